/* Figures: data whole, and described as python/floe reads them (tests/python/test_pictures.py draws them); what starting Python comes to. */
#include "check.h"

#include "base/memory.h"
#include "io/file.h"
#include "plot/plot.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH = 512 };

typedef struct place {
    context *ctx;
    char dir[PATH];
    int warnings;
} place;

static void count_warnings(void *user, log_level level, const char *line)
{
    place *p = user;
    (void)line;
    p->warnings += level == LOG_WARNING;
}

static int set_up(void **state)
{
    static place p;
    p = (place){.ctx = context_create()};
    (void)snprintf(p.dir, sizeof p.dir, "plot_XXXXXX");
    if (!p.ctx || !mkdtemp(p.dir)) return -1;
    context_set_sink(p.ctx, count_warnings, &p, LOG_WARNING);
    *state = &p;
    return 0;
}

static int tear_down(void **state)
{
    place *p = *state;
    char command[PATH + 16];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", p->dir);
    const int status = system(command);
    assert_int_equal(memory_read_account(p->ctx).live_bytes, 0);
    context_destroy(&p->ctx);
    return status;
}

static void path_of(const place *p, const char *name, char path[2 * PATH])
{
    (void)snprintf(path, (size_t)2 * PATH, "%s/%s", p->dir, name);
}

/* Two panels with all that is odd: quotes, markup, an empty series, gaps. */
static const double h[] = {0.1, 0.05, 0.025}, error[] = {0.04, 0.0, NAN};
static const plot_series converge[] = {
    {.name = "ice-mpm's \"best\" <50%>", .style = PLOT_LINES_POINTS, .colour = 1, .x = h, .y = error, .n = 3},
    {.name = "nothing", .style = PLOT_POINTS, .colour = 2},
    {.style = PLOT_LINES, .emphasis = true, .x = h, .y = h, .n = 2},
};
static const plot_panel panels[] = {{.title = "it's an error",
                                     .x_label = "h (m)",
                                     .y_label = "error (%)",
                                     .log_x = true,
                                     .log_y = true,
                                     .series = converge,
                                     .n_series = 3,
                                     .slope = {1.0, 2.0},
                                     .n_slopes = 2},
                                    {.series = converge, .n_series = 1}};
static const plot_figure figure = {
    .name = "errors", .title = "O'Hara & <co>", .columns = 2, .panel = panels, .n_panels = 2};

static const json_t *series_at(const json_t *told, size_t panel, size_t series)
{
    return json_array_get(json_object_get(json_array_get(json_object_get(told, "panels"), panel), "series"), series);
}

static void writes_data_and_description(void **state)
{
    place *p = *state;
    char path[2 * PATH];
    char *text;
    plot_names names = {0};
    path_of(p, "errors.svg", path);
    check_ok(p->ctx, file_replace_text(p->ctx, path, "an earlier drawing"));
    check_ok(p->ctx, plot_write_data(p->ctx, p->dir, &figure, &names));
    assert_false(file_exists(path));
    assert_int_equal(names.n, 1);
    assert_string_equal(names.name[0], "errors");

    path_of(p, "errors.csv", path);
    check_ok(p->ctx, file_read(p->ctx, path, &text, NULL));
    assert_string_equal(text,
                        "panel,series,x,y,label\n"
                        "\"it's an error\",\"ice-mpm's \"\"best\"\" <50%>\",0.10000000000000001,0.040000000000000001,\n"
                        "\"it's an error\",\"ice-mpm's \"\"best\"\" <50%>\",0.050000000000000003,0,\n"
                        "\"it's an error\",\"ice-mpm's \"\"best\"\" <50%>\",0.025000000000000001,nan,\n"
                        "\"it's an error\",\"\",0.10000000000000001,0.10000000000000001,\n"
                        "\"it's an error\",\"\",0.050000000000000003,0.050000000000000003,\n"
                        "\"\",\"ice-mpm's \"\"best\"\" <50%>\",0.10000000000000001,0.040000000000000001,\n"
                        "\"\",\"ice-mpm's \"\"best\"\" <50%>\",0.050000000000000003,0,\n"
                        "\"\",\"ice-mpm's \"\"best\"\" <50%>\",0.025000000000000001,nan,\n");
    memory_free(p->ctx, &text);

    json_error_t wrong;
    path_of(p, "errors.json", path);
    json_t *told = json_load_file(path, 0, &wrong);
    assert_non_null(told);
    const json_t *first = json_array_get(json_object_get(told, "panels"), 0);
    assert_string_equal(json_string_value(json_object_get(told, "title")), "O'Hara & <co>");
    assert_int_equal(json_integer_value(json_object_get(told, "columns")), 2);
    assert_int_equal(json_array_size(json_object_get(told, "panels")), 2);
    assert_true(json_is_true(json_object_get(first, "log_x")));
    assert_int_equal(json_array_size(json_object_get(first, "slopes")), 2);
    assert_string_equal(json_string_value(json_object_get(series_at(told, 0, 0), "style")), "linespoints");
    assert_int_equal(json_integer_value(json_object_get(series_at(told, 0, 1), "rows")), 0);
    assert_true(json_is_true(json_object_get(series_at(told, 0, 2), "emphasis")));
    assert_int_equal(json_integer_value(json_object_get(series_at(told, 1, 0), "rows")), 3);
    json_decref(told);
}

/* Wherever memory runs out: that is said, and nothing leaks. */
static void survives_without_memory(void **state)
{
    place *p = *state;
    floe_status status = FLOE_NO_MEMORY;
    int failed = 0;
    assert_int_equal(setenv("FLOE_PYTHON", "true", 1), 0);
    for (uint64_t n = 1; n < 200 && status != FLOE_OK; n++) {
        plot_names names = {0};
        memory_inject_failure(p->ctx, n);
        status = plot_write_data(p->ctx, p->dir, &figure, &names);
        if (status == FLOE_OK) status = plots_draw(p->ctx, p->dir, &names);
        memory_inject_failure(p->ctx, 0);
        assert_int_equal(memory_read_account(p->ctx).live_bytes, 0);
        if (status == FLOE_OK) continue;
        check_fails(p->ctx, status, FLOE_NO_MEMORY);
        failed++;
    }
    check_ok(p->ctx, status);
    assert_true(failed > 8);
}

/* What stands for Python: a script that ends with a status. */
static void stand_in(const place *p, const char *content, char path[2 * PATH])
{
    char command[8 * PATH];
    path_of(p, "python", path);
    (void)snprintf(command, sizeof command, "printf '#!/bin/sh\\n%s\\n' >'%s' && chmod +x '%s'", content, path, path);
    assert_int_equal(system(command), 0);
    assert_int_equal(setenv("FLOE_PYTHON", path, 1), 0);
}

static void exit_statuses_are_told_apart(void **state)
{
    place *p = *state;
    const char *const argument[] = {"picture", "a b"};
    char path[2 * PATH];
    int exit_status = -1;
    stand_in(p, "[ \"$2\" = picture ] && [ \"$3\" = \"a b\" ] && [ -f \"$1/__main__.py\" ]", path);
    check_ok(p->ctx, python_run(p->ctx, argument, 2, NULL, &exit_status));
    assert_int_equal(exit_status, 0);
    stand_in(p, "exit 2", path);
    check_ok(p->ctx, python_run(p->ctx, argument, 2, NULL, &exit_status));
    assert_int_equal(exit_status, 2);
    const char *const bad[] = {"exit 1", "kill -9 $$", "exit 69"};
    const char *const said[] = {"has failed", "has failed", "install python3-numpy"};
    for (int i = 0; i < 3; i++) {
        stand_in(p, bad[i], path);
        const floe_status status = python_run(p->ctx, argument, 2, NULL, &exit_status);
        assert_non_null(strstr(context_message(p->ctx), said[i]));
        check_fails(p->ctx, status, FLOE_IO);
    }
    /* Plots that are not made are warned of. */
    check_ok(p->ctx, plots_draw(p->ctx, p->dir, &(plot_names){.name = {"errors"}, .n = 1}));
    assert_int_equal(p->warnings, 1);
    assert_int_equal(setenv("FLOE_PYTHON", "/no/such/python", 1), 0);
    check_fails(p->ctx, python_run(p->ctx, argument, 2, NULL, &exit_status), FLOE_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(writes_data_and_description, set_up, tear_down),
        cmocka_unit_test_setup_teardown(survives_without_memory, set_up, tear_down),
        cmocka_unit_test_setup_teardown(exit_statuses_are_told_apart, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

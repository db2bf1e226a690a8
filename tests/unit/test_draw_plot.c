/* Figures: data whole, scripts that gnuplot takes whatever the names, and pictures fit for pages. */
#include "check.h"

#include "base/memory.h"
#include "draw/plot.h"
#include "io/file.h"

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
    context_destroy(&p->ctx);
    return status;
}

static char *read_back(const place *p, const char *name)
{
    char path[2 * PATH];
    static char *text; /* static, or gcc 12 takes the pointer that is returned for one to it */
    (void)snprintf(path, sizeof path, "%s/%s", p->dir, name);
    check_ok(p->ctx, file_read(p->ctx, path, &text, NULL));
    return text;
}

static bool is_there(const place *p, const char *name)
{
    char path[2 * PATH];
    (void)snprintf(path, sizeof path, "%s/%s", p->dir, name);
    return file_exists(path);
}

static bool has_gnuplot(void)
{
    return system("command -v gnuplot >/dev/null 2>&1") == 0;
}

static int count(const char *text, const char *what)
{
    int n = 0;
    for (const char *at = strstr(text, what); at; at = strstr(at + 1, what)) n++;
    return n;
}

/* Two panels with all that is odd: quotes, markup, an empty series, gaps, zeros on logarithmic axes. */
static const double h[] = {0.1, 0.05, 0.025, 0.0125}, error[] = {0.04, 0.0, NAN, 6.3e-4},
                    time_[] = {0.0, 1.0, 2.0, 3.0};
static const char *const label[] = {"a \"quoted\\n\" one", "zero", "gap", NULL};
static const plot_series converge[] = {
    {.name = "ice-mpm's \"best\" <50%> a_b",
     .style = PLOT_LINES_POINTS,
     .colour = 1,
     .x = h,
     .y = error,
     .label = label,
     .n = 4},
    {.name = "nothing", .style = PLOT_POINTS, .colour = 2},
    {.name = "front", .style = PLOT_LINES_POINTS, .emphasis = true, .x = h, .y = error, .n = 4},
};
static const plot_series history[] = {
    {.name = "steps", .style = PLOT_STEPS, .colour = 9, .x = time_, .y = h, .n = 4},
    {.name = "line", .style = PLOT_LINES, .colour = 3, .x = time_, .y = error, .n = 4},
};
static const plot_panel panels[] = {
    {.title = "it's an error",
     .x_label = "h (m)",
     .y_label = "error (%)",
     .log_x = true,
     .log_y = true,
     .series = converge,
     .n_series = 3,
     .slope = {1.0, 2.0},
     .n_slopes = 2},
    {.title = "nothing here", .log_y = true, .series = &converge[1], .n_series = 1},
    {.x_label = "time (s)", .series = history, .n_series = 2},
};

static void writes_data_script_and_picture(void **state)
{
    place *p = *state;
    const plot_figure figure = {
        .name = "01-it's a/figure.x", .title = "O'Hara & <co>", .columns = 2, .panel = panels, .n_panels = 3};
    check_ok(p->ctx, plot_write(p->ctx, p->dir, &figure));
    char *csv = read_back(p, "01-it_s_a_figure.x.csv");
    assert_int_equal(strncmp(csv, "panel,series,x,y,label\n", 23), 0);
    assert_int_equal(count(csv, "\n"), 1 + 4 + 4 + 4 + 4); /* every value, drawn or not */
    assert_non_null(strstr(csv, "\"it's an error\",\"ice-mpm's \"\"best\"\" <50%> "
                                "a_b\",0.10000000000000001,0.040000000000000001,\"a \"\"quoted\\n\"\" one\"\n"));
    assert_non_null(strstr(csv, ",0.050000000000000003,0,\"zero\"\n"));
    assert_non_null(strstr(csv, ",0.025000000000000001,nan,\"gap\"\n"));
    memory_free(p->ctx, &csv);

    char *script = read_back(p, "01-it_s_a_figure.x.gp");
    assert_non_null(strstr(script, "$p0s0 << EOD\n0.1 0.04 \"a 'quoted/n' one\"\n\n\n0.0125 0.00063 \"\"\nEOD\n"));
    assert_null(strstr(script, "$p0s1")); /* nothing to draw */
    assert_non_null(strstr(script, "title 'ice-mpm''s \"best\" <50%> a_b'"));
    /* A label stands at the end of its line. */
    double x, y, end[2];
    const char *slope = strstr(script, "set label 'slope 1' at ");
    const char *line = strstr(script, "$slope0 << EOD\n");
    assert_non_null(slope);
    assert_non_null(line);
    assert_int_equal(sscanf(slope, "set label 'slope 1' at %lf,%lf", &x, &y), 2);
    assert_int_equal(sscanf(line, "$slope0 << EOD\n%*f %*f\n%lf %lf", &end[0], &end[1]), 2);
    assert_true(x == end[0] && y == end[1]);
    assert_non_null(strstr(script, "set label 'slope 2'"));
    assert_non_null(strstr(script, "'no data'"));
    memory_free(p->ctx, &script);

    assert_int_equal(is_there(p, "01-it_s_a_figure.x.svg"), has_gnuplot());
    assert_int_equal(p->warnings, has_gnuplot() ? 0 : 1);
}

/* Everything that a picture refers to is its own, so that two of them may stand in one page. */
static void pictures_may_share_a_page(void **state)
{
    place *p = *state;
    const plot_figure figure[] = {
        {.name = "one", .title = "O'Hara & <co>", .panel = panels, .n_panels = 3},
        {.name = "two", .panel = panels, .n_panels = 1},
    };
    check_ok(p->ctx, plots_write(p->ctx, p->dir, figure, 2));
    if (!has_gnuplot()) skip();
    char *svg = read_back(p, "one.svg");
    assert_int_equal(count(svg, "<svg class=\"floe-plot\" role=\"img\""), 1);
    assert_int_equal(count(svg, "</svg>"), 1);
    assert_non_null(strstr(svg, "<title>O&apos;Hara &amp; &lt;co&gt;</title>"));
    assert_non_null(strstr(svg, "prefers-color-scheme: dark"));
    assert_int_equal(count(svg, " id='"), count(svg, " id='one-gp"));
    assert_int_equal(count(svg, " id=\""), 0);
    assert_int_equal(count(svg, "href='#"), count(svg, "href='#one-gp"));
    memory_free(p->ctx, &svg);
    svg = read_back(p, "two.svg");
    assert_non_null(strstr(svg, "href='#two-gpPt"));
    memory_free(p->ctx, &svg);
}

/* What hardly changes, or does not, is drawn too: a single point, round-off, huge and tiny numbers. */
static void draws_what_is_constant(void **state)
{
    place *p = *state;
    static const double x[] = {1.0, 1.0 + 1e-15, 1.0 + 2e-15}, tiny[] = {0.0, 1e-300, 2e-300};
    static const double huge[] = {-1e300, 0.0, 1e300}, zero[] = {0.0, 0.0, 0.0};
    static const plot_series series[] = {
        {.name = "round-off", .style = PLOT_LINES, .x = x, .y = x, .n = 3},
        {.name = "one", .style = PLOT_LINES, .x = x, .y = x, .n = 1},
        {.name = "tiny", .style = PLOT_LINES, .x = x, .y = tiny, .n = 3},
        {.name = "huge", .style = PLOT_LINES, .x = x, .y = huge, .n = 3},
        {.name = "zero", .style = PLOT_LINES, .x = zero, .y = zero, .n = 3},
    };
    enum { N = sizeof series / sizeof series[0] };
    plot_panel panel[2 * N];
    plot_figure figure[2 * N];
    char name[2 * N][16];
    for (int i = 0; i < 2 * N; i++) {
        (void)snprintf(name[i], sizeof name[i], "plot%d", i);
        panel[i] = (plot_panel){.log_x = i >= N, .log_y = i >= N, .series = &series[i % N], .n_series = 1};
        figure[i] = (plot_figure){.name = name[i], .panel = &panel[i], .n_panels = 1};
    }
    check_ok(p->ctx, plots_write(p->ctx, p->dir, figure, 2 * N));
    if (!has_gnuplot()) skip();
    assert_int_equal(p->warnings, 0);
}

static void does_without_gnuplot(void **state)
{
    place *p = *state;
    const plot_figure figure[] = {{.name = "one", .panel = panels, .n_panels = 3},
                                  {.name = "two", .panel = panels, .n_panels = 1}};
    char *path = getenv("PATH"), *kept = path ? strdup(path) : NULL;
    assert_non_null(kept);
    assert_int_equal(setenv("PATH", p->dir, 1), 0);
    const floe_status status = plots_write(p->ctx, p->dir, figure, 2);
    assert_int_equal(setenv("PATH", kept, 1), 0);
    free(kept);
    check_ok(p->ctx, status);
    assert_int_equal(p->warnings, 1); /* not one for each */
    assert_true(is_there(p, "one.csv") && is_there(p, "one.gp") && is_there(p, "two.gp"));
    assert_false(is_there(p, "one.svg"));
}

/* Of a long line with a jump, a peak and a gap these stay, and both ends; of a cloud an even part; a short or labelled curve is whole. */
static void thins_long_curves(void **state)
{
    place *p = *state;
    enum { N = 20000, MOST = 100, JUMP = 7003, PEAK = 15001, GAP = 10000 };
    static double x[N], y[N];
    static const char *text[N];
    for (int i = 0; i < N; i++) {
        x[i] = i;
        y[i] = i < JUMP ? 1.0 : 2.0;
        if (i >= GAP && i < GAP + 2000) y[i] = (double)NAN;
    }
    y[PEAK] = 5.0;
    const plot_series series[] = {
        {.name = "line", .style = PLOT_LINES, .x = x, .y = y, .n = N},
        {.name = "cloud", .style = PLOT_POINTS, .x = x, .y = x, .n = N},
        {.name = "whole", .style = PLOT_POINTS, .x = x, .y = x, .label = text, .n = MOST + 1},
        {.name = "short", .style = PLOT_LINES, .x = x, .y = x, .n = MOST},
    };
    const plot_panel panel = {.series = series, .n_series = 4};
    plot_figure figure = {.name = "long", .panel = &panel, .n_panels = 1};
    assert_false(plot_is_thinned(&figure));
    figure.most = MOST;
    assert_true(plot_is_thinned(&figure));
    check_ok(p->ctx, plot_write(p->ctx, p->dir, &figure));
    char *csv = read_back(p, "long.csv");
    assert_int_equal(count(csv, "\"line\""), MOST + 1); /* and the gap */
    assert_int_equal(count(csv, "\"cloud\""), MOST);
    assert_int_equal(count(csv, "\"whole\""), MOST + 1);
    assert_int_equal(count(csv, "\"short\""), MOST);
    assert_int_equal(count(csv, ",nan,nan,"), 1);
    assert_non_null(strstr(csv, "\"line\",0,1,\n"));
    assert_non_null(strstr(csv, "\"line\",19999,2,\n"));
    assert_non_null(strstr(csv, "\"line\",15001,5,\n"));
    assert_non_null(strstr(csv, "\"cloud\",0,0,\n"));
    assert_non_null(strstr(csv, "\"cloud\",19999,19999,\n"));
    /* The jump lies between neighbours that are no further apart than two buckets; so do neighbours of the cloud. */
    double at, value, last = 0.0, before = 1.0;
    bool jumped = false;
    for (const char *line = strstr(csv, "\"line\""); line; line = strstr(line + 1, "\"line\"")) {
        if (sscanf(line, "\"line\",%lf,%lf", &at, &value) != 2 || isnan(at)) continue;
        if (before == 1.0 && value == 2.0) {
            jumped = true;
            assert_true(last < JUMP && at >= JUMP && at - last <= 2.0 * (N - 2) / (MOST - 2) + 1.0);
        }
        before = value;
        last = at;
    }
    assert_true(jumped);
    last = 0.0;
    for (const char *line = strstr(csv, "\"cloud\""); line; line = strstr(line + 1, "\"cloud\"")) {
        assert_int_equal(sscanf(line, "\"cloud\",%lf", &at), 1);
        assert_true(at - last <= 2.0 * (N - 2) / (MOST - 2) + 1.0);
        last = at;
    }
    memory_free(p->ctx, &csv);
    figure.most = 2;
    assert_int_equal(plot_write(p->ctx, p->dir, &figure), FLOE_INTERNAL);
}

/* Marks are grouped, and none is lost or moved: the key's and those of all points. */
static void marks_stay_where_they_are(void **state)
{
    place *p = *state;
    static const double x[] = {0.0, 1.0, 2.0, 3.0};
    const plot_series series[] = {{.name = "a", .style = PLOT_POINTS, .x = x, .y = x, .n = 4},
                                  {.name = "b", .style = PLOT_POINTS, .colour = 1, .x = x, .y = h, .n = 4}};
    const plot_panel panel = {.series = series, .n_series = 2};
    const plot_figure figure = {.name = "marks", .panel = &panel, .n_panels = 1};
    check_ok(p->ctx, plot_write(p->ctx, p->dir, &figure));
    if (!has_gnuplot()) skip();
    char *svg = read_back(p, "marks.svg");
    assert_int_equal(count(svg, "<use xlink:href='#marks-gpPt6' x="), 5);
    assert_int_equal(count(svg, "<use xlink:href='#marks-gpPt4' x="), 5);
    /* Evenly spaced points of the line y = x are evenly spaced marks, one below the other. */
    double at[4][2], scale;
    const char *group = strstr(svg, "' transform='scale(");
    assert_non_null(group);
    assert_int_equal(sscanf(group, "' transform='scale(%lf)", &scale), 1);
    for (int i = 0; i < 4; i++) {
        group = strstr(group + 1, "<use xlink:href='#marks-gpPt6' x=");
        assert_non_null(group);
        assert_int_equal(sscanf(group, "<use xlink:href='#marks-gpPt6' x='%lf' y='%lf'/>", &at[i][0], &at[i][1]), 2);
    }
    for (int i = 2; i < 4; i++) {
        for (int a = 0; a < 2; a++) {
            const double step = at[1][a] - at[0][a];
            assert_true(fabs(at[i][a] - at[0][a] - i * step) * scale < 0.1); /* px; gnuplot writes hundredths */
            assert_true(a == 0 ? step > 0.0 : step < 0.0);
        }
    }
    memory_free(p->ctx, &svg);
}

static void stems_are_plain(void **state)
{
    (void)state;
    char stem[PLOT_STEM];
    plot_stem("../a b'\"$", stem);
    assert_string_equal(stem, "_._a_b___");
    plot_stem("", stem);
    assert_string_equal(stem, "plot");
    plot_stem("-e", stem);
    assert_string_equal(stem, "_e");
    char text[2 * PLOT_STEM];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    plot_stem(text, stem);
    assert_int_equal(strlen(stem), PLOT_STEM - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(writes_data_script_and_picture, set_up, tear_down),
        cmocka_unit_test_setup_teardown(pictures_may_share_a_page, set_up, tear_down),
        cmocka_unit_test_setup_teardown(draws_what_is_constant, set_up, tear_down),
        cmocka_unit_test_setup_teardown(thins_long_curves, set_up, tear_down),
        cmocka_unit_test_setup_teardown(marks_stay_where_they_are, set_up, tear_down),
        cmocka_unit_test_setup_teardown(does_without_gnuplot, set_up, tear_down),
        cmocka_unit_test(stems_are_plain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

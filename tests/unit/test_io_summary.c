/* The summary: exactly the fields of the contract, every digit kept, NaN as null, and a reader that says what is wrong. */
#include "test_io_fixture.h"

#include "io/summary.h"
#include "test_io_faults.h"

#include <jansson.h>

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

static run_summary some_summary(fixture *f)
{
    run_summary r = {.status = "done",
                     .message = "a \"cause\"",
                     .wall_seconds = 1.0 / 3.0,
                     .output_seconds = 0.25,
                     .cpu_seconds = 0.125,
                     .reference_accuracy = 3e-4,
                     .peak_rss_bytes = 123456789012345,
                     .threads = 2};
    (void)snprintf(r.deck, sizeof r.deck, "inputs/pressurized \"cylinder\".yaml");
    summary_set_build(&r);
    check_ok(f->ctx, summary_set_sim(&r, &f->sim));
    summary_add_warning(&r, "half of it is \"lost\"");
    summary_add_warning(&r, "and the rest");
    (void)snprintf(r.notes, sizeof r.notes, "3 points lost");
    check_ok(f->ctx, summary_add_error(&r, f->ctx, "eq13", 0.066));
    check_ok(f->ctx, summary_add_error(&r, f->ctx, "l1_sigma_r", NAN));
    return r;
}

static void has_fields(const json_t *object, const char *const *names)
{
    size_t n = 0;
    for (; names[n]; n++) {
        if (!json_object_get(object, names[n])) print_error("no field '%s'\n", names[n]);
        assert_non_null(json_object_get(object, names[n]));
    }
    assert_int_equal(json_object_size(object), n);
}

static void has_fields_of_contract(void **state)
{
    (void)state;
    static const char *const top[] = {"schema",
                                      "deck",
                                      "coupling",
                                      "solver",
                                      "pressure",
                                      "substeps",
                                      "units",
                                      "status",
                                      "message",
                                      "time",
                                      "steps",
                                      "rejected_steps",
                                      "wall_seconds",
                                      "output_seconds",
                                      "cpu_seconds",
                                      "seconds_by_stage",
                                      "cells",
                                      "points",
                                      "cell_updates",
                                      "point_updates",
                                      "memory",
                                      "conservation",
                                      "warnings",
                                      "notes",
                                      "errors",
                                      "counters",
                                      "floe",
                                      "interface",
                                      "reference_accuracy",
                                      NULL};
    static const char *const memory[] = {"peak_rss_bytes", "field_bytes", NULL};
    static const char *const bytes[] = {"mpm", "ice", "coupling", NULL};
    static const char *const drift[] = {"mass", "momentum", "angular_momentum", "energy", "at_end", NULL};
    static const char *const build[] = {"version", "git", "compiler", "flags", "machine", "threads", NULL};
    fixture f;
    fixture_make(&f, &coupled);
    const run_summary r = some_summary(&f);
    json_t *object = summary_json(&r);
    has_fields(object, top);
    has_fields(json_object_get(object, "memory"), memory);
    has_fields(json_object_get(json_object_get(object, "memory"), "field_bytes"), bytes);
    has_fields(json_object_get(object, "conservation"), drift);
    has_fields(json_object_get(object, "floe"), build);
    assert_int_equal(json_integer_value(json_object_get(object, "schema")), 1);
    assert_true(json_is_null(json_object_get(json_object_get(object, "errors"), "l1_sigma_r")));
    assert_int_equal(json_integer_value(json_object_get(json_object_get(object, "counters"), "newton_cells")), 100);
    json_decref(object);
    fixture_free(&f);
}

static void reads_back(void **state)
{
    (void)state;
    fixture f;
    run_summary back;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "summary.json");
    fixture_make(&f, &coupled);
    run_summary r = some_summary(&f);
    check_ok(f.ctx, summary_write(f.ctx, path, &r));
    check_ok(f.ctx, summary_read(f.ctx, path, &back));
    assert_true(isnan(back.errors[1].value));
    back.errors[1].value = r.errors[1].value = 0.0; /* a NaN's bits are not kept */
    assert_string_equal(back.errors[1].name, "l1_sigma_r");
    assert_true(back.n_errors == 2 && back.errors[0].value == 0.066);
    assert_true(summary_run_seconds(&back) == 1.0 / 3.0 - 0.25);
    assert_true(back.wall_seconds == 1.0 / 3.0 && back.time == f.sim.time && back.steps == 1234);
    assert_true(back.point_updates == 1e18 / 3.0 && back.cell_updates == 17.0);
    assert_true(back.cells == 480 && back.points > 200);
    assert_true(back.n_counters == LEDGER_COUNTS && back.counters[LEDGER_COUNTS - 1].value == 100 + LEDGER_COUNTS - 1);
    assert_true(back.field_bytes_mpm > 0 && back.field_bytes_ice > 0 && back.field_bytes_coupling > 0);
    assert_memory_equal(&back, &r, sizeof r); /* all of it */
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void refuses(fixture *f, const char *path, const char *text, const char *words)
{
    run_summary back;
    check_ok(f->ctx, file_replace_text(f->ctx, path, text));
    const floe_status status = summary_read(f->ctx, path, &back);
    if (!strstr(context_message(f->ctx), words)) print_error("%s\n", context_message(f->ctx));
    assert_non_null(strstr(context_message(f->ctx), words));
    check_fails(f->ctx, status, FLOE_IO);
}

static void says_what_is_wrong(void **state)
{
    (void)state;
    fixture f;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "summary.json");
    fixture_make(&f, &coupled);
    refuses(&f, path, "", ":1:0: not JSON");
    refuses(&f, path, "{\n \"schema\": 1,\n}", ":3:1: not JSON");
    refuses(&f, path, "[]", "'schema' should be");
    refuses(&f, path, "{\"schema\": 2}", "'schema' should be 1");
    refuses(&f, path, "{\"schema\": 1, \"deck\": 7}", "'deck' should be a text");
    const run_summary r = some_summary(&f);
    json_t *object = summary_json(&r);
    assert_int_equal(json_object_set_new(object, "steps", json_string("many")), 0);
    char *text = json_dumps(object, 0);
    refuses(&f, path, text, "'steps' should be a whole number");
    free(text);
    json_decref(object);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void keeps_earlier_when_disk_is_full(void **state)
{
    (void)state;
    fixture f;
    run_summary back;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "summary.json");
    fixture_make(&f, &coupled);
    run_summary r = some_summary(&f);
    check_ok(f.ctx, summary_write(f.ctx, path, &r));
    r.steps = 9;
    int n = 1, in_place = 0; /* each operation in turn, until there is none left to fail */
    for (;; n++) {
        fault_arm(n, ENOSPC, true);
        const floe_status status = summary_write(f.ctx, path, &r);
        fault_arm(0, 0, false);
        if (status == FLOE_OK) break;
        check_fails(f.ctx, status, FLOE_IO);
        check_ok(f.ctx, summary_read(f.ctx, path, &back));
        in_place += back.steps == 9; /* the folder's own entry could not be brought to the disk */
        assert_int_equal(back.steps, in_place ? 9 : 1234);
    }
    check_true(n >= 5); /* to write, to bring it to the disk, to put it in its place, to bring that to the disk */
    assert_int_equal(in_place, 1);
    check_ok(f.ctx, summary_read(f.ctx, path, &back));
    assert_int_equal(back.steps, 9);
    while (r.n_errors < SUMMARY_MAX_ERRORS) check_ok(f.ctx, summary_add_error(&r, f.ctx, "more", 0.0));
    check_fails(f.ctx, summary_add_error(&r, f.ctx, "too many", 0.0), FLOE_INTERNAL);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(has_fields_of_contract),
        cmocka_unit_test(reads_back),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(keeps_earlier_when_disk_is_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* From snapshots to pictures: every kind of scene, what is chosen where nothing is asked for, what is refused, and with what words. */
#include "test_io_fixture.h"

#include "draw/field_choice.h"
#include "draw/field_picture.h"
#include "io/snapshot/snapshot.h"

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

static void begin(fixture *f, const fixture_spec *spec, char folder[FIXTURE_PATH], int times)
{
    snapshot_series *series;
    fixture_folder(folder);
    fixture_make(f, spec);
    check_ok(f->ctx, snapshot_open(&series, f->ctx, folder, "floe: 1\n", -INFINITY));
    for (int i = 0; i < times; i++) {
        f->sim.time = 1e-3 * i;
        check_ok(f->ctx, snapshot_write(series, &f->sim));
    }
    snapshot_close(&series);
}

static void end(fixture *f, const char *folder)
{
    fixture_free(f);
    fixture_remove_folder(folder);
}

static void check_png(context *ctx, const char *path)
{
    static const unsigned char magic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    size_t size;
    char *data = fixture_read(ctx, path, &size);
    assert_true(size > 2000);
    assert_memory_equal(data, magic, sizeof magic);
    memory_free(ctx, &data);
    check_ok(ctx, file_remove(ctx, path));
}

static void every_scene_has_a_picture(void **state)
{
    (void)state;
    const struct {
        fixture_spec spec;
        const char *caption;
    } cases[] = {
        {coupled, "von Mises stress of points over pressure of cells at t = 1 ms"},
        {{.dim = 1, .cells = {40}, .with_points = true, .with_cells = true},
         "stress xx of points over pressure of cells at t = 1 ms"},
        {{.dim = 3, .cells = {6, 5, 4}, .with_points = true, .with_cells = true},
         "von Mises stress of points over pressure of cells in the middle plane at t = 1 ms"},
        {{.dim = 2, .cells = {9, 8}, .with_points = true, .geometry = MESH_AXISYMMETRIC},
         "von Mises stress of points at t = 1 ms"},
        {{.dim = 2, .cells = {9, 8}, .with_cells = true}, "pressure of cells at t = 1 ms"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int dark = 0; dark < 2; dark++) {
            fixture f;
            char folder[FIXTURE_PATH], path[FIXTURE_PATH], caption[FIELD_CAPTION];
            const field_picture_options o = {.dark = dark != 0, .width = 300};
            begin(&f, &cases[i].spec, folder, 2);
            fixture_path(path, folder, "a.png");
            check_ok(f.ctx, field_picture_write(f.ctx, folder, 1, &o, path, caption));
            assert_string_equal(caption, cases[i].caption);
            check_png(f.ctx, path);
            end(&f, folder);
        }
    }
}

static void refuses(fixture *f, const char *folder, const field_picture_options *o, const char *reason)
{
    char path[FIXTURE_PATH];
    fixture_path(path, folder, "a.png");
    const floe_status status = field_picture_write(f->ctx, folder, 0, o, path, NULL);
    if (!strstr(context_message(f->ctx), reason)) print_error("'%s' in '%s'\n", reason, context_message(f->ctx));
    assert_non_null(strstr(context_message(f->ctx), reason));
    check_fails(f->ctx, status, FLOE_BAD_INPUT);
    assert_false(file_exists(path));
}

static void unknown_fields_are_answered_with_known_ones(void **state)
{
    (void)state;
    fixture f;
    char folder[FIXTURE_PATH];
    begin(&f, &coupled, folder, 1);
    refuses(&f, folder, &(field_picture_options){.points = "mises"}, "von_mises");
    refuses(&f, folder, &(field_picture_options){.points = "velocity_z"}, "velocity (_x, _y)"); /* the plane has no z */
    refuses(&f, folder, &(field_picture_options){.cells = "von_mises"}, "there is no field 'von_mises' of cells");
    refuses(&f, folder, &(field_picture_options){.points = "none", .cells = "none"}, "nothing to draw");
    end(&f, folder);
}

/* Vectors by magnitude and component; materials' fields are blank where the material is not. */
static void values_are_what_was_chosen(void **state)
{
    (void)state;
    fixture f;
    snapshot s;
    field_choice choice;
    double *value, *vector;
    char folder[FIXTURE_PATH];
    begin(&f, &coupled, folder, 1);
    check_ok(f.ctx, snapshot_read(&s, f.ctx, folder, 0));
    const snapshot_field *velocity = snapshot_find(&s.grid, "velocity_gas");
    assert_non_null(velocity);
    check_ok(f.ctx, snapshot_values(&s, &s.grid, velocity, &vector));
    const char *const names[] = {"velocity_gas", "velocity_gas_x", "velocity_gas_y"};
    for (int n = 0; n < 3; n++) {
        size_t blank = 0;
        field_choose(&s, &s.grid, names[n], &choice);
        assert_ptr_equal(choice.field, velocity);
        assert_true(choice.is_signed == (n > 0));
        check_ok(f.ctx, field_values(&s, &s.grid, &choice, &value));
        for (size_t i = 0; i < s.grid.n; i++) {
            const double *v = vector + 3 * i;
            const double expected = n == 0 ? sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) : v[n - 1];
            if (isnan(value[i])) {
                blank++;
            } else {
                check_close_relative(value[i], expected, 1e-15);
            }
        }
        assert_true(blank < s.grid.n);
        memory_free(f.ctx, &value);
    }
    field_choose(&s, &s.grid, "velocity_gas_z", &choice);
    assert_null(choice.field);
    memory_free(f.ctx, &vector);
    snapshot_free(&s);
    end(&f, folder);
}

static void common_range_holds_all_and_keeps_what_is_given(void **state)
{
    (void)state;
    fixture f;
    snapshot_times times;
    char folder[FIXTURE_PATH];
    field_picture_options o = {.range = {{1.0, 2.0}}};
    begin(&f, &coupled, folder, 3);
    check_ok(f.ctx, snapshot_times_read(&times, f.ctx, folder));
    check_ok(f.ctx, field_picture_common_range(f.ctx, folder, &times, &o));
    assert_true(o.range[0].lower == 1.0 && o.range[0].upper == 2.0);
    assert_true(o.range[1].lower < o.range[1].upper);
    snapshot_times_free(f.ctx, &times);
    end(&f, folder);
}

/* Wherever memory runs out: that is said, no half file is left, nothing leaks. */
static void survives_without_memory(void **state)
{
    (void)state;
    fixture f;
    int failed = 0;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    const field_picture_options o = {.width = 300};
    begin(&f, &coupled, folder, 1);
    fixture_path(path, folder, "a.png");
    const uint64_t before = memory_read_account(f.ctx).live_bytes;
    floe_status status = FLOE_NO_MEMORY;
    for (uint64_t n = 1; n < 200 && status != FLOE_OK; n++) {
        memory_inject_failure(f.ctx, n);
        status = field_picture_write(f.ctx, folder, 0, &o, path, NULL);
        memory_inject_failure(f.ctx, 0);
        assert_int_equal(memory_read_account(f.ctx).live_bytes, before);
        if (status == FLOE_OK) continue;
        check_fails(f.ctx, status, FLOE_NO_MEMORY);
        if (file_exists(path)) check_png(f.ctx, path); /* whole or not at all */
        failed++;
    }
    check_ok(f.ctx, status);
    assert_true(failed > 15);
    end(&f, folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scene_has_a_picture),  cmocka_unit_test(unknown_fields_are_answered_with_known_ones),
        cmocka_unit_test(values_are_what_was_chosen), cmocka_unit_test(common_range_holds_all_and_keeps_what_is_given),
        cmocka_unit_test(survives_without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Snapshots read back: what the library wrote of a simulation is what it reads, and what is damaged or foreign is refused. */
#include "test_io_fixture.h"

#include "io/snapshot/snapshot_read.h"

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

static const snapshot_field *field_of(const snapshot_group *group, const char *name)
{
    const snapshot_field *field = snapshot_find(group, name);
    if (!field) print_error("no field '%s' in '%s'\n", name, group->name);
    assert_non_null(field);
    return field;
}

static void head_tells_the_scene(void **state)
{
    (void)state;
    const fixture_spec specs[] = {
        coupled,
        {.dim = 1, .cells = {40}, .with_points = true, .with_cells = true},
        {.dim = 3, .cells = {6, 5, 4}, .with_points = true, .with_cells = true},
        {.dim = 2, .cells = {9, 8}, .with_points = true, .geometry = MESH_AXISYMMETRIC},
        {.dim = 2, .cells = {9, 8}, .with_cells = true},
    };
    for (size_t i = 0; i < sizeof specs / sizeof specs[0]; i++) {
        const fixture_spec *spec = &specs[i];
        fixture f;
        snapshot s;
        size_t cells = 1;
        char folder[FIXTURE_PATH];
        fixture_folder(folder);
        fixture_make(&f, spec);
        fixture_write_times(&f, folder, 2);
        check_ok(f.ctx, snapshot_read(&s, f.ctx, folder, 1));
        assert_int_equal(s.dim, spec->dim);
        assert_true(s.axisymmetric == (spec->geometry == MESH_AXISYMMETRIC));
        assert_true(s.time == 0.1);
        assert_string_equal(s.time_unit, "s");
        assert_string_equal(s.unit, "m");
        for (int a = 0; a < spec->dim; a++) {
            assert_int_equal(s.cells[a], spec->cells[a]);
            assert_true(s.lower[a] == f.sim.mesh.lower[a] && s.upper[a] == f.sim.mesh.upper[a]);
            cells *= (size_t)spec->cells[a];
        }
        assert_int_equal(s.grid.n, spec->with_cells ? cells : 0);
        assert_int_equal(s.n_bodies, spec->with_points ? FIXTURE_BODIES : 0);
        snapshot_free(&s);
        fixture_free(&f);
        fixture_remove_folder(folder);
    }
}

static void values_are_those_of_the_sim(void **state)
{
    (void)state;
    fixture f;
    snapshot s;
    point_list list;
    double *density, *velocity, *mass, *id;
    char folder[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_make(&f, &coupled);
    fixture_write_times(&f, folder, 1);
    check_ok(f.ctx, snapshot_read(&s, f.ctx, folder, 0));
    const snapshot_field *of_density = field_of(&s.grid, "density_soft___wet");
    assert_string_equal(of_density->unit, "kg/m3");
    assert_int_equal(of_density->components, 1);
    assert_int_equal(field_of(&s.grid, "velocity_gas")->components, 3);
    check_ok(f.ctx, snapshot_values(&s, &s.grid, of_density, &density));
    check_ok(f.ctx, snapshot_values(&s, &s.grid, field_of(&s.grid, "velocity_gas"), &velocity));
    for (int at = 0; at < 24 * 20; at++) {
        assert_true(density[at] == fixture_value(C_RHO, 16, (uint64_t)at));
        assert_true(velocity[3 * at + 1] == fixture_value(C_VEL, 33, (uint64_t)at));
    }
    const snapshot_group *body = NULL;
    for (size_t b = 0; b < s.n_bodies; b++) {
        if (strcmp(s.body[b].name, "plug__1_") == 0) body = &s.body[b];
    }
    assert_non_null(body);
    check_ok(f.ctx, point_list_make(&list, &f.sim, 1));
    assert_int_equal(body->n, list.n);
    check_ok(f.ctx, snapshot_values(&s, body, field_of(body, "mass"), &mass));
    check_ok(f.ctx, snapshot_values(&s, body, field_of(body, "id"), &id)); /* whole numbers come as doubles */
    for (size_t i = 0; i < list.n; i++) {
        assert_true(id[i] == (double)list.place[i].id);
        assert_true(mass[i] == s.volume_scale * fixture_value(P_MASS, 0, list.place[i].id));
    }
    assert_null(snapshot_find(body, "no_such_field"));
    point_list_free(f.ctx, &list);
    memory_free(f.ctx, &density);
    memory_free(f.ctx, &velocity);
    memory_free(f.ctx, &mass);
    memory_free(f.ctx, &id);
    snapshot_free(&s);
    snapshot_free(&s);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

/* Changes one byte of a file. */
static void damage(context *ctx, const char *path, size_t at)
{
    size_t size;
    char *data = fixture_read(ctx, path, &size);
    assert_true(at < size);
    data[at] ^= 1;
    const file_part part = {data, size};
    check_ok(ctx, file_replace(ctx, path, &part, 1));
    memory_free(ctx, &data);
}

static void refuses(context *ctx, const char *folder, long number, const char *reason)
{
    snapshot s;
    const floe_status status = snapshot_read(&s, ctx, folder, number);
    assert_non_null(strstr(context_message(ctx), reason));
    check_fails(ctx, status, FLOE_IO);
    snapshot_free(&s);
}

static void refuses_what_is_missing_foreign_or_damaged(void **state)
{
    (void)state;
    fixture f;
    snapshot_times times;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_make(&f, &coupled);
    check_fails(f.ctx, snapshot_times_read(&times, f.ctx, folder), FLOE_IO); /* no run's folder */
    fixture_write_times(&f, folder, 3);
    check_ok(f.ctx, snapshot_times_read(&times, f.ctx, folder));
    assert_int_equal(times.n, 3);
    for (int i = 0; i < 3; i++) assert_true(times.entry[i].number == i && times.entry[i].time == 0.1 * i);
    snapshot_times_free(f.ctx, &times);
    snapshot_time last;
    check_ok(f.ctx, snapshot_last(&last, f.ctx, folder));
    assert_true(last.number == 2 && last.time == 0.2);
    refuses(f.ctx, folder, 7, "fields/000007.h5");
    fixture_path(path, folder, "fields/000001.h5");
    damage(f.ctx, path, 5000);
    refuses(f.ctx, folder, 1, "damaged");
    fixture_path(path, folder, "fields/000002.h5");
    check_ok(f.ctx, file_replace_text(f.ctx, path, "a holiday picture"));
    refuses(f.ctx, folder, 2, "not a file of floe's");
    check_ok(f.ctx, snapshot_times_read(&times, f.ctx, folder)); /* the sound one is found */
    assert_int_equal(times.n, 1);
    snapshot_times_free(f.ctx, &times);
    check_ok(f.ctx, snapshot_last(&last, f.ctx, folder));
    assert_int_equal(last.number, 0);
    fixture_path(path, folder, "fields/000000.h5");
    damage(f.ctx, path, 100);
    check_fails(f.ctx, snapshot_times_read(&times, f.ctx, folder), FLOE_IO);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void reads_all_or_nothing_when_memory_runs_out(void **state)
{
    (void)state;
    fixture f;
    snapshot s;
    snapshot_times times;
    int failed = 0;
    char folder[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_make(&f, &coupled);
    fixture_write_times(&f, folder, 2);
    const uint64_t before = memory_read_account(f.ctx).live_bytes;
    for (uint64_t n = 1; n <= 120; n++) {
        memory_inject_failure(f.ctx, n);
        floe_status status = snapshot_read(&s, f.ctx, folder, 0);
        if (status == FLOE_OK) status = snapshot_times_read(&times, f.ctx, folder);
        memory_inject_failure(f.ctx, 0);
        snapshot_free(&s);
        if (status == FLOE_OK) {
            snapshot_times_free(f.ctx, &times);
        } else {
            check_fails(f.ctx, status, FLOE_NO_MEMORY);
            failed++;
        }
        assert_int_equal(memory_read_account(f.ctx).live_bytes, before);
    }
    assert_in_range(failed, 5, 119); /* the last ones get through */
    fixture_free(&f);
    fixture_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(head_tells_the_scene),
        cmocka_unit_test(values_are_those_of_the_sim),
        cmocka_unit_test(refuses_what_is_missing_foreign_or_damaged),
        cmocka_unit_test(reads_all_or_nothing_when_memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

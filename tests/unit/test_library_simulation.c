/* Decks stepped by a program: the same bits as runs, fields where they lie, sums, callbacks, checkpoints. */
#include "check.h"

#include "floe/floe.h"

#include <hdf5.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char sod[] = FLOE_SOURCE_DIR "/inputs/sod.yaml";
static const char *const gas[] = {"coupling=ice", "domain.cell=0.02", "output.interval=0.0715"};
static const char *const points[] = {"coupling=mpm", "domain.cell=0.05", "output.interval=0.0715"};
static const char *const pieces[] = {"coupling=ice", "domain.cell=0.0125", "domain.blocks=[2]"};

typedef struct fixture {
    floe_context *floe;
    floe_deck *deck;
    floe_simulation *s;
    char folder[64];
} fixture;

static void begin_as(fixture *f, const char *const *set, size_t n, const floe_options *options)
{
    *f = (fixture){.floe = floe_create()};
    assert_int_equal(floe_init(), FLOE_OK);
    (void)snprintf(f->folder, sizeof f->folder, "/tmp/floe-test-XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    assert_int_equal(floe_load(f->floe, sod, set, n, &f->deck), FLOE_OK);
    assert_int_equal(floe_simulation_create(f->deck, options, &f->s), FLOE_OK);
}

static void end_all(fixture *f)
{
    floe_simulation_destroy(&f->s);
    floe_simulation_destroy(&f->s);
    floe_deck_destroy(&f->deck);
    floe_destroy(&f->floe);
}

static double *copy_of(floe_simulation *s, const char *name, size_t *n)
{
    assert_int_equal(floe_copy_field(s, name, NULL, 0, n), FLOE_OK);
    double *to = malloc((*n + 1) * sizeof *to);
    assert_non_null(to);
    assert_int_equal(floe_copy_field(s, name, to, *n, NULL), FLOE_OK);
    return to;
}

/* An array of a snapshot as doubles, which the caller frees, and how many there are. */
static double *read_array(hid_t group, const char *name, size_t *n)
{
    const hid_t set = H5Dopen2(group, name, H5P_DEFAULT), space = H5Dget_space(set);
    *n = (size_t)H5Sget_simple_extent_npoints(space);
    double *to = malloc((*n + 1) * sizeof *to);
    assert_non_null(to);
    assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0);
    (void)H5Sclose(space);
    (void)H5Dclose(set);
    return to;
}

enum { NAME = 160 };

static bool next_name(hid_t group, hsize_t i, char name[NAME])
{
    H5G_info_t info;
    assert_true(H5Gget_info(group, &info) >= 0);
    return i < info.nlinks &&
           H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, NAME, H5P_DEFAULT) > 0;
}

/* Cells or points of a group: its scalars have one number for each, its vectors three. */
static size_t entries_of(hid_t group)
{
    char name[NAME];
    size_t n, least = SIZE_MAX;
    for (hsize_t i = 0; next_name(group, i, name); i++) {
        free(read_array(group, name, &n));
        if (n < least) least = n;
    }
    return least;
}

/* Every array of the group, except those that are computed from others, has the simulation's bits, under its name. */
static void compare_group(fixture *f, hid_t file, const char *prefix, size_t *met)
{
    static const char *const derived[] = {"index", "id", "pressure", "von_mises"};
    const hid_t group = H5Gopen2(file, prefix, H5P_DEFAULT);
    const size_t entries = entries_of(group);
    char field[NAME];
    for (hsize_t i = 0; next_name(group, i, field); i++) {
        char name[3 * NAME];
        size_t n, m;
        bool skip = false;
        for (size_t k = 0; k < 4 && strcmp(prefix, "cells") != 0; k++) skip = skip || !strcmp(field, derived[k]);
        if (skip) continue;
        (void)snprintf(name, sizeof name, "%s/%s", prefix, field);
        double *ours = copy_of(f->s, name, &n), *theirs = read_array(group, field, &m);
        const size_t components = m / entries, width = components == 3 ? n / entries : 1;
        assert_int_equal(m, components * entries);
        assert_int_equal(n, width * entries);
        for (size_t k = 0; k < entries; k++)
            for (size_t c = 0; c < width; c++) check_close(ours[k * width + c], theirs[k * components + c], 0.0);
        ++*met;
        free(ours);
        free(theirs);
    }
    (void)H5Gclose(group);
}

/* The groups of the snapshot that the run has written last. */
static size_t compare_snapshot(fixture *f, const char *path)
{
    char body[NAME], prefix[2 * NAME];
    size_t met = 0;
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    if (H5Lexists(file, "cells", H5P_DEFAULT) > 0) compare_group(f, file, "cells", &met);
    if (H5Lexists(file, "points", H5P_DEFAULT) > 0) {
        const hid_t bodies = H5Gopen2(file, "points", H5P_DEFAULT);
        for (hsize_t b = 0; next_name(bodies, b, body); b++) {
            (void)snprintf(prefix, sizeof prefix, "points/%s", body);
            compare_group(f, file, prefix, &met);
        }
        (void)H5Gclose(bodies);
    }
    (void)H5Fclose(file);
    return met;
}

static void compare_with_run(const char *const *set, size_t n)
{
    fixture f;
    floe_deck *deck;
    floe_run *run;
    char out[96], path[128];
    begin_as(&f, set, n, NULL);
    assert_int_equal(floe_advance(f.s, 0.0715), FLOE_OK);
    check_close(floe_time(f.s), 0.0715, 0.0);
    assert_int_equal(floe_advance(f.s, floe_end_time(f.s)), FLOE_OK);
    check_true(floe_is_finished(f.s));
    (void)snprintf(out, sizeof out, "%s/out", f.folder);
    assert_int_equal(floe_load(f.floe, sod, set, n, &deck), FLOE_OK);
    assert_int_equal(floe_execute(deck, &(floe_options){.directory = out}, &run), FLOE_OK);
    check_close(floe_value(run, "steps"), (double)floe_step_count(f.s), 0.0);
    (void)snprintf(path, sizeof path, "%s/fields/000002.h5", out);
    check_true(compare_snapshot(&f, path) >= 4);
    double error;
    assert_int_equal(floe_error(f.s, "l1_density", &error), FLOE_OK);
    check_close(error, floe_value(run, "errors.l1_density"), 0.0);
    assert_int_equal(floe_error(f.s, "l1_colour", &error), FLOE_BAD_INPUT);
    floe_run_destroy(&run);
    floe_deck_destroy(&deck);
    end_all(&f);
}

static void steps_as_a_run_does(void **state)
{
    (void)state;
    compare_with_run(gas, 3);
    compare_with_run(points, 3);
}

/* The views of all blocks hold what the copy holds, and a probe what stands in its cell. */
static void shows_fields_where_they_lie(void **state)
{
    (void)state;
    fixture f;
    size_t n;
    begin_as(&f, pieces, 3, NULL);
    const floe_mesh m = floe_get_mesh(f.s);
    assert_int_equal(m.blocks, 2);
    assert_int_equal(m.dimension, 1);
    assert_int_equal(floe_advance(f.s, 0.05), FLOE_OK);
    for (int i = 0; floe_field_name(f.s, i); i++) {
        const char *name = floe_field_name(f.s, i);
        double *whole = copy_of(f.s, name, &n);
        size_t seen = 0;
        for (int b = 0; b < m.blocks; b++) {
            floe_view v;
            assert_int_equal(floe_field(f.s, name, b, &v), FLOE_OK);
            assert_int_equal(v.centring, FLOE_CELLS);
            assert_int_equal(v.components, 1);
            assert_int_equal(v.shape[1] * v.shape[2], 1);
            for (size_t k = 0; k < v.shape[0]; k++, seen++)
                check_close(v.data[0][(ptrdiff_t)k * v.stride[0]], whole[v.first[0] + k], 0.0);
        }
        assert_int_equal(seen, m.cells[0]);
        free(whole);
    }
    double *u = copy_of(f.s, "cells/velocity_gas", &n);
    for (size_t i = 0; i < n; i++) {
        const double x = m.lower[0] + ((double)i + 0.5) * m.spacing[0];
        double value[FLOE_MAX_COMPONENTS];
        check_close(floe_probe_at(f.s, &x).velocity[0], u[i], 1e-15 * fabs(u[i]));
        assert_int_equal(floe_field_at(f.s, "cells/velocity_gas", &x, value), FLOE_OK);
        check_close(value[0], u[i], 0.0);
    }
    free(u);
    const double outside = -1.0;
    double value[FLOE_MAX_COMPONENTS];
    check_true(isnan(floe_probe_at(f.s, &outside).pressure));
    assert_int_equal(floe_field_at(f.s, "cells/velocity_gas", &outside, value), FLOE_BAD_INPUT);
    floe_view v;
    assert_int_equal(floe_field(f.s, "cells/velocity", 0, &v), FLOE_BAD_INPUT);
    assert_non_null(strstr(floe_message(f.floe), "cells/velocity_gas"));
    assert_int_equal(floe_field(f.s, "cells/velocity_gas", 2, &v), FLOE_BAD_INPUT);
    end_all(&f);
}

/* Nodes carry the mass of the points, which views scale as outputs do. */
static void sums_points_and_nodes(void **state)
{
    (void)state;
    fixture f;
    floe_totals t;
    floe_balance b;
    size_t n;
    double points_mass = 0.0, nodes_mass = 0.0;
    begin_as(&f, points, 3, NULL);
    assert_int_equal(floe_sum(f.s, &t), FLOE_OK);
    const double start = t.mass;
    assert_int_equal(floe_step(f.s, 0.1), FLOE_OK);
    assert_int_equal(floe_sum(f.s, &t), FLOE_OK);
    check_close_relative(t.mass, start, 1e-15);
    check_true(t.kinetic_energy > 0.0 && t.momentum[0] > 0.0);
    for (int i = 0; floe_field_name(f.s, i); i++) {
        const char *name = floe_field_name(f.s, i);
        const bool of_points = strncmp(name, "points/", 7) == 0 && strstr(name, "/mass") && !strstr(name, "share");
        const bool of_nodes = strncmp(name, "nodes/node_mass", 15) == 0 || strncmp(name, "nodes/mass", 10) == 0;
        if (!of_points && !of_nodes) continue;
        double *mass = copy_of(f.s, name, &n);
        for (size_t k = 0; k < n; k++) *(of_points ? &points_mass : &nodes_mass) += mass[k];
        free(mass);
    }
    check_close_relative(points_mass, t.mass, 1e-12);
    check_close_relative(nodes_mass, t.mass, 1e-12);
    assert_int_equal(floe_read_balance(f.s, FLOE_MASS, &b), FLOE_OK);
    check_true(b.conserved);
    check_close_relative(b.now, t.mass, 1e-12);
    check_true(fabs(b.drift) < 1e-13);
    assert_int_equal(floe_read_balance(f.s, (floe_quantity)99, &b), FLOE_BAD_INPUT);
    end_all(&f);
}

typedef struct tally {
    int before, after, stop_after;
    double last;
} tally;

static floe_status count_before(floe_simulation *s, void *user)
{
    tally *t = user;
    t->before++;
    assert_int_equal(floe_step(s, floe_end_time(s)), FLOE_BAD_INPUT);
    return FLOE_OK;
}

static floe_status count_after(floe_simulation *s, void *user)
{
    tally *t = user;
    floe_view v;
    assert_int_equal(floe_field(s, "cells/pressure", 0, &v), FLOE_OK);
    t->last = floe_time(s);
    return ++t->after == t->stop_after ? FLOE_INTERRUPTED : FLOE_OK;
}

static void calls_back_around_steps(void **state)
{
    (void)state;
    fixture f;
    floe_run *run;
    tally t = {.stop_after = 5};
    char out[96];
    floe_options options = {.before_step = count_before, .after_step = count_after, .user = &t};
    begin_as(&f, gas, 3, &options);
    assert_int_equal(floe_advance(f.s, 0.143), FLOE_INTERRUPTED);
    assert_int_equal(t.before, 5);
    assert_int_equal(t.after, 5);
    check_close(t.last, floe_time(f.s), 0.0);
    assert_int_equal(floe_advance(f.s, 0.143), FLOE_OK);
    assert_int_equal(t.after, floe_step_count(f.s));
    assert_int_equal(floe_execute(f.deck, &options, &run), FLOE_BAD_INPUT);
    floe_simulation_destroy(&f.s);
    /* A run that a callback ends goes on from its checkpoint. */
    t = (tally){.stop_after = 7};
    (void)snprintf(out, sizeof out, "%s/out", f.folder);
    options.directory = out;
    assert_int_equal(floe_execute(f.deck, &options, &run), FLOE_INTERRUPTED);
    assert_non_null(strstr(floe_message(f.floe), "by the program"));
    assert_string_equal(floe_run_status(run), "interrupted");
    floe_run_destroy(&run);
    options.resume = true;
    assert_int_equal(floe_execute(f.deck, &options, &run), FLOE_OK);
    check_close(floe_value(run, "steps"), t.after, 0.0);
    floe_run_destroy(&run);
    end_all(&f);
}

/* Saved, changed and restored: the bits of one that never stopped. */
static void restores_what_it_saved(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        fixture f;
        size_t n, again;
        char path[96];
        const char *name = kind ? "points/left/stress_xx" : "cells/density_gas";
        begin_as(&f, kind ? points : gas, 3, NULL);
        (void)snprintf(path, sizeof path, "%s/state.h5", f.folder);
        for (int k = 0; k < 4; k++) assert_int_equal(floe_step(f.s, 0.143), FLOE_OK);
        assert_int_equal(floe_save(f.s, path), FLOE_OK);
        const double then = floe_time(f.s);
        assert_int_equal(floe_advance(f.s, 0.143), FLOE_OK);
        const long steps = floe_step_count(f.s);
        double *whole = copy_of(f.s, name, &n);
        assert_int_equal(floe_restore(f.s, "/nowhere/state.h5"), FLOE_IO);
        assert_int_equal(floe_step_count(f.s), steps);
        assert_int_equal(floe_restore(f.s, path), FLOE_OK);
        check_close(floe_time(f.s), then, 0.0);
        assert_int_equal(floe_step_count(f.s), 4);
        assert_int_equal(floe_advance(f.s, 0.143), FLOE_OK);
        assert_int_equal(floe_step_count(f.s), steps);
        double *resumed = copy_of(f.s, name, &again);
        assert_int_equal(n, again);
        assert_memory_equal(whole, resumed, n * sizeof *whole);
        free(whole);
        free(resumed);
        end_all(&f);
    }
}

static void refuses_what_it_cannot_step(void **state)
{
    (void)state;
    fixture f;
    floe_simulation *other;
    begin_as(&f, gas, 3, NULL);
    assert_int_equal(floe_simulation_create(f.deck, NULL, &other), FLOE_BAD_INPUT);
    assert_null(other);
    assert_int_equal(floe_step(f.s, 0.0), FLOE_BAD_INPUT);
    assert_int_equal(floe_step(f.s, (double)NAN), FLOE_BAD_INPUT);
    assert_int_equal(floe_advance(f.s, 0.2), FLOE_BAD_INPUT);
    assert_non_null(strstr(floe_message(f.floe), "time.end"));
    assert_int_equal(floe_step(f.s, 0.1), FLOE_OK);
    assert_string_equal(floe_message(f.floe), "");
    end_all(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_as_a_run_does),    cmocka_unit_test(shows_fields_where_they_lie),
        cmocka_unit_test(sums_points_and_nodes),  cmocka_unit_test(calls_back_around_steps),
        cmocka_unit_test(restores_what_it_saved), cmocka_unit_test(refuses_what_it_cannot_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

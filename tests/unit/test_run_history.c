/* Histories against their reference: rows written by hand whose errors are known, columns that are not there, and no memory. */
#include "deck_text_fixture.h"

#include "base/memory.h"
#include "run/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct measured {
    context *ctx;
    scene *scene;
    sim *sim;
    run_summary summary;
    char path[64];
} measured;

/* A stiff membrane of radius 0.5, a quarter of it, around gas at 1000: radius and pressure stay to 1e-7. */
static const char deck[] = "floe: 1\n"
                           "units: none\n"
                           "coupling: mpm\n"
                           "domain: {dim: 1, lower: [0], upper: [1], cell: 0.1}\n"
                           "materials:\n"
                           "  rock: {density: 1, law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}}\n"
                           "bodies:\n"
                           "  block: {material: rock, shape: {box: {lower: [0.2], upper: [0.4]}}}\n"
                           "time: {end: 1}\n"
                           "verify:\n"
                           "  reference:\n"
                           "    membrane_rest: {rest_radius: 0.5, thickness: 0.1, modulus: 1e15, gas_pressure: 1000,\n"
                           "                    gas_volume: 0.19634954084936207, share: 0.25}\n"
                           "  history: {radius: %s, pressure: strain}\n"
                           "  metrics: [hmax_radius, hend_radius, hmax_pressure, hlate_pressure]\n";

/* kinetic stands in for a radius, strain for a pressure; words in quotes may hold commas. */
static const char rows[] = "time (1),dt_limit,kinetic (1),kinetic_rock (1),strain (1)\n"
                           "0,\"a, b\",0.5,9,1000\n"
                           "0.5,\"\",0.55,9,1100\n"
                           "0.95,\"c\",0.5,9,990\n"
                           "1,\"d\",0.49,9,990\n";

static void write_rows(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    check_true(file != NULL);
    check_true(fputs(text, file) >= 0);
    check_true(fclose(file) == 0);
}

static void load(measured *m, const char *column)
{
    char text[2048];
    *m = (measured){.ctx = context_create(), .path = "/tmp/floe_history_XXXXXX"};
    (void)snprintf(text, sizeof text, deck, column);
    m->scene = fixture_scene(m->ctx, text);
    check_ok(m->ctx, sim_create(&m->sim, m->ctx, m->scene, m->scene->coupling));
    const int file = mkstemp(m->path);
    check_true(file >= 0);
    close(file);
}

static void release(measured *m)
{
    remove(m->path);
    sim_destroy(&m->sim);
    scene_destroy(&m->scene);
    check_true(memory_read_account(m->ctx).live_bytes == 0);
    context_destroy(&m->ctx);
}

static double error_of(const measured *m, const char *name)
{
    for (int i = 0; i < m->summary.n_errors; i++) {
        if (strcmp(m->summary.errors[i].name, name) == 0) return m->summary.errors[i].value;
    }
    return NAN;
}

static void rows_are_measured(void **state)
{
    (void)state;
    measured m;
    load(&m, "kinetic");
    check_ok(m.ctx, measure_history_check(m.sim));
    write_rows(m.path, rows);
    check_ok(m.ctx, measure_history(m.sim, m.path, &m.summary));
    check_true(m.summary.n_errors == 4);
    check_close(error_of(&m, "hmax_radius"), 0.1, 1e-6);
    check_close(error_of(&m, "hend_radius"), 0.02, 1e-6);
    check_close(error_of(&m, "hmax_pressure"), 0.1, 1e-6);
    check_close(error_of(&m, "hlate_pressure"), 0.01, 1e-6);
    release(&m);
}

static void a_missing_column_is_named(void **state)
{
    (void)state;
    measured m;
    load(&m, "kinetic_");
    check_fails(m.ctx, measure_history_check(m.sim), FLOE_BAD_INPUT);
    release(&m);
}

/* A history without rows has no errors to show, and times that go backwards are refused. */
static void odd_files(void **state)
{
    (void)state;
    measured m;
    load(&m, "kinetic");
    write_rows(m.path, "time (1),kinetic (1),strain (1)\n");
    check_ok(m.ctx, measure_history(m.sim, m.path, &m.summary));
    check_true(isnan(error_of(&m, "hmax_radius")));
    write_rows(m.path, "time (1),kinetic (1),strain (1)\n1,0.5,1000\n0,0.5,1000\n");
    check_fails(m.ctx, measure_history(m.sim, m.path, &m.summary), FLOE_BAD_INPUT);
    remove(m.path);
    check_fails(m.ctx, measure_history(m.sim, m.path, &m.summary), FLOE_IO);
    release(&m);
}

static void any_allocation_may_fail(void **state)
{
    (void)state;
    measured m;
    load(&m, "kinetic");
    write_rows(m.path, rows);
    floe_status status = FLOE_NO_MEMORY;
    for (uint64_t k = 1; status != FLOE_OK; k++) {
        m.summary.n_errors = 0;
        memory_inject_failure(m.ctx, k);
        status = measure_history(m.sim, m.path, &m.summary);
        memory_inject_failure(m.ctx, 0);
        check_true(k < 50);
        if (status != FLOE_OK) check_fails(m.ctx, status, FLOE_NO_MEMORY);
    }
    check_true(m.summary.n_errors == 4);
    release(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_measured),
        cmocka_unit_test(a_missing_column_is_named),
        cmocka_unit_test(odd_files),
        cmocka_unit_test(any_allocation_may_fail),
    };
    return cmocka_run_group_tests_name("errors of histories", tests, NULL, NULL);
}

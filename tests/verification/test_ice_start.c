/* The first state of cells under gravity (theory 2.4): columns at rest, also of fluids given by their density, in a wind and under gravity along no
 * axis; a charge keeps the pressure that it was given; nothing bears the weight between open sides of one pressure. */
#include "ice_fixture.h"

static const double none = (double)NAN;

static void take_steps(fixture *f, int n)
{
    for (int k = 0; k < n; ++k) {
        step_limit limit;
        check_ok(f->ctx, ice_time_step(f->ice, &limit));
        check_ok(f->ctx, fixture_try(f, limit.dt));
    }
}

/* Largest speed along an axis. */
static double fastest_along(const fixture *f, int axis)
{
    double most = 0.0;
    const block *b = &f->mesh.block[0];
    for (int j = 0; j < b->n[1]; ++j)
        for (int i = 0; i < b->n[0]; ++i)
            for (int r = 0; r < f->ice->n_materials; ++r) {
                const ptrdiff_t at = mesh_index(b, i, j, 0);
                const double u = fabs(fixture_array(f, C_VEL, r, axis)[at]);
                if (fixture_array(f, C_RHO, r, 0)[at] > 0.0 && !(u <= most)) most = u;
            }
    return most;
}

static void begin_box(fixture *f)
{
    fixture_create(f, 2, (const int[]){8, 60}, (const double[]){8.0, 60.0}, false);
    fixture_fluid(f, "ideal", 1.4, 717.5, 0.0);
}

/* 3 kg/m3 under 1 kg/m3, in bodies given by density: both keep it, and rest. */
static void by_density(void **unused)
{
    (void)unused;
    fixture f;
    begin_box(&f);
    fixture_fluid(&f, "ideal", 1.6, 300.0, 0.0);
    fixture_box(&f, 1, (const double[]){-1.0, -1.0}, (const double[]){9.0, 30.0}, 1e5, none, 3.0);
    fixture_fill(&f, 0, 1e5, none, 1.0);
    f.scene->method.exchange = 1e15;
    fixture_gravity(&f, 1);
    fixture_start(&f);
    take_steps(&f, 500);
    const block *b = &f.mesh.block[0];
    const double low = fixture_array(&f, C_RHO, 1, 0)[mesh_index(b, 4, 0, 0)],
                 high = fixture_array(&f, C_RHO, 0, 0)[mesh_index(b, 4, 59, 0)], speed = fastest_along(&f, 1) / 374.0;
    print_message("given by density: %.2e of the speed of sound after 500 steps\n", speed);
    check_true(speed <= 1e-12);
    check_close_relative(low, 3.0, 1e-12);
    check_close_relative(high, 1.0, 1e-12);
    fixture_destroy(&f);
}

/* A wind across gravity: no motion along it. */
static void in_wind(void **unused)
{
    (void)unused;
    fixture f;
    begin_box(&f);
    f.scene->mesh.periodic[0] = true;
    for (int side = 0; side < 2; ++side) f.scene->bc.side[0][side].kind = BC_PERIODIC;
    fixture_fill(&f, 0, 1e5, 300.0, none)->velocity[0] = 20.0;
    fixture_gravity(&f, 1);
    fixture_start(&f);
    take_steps(&f, 500);
    const double speed = fastest_along(&f, 1) / 347.0;
    print_message("in a wind: %.2e of the speed of sound across it after 500 steps\n", speed);
    check_true(speed <= 1e-13);
    fixture_destroy(&f);
}

static void along_no_axis(void **unused)
{
    (void)unused;
    fixture f;
    begin_box(&f);
    fixture_fill(&f, 0, 1e5, 300.0, none);
    for (int axis = 0; axis < 2; ++axis) fixture_gravity(&f, axis);
    fixture_start(&f);
    take_steps(&f, 500);
    const double speed = fmax(fastest_along(&f, 0), fastest_along(&f, 1)) / 347.0;
    print_message("gravity along no axis: %.2e of the speed of sound after 500 steps\n", speed);
    check_true(speed <= 1e-13);
    fixture_destroy(&f);
}

/* A charge of 10 bar in the middle of the box: its energy over the air's, to the weight of the column above it. */
static void charge(void **unused)
{
    (void)unused;
    fixture f;
    ice_totals sum;
    begin_box(&f);
    fixture_box(&f, 0, (const double[]){2.0, 20.0}, (const double[]){6.0, 40.0}, 1e6, 300.0, none);
    fixture_fill(&f, 0, 1e5, 300.0, none);
    fixture_gravity(&f, 1);
    fixture_start(&f);
    check_ok(f.ctx, ice_sum(f.ice, &sum));
    const double expected = (1e6 * 80.0 + 1e5 * 400.0) / 0.4, weight = sum.mass[0] * 9.81 / 8.0;
    print_message("charge: energy %.2e off\n", sum.internal[0] / expected - 1.0);
    check_close(sum.internal[0], expected, weight * 480.0 / 0.4);
    check_close_relative(sum.internal[0], expected, 6e-3);
    fixture_destroy(&f);
}

/* Between two outlets of one pressure gas falls as one, and no wave starts. */
static void between_outlets(void **unused)
{
    (void)unused;
    fixture f;
    begin_box(&f);
    for (int side = 0; side < 2; ++side) {
        f.scene->bc.side[1][side].kind = BC_OUTLET;
        f.scene->bc.side[1][side].pressure = 1e5;
        f.scene->bc.side[1][side].temperature = 300.0;
    }
    fixture_fill(&f, 0, 1e5, 300.0, none);
    fixture_gravity(&f, 1);
    fixture_start(&f);
    take_steps(&f, 20);
    const double *u = fixture_array(&f, C_VEL, 0, 1);
    const double fallen = u[mesh_index(&f.mesh.block[0], 4, 30, 0)] / (-9.81 * f.time);
    print_message("between outlets: %.12f of free fall\n", fallen);
    check_close(fallen, 1.0, 2e-12);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_density), cmocka_unit_test(in_wind),         cmocka_unit_test(along_no_axis),
        cmocka_unit_test(charge),     cmocka_unit_test(between_outlets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

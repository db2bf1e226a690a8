/* Viscosity and conduction on the cells: orders against exact solutions in one, two and three dimensions, what closes to
 * round-off, and the same bits for any blocks and threads. */
#include "ice_fixture.h"
#include "order_fixture.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* L1 of a velocity component (or, with axis -1, of the temperature) against exact values at cell centres. */
static double error_of(const fixture *f, int axis)
{
    double sum = 0.0;
    const block *b = &f->mesh.block[0];
    const eos *law = &f->ice->material[0].eos;
    const exact_quantity what = axis < 0 ? EXACT_TEMPERATURE : (exact_quantity)(EXACT_VELOCITY_X + axis);
    for (int k = 0; k < b->n[2]; ++k)
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                const int cell[3] = {i, j, k};
                double x[3] = {0.0}, T;
                for (int a = 0; a < f->mesh.dim; ++a) x[a] = mesh_centre(&f->mesh, a, cell[a]);
                law->model->temperature(law->par, 1, &fixture_array(f, C_RHO, 0, 0)[at],
                                        &fixture_array(f, C_ENERGY, 0, 0)[at], &T);
                sum += fabs((axis < 0 ? T : fixture_array(f, C_VEL, 0, axis)[at]) -
                            exact_value(&f->exact, what, x, f->time));
            }
    return sum / (b->n[0] * b->n[1] * b->n[2]);
}

static void gas_of(fixture *f, double mu, double zeta, double k)
{
    scene_material *m = &f->scene->material[fixture_fluid(f, "ideal", 1.4, 2.5, 0.0)];
    m->shear_viscosity = mu;
    m->bulk_viscosity = zeta;
    m->conductivity = k;
    fixture_fill(f, 0, 1.0, (double)NAN, 1.4);
}

/* Between plates across `axis`, the upper one hot and sliding (not in one dimension): errors of velocity and temperature. */
static void plates_error(int dim, int axis, int cells, double *velocity, double *temperature)
{
    fixture f;
    int n[3] = {4, 4, 4};
    double length[3];
    n[axis] = cells;
    for (int a = 0; a < 3; ++a) length[a] = a == axis ? 1.0 : 4.0 / cells;
    fixture_create(&f, dim, n, length, true);
    const int along = axis == 0 ? 1 : 0;
    bc_side *side = f.scene->bc.side[axis];
    f.scene->mesh.periodic[axis] = false;
    side[0].kind = side[1].kind = dim > 1 ? BC_NO_SLIP : BC_SLIP;
    side[0].temperature = 1.0;
    side[1].temperature = 1.2;
    if (dim > 1) side[1].velocity[along] = 0.8;
    gas_of(&f, 0.16, 0.0, 0.6);
    const fixture_value values[] = {{"height", 1.0, 0},
                                    {"speed", dim > 1 ? 0.8 : 0.0, 0},
                                    {"pressure", 1.0, 0},
                                    {"heat_capacity", 2.5, 0},
                                    {"viscosity", 0.16, 0},
                                    {"conductivity", 0.6, 0},
                                    {"lower_temperature", 1.0, 0},
                                    {"upper_temperature", 1.2, 0},
                                    {"axis", axis, 0}};
    fixture_exact(&f, "couette_hot", sizeof values / sizeof *values, values);
    f.scene->time.cfl_ice = 0.5;
    fixture_start(&f);
    fixture_run(&f, 10.0);
    *velocity = dim > 1 ? error_of(&f, along) : 0.0;
    *temperature = error_of(&f, -1);
    const double drift = ledger_drift(&f.ledger, LEDGER_ENERGY);
    printf("plates across axis %d, %d-D, %d cells: L1 of velocity %.3e, of temperature %.3e; energy drifts by %.1e\n",
           axis, dim, cells, *velocity, *temperature, drift);
    check_true(drift <= 1e-12);
    fixture_destroy(&f);
}

/* Measured: order 2.00 of temperature with sliding; what is linear (velocity, temperature without sliding) is exact. */
static void plates(void **state)
{
    (void)state;
    static const int cases[][2] = {{1, 0}, {2, 0}, {2, 1}, {3, 2}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
        double h[2], velocity[2], temperature[2];
        for (int k = 0; k < 2; ++k) {
            const int cells = 6 << k;
            h[k] = 1.0 / cells;
            plates_error(cases[c][0], cases[c][1], cells, &velocity[k], &temperature[k]);
        }
        if (cases[c][0] == 1)
            check_true(temperature[0] <= 1e-9 && temperature[1] <= 1e-9);
        else
            check_true(fitted_order(2, h, temperature) >= 1.9);
        check_true(velocity[0] <= 1e-9 && velocity[1] <= 1e-9);
    }
}

static double wave_error(int cells, bool thermal)
{
    fixture f;
    fixture_create(&f, 1, &cells, (const double[]){1.0}, true);
    gas_of(&f, 0.005, 0.002, 0.02);
    f.scene->method.limiter = ICE_LIMITER_NONE;
    const fixture_value values[] = {{"density", 1.4, 0},     {"pressure", 1.0, 0},         {"heat_capacity", 2.5, 0},
                                    {"viscosity", 0.005, 0}, {"bulk_viscosity", 0.002, 0}, {"conductivity", 0.02, 0},
                                    {"amplitude", 1e-5, 0},  {"thermal", thermal, 0}};
    fixture_exact(&f, "damped_wave", sizeof values / sizeof *values, values);
    fixture_start(&f);
    fixture_run(&f, 2.0);
    const double error = thermal ? error_of(&f, -1) : error_of(&f, 0);
    fixture_destroy(&f);
    return error;
}

/* Small waves: heat at constant pressure, sound. Measured: 2.0 and 2.1. */
static void waves(void **state)
{
    (void)state;
    double h[3], heat[3], sound[3];
    for (int k = 0; k < 3; ++k) {
        h[k] = 1.0 / (32 << k);
        heat[k] = wave_error(32 << k, true);
        sound[k] = wave_error(32 << k, false);
    }
    const double of_heat = fitted_order(3, h, heat), of_sound = fitted_order(3, h, sound);
    printf("waves: heat %.3e %.3e %.3e order %.3f; sound %.3e %.3e %.3e order %.3f\n", heat[0], heat[1], heat[2],
           of_heat, sound[0], sound[1], sound[2], of_sound);
    check_true(of_heat >= 1.95);
    check_true(of_sound >= 1.95);
}

static double driving(void *user, const double x[3], double t, double force[3])
{
    exact_body_force(user, x, t, force);
    return exact_heat_source(user, x, t);
}

static void manufacture(fixture *f, int dim, int cells)
{
    fixture_create(f, dim, (const int[]){cells, cells, cells}, (const double[]){1.0, 1.0, 1.0}, true);
    gas_of(f, 0.01, 0.005, 0.04);
    f->scene->method.limiter = ICE_LIMITER_NONE;
    const fixture_value values[] = {{"heat_capacity", 2.5, 0},
                                    {"viscosity", 0.01, 0},
                                    {"conductivity", 0.04, 0},
                                    {"bulk_viscosity", 0.005, 0},
                                    {"speed", 0.4, 0}};
    fixture_exact(f, "flow_mms", sizeof values / sizeof *values, values);
    f->scene->driving = driving;
    f->scene->time.cfl_ice = 0.4;
}

/* The whole step at once, at Mach 0.5. Measured: 1-D 2.0 and 2.0, 2-D 2.2 and 2.0, 3-D 2.0 and 2.1, of velocity and temperature. */
static void manufactured(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; ++dim) {
        double h[2], velocity[2], temperature[2];
        for (int k = 0; k < 2; ++k) {
            fixture f;
            const int cells = (dim == 1 ? 64 : dim == 2 ? 16 : 8) << k;
            manufacture(&f, dim, cells);
            fixture_start(&f);
            fixture_run(&f, dim == 3 ? 0.1 : 0.5);
            h[k] = 1.0 / cells;
            velocity[k] = error_of(&f, 0);
            temperature[k] = error_of(&f, -1);
            for (int q = 0; q < LEDGER_QUANTITIES; ++q)
                check_true(ledger_drift(&f.ledger, (ledger_quantity)q) <= 1e-12);
            fixture_destroy(&f);
        }
        const double of_u = fitted_order(2, h, velocity), of_T = fitted_order(2, h, temperature);
        printf("manufactured, %d-D: velocity %.3e %.3e order %.2f, temperature %.3e %.3e order %.2f\n", dim,
               velocity[0], velocity[1], of_u, temperature[0], temperature[1], of_T);
        check_true(of_u >= 1.9);
        check_true(of_T >= 1.9);
    }
}

/* A box whose walls rub, slide, heat and cool, with one gas and with two: what enters is in the ledger. Every stage is checked. */
static void closed_box(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; ++dim)
        for (int two = 0; two < 2; ++two) {
            fixture f;
            fixture_create(&f, dim, (const int[]){12, 10, 8}, (const double[]){1.0, 1.1, 0.9}, false);
            gas_of(&f, 0.05, 0.01, 0.3);
            if (two) {
                scene_material *m = &f.scene->material[fixture_fluid(&f, "ideal", 1.67, 1.0, 0.0)];
                m->shear_viscosity = 0.02;
                m->conductivity = 0.1;
                f.scene->n_bodies = 0;
                fixture_box(&f, 1, (const double[]){-1.0, -1.0, -1.0}, (const double[]){0.44, 0.5, 0.5}, 1.0, 1.5,
                            (double)NAN);
                fixture_fill(&f, 0, 1.0, 1.0, (double)NAN);
                f.scene->method.exchange = 10.0;
                f.scene->method.heat_exchange = 1.0;
            }
            for (int a = 0; a < dim; ++a)
                for (int side = 0; side < 2; ++side) f.scene->bc.side[a][side].kind = BC_NO_SLIP;
            f.scene->bc.side[0][0].temperature = 2.0;
            f.scene->bc.side[0][1].heat_flux = -0.3;
            if (dim > 1) f.scene->bc.side[1][1].velocity[0] = 0.5;
            fixture_start(&f);
            f.stages.checking = true;
            for (int k = 0; k < 20; ++k) {
                step_limit limit;
                check_ok(f.ctx, ice_time_step(f.ice, &limit));
                check_ok(f.ctx, fixture_try(&f, limit.dt));
            }
            fixture_account(&f, &f.ledger);
            printf("box with working walls, %d-D, %d gas(es): drifts", dim, two + 1);
            for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
                if (q >= LEDGER_MOMENTUM_X && q - LEDGER_MOMENTUM_X >= dim && q < LEDGER_ENERGY) continue;
                const double drift = ledger_drift(&f.ledger, (ledger_quantity)q);
                printf(" %.1e", drift);
                check_true(drift <= 1e-12);
            }
            printf(", energy through the walls %g\n", f.ledger.entry[LEDGER_ENERGY][LEDGER_BOUNDARY].value);
            fixture_destroy(&f);
        }
}

/* A gas at rest takes up what a wall gives: q A t, to round-off. */
static void heat_flux(void **state)
{
    (void)state;
    fixture f;
    fixture_create(&f, 2, (const int[]){16, 4}, (const double[]){1.0, 0.5}, false);
    gas_of(&f, 0.0, 0.0, 0.3);
    f.scene->bc.side[0][1].kind = BC_SLIP;
    f.scene->bc.side[0][1].heat_flux = 0.25;
    fixture_start(&f);
    fixture_run(&f, 0.8);
    const double gained = f.ledger.total[LEDGER_ENERGY] - f.ledger.initial[LEDGER_ENERGY];
    printf("heat flux: gained %.15g of %.15g\n", gained, 0.25 * 0.5 * 0.8);
    check_close(gained, 0.25 * 0.5 * 0.8, 1e-12);
    fixture_destroy(&f);
}

/* Flow along a pipe under a force: u = g rho (R^2 - r^2)/(4 mu), about the axis. Measured: order 2.0. */
static void pipe(void **state)
{
    (void)state;
    double h[2], error[2] = {0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
        const int cells = 6 << k;
        fixture f;
        fixture_create(&f, 2, (const int[]){cells, 4}, (const double[]){1.0, 4.0 / cells}, false);
        f.scene->mesh.geometry = MESH_AXISYMMETRIC;
        f.scene->mesh.periodic[1] = true;
        f.scene->bc.side[1][0].kind = f.scene->bc.side[1][1].kind = BC_PERIODIC;
        f.scene->bc.side[0][1].kind = BC_NO_SLIP;
        f.scene->bc.side[0][1].temperature = 1.0 / (0.4 * 2.5 * 1.4);
        gas_of(&f, 0.5, 0.0, 1.0); /* slow and cooled: density stays to 1e-5 */
        scene_load *load = &f.scene->load[f.scene->n_loads++];
        load->kind = LOAD_BODY_FORCE;
        load->body = -1;
        load->vector[1] = 0.01;
        fixture_start(&f);
        fixture_run(&f, 8.0);
        for (int i = 0; i < cells; ++i) {
            const double lo = (double)i / cells, hi = (i + 1.0) / cells, mean = 0.5 * (lo * lo + hi * hi);
            const double u = 0.01 * 1.4 / (4.0 * 0.5) * (1.0 - mean);
            error[k] += fabs(fixture_array(&f, C_VEL, 0, 1)[mesh_index(&f.mesh.block[0], i, 0, 0)] - u) / cells;
        }
        h[k] = 1.0 / cells;
        check_true(ledger_drift(&f.ledger, LEDGER_MOMENTUM_Y) <= 1e-12);
        check_true(ledger_drift(&f.ledger, LEDGER_ENERGY) <= 1e-12);
        fixture_destroy(&f);
    }
    printf("pipe: L1 %.3e %.3e order %.2f\n", error[0], error[1], fitted_order(2, h, error));
    check_true(fitted_order(2, h, error) >= 1.9);
}

/* Velocity and energy of every owned cell, in global order. */
static void copy_state(const fixture *f, double *out)
{
    for (int id = 0; id < f->mesh.n_blocks; ++id) {
        const block *b = &f->mesh.block[id];
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i)
                for (int what = 0; what < 3; ++what) {
                    const field_id field = what < 2 ? C_VEL : C_ENERGY;
                    const double *a = field_get(f->domain->fields[id], field, 0, what < 2 ? what : 0);
                    out[3 * ((b->lo[1] + j) * f->mesh.n[0] + b->lo[0] + i) + what] = a[mesh_index(b, i, j, 0)];
                }
    }
}

static void same_bits(void **state)
{
    (void)state;
    enum { CELLS = 32 };
    static double first[3 * CELLS * CELLS], other[3 * CELLS * CELLS];
    for (int variant = 0; variant < 3; ++variant) {
        fixture f;
        manufacture(&f, 2, CELLS);
        for (int a = 0; a < 2; ++a) f.scene->mesh.blocks[a] = variant == 2 ? 2 : 1;
#ifdef _OPENMP
        omp_set_num_threads(variant == 1 ? 2 : 1);
#endif
        fixture_start(&f);
        fixture_run(&f, 0.05);
        copy_state(&f, variant == 0 ? first : other);
        if (variant > 0) check_true(memcmp(first, other, sizeof first) == 0);
        fixture_destroy(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plates),     cmocka_unit_test(waves),     cmocka_unit_test(manufactured),
        cmocka_unit_test(closed_box), cmocka_unit_test(heat_flux), cmocka_unit_test(pipe),
        cmocka_unit_test(same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

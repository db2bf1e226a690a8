/* Sod's shock tube on the cells (validation B1, D1) against the exact Riemann solution. */
#include "exact_values.h"
#include "ice_fixture.h"
#include "order_fixture.h"

static const double end_time = 0.143;

/* A tube of one row of cells, or in a plane of two rows of cells that are `wide` times as wide as long. */
static void make_wide_tube(fixture *f, int cells, double wide, const fixture_value *side, double position, bc_kind ends)
{
    const int n[] = {cells, 2};
    fixture_create(f, wide > 0.0 ? 2 : 1, n, (const double[]){1.0, 2.0 * wide / cells}, false);
    f->scene->time.cfl_ice = 0.5;
    f->scene->bc.side[0][0].kind = f->scene->bc.side[0][1].kind = ends;
    const int gas = fixture_fluid(f, "ideal", 1.4, 1.0, 0.0);
    fixture_fill(f, gas, side[1].value, (double)NAN, side[0].value);
    const fixture_value values[] = {{"left_density", side[0].value, 0},
                                    {"left_pressure", side[1].value, 0},
                                    {"left_velocity", side[2].value, 0},
                                    {"right_density", side[3].value, 0},
                                    {"right_pressure", side[4].value, 0},
                                    {"right_velocity", side[5].value, 0},
                                    {"position", position, 0}};
    fixture_exact(f, "riemann", sizeof values / sizeof *values, values);
    fixture_start(f);
}

static void make_tube(fixture *f, int cells, const fixture_value *side, double position, bc_kind ends)
{
    make_wide_tube(f, cells, 0.0, side, position, ends);
}

static const fixture_value sod[6] = {{"", 1.0, 0},   {"", 1.0, 0}, {"", 0.0, 0},
                                     {"", 0.125, 0}, {"", 0.1, 0}, {"", 0.0, 0}};

/* Where density crosses the mean of the two sides of the shock, as a share of its travel. */
static double shock_error(const fixture *f)
{
    const double star = exact_scalar_value(&f->exact, "star_density_right", f->time), middle = 0.5 * (star + 0.125);
    const double exact_place = exact_scalar_value(&f->exact, "right_head", f->time);
    const double *rho = fixture_array(f, C_RHO, 0, 0);
    const block *b = &f->mesh.block[0];
    for (int i = b->n[0] - 2; i > 0; --i) {
        const ptrdiff_t at = mesh_index(b, i, 0, 0);
        if (!(rho[at] > middle)) continue;
        const double x = mesh_centre(&f->mesh, 0, i) + f->mesh.h[0] * (rho[at] - middle) / (rho[at] - rho[at + 1]);
        return (x - exact_place) / (exact_place - 0.5);
    }
    return (double)NAN;
}

/* A second-order Godunov code has 0.00454, 0.00254, 0.00136 at 100, 200, 400 cells. */
static void error_and_order(void **state)
{
    (void)state;
    double h[3], error[3], shock = 0.0;
    for (int k = 0; k < 3; ++k) {
        fixture f;
        const int cells = 100 << k;
        make_tube(&f, cells, sod, 0.5, BC_SYMMETRY);
        fixture_run(&f, end_time);
        h[k] = 1.0 / cells;
        error[k] = fixture_density_error(&f).l1;
        shock = shock_error(&f);
        const double mass = ledger_drift(&f.ledger, LEDGER_MASS), energy = ledger_drift(&f.ledger, LEDGER_ENERGY),
                     momentum = ledger_drift(&f.ledger, LEDGER_MOMENTUM_X);
        printf("sod %d cells, %ld steps: L1(rho) %.6f, shock %.4f %% of its travel, drifts %.1e %.1e %.1e\n", cells,
               f.steps, error[k], 100.0 * shock, mass, momentum, energy);
        check_true(mass <= 1e-13);
        check_true(momentum <= 1e-12);
        check_true(energy <= 1e-12);
        check_true(f.ledger.count[COUNT_ENERGY_GUARDS] == 0);
        fixture_destroy(&f);
    }
    check_true(error[1] <= 0.0026);
    check_true(fabs(shock) <= 8e-4);
    const double order = fitted_order(3, h, error);
    printf("sod order %.3f\n", order);
    check_true(order >= 0.85);
}

/* Largest density above, and least below, what is there, from the head of the fan to four cells ahead of the shock, as shares of it. Left out: eight
 * cells on either side of the contact, and the three of the shock. Ahead of the fan's foot only what exceeds the gas at rest counts. */
static void extremes(const fixture *f, double *over, double *under)
{
    const double left = exact_scalar_value(&f->exact, "star_density_left", f->time),
                 right = exact_scalar_value(&f->exact, "star_density_right", f->time),
                 foot = exact_scalar_value(&f->exact, "left_tail", f->time),
                 middle = exact_scalar_value(&f->exact, "contact", f->time),
                 shock = exact_scalar_value(&f->exact, "right_head", f->time);
    const double *rho = fixture_array(f, C_RHO, 0, 0), h = f->mesh.h[0];
    *over = *under = 0.0;
    for (int i = 0; i < f->mesh.block[0].n[0]; ++i) {
        const double x = mesh_centre(&f->mesh, 0, i), value = rho[mesh_index(&f->mesh.block[0], i, 0, 0)];
        const bool beside = fabs(x - middle) < 8.0 * h;
        const double here = x < foot ? 1.0 : x < middle ? left : right;
        if (!beside && (x < foot || x > middle) && x < shock + 4.0 * h) *over = fmax(*over, value / here - 1.0);
        if (!beside && x > foot && x < shock - 3.0 * h) *under = fmax(*under, 1.0 - value / here);
    }
}

/* Measured at 200 cells: 0.32 % above, behind the shock, and 0.31 % below, at the foot of the fan. */
static void rings_little(void **state)
{
    (void)state;
    fixture f;
    make_tube(&f, 200, sod, 0.5, BC_SYMMETRY);
    fixture_run(&f, end_time);
    double over, under;
    extremes(&f, &over, &under);
    printf("sod 200 cells: density %.3f %% above and %.3f %% below what it should be\n", 100.0 * over, 100.0 * under);
    check_true(over <= 1.5e-3);
    check_true(under <= 2e-3);
    fixture_destroy(&f);
}

/* Cells that are wider than long do not smear the shock: with cells 8 times as wide the error is that of one row to 1e-6 of it. With the
 * viscosities by V^(1/d) it was 52 % larger. */
static void wide_cells(void **state)
{
    (void)state;
    double error[2];
    for (int k = 0; k < 2; ++k) {
        fixture f;
        make_wide_tube(&f, 100, 8.0 * k, sod, 0.5, BC_SYMMETRY);
        fixture_run(&f, end_time);
        error[k] = fixture_density_error(&f).l1;
        fixture_destroy(&f);
    }
    printf("sod, cells 8 times as wide as long: L1(rho) %.6f for %.6f\n", error[1], error[0]);
    check_close_relative(error[1], error[0], 0.01);
}

/* A contact carried over 40 and 80 cells: as many cells wide on either mesh, so first order, and pressure hardly sees it.
 * Measured: L1 0.0056, 0.0028 and p off by 1.9e-3; with the plain limiter 0.0102, 0.0052 and 9e-3. */
static void contact(void **state)
{
    (void)state;
    static const fixture_value sides[6] = {{"", 1.0, 0},   {"", 1.0, 0}, {"", 1.0, 0},
                                           {"", 0.125, 0}, {"", 1.0, 0}, {"", 1.0, 0}};
    double error[2], worst = 0.0;
    for (int k = 0; k < 2; ++k) {
        fixture f;
        make_tube(&f, 100 << k, sides, 0.3, BC_FREE);
        fixture_run(&f, 0.4);
        error[k] = fixture_density_error(&f).l1;
        const double *rho = fixture_array(&f, C_RHO, 0, 0), *e = fixture_array(&f, C_ENERGY, 0, 0);
        const block *b = &f.mesh.block[0];
        for (int i = b->n[0] / 4; i < b->n[0] * 9 / 10; ++i) {
            const ptrdiff_t at = mesh_index(b, i, 0, 0);
            worst = fmax(worst, fabs(0.4 * rho[at] * e[at] - 1.0));
        }
        fixture_destroy(&f);
    }
    printf("contact: L1(rho) %.6f, %.6f, pressure off by %.2e\n", error[0], error[1], worst);
    check_true(error[0] <= 0.0065);
    check_true(error[1] <= 0.52 * error[0]);
    check_true(worst <= 1e-11);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_and_order),
        cmocka_unit_test(rings_little),
        cmocka_unit_test(wide_cells),
        cmocka_unit_test(contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

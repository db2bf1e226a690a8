/* The pressure of a cell now is what the next step's equilibrium will find: of one fluid, and of two that are mixed. */
#include "ice_fixture.h"

enum { CELLS = 40 };

/* Fluid r takes a share of the cell at a pressure that varies along the line. */
static void set_share(fixture *f, int r, int i, double theta)
{
    const eos *law = &f->ice->material[r].eos;
    const double p = 1e5 * (1.0 + 0.3 * sin(0.4 * i)), T = 300.0 + 20.0 * r;
    const ptrdiff_t at = mesh_index(&f->mesh.block[0], i, 0, 0);
    double v, dvdp;
    law->model->volume(law->par, 1, &p, &T, &v, &dvdp);
    const double rho = 1.0 / v;
    fixture_array(f, C_RHO, r, 0)[at] = theta * rho;
    if (ice_is_mixture(f->ice)) fixture_array(f, C_VOL, r, 0)[at] = v;
    fixture_array(f, C_PRESSURE, 0, 0)[at] = p;
    law->model->energy(law->par, 1, &rho, &T, &fixture_array(f, C_ENERGY, r, 0)[at]);
}

/* By how much the pressures now differ from those of the equilibrium at the same state, and the last step's from them. */
static void compare(const char *second, double *off, double *step)
{
    fixture f;
    const int cells = CELLS;
    fixture_create(&f, 1, &cells, (const double[]){1.0}, false);
    const int gas = fixture_fluid(&f, "ideal", 1.4, 717.5, 0.0);
    if (second) fixture_fluid(&f, second, 4.4, 1000.0, 6e8);
    fixture_fill(&f, gas, 1e5, 300.0, (double)NAN);
    fixture_start(&f);
    for (int i = 0; i < CELLS; ++i)
        for (int r = 0; r < f.ice->n_materials; ++r) {
            const double gas_share = second ? 0.1 + 0.2 * (i % 5) : 1.0;
            set_share(&f, r, i, r == 0 ? gas_share : 1.0 - gas_share);
        }
    fixture_run(&f, 2e-5);
    double now[CELLS];
    for (int i = 0; i < CELLS; ++i) {
        const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, 0, 0);
        now[i] = ice_pressure_now(f.ice, 0, fixture_array(&f, C_RHO, 0, 0)[at] > 0.0 ? 0 : 1, at);
    }
    check_ok(f.ctx, ice_boundary_ghosts(f.ice));
    check_ok(f.ctx, ice_equilibrium_pressure(f.ice));
    *off = *step = 0.0;
    for (int i = 0; i < CELLS; ++i) {
        const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, 0, 0);
        const double p = field_next(f.domain->fields[0], C_PRESSURE, 0, 0)[at];
        *off = fmax(*off, fabs(now[i] / p - 1.0));
        *step = fmax(*step, fabs(fixture_array(&f, C_PRESSURE, 0, 0)[at] / p - 1.0));
    }
    printf("%s: off by %.1e, the field by %.1e\n", second ? second : "alone", *off, *step);
    fixture_destroy(&f);
}

static void one_fluid(void **state)
{
    (void)state;
    double off, step;
    compare(NULL, &off, &step);
    check_true(off == 0.0);
    check_true(step > 1e-4);
}

/* A liquid of 6e8 Pa beside a gas at 1e5 Pa: round-off of its law is some 1e-12 of the pressure. */
static void two_fluids(void **state)
{
    (void)state;
    double off, step;
    compare("ideal", &off, &step);
    check_true(off <= 1e-12);
    check_true(step > 1e-4);
    compare("stiffened", &off, &step);
    check_true(off <= 1e-9);
    check_true(step > 1e-4);
}

/* Three gases at pressures of their own, all of them, two or one in a cell: once they are at one pressure, each has the temperature that its law gives its
 * volume and energy. */
static void closed_states(void **state)
{
    (void)state;
    static const double gamma[] = {1.4, 1.6, 1.2}, heat[] = {717.5, 300.0, 2000.0};
    fixture f;
    const int cells = CELLS;
    fixture_create(&f, 1, &cells, (const double[]){1.0}, false);
    for (int r = 0; r < 3; ++r) fixture_fluid(&f, "ideal", gamma[r], heat[r], 0.0);
    fixture_fill(&f, 0, 1e5, 300.0, (double)NAN);
    for (int r = 1; r < 3; ++r)
        fixture_box(&f, r, (const double[]){0.3 * r}, (const double[]){0.3 * r + 0.1}, 1e5, 300.0, (double)NAN);
    fixture_start(&f);
    for (int i = 0; i < CELLS; ++i)
        for (int r = 0; r < 3; ++r) {
            const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, 0, 0);
            const int present = 3 - i % 3;
            const double share = r < present ? 1.0 / present : 0.0;
            set_share(&f, r, i, share);
            if (share == 0.0) fixture_array(&f, C_VOL, r, 0)[at] = fixture_array(&f, C_ENERGY, r, 0)[at] = 0.0;
            fixture_array(&f, C_ENERGY, r, 0)[at] *= 1.0 + 0.2 * r; /* pressures of their own */
        }
    check_ok(f.ctx, ice_boundary_ghosts(f.ice));
    check_ok(f.ctx, ice_equilibrium_pressure(f.ice));
    for (int i = 0; i < CELLS; ++i) {
        const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, 0, 0);
        for (int r = 0; r < 3 - i % 3; ++r) {
            const eos *law = &f.ice->material[r].eos;
            const double rho = 1.0 / fixture_array(&f, C_VOL, r, 0)[at], e = fixture_array(&f, C_ENERGY, r, 0)[at];
            double T;
            law->model->temperature(law->par, 1, &rho, &e, &T);
            check_close_relative(fixture_array(&f, C_TEMP, r, 0)[at], T, 1e-13);
        }
    }
    fixture_destroy(&f);
}

/* Gases whose sound is slower than 1 m/s: of all cells the message names the one without a pressure. */
static void cell_to_blame(void **state)
{
    (void)state;
    fixture f;
    const int cells = CELLS;
    fixture_create(&f, 1, &cells, (const double[]){1.0}, false);
    const int gas = fixture_fluid(&f, "ideal", 1.4, 1.0, 0.0);
    const int other = fixture_fluid(&f, "ideal", 1.6, 1.0, 0.0);
    fixture_box(&f, other, (const double[]){0.75}, (const double[]){2.0}, 0.1, (double)NAN, 1.0);
    fixture_fill(&f, gas, 0.1, (double)NAN, 1.0);
    fixture_start(&f);
    fixture_array(&f, C_ENERGY, 0, 0)[mesh_index(&f.mesh.block[0], 23, 0, 0)] = -0.5;
    const floe_status status = fixture_try(&f, 1e-4);
    assert_non_null(strstr(context_message(f.ctx), "cell (23)"));
    assert_non_null(strstr(context_message(f.ctx), "internal energy -0.5 J/kg"));
    check_fails(f.ctx, status, FLOE_RETRY);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_fluid),
        cmocka_unit_test(two_fluids),
        cmocka_unit_test(closed_states),
        cmocka_unit_test(cell_to_blame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Mass exchange between fluids of the cells: a constant-volume reaction against a quadrature, a threshold, grains that burn in a closed
 * vessel; mass, momentum, energy and volume to round-off. */
#include "exchange_fixture.h"

#include "coupling/reaction.h"
#include "verify/reference.h"

static void react(fixture *f, int reactant, int product, const char *law, double heat, size_t n,
                  const fixture_value *values)
{
    scene_reaction *q = &f->scene->reaction[f->scene->n_reactions++];
    const reaction_model *m = reaction_find(law);
    assert_non_null(m);
    *q = (scene_reaction){.name = "reaction", .reactant = reactant, .product = product, .model = m, .heat = heat};
    check_ok(f->ctx, scene_allocate(f->scene, &q->par, m->param_size));
    param_fill_defaults(m->params, m->n_params, q->par);
    for (size_t k = 0; k < n; ++k) fixture_param(m->params, m->n_params, q->par, values[k].key, 0, values[k].value);
}

static void check_drifts(const fixture *f, double most)
{
    const double m = ledger_drift(&f->ledger, LEDGER_MASS), p = ledger_drift(&f->ledger, LEDGER_MOMENTUM_X),
                 e = ledger_drift(&f->ledger, LEDGER_ENERGY);
    printf("drifts: mass %.1e, momentum %.1e, energy %.1e\n", m, p, e);
    check_true(m <= most && p <= most && e <= most);
}

/* ---- one reaction at constant volume ---- */

static const double A = 1e8, Ta = 15000.0, T0 = 1200.0, q_over_cv = 1500.0, cv_both = 717.5;

/* dt/dxi of the share that has reacted, for the quadrature. */
static double slowness(double xi)
{
    return exp(Ta / (T0 + q_over_cv * xi)) / (A * (1.0 - xi));
}

/* Time until the share xi has reacted: Simpson's rule. */
static double time_to(double xi)
{
    enum { N = 20000 };
    double sum = slowness(0.0) + slowness(xi);
    for (int k = 1; k < N; ++k) sum += (k % 2 ? 4.0 : 2.0) * slowness(xi * k / N);
    return sum * xi / N / 3.0;
}

/* Gas that becomes another of the same laws: t = int dxi/[A (1 - xi) exp(-T_a/T)], T = T_0 + xi q/c_v. The temperature is followed within
 * a step, so that the steps do not matter: neither 40 of them nor one over the whole explosion. */
static void explosion(void **unused)
{
    (void)unused;
    for (int steps = 1; steps <= 40; steps += 39)
        for (int k = 0; k < 2; ++k) {
            const double xi = k == 0 ? 0.05 : 0.9, end = time_to(xi);
            fixture f;
            fixture_create(&f, 1, (const int[]){4}, (const double[]){1.0}, true);
            for (int r = 0; r < 2; ++r) fixture_fluid(&f, "ideal", 1.4, cv_both, 0.0);
            fixture_share(&f, 0, 1.0, 3.0, T0);
            fixture_pair(&f, 0, 1)->heat = fixture_law(&f, "locked", EXCHANGE_HEAT, 0, NULL);
            react(&f, 0, 1, "arrhenius", q_over_cv * cv_both, 2,
                  (const fixture_value[]){{"frequency", A, 0}, {"activation", Ta, 0}});
            fixture_start(&f);
            const double rho = fixture_value_of(&f, C_RHO, 0);
            fixture_steps(&f, steps, end / steps);
            const double reacted = fixture_value_of(&f, C_RHO, 1) / rho;
            printf("explosion, %d steps: %.9f reacted (%.2f)\n", steps, reacted, xi);
            check_close(reacted, xi, 3.5e-7); /* CVODE's tolerance, over a thermal runaway */
            check_drifts(&f, 1e-13);
            fixture_destroy(&f);
        }
}

/* Nothing below the temperature, not a bit; above it all but exp(-t/tau). A reaction that is 1e12 times as fast as the step leaves nothing. */
static void threshold(void **unused)
{
    (void)unused;
    const double limit[3] = {301.0, 299.0, 299.0}, tau[3] = {1e-4, 1e-4, 1e-16};
    for (int k = 0; k < 3; ++k) {
        fixture f;
        fixture_create(&f, 1, (const int[]){4}, (const double[]){1.0}, true);
        fixture_fluid(&f, "ideal", 1.4, 717.5, 0.0);
        fixture_fluid(&f, "ideal", 1.25, 1400.0, 0.0);
        fixture_share(&f, 0, 0.7, 3.0, 300.0);
        fixture_share(&f, 1, 1.0, -2.0, 300.0);
        react(&f, 0, 1, "threshold", 0.0, 2,
              (const fixture_value[]){{"temperature", limit[k], 0}, {"time", tau[k], 0}});
        f.scene->reaction[0].heat = 1e6;
        fixture_start(&f);
        const double rho = fixture_value_of(&f, C_RHO, 0);
        fixture_steps(&f, 10, 1e-5);
        const double left = fixture_value_of(&f, C_RHO, 0) / rho;
        check_close(left, k == 0 ? 1.0 : exp(-1e-4 / tau[k]), k == 0 ? 0.0 : 1.5e-9);
        check_drifts(&f, 1e-13);
        fixture_destroy(&f);
    }
}

/* The new volume is compressed with all the rest (theory 2.10): sum (m v)^L = V (1 + D), D the dilatation, to round-off. */
static void volume_is_kept(void **unused)
{
    (void)unused;
    fixture f;
    fixture_create(&f, 1, (const int[]){16}, (const double[]){1.0}, false);
    fixture_fluid(&f, "stiffened", 4.4, 1000.0, 6e8);
    fixture_fluid(&f, "ideal", 1.25, 1400.0, 0.0);
    fixture_box(&f, 0, (const double[]){0.2}, (const double[]){0.63}, 1e5, 300.0, (double)NAN);
    fixture_fill(&f, 1, 2e5, 400.0, (double)NAN);
    react(&f, 0, 1, "threshold", 2e5, 2, (const fixture_value[]){{"temperature", 250.0, 0}, {"time", 1.0, 0}});
    f.scene->method.exchange = 1e15;
    fixture_start(&f);
    for (int n = 0; n < 20; ++n) {
        fixture_steps(&f, 1, 1e-6);
        for (int i = 0; i < 16; ++i) {
            const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, 0, 0);
            double volume = 0.0;
            for (int r = 0; r < 2; ++r)
                volume += fixture_array(&f, C_RHO_L, r, 0)[at] * fixture_array(&f, C_VOLUME_L, r, 0)[at];
            const double dilatation = -fixture_array(&f, C_DP, 0, 0)[at] * fixture_array(&f, C_KAPPA_SUM, 0, 0)[at];
            check_close(volume, 1.0 + dilatation, 2e-13); /* that of the equilibrium's fractions */
        }
    }
    check_drifts(&f, 1e-12);
    fixture_destroy(&f);
}

/* ---- the closed vessel ---- */

/* Material 0: 1600 kg/m3, hardly compressible. */
static void fixture_liquid(fixture *f)
{
    scene_material *m = &f->scene->material[f->scene->n_materials++];
    snprintf(m->name, sizeof m->name, "grains");
    m->kind = MATERIAL_FLUID;
    m->eos.model = eos_find("tait");
    assert_non_null(m->eos.model);
    check_ok(f->ctx, scene_allocate(f->scene, &m->eos.par, m->eos.model->param_size));
    param_fill_defaults(m->eos.model->params, m->eos.model->n_params, m->eos.par);
    const fixture_value values[] = {{"density", 1600.0, 0}, {"bulk_modulus", 1e10, 0}, {"pressure", 1e5, 0}};
    for (size_t k = 0; k < sizeof values / sizeof *values; ++k)
        fixture_param(m->eos.model->params, m->eos.model->n_params, m->eos.par, values[k].key, 0, values[k].value);
}

/* ---- a surface that recedes ---- */

/* A block of the reactant on whole cells, by its surface: the gradients of its volume fraction, a half over h across each of its faces, in the cells
 * that have some of it. What burns in a short step is rho r_0 dt times that. */
static void surface_burns(void **unused)
{
    (void)unused;
    enum { CELLS = 8, BLOCK = 4 };
    const double h = 1.0 / CELLS, velocity = 1e-3, dt = 1e-6;
    for (int dim = 1; dim <= 2; ++dim) {
        fixture f;
        fixture_create(&f, dim, (const int[]){CELLS, CELLS}, (const double[]){1.0, 1.0}, true);
        fixture_liquid(&f);
        fixture_fluid(&f, "ideal", 1.25, 1400.0, 0.0);
        fixture_box(&f, 0, (const double[]){0.25, 0.25}, (const double[]){0.75, 0.75}, 1e5, 300.0, (double)NAN);
        fixture_fill(&f, 1, 1e5, 300.0, (double)NAN);
        react(&f, 0, 1, "burn", 0.0, 3,
              (const fixture_value[]){{"velocity", velocity, 0}, {"pressure", 1e5, 0}, {"exponent", 0.0, 0}});
        fixture_start(&f);
        double before[CELLS * CELLS], burnt = 0.0, density = 0.0;
        const int rows = dim == 1 ? 1 : CELLS;
        for (int k = 0; k < CELLS * rows; ++k) {
            before[k] = fixture_array(&f, C_RHO, 0, 0)[mesh_index(&f.mesh.block[0], k % CELLS, k / CELLS, 0)];
            density = fmax(density, before[k]);
        }
        fixture_steps(&f, 1, dt);
        for (int k = 0; k < CELLS * rows; ++k)
            burnt += before[k] - fixture_array(&f, C_RHO, 0, 0)[mesh_index(&f.mesh.block[0], k % CELLS, k / CELLS, 0)];
        const double faces = dim == 1 ? 2.0 * 0.5 : 4.0 * (BLOCK - 2) * 0.5 + 4.0 * 0.5 * sqrt(2.0);
        const double wanted = density * velocity * dt * faces / h;
        printf("%d-D: %.12g kg/m3 burnt for %.12g: %.1e\n", dim, burnt, wanted, burnt / wanted - 1.0);
        check_close_relative(burnt, wanted, 2.5e-8); /* 1.2e-8 of it has burnt by then */
        check_drifts(&f, 1e-13);
        fixture_destroy(&f);
    }
}

/* Grains of 0.2 % of the volume against the equation of the vessel: the pressure is that of the step's start, hence order one. */
static double vessel_error(int steps, double *pressure)
{
    fixture f;
    const double end = 0.008;
    fixture_create(&f, 1, (const int[]){4}, (const double[]){1.0}, true);
    fixture_liquid(&f);
    fixture_fluid(&f, "ideal", 1.25, 1400.0, 0.0);
    fixture_share(&f, 0, 0.002, 0.0, 300.0);
    fixture_share(&f, 1, 1.0, 0.0, 300.0);
    react(&f, 0, 1, "burn", 3e6, 3,
          (const fixture_value[]){{"velocity", 0.1, 0}, {"exponent", 0.8, 0}, {"specific_surface", 2000.0, 0}});
    fixture_start(&f);
    const reference_model *model = reference_find("closed_vessel");
    double par[16], value[8];
    assert_non_null(model);
    memcpy(par, model->sample, model->param_size);
    *param_find(model->params, model->n_params, par, "gas_mass") = fixture_value_of(&f, C_RHO, 1);
    reference vessel;
    check_ok(f.ctx, reference_create(f.ctx, model, par, &vessel));
    check_ok(f.ctx, reference_series(f.ctx, &vessel, 1, &end, value));
    reference_destroy(f.ctx, &vessel);
    fixture_steps(&f, steps, end / steps);
    const double gas = fixture_value_of(&f, C_RHO, 1);
    /* Of the state at the end: the gas fills what the grains leave. */
    const double p = 0.25 * gas * fixture_value_of(&f, C_ENERGY, 1) / (1.0 - fixture_value_of(&f, C_RHO, 0) / 1600.0);
    printf("vessel, %d steps: %.6f kg of gas (%.6f), %.5g Pa (%.5g)\n", steps, gas, value[1], p, value[2]);
    check_drifts(&f, 1e-13);
    *pressure = fabs(p - value[2]) / value[2];
    fixture_destroy(&f);
    return fabs(gas - value[1]) / value[1];
}

static void vessel_burns(void **unused)
{
    (void)unused;
    double pressure[3], error[3];
    for (int k = 0; k < 3; ++k) error[k] = vessel_error(100 << k, &pressure[k]);
    printf("vessel: errors of the mass %.2e %.2e %.2e, of the pressure %.2e %.2e %.2e\n", error[0], error[1], error[2],
           pressure[0], pressure[1], pressure[2]);
    check_true(log2(error[0] / error[1]) > 0.9 && log2(error[1] / error[2]) > 0.9);
    check_true(error[2] < 3e-3 && pressure[2] < 4e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(explosion),     cmocka_unit_test(threshold),    cmocka_unit_test(volume_is_kept),
        cmocka_unit_test(surface_burns), cmocka_unit_test(vessel_burns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

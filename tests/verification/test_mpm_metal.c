/* Laws of metals in motion: shocks of a Mie-Grueneisen pressure against the jump conditions, adiabatic shear of Johnson and Cook's law
 * against an integration of its own, and Taylor's test of a copper cylinder. */
#include "mpm_fixture.h"

static void set_law(scene_material *m, const char *key, double value)
{
    set_param(m->law->params, m->law->n_params, m->law_par, key, 0, value);
}

/* OFHC copper (Johnson and Cook 1983). */
static scene_material *add_copper(trial *t, const char *law, double K, double G, double rho)
{
    scene_material *m = &t->scene->material[add_solid(t, law, K, G, rho)];
    param_fill_defaults(m->law->params, m->law->n_params, m->law_par);
    set_law(m, "bulk_modulus", K);
    set_law(m, "shear_modulus", G);
    m->plastic_heat = m->stress_free_temperature = (double)NAN;
    if (strcmp(law, "johnson_cook") != 0) return m;
    set_law(m, "yield_stress", 90e6);
    set_law(m, "hardening_modulus", 292e6);
    set_law(m, "hardening_exponent", 0.31);
    set_law(m, "rate_coefficient", 0.025);
    set_law(m, "softening_exponent", 1.09);
    set_law(m, "melting_temperature", 1356.0);
    m->specific_heat = 383.0;
    return m;
}

/* ---- a block that hits a wall ---- */

static const double shock_rho = 8930.0, shock_c0 = 3940.0, shock_s = 1.489, shock_Gamma = 1.99, shock_G = 46e9;

/* The state behind an overdriven shock of a block of constant yield stress Y that stops at a wall at u: rho0 U u = sigma = p + 2/3 Y,
 * u^2/2 = e, of which J Y^2/(6 G rho0) is stored in shear; p = f(eta) + Gamma rho0 (e - e_shear), eta = u/U. By bisection. */
typedef struct jump {
    double stress, speed, ratio; /* Pa, m/s towards the block at rest, density over that before */
    double heating;              /* K */
} jump;

static double jump_residual(double eta, double u, double Y, double *stress)
{
    const double e = 0.5 * u * u - (1.0 - eta) * Y * Y / (6.0 * shock_G * shock_rho);
    const double f =
        shock_rho * shock_c0 * shock_c0 * eta * (1.0 - 0.5 * shock_Gamma * eta) / pow(1.0 - shock_s * eta, 2);
    *stress = f + shock_Gamma * shock_rho * e + 2.0 / 3.0 * Y;
    return *stress - shock_rho * u * u / eta;
}

/* Of a steady shock, sigma = rho0 U^2 eta and e = U^2 eta^2/2 within it too: what viscosity does, the integral of sigma - p - 2/3 Y, and nine
 * tenths of the plastic work are heat. */
static double heating_of(double speed, double end, double Y)
{
    enum { PARTS = 2000 };
    double heat = 0.0;
    for (int k = 0; k < PARTS; ++k) {
        const double eta = (k + 0.5) / PARTS * end, shear = fmin(2.0 / 3.0 * Y, 4.0 / 3.0 * shock_G * eta);
        const double e = 0.5 * speed * speed * eta * eta - (1.0 - eta) * 0.375 * shear * shear / (shock_G * shock_rho);
        const double f =
            shock_rho * shock_c0 * shock_c0 * eta * (1.0 - 0.5 * shock_Gamma * eta) / pow(1.0 - shock_s * eta, 2);
        const double viscous = shock_rho * speed * speed * eta - f - shock_Gamma * shock_rho * e - shear;
        heat += (viscous + (eta > 0.5 * Y / shock_G ? 0.9 * shear : 0.0)) * end / PARTS;
    }
    return heat / (shock_rho * 383.0);
}

static jump jump_of(double u, double Y)
{
    double low = 1e-6, high = 0.6, stress = 0.0;
    for (int k = 0; k < 200; ++k) {
        const double middle = 0.5 * (low + high);
        if (jump_residual(middle, u, Y, &stress) < 0.0)
            low = middle;
        else
            high = middle;
    }
    return (jump){stress, u / low, 1.0 / (1.0 - low), heating_of(u / low, low, Y)};
}

typedef struct plateau {
    double from, to, stress, ratio, T, n; /* m; sums */
    double front, sharp;                  /* m: where the stress is half, of the points about it */
    double half;
} plateau;

static void add_plateau(void *user, const fields *f, int body, size_t k)
{
    plateau *p = user;
    const double x = field_get(f, P_POS, body, 0)[k], stress = -field_get(f, P_STRESS, body, 0)[k];
    if (stress > p->half) p->front = fmax(p->front, x);
    if (x < p->from || x > p->to) return;
    p->stress += stress;
    p->ratio += 1.0 / field_get(f, P_J, body, 0)[k];
    if (field_get(f, P_TEMP, body, 0)) p->T += field_get(f, P_TEMP, body, 0)[k];
    p->n += 1.0;
}

typedef struct shock_case {
    const char *law;
    double speed, yield;
    bool warm;
} shock_case;

typedef struct shock_error {
    double stress, ratio, heating, front, energy;
} shock_error;

static shock_error shock_error_of(const shock_case *c, double h)
{
    const jump behind = jump_of(c->speed, c->yield);
    const double length = 1.0, end = 0.6 * length / behind.speed;
    trial t;
    trial_begin(&t, 1, (const double[]){1.25, 0.0, 0.0}, h);
    set_sides(&t, 0, BC_SYMMETRY, BC_FREE);
    set_method(&t, "quadratic", STRESS_USL, 1.0);
    t.scene->time.cfl_mpm = 0.4;
    scene_material *m = add_copper(&t, c->law, shock_rho * shock_c0 * shock_c0, shock_G, shock_rho);
    set_law(m, "yield_stress", c->yield);
    set_law(m, "shock_slope", shock_s);
    set_law(m, "grueneisen", shock_Gamma);
    set_law(m, "hardening_modulus", 0.0);
    if (strcmp(c->law, "johnson_cook") == 0) {
        set_law(m, "rate_coefficient", 0.0);
        set_law(m, "softening_exponent", 5.0); /* the flow stress stays */
        set_law(m, "melting_temperature", c->warm ? 1e6 : 0.0);
        m->specific_heat = c->warm ? 383.0 : (double)NAN;
    }
    m->artificial_linear = 0.3;
    m->artificial_quadratic = 1.5;
    scene_body *b = add_body(&t, 0, make_box(&t, (const double[]){0, 0, 0}, (const double[]){length, 0, 0}), 2);
    b->velocity[0] = -c->speed;
    b->temperature = 300.0;
    trial_start(&t);
    trial_run(&t, end);
    const double front = (behind.speed - c->speed) * end;
    plateau p = {.from = 0.2 * front, .to = 0.7 * front, .half = 0.5 * behind.stress};
    visit_points(&t, 0, add_plateau, &p);
    const shock_error e = {fabs(p.stress / (p.n * behind.stress) - 1.0), fabs(p.ratio / (p.n * behind.ratio) - 1.0),
                           c->warm ? fabs((p.T / p.n - 300.0) / behind.heating - 1.0) : 0.0,
                           fabs(p.front / front - 1.0), ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY)};
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_X) <= 1e-12);
    trial_end(&t);
    print_message("%s %g m/s, yield %g MPa%s, h = %g: %.2f GPa off by %.1e, density %.1e, heating of %.1f K %.1e, "
                  "front %.1e, energy %.1e\n",
                  c->law, c->speed, 1e-6 * c->yield, c->warm ? ", warm" : "", h, 1e-9 * behind.stress, e.stress,
                  e.ratio, behind.heating, e.heating, e.front, e.energy);
    return e;
}

static void test_shocks(void **state)
{
    (void)state;
    /* without strength it is the Hugoniot: p = rho0 (c0 + s u) u, U = c0 + s u */
    const jump fluid = jump_of(800.0, 0.0);
    check_close_relative(fluid.stress, shock_rho * (shock_c0 + shock_s * 800.0) * 800.0, 1e-12);
    check_close_relative(fluid.speed, shock_c0 + shock_s * 800.0, 1e-12);
    static const shock_case cases[] = {{"j2", 800.0, 1e6, false},
                                       {"j2", 1500.0, 400e6, false},
                                       {"johnson_cook", 800.0, 400e6, false},
                                       {"johnson_cook", 800.0, 400e6, true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const shock_error coarse = shock_error_of(&cases[k], 0.01), fine = shock_error_of(&cases[k], 0.005);
        /* points of a cell differ by 3 % of the stress; the front is found to half a cell, 0.5 % of its way at the finer spacing */
        check_true(fine.stress <= 6e-3 && coarse.stress <= 6e-3);     /* 0.8e-3 to 3.4e-3 */
        check_true(fine.ratio <= 1e-3 && coarse.ratio <= 1e-3);       /* 0.1e-3 to 0.5e-3 */
        check_true(fine.heating <= 1.6e-2 && coarse.heating <= 0.15); /* 0.8e-2, 7.7e-2 */
        check_true(fine.front <= 1.5e-2 && coarse.front <= 3e-2);     /* 1.0e-2, 2.0e-2 */
        check_true(fine.energy <= 1.5e-2);                            /* 7.7e-3; 2.8e-3 at a quarter of the step */
    }
}

/* ---- adiabatic flow ---- */

/* Points that move freely, x = X + t v(X) with v linear, until the waves of the ends come: L = L0 (1 + L0 t)^-1. The state by LSODA of
 * scipy (relative 1e-11), of K = 129 and G = 46 GPa. */
typedef struct flow_case {
    const char *name;
    int dim;
    bool radial;
    double rate[3], end;      /* 1/s along the axes (3: about the axis); s */
    double mean, deviator[3]; /* Pa */
    double plastic, temperature;
} flow_case;

static void set_flow(void *user, const fields *f, int body, size_t k)
{
    const flow_case *c = user;
    for (int a = 0; a < c->dim; ++a) {
        field_get(f, P_VEL, body, a)[k] = c->rate[a] * field_get(f, P_POS, body, a)[k];
        field_get(f, P_AFFINE, body, a * c->dim + a)[k] = c->rate[a];
    }
}

typedef struct flow_error {
    const flow_case *c;
    double stress, plastic, heating; /* largest, relative */
    size_t n;
} flow_error;

static void add_flow_error(void *user, const fields *f, int body, size_t k)
{
    flow_error *e = user;
    for (int a = 0; a < e->c->dim; ++a)
        if (field_get(f, P_POS, body, a)[k] > 0.45) return;
    for (int a = 0; a < (e->c->dim == 3 ? 3 : 2); ++a)
        e->stress = fmax(e->stress, fabs(field_get(f, P_STRESS, body, a)[k] - e->c->mean - e->c->deviator[a]) / 275e6);
    e->plastic = fmax(e->plastic, fabs(field_get(f, P_HISTORY_1, body, 0)[k] / e->c->plastic - 1.0));
    e->heating = fmax(e->heating, fabs((field_get(f, P_TEMP, body, 0)[k] - 300.0) / (e->c->temperature - 300.0) - 1.0));
    ++e->n;
}

static flow_error flow_error_of(const flow_case *c, double cfl)
{
    trial t;
    const double upper[3] = {1.5, 1.5, 1.5}, size[3] = {1.0, 1.0, 1.0};
    trial_begin(&t, c->dim, upper, 0.125);
    if (c->radial) t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    for (int a = 0; a < c->dim; ++a) set_sides(&t, a, BC_SYMMETRY, BC_FREE);
    set_method(&t, "quadratic", STRESS_USL, 1.0);
    snprintf(t.scene->method.transfer, sizeof t.scene->method.transfer, "apic");
    t.scene->time.cfl_mpm = cfl;
    (void)add_copper(&t, "johnson_cook", 129e9, 46e9, 8960.0);
    add_body(&t, 0, make_box(&t, (const double[]){0, 0, 0}, size), 2)->temperature = 300.0;
    trial_start(&t);
    visit_points(&t, 0, set_flow, (void *)(uintptr_t)c);
    trial_run(&t, c->end);
    flow_error e = {.c = c};
    visit_points(&t, 0, add_flow_error, &e);
    trial_end(&t);
    print_message("%s, cfl %g: stress %.1e, plastic strain %.1e, heating %.1e\n", c->name, cfl, e.stress, e.plastic,
                  e.heating);
    assert_true(e.n > 20);
    return e;
}

static void test_flow(void **state)
{
    (void)state;
    static const flow_case cases[] = {{"plane",
                                       2,
                                       false,
                                       {1e4, -1e4, 0},
                                       8e-6,
                                       -8.28253247e8,
                                       {1.57974376e8, -1.66436631e8, 0},
                                       9.05688654e-2,
                                       305.716566},
                                      {"axis",
                                       2,
                                       true,
                                       {-1e4, 2e4, -1e4},
                                       4e-6,
                                       -6.04100280e8,
                                       {-9.18383791e7, 1.83676758e8, 0},
                                       7.65255372e-2,
                                       304.751784},
                                      {"space",
                                       3,
                                       false,
                                       {-1e4, 1.6e4, -0.6e4},
                                       5e-6,
                                       -6.18098435e8,
                                       {-1.15836339e8, 1.80967370e8, -6.51310312e7},
                                       7.74821455e-2,
                                       304.800334}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const flow_error coarse = flow_error_of(&cases[k], 0.04), fine = flow_error_of(&cases[k], 0.01);
        check_true(fine.stress <= 2.4e-3 && fine.plastic <= 2.4e-5 &&
                   fine.heating <= 1.5e-3); /* 1.2e-3, 1.9e-5, 7.3e-4 */
        check_true(coarse.heating >= 2.5 * fine.heating);
    }
}

/* ---- Taylor's test ---- */

typedef struct cylinder {
    double length, face, bulge; /* m: the length, radius at the wall, radius at a fifth of the first length */
    double hottest, h;          /* K, m */
} cylinder;

static void find_shape(void *user, const fields *f, int body, size_t k)
{
    cylinder *c = user;
    const double r = field_get(f, P_POS, body, 0)[k], z = field_get(f, P_POS, body, 1)[k];
    c->length = fmax(c->length, z);
    c->face = fmax(c->face, r);
    if (fabs(z - 0.2 * 25.4e-3) < c->h) c->bulge = fmax(c->bulge, r);
    c->hottest = fmax(c->hottest, field_get(f, P_TEMP, body, 0)[k]);
}

/* Cylinder of OFHC copper, 25.4 x 7.62 mm, at 190 m/s (Johnson and Cook 1983) with their constants of torsion and tension. Finite elements of
 * our own in Python (four nodes, one point, Lagrangian, the same law by bisection, no friction) come to a length of 17.44 mm, diameters of 14.64 mm at
 * the wall and 9.47 mm at a fifth of the first length, and 576 K. (The test had 16.2, 13.5 and 10.1 mm: the constants, not the solver.) */
static void test_taylor(void **state)
{
    (void)state;
    const double h = 0.381e-3, speed = 190.0, radius = 3.81e-3, length = 25.4e-3;
    trial t;
    trial_begin(&t, 2, (const double[]){26 * h, 70 * h, 0.0}, h);
    t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    set_sides(&t, 0, BC_SYMMETRY, BC_FREE);
    set_sides(&t, 1, BC_SLIP, BC_FREE);
    set_method(&t, "quadratic", STRESS_USL, 0.99);
    (void)add_copper(&t, "johnson_cook", 129e9, 46e9, 8960.0);
    scene_body *b = add_body(&t, 0, make_box(&t, (const double[]){0, 0, 0}, (const double[]){radius, length, 0.0}), 2);
    b->velocity[1] = -speed;
    b->temperature = 300.0;
    trial_start(&t);
    trial_run(&t, 90e-6);
    cylinder c = {.h = h};
    visit_points(&t, 0, find_shape, &c);
    sim_totals totals;
    check_ok(t.ctx, sim_sum(t.sim, &totals));
    c.length += 0.25 * h; /* points stand half of theirs inside */
    c.face += 0.25 * h;
    c.bulge += 0.25 * h;
    print_message("length %.2f mm, face %.2f mm, bulge %.2f mm, hottest %.0f K, energy drift %.1e\n", 1e3 * c.length,
                  2e3 * c.face, 2e3 * c.bulge, c.hottest, ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
    trial_end(&t);
    check_close_relative(c.length, 17.435e-3, 1.2e-3);
    check_close_relative(2.0 * c.bulge, 9.467e-3, 8e-3);
    check_close_relative(2.0 * c.face, 14.643e-3, 5e-2); /* 14.22, 14.62 mm at half the spacing */
    check_close_relative(c.hottest - 300.0, 276.0, 0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shocks),
        cmocka_unit_test(test_flow),
        cmocka_unit_test(test_taylor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

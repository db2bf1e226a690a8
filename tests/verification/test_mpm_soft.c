/* Soft solids and soils in scenes: rubber balloons of Ogden's law with their limit point, creep of a rubber cylinder, a damped bar, a
 * sphere in soil under pressure, a column of sand that collapses. */
#include "thick_wall_fixture.h"

#define ABOUT_AXIS                                                                          \
    "domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [1.6, 1.6], cell: 0.1}", \
        "boundaries={r: {lower: symmetry, upper: free}, z: {lower: symmetry, upper: free}}"

/* ---- an incompressible balloon of Ogden's law: a sphere from 0.5 to 1 whose bore has gone to a ---- */

static const double balloon_mu[3] = {0.63, 1.2e-3, -0.01}, balloon_alpha[3] = {1.3, 5.0, -2.0};
#define BALLOON                                                                                                    \
    "materials.rubber.law={ogden: {bulk_modulus: 4225, mu_1: 0.63, alpha_1: 1.3, mu_2: 1.2e-3, alpha_2: 5, mu_3: " \
    "-0.01, "                                                                                                      \
    "alpha_3: -2}}"

static double balloon_growth; /* r^3 = R^3 + growth */

static double hoop_less_radial(double r)
{
    const double stretch = r / cbrt(r * r * r - balloon_growth);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
        sum += balloon_mu[k] * (pow(stretch, balloon_alpha[k]) - pow(stretch, -2.0 * balloon_alpha[k]));
    return sum;
}

/* sigma_r = - integral from r to the outside of 2 (sigma_theta - sigma_r)/r, by Simpson's rule in ln r. */
static double balloon_stress(double r, bool hoop)
{
    enum { PARTS = 400 };
    const double from = log(r), step = (log(cbrt(1.0 + balloon_growth)) - from) / PARTS;
    double sum = 0.0;
    for (int k = 0; k <= PARTS; ++k)
        sum += (k == 0 || k == PARTS ? 1.0 : k % 2 ? 4.0 : 2.0) * 2.0 * hoop_less_radial(exp(from + k * step));
    const double radial = -sum * step / 3.0;
    return hoop ? radial + hoop_less_radial(r) : radial;
}

static double balloon_pressure(double bore)
{
    balloon_growth = bore * bore * bore - 0.125;
    return -balloon_stress(bore, false);
}

/* A dead traction acts on the area at rest: p (a/A)^2 goes on growing where the pressure p falls, beyond the limit point. */
static void ogden_balloon(void **unused)
{
    (void)unused;
    double limit = 0.5;
    while (balloon_pressure(limit + 1e-3) > balloon_pressure(limit)) limit += 1e-3;
    const double highest = balloon_pressure(limit);
    const double bores[3] = {0.65, limit, 1.0}, most[3][2] = {{0.065, 0.028}, {0.22, 0.063}, {0.4, 0.1}};
    print_message("limit point: bore %.3f, pressure %.5f\n", limit, highest);
    for (int k = getenv("FLOE_EVERY") ? 0 : 2; k < 3; ++k) { /* quick: beyond the limit alone */
        const double p = balloon_pressure(bores[k]), nominal = p * 4.0 * bores[k] * bores[k];
        char pressure[80];
        double krylov;
        (void)snprintf(pressure, sizeof pressure, "loads.bore.traction.pressure=%.15g", nominal);
        const char *const set[] = {STATIC,
                                   ABOUT_AXIS,
                                   BALLOON,
                                   pressure,
                                   "time.increments=20",
                                   "bodies.cylinder.points=3",
                                   "loads.bore.traction.dead=true"};
        const stress_errors e = balance(set, sizeof set / sizeof *set, balloon_stress, &krylov);
        const double growth = e.cube / e.volume - 0.5 * (1.0 + 0.125); /* mean R^3 of the volume */
        const double bore = cbrt(0.125 + growth);
        print_message("bore %.4f for %.4f (pressure %.5f); stresses %.2e, %.2e off\n", bore, bores[k], p, e.off[0],
                      e.off[1]);
        check_true(fabs(bore / bores[k] - 1.0) <= 0.005);
        check_true(e.off[0] <= most[k][0] && e.off[1] <= most[k][1]);
    }
}

/* ---- creep ---- */

static double lame_of_bore(double r, bool hoop)
{
    return 2e-4 * 0.25 / 0.75 * (1.0 + (hoop ? 1.0 : -1.0) / (r * r));
}

/* A cylinder of rubber, K/G = 1e4, under a pressure that grows over 0.1 s and stays: stresses stay Lame's, and its area grows by the
 * creep compliance, J(t) = (1 - g exp(-t/T))/(G (1 - g)), T = tau/(1 - g), of what was put on. */
static double crept_area(const char *until, const char *increments, double drift)
{
    const char *const set[] = {"time.solver=static",
                               until,
                               increments,
                               "damping=null",
                               "verify=null",
                               "loads.bore.traction.ramp=0.1",
                               "loads.bore.traction.pressure=2e-4",
                               "materials.rubber.law={viscoelastic: {bulk_modulus: 3750, shear_modulus: 0.375, g_1: "
                               "0.6, tau_1: 0.3}}"};
    trial t;
    deck_begin(&t, "defaults/e7_cylinder", set, sizeof set / sizeof *set);
    trial_start(&t);
    stress_errors first = {.exact = lame_of_bore, .dim = 2}, e = first;
    visit_points(&t, 0, add_errors, &first);
    trial_run(&t, t.scene->time.end);
    visit_points(&t, 0, add_errors, &e);
    const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
    trial_end(&t);
    print_message("%s: stresses %.2e, %.2e off, drift %.2e\n", until, e.off[0] / e.all[0], e.off[1] / e.all[1], energy);
    check_true(energy <= drift);
    check_true(e.off[0] <= 0.035 * e.all[0] && e.off[1] <= 0.011 * e.all[1]);
    return e.square / e.volume - first.square / first.volume;
}

static double compliance_sum(double t) /* integral of J from 0 to t, times G */
{
    const double g = 0.6, T = 0.3 / (1.0 - g);
    return (t - g * T * (1.0 - exp(-t / T))) / (1.0 - g);
}

static void rubber_creeps(void **unused)
{
    (void)unused;
    const double early = crept_area("time.end=0.1", "time.increments=4", 0.0076),
                 late = crept_area("time.end=1", "time.increments=40", 0.0027);
    const double expected = (compliance_sum(1.0) - compliance_sum(0.9)) / compliance_sum(0.1);
    print_message("crept by %.5f of the first strain (%.5f)\n", late / early, expected);
    check_close_relative(late / early, expected, 4e-4); /* measured 2.1e-4 */
}

/* ---- a bar that rings down ---- */

typedef struct damped_bar {
    double speed, q, z,
        lost; /* of the mode: first velocity (m/s), displacement (m), strain of the network (m), heat over first energy */
} damped_bar;

static const double bar_density = 1000.0, bar_bulk = 2e6, bar_shear = 1.5e6, bar_share = 0.4, bar_time = 0.004;

/* q'' = -w^2 q - w1^2 z, z' = q' - z/tau, and psi' = w1^2 z q' - psi/tau of the strands, psi/tau the heat: the mode sin(pi x) of a bar of length 1 between walls, by Runge and Kutta's method. */
static void bar_rates(const double y[5], double rate[5])
{
    const double k2 = acos(-1.0) * acos(-1.0) / bar_density, shear = 4.0 / 3.0 * bar_shear;
    const double w2 = k2 * (bar_bulk + shear * (1.0 - bar_share)), w12 = k2 * shear * bar_share;
    rate[0] = y[1];
    rate[1] = -w2 * y[0] - w12 * y[2];
    rate[2] = y[1] - y[2] / bar_time;
    rate[3] = w12 * y[2] * y[1] - y[3] / bar_time; /* energy of the strands, over the mass of the mode */
    rate[4] = y[3] / bar_time;                     /* heat */
}

static damped_bar ring_down(double speed, double end)
{
    enum { STEPS = 20000 };
    const double dt = end / STEPS;
    double y[5] = {0.0, speed, 0.0, 0.0, 0.0};
    for (int n = 0; n < STEPS; ++n) {
        double r[4][5], at[5];
        for (int s = 0; s < 4; ++s) {
            const double part = s == 0 ? 0.0 : s == 3 ? dt : 0.5 * dt;
            for (int k = 0; k < 5; ++k) at[k] = y[k] + (s == 0 ? 0.0 : part * r[s - 1][k]);
            bar_rates(at, r[s]);
        }
        for (int k = 0; k < 5; ++k) y[k] += dt / 6.0 * (r[0][k] + 2.0 * r[1][k] + 2.0 * r[2][k] + r[3][k]);
    }
    return (damped_bar){speed, y[0], y[2], 2.0 * y[4] / (speed * speed)};
}

typedef struct bar_reading {
    double speed, mode, weight;
    double *start; /* m, by id */
} bar_reading;

static void start_bar(void *user, const fields *f, int body, size_t k)
{
    bar_reading *r = user;
    const double x = field_get(f, P_POS, body, 0)[k];
    r->start[(size_t)fmod(field_get(f, P_ID, body, 0)[k], 0x1p40)] = x;
    field_get(f, P_VEL, body, 0)[k] = r->speed * sin(acos(-1.0) * x);
}

static void read_bar(void *user, const fields *f, int body, size_t k)
{
    bar_reading *r = user;
    const double X = r->start[(size_t)fmod(field_get(f, P_ID, body, 0)[k], 0x1p40)], form = sin(acos(-1.0) * X);
    r->mode += form * (field_get(f, P_POS, body, 0)[k] - X);
    r->weight += form * form;
}

static void bar_rings_down(void **unused)
{
    (void)unused;
    const double speed = 1e-3, end = 0.031;
    const damped_bar expected = ring_down(speed, end);
    for (int n = 16; n <= 32; n *= 2) {
        trial t;
        trial_begin(&t, 1, (const double[]){1.0, 0.0, 0.0}, 1.0 / n);
        set_sides(&t, 0, BC_NO_SLIP, BC_NO_SLIP);
        set_method(&t, "quadratic", STRESS_USL, 1.0);
        t.scene->time.cfl_mpm = 0.4;
        const int rubber = add_solid(&t, "viscoelastic", bar_bulk, bar_shear, bar_density);
        scene_material *m = &t.scene->material[rubber];
        for (size_t k = 0; k < m->law->n_params; ++k)
            if (m->law->params[k].fallback == 0.0)
                set_param(m->law->params, m->law->n_params, m->law_par, m->law->params[k].key, 0, 0.0);
        set_param(m->law->params, m->law->n_params, m->law_par, "g_1", 0, bar_share);
        set_param(m->law->params, m->law->n_params, m->law_par, "tau_1", 0, bar_time);
        add_body(&t, rubber, make_box(&t, (const double[]){0, 0, 0}, (const double[]){1.0, 0, 0}), 2);
        trial_start(&t);
        double start[64];
        bar_reading r = {.speed = speed, .start = start};
        visit_points(&t, 0, start_bar, &r);
        sim_totals first, totals;
        check_ok(t.ctx, sim_sum(t.sim, &first));
        trial_run(&t, end);
        visit_points(&t, 0, read_bar, &r);
        check_ok(t.ctx, sim_sum(t.sim, &totals));
        const double error = fabs(r.mode / r.weight - expected.q) * acos(-1.0) * 63.0 / speed;
        const double heat = (totals.internal - first.internal) / first.kinetic - expected.lost;
        const double energy = (totals.kinetic + totals.strain + totals.internal - first.internal) / first.kinetic - 1.0;
        print_message("bar of %d cells: displacement %.2e of the amplitude off, heat %.2e of %.4f, energy %.2e\n", n,
                      error, heat, expected.lost, energy);
        const double coarse =
            n == 16 ? 4.0 : 1.0; /* of second order; velocities live half a step before: energy of first */
        check_true(error <= 0.02 * coarse && fabs(heat) <= 1.2e-3 * coarse &&
                   fabs(energy) <= 0.8e-2 * sqrt(coarse) * 2.0);
        trial_end(&t);
    }
}

/* ---- a sphere in soil: the cavity of Yu (Cavity Expansion Methods in Geomechanics (2000), section 3.2.1) in a shell from 0.5 to 1, plastic to 0.75 ---- */

static const double soil_bulk = 3000.0, soil_shear = 2000.0, soil_friction = 0.5, soil_dilation = 0.2,
                    soil_cohesion = 1.0;
#define SOIL                                                                                                          \
    "materials.rubber.law={drucker_prager: {bulk_modulus: 3000, shear_modulus: 2000, friction_angle: 0.5, cohesion: " \
    "1, dilation_angle: 0.2}}"

static const double plastic_radius = 0.75;

/* sigma_1 = alpha sigma_3 + Y where it flows: Mohr and Coulomb's, since two principal stresses are equal. */
static double passive_ratio(double angle)
{
    return (1.0 + sin(angle)) / (1.0 - sin(angle));
}

static double soil_strength(void)
{
    return 2.0 * soil_cohesion * cos(soil_friction) / (1.0 - sin(soil_friction));
}

/* Of the elastic part, sigma_r = -B (1/r^3 - 1), sigma_theta = B (1/(2 r^3) + 1). */
static double elastic_part(void)
{
    const double cube = pow(plastic_radius, -3.0);
    return soil_strength() / ((cube - 1.0) + passive_ratio(soil_friction) * (0.5 * cube + 1.0));
}

static double soil_stress(double r, bool hoop)
{
    const double B = elastic_part(), ratio = passive_ratio(soil_friction), Y = soil_strength();
    if (r >= plastic_radius) return hoop ? B * (0.5 / (r * r * r) + 1.0) : -B * (1.0 / (r * r * r) - 1.0);
    const double apex = Y / (ratio - 1.0), power = 2.0 * (ratio - 1.0) / ratio;
    const double radial = apex - (B * (pow(plastic_radius, -3.0) - 1.0) + apex) * pow(plastic_radius / r, power);
    return hoop ? (radial + Y) / ratio : radial;
}

/* Elastic strain along and across the radius. */
static double soil_strain(double r, bool hoop)
{
    const double radial = soil_stress(r, false), across = soil_stress(r, true), mean = (radial + 2.0 * across) / 3.0;
    return mean / (3.0 * soil_bulk) + ((hoop ? across : radial) - mean) / (2.0 * soil_shear);
}

/* Displacement (m): in the plastic part beta (u' - e_r) + 2 (u/r - e_theta) = 0, beta the passive ratio of the dilation angle. */
static double soil_displacement(double r)
{
    enum { PARTS = 2000 };
    const double beta = passive_ratio(soil_dilation);
    double at = plastic_radius, u = at * soil_strain(at, true);
    if (r >= at) return r * soil_strain(r, true);
    const double step = (r - at) / PARTS;
    for (int k = 0; k < PARTS; ++k) { /* midpoint rule */
        const double first = soil_strain(at, false) + 2.0 / beta * (soil_strain(at, true) - u / at);
        const double half = at + 0.5 * step, middle = u + 0.5 * step * first;
        u += step * (soil_strain(half, false) + 2.0 / beta * (soil_strain(half, true) - middle / half));
        at += step;
    }
    return u;
}

typedef struct soil_reading {
    double start[4096][2]; /* m, by id */
    double volume, off, all, farthest;
} soil_reading;

static void start_soil(void *user, const fields *f, int body, size_t k)
{
    soil_reading *r = user;
    const size_t id = (size_t)fmod(field_get(f, P_ID, body, 0)[k], 0x1p40);
    assert_true(id < 4096);
    for (int a = 0; a < 2; ++a) r->start[id][a] = field_get(f, P_POS, body, a)[k];
}

static void read_soil(void *user, const fields *f, int body, size_t k)
{
    soil_reading *r = user;
    const double *X = r->start[(size_t)fmod(field_get(f, P_ID, body, 0)[k], 0x1p40)], radius = hypot(X[0], X[1]);
    double moved = 0.0;
    for (int a = 0; a < 2; ++a) moved += X[a] / radius * (field_get(f, P_POS, body, a)[k] - X[a]);
    const double volume = field_get(f, P_VOLUME0, body, 0)[k], expected = soil_displacement(radius);
    r->off += volume * fabs(moved - expected);
    r->all += volume * fabs(expected);
    if (field_get(f, P_HISTORY_1, body, 0)[k] > 2e-5) r->farthest = fmax(r->farthest, radius);
}

static void sphere_in_soil(void **unused)
{
    (void)unused;
    static const char *const cells[2] = {"domain.cell=0.1", "domain.cell=0.05"};
    char pressure[80];
    (void)snprintf(pressure, sizeof pressure, "loads.bore.traction.pressure=%.15g", -soil_stress(0.5, false));
    for (int k = 0; k < 2; ++k) {
        const char *const set[] = {STATIC, ABOUT_AXIS, "domain.upper=[1.2, 1.2]", cells[k],
                                   SOIL,   pressure,   "time.increments=10",      "loads.bore.traction.dead=true"};
        trial t;
        soil_reading *r;
        deck_begin(&t, "defaults/e7_cylinder", set, sizeof set / sizeof *set);
        check_ok(t.ctx, memory_new(t.ctx, &r, 1, sizeof *r));
        trial_start(&t);
        visit_points(&t, 0, start_soil, r);
        trial_run(&t, 1.0);
        visit_points(&t, 0, read_soil, r);
        stress_errors e = {.exact = soil_stress, .dim = 2, .axial = true};
        visit_points(&t, 0, add_errors, &e);
        print_message("soil, %s: stresses %.2e, %.2e, displacement %.2e off, plastic to %.3f\n", cells[k],
                      e.off[0] / e.all[0], e.off[1] / e.all[1], r->off / r->all, r->farthest);
        /* twice the measured at most, of second order; the outermost plastic point is within a cell of the radius */
        const double coarse = k == 0 ? 2.7 : 1.0;
        check_true(e.off[0] <= 0.0125 * coarse * e.all[0] && e.off[1] <= 0.0036 * coarse * e.all[1]);
        check_true(r->off <= 0.00068 * (k == 0 ? 4.0 : 1.0) * r->all);
        check_true(fabs(r->farthest - plastic_radius) <= (k == 0 ? 0.05 : 0.025));
        memory_free(t.ctx, &r);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rubber_creeps),
        cmocka_unit_test(ogden_balloon),
        cmocka_unit_test(bar_rings_down),
        cmocka_unit_test(sphere_in_soil),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

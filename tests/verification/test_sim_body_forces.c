/* Body forces by formulas of place and in regions (theory 4.13): a spinning disc against its exact stress in every coupling and solver, rigid bodies, flows that
 * they drive, what they give in the ledger, and what is refused. */
#include "deck_run_fixture.h"

#include "mpm/mpm.h"

static const double pi = 3.14159265358979323846;

/* ---- a disc that spins ---- */

/* Seen from the disc: rho w^2 r, with w = 100 1/s. Beside cells of gas, or alone. */
static const char disc[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "reference_pressure: 1e5\n"
    "constants: {h: 0.05, w: 100 1/s}\n"
    "domain: {dim: 2, lower: [0, 0], upper: [1.2, 1.2], cell: h}\n"
    "boundaries: {x: {lower: symmetry, upper: slip}, y: {lower: symmetry, upper: slip}}\n"
    "materials: {steel: {density: 8000, specific_heat: 460, tension_switch: 1e5, law: {linear_elastic: {bulk_modulus: "
    "117e9, shear_modulus: 43.8e9}}}}\n"
    "bodies: {disc: {material: steel, shape: {ball: {centre: [0, 0], radius: 1}}}}\n"
    "loads: {spin: {body_force: {body: disc, acceleration: [\"w^2 * x\", \"w^2 * y\"]}}}\n"
    "time: {end: 3 ms}\n";

typedef struct disc_error {
    double radial, hoop; /* root mean square, over the exact stress of the centre */
} disc_error;

/* sigma_r = a (3 + nu) (1 - r^2), sigma_t = a (3 + nu - (1 + 3 nu) r^2), a = rho w^2 / 8; in plane strain with nu / (1 - nu) for nu. */
static disc_error disc_errors(const bench *t, bool plane_stress)
{
    const fields *f = t->sim->domain->fields[0];
    const double own = (3.0 * 117.0 - 2.0 * 43.8) / (2.0 * (3.0 * 117.0 + 43.8)),
                 nu = plane_stress ? own : own / (1.0 - own);
    const double a = 8000.0 * 1e4 / 8.0, *x = field_get(f, P_POS, 0, 0), *y = field_get(f, P_POS, 0, 1);
    const double *s[4], *volume = field_get(f, P_VOLUME0, 0, 0);
    double sum[3] = {0.0};
    for (int c = 0; c < 4; ++c) s[c] = field_get(f, P_STRESS, 0, c);
    for (size_t k = 0; k < t->sim->mpm->points[0][0].n; ++k) {
        const double r2 = x[k] * x[k] + y[k] * y[k], cc = x[k] * x[k] / r2, ss = y[k] * y[k] / r2,
                     cs = x[k] * y[k] / r2;
        const double radial = s[0][k] * cc + s[1][k] * ss + 2.0 * s[3][k] * cs - a * (3.0 + nu) * (1.0 - r2);
        const double hoop = s[0][k] * ss + s[1][k] * cc - 2.0 * s[3][k] * cs - a * (3.0 + nu - (1.0 + 3.0 * nu) * r2);
        sum[0] += volume[k];
        sum[1] += volume[k] * radial * radial;
        sum[2] += volume[k] * hoop * hoop;
    }
    const double centre = a * (3.0 + nu);
    return (disc_error){sqrt(sum[1] / sum[0]) / centre, sqrt(sum[2] / sum[0]) / centre};
}

static disc_error spin_disc(const char *name, const char *const *set, size_t n, double until, bool plane_stress)
{
    bench t;
    begin(&t, disc, set, n);
    run_until(&t, until);
    const disc_error e = disc_errors(&t, plane_stress);
    print_message("disc, %s: radial stress %.2g, hoop %.2g off\n", name, e.radial, e.hoop);
    end(&t);
    return e;
}

/* Measured, of 20 and 40 cells of radius: 1.7e-3 and 1.0e-3 (plane stress 1.7e-3, 0.9e-3), 6.1e-4 and 4.6e-4. */
static void test_disc(void **unused)
{
    (void)unused;
    const char *balance[] = {"time.solver=static", "time.end=1", "domain.stress_state=plane_stress"},
               *fine[] = {"time.solver=static", "time.end=1", "constants.h=0.025"},
               *implicit[] = {"time.solver=implicit", "time.max_step=5e-5", "damping={rate: 1.2e4}"},
               *alone[] = {"damping={rate: 1.2e4}"},
               *sharp[] = {"coupling=ice-mpm", "materials.air={eos: {ideal: {specific_heat: 717.5}}}",
                           "ambient={material: air, pressure: 1e5, temperature: 300}", "method.interface=sharp",
                           "damping={rate: 1.2e4}"},
               *smeared[] = {sharp[0], sharp[1], sharp[2], "method.interface=smeared", sharp[4]};
    const disc_error e[] = {spin_disc("static, plane stress", balance, 3, 1.0, true),
                            spin_disc("static, finer", fine, 3, 1.0, false),
                            spin_disc("implicit", implicit, 3, 3e-3, false),
                            spin_disc("explicit", alone, 1, 3e-3, false),
                            spin_disc("sharp", sharp, 5, 3e-3, false),
                            spin_disc("smeared", smeared, 5, 3e-3, false)};
    for (size_t k = 0; k < sizeof e / sizeof *e; ++k)
        check_true(e[k].radial < (k == 1 ? 1.2e-3 : 3.4e-3) && e[k].hoop < (k == 1 ? 9e-4 : 2e-3));
}

/* ---- a rigid body ---- */

static const char rigid[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "domain: {dim: 2, lower: [0, 0], upper: [2, 2], cell: 0.05}\n"
    "materials: {steel: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e7, shear_modulus: 5e6}}}}\n"
    "bodies: {b: {material: steel, shape: {box: {lower: [0.8, 0.9], upper: [1.0, 1.1]}}, motion: rigid}}\n"
    "loads: {pull: {body_force: {acceleration: [\"400 * (1 - x)\", \"100 * (1 - x)\"]}}}\n"
    "time: {end: 1, max_step: 1e-4}\n";

/* The centre swings as 1 - x = 0.1 cos(20 t); across it a_y = 100 (1 - x), which also turns a square by -50 1/s^2. */
static void test_rigid(void **unused)
{
    (void)unused;
    bench t;
    mpm_totals sum;
    double spin[3], size[3];
    begin(&t, rigid, NULL, 0);
    run_until(&t, 0.01);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    mpm_angular_momentum(t.sim->mpm, 0, spin, size);
    const double m = sum.mass[0], x = sum.moment[0][0] / m, y = sum.moment[0][1] / m, vx = sum.momentum[0][0] / m,
                 vy = sum.momentum[0][1] / m, inertia = m * 0.08 / 12.0 * (1.0 - 1.0 / 64.0),
                 now = t.sim->time - 0.5 * t.sim->mpm->dt_previous;
    const double w = (spin[2] - m * (x * vy - y * vx)) / inertia;
    print_message("rigid: v_x off by %.2g, v_y by %.2g, spin by %.2g\n", vx / (2.0 * sin(20.0 * now)) - 1.0,
                  vy / (0.1 * 100.0 / 20.0 * sin(20.0 * now)) - 1.0, w / (-50.0 * now) - 1.0);
    check_close_relative(vx, 2.0 * sin(20.0 * now), 7e-7);
    check_close_relative(vy, 0.5 * sin(20.0 * now), 7e-7);
    check_close_relative(w, -50.0 * now, 1e-12);
    check_true(fabs(ledger_drift(&t.sim->ledger, LEDGER_MOMENTUM_X)) < 1e-12);
    check_true(fabs(ledger_drift(&t.sim->ledger, LEDGER_MOMENTUM_Y)) < 1e-12);
    end(&t);
}

/* ---- flows ---- */

static const char channel[] = "floe: 1\n"
                              "units: none\n"
                              "coupling: ice\n"
                              "constants: {h: 0.0625}\n"
                              "reference_pressure: 1\n"
                              "domain: {dim: 2, lower: [0, 0], upper: [0.5, 1], cell: h}\n"
                              "boundaries: {x: periodic, y: no_slip}\n"
                              "materials: {liquid: {eos: {acoustic: {density: 1, sound_speed: 10, pressure: 1, "
                              "specific_heat: 1}}, viscosity: {shear: 0.5}}}\n"
                              "bodies: {liquid: {material: liquid, shape: {box: {lower: [0, 0], upper: [0.5, 1]}}, "
                              "temperature: 1, pressure: 1}}\n"
                              "loads: {push: {body_force: {acceleration: [\"4 * sin(pi * y)\", 0]}}}\n"
                              "time: {end: 2}\n";

/* Momentum of the channel over the exact one. */
static double flow_error(const char *coupling, const char *cell, const char *change, double exact)
{
    const char *set[] = {coupling, cell, change};
    bench t;
    sim_totals sum;
    begin(&t, channel, set, 3);
    run_until(&t, 2.0);
    check_ok(t.ctx, sim_sum(t.sim, &sum));
    const double error = sum.momentum[0] / (0.5 * exact) - 1.0;
    print_message("channel, %s, %s, %s: flow off by %.2g, energy %.1e\n", coupling, cell, change, error,
                  ledger_drift(&t.sim->ledger, LEDGER_ENERGY));
    check_true(fabs(ledger_drift(&t.sim->ledger, LEDGER_MOMENTUM_X)) < 1e-12);
    end(&t);
    return fabs(error);
}

/* u = 4 sin(pi y) / (mu pi^2); by a force of 2 in the middle half of the channel, mu u = y / 2 beside it and 1/8 + (y - 1/4) / 2 - (y - 1/4)^2 in it: 11/96 in the
 * mean. */
static void test_flows(void **unused)
{
    (void)unused;
    static const char
        all[] = "time.cfl=0.5",
        half[] =
            "loads={push: {body_force: {region: {box: {lower: [0, 0.25], upper: [0.5, 0.75]}}, acceleration: [2, 0]}}}";
    const double by_sine = 4.0 / (0.5 * pi * pi) * 2.0 / pi, by_half = 2.0 * 11.0 / 96.0;
    check_true(flow_error("coupling=ice", "constants.h=0.125", all, by_sine) < 3.8e-2);
    check_true(flow_error("coupling=ice", "constants.h=0.0625", all, by_sine) < 9.6e-3);
    check_true(flow_error("coupling=ice", "constants.h=0.0625", "method.pressure=implicit", by_sine) < 9.6e-3);
    check_true(flow_error("coupling=ice", "constants.h=0.125", half, by_half) < 4.6e-2);
    check_true(flow_error("coupling=ice", "constants.h=0.0625", half, by_half) < 1.12e-2);
    check_true(flow_error("coupling=mpm", "constants.h=0.0625", all, by_sine) < 1.1e-2);
}

/* ---- what is refused ---- */

static void refuse(const char *text, const char *const *set, size_t n, const char *words)
{
    bench t;
    deck_report report;
    check_ok(NULL, load(&t, text, set, n, &report));
    deck_report_free(&report);
    assert_int_not_equal(sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling), FLOE_OK);
    if (!strstr(context_message(t.ctx), words)) print_error("%s\n", context_message(t.ctx));
    assert_non_null(strstr(context_message(t.ctx), words));
    end(&t);
}

static void test_refusals(void **unused)
{
    (void)unused;
    const char *set[] = {"coupling=ice-mpm", "materials.air={eos: {ideal: {specific_heat: 717.5}}}",
                         "ambient={material: air, pressure: 1e5, temperature: 300}", "method.interface=sharp",
                         "loads.spin.body_force.body=null"};
    const char *still[] = {set[0], set[1], set[2], "time.solver=static"};
    refuse(disc, set, 5, "take no body force that changes with place");
    refuse(disc, still, 4, "in static balance beside cells a body force is one acceleration everywhere");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disc),
        cmocka_unit_test(test_rigid),
        cmocka_unit_test(test_flows),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

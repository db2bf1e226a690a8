/* Stress that a deck gives a body at the start: a beam under tension against its frequency, and ground at rest under its weight in every coupling and solver. */
#include "deck_run_fixture.h"

#include "mpm/mpm.h"

static const double pi = 3.14159265358979323846;

/* ---- a beam under tension ---- */

static const char beam[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "constants: {h: 0.025, S: 1e7}\n"
    "domain: {dim: 2, lower: [0, 0], upper: [1, 0.4], cell: h}\n"
    "boundaries: {x: symmetry}\n"
    "materials: {steel: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e8, shear_modulus: 5e7}}}}\n"
    "bodies: {beam: {material: steel, shape: {box: {lower: [0, 0.15], upper: [1, 0.25]}}, velocity: [0, \"0.1 * cos(pi "
    "* x)\"], "
    "stress: [S, 0, S / 2, 0, 0, 0]}}\n"
    "time: {end: 1}\n";

/* Timoshenko's beam between mirrors with half a wave of it and a tension S: (k G + S) q^2 - rho w^2 times D q^2 + k G - rho I w^2 is (k G q)^2, all per area. */
static double beam_period(double S, double rho)
{
    const double K = 1e8, G = 5e7, E = 9.0 * K * G / (3.0 * K + G), nu = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G));
    const double I = 0.01 / 12.0, D = E / (1.0 - nu * nu) * I, shear = 5.0 / 6.0 * G, q = pi;
    const double A = (shear + S) * q * q, B = D * q * q + shear, a = rho * rho * I, b = -(rho * B + rho * I * A),
                 c = A * B - shear * q * shear * q;
    return 2.0 * pi / sqrt((-b - sqrt(b * b - 4.0 * a * c)) / (2.0 * a));
}

/* From the middle, where the beam starts, to its turn and back is half a period: the momentum of its left half changes its sign twice. */
static double beam_error(const char *name, const char *const *set, size_t n, double S, double rho)
{
    bench t;
    double before = 0.0, when = 0.0, first = 0.0, period = 0.0;
    begin(&t, beam, set, n);
    while (period == 0.0 && t.sim->time < 0.1) {
        const fields *f = t.sim->domain->fields[0];
        const double *x = field_get(f, P_POS, 0, 0), *v = field_get(f, P_VEL, 0, 1), *m = field_get(f, P_MASS, 0, 0);
        double sum = 0.0;
        for (size_t k = 0; k < t.sim->mpm->points[0][0].n; ++k) sum += x[k] < 0.5 ? m[k] * v[k] : 0.0;
        if (sum * before < 0.0) {
            const double cross = when + (t.sim->time - when) * before / (before - sum);
            if (first == 0.0)
                first = cross;
            else
                period = 2.0 * (cross - first);
        }
        before = sum;
        when = t.sim->time;
        check_ok(t.ctx, sim_step(t.sim, 1.0));
    }
    const double error = period / beam_period(S, rho) - 1.0;
    print_message("beam, %s: period off by %.2g\n", name, error);
    end(&t);
    return fabs(error);
}

/* The law of the deformation gradient: a body of the density that the stress leaves, rho / J, J = 1.05 within the strain's square. */
static void test_beam(void **unused)
{
    (void)unused;
    const char *fine[] = {"constants.h=0.0125"}, *free[] = {"constants.S=0"},
               *neo[] = {"materials.steel.law={neo_hookean: {bulk_modulus: 1e8, shear_modulus: 5e7}}",
                         "constants.S=1e7"};
    check_true(beam_error("tension", NULL, 0, 1e7, 1000.0) < 8.8e-3);
    check_true(beam_error("tension, finer", fine, 1, 1e7, 1000.0) < 4.2e-3);
    check_true(beam_error("none", free, 1, 0.0, 1000.0) < 1.36e-2);
    check_true(beam_error("neo-Hookean", neo, 2, 1e7, 1000.0 / 1.05) < 5.8e-3);
}

/* ---- ground at rest ---- */

static const char ground[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "constants: {h: 0.1}\n"
    "reference_pressure: 1e5\n"
    "domain: {dim: 2, lower: [0, 0], upper: [1, 1.2], cell: h}\n"
    "boundaries: {x: symmetry, y: {lower: symmetry, upper: slip}}\n"
    "materials: {soil: {density: 2000, specific_heat: 800, tension_switch: 1e5, law: {linear_elastic: {bulk_modulus: "
    "1e7, "
    "shear_modulus: 5e6}}}}\n"
    "bodies: {soil: {material: soil, shape: {box: {lower: [0, 0], upper: [1, 1]}}, stress: [\"-0.9 * 2e4 * (1 - y)\", "
    "\"-2e4 * (1 - y)\", \"-0.9 * 2e4 * (1 - y)\", 0, 0, 0]}}\n"
    "loads: {weight: {gravity: {acceleration: [0, -10]}}}\n"
    "time: {end: 0.1}\n";

/* Largest error of a stress, over that at the foot, where it would be 0.33 / 0.67 times as large across by elasticity alone, not 0.9. */
static double ground_error(const char *name, const char *const *set, size_t n)
{
    bench t;
    double worst = 0.0;
    begin(&t, ground, set, n);
    run_until(&t, 0.1);
    const fields *f = t.sim->domain->fields[0];
    const double *y = field_get(f, P_POS, 0, 1), *across = field_get(f, P_STRESS, 0, 0),
                 *down = field_get(f, P_STRESS, 0, 1);
    for (size_t k = 0; k < t.sim->mpm->points[0][0].n; ++k) {
        worst = fmax(worst, fabs(across[k] / 2e4 + 0.9 * (1.0 - y[k])));
        worst = fmax(worst, fabs(down[k] / 2e4 + (1.0 - y[k])));
    }
    print_message("ground, %s: stress off by %.2g\n", name, worst);
    end(&t);
    return worst;
}

static void test_ground(void **unused)
{
    (void)unused;
    const char *fine[] = {"constants.h=0.05"}, *balance[] = {"time.solver=static"},
               *implicit[] = {"time.solver=implicit", "time.increments=20"},
               *neo[] = {"materials.soil.law={neo_hookean: {bulk_modulus: 1e7, shear_modulus: 5e6}}"},
               *sharp[] = {"coupling=ice-mpm", "materials.air={eos: {ideal: {specific_heat: 717.5}}}",
                           "ambient={material: air, pressure: 1e5, temperature: 300}", "method.interface=sharp"},
               *smeared[] = {sharp[0], sharp[1], sharp[2], "method.interface=smeared"};
    check_true(ground_error("explicit", NULL, 0) < 1.9e-2);
    check_true(ground_error("finer", fine, 1) < 9.8e-3);
    check_true(ground_error("static", balance, 1) < 1.9e-2);
    check_true(ground_error("implicit", implicit, 2) < 1.9e-2);
    check_true(ground_error("neo-Hookean", neo, 1) < 1.9e-2);
    check_true(ground_error("sharp", sharp, 4) < 1.9e-2);
    check_true(ground_error("smeared", smeared, 4) < 7.2e-2);
}

/* ---- a bar in two clamps ---- */

static const char clamped[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "domain: {dim: 1, lower: 0, upper: 1, cell: 0.05}\n"
    "materials: {steel: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e8, shear_modulus: 5e7}}}}\n"
    "bodies: {bar: {material: steel, shape: {box: {lower: 0.1, upper: 0.9}}, stress: [1e7, 2e6, 2e6, 0, 0, 0]}}\n"
    "supports: {lower: {region: {box: {lower: 0, upper: 0.23}}}, upper: {region: {box: {lower: 0.78, upper: 1}}}}\n"
    "time: {end: 0.02}\n";

/* Points in the clamps have no stress, and laws of the deformation gradient no strain: it would bring the stress back, which acts beyond the clamps. Returns the
 * kinetic energy over that of the stress. */
static double clamped_motion(const char *name, const char *const *set, size_t n)
{
    bench t;
    mpm_totals sum;
    double most = 0.0;
    begin(&t, clamped, set, n);
    while (t.sim->time < 0.02) {
        check_ok(t.ctx, sim_step(t.sim, 0.02));
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
        most = fmax(most, sum.kinetic[0] / sum.strain[0]);
    }
    print_message("clamped bar, %s: energy of motion %.2g of the strain's\n", name, most);
    end(&t);
    return most;
}

static void test_clamped(void **unused)
{
    (void)unused;
    const char *neo[] = {"materials.steel.law={neo_hookean: {bulk_modulus: 1e8, shear_modulus: 5e7}}",
                         "method.basis=gimp"};
    const char *mirror[] = {"domain={dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.05}",
                            "boundaries={y: {lower: symmetry}}",
                            "bodies.bar.shape={box: {lower: [0.1, 0], upper: [0.9, 0.3]}}",
                            "bodies.bar.stress=[1e6, 0, 0, 0, 0, 0]",
                            "supports.lower.region={box: {lower: [0, 0], upper: [0.25, 1]}}",
                            "supports.upper.region={box: {lower: [0.75, 0], upper: [1, 1]}}"};
    check_true(clamped_motion("linear, at a mirror", mirror, 6) < 1e-18);
    check_true(clamped_motion("linear", NULL, 0) < 9.8e-6);
    check_true(clamped_motion("neo-Hookean", neo, 1) < 1e-5);
    check_true(clamped_motion("neo-Hookean, gimp", neo, 2) < 1e-18);
}

/* A law that has no strain with the stress says so, and a rigid body has none. */
static void test_refusals(void **unused)
{
    (void)unused;
    static const char *const set[] = {"bodies.soil.motion=rigid",
                                      "materials.soil.law={neo_hookean: {bulk_modulus: 1e7, shear_modulus: 5e6}}"},
                             *const words[] = {"its stress stays zero", "stress: it starts from stresses up to"};
    for (int k = 0; k < 2; ++k) {
        const char *change[] = {set[k], k == 1 ? "bodies.soil.stress=[-1e9, -1e9, 3e9, 0, 0, 0]" : "constants.h=0.1"};
        bench t;
        deck_report report;
        check_ok(NULL, load(&t, ground, change, 2, &report));
        deck_report_free(&report);
        floe_status status = sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling);
        assert_int_not_equal(status, FLOE_OK);
        if (!strstr(context_message(t.ctx), words[k])) print_error("%s\n", context_message(t.ctx));
        assert_non_null(strstr(context_message(t.ctx), words[k]));
        end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_beam),
        cmocka_unit_test(test_ground),
        cmocka_unit_test(test_clamped),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Loads that follow surfaces which stretch and turn (theory 4.13): a soft cylinder blown up, by gas and by a load; a free block pressed from all sides; a
 * cantilever bent far by a force that keeps its direction; a bar in torsion. References: the radial balance at large strain (Green and Zerna); equilibrium; the elastica
 * (Mattiasson 1981, International Journal for Numerical Methods in Engineering 17, 145); Saint-Venant's torsion of a square. */
#include "deck_run_fixture.h"

#include "grid/ledger.h"
#include "sim/tracer.h"
#include "verify/exact.h"

#include <stdlib.h>

static double bore_displacement(bench *t)
{
    const exact_model *model = exact_find(t->scene->verify.exact);
    void *prepared = calloc(1, model->prepared_size);
    check_ok(t->ctx, model->prepare(t->ctx, t->scene->verify.exact_par, 2, prepared));
    const double out = model->scalar(t->scene->verify.exact_par, prepared, 0, 1.0);
    free(prepared);
    return out;
}

static double moved(bench *t, int axis)
{
    tracer_value value[SCENE_MAX_TRACERS];
    tracers_read(t->sim, value);
    return value[0].displacement[axis];
}

/* ---- a bore that opens by a third ---- */

#define CYLINDER                                                                                                     \
    "floe: 1\ntitle: rubber cylinder blown up\ncoupling: mpm\nreference_pressure: 1 bar\n"                           \
    "domain: {dim: 2, lower: [0, 0], upper: [1.5, 1.5], cell: 0.1}\n"                                                \
    "boundaries: {x: {lower: symmetry, upper: free}, y: {lower: symmetry, upper: free}}\n"                           \
    "materials:\n"                                                                                                   \
    "  rubber: {density: 1000, law: {neo_hookean: {bulk_modulus: 2 MPa, shear_modulus: 1 MPa}}}\n"                   \
    "  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5 J/kg/K}}}\n"                                             \
    "time: {end: 1 s, solver: static, increments: 4}\n"                                                              \
    "output: {interval: 1 s, tracers: {bore: {body: cylinder, position: [0.5, 0]}}}\n"                               \
    "verify:\n"                                                                                                      \
    "  exact: {soft_cylinder: {inner_radius: 0.5, outer_radius: 1.0, inner_pressure: 0.3 MPa, bulk_modulus: 2 MPa, " \
    "shear_modulus: 1 MPa}}\n"                                                                                       \
    "  body: cylinder\n  pressure: 0.3 MPa\n  metrics: [l1_sigma_theta]\n"

#define SHELL "  cylinder: {material: rubber, points: 3, shape: {annulus: {inner_radius: 0.5, outer_radius: 1.0}}}\n"

/* The gas, on points or on cells, has the pressure that the load has. */
static void test_cylinder(void **unused)
{
    (void)unused;
    static const char *const name[4] = {"gas", "load", "dead load", "gas on cells"};
    static const char *const deck[4] = {
        CYLINDER "bodies:\n" SHELL
                 "  gas: {material: air, pressure: 1 bar, temperature: 300 K, shape: {ball: {radius: 0.5}}}\n"
                 "loads: {fill: {pressurise: {material: air, target: 0.3 MPa, ramp: 1 s, hold: true}}}\n",
        CYLINDER
        "bodies:\n" SHELL
        "loads: {fill: {traction: {body: cylinder, surface: {ball: {radius: 0.5}}, pressure: 0.3 MPa, ramp: 1 s}}}\n",
        CYLINDER "bodies:\n" SHELL "loads: {fill: {traction: {body: cylinder, surface: {ball: {radius: 0.5}}, "
                 "pressure: 0.3 MPa, ramp: 1 s, dead: true}}}\n",
        CYLINDER "bodies:\n" SHELL
                 "  gas: {material: air, pressure: 1 bar, temperature: 300 K, shape: {ball: {radius: 0.5}}}\n"
                 "ambient: {material: air, pressure: 1 bar, temperature: 300 K}\n"
                 "loads: {fill: {pressurise: {material: air, region: {ball: {radius: 0.3}}, target: 0.3 MPa, ramp: 1 "
                 "s, hold: true}}}\n"};
    static const char *const cells[4] = {"coupling=ice-mpm", "materials.rubber.specific_heat=1800",
                                         "boundaries.x.upper={outlet: {pressure: 1 bar, temperature: 300 K}}",
                                         "boundaries.y.upper={outlet: {pressure: 1 bar, temperature: 300 K}}"};
    static const char *const dead[1] = {"verify.exact.soft_cylinder.dead=1"};
    for (size_t k = 0; k < 4; ++k) {
        bench t;
        begin(&t, deck[k], k == 3 ? cells : dead, k == 3 ? 4 : k == 2 ? 1 : 0);
        const double opened = bore_displacement(&t);
        run_until(&t, 1.0);
        const double ratio = moved(&t, 0) / opened;
        print_message("%s: bore opens by %.5f m, %.4f of the exact solution\n", name[k], opened, ratio);
        check_close(ratio, 1.0, 0.004);
        end(&t);
    }
}

/* ---- a block that spins freely, pressed from all sides ---- */

/* A closed surface under one pressure has neither force nor moment, whatever it has become. */
static void test_pressed_block(void **unused)
{
    (void)unused;
    static const char text[] =
        "floe: 1\ntitle: block pressed from all sides\ncoupling: mpm\nboundaries: free\n"
        "domain: {dim: 3, lower: [-0.5, -0.5, -0.5], upper: [0.5, 0.5, 0.5], cell: 0.1}\n"
        "materials: {rubber: {density: 1000, law: {neo_hookean: {bulk_modulus: 2 MPa, shear_modulus: 1 MPa}}}}\n"
        "bodies: {block: {material: rubber, velocity: [-10 * y, 10 * x, 0],\n"
        "                 shape: {box: {lower: [-0.33, -0.23, -0.17], upper: [0.31, 0.24, 0.16]}}}}\n"
        "loads: {press: {traction: {body: block, pressure: 50 kPa,\n"
        "        surface: {box: {lower: [-0.33, -0.23, -0.17], upper: [0.31, 0.24, 0.16]}}}}}\n"
        "time: {end: 20 ms}\noutput: {interval: 20 ms}\n";
    bench t;
    begin(&t, text, NULL, 0);
    sim_totals first, last;
    check_ok(t.ctx, sim_sum(t.sim, &first));
    sim_sum_moments(t.sim, &first);
    run_until(&t, 0.02);
    check_ok(t.ctx, sim_sum(t.sim, &last));
    sim_sum_moments(t.sim, &last);
    double force = 0.0, turned = 0.0;
    for (int a = 0; a < 3; ++a) {
        force = fmax(force, fabs(last.momentum[a] - first.momentum[a]));
        turned = fmax(turned, fabs(last.moment[a] - first.moment[a]));
    }
    print_message("impulse %.1e N s of %.0f on a side, moment %.1e of %.2f N m s\n", force, 5e4 * 0.47 * 0.33 * 0.02,
                  turned, last.moment[2]);
    check_true(force <= 3e-8);                         /* some 1e-14 N s where it does not spin */
    check_true(turned <= 1e-4 * fabs(last.moment[2])); /* points lose as much of their spin without a load */
    end(&t);
}

/* ---- a force per area that keeps its direction ---- */

/* P l^2/(E I) = 2; the depth is a tenth of the length, which adds P/(5/6 G A) of shear. */
static void test_elastica(void **unused)
{
    (void)unused;
    static const char text[] =
        "floe: 1\ntitle: cantilever bent far\ncoupling: mpm\nboundaries: free\n"
        "domain: {dim: 2, lower: [-0.2, -1], upper: [1.4, 0.4], cell: 0.05}\n"
        "materials: {rubber: {density: 1000, law: {st_venant_kirchhoff: {young_modulus: 1 MPa, poisson_ratio: 0}}}}\n"
        "bodies: {beam: {material: rubber, shape: {box: {lower: [-0.15, -0.05], upper: [1, 0.05]}}}}\n"
        "supports: {wall: {region: {box: {lower: [-9, -9], upper: [0, 9]}}}}\n"
        "loads: {tip: {traction: {body: beam, surface: {box: {lower: [-9, -9], upper: [1, 9]}}, vector: [0, -5000 Pa / "
        "3]}}}\n"
        "time: {end: 1 s, solver: static, increments: 10}\n"
        "output: {interval: 1 s, tracers: {tip: {body: beam, position: [1, 0]}}}\n";
    const double shear = 5000.0 / 3.0 / (5.0 / 6.0 * 0.5e6);
    bench t;
    begin(&t, text, NULL, 0);
    run_until(&t, 1.0);
    print_message("elastica: tip down by %.4f m for %.4f, back by %.4f for %.4f\n", -moved(&t, 1), 0.49346 + shear,
                  -moved(&t, 0), 0.16064);
    check_close_relative(-moved(&t, 1), 0.49346 + shear, 0.01);
    check_close_relative(-moved(&t, 0), 0.16064, 0.06);
    end(&t);
}

/* Rate of twist T/(0.1406 G a^4) of a square of side a, four cells wide, under (0, -c z, c y), T = c a^4/6. */
static void test_torsion(void **unused)
{
    (void)unused;
    static const char text[] =
        "floe: 1\ntitle: torsion of a square bar\ncoupling: mpm\nboundaries: free\n"
        "domain: {dim: 3, lower: [-0.2, -0.25, -0.25], upper: [0.8, 0.25, 0.25], cell: 0.05}\n"
        "materials: {rubber: {density: 1000, law: {linear_elastic: {young_modulus: 1 MPa, poisson_ratio: 0.3}}}}\n"
        "bodies: {bar: {material: rubber, shape: {box: {lower: [-0.15, -0.1, -0.1], upper: [0.6, 0.1, 0.1]}}}}\n"
        "supports: {wall: {region: {box: {lower: [-9, -9, -9], upper: [0, 9, 9]}}}}\n"
        "loads: {twist: {traction: {body: bar, surface: {box: {lower: [-9, -9, -9], upper: [0.6, 9, 9]}},\n"
        "        vector: [0, -1 kPa/m * z, 1 kPa/m * y]}}}\n"
        "time: {end: 1 s, solver: static, increments: 1}\n"
        "output: {interval: 1 s, tracers: {far: {body: bar, position: [0.5, 0.1, 0]}, near: {body: bar, position: "
        "[0.2, 0.1, 0]}}}\n";
    bench t;
    tracer_value value[SCENE_MAX_TRACERS];
    begin(&t, text, NULL, 0);
    run_until(&t, 1.0);
    tracers_read(t.sim, value);
    const double rate = (value[0].displacement[2] - value[1].displacement[2]) / 0.1 / 0.3,
                 torsion = 1000.0 / 6.0 / (0.1406 * 1e6 / 2.6);
    print_message("torsion: %.4f of Saint-Venant's twist\n", rate / torsion);
    check_close(rate / torsion, 1.0, 0.03);
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_cylinder), cmocka_unit_test(test_pressed_block),
                                       cmocka_unit_test(test_elastica), cmocka_unit_test(test_torsion)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

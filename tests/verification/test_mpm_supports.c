/* Supports that solids pass between nodes (theory 4.13): a cantilever under its weight and let go from straight, a bar drawn by two grips, one that a grip carries
 * along, one that hangs in space from an oblique surface; the same with fixed bodies, to which others stick. References: Timoshenko's beam; sigma = E u/l; a rigid motion; rho g l^2/(2 E). */
#include "deck_run_fixture.h"

#include "grid/ledger.h"
#include "sim/tracer.h"

/* E = 1 MPa, nu = 0, in all scenes. */
#define SCENE                                    \
    "floe: 1\ncoupling: mpm\nboundaries: free\n" \
    "materials: {rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 1 MPa / 3, shear_modulus: 0.5 MPa}}}}\n"

static const double pi = 3.14159265358979323846;

static double worst_momentum(const sim *s)
{
    double worst = 0.0;
    for (int q = LEDGER_MOMENTUM_X; q <= LEDGER_MOMENTUM_Z; ++q)
        worst = fmax(worst, fabs(ledger_largest_drift(&s->ledger, (ledger_quantity)q)));
    return worst;
}

static double tip_of(bench *t, int axis)
{
    tracer_value value[SCENE_MAX_TRACERS];
    tracers_read(t->sim, value);
    return value[0].displacement[axis];
}

/* ---- a cantilever of length 1 m and 0.1 m height, E = 1 MPa, nu = 0; `off`: of the nodes from the surface, in cells ---- */

static void write_cantilever(char text[2000], double h, double off, const char *time)
{
    (void)snprintf(text, 2000,
                   SCENE "title: cantilever\n"
                         "domain: {dim: 2, lower: [%.17g, -0.2], upper: [%.17g, 0.2], cell: %.17g}\n"
                         "bodies: {beam: {material: rubber, shape: {box: {lower: [-0.15, -0.05], upper: [1, 0.05]}}}}\n"
                         "supports: {wall: {region: {box: {lower: [-9, -9], upper: [0, 9]}}}}\n"
                         "loads: {weight: {gravity: {acceleration: [0, -0.0066666666666666667]}}}\n"
                         "time: {%s}\n"
                         "output: {interval: 1 s, tracers: {tip: {body: beam, position: [1, 0]}}}\n",
                   (off - 4.0) * h, (off - 4.0) * h + 1.4, h, time);
}

/* The same, sticking to a fixed block in place of the support. */
static void write_clamped(char text[2000], double h, double off, const char *time)
{
    (void)snprintf(
        text, 2000,
        SCENE "title: cantilever on a block\n"
              "domain: {dim: 2, lower: [%.17g, -0.2], upper: [%.17g, 0.2], cell: %.17g}\n"
              "bodies:\n"
              "  beam: {material: rubber, shape: {box: {lower: [0, -0.05], upper: [1, 0.05]}}}\n"
              "  block: {material: rubber, motion: fixed, shape: {box: {lower: [-0.15, -0.15], upper: [0, 0.15]}}}\n"
              "loads: {weight: {body_force: {body: beam, acceleration: [0, -0.0066666666666666667]}}}\n"
              "time: {%s}\n"
              "output: {interval: 1 s, tracers: {tip: {body: beam, position: [1, 0]}}}\n",
        (off - 4.0) * h, (off - 4.0) * h + 1.4, h, time);
}

/* 1e-3 m by bending, and what shear adds. */
static double beam_deflection(void)
{
    const double bending = 1.0 / (8.0 * 1e6 * 0.001 / 12.0), shear = 1.0 / (2.0 * 5.0 / 6.0 * 0.5e6 * 0.1);
    return 1e-3 * (1.0 + shear / bending);
}

static void test_cantilever_at_rest(void **unused)
{
    (void)unused;
    static const double cell[2] = {0.05, 0.025}, allowed[2] = {0.028, 0.0074};
    for (int k = 0; k < 2; ++k)
        for (int n = 0; n < 5; ++n) {
            char text[2000];
            bench t;
            write_cantilever(text, cell[k], 0.2 * n, "end: 1 s, solver: static, increments: 1");
            begin(&t, text, NULL, 0);
            run_until(&t, 1.0);
            const double ratio = -tip_of(&t, 1) / beam_deflection();
            print_message("%g cells long, surface %g of a cell from a node: %.4f of the deflection\n", 1.0 / cell[k],
                          0.2 * n, ratio);
            check_close(ratio, 1.0, allowed[k]);
            end(&t);
        }
}

/* It swings to twice its deflection in half a period, 3.516^2 = rho A l^4 omega^2/(E I), and back. */
static void test_cantilever_swings(void **unused)
{
    (void)unused;
    static const char *const solver[2] = {"dynamic", "implicit, increments: 80"};
    const double half = pi / (3.516 * sqrt(1e6 * 0.01 / 12.0 / 1000.0));
    for (int k = 0; k < 2; ++k) {
        char text[2000], time[80];
        bench t;
        (void)snprintf(time, sizeof time, "end: %.17g, solver: %s", half, solver[k]);
        write_cantilever(text, 0.05, 0.3, time);
        begin(&t, text, NULL, 0);
        run_until(&t, half);
        const double ratio = -tip_of(&t, 1) / beam_deflection(), drift = worst_momentum(t.sim);
        print_message("%s: after half a period %.4f of the deflection at rest, momentum drifts by %.1e\n", solver[k],
                      ratio, drift);
        check_close(ratio, 2.0, 0.019);
        check_true(drift < 1e-12);
        end(&t);
    }
}

/* K/G = 10: points share changes of volume over patches, those of the support not among them. A clamp that keeps the end from narrowing makes it stiffer by some 2 %. */
static void test_nearly_incompressible_cantilever(void **unused)
{
    (void)unused;
    static const char *const set[1] = {"materials.rubber.law.linear_elastic.bulk_modulus=5e6"};
    const double modulus = 0.5e6 * 2.0 * (1.0 + 14.0 / 31.0) / (1.0 - 14.0 / 31.0 * 14.0 / 31.0); /* E/(1 - nu^2) */
    const double straight = 1e-3 * 1e6 / modulus * (1.0 + modulus / (3.0 * 5.0 / 6.0 * 0.5e6) * 0.01);
    static const double cell[2] = {0.05, 0.025}, allowed[2] = {0.11, 0.06};
    for (int k = 0; k < 2; ++k)
        for (int n = 0; n < 3; ++n) {
            char text[2000];
            bench t;
            write_cantilever(text, cell[k], 0.3 * n, "end: 1 s, solver: static, increments: 1");
            begin(&t, text, set, 1);
            run_until(&t, 1.0);
            const double ratio = -tip_of(&t, 1) / straight;
            print_message("K/G = 10, %g cells long, surface %g of a cell from a node: %.4f of the deflection\n",
                          1.0 / cell[k], 0.3 * n, ratio);
            check_close(ratio, 1.0, allowed[k]);
            end(&t);
        }
    const double half = pi / (3.516 * sqrt(modulus * 0.01 / 12.0 / 1000.0));
    char text[2000], time[80];
    bench t;
    (void)snprintf(time, sizeof time, "end: %.17g, solver: dynamic", half);
    write_cantilever(text, 0.05, 0.3, time);
    begin(&t, text, set, 1);
    run_until(&t, half);
    print_message("K/G = 10: after half a period %.4f of the deflection at rest\n", -tip_of(&t, 1) / straight);
    check_close(-tip_of(&t, 1) / straight, 2.0, 0.11);
    check_true(worst_momentum(t.sim) < 1e-12);
    end(&t);
}

static void test_drawn_by_grips(void **unused)
{
    (void)unused;
    static const char text[] =
        SCENE "title: bar drawn by its grips\n"
              "domain: {dim: 2, lower: [0, 0], upper: [4, 1], cell: 0.1 m}\n"
              "bodies: {bar: {material: rubber, shape: {box: {lower: [0.33, 0.4], upper: [2.5, 0.6]}}}}\n"
              "supports:\n"
              "  grip: {region: {box: {lower: [0, 0], upper: [0.57, 1]}}}\n"
              "  hand: {region: {box: {lower: [2.23, 0], upper: [4, 1]}}, velocity: [0.001, 0]}\n"
              "time: {end: 1 s, solver: static, increments: 2}\n"
              "output: {interval: 1 s, tracers: {middle: {body: bar, position: [1.4, 0.5]}}}\n";
    bench t;
    begin(&t, text, NULL, 0);
    run_until(&t, 1.0);
    tracer_value value[SCENE_MAX_TRACERS];
    tracers_read(t.sim, value);
    print_message("bar drawn by 1 mm over 1.66 m: stress %.2f Pa\n", value[0].stress[0]);
    check_close_relative(value[0].stress[0], 1e6 * 0.001 / 1.66, 6e-4);
    end(&t);
}

/* A grip that moves carries its bar along without straining it, across nodes. */
static void test_carried_by_grip(void **unused)
{
    (void)unused;
    static const char text[] = SCENE
        "title: bar that its grip carries along\n"
        "domain: {dim: 2, lower: [0, 0], upper: [4, 1], cell: 0.1 m}\n"
        "bodies: {bar: {material: rubber, velocity: [2, 0.3], shape: {box: {lower: [0.33, 0.4], upper: [1.5, 0.6]}}}}\n"
        "supports: {grip: {region: {box: {lower: [0, 0], upper: [0.57, 1]}}, velocity: [2, 0.3]}}\n"
        "time: {end: 0.2 s, solver: dynamic}\n"
        "output: {interval: 0.1 s}\n";
    static const char *const set[2] = {"time.solver=implicit", "time.increments=40"};
    for (size_t k = 0; k < 2; ++k) {
        bench t;
        begin(&t, text, set, 2 * k);
        run_until(&t, 0.2);
        sim_totals now;
        check_ok(t.ctx, sim_sum(t.sim, &now));
        print_message("%s: strain energy %.1e J of %.0f J of motion\n", k ? "implicit" : "explicit", now.strain,
                      now.kinetic);
        check_true(now.strain < 1e-20);
        check_true(worst_momentum(t.sim) < 1e-12);
        end(&t);
    }
}

static void test_hangs_in_space(void **unused)
{
    (void)unused;
    static const char text[] =
        SCENE "title: bar that hangs from an oblique ceiling\n"
              "domain: {dim: 3, lower: [0, 0, 0], upper: [1, 1, 2], cell: 0.1 m}\n"
              "bodies: {bar: {material: rubber, shape: {box: {lower: [0.3, 0.3, 0.37], upper: [0.7, 0.7, 1.9]}}}}\n"
              "supports: {ceiling: {region: {halfspace: {point: [0.5, 0.5, 1.53], normal: [-0.1, -0.05, -1]}}}}\n"
              "loads: {weight: {gravity: {acceleration: [0, 0, -1]}}}\n"
              "time: {end: 1 s, solver: static, increments: 1}\n"
              "output: {interval: 1 s, tracers: {tip: {body: bar, position: [0.5, 0.5, 0.37]}}}\n";
    bench t;
    begin(&t, text, NULL, 0);
    run_until(&t, 1.0);
    const double exact = 1000.0 * 1.16 * 1.16 / 2e6, ratio = -tip_of(&t, 2) / exact;
    print_message("bar in space: %.4f of its way down\n", ratio);
    check_close(ratio, 1.0, 0.0044);
    end(&t);
}

/* ---- a fixed body that holds what sticks to it ---- */

typedef struct held_sums {
    double impulse, moment; /* that the block takes: N s along the last axis, N m s about its centre */
} held_sums;

static held_sums step_until(bench *t, double until)
{
    held_sums sum = {0.0, 0.0};
    while (t->sim->time < until * (1.0 - 1e-12)) {
        double force[3], moment[3];
        check_ok(t->ctx, sim_step(t->sim, until));
        check_true(mpm_motion_force(t->sim->mpm, 1, force, moment));
        sum.impulse += t->sim->mpm->kick * force[t->sim->mpm->mesh->dim - 1];
        sum.moment += t->sim->mpm->kick * moment[2];
    }
    check_ok(t->ctx, sim_update_ledger(t->sim));
    return sum;
}

/* After half a period the beam is at rest but for its higher modes: the block has taken its weight over the time, and the moment of that. */
static void test_clamped_by_a_body(void **unused)
{
    (void)unused;
    static const double cell[2] = {0.05, 0.025}, allowed[2] = {0.08, 0.068}, turned[2] = {0.018, 0.13};
    const double half = pi / (3.516 * sqrt(1e6 * 0.01 / 12.0 / 1000.0));
    for (int k = 0; k < 2; ++k)
        for (int n = 0; n < 4; n += 1 + k) {
            char text[2000], time[80];
            bench t;
            (void)snprintf(time, sizeof time, "end: %.17g", half);
            write_clamped(text, cell[k], 0.27 * n, time);
            begin(&t, text, NULL, 0);
            const held_sums sum = step_until(&t, half);
            const double ratio = -tip_of(&t, 1) / beam_deflection(), drift = worst_momentum(t.sim);
            const double weight = 0.1 * 1000.0 * 0.0066666666666666667 * half;
            print_message("%g cells long, joint %g of a cell from a node: %.4f of the deflection; the block takes %.4f "
                          "and %.4f of the weight and its moment, momentum drifts by %.1e\n",
                          1.0 / cell[k], 0.27 * n, ratio, -sum.impulse / weight, -sum.moment / (0.575 * weight), drift);
            check_close(ratio, 2.0, allowed[k]);
            check_close(-sum.impulse / weight, 1.0, 0.01);
            check_close(-sum.moment / (0.575 * weight), 1.0, turned[k]);
            check_true(drift < 1e-12);
            end(&t);
        }
}

/* CSM3 of Turek and Hron (2006), on a round block that is a body of its own: the tip goes down by 128.8 and back by 28.6 mm. */
static void test_flag_on_a_round_block(void **unused)
{
    (void)unused;
    static const char text[] =
        "floe: 1\ntitle: flag on a round block\ncoupling: mpm\nboundaries: free\n"
        "domain: {dim: 2, lower: [0.1003, -0.0017], upper: [0.7003, 0.2983], cell: 10 mm}\n"
        "materials: {rubber: {density: 1000, law: {st_venant_kirchhoff: {bulk_modulus: 7 MPa / 3, shear_modulus: 0.5 "
        "MPa}}}}\n"
        "bodies:\n"
        "  flag: {material: rubber, yields: true, shape: {box: {lower: [0.2, 0.19], upper: [0.6, 0.21]}}}\n"
        "  block: {material: rubber, motion: fixed, shape: {ball: {centre: [0.2, 0.2], radius: 0.05}}}\n"
        "loads: {weight: {body_force: {body: flag, acceleration: [0, -2]}}}\n"
        "time: {end: 1 s}\n"
        "output: {interval: 1 s, tracers: {tip: {body: flag, position: [0.6, 0.2]}}}\n";
    bench t;
    double most[2] = {0.0, 0.0};
    begin(&t, text, NULL, 0);
    while (t.sim->time < 0.5) {
        check_ok(t.ctx, sim_step(t.sim, 0.5));
        for (int a = 0; a < 2; ++a) most[a] = fmax(most[a], -tip_of(&t, a));
    }
    print_message("flag on a round block: %.2f and %.2f mm\n", 1e3 * most[1], 1e3 * most[0]);
    check_close(most[1] / 0.12877, 1.0, 0.044);
    check_close(most[0] / 0.02861, 1.0, 0.11);
    end(&t);
}

/* Let go, it is rho g l^2/E longer after the wave has gone down and up again. */
static void test_hangs_from_a_body(void **unused)
{
    (void)unused;
    static const char text[] = SCENE
        "title: bar that hangs from a block\n"
        "domain: {dim: 3, lower: [0, 0, 0], upper: [1, 1, 2], cell: 0.1 m}\n"
        "bodies:\n"
        "  bar: {material: rubber, shape: {box: {lower: [0.33, 0.3, 0.37], upper: [0.73, 0.7, 1.53]}}}\n"
        "  block: {material: rubber, motion: fixed, shape: {box: {lower: [0.2, 0.2, 1.53], upper: [0.8, 0.8, 1.9]}}}\n"
        "loads: {weight: {body_force: {body: bar, acceleration: [0, 0, -1]}}}\n"
        "time: {end: 1 s}\n"
        "output: {interval: 1 s, tracers: {tip: {body: bar, position: [0.53, 0.5, 0.37]}}}\n";
    bench t;
    begin(&t, text, NULL, 0);
    const double until = 2.0 * 1.16 / sqrt(1e6 / 1000.0);
    const held_sums sum = step_until(&t, until);
    const double ratio = -tip_of(&t, 2) / (1000.0 * 1.16 * 1.16 / 1e6), weight = 0.16 * 1160.0 * until;
    print_message("bar under a block: %.4f of its way down, the block takes %.4f of the weight\n", ratio,
                  -sum.impulse / weight);
    check_close(ratio, 1.0, 0.02);
    check_close(-sum.impulse / weight, 1.0, 0.042);
    end(&t);
}

/* One that comes from afar flies on until nodes are shared, and does not enter the block. */
static void test_arrives_at_a_body(void **unused)
{
    (void)unused;
    static const char text[] =
        SCENE "title: bar that flies to a block\n"
              "domain: {dim: 2, lower: [0, 0], upper: [2, 1], cell: 0.05 m}\n"
              "bodies:\n"
              "  bar: {material: rubber, velocity: [-1, 0], shape: {box: {lower: [1, 0.3], upper: [1.5, 0.6]}}}\n"
              "  block: {material: rubber, motion: fixed, shape: {box: {lower: [0.3, 0.1], upper: [0.6, 0.8]}}}\n"
              "time: {end: 1 s}\n"
              "output: {interval: 1 s, tracers: {tip: {body: bar, position: [1, 0.45]}}}\n";
    bench t;
    begin(&t, text, NULL, 0);
    (void)step_until(&t, 0.2);
    check_close(tip_of(&t, 0), -0.2, 1e-12);
    while (t.sim->time < 0.4) {
        check_ok(t.ctx, sim_step(t.sim, 0.4));
        check_true(tip_of(&t, 0) > -0.4);
    }
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cantilever_at_rest),
        cmocka_unit_test(test_cantilever_swings),
        cmocka_unit_test(test_nearly_incompressible_cantilever),
        cmocka_unit_test(test_drawn_by_grips),
        cmocka_unit_test(test_carried_by_grip),
        cmocka_unit_test(test_hangs_in_space),
        cmocka_unit_test(test_clamped_by_a_body),
        cmocka_unit_test(test_flag_on_a_round_block),
        cmocka_unit_test(test_hangs_from_a_body),
        cmocka_unit_test(test_arrives_at_a_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

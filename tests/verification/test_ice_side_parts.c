/* Conditions on parts of sides, and sides whose numbers change with place and time: the same bits as one condition where parts say the
 * same, what enters by a part to round-off, and exact flows. */
#include "deck_run_fixture.h"

#include "scene/deck_location.h"
#include "scene/unsupported.h"

/* Of a cell, counted over the whole mesh. */
static double value_of(const bench *t, field_id id, int component, int i, int j)
{
    const mesh *m = t->sim->domain->mesh;
    const int cell[MESH_MAX_DIM] = {i, j, 0};
    const block *b = &m->block[mesh_block_of(m, cell)];
    const ptrdiff_t at = mesh_index(b, i - b->lo[0], j - b->lo[1], 0);
    return field_get(t->sim->domain->fields[b->id], id, 0, component)[at];
}

static double difference_of(const bench *a, const bench *b)
{
    double most = 0.0;
    const mesh *m = a->sim->domain->mesh;
    for (int j = 0; j < m->n[1]; ++j)
        for (int i = 0; i < m->n[0]; ++i) {
            most = fmax(most, fabs(value_of(a, C_RHO, 0, i, j) - value_of(b, C_RHO, 0, i, j)));
            most = fmax(most, fabs(value_of(a, C_ENERGY, 0, i, j) - value_of(b, C_ENERGY, 0, i, j)));
            for (int c = 0; c < 2; ++c)
                most = fmax(most, fabs(value_of(a, C_VEL, c, i, j) - value_of(b, C_VEL, c, i, j)));
        }
    return most;
}

/* A vessel with a wall about it, into which a part of the side at x = 0 lets a supersonic jet. */
static const char vessel[] =
    "floe: 1\n"
    "coupling: ice\n"
    "units: none\n"
    "domain: {dim: 2, lower: [0, 0], upper: [2, 1], cell: 0.1}\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 2.5}}}}\n"
    "bodies: {gas: {material: gas, shape: {box: {lower: [0, 0], upper: [2, 1]}}, pressure: 1, temperature: 1}}\n"
    "boundaries: {x: {lower: slip, upper: slip}, y: slip}\n"
    "boundary_parts:\n"
    "  nozzle: {side: x.lower, where: {box: {lower: [-1, 0.4], upper: [1, 0.6]}}, condition: "
    "{inlet: {velocity: [4, 0], pressure: "
    "2, temperature: 1}}}\n"
    "time: {end: 1}\n";

/* What enters is rho u A t; its total energy per mass is e + p / rho + u^2 / 2. To round-off. */
static void test_what_enters_by_a_part(void **state)
{
    (void)state;
    bench t;
    sim_totals before, after;
    begin(&t, vessel, NULL, 0);
    check_ok(t.ctx, sim_sum(t.sim, &before));
    run_until(&t, 0.3);
    check_ok(t.ctx, sim_sum(t.sim, &after));
    const double mass = 2.0 * 4.0 * 0.2 * 0.3, per_mass = 2.5 + 1.0 + 8.0;
    check_close_relative(after.mass - before.mass, mass, 1e-12);
    check_close_relative(after.internal + after.kinetic - before.internal - before.kinetic, mass * per_mass, 1e-12);
    check_true(value_of(&t, C_VEL, 0, 0, 4) > 2.0 && fabs(value_of(&t, C_VEL, 0, 0, 0)) < 1.5);
    end(&t);
}

/* A whole side of one condition, and the same in three parts, one of them by formulas: not a bit differs, on any blocks. */
static void test_parts_that_say_the_same(void **state)
{
    (void)state;
    const char *const whole[] = {"boundary_parts=null",
                                 "boundaries.x.lower={inlet: {velocity: [4, 0], pressure: 2, temperature: 1}}",
                                 "boundaries.x.upper=free"};
    const char *const parts[] = {"boundary_parts={a: {side: x.lower, where: {box: {lower: [-1, -1], upper: [1, 0.3]}}, "
                                 "condition: {inlet: {velocity: [4, 0], "
                                 "pressure: 2, temperature: 1}}}, b: {side: x.lower, where: {box: {lower: [-1, 0.3], "
                                 "upper: [1, 2]}}, condition: {inlet: "
                                 "{velocity: [\"4 + 0 * t\", 0], pressure: \"if(y > -1, 2, 0)\", temperature: 1}}}, c: "
                                 "{side: x.upper, where: {box: {lower: [0, 0], "
                                 "upper: [3, 0.5]}}, condition: free}}",
                                 "boundaries.x.upper=free", "domain.blocks=[2, 1]"};
    bench a, b;
    begin(&a, vessel, whole, 3);
    begin(&b, vessel, parts, 3);
    run_until(&a, 0.8);
    run_until(&b, 0.8);
    check_close(difference_of(&a, &b), 0.0, 0.0);
    end(&a);
    end(&b);
}

/* Parts of every kind, beside each other: mirror images of each other stay so, and blocks do not matter. */
static void test_kinds_beside_each_other(void **state)
{
    (void)state;
    static const char *const kinds[] = {"slip",
                                        "free",
                                        "no_slip",
                                        "{outlet: {pressure: 1.2, temperature: 1}}",
                                        "{non_reflecting: {pressure: 1.2, temperature: 1}}",
                                        "{reservoir: {pressure: 1.5, temperature: 1}}",
                                        "{velocity: {velocity: [\"0.1 * sin(t)\", 0]}}"};
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; ++k) {
        char lower[300], upper[300];
        bench a, b;
        snprintf(lower, sizeof lower,
                 "boundary_parts.low={side: x.upper, where: {box: {lower: [0, -1], upper: [3, 0.3]}}, condition: %s}",
                 kinds[k]);
        snprintf(upper, sizeof upper,
                 "boundary_parts.high={side: x.upper, where: {box: {lower: [0, 0.7], upper: [3, 2]}}, condition: %s}",
                 kinds[k]);
        const char *const set[] = {lower, upper, "domain.blocks=[2, 1]"};
        begin(&a, vessel, set, 2);
        begin(&b, vessel, set, 3);
        run_until(&a, 0.8);
        run_until(&b, 0.8);
        check_close(difference_of(&a, &b), 0.0, 0.0);
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 5; ++j)
                check_close(value_of(&a, C_RHO, 0, i, j), value_of(&a, C_RHO, 0, i, 9 - j), 1e-11);
        end(&a);
        end(&b);
    }
}

/* A piston at the end of a tube, moved by a formula, sends out a wave of sound: u = a sin(w (t - x / c)). */
static const char piston[] =
    "floe: 1\n"
    "coupling: ice\n"
    "units: none\n"
    "constants: {h: 0.01, w: 20, a: 1e-4}\n"
    "domain: {dim: 1, lower: 0, upper: 2, cell: h}\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 1}}}}\n"
    "bodies: {gas: {material: gas, shape: {box: {lower: 0, upper: 2}}, pressure: 1 / 1.4, density: 1}}\n"
    "boundaries: {x: {lower: {velocity: {velocity: [\"a * sin(w * t)\"]}}, upper: free}}\n"
    "time: {end: 2}\n";

static double piston_error(const char *cell)
{
    const char *const set[] = {cell};
    double sum = 0.0, scale = 0.0;
    bench t;
    begin(&t, piston, set, 1);
    run_until(&t, 1.5);
    const int n = t.sim->domain->mesh->n[0];
    for (int i = 0; i < n; ++i) {
        const double x = (i + 0.5) * 2.0 / n, exact = x < 1.5 ? 1e-4 * sin(20.0 * (1.5 - x)) : 0.0;
        sum += fabs(value_of(&t, C_VEL, 0, i, 0) - exact);
        scale += fabs(exact);
    }
    end(&t);
    return sum / scale;
}

/* Measured: 1.70 and 0.39 % of the wave, order 2.1. */
static void test_piston_by_formula(void **state)
{
    (void)state;
    const double coarse = piston_error("constants.h=0.01"), fine = piston_error("constants.h=0.005");
    check_true(coarse < 0.03 && fine < 0.0078);
    check_true(log2(coarse / fine) > 1.8);
}

/* Poiseuille's flow, developed as it enters: measured 0.63 % of the mean velocity, 0.24 % with half the cells. */
static const char channel[] =
    "floe: 1\n"
    "units: none\n"
    "coupling: ice\n"
    "constants: {mu: 0.1, G: 0.8, L: 2}\n"
    "domain: {dim: 2, lower: [0, 0], upper: [L, 1], cell: 0.1}\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 1000}}, viscosity: {shear: mu}}}\n"
    "bodies: {gas: {material: gas, shape: {box: {lower: [0, 0], upper: [L, 1]}}, velocity: [\"G / (2 * mu) * y * (1 - "
    "y)\", 0], "
    "pressure: 1000 + G * (L - x), density: 1}}\n"
    "boundaries:\n"
    "  x: {lower: {inlet: {velocity: [\"G / (2 * mu) * y * (1 - y)\", 0], pressure: 1000 + G * L, temperature: 2.5}}, "
    "upper: {outlet: "
    "{pressure: 1000}}}\n"
    "  y: no_slip\n"
    "time: {end: 10}\n";

static void test_profile_at_an_inlet(void **state)
{
    (void)state;
    bench t;
    double sum = 0.0;
    begin(&t, channel, NULL, 0);
    run_until(&t, 1.0);
    for (int j = 0; j < 10; ++j) {
        const double lo = 0.1 * j, hi = lo + 0.1;
        const double mean = 4.0 * ((hi * hi - lo * lo) / 2.0 - (hi * hi * hi - lo * lo * lo) / 3.0) / 0.1;
        sum += fabs(value_of(&t, C_VEL, 0, 10, j) - mean) / 10.0;
    }
    check_true(sum / (2.0 / 3.0) < 0.0126);
    end(&t);
}

/* Formulas are asked for no value beyond the domain, where roots have none. */
static void test_formulas_end_with_the_domain(void **state)
{
    (void)state;
    const char *const set[] = {"boundaries.x.lower={inlet: {velocity: [\"sqrt(y * (1 - y))\", 0], pressure: 1000, "
                               "temperature: \"1 + sqrt(1 - y)\"}}"};
    bench t;
    begin(&t, channel, set, 1);
    run_until(&t, 0.01);
    end(&t);
}

static const char block_in_stream[] =
    "floe: 1\n"
    "units: none\n"
    "coupling: ice-mpm\n"
    "constants: {from: 0.4}\n"
    "domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1}\n"
    "reference_pressure: 1000\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 1000}}}, m: {density: 100, specific_heat: 1000, law: "
    "{linear_elastic: {bulk_modulus: 1e6, shear_modulus: 1e6}}}}\n"
    "ambient: {material: gas, pressure: 1000, temperature: 2.5}\n"
    "bodies: {block: {material: m, shape: {box: {lower: [from, 0.4], upper: [0.7, 0.7]}}}}\n"
    "boundaries: {x: {lower: {inlet: {velocity: [\"y * (1 - y)\", 0], pressure: 1000, temperature: 2.5}}}}\n"
    "time: {end: 10}\n";

/* Points would see one velocity where the gas has a profile. */
static void test_solids_at_a_profile(void **state)
{
    (void)state;
    const struct {
        const char *from;
        floe_status status;
    } row[] = {{"constants.from=0.4", FLOE_OK}, {"constants.from=0", FLOE_BAD_INPUT}};
    for (int i = 0; i < 2; ++i) {
        deck_report report;
        bench t;
        assert_int_equal(load(&t, block_in_stream, &row[i].from, 1, &report), FLOE_OK);
        deck_report_free(&report);
        assert_int_equal(scene_refuse_unsupported(t.scene, COUPLING_ICE_MPM), row[i].status);
        end(&t);
    }
}

static void test_what_is_refused(void **state)
{
    (void)state;
    const struct {
        const char *set, *says;
    } row[] = {
        {"boundary_parts.nozzle.where={box: {lower: [-1, 0.41], upper: [1, 0.44]}}", "no face of the side"},
        {"boundary_parts.nozzle.side=z.lower", "boundary_parts"},
        {"boundary_parts.nozzle.condition=periodic", "a periodic side has no parts"},
        {"boundaries.x=periodic", "a periodic side has no parts"},
        {"boundary_parts.nozzle.condition={inlet: {velocity: [4, 0], pressure: -1, temperature: 1}}", "does not exist"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        deck_report report;
        bench t;
        assert_int_equal(load(&t, vessel, &row[i].set, 1, &report), FLOE_BAD_INPUT);
        if (!strstr(report.text, row[i].says)) print_error("%s\n%s", row[i].set, report.text);
        check_true(strstr(report.text, row[i].says));
        deck_report_free(&report);
        end(&t);
    }
    bench t;
    deck_report report;
    const char *const as_mpm[] = {"coupling=mpm"};
    assert_int_equal(load(&t, vessel, as_mpm, 1, &report), FLOE_OK);
    check_fails(t.ctx, scene_refuse_unsupported(t.scene, COUPLING_MPM), FLOE_BAD_INPUT);
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_enters_by_a_part),   cmocka_unit_test(test_parts_that_say_the_same),
        cmocka_unit_test(test_kinds_beside_each_other), cmocka_unit_test(test_piston_by_formula),
        cmocka_unit_test(test_profile_at_an_inlet),     cmocka_unit_test(test_formulas_end_with_the_domain),
        cmocka_unit_test(test_solids_at_a_profile),     cmocka_unit_test(test_what_is_refused),
    };
    deck_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Rejected steps: whatever stage a step fails in, the run goes on as one that took the smaller step at once, bit for bit. */
#include "verification/coupled_fixture.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const deck_variant variants[] = {
    {"points", "pressurized_cylinder", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"points, blocks, USF", "pressurized_cylinder", COUPLING_MPM, 2, 2, {"domain.cell=0.1", "method.stress=usf"}},
    {"points, MUSL", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.stress=musl"}},
    {"gas as points, density of cells", "sod", COUPLING_MPM, 1, 2, {"domain.cell=0.02", "method.point_density=cell"}},
    {"gas as points along solids", "defaults/e1_shock_tube", COUPLING_MPM, 1, 1, {"domain.cell=0.02"}},
    {"surface loads", "annulus_traction", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"one gas", "sod", COUPLING_ICE, 2, 1, {"domain.cell=0.00625"}},
    {"one gas, implicit", "sod", COUPLING_ICE, 1, 2, {"domain.cell=0.00625", "method.pressure=implicit"}},
    {"both", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.1", "method.interface=smeared"}},
    {"both, blocks, MUSL",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     2,
     3,
     {"domain.cell=0.1", "method.stress=musl", "method.interface=smeared"}},
    {"both, heat of solids",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     2,
     4,
     {"domain.cell=0.1", "method.heat_exchange=1e9", "materials.steel.conductivity=50",
      "materials.steel.expansion=1e-5"}},
    {"plastic heat",
     "taylor_bar",
     COUPLING_MPM,
     1,
     3,
     {"materials.copper.specific_heat=385", "materials.copper.plastic_heat=0.9", "method.stress=usf"}},
    {"both, implicit", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.2", "method.pressure=implicit"}},
    {"slip along a wall", "slip_wall", COUPLING_ICE_MPM, 1, 0, {NULL}},
    {"reaction", "closed_vessel_burn", COUPLING_ICE, 1, 1, {"time.fixed_step=null"}},
    {"reaction, implicit",
     "closed_vessel_burn",
     COUPLING_ICE,
     1,
     2,
     {"time.fixed_step=null", "method.pressure=implicit"}},
    {"solid that burns", "burning_block", COUPLING_ICE_MPM, 2, 2, {"domain.cell=0.002", "method.transfer=xpic"}},
    {"viscous, conducting, between plates", "couette", COUPLING_ICE, 1, 0, {NULL}},
    {"two gases, drag, heat", "relaxation", COUPLING_ICE, 1, 1, {"time.fixed_step=null"}},
    {"membrane of points", "membrane_circle", COUPLING_MPM, 1, 1, {"domain.cell=0.25"}},
    {"unconnected membrane",
     "membrane_circle",
     COUPLING_MPM,
     1,
     2,
     {"domain.cell=0.25", "bodies.skin.membrane.normals=quadric"}},
    {"membrane that holds gas", "membrane_circle", COUPLING_ICE_MPM, 1, 1, {"domain.cell=0.25"}},
    {"membrane that holds gas, piston", "piston_membrane", COUPLING_ICE_MPM, 1, 0, {NULL}},
    {"membrane in space", "membrane_sphere", COUPLING_MPM, 1, 1, {"domain.cell=0.2"}},
    {"contact", "two_bars", COUPLING_MPM, 1, 1, {"domain.cell=0.25"}},
    {"springs, supports", "ball_net", COUPLING_MPM, 1, 0, {NULL}},
    {"solid that a support holds",
     "turek_hron_csm",
     COUPLING_MPM,
     1,
     2,
     {"time={end: 1, solver: dynamic}", "domain.cell=5 mm"}},
    {"plastic, APIC", "taylor_bar", COUPLING_MPM, 1, 1, {"method.transfer=apic"}},
    {"contact, affine FMPM",
     "two_bars",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.25", "method.transfer=afmpm", "method.flip=null"}},
    {"XPIC",
     "bar_vibration",
     COUPLING_MPM,
     1,
     3,
     {"method.transfer=xpic", "method.flip=null", "method.filter_order=3"}},
    {"held edges", "annulus_traction", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.edge_penalty=0.05"}},
    {"all but incompressible",
     "annulus_traction",
     COUPLING_MPM,
     1,
     2,
     {"domain.cell=0.1", "materials.steel.law.linear_elastic.shear_modulus=1e9"}},
    {"all but incompressible, USF",
     "annulus_traction",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.1", "materials.steel.law.linear_elastic.shear_modulus=1e9", "method.stress=usf"}},
    {"both, held edges",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     2,
     3,
     {"domain.cell=0.1", "method.edge_penalty=0.05", "method.interface=smeared"}},
    {"sharp interface", "shock_plate", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.02", "time.substeps=1"}},
    {"sharp interface, held edges",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     1,
     4,
     {"domain.cell=0.1", "method.interface=sharp", "method.edge_penalty=0.05", "time.substeps=1"}},
    {"sharp interface, sub-steps",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     2,
     4,
     {"domain.cell=0.1", "method.interface=sharp", "method.edge_penalty=0.05", "time.substeps=3"}},
    {"sharp interface, implicit pressure",
     "shock_plate",
     COUPLING_ICE_MPM,
     1,
     3,
     {"domain.cell=0.02", "method.interface=sharp", "method.pressure=implicit"}},
    {"heat through a sharp surface",
     "natural_convection",
     COUPLING_ICE_MPM,
     1,
     2,
     {"domain.cell=0.2", "method.pressure=explicit"}},
    {"source of mass",
     "sod",
     COUPLING_ICE,
     1,
     1,
     {"sources={inflator: {material: gas, region: {box: {lower: 0.4, upper: 0.5}}, mass_rate: 0.01, temperature: "
      "300}}"}},
    {"driven piston", "defaults/f3_piston", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.05", "method.interface=smeared"}},
    {"driven piston in points", "defaults/f3_piston", COUPLING_MPM, 1, 1, {"domain.cell=0.05"}},
    {"rigid box", "defaults/h5_top", COUPLING_MPM, 1, 0, {NULL}},
    {"membrane that holds gas, about an axis", "membrane_balloon", COUPLING_ICE_MPM, 1, 0, {NULL}},
    {"membrane in space that holds gas", "membrane_revolved", COUPLING_MPM, 1, 0, {NULL}},
    {"implicit steps", "bar_vibration", COUPLING_MPM, 1, 2, {"time.solver=implicit", "time.increments=100"}},
    {"statics",
     "annulus_traction",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.1", "time.solver=static", "time.increments=16"}},
    {"driven points", "bar_mms", COUPLING_MPM, 1, 0, {NULL}},
    {"statics of a membrane around gas",
     "membrane_circle",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.25", "time.solver=static", "time.increments=16"}},
    {"statics beside gas on cells",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     1,
     3,
     {"domain.cell=0.1", "time.solver=static", "time.increments=16"}},
};

enum { BEFORE = 6, AFTER = 4 };

/* ---- every stage there is ---- */

enum { SOURCE_SIZE = 1 << 20, NAMES = 256 };

typedef struct name_set {
    char name[NAMES][64];
    int n;
} name_set;

static bool has_name(const name_set *set, const char *name)
{
    for (int i = 0; i < set->n; ++i)
        if (strcmp(set->name[i], name) == 0) return true;
    return false;
}

static void add_name(name_set *set, const char *name, size_t length)
{
    char copy[sizeof *set->name] = "";
    assert_in_range(length, 1, sizeof copy - 1);
    memcpy(copy, name, length);
    if (has_name(set, copy)) return;
    assert_in_range(set->n, 0, NAMES - 1);
    memcpy(set->name[set->n++], copy, sizeof copy);
}

/* Past the comma that ends an argument, which may hold commas in parentheses. */
static const char *next_argument(const char *text)
{
    for (int depth = 0; depth > 0 || *text != ','; ++text) {
        assert_true(*text != '\0');
        depth += (*text == '(') - (*text == ')');
    }
    return text + 1;
}

/* The third argument of each STAGE(s, when, function, ...) in a file. */
static void add_stages_of(name_set *set, const char *path)
{
    static char text[SOURCE_SIZE];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    const size_t n = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[n] = '\0';
    for (const char *at = text; (at = strstr(at, " STAGE(")) != NULL;) {
        at = next_argument(next_argument(at + strlen(" STAGE(")));
        at += strspn(at, " \n");
        add_name(set, at, strcspn(at, ", \n"));
    }
}

static void add_stages_of_sources(name_set *set)
{
    glob_t found;
    assert_int_equal(glob(FLOE_SOURCE_DIR "/src/*/*.c", 0, NULL, &found), 0);
    assert_int_equal(glob(FLOE_SOURCE_DIR "/src/*/*/*.c", GLOB_APPEND, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; ++i) add_stages_of(set, found.gl_pathv[i]);
    globfree(&found);
}

/* A stage that none of the scenes below comes by has never been rejected. */
static void test_no_stage_is_left_out(void **unused)
{
    (void)unused;
    static name_set all, taken;
    add_stages_of_sources(&all);
    check_true(all.n > 50);
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        trial t;
        exact solution;
        variant_load(&t, &variants[k], &solution);
        coupled_start(&t);
        for (int i = 0; i < t.sim->stages.n; ++i)
            add_name(&taken, t.sim->stages.record[i].name, strlen(t.sim->stages.record[i].name));
        variant_end(&t, &solution);
    }
    int left_out = 0;
    for (int i = 0; i < all.n; ++i)
        if (!has_name(&taken, all.name[i])) {
            print_error("stage '%s' is in no scene of this test\n", all.name[i]);
            left_out++;
        }
    assert_int_equal(left_out, 0);
}

/* ---- what a rejected step leaves ---- */

/* Steps of this size from now on; statics go by parts of the whole. (A scene with ambient points is the run's own.) */
static void take_steps_of(trial *t, double dt)
{
    scene_time *time = &((scene *)t->sim->scene)->time;
    if (time->solver == SOLVER_STATIC)
        time->increments = lround(time->end / dt);
    else
        time->fixed_step = dt;
}

/* Stages that have run so far: one that is repeated in a step counts every time. */
static int stages_run(const sim *s)
{
    long calls = 0;
    for (int i = 0; i < s->stages.n; ++i) calls += s->stages.record[i].calls;
    return (int)calls;
}

/* The step after the first few is done with half the step, which is what a rejected one is retried with. */
static state run(const deck_variant *v, int fail_at, int *stages)
{
    trial t;
    exact solution;
    double full, steps;
    const char *reason;
    variant_load(&t, v, &solution);
    coupled_start(&t);
    check_ok(t.ctx, sim_predict(t.sim, &full, &steps, &reason));
    full *= 0.5;
    take_steps_of(&t, full);
    trial_steps(&t, BEFORE - 1);
    *stages = -stages_run(t.sim);
    trial_steps(&t, 1);
    *stages += stages_run(t.sim);
    t.sim->stages.fail_at = fail_at;
    if (fail_at == 0) take_steps_of(&t, 0.5 * full);
    trial_steps(&t, 1);
    assert_int_equal(t.sim->rejected, fail_at != 0);
    assert_int_equal(t.sim->stages.fail_at, 0);
    assert_string_equal(context_message(t.ctx), "");
    take_steps_of(&t, full);
    trial_steps(&t, AFTER);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    state s = state_of(t.sim);
    state_add_ledger(&s, t.sim);
    variant_end(&t, &solution);
    return s;
}

static void test_every_stage(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        const deck_variant *v = &variants[k];
        int n;
        state expected = run(v, 0, &n);
        print_message("%s: %d stages\n", v->name, n);
        check_true(n >= 2);
        for (int stage = 1; stage <= n; ++stage) {
            state found = run(v, stage, &n);
            same_state(&expected, &found);
            state_free(&found);
        }
        state_free(&expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_stage_is_left_out),
        cmocka_unit_test(test_every_stage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

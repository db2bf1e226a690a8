/* Rejected steps: whatever stage a step fails in, the run goes on as one that took the smaller step at once, bit for bit. */
#include "verification/coupled_fixture.h"

static const deck_variant variants[] = {
    {"points", "pressurized_cylinder", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"points, blocks, USF", "pressurized_cylinder", COUPLING_MPM, 2, 2, {"domain.cell=0.1", "method.stress=usf"}},
    {"points, MUSL", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.stress=musl"}},
    {"surface loads", "annulus_traction", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"one gas", "sod", COUPLING_ICE, 2, 1, {"domain.cell=0.00625"}},
    {"one gas, implicit", "sod", COUPLING_ICE, 1, 2, {"domain.cell=0.00625", "method.pressure=implicit"}},
    {"both", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 1, {"domain.cell=0.1"}},
    {"both, blocks, MUSL", "pressurized_cylinder", COUPLING_ICE_MPM, 2, 2, {"domain.cell=0.1", "method.stress=musl"}},
    {"both, implicit", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.2", "method.pressure=implicit"}},
    {"slip along a wall", "slip_wall", COUPLING_ICE_MPM, 1, 0, {NULL}},
    {"reaction", "closed_vessel_burn", COUPLING_ICE, 1, 1, {"time.fixed_step=null"}},
    {"reaction, implicit",
     "closed_vessel_burn",
     COUPLING_ICE,
     1,
     2,
     {"time.fixed_step=null", "method.pressure=implicit"}},
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
    {"plastic, APIC", "taylor_bar", COUPLING_MPM, 1, 1, {"method.transfer=apic"}},
    {"XPIC",
     "bar_vibration",
     COUPLING_MPM,
     1,
     3,
     {"method.transfer=xpic", "method.flip=null", "method.filter_order=3"}},
};

enum { BEFORE = 6, AFTER = 4 };

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
    t.scene->time.fixed_step = full;
    trial_steps(&t, BEFORE);
    t.sim->stages.fail_at = fail_at;
    if (fail_at == 0) t.scene->time.fixed_step = 0.5 * full;
    trial_steps(&t, 1);
    assert_int_equal(t.sim->rejected, fail_at != 0);
    assert_int_equal(t.sim->stages.fail_at, 0);
    assert_string_equal(context_message(t.ctx), "");
    t.scene->time.fixed_step = full;
    trial_steps(&t, AFTER);
    check_ok(t.ctx, sim_account(t.sim));
    state s = state_of(t.sim);
    state_add_ledger(&s, t.sim);
    *stages = t.sim->stages.n;
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
        check_true(n > 2);
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
        cmocka_unit_test(test_every_stage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

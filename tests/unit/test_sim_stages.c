/* Every stage of every coupling under the checks of debug builds: it writes what it says, all of it, and nothing else; and the
 * checks themselves leave no trace. */
#include "verification/coupled_fixture.h"

static const deck_variant variants[] = {
    {"points", "pressurized_cylinder", COUPLING_MPM, 2, 1, {"domain.cell=0.1"}},
    {"points, linear", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.basis=linear"}},
    {"points, gimp, USF",
     "pressurized_cylinder",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.1", "method.basis=gimp", "method.stress=usf"}},
    {"points, gimp, USL", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.basis=gimp"}},
    {"points, MUSL", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.stress=musl"}},
    {"surface loads", "annulus_traction", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"solids alone, linear", "defaults/e5_discs", COUPLING_MPM, 2, 1, {"method.basis=linear"}},
    {"gas points, shock", "sod", COUPLING_MPM, 1, 1, {"domain.cell=0.02"}},
    {"bar", "bar_vibration", COUPLING_MPM, 1, 0, {NULL}},
    {"driven ring", "ring_mms", COUPLING_MPM, 2, 2, {"method.stress=usf", "method.basis=cpdi"}},
    {"driven bar, implicit", "bar_mms", COUPLING_MPM, 1, 2, {"time.solver=implicit", "time.increments=100"}},
    {"one gas", "sod", COUPLING_ICE, 2, 1, {"domain.cell=0.00625"}},
    {"vortex", "isentropic_vortex", COUPLING_ICE, 2, 0, {NULL}},
    {"column", "hydrostatic_column", COUPLING_ICE, 1, 0, {NULL}},
    {"stream", "free_stream", COUPLING_ICE, 1, 0, {NULL}},
    {"box", "closed_box", COUPLING_ICE, 1, 0, {NULL}},
    {"implicit vortex", "isentropic_vortex", COUPLING_ICE, 2, 1, {"method.pressure=implicit"}},
    {"both", "pressurized_cylinder", COUPLING_ICE_MPM, 2, 2, {"domain.cell=0.1", "method.interface=smeared"}},
    {"both, implicit", "pressurized_cylinder", COUPLING_ICE_MPM, 2, 2, {"domain.cell=0.1", "method.pressure=implicit"}},
    {"both, USF",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     1,
     3,
     {"domain.cell=0.1", "method.stress=usf", "method.interface=smeared"}},
    {"both, MUSL",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     1,
     3,
     {"domain.cell=0.1", "method.stress=musl", "method.interface=smeared"}},
    {"both, gimp",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     1,
     3,
     {"domain.cell=0.1", "method.basis=gimp", "method.interface=smeared"}},
    {"both, heat", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.1", "method.heat_exchange=1e3"}},
};

static state run(const deck_variant *v, bool checking)
{
    trial t;
    exact solution;
    variant_load(&t, v, &solution);
    coupled_start(&t);
    t.sim->stages.checking = checking;
    trial_steps(&t, 5);
    assert_int_equal(t.sim->rejected, 0);
    check_ok(t.ctx, sim_refresh(t.sim));
    state s = state_of(t.sim);
    variant_end(&t, &solution);
    return s;
}

static void test_every_stage(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        print_message("%s\n", variants[k].name);
        state expected = run(&variants[k], false), found = run(&variants[k], true);
        same_state(&expected, &found);
        state_free(&found);
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

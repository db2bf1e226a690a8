/* What a plan says of a scene against what the scene takes: bytes against the memory account, kinds of fields, pressure solves. */
#include "verification/coupled_fixture.h"

static const deck_variant variants[] = {
    {"points", "annulus_traction", COUPLING_MPM, 1, 1, {"domain.cell=0.02"}},
    {"points with their edges held",
     "annulus_traction",
     COUPLING_MPM,
     1,
     2,
     {"domain.cell=0.025", "method.edge_penalty=0.05"}},
    {"points of both kinds", "pressurized_cylinder", COUPLING_MPM, 1, 1, {"domain.cell=0.025"}},
    {"one gas", "closed_box", COUPLING_ICE, 1, 1, {"domain.cell=0.005"}},
    {"both", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.025", "method.interface=smeared"}},
};

static uint64_t fields_of(const sim_plan_info *p)
{
    return p->mpm_bytes + p->ice_bytes + p->coupling_bytes;
}

/* Within 1 %, after steps in which points have moved and solvers have run. */
static void test_bytes(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        trial t;
        exact solution;
        sim_plan_info plan, later;
        variant_load(&t, &variants[k], &solution);
        const uint64_t before = memory_read_account(t.ctx).live_bytes;
        coupled_start(&t);
        check_ok(t.ctx, sim_plan(t.sim, &plan));
        trial_steps(&t, 10);
        check_ok(t.ctx, sim_plan(t.sim, &later));
        const memory_account m = memory_read_account(t.ctx);
        const double planned = (double)(fields_of(&plan) + plan.scratch_bytes), live = (double)(m.live_bytes - before);
        print_message("%s: %zu cells, %zu points, fields %.4g MB, scratch %.4g MB, live %+.3f %%, most ever %+.1f %%\n",
                      variants[k].name, plan.cells, plan.points, 1e-6 * (double)fields_of(&plan),
                      1e-6 * (double)plan.scratch_bytes, 100.0 * (live / planned - 1.0),
                      100.0 * ((double)(m.peak_bytes - before) / planned - 1.0));
        check_close_relative((double)fields_of(&later), (double)fields_of(&plan), 0.01);
        check_close_relative(live, planned, 0.01);
        const bool edges = t.sim->mpm && mpm_edge_penalty(t.sim->mpm) > 0.0; /* which keep lists of their own */
        const size_t batches = 128 * 1024; /* of points, a thread: as large in small scenes */
        check_true(plan.scratch_bytes < batches + fields_of(&plan) / (edges ? 1 : 3));
        variant_end(&t, &solution);
    }
}

/* Solids alone hold nothing of cells, and one gas nothing of points and mixtures; only both together pay for the coupling. */
static void test_pays_for_what_it_uses(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        trial t;
        exact solution;
        sim_plan_info plan;
        variant_load(&t, &variants[k], &solution);
        coupled_start(&t);
        check_ok(t.ctx, sim_plan(t.sim, &plan));
        trial_steps(&t, 3);
        const scene_coupling c = variants[k].coupling;
        assert_int_equal(plan.mpm_bytes > 0, c != COUPLING_ICE);
        assert_int_equal(plan.ice_bytes > 0, c != COUPLING_MPM);
        assert_int_equal(plan.coupling_bytes > 0, c == COUPLING_ICE_MPM);
        assert_int_equal(plan.points > 0, c != COUPLING_ICE);
        assert_int_equal(plan.cells > 0, c != COUPLING_MPM);
        assert_int_equal(t.sim->ledger.count[COUNT_NEWTON_CELLS] > 0, c == COUPLING_ICE_MPM);
        static const field_id mixtures[] = {C_THETA, C_VOL, C_KAPPA, C_MIXED, C_SOURCE, C_MOMENTUM_L, F_THETA, F_FLUX};
        for (size_t m = 0; m < sizeof mixtures / sizeof *mixtures; ++m)
            assert_int_equal(fields_bytes(t.sim->domain->fields[0], mixtures[m], mixtures[m]) > 0,
                             c == COUPLING_ICE_MPM);
        variant_end(&t, &solution);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_pays_for_what_it_uses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

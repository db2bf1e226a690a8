/* Every allocation of a simulation's making and of its first steps fails once, with all after it: always FLOE_NO_MEMORY with a
 * message, nothing lost, nothing left. */
#include "verification/coupled_fixture.h"

static const deck_variant variants[] = {
    {"both",
     "pressurized_cylinder",
     COUPLING_ICE_MPM,
     1,
     3,
     {"domain.cell=0.4", "method.basis=gimp", "method.interface=smeared"}},
    {"points", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.4", "method.stress=musl"}},
    {"surface loads", "annulus_traction", COUPLING_MPM, 1, 1, {"domain.cell=0.4"}},
    {"surface loads, static", "annulus_traction", COUPLING_MPM, 1, 2, {"domain.cell=0.4", "time.solver=static"}},
    {"all but incompressible, static",
     "annulus_traction",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.4", "time.solver=static", "materials.steel.law.linear_elastic.shear_modulus=1e8"}},
    {"edges", "annulus_traction", COUPLING_MPM, 1, 2, {"domain.cell=0.4", "method.edge_penalty=0.05"}},
    {"implicit steps of points", "bar_vibration", COUPLING_MPM, 1, 2, {"time.solver=implicit", "time.max_step=0.005"}},
    {"one gas", "sod", COUPLING_ICE, 1, 1, {"domain.cell=0.1"}},
    {"one gas, implicit", "sod", COUPLING_ICE, 1, 2, {"domain.cell=0.1", "method.pressure=implicit"}},
    {"reaction", "closed_vessel_burn", COUPLING_ICE, 1, 1, {"time.fixed_step=null"}},
    {"solid that burns", "burning_block", COUPLING_ICE_MPM, 1, 1, {"domain.cell=0.004"}},
    {"drag and heat of two gases", "relaxation", COUPLING_ICE, 1, 1, {"time.fixed_step=null"}},
    {"sub-steps", "shock_plate", COUPLING_ICE_MPM, 1, 2, {"domain.cell=0.02", "time.substeps=2"}},
    {"contact", "two_bars", COUPLING_MPM, 1, 1, {"domain.cell=0.25"}},
    {"membrane that holds gas", "membrane_circle", COUPLING_ICE_MPM, 1, 1, {"domain.cell=0.25"}},
    {"surface that holds gas points", "membrane_sphere", COUPLING_MPM, 1, 1, {"domain.cell=0.3"}},
    {"unconnected membrane",
     "membrane_circle",
     COUPLING_MPM,
     1,
     3,
     {"domain.cell=0.25", "bodies.gas.points=2", "bodies.skin.membrane.normals=colour_cubic"}},
};

static uint64_t live(const trial *t)
{
    return memory_read_account(t->ctx).live_bytes;
}

/* The number of allocations that were made to fail. */
static uint64_t sweep(const deck_variant *v, bool stepping)
{
    trial t;
    exact solution;
    variant_load(&t, v, &solution);
    const uint64_t before = live(&t);
    uint64_t n = 1;
    for (floe_status status = FLOE_NO_MEMORY; status != FLOE_OK; ++n) {
        if (stepping) coupled_start(&t);
        memory_inject_failure(t.ctx, n);
        if (stepping)
            for (int k = 0; k < 3 && (k == 0 || status == FLOE_OK); ++k) status = sim_step(t.sim, INFINITY);
        else
            status = sim_create(&t.sim, t.ctx, t.scene, v->coupling);
        memory_inject_failure(t.ctx, 0);
        if (status != FLOE_OK) {
            if (!stepping) assert_null(t.sim);
            check_fails(t.ctx, status, FLOE_NO_MEMORY);
        }
        sim_destroy(&t.sim);
        assert_null(t.sim);
        assert_int_equal(live(&t), before);
        assert_in_range(n, 1, 100000);
    }
    variant_end(&t, &solution);
    return n - 2;
}

static void test_create(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        const uint64_t n = sweep(&variants[k], false);
        print_message("%s: %llu allocations\n", variants[k].name, (unsigned long long)n);
        check_true(n > 10);
    }
}

static void test_steps(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k)
        print_message("%s: %llu allocations in three steps\n", variants[k].name,
                      (unsigned long long)sweep(&variants[k], true));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_create),
        cmocka_unit_test(test_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

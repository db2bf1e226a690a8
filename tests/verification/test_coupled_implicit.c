/* The same bits with the implicit pressure for any blocks and threads, and after a restart; fluids alone and with a solid. */
#include "coupled_fixture.h"

#include "io/checkpoint.h"
#include "io/io.h"

#include <unistd.h>

static const deck_variant variants[] = {
    {"gas in a box",
     "closed_box",
     COUPLING_ICE,
     1,
     3,
     {"method.pressure=implicit", "time.acoustic_cfl=20", "domain.cell=0.03125"}},
    {"cylinder", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"method.pressure=implicit", "domain.cell=0.1"}},
};
enum { VARIANTS = sizeof variants / sizeof *variants, STEPS = 30, STEPS_ON = 3 };

static void begin(trial *t, const deck_variant *v, int blocks, int threads, exact *solution)
{
    deck_variant cut = *v;
    cut.blocks = blocks;
    variant_load(t, &cut, solution);
    use_threads(threads);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, t->scene->coupling));
}

static state after(trial *t, long steps)
{
    trial_steps(t, steps);
    check_ok(t->ctx, sim_account(t->sim));
    state s = state_of(t->sim);
    state_add_ledger(&s, t->sim);
    return s;
}

static void blocks_and_threads(void **unused)
{
    (void)unused;
    static const int other[][2] = {{1, 3}, {2, 2}};
    for (int k = 0; k < VARIANTS; ++k) {
        trial t;
        exact solution;
        begin(&t, &variants[k], 1, 1, &solution);
        state expected = after(&t, STEPS);
        assert_true(t.sim->ledger.count[COUNT_CG_ITERATIONS] > STEPS);
        variant_end(&t, &solution);
        for (size_t n = 0; n < sizeof other / sizeof *other; ++n) {
            begin(&t, &variants[k], other[n][0], other[n][1], &solution);
            state found = after(&t, STEPS);
            same_state(&expected, &found);
            state_free(&found);
            variant_end(&t, &solution);
        }
        state_free(&expected);
    }
}

static void resume(void **unused)
{
    (void)unused;
    char folder[] = "/tmp/floe-test-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/checkpoint.h5", folder);
    checkpoint_run info = {.deck = "floe: 1\n", .identity = "floe: 1\n"};
    for (int k = 0; k < VARIANTS; ++k)
        for (long steps = 0; steps < 24; steps += 11) {
            trial t;
            exact solution;
            begin(&t, &variants[k], 1, 1, &solution);
            check_ok(t.ctx, io_init(t.ctx));
            trial_steps(&t, steps);
            check_ok(t.ctx, checkpoint_write(t.sim, path, &info));
            state expected = after(&t, STEPS_ON);
            variant_end(&t, &solution);
            begin(&t, &variants[k], 2, 1, &solution);
            check_ok(t.ctx, checkpoint_read(t.sim, path, &info));
            state found = after(&t, STEPS_ON);
            same_state(&expected, &found);
            state_free(&found);
            state_free(&expected);
            variant_end(&t, &solution);
        }
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_and_threads),
        cmocka_unit_test(resume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

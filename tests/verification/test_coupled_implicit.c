/* The same bits with the implicit pressure for any blocks and threads, and after a restart; fluids alone and with a solid. */
#include "coupled_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/io.h"

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
    check_ok(t->ctx, sim_update_ledger(t->sim));
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
    const checkpoint_place place = checkpoint_place_make();
    for (int k = 0; k < VARIANTS; ++k)
        for (long steps = 0; steps < 24; steps += 11) {
            trial t;
            exact solution;
            begin(&t, &variants[k], 1, 1, &solution);
            check_ok(t.ctx, io_init(t.ctx));
            trial_steps(&t, steps);
            write_checkpoint(&t, place.path);
            state expected = after(&t, STEPS_ON);
            variant_end(&t, &solution);
            begin(&t, &variants[k], 2, 1, &solution);
            read_checkpoint(&t, place.path);
            state found = after(&t, STEPS_ON);
            same_state(&expected, &found);
            state_free(&found);
            state_free(&expected);
            variant_end(&t, &solution);
        }
    checkpoint_place_remove(&place);
}

/* method.pressure auto: implicit from the start where sound would bind, explicit once the limit of the acoustic CFL leaves nothing to gain,
 * and back; a run that is resumed in between does the same. */
static void auto_changes_and_resumes(void **unused)
{
    (void)unused;
    static const deck_variant box = {
        "box", "closed_box", COUPLING_ICE, 1, 3, {"method.pressure=auto", "time.acoustic_cfl=20", "time.end=1"}};
    const checkpoint_place place = checkpoint_place_make();
    trial t;
    exact solution;
    begin(&t, &box, 1, 1, &solution);
    check_ok(t.ctx, io_init(t.ctx));
    assert_true(t.sim->ice->implicit);
    assert_non_null(strstr(t.sim->pressure_reason, "implicit"));
    trial_steps(&t, 60);
    t.scene->time.acoustic_cfl = 0.5;
    trial_steps(&t, 10);
    assert_false(t.sim->ice->implicit);
    assert_non_null(strstr(t.sim->pressure_reason, "from now on explicit"));
    write_checkpoint(&t, place.path);
    t.scene->time.acoustic_cfl = 20.0;
    state expected = after(&t, 70);
    assert_true(t.sim->ice->implicit);
    variant_end(&t, &solution);
    begin(&t, &box, 2, 1, &solution);
    read_checkpoint(&t, place.path);
    assert_false(t.sim->ice->implicit);
    state found = after(&t, 70);
    same_state(&expected, &found);
    state_free(&found);
    state_free(&expected);
    variant_end(&t, &solution);
    checkpoint_place_remove(&place);
}

/* What each scene costs less with. */
static void auto_chooses_by_cost(void **unused)
{
    (void)unused;
    static const struct {
        deck_variant deck;
        bool implicit;
    } cases[] = {
        {{"vortex at Mach 7e-4", "low_mach_vortex", COUPLING_ICE, 1, 1, {"method.pressure=auto"}}, true},
        {{"vortex at Mach 0.8", "isentropic_vortex", COUPLING_ICE, 1, 1, {"method.pressure=auto"}}, false},
        {{"shock tube", "sod", COUPLING_ICE, 1, 1, {"method.pressure=auto"}}, false},
        {{"stiff solid", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 2, {"method.pressure=auto", "domain.cell=0.1"}},
         false},
        {{"unstable fixed step", "closed_box", COUPLING_ICE, 1, 2, {"method.pressure=auto", "time.fixed_step=1e-3"}},
         true},
        {{"stable fixed step", "closed_box", COUPLING_ICE, 1, 2, {"method.pressure=auto", "time.fixed_step=1e-5"}},
         false},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        trial t;
        exact solution;
        begin(&t, &cases[k].deck, 1, 1, &solution);
        print_message("%s: %s\n", cases[k].deck.name, t.sim->pressure_reason);
        assert_int_equal(t.sim->ice->implicit, cases[k].implicit);
        variant_end(&t, &solution);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_and_threads),
        cmocka_unit_test(resume),
        cmocka_unit_test(auto_changes_and_resumes),
        cmocka_unit_test(auto_chooses_by_cost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

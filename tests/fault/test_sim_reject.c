/* Rejected steps: whatever stage a step fails in, the run goes on as one that took the smaller step at once, bit for bit. */
#include "verification/coupled_fixture.h"

typedef struct variant {
    const char *name, *deck;
    scene_coupling coupling;
    int blocks;
    size_t n_set;
    const char *set[4];
} variant;

static const variant variants[] = {
    {"points", "pressurized_cylinder", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"points, blocks, USF", "pressurized_cylinder", COUPLING_MPM, 2, 2, {"domain.cell=0.1", "method.stress=usf"}},
    {"points, MUSL", "pressurized_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.1", "method.stress=musl"}},
    {"surface loads", "annulus_traction", COUPLING_MPM, 1, 1, {"domain.cell=0.1"}},
    {"one gas", "sod", COUPLING_ICE, 2, 1, {"domain.cell=0.00625"}},
    {"both", "pressurized_cylinder", COUPLING_ICE_MPM, 1, 1, {"domain.cell=0.1"}},
    {"both, blocks, MUSL", "pressurized_cylinder", COUPLING_ICE_MPM, 2, 2, {"domain.cell=0.1", "method.stress=musl"}},
};

enum { BEFORE = 6, AFTER = 4 };

static void begin(trial *t, const variant *v, double *dt)
{
    deck_begin(t, v->deck, v->set, v->n_set);
    for (int a = 0; a < t->scene->mesh.dim; ++a) t->scene->mesh.blocks[a] = v->blocks;
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, v->coupling));
    double steps;
    const char *reason;
    check_ok(t->ctx, sim_predict(t->sim, dt, &steps, &reason));
    t->scene->time.fixed_step = 0.5 * *dt;
}

static state finish(trial *t)
{
    check_ok(t->ctx, sim_account(t->sim));
    state s = state_of(t->sim);
    state_add_ledger(&s, t->sim);
    trial_end(t);
    return s;
}

/* The step after the first few is done with half the step, which is what a rejected one is retried with. */
static state run(const variant *v, int fail_at)
{
    trial t;
    double dt;
    begin(&t, v, &dt);
    trial_steps(&t, BEFORE);
    const double full = t.scene->time.fixed_step;
    t.sim->stages.fail_at = fail_at;
    if (fail_at == 0) t.scene->time.fixed_step *= 0.5;
    trial_steps(&t, 1);
    assert_int_equal(t.sim->rejected, fail_at != 0);
    assert_int_equal(t.sim->stages.fail_at, 0);
    assert_string_equal(context_message(t.ctx), "");
    t.scene->time.fixed_step = full;
    trial_steps(&t, AFTER);
    return finish(&t);
}

static int stages_of(const variant *v)
{
    trial t;
    double dt;
    begin(&t, v, &dt);
    const int n = t.sim->stages.n;
    trial_end(&t);
    return n;
}

static void test_every_stage(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        const variant *v = &variants[k];
        const int n = stages_of(v);
        state expected = run(v, 0);
        print_message("%s: %d stages\n", v->name, n);
        for (int stage = 1; stage <= n; ++stage) {
            state found = run(v, stage);
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

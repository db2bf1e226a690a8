/* The same bits of a coupled run for any blocks and threads, and after a restart: every field of state, and the ledger. */
#include "coupled_fixture.h"

#include "io/checkpoint.h"
#include "io/io.h"

#include <unistd.h>

enum { STEPS = 100 };

typedef struct variant {
    int blocks, threads;
    const char *basis, *cell; /* as set on the command line */
} variant;

static void begin(trial *t, const variant *v)
{
    const char *const set[] = {v->cell, v->basis};
    deck_begin(t, "pressurized_cylinder", set, 2);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = v->blocks;
    use_threads(v->threads);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

static state finish(trial *t)
{
    check_ok(t->ctx, sim_account(t->sim));
    state s = state_of(t->sim);
    state_add_ledger(&s, t->sim);
    trial_end(t);
    return s;
}

static state run(const variant *v)
{
    trial t;
    begin(&t, v);
    trial_steps(&t, STEPS);
    return finish(&t);
}

static void test_blocks_and_threads(void **unused)
{
    (void)unused;
    static const struct {
        const char *basis, *cell;
        int variants;
    } deck[] = {{"method.basis=quadratic", "domain.cell=0.05", 3},
                {"method.basis=linear", "domain.cell=0.1", 2},
                {"method.basis=gimp", "domain.cell=0.1", 2}};
    static const int other[][2] = {{1, 2}, {2, 2}, {3, 1}};
    for (int k = 0; k < 3; ++k) {
        const variant one = {1, 1, deck[k].basis, deck[k].cell};
        state expected = run(&one);
        for (int n = 0; n < deck[k].variants; ++n) {
            const variant v = {other[n][0], other[n][1], one.basis, one.cell};
            state found = run(&v);
            same_state(&expected, &found);
            state_free(&found);
        }
        state_free(&expected);
    }
}

/* Written after half of the steps, read into a fresh simulation with other blocks. */
static void test_resume(void **unused)
{
    (void)unused;
    char folder[] = "/tmp/floe-test-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/checkpoint.h5", folder);
    const variant one = {1, 1, "method.basis=quadratic", "domain.cell=0.1"}, four = {2, 1, one.basis, one.cell};
    state expected = run(&one);
    checkpoint_run info = {.deck = "floe: 1\n", .identity = "floe: 1\n"};
    trial t;
    begin(&t, &one);
    check_ok(t.ctx, io_init(t.ctx));
    trial_steps(&t, STEPS / 2);
    check_ok(t.ctx, checkpoint_write(t.sim, path, &info));
    trial_end(&t);
    begin(&t, &four);
    check_ok(t.ctx, checkpoint_read(t.sim, path, &info));
    trial_steps(&t, STEPS - STEPS / 2);
    state found = finish(&t);
    same_state(&expected, &found);
    state_free(&found);
    state_free(&expected);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blocks_and_threads),
        cmocka_unit_test(test_resume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

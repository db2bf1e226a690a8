/* The same bits of a coupled run for any blocks and threads, and after a restart: every field of state, and the ledger. */
#include "coupled_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/io.h"

enum { STEPS = 40 };

typedef struct variant {
    int blocks, threads;
    const char *basis, *cell; /* as set on the command line */
    const char *deck;
} variant;

static void begin(trial *t, const variant *v)
{
    const char *const set[] = {v->cell, v->basis, "method.interface=smeared"}; /* sharp: test_coupled_sharp.c */
    deck_begin(t, v->deck, set, 3);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = v->blocks;
    use_threads(v->threads);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

static state run(const variant *v)
{
    trial t;
    begin(&t, v);
    trial_steps(&t, STEPS);
    return trial_finish(&t);
}

static void test_blocks_and_threads(void **unused)
{
    (void)unused;
    static const struct {
        const char *name, *basis, *cell;
        int variants;
    } deck[] = {{"pressurized_cylinder", "method.basis=quadratic", "domain.cell=0.05", 3},
                {"pressurized_cylinder", "method.basis=linear", "domain.cell=0.1", 2},
                {"pressurized_cylinder", "method.basis=gimp", "domain.cell=0.1", 2},
                {"pressurized_sphere", "method.basis=quadratic", "domain.cell=0.1", 2}}; /* about an axis */
    static const int other[][2] = {{1, 2}, {2, 2}, {3, 1}};
    for (size_t k = 0; k < sizeof deck / sizeof *deck; ++k) {
        const variant one = {1, 1, deck[k].basis, deck[k].cell, deck[k].name};
        state expected = run(&one);
        for (int n = 0; n < deck[k].variants; ++n) {
            const variant v = {other[n][0], other[n][1], one.basis, one.cell, one.deck};
            state found = run(&v);
            same_state(&expected, &found);
            state_free(&found);
        }
        state_free(&expected);
    }
}

/* The whole state, and what rows of the history measure, after each of a few steps. */
enum { STEPS_ON = 3 };

static void keep(trial *t, state *s)
{
    double pressure;
    const int gas = 1;
    check_ok(t->ctx, sim_update_ledger(t->sim));
    *s = state_of(t->sim);
    state_add_ledger(s, t->sim);
    check_ok(t->ctx,
             ice_mean_pressure(t->sim->ice, ice_material_of(t->sim->ice, gas), &t->scene->load[0].region, &pressure));
    state_part(s, "mean pressure");
    *state_reserve(s, 1) = pressure;
}

/* Written after some steps, read into a fresh simulation with other blocks: the same from the first step on. */
static void resume_at(const char *path, long steps)
{
    const variant one = {1, 1, "method.basis=quadratic", "domain.cell=0.1", "pressurized_cylinder"},
                  four = {2, 1, one.basis, one.cell, one.deck};
    state expected[STEPS_ON];
    trial t;
    begin(&t, &one);
    check_ok(t.ctx, io_init(t.ctx));
    assert_int_equal(t.scene->material[1].kind, MATERIAL_FLUID);
    trial_steps(&t, steps);
    write_checkpoint(&t, path);
    for (int k = 0; k < STEPS_ON; ++k) {
        trial_steps(&t, 1);
        keep(&t, &expected[k]);
    }
    trial_end(&t);
    begin(&t, &four);
    read_checkpoint(&t, path);
    for (int k = 0; k < STEPS_ON; ++k) {
        state found;
        trial_steps(&t, 1);
        keep(&t, &found);
        same_state(&expected[k], &found);
        state_free(&found);
        state_free(&expected[k]);
    }
    trial_end(&t);
}

static void test_resume(void **unused)
{
    (void)unused;
    const checkpoint_place place = checkpoint_place_make();
    static const long steps[] = {0, 1, 2, 50, 200};
    for (size_t k = 0; k < sizeof steps / sizeof *steps; ++k) resume_at(place.path, steps[k]);
    checkpoint_place_remove(&place);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blocks_and_threads),
        cmocka_unit_test(test_resume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

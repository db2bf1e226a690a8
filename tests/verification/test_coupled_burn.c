/* Solids on points that burn to gas of the cells: a slab against the equation of its closed vessel, what is left when all is burnt, and mass
 * and momentum to round-off, however fast they burn and move. */
#include "coupled_fixture.h"

#include "verify/reference.h"

enum { BLOCK = 0, GAS = 1, MOST_SET = 8 };

static const char *const slab[] = {"domain={dim: 1, lower: 0, upper: 40 mm, cell: 1 mm}",
                                   "bodies.block.shape={box: {lower: [15 mm], upper: [25 mm]}}"};

/* The deck, in one dimension, with more replaced. */
static void slab_begin(trial *t, const char *const *more, size_t n)
{
    const char *set[MOST_SET] = {slab[0], slab[1]};
    for (size_t k = 0; k < n; ++k) set[2 + k] = more[k];
    deck_begin(t, "burning_block", set, 2 + n);
    coupled_start(t);
}

typedef struct burning {
    double solid, gas, energy,
        pressure; /* kg, kg, J of the gas, Pa: of the gas by its energy and the volume that the solid leaves */
} burning;

static burning look(trial *t)
{
    sim_totals now;
    check_ok(t->ctx, sim_sum(t->sim, &now));
    const int gas = ice_material_of(t->sim->ice, GAS);
    const mesh *m = &t->sim->mesh;
    double volume = 1.0;
    for (int a = 0; a < m->dim; ++a) volume *= m->upper[a] - m->lower[a];
    burning b = {now.mpm.mass[BLOCK], now.ice.mass[gas], now.ice.internal[gas], 0.0};
    b.pressure = 0.25 * b.energy / (volume - b.solid / 1600.0);
    return b;
}

/* The equation of the vessel, for a body with the surface (m2) and form of the deck's reference. */
static burning vessel_at(trial *t, const burning *start, double volume, double surface, double form, double time)
{
    const reference_model *model = reference_find("closed_vessel");
    assert_non_null(model);
    double par[24] = {0.0}, value[8];
    memcpy(par, model->sample, model->param_size);
    const struct {
        const char *key;
        double value;
    } given[] = {{"volume", volume},
                 {"grain_mass", start->solid},
                 {"gas_mass", start->gas},
                 {"gas_energy", start->energy / start->gas},
                 {"heat", 3e5},
                 {"velocity", 1.0},
                 {"pressure", 1e7},
                 {"exponent", 0.6},
                 {"specific_surface", 0.0},
                 {"surface", surface},
                 {"form", form}};
    for (size_t k = 0; k < sizeof given / sizeof *given; ++k)
        *param_find(model->params, model->n_params, par, given[k].key) = given[k].value;
    reference vessel;
    check_ok(t->ctx, reference_create(t->ctx, model, par, &vessel));
    check_ok(t->ctx, reference_series(t->ctx, &vessel, 1, &time, value));
    reference_destroy(t->ctx, &vessel);
    return (burning){value[0], value[1], 0.0, value[2]};
}

/* Both faces of a slab of ten cells recede by A p^n. Measured: 0.3 % of the slab off, 4 % of the pressure and of the energy. */
static void test_recession(void **unused)
{
    (void)unused;
    static const char *const set[] = {"reactions.burn.rate.burn.velocity=1"};
    trial t;
    slab_begin(&t, set, 1);
    const burning start = look(&t);
    check_close(start.solid, 16.0, 1e-12);
    for (int k = 1; k <= 3; ++k) {
        const double time = 5e-4 * k;
        trial_run(&t, time);
        const burning now = look(&t), then = vessel_at(&t, &start, 0.04, 2.0, 0.0, time);
        print_message("slab at %.1e s: %.4f of it left (%.4f), %.4g Pa (%.4g), drift of energy %.1e\n", time,
                      now.solid / start.solid, then.solid / start.solid, now.pressure, then.pressure,
                      ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
        check_close(now.solid / start.solid, then.solid / start.solid, 0.0065);
        check_close(now.pressure, then.pressure, 0.05 * then.pressure);
        check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 0.045);
    }
    trial_end(&t);
}

/* When all is burnt p V = (gamma - 1) E, E what there was and what came with the solid; no point is left. */
static void test_burnt_out(void **unused)
{
    (void)unused;
    static const char *const set[] = {"bodies.block.shape={box: {lower: [19 mm], upper: [21 mm]}}",
                                      "reactions.burn.heat=3e6"};
    trial t;
    slab_begin(&t, set, 2);
    const burning start = look(&t);
    trial_run(&t, 1e-3);
    const burning end = look(&t);
    const double all = 0.25 * (start.energy + start.solid * (3e5 + 3e6)) / 0.04;
    print_message("burnt out: %.5g Pa (%.5g), %lld points burnt\n", end.pressure, all,
                  t.sim->ledger.count[COUNT_POINTS_BURNT]);
    assert_int_equal(mpm_count(t.sim->mpm), 0);
    assert_int_equal(t.sim->ledger.count[COUNT_POINTS_BURNT], 4);
    check_close(end.gas, start.gas + start.solid, 1e-13 * (start.gas + start.solid));
    check_close(end.pressure, all, 1.4e-3 * all);
    trial_end(&t);
}

/* Whatever the basis and the transfer, and however stiff the rate: a block that moves with its gas through a periodic mesh. */
static void test_conserves(void **unused)
{
    (void)unused;
    static const char *const method[][2] = {
        {"linear", "flip"}, {"gimp", "apic"}, {"quadratic", "xpic"}, {"cubic", "flip"}};
    static const char *const rate[] = {"reactions.burn.rate={burn: {velocity: 30, pressure: 1e6, exponent: 0}}",
                                       "reactions.burn.rate={threshold: {temperature: 299, time: 1e-12}}"};
    for (int k = 0; k < 8; ++k) {
        char basis[64], transfer[64];
        (void)snprintf(basis, sizeof basis, "method.basis=%s", method[k / 2][0]);
        (void)snprintf(transfer, sizeof transfer, "method.transfer=%s", method[k / 2][1]);
        const char *const set[] = {
            "domain.cell=0.004", "boundaries=periodic", "bodies.block.velocity=[40, 25]", rate[k % 2], basis, transfer};
        trial t;
        deck_begin(&t, "burning_block", set, 6);
        coupled_start(&t);
        const burning start = look(&t);
        trial_steps(&t, 12);
        const burning now = look(&t);
        const double mass = ledger_worst(&t, LEDGER_MASS, LEDGER_MASS),
                     momentum = ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y);
        print_message("%s %s, %s: %.4f left, drifts %.1e %.1e\n", method[k / 2][0], method[k / 2][1],
                      k % 2 ? "stiff" : "slow", now.solid / start.solid, mass, momentum);
        check_true(now.solid < (k % 2 ? 0.01 : 0.999) * start.solid);
        check_true(mass <= 1e-14);
        check_true(momentum <= 1e-13);
        trial_end(&t);
    }
}

/* Nothing reacts below the threshold, not a bit. */
static void test_cold(void **unused)
{
    (void)unused;
    static const char *const set[] = {"reactions.burn.rate={threshold: {temperature: 301, time: 1e-12}}"};
    trial t;
    slab_begin(&t, set, 1);
    const burning start = look(&t);
    trial_steps(&t, 20);
    check_true(look(&t).solid == start.solid);
    trial_end(&t);
}

static state burn(int blocks, int threads, const char *path)
{
    static const char *const set[] = {"domain.cell=0.002", "reactions.burn.rate.burn.velocity=60"};
    checkpoint_run info = {.deck = "floe: 1\n", .identity = "floe: 1\n"};
    trial t;
    for (int part = path ? 0 : 1; part < 2; ++part) {
        deck_begin(&t, "burning_block", set, 2);
        for (int a = 0; a < 2; ++a) t.scene->mesh.blocks[a] = blocks;
        use_threads(threads);
        coupled_start(&t);
        if (path && part == 1) check_ok(t.ctx, checkpoint_read(t.sim, path, &info));
        if (path) check_ok(t.ctx, io_init(t.ctx));
        trial_steps(&t, path ? (part == 0 ? 60 : 40) : 100);
        if (!path || part == 1) break;
        check_ok(t.ctx, checkpoint_write(t.sim, path, &info));
        trial_end(&t);
    }
    check_true(t.sim->ledger.count[COUNT_POINTS_BURNT] > 0);
    return trial_finish(&t);
}

/* The same bits for any blocks and threads, and after a checkpoint, with points gone. */
static void test_bits(void **unused)
{
    (void)unused;
    same_bits_however_run(burn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_recession), cmocka_unit_test(test_burnt_out), cmocka_unit_test(test_conserves),
        cmocka_unit_test(test_cold),      cmocka_unit_test(test_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

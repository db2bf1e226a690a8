/* York's airbag (inputs/airbag_200.yaml, airbag_500.yaml): printed masses, a bag that neither tears nor leaks while the probe pushes it in,
 * momentum and energy; and the tether as a force. */
#include "coupled_fixture.h"

enum { GAS_BODIES = 6, BAG = 6, PROBE = 7, BAG_MOST = 400 };

/* Places of the bag's points by number; where it meets the axis it goes on straight. */
typedef struct bag {
    double r[BAG_MOST], z[BAG_MOST];
    size_t n;
} bag;

static void add_bag_point(void *user, const fields *f, int body, size_t k)
{
    bag *b = user;
    const size_t number = (size_t)((uint64_t)field_get(f, P_ID, body, 0)[k] & ((UINT64_C(1) << 40) - 1));
    assert_true(number < BAG_MOST);
    b->r[number] = field_get(f, P_POS, body, 0)[k];
    b->z[number] = field_get(f, P_POS, body, 1)[k];
    b->n++;
}

static double widest_gap(const bag *b)
{
    double gap = 0.0;
    for (size_t k = 0; k + 1 < b->n; ++k) gap = fmax(gap, hypot(b->r[k + 1] - b->r[k], b->z[k + 1] - b->z[k]));
    return gap;
}

typedef struct leak {
    const bag *bag;
    double farthest; /* m: of a gas point outside, from the bag */
    int outside;
} leak;

/* Distance from the line between two points of the bag. */
static double distance(const bag *b, size_t k, double r, double z)
{
    const double dr = b->r[k + 1] - b->r[k], dz = b->z[k + 1] - b->z[k];
    const double share = ((r - b->r[k]) * dr + (z - b->z[k]) * dz) / (dr * dr + dz * dz),
                 on = fmin(fmax(share, 0.0), 1.0);
    return hypot(r - b->r[k] - on * dr, z - b->z[k] - on * dz);
}

/* Inside: a ray away from the axis crosses the bag an odd number of times. */
static void look_for_leak(void *user, const fields *f, int body, size_t k)
{
    leak *l = user;
    const bag *b = l->bag;
    const double r = field_get(f, P_POS, body, 0)[k], z = field_get(f, P_POS, body, 1)[k];
    double nearest = INFINITY;
    bool inside = false;
    for (size_t m = 0; m + 1 < b->n; ++m) {
        nearest = fmin(nearest, distance(b, m, r, z));
        const double share = (z - b->z[m]) / (b->z[m + 1] - b->z[m]);
        if ((b->z[m] > z) != (b->z[m + 1] > z) && r < b->r[m] + share * (b->r[m + 1] - b->r[m])) inside = !inside;
    }
    if (inside) return;
    l->outside++;
    l->farthest = fmax(l->farthest, nearest);
}

static double gas_of(const double *of_body)
{
    double sum = 0.0;
    for (int k = 0; k < GAS_BODIES; ++k) sum += of_body[k];
    return sum;
}

/* Runs a deck to 10 ms. Measured: energy off by 3e-4 (200 mm) and 2e-4 (500 mm). */
static void push_in(const char *deck, const char *const *set, size_t n_set, double probe_mass)
{
    trial t;
    mpm_totals start, sum;
    static bag b;
    b.n = 0;
    const double around = 2.0 * 3.14159265358979323846; /* sums are those of a radian */
    deck_begin(&t, deck, set, n_set);
    trial_start(&t);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &start));
    trial_run(&t, 0.01);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    /* printed: 6.03 or 8.05 kg, 367.2 g; the gas of the box's regions, by the frusta between their corners */
    check_close_relative(around * sum.mass[PROBE], probe_mass, 2.5e-4);
    check_close_relative(around * sum.mass[BAG], 0.3672, 8e-6);
    check_close_relative(around * gas_of(sum.mass), strcmp(deck, "airbag_200") == 0 ? 0.0666544 : 0.0665892, 2.5e-5);

    visit_points(&t, BAG, add_bag_point, &b);
    leak l = {.bag = &b};
    for (int k = 0; k < GAS_BODIES; ++k) visit_points(&t, k, look_for_leak, &l);
    const double fallen = (start.moment[PROBE][1] - sum.moment[PROBE][1]) / sum.mass[PROBE];
    const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
    print_message("%s: probe down %.4f m, gap %.4f m, %d gas points outside (%.4f m), energy %.1e\n", deck, fallen,
                  widest_gap(&b), l.outside, l.farthest, energy);
    check_true(fallen > 0.03 && fallen < 0.05);
    check_true(widest_gap(&b) < 2.0 * 0.0025); /* 0.0025 at the start */
    assert_int_equal(l.outside, 0);
    check_true(energy < 1e-4);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-14);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_Y, LEDGER_MOMENTUM_Y) <
               1e-12); /* along the axis, with what the walls took */
    trial_end(&t);
}

static void test_small_probe(void **unused)
{
    (void)unused;
    push_in("airbag_200", NULL, 0, 6.03);
}

static void test_large_probe(void **unused)
{
    (void)unused;
    push_in("airbag_500", NULL, 0, 8.05);
}

static void test_tether(void **unused)
{
    (void)unused;
    static const char *const set[] = {"springs.tether={from: {body: bag, point: 44}, to: {body: bag, point: 243}, "
                                      "stiffness: 71500, one_way: true}"};
    push_in("airbag_200", set, 1, 6.03);
}

static void find_lowest_probe(void *user, const fields *f, int body, size_t k)
{
    double *lowest = user;
    const double half = 0.5 * 0.01; /* two points a cell of 0.02 */
    *lowest = fmin(*lowest, field_get(f, P_POS, body, 1)[k] - half);
}

/* Gas behind the bag has no say in where bag and probe meet. Measured: the bag is 0.2 mm below the probe, where gas
 * counted as a body 15 mm inside it. */
static void test_contact(void **unused)
{
    (void)unused;
    static const char *const set[] = {"contact={between: [bag, probe]}"};
    static bag b;
    trial t;
    double bottom = INFINITY, deepest = -INFINITY;
    b.n = 0;
    deck_begin(&t, "airbag_200", set, 1);
    trial_start(&t);
    trial_run(&t, 0.02);
    visit_points(&t, BAG, add_bag_point, &b);
    visit_points(&t, PROBE, find_lowest_probe, &bottom);
    for (size_t k = 0; k < b.n; ++k)
        if (b.r[k] < 0.1) deepest = fmax(deepest, b.z[k] - bottom);
    print_message("bag %.4f m into the probe\n", deepest);
    check_true(deepest < 0.1 * 0.02);
    check_true(deepest > -0.5 * 0.02); /* and pushed by it, not from afar */
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_small_probe), cmocka_unit_test(test_large_probe),
                                       cmocka_unit_test(test_tether), cmocka_unit_test(test_contact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

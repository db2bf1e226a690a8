/* Standing waves of water under air in a closed tank, half a wavelength wide (theory 2.17), with the explicit pressure. Reference: linear waves of two fluids between walls
 * (Lamb, Hydrodynamics, article 231),
 *     omega^2 = g k (rho - rho') / (rho coth(k h) + rho' coth(k h')),
 * whose period waves of the heights here, at most 0.06/k, exceed by less than 0.05 %. Nothing damps them. */
#include "deck_run_fixture.h"

enum { POINTS = 80 }; /* of the surface */

static const double pi = 3.14159265358979323846, width = 1.0, gravity = 9.81, liquid = 1000.0, gas = 1.2;

typedef struct tank {
    double depth, above, height; /* m: of the water and of the air, at rest; of the wave */
    /* found, of their exact values: how much longer the period is, and how much of the height is lost in one */
    double period, loss;
    double fastest; /* of the cells of gas, over the fastest that the wave moves it */
} tank;

static double exact_period(const tank *w)
{
    const double k = pi / width;
    return 2.0 * pi / sqrt(gravity * k * (liquid - gas) / (liquid / tanh(k * w->depth) + gas / tanh(k * w->above)));
}

static void write_deck(const tank *w, char *deck, size_t size)
{
    size_t at = (size_t)snprintf(
        deck, size,
        "floe: 1\ncoupling: ice\n"
        "domain: {dim: 2, lower: [0, %.17g], upper: [1, %.17g], cell: 0.05}\nboundaries: slip\n"
        "materials: {water: {eos: {acoustic: {density: 1000, sound_speed: 50, pressure: 8571, specific_heat: 4186}}}, "
        "air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}}\n"
        "ambient: {material: air, pressure: 8571, temperature: 24.887}\n"
        "loads: {weight: {gravity: {acceleration: [0, -9.81]}}}\ntime: {end: 9}\n"
        "bodies: {water: {material: water, density: 1000, pressure: 8571, shape: {polygon: {vertices: [[0, -2], [1, "
        "-2]",
        -w->depth, w->above);
    for (int n = POINTS; n >= 0; --n) {
        const double x = width * n / POINTS;
        at += (size_t)snprintf(deck + at, size - at, ", [%.6f, %.8f]", x, w->height * cos(pi * x / width));
    }
    snprintf(deck + at, size - at, "]}}}}\n");
}

/* Of the wave's shape, m. */
static double height_now(const bench *t)
{
    const mesh *m = &t->sim->mesh;
    const block *b = &m->block[0];
    const double *rho = field_get(t->sim->domain->fields[0], C_RHO, 0, 0),
                 *v = field_get(t->sim->domain->fields[0], C_VOL, 0, 0);
    double sum = 0.0;
    for (int j = 0; j < b->n[1]; ++j)
        for (int i = 0; i < b->n[0]; ++i) {
            const ptrdiff_t at = mesh_index(b, i, j, 0);
            sum += rho[at] * v[at] * cos(pi * mesh_centre(m, 0, i) / width);
        }
    return 2.0 / width * sum * m->h[0] * m->h[1];
}

/* m/s: of the cells that the gas fills. */
static double fastest_gas(const bench *t)
{
    const block *b = &t->sim->mesh.block[0];
    const fields *f = t->sim->domain->fields[0];
    const double *rho = field_get(f, C_RHO, 1, 0), *v = field_get(f, C_VOL, 1, 0), *u = field_get(f, C_VEL, 1, 0),
                 *w = field_get(f, C_VEL, 1, 1);
    double fastest = 0.0;
    for (int j = 0; j < b->n[1]; ++j)
        for (int i = 0; i < b->n[0]; ++i) {
            const ptrdiff_t at = mesh_index(b, i, j, 0);
            if (rho[at] * v[at] > 0.99) fastest = fmax(fastest, hypot(u[at], w[at]));
        }
    return fastest;
}

/* From the first time that the surface is even to the third is a period; the height is largest half a period after the second. */
static void follow(tank *w)
{
    static char deck[8192];
    bench t;
    write_deck(w, deck, sizeof deck);
    begin(&t, deck, NULL, 0);
    const double exact = exact_period(w), start = height_now(&t), speed = 2.0 * pi / exact * w->height;
    double before = start, time = 0.0, crossing[3], top = 0.0;
    for (int n = 0; n < 3;) {
        check_ok(t.ctx, sim_step(t.sim, 2.0 * exact));
        const double now = height_now(&t);
        if (before * now <= 0.0 && (n == 0 || t.sim->time > crossing[n - 1] + 0.2 * exact))
            crossing[n++] = time + (t.sim->time - time) * before / (before - now);
        if (n == 2) top = fmax(top, now);
        w->fastest = fmax(w->fastest, fastest_gas(&t) / speed);
        before = now;
        time = t.sim->time;
    }
    check_true(sim_update_ledger(t.sim) == FLOE_OK);
    check_true(fabs(ledger_largest_drift(&t.sim->ledger, LEDGER_MASS)) < 1e-12);
    check_true(fabs(ledger_largest_drift(&t.sim->ledger, LEDGER_ENERGY)) < 1e-12);
    end(&t);
    w->period = (crossing[2] - crossing[0]) / exact - 1.0;
    w->loss = 1.0 - top / start;
    print_message("%.4g m of water, wave of %.3g m: period %+.3g %%, height %+.3g %%, gas at %.3g of its speed\n",
                  w->depth, w->height, 100.0 * w->period, -100.0 * w->loss, w->fastest);
}

/* The surface crosses two rows of cells; and it stays within one, at its middle, and at a quarter and three quarters of its height. */
static void test_period_and_height(void **state)
{
    (void)state;
    tank high = {.depth = 0.5, .above = 0.5, .height = 0.02};
    follow(&high);
    check_true(fabs(high.period) < 5e-3);
    check_true(fabs(high.loss) < 1.8e-2);
    check_true(high.fastest < 2.5);
    for (int n = 1; n < 4; ++n) {
        tank low = {.depth = 0.5 + 0.0125 * n, .above = 0.5 - 0.0125 * n, .height = 0.004};
        follow(&low);
        check_true(fabs(low.period) < 1.4e-2);
        check_true(fabs(low.loss) < 2.2e-2);
        check_true(low.fastest < 2.8);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_period_and_height)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

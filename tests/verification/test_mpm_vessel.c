/* Gas points in a thick steel cylinder (Guilkey et al. 2003, section 3), pressurised: a quarter in plane strain with
 * fitted points, whose small volume fractions at the surface join others. */
#include "mpm_fixture.h"

static const double bore = 0.5, outside = 1.0, ambient = 101325.0;

static void make_vessel(trial *t, const char *basis, double h)
{
    const double size[3] = {1.2, 1.2, 0.0};
    trial_begin(t, 2, size, h);
    for (int axis = 0; axis < 2; ++axis) set_sides(t, axis, BC_SYMMETRY, BC_FREE);
    set_method(t, basis, STRESS_USL, 0.99);
    t->scene->time.growth = 1.1;
    t->scene->damping.rate = 1.2e4;
    t->scene->reference_pressure = ambient;
    const int gas = add_gas(t, 1.4, 717.5), steel = add_solid(t, "linear_elastic", 117e9, 43.8e9, 8900.0);
    add_body(t, steel, make_ring(t, bore, outside), 2)->seeding = SEED_FITTED;
    scene_body *b = add_body(t, gas, make_ball(t, (const double[]){0.0, 0.0, 0.0}, bore), 2);
    b->seeding = SEED_FITTED;
    b->pressure = ambient;
    b->temperature = 300.0;
    scene_load *load = add_load(t, LOAD_PRESSURISE, -1);
    load->material = gas;
    load->target = 19.4e6;
    load->ramp = 1.4e-3;
    load->hold = true;
    trial_start(t);
}

enum { CELLS = 24, STEEL = 0, GAS = 1 };

typedef struct contents {
    double h, volume[2][CELLS * CELLS], total[2];
} contents;

static void add_volume(void *user, const fields *f, int body, size_t k)
{
    contents *c = user;
    const int i = (int)(field_get(f, P_POS, body, 0)[k] / c->h), j = (int)(field_get(f, P_POS, body, 1)[k] / c->h);
    const double volume = field_get(f, P_VOLUME0, body, 0)[k];
    c->volume[body][i + CELLS * j] += volume;
    c->total[body] += volume;
}

typedef struct gas_cells {
    int full, other;
} gas_cells;

/* Cells of gas that no point of the steel is in. */
static gas_cells count_gas_cells(const contents *c)
{
    gas_cells found = {0, 0};
    for (int k = 0; k < CELLS * CELLS; ++k) {
        if (c->volume[STEEL][k] > 0.0 || c->volume[GAS][k] == 0.0) continue;
        if (fabs(c->volume[GAS][k] / (c->h * c->h) - 1.0) < 1e-6)
            ++found.full;
        else
            ++found.other;
    }
    return found;
}

static const int meshes[] = {12, 15, 24};

/* With the linear basis gas fills the cells that no point of the steel is in, whose small volume fractions have left;
 * other bases have it as its shape is. (Measured: 3.4e-3, -3.8e-3 and 4e-4 of the gas is added.) The steel is as it is
 * either way. */
static void test_gas_fills_cells(void **state)
{
    (void)state;
    const double quarter = 0.25 * acos(-1.0);
    for (int linear = 0; linear <= 1; ++linear)
        for (size_t m = 0; m < sizeof meshes / sizeof *meshes; ++m) {
            trial t;
            contents c = {.h = 1.2 / meshes[m]};
            make_vessel(&t, linear ? "linear" : "gimp", c.h);
            visit_points(&t, STEEL, add_volume, &c);
            visit_points(&t, GAS, add_volume, &c);
            const gas_cells found = count_gas_cells(&c);
            check_true(found.full > meshes[m]);
            check_true(linear ? found.other == 0 : found.other > 0); /* else there would be nothing to mend */
            check_close_relative(c.total[STEEL], quarter * (outside * outside - bore * bore), 4e-10);
            check_close_relative(c.total[GAS], quarter * bore * bore, linear ? 0.01 : 1e-8);
            trial_end(&t);
        }
}

typedef struct extremes {
    double least, most, speed;
} extremes;

static void add_extremes(void *user, const fields *f, int body, size_t k)
{
    extremes *e = user;
    const double J = field_get(f, P_J, body, 0)[k];
    e->least = fmin(e->least, J);
    e->most = fmax(e->most, J);
    e->speed = fmax(e->speed, hypot(field_get(f, P_VEL, body, 0)[k], field_get(f, P_VEL, body, 1)[k]));
}

/* The steel gives way by 1e-4 of the bore's volume: the gas stays where it is. Measured: J from 0.973 to 1.026, up to
 * 0.04 m/s; with cells that small volume fractions leave partly empty 0.4 to 6 and 650 m/s, before the time step shrank
 * to nothing at 2.3 ms. With GIMP small volume fractions at the steel settle, 0.952 to 1.153, up to 0.07 m/s; with
 * boxes that keep their size up to 1.7 m/s by then, at h = 0.1, and growing. */
static void test_gas_stays(void **state)
{
    (void)state;
    for (size_t m = 0; m < 2 * (sizeof meshes / sizeof *meshes); ++m) {
        trial t;
        make_vessel(&t, m % 2 ? "gimp" : "linear", 1.2 / meshes[m / 2]);
        trial_run(&t, 2.6e-3);
        extremes e = {INFINITY, 0.0, 0.0};
        visit_points(&t, GAS, add_extremes, &e);
        print_message("%s, h = %.4f: J from %.3f to %.3f, speeds to %.3g m/s\n", m % 2 ? "gimp" : "linear",
                      1.2 / meshes[m / 2], e.least, e.most, e.speed);
        check_true(e.least >= (m % 2 ? 0.93 : 0.95) && e.most <= (m % 2 ? 1.2 : 1.05));
        check_true(e.speed <= 0.14);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gas_fills_cells),
        cmocka_unit_test(test_gas_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

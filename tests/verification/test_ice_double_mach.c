/* A shock of Mach 10 that meets a wall at 60 degrees (Woodward and Colella 1984): a part of the lower side lets the gas behind the shock
 * pass, formulas of place and time lead the upper side along with the shock. */
#include "deck_run_fixture.h"

#define AHEAD "if(x < a + (1 + 20 * t) * cot, "
static const char deck[] =
    "floe: 1\n"
    "coupling: ice\n"
    "constants: {n: 60, u: 8.25 * cos(pi / 6), v: -8.25 * sin(pi / 6), p: 116.5, T: 116.5 / 8, a: 1 / 6, cot: 1 / "
    "sqrt(3)}\n"
    "domain: {dim: 2, lower: [0, 0], upper: [3, 1], cell: 1 / n}\n"
    "boundaries:\n"
    "  x: {lower: {inlet: {velocity: [u, v], pressure: p, temperature: T}}, upper: free}\n"
    "  y: {lower: slip, upper: {inlet: {velocity: [\"" AHEAD "u, 0)\", \"" AHEAD "v, 0)\"], pressure: \"" AHEAD
    "p, 1)\", temperature: \"" AHEAD "T, 1 / 1.4)\"}}}\n"
    "boundary_parts:\n"
    "  behind: {side: y.lower, where: {box: {lower: [-1, -1], upper: [a, 1]}}, condition: {inlet: {velocity: [u, v], "
    "pressure: p, temperature: T}}}\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 2.5}}}}\n"
    "bodies: {gas: {material: gas, shape: {box: {lower: [0, 0], upper: [3, 1]}}, velocity: [\"if(x < a + y * cot, u, "
    "0)\", \"if(x < a + y * cot, v, 0)\"], pressure: \"if(x < a + y * cot, p, 1)\", temperature: \"if(x < a + y * "
    "cot, T, 1 / 1.4)\"}}\n"
    "time: {end: 1}\n";

static void begin_with(bench *t, const char *cells)
{
    char set[80];
    const char *const list[] = {set};
    snprintf(set, sizeof set, "constants.n=%s", cells);
    begin(t, deck, list, 1);
}

static double value_of(const bench *t, field_id id, int i, int j)
{
    const block *b = &t->sim->ice->mesh->block[0];
    return field_get(t->sim->ice->domain->fields[0], id, 0, 0)[mesh_index(b, i, j, 0)];
}

/* Where along row j the density first comes, from the right, to the mean of both sides of the incident shock. */
static double front_of(const bench *t, int j)
{
    const mesh *m = t->sim->ice->mesh;
    const double half = 4.7;
    int i = m->n[0] - 1;
    while (i > 0 && value_of(t, C_RHO, i, j) < half) i--;
    const double here = value_of(t, C_RHO, i, j), next = value_of(t, C_RHO, i + 1, j);
    return mesh_centre(m, 0, i) + (here - half) / (here - next) * m->h[0];
}

typedef struct reflection {
    double incident, foot, foot_at_half, along_top, largest; /* cells, m, m, kg/m3, kg/m3 */
} reflection;

/* At t = 0.2: how far the shock above the pattern is from its exact place, in cells; where the stem's foot is; how far the gas
 * behind the shock is from its state below the upper side. */
static reflection reflect(const char *cells)
{
    bench t;
    reflection r = {0};
    begin_with(&t, cells);
    while (t.sim->time < 0.1) check_ok(t.ctx, sim_step(t.sim, 0.1));
    r.foot_at_half = front_of(&t, 0);
    while (t.sim->time < 0.2) check_ok(t.ctx, sim_step(t.sim, 0.2));
    const mesh *m = t.sim->ice->mesh;
    const int high = (int)(0.8 * m->n[1]);
    r.incident = (front_of(&t, high) - 1.0 / 6.0 - (20.0 * 0.2 + mesh_centre(m, 1, high)) / sqrt(3.0)) / m->h[0];
    r.foot = front_of(&t, 0);
    for (int i = 0; i < 2 * m->n[1]; ++i)
        r.along_top = fmax(r.along_top, fabs(value_of(&t, C_RHO, i, m->n[1] - 1) - 8.0));
    for (int j = 0; j < m->n[1]; ++j)
        for (int i = 0; i < m->n[0]; ++i) r.largest = fmax(r.largest, value_of(&t, C_RHO, i, j));
    end(&t);
    return r;
}

/* The flow has no length but that to the corner from which it starts: the stem's foot is twice as far from there in twice the time, and
 * ahead of where the incident shock would meet the wall, which is exact at 2.476. Measured: 0.03 and 0.25 cells. */
static void check_self_similar(const reflection *r, double h)
{
    check_close(r->foot - 2.0 * r->foot_at_half + 1.0 / 6.0, 0.0, 0.5 * h);
    assert_true(r->foot > 1.0 / 6.0 + 4.0 / sqrt(3.0));
}

/* Measured with 30 and 60 cells a unit: the shock 0.42 and 0.41 cells ahead, the gas below the side 1.1e-2 and 6e-4 off, the foot at
 * 2.763 and 2.770 (2.783 with 120), the largest density 19.92 and 20.52 (20.78; contours of this flow are drawn up to 20.92). */
static void test_double_mach(void **state)
{
    (void)state;
    const reflection coarse = reflect("30"), fine = reflect("60");
    assert_true(fabs(coarse.incident) < 0.6 && fabs(fine.incident) < 0.6);
    assert_true(coarse.along_top < 2e-2 && fine.along_top < 1.2e-3);
    check_self_similar(&coarse, 1.0 / 30.0);
    check_self_similar(&fine, 1.0 / 60.0);
    check_close(coarse.largest, 20.92, 1.5);
    check_close(fine.largest, 20.92, 0.6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_double_mach)};
    deck_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}

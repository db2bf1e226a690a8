/* A bubble of air in water that swings (theory 2.17): gas that no shock has met keeps its entropy, also in the cells that it shares with water, and at the turn
 * both are at rest. */
#include "deck_run_fixture.h"

static const char deck[] =
    "floe: 1\ncoupling: ice\n"
    "domain: {dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.3, 0.3], cell: 0.00625}\n"
    "boundaries: {r: {lower: symmetry, upper: {outlet: {pressure: 1e5}}}, z: {lower: symmetry, upper: {outlet: "
    "{pressure: 1e5}}}}\n"
    "materials: {water: {eos: {stiffened: {gamma: 4.4, p_inf: 2.2e6, specific_heat: 10}}}, air: {eos: {ideal: {gamma: "
    "1.4, "
    "specific_heat: 717.5}}}}\n"
    "ambient: {material: water, pressure: 1e5, temperature: 67}\n"
    "bodies: {bubble: {material: air, shape: {ball: {centre: [0, 0], radius: 0.1}}, pressure: 1.2e5, temperature: "
    "300}}\n"
    "time: {end: 1}\n";

/* Largest relative change of p v^gamma of the air in cells of which it has a hundredth, and the fastest of all cells there. */
static void look(const bench *t, double *entropy, double *fastest)
{
    const double first = 717.5 * 300.0 * pow(0.4 * 717.5 * 300.0 / 1.2e5, 0.4);
    const mesh *m = &t->sim->mesh;
    *entropy = *fastest = 0.0;
    for (int id = 0; id < m->n_blocks; ++id) {
        const block *b = &m->block[id];
        const fields *f = t->sim->domain->fields[id];
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, 0);
                const double v = field_get(f, C_VOL, 1, 0)[at];
                if (field_get(f, C_RHO, 1, 0)[at] * v < 0.01) continue;
                const double now = field_get(f, C_ENERGY, 1, 0)[at] * pow(v, 0.4);
                *entropy = fmax(*entropy, fabs(now / first - 1.0));
                *fastest = fmax(*fastest, hypot(field_get(f, C_VEL, 1, 0)[at], field_get(f, C_VEL, 1, 1)[at]));
            }
    }
}

/* Half a period is 14 ms. */
static void test_swing(void **state)
{
    (void)state;
    bench t;
    double entropy, fastest;
    begin(&t, deck, NULL, 0);
    run_until(&t, 14e-3);
    look(&t, &entropy, &fastest);
    print_message("entropy of the air off by %.3g at the turn, fastest cell %.3g m/s\n", entropy, fastest);
    check_true(entropy < 1.5e-4);
    check_true(fastest < 0.2);
    check_drifts(&t, 1e-12);
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_swing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

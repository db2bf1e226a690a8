/* Viscosity and conduction of fluids that share cells beside solids with sharp surfaces: two layers between walls against the exact profile; the
 * same at rest under gravity about bodies; heat between two liquids, and in one; nothing made or lost, for any blocks, any threads and after a
 * restart. */
#include "coupled_fixture.h"

#define LIQUID(name, more) \
    "materials." name "={eos: {acoustic: {density: 1, sound_speed: 10, pressure: 1, specific_heat: 1}}, " more "}"
#define WALL \
    "materials.plate={density: 5, specific_heat: 1, law: {linear_elastic: {bulk_modulus: 1e4, shear_modulus: 5e3}}}"
#define NO_AIR "bodies.behind=null", "materials.air=null", "method=null", "reference_pressure=1"

static void begin(trial *t, const char *const *set, size_t n)
{
    deck_begin(t, "shock_plate", set, n);
    check_true(t->scene->method.interface == INTERFACE_SHARP);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

/* Values of the open cells of a field in order of their number; the others are NAN. */
static double *gather_open(const trial *t, field_id id, int instance)
{
    const size_t n = mesh_cells(&t->sim->mesh);
    double *x = malloc(2 * n * sizeof *x);
    assert_non_null(x);
    gather_cells(t->sim, id, instance, 0, 1, x);
    gather_cells(t->sim, C_OPEN, 0, 0, 1, x + n);
    for (size_t k = 0; k < n; ++k)
        if (!(x[n + k] > 0.0)) x[k] = NAN;
    return x;
}

/* ---- two layers between walls ---- */

typedef struct layers {
    double height, middle, force, mu[2]; /* mu[0] below the middle */
} layers;

/* mu u'' = -force in both, u and mu u' go on over the interface, no slip (Batchelor 1967, section 4.2). */
static double layers_velocity(const layers *l, double y)
{
    const double s = l->middle, d = l->height - s, f = l->force, *mu = l->mu;
    const double shear =
        f * (0.5 * d * d / mu[1] - 0.5 * s * s / mu[0]) / (s / mu[0] + d / mu[1]); /* at the interface */
    if (y < s) return ((shear + f * s) * y - 0.5 * f * y * y) / mu[0];
    return ((f * d - shear) * (l->height - y) - 0.5 * f * pow(l->height - y, 2.0)) / mu[1];
}

/* Mean error of the velocity, of its maximum. Walls at y = 1/4 and 1 1/4. */
static double layers_error(const char *cell, const char *const *place, double below, double middle)
{
    const char *set[] = {NO_AIR,
                         LIQUID("oil", "viscosity: {shear: 0.1}"),
                         LIQUID("tar", "viscosity: {shear: 0.4}"),
                         WALL,
                         "ambient={material: oil, pressure: 1.0, temperature: 1, velocity: [0.2, 0]}",
                         cell,
                         "boundaries={x: {outlet: {pressure: 1.0}}, y: symmetry}",
                         "loads={drive: {gravity: {acceleration: [0.8, 0]}}}",
                         place[0],
                         place[1],
                         place[2]};
    trial t;
    begin(&t, set, sizeof set / sizeof *set);
    check_true(t.scene->fluids_share);
    trial_run(&t, 4.0);
    const layers flow = {1.0, middle - below, 0.8, {0.1, 0.4}};
    const mesh *m = &t.sim->mesh;
    double *oil = gather_open(&t, C_VEL, 0), *tar = gather_open(&t, C_VEL, 1), *part = gather_open(&t, C_RHO, 0);
    double sum = 0.0, largest = 0.0;
    int n = 0;
    for (int j = 0; j < m->n[1]; ++j) {
        const int k = j * m->n[0] + 1;
        const double y = mesh_centre(m, 1, j) - below;
        if (isnan(part[k]) || !(y > 0.0 && y < 1.0)) continue;
        const double u = layers_velocity(&flow, y);
        sum += fabs((part[k] > 0.5 ? oil : tar)[k] - u);
        largest = fmax(largest, u);
        ++n;
    }
    free(oil);
    free(tar);
    free(part);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 1e-11);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-12);
    trial_end(&t);
    return sum / n / largest;
}

#define CHANNEL(cell) "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.25, 1.5], cell: " cell "}"

/* Walls and interface on sides of cells: exact but for the cells at the interface. Measured: 0.65 and 0.10 %, both walls alike. */
static void test_layers(void **unused)
{
    (void)unused;
    static const char *const place[] = {
        "bodies.plate={material: plate, shape: {box: {lower: [0, 0], upper: [0.25, 0.25]}}, motion: fixed}",
        "bodies.lid={material: plate, shape: {box: {lower: [0, 1.25], upper: [0.25, 1.5]}}, motion: fixed}",
        "bodies.tar={material: tar, shape: {box: {lower: [0, 0.75], upper: [0.25, 1.25]}}, pressure: 1.0, "
        "temperature: 1, "
        "velocity: [0.2, 0]}"};
    const double coarse = layers_error(CHANNEL("0.125"), place, 0.25, 0.75),
                 fine = layers_error(CHANNEL("0.0625"), place, 0.25, 0.75);
    print_message("two layers: velocity off by %.4f and %.4f of its maximum\n", coarse, fine);
    check_true(coarse < 0.013);
    check_true(fine < 0.002);
    check_true(log2(coarse / fine) > 1.5);
}

/* ---- rest ---- */

/* Water and air, both as viscous as oil, about a disc across the water's surface. */
static void test_rest(void **unused)
{
    (void)unused;
    const char *set[] = {
        "ambient={material: air, pressure: 1e5, temperature: 300}",
        "bodies.behind=null",
        "method=null",
        "materials.water={eos: {stiffened: {gamma: 4.4, p_inf: 6e8, specific_heat: 1816}}, viscosity: {shear: 1}, "
        "conductivity: 0.6}",
        "materials.air.viscosity={shear: 0.01}",
        "materials.air.conductivity=0.03",
        "materials.plate={density: 2700, specific_heat: 900, law: {linear_elastic: {bulk_modulus: 4e9, shear_modulus: "
        "2e9}}}",
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 1], cell: 0.05}",
        "boundaries={x: symmetry, y: no_slip}",
        "loads={fall: {gravity: {acceleration: [0, -10]}}}",
        "bodies.sea={material: water, shape: {box: {lower: [0, 0], upper: [1, 0.5]}}, pressure: 1e5, temperature: 300}",
        "bodies.plate={material: plate, shape: {ball: {centre: [0.51, 0.57], radius: 0.23}}, motion: fixed}"};
    trial t;
    ice_totals sum;
    double most = 0.0;
    begin(&t, set, sizeof set / sizeof *set);
    trial_steps(&t, 400);
    check_ok(t.ctx, ice_sum(t.sim->ice, &sum));
    for (int r = 0; r < 2; ++r) most = fmax(most, sqrt(2.0 * sum.kinetic[r] / sum.mass[r]));
    print_message("at rest: %.2g m/s\n", most);
    check_true(most < 4e-9);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-13);
    trial_end(&t);
}

/* ---- heat ---- */

/* Two liquids at 1 and 2 K, of k = 0.1 and 0.4, meet at x = 1: until heat reaches the walls each has half an error function, and between them is
 * T = (sqrt k T + sqrt k' T')/(sqrt k + sqrt k') (Carslaw and Jaeger 1959, section 2.15). Walls of points keep all of it. Returns the mean error. */
static double heat_error(const char *cell, const char *second, double k1, double k2)
{
    const char *set[] = {NO_AIR,
                         LIQUID("oil", "conductivity: 0.1"),
                         LIQUID("tar", "conductivity: 0.4"),
                         WALL,
                         "ambient={material: oil, pressure: 1.0, temperature: 1}",
                         cell,
                         "boundaries={x: symmetry}",
                         "bodies.plate={material: plate, shape: {box: {lower: 0, upper: 0.25}}, motion: fixed}",
                         "bodies.lid={material: plate, shape: {box: {lower: 1.75, upper: 2}}, motion: fixed}",
                         second};
    const double T1 = 1.0, T2 = 2.0, e1 = sqrt(k1), e2 = sqrt(k2), middle = (e1 * T1 + e2 * T2) / (e1 + e2), end = 0.08;
    trial t;
    begin(&t, set, sizeof set / sizeof *set);
    trial_run(&t, end);
    const mesh *m = &t.sim->mesh;
    const int other = t.sim->ice->n_materials - 1;
    check_ok(t.ctx, ice_refresh(t.sim->ice));
    double *e[2] = {gather_open(&t, C_ENERGY, 0), gather_open(&t, C_ENERGY, other)}, sum = 0.0;
    int n = 0;
    for (int i = 0; i < m->n[0]; ++i) {
        const double x = mesh_centre(m, 0, i) - 1.0;
        if (isnan(e[0][i]) || fabs(x) > 0.5) continue;
        const double k = x < 0.0 ? k1 : k2, far = x < 0.0 ? T1 : T2;
        sum += fabs(e[x > 0.0][i] - middle - (far - middle) * erf(fabs(x) / sqrt(4.0 * k * end)));
        ++n;
    }
    free(e[0]);
    free(e[1]);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    trial_end(&t);
    return sum / n;
}

#define LINE(cell) "domain={dim: 1, stress_state: uniaxial_strain, lower: 0, upper: 2, cell: " cell "}"

/* Measured: 0.20 and 0.034 % of a kelvin; 0.04. */
static void test_heat(void **unused)
{
    (void)unused;
    static const char *const hot =
        "bodies.hot={material: %s, shape: {box: {lower: 1, upper: 1.75}}, pressure: 1.0, temperature: 2}";
    char tar[160], oil[160];
    (void)snprintf(tar, sizeof tar, hot, "tar");
    (void)snprintf(oil, sizeof oil, hot, "oil");
    const double coarse = heat_error(LINE("0.0625"), tar, 0.1, 0.4), fine = heat_error(LINE("0.03125"), tar, 0.1, 0.4);
    const double one = heat_error(LINE("0.03125"), oil, 0.1, 0.1);
    print_message("two liquids: temperature off by %.4f and %.4f; one by %.4f\n", coarse, fine, one);
    check_true(coarse < 0.004);
    check_true(fine < 0.0007);
    check_true(one < 0.0008);
}

/* ---- the same bits ---- */

#define BOX(cell) "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 0.4], cell: " cell "}"

/* Air of 50 bar drives a plate into water, both viscous and conducting. */
static void shock_begin(trial *t, const char *box, int blocks)
{
    const char *set[] = {
        "ambient={material: air, pressure: 1e5, temperature: 300}",
        "bodies.behind=null",
        "method=null",
        "materials.water={eos: {stiffened: {gamma: 4.4, p_inf: 6e8, specific_heat: 1816}}, viscosity: "
        "{shear: 300}, conductivity: 5e4}",
        "materials.air.viscosity={shear: 3, bulk: 1}",
        "materials.air.conductivity=1e3",
        "materials.plate={density: 2700, specific_heat: 900, law: {linear_elastic: {bulk_modulus: "
        "70e9, shear_modulus: 26e9}}}",
        box,
        "boundaries={x: {outlet: {pressure: 1e5}}, y: slip}",
        "bodies.plate={material: plate, shape: {box: {lower: [0.4031, 0.1007], upper: [0.4531, 0.2993]}}}",
        "bodies.driver={material: air, shape: {box: {lower: [0.05, 0], upper: [0.25, 0.4]}}, "
        "pressure: 50e5, temperature: 600}",
        "bodies.sea={material: water, shape: {box: {lower: [0.4531, 0.13], upper: [0.6, 0.27]}}, "
        "pressure: 1e5, density: 1000}"};
    deck_begin(t, "shock_plate", set, sizeof set / sizeof *set);
    check_true(t->scene->fluids_share);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
}

static void test_shock(void **unused)
{
    (void)unused;
    trial t;
    mpm_totals m;
    shock_begin(&t, BOX("0.05"), 1);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_run(&t, 4e-4);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    print_message("shock: across %.1e of the momentum along; drift of energy %.1e\n",
                  fabs(m.momentum[0][1]) / m.momentum[0][0], ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
    check_true(fabs(m.momentum[0][1]) <
               5.6e-6 * m.momentum[0][0]); /* round-off: the interface is unstable behind the shock */
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-11);
    /* Measured: 1.7e-10; 8.3e-12 with centred faces, but 4.3e-10 with them where outputs end other steps: traces of air in the water, not understood. */
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 3.4e-10);
    trial_end(&t);
}

static state run(int blocks, int threads, const char *path)
{
    trial t;
    shock_begin(&t, BOX("0.025"), blocks);
    use_threads(threads);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_steps(&t, 25);
    if (path) { /* written, and read into another run with other blocks */
        check_ok(t.ctx, io_init(t.ctx));
        write_checkpoint(&t, path);
        trial_end(&t);
        shock_begin(&t, BOX("0.025"), 1);
        check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
        read_checkpoint(&t, path);
    }
    trial_steps(&t, 25);
    return trial_finish(&t);
}

static void test_bits(void **unused)
{
    (void)unused;
    same_bits_however_run(run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layers), cmocka_unit_test(test_rest), cmocka_unit_test(test_heat),
        cmocka_unit_test(test_shock),  cmocka_unit_test(test_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

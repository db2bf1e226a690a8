/* Viscous fluids beside sharp walls that lie anywhere in their cells (theory 7.6): flow between plates and in a pipe, between turning cylinders. */
#include "coupled_fixture.h"

#define LIQUID(mu) \
    "materials.liquid={eos: {acoustic: {density: 1, sound_speed: 10, pressure: 1, specific_heat: 1}}, viscosity: {shear: " mu "}}"
#define WALL \
    "materials.plate={density: 5, specific_heat: 1, law: {linear_elastic: {bulk_modulus: 1e4, shear_modulus: 5e3}}}"
#define PLAIN "bodies.behind=null", "materials.air=null", "method=null", "reference_pressure=1"

static void begin(trial *t, const char *const *set, size_t n)
{
    deck_begin(t, "shock_plate", set, n);
    check_true(t->scene->method.interface == INTERFACE_SHARP);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

/* Component of a velocity in all cells, NAN in those that are not open by more than `least`. */
static double *gather_velocity(const trial *t, int component, double least)
{
    const size_t n = mesh_cells(&t->sim->mesh);
    double *x = malloc(2 * n * sizeof *x);
    assert_non_null(x);
    gather_cells(t->sim, C_VEL, 0, component, 1, x);
    gather_cells(t->sim, C_OPEN, 0, 0, 1, x + n);
    for (size_t k = 0; k < n; ++k)
        if (!(x[n + k] > least)) x[k] = NAN;
    return x;
}

/* Errors of the whole cells that lie by more than a cell from the walls, the largest of the maximum, and of the volume that flows. */
typedef struct errors {
    double velocity, flow;
} errors;

#define CHANNEL "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [%g, 1.5], cell: %.17g}"

static errors channel_error(int n, double offset, bool shear)
{
    char box[160], plate[160], lid[200];
    const double h = 1.0 / n, below = 0.25 + offset * h;
    (void)snprintf(box, sizeof box, CHANNEL, 4.0 * h, h);
    (void)snprintf(plate, sizeof plate,
                   "bodies.plate={material: plate, shape: {box: {lower: [0, 0], upper: [%g, %.17g]}}, motion: fixed}", 4.0 * h,
                   below);
    (void)snprintf(lid, sizeof lid,
                   "bodies.lid={material: plate, shape: {box: {lower: [%s, %.17g], upper: [%s, 1.5]}}, motion: %s}", "-9",
                   below + 1.0, shear ? "9" : "9", shear ? "{velocity: [1, 0]}" : "fixed");
    const char *set[] = {PLAIN, LIQUID("0.1"), WALL,
                         "ambient={material: liquid, pressure: 1.0, temperature: 1, velocity: [0.2, 0]}", box,
                         "boundaries={x: {outlet: {pressure: 1.0}}, y: symmetry}",
                         shear ? "loads={}" : "loads={drive: {gravity: {acceleration: [0.8, 0]}}}", plate, lid};
    trial t;
    begin(&t, set, sizeof set / sizeof *set);
    trial_run(&t, 6.0);
    const mesh *m = &t.sim->mesh;
    double *u = gather_velocity(&t, 0, 0.0), *open = u + mesh_cells(m), flow = 0.0;
    errors e = {0.0, 0.0};
    for (int j = 0; j < m->n[1]; ++j) {
        const int k = j * m->n[0] + 1;
        const double y = mesh_centre(m, 1, j) - below;
        if (getenv("SHOW")) print_message("%d %g %g %.6f %.6f\n", j, y, open[k], u[k], shear ? y : 4.0 * y * (1.0 - y));
        if (isnan(u[k])) continue;
        flow += open[k] * u[k] * h;
        if (!(y > 1.5 * h && y < 1.0 - 1.5 * h)) continue;
        e.velocity = fmax(e.velocity, fabs(u[k] - (shear ? y : 4.0 * y * (1.0 - y))));
    }
    e.flow = fabs(flow / (shear ? 0.5 : 2.0 / 3.0) - 1.0);
    free(u);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 1e-11);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-12);
    trial_end(&t);
    return e;
}

static void test_channel(void **unused)
{
    (void)unused;
    static const double offset[] = {0.0, 0.02, 0.1, 0.3, 0.48, 0.52, 0.7, 0.97};
    for (int k = 0; k < 8; ++k) {
        const errors coarse = channel_error(16, offset[k], false), fine = channel_error(32, offset[k], false);
        print_message("channel %.2f: velocity %.5f %.5f, flow %.5f %.5f\n", offset[k], coarse.velocity, fine.velocity,
                      coarse.flow, fine.flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_channel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

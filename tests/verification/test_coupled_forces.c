/* Forces of fluids on bodies beside a sharp interface: a block in a channel whose surface lies on faces of the mesh has the lift of its mirror image; a plate whose
 * end lies within cells that of one on faces; a disc that deforms is lifted by the weight of what it displaces (Archimedes). A disc that drifts past a change of the
 * cells with which others are merged leaves the pressure as it is. */
#include "coupled_fixture.h"

#include "mpm/surface/boundary.h"

/* Force on a block in a viscous stream, off the middle of a channel. */
static void push_block(const char *pressure, const char *body, double force[3])
{
    const char *set[] = {"domain.upper=[4, 2]",
                         "domain.cell=0.1",
                         "constants={height: 2, top: 1.5}",
                         pressure,
                         "time={end: 1, cfl: 0.5, first_step: 0.01}",
                         body};
    trial t;
    double moment[3];
    deck_begin(&t, "cylinder_channel", set, sizeof set / sizeof *set);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_run(&t, 1.0);
    check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
    trial_end(&t);
}

/* Measured: drags apart by 0.0076 and 0.0019 (implicit and explicit), lifts by 0.0074 and 0.0048 of the drag. With corners that fluid passes, 0.0098 and
 * 0.076; with the drag on surfaces in covered cells that of any cell beside them, too, 0.015 and 0.0032 (implicit). */
static void test_mirror(void **unused)
{
    (void)unused;
    static const char *const method[] = {"method={interface: sharp, pressure: implicit}", "method={interface: sharp}"};
    for (int k = 0; k < 2; ++k) {
        double low[3], high[3];
        push_block(method[k],
                   "bodies.cylinder={material: steel, shape: {box: {lower: [1, 0.7], upper: [2, 0.9]}}, motion: fixed}",
                   low);
        push_block(method[k],
                   "bodies.cylinder={material: steel, shape: {box: {lower: [1, 1.1], upper: [2, 1.3]}}, motion: fixed}",
                   high);
        print_message("drag %.6g and %.6g, lift %.6g and %.6g\n", low[0], high[0], low[1], high[1]);
        check_close(high[0] / low[0], 1.0, k == 0 ? 0.0148 : 4e-3);
        check_close((high[1] + low[1]) / low[0], 0.0, k == 0 ? 0.0148 : 9.4e-3);
    }
}

/* A plate of two cells in a stream (Reynolds number 6 of its thickness), its end half way along a cell, 0.08 of a cell of fluid of one row beneath it; it
 * is 0.04 of a cell off the middle of the channel, which on rows of the mesh is 0.011 N of lift, for 6.8 N of drag. Measured: off by 0.031 N. With pressure and
 * shear of the cell behind the end on all of its pieces, and fluid that passes beneath them, by 0.225. */
static void test_end_within(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.8, 0.4], cell: 0.01}",
        "boundaries={x: {lower: {inlet: {velocity: [0.3, 0], pressure: 1e5, temperature: 300}}, "
        "upper: {outlet: {pressure: 1e5}}}, y: slip}",
        "ambient={material: liquid, pressure: 1e5, temperature: 300, velocity: [0.3, 0]}",
        "bodies.body={material: rubber, shape: {box: {lower: [0.2, 0.1908], upper: [0.405, 0.21]}}, motion: fixed}"};
    trial t;
    double force[3], moment[3];
    deck_begin(&t, "turek_hron_cfd", set, sizeof set / sizeof *set);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_run(&t, 6.0);
    check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
    print_message("plate: drag %.5g, lift %.5g\n", force[0], force[1]);
    check_close(force[1], -0.0113, 0.06);
    trial_end(&t);
}

/* Largest change of pressure (Pa) in a step in cells that have fluid before and after it. */
static double largest_jump(trial *t)
{
    enum { CELLS = 32 * 16 };
    static double before[CELLS], was_open[CELLS];
    const block *b = &t->sim->mesh.block[0];
    const fields *f = t->sim->domain->fields[0];
    double most = 0.0;
    for (int step = 0; step < 2; ++step) {
        const double *p = field_get(f, C_PRESSURE, 0, 0), *open = field_get(f, C_OPEN, 0, 0);
        for (int n = 0; n < CELLS; ++n) {
            const ptrdiff_t at = mesh_index(b, n % 32, n / 32, 0);
            if (step > 0 && open[at] > 0.0 && was_open[n] > 0.0) most = fmax(most, fabs(p[at] - before[n]));
            before[n] = p[at];
            was_open[n] = open[at];
        }
        if (step == 0) trial_steps(t, 1);
    }
    return most;
}

/* A disc that drifts along in water with a hundredth of the stream's speed, past the place where cells of its circle that are as open towards both axes change
 * the neighbour with which they are merged. Measured: 175 Pa in a step (rho h/dt is 1e4 Pa s/m, the stream has 0.1 m/s). With what each member has alone handed on, 1e7. */
static void test_hosts(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1.6, 0.8], cell: 0.05, blocks: [1, 1]}",
        "boundaries={x: {lower: {velocity: {velocity: [0.1, 0]}}, upper: {outlet: {pressure: 1e5}}}, y: symmetry}",
        "materials.water={eos: {stiffened: {gamma: 4.4, p_inf: 5.11e8, specific_heat: 1000}}}",
        "materials.air=null",
        "ambient={material: water, pressure: 1e5, temperature: 150.3235294117647}",
        "bodies.behind=null",
        "bodies.plate={material: plate, shape: {ball: {centre: [0.39985, 0.4], radius: 0.19}}, motion: {times: [0, 1], "
        "velocities: [[1e-3, 0], [1e-3, 0]]}}",
        "time={end: 1, first_step: 5e-3, max_step: 5e-3, acoustic_cfl: 1e6}",
        "method={interface: sharp, pressure: implicit}"};
    trial t;
    double most = 0.0;
    deck_begin(&t, "shock_plate", set, sizeof set / sizeof *set);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_steps(&t, 10);
    for (int k = 0; k < 50; ++k) most = fmax(most, largest_jump(&t));
    print_message("hosts change: %.3g Pa in a step, momentum %.1g, energy %.1g\n", most,
                  ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y),
                  ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
    check_true(most < 350.0);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    trial_end(&t);
}

/* Largest change of density, over 1000 kg/m3, in cells with fluid. */
static double densest_change(const trial *t)
{
    double most = 0.0;
    for (int id = 0; id < t->sim->mesh.n_blocks; ++id) {
        const block *b = &t->sim->mesh.block[id];
        const double *rho = field_get(t->sim->domain->fields[id], C_RHO, 0, 0),
                     *open = field_get(t->sim->domain->fields[id], C_OPEN, 0, 0);
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, 0);
                if (open[at] > 0.0) most = fmax(most, fabs(rho[at] / 1000.0 - 1.0));
            }
    }
    return most;
}

/* A block that moves evenly through a closed tank of liquid, its corners within cells: what its pieces sweep passes the faces that they shade, so that densities
 * stay. Measured: 2.3e-9 at most; where it stays in the cells of which it is swept, 6.9e-4. */
static void test_swept(void **unused)
{
    (void)unused;
    const char *set[] = {"domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 0.7], cell: 0.05}",
                         "boundaries=slip",
                         "ambient={material: liquid, pressure: 1e5, temperature: 300}",
                         "materials.liquid.eos.acoustic.sound_speed=1000",
                         "bodies.body={material: rubber, shape: {box: {lower: [0.31, 0.246], upper: [0.528, 0.463]}}, "
                         "motion: {velocity: [0.01, 0.004]}}",
                         "time={end: 0.5, first_step: 0.01, max_step: 0.01, acoustic_cfl: 1e9}"};
    trial t;
    double most = 0.0;
    deck_begin(&t, "turek_hron_cfd", set, sizeof set / sizeof *set);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_run(&t, 0.1);
    while (t.sim->time < 0.495) {
        trial_steps(&t, 1);
        most = fmax(most, densest_change(&t));
    }
    print_message("swept: densities change by %.3g at most\n", most);
    check_true(most < 4.5e-9);
    trial_end(&t);
}

/* A cylinder that moves slowly in a concentric one, the gap 4.8 cells: 4 pi mu U/(ln(b/a) - (b^2 - a^2)/(b^2 + a^2)) of Stokes' flow (Slezkin 1955; Happel and Brenner,
 * Low Reynolds Number Hydrodynamics, 1965). Measured: 4.9 % short; before viscosity moved the faces 9.1 %, and it changed where a step was a quarter
 * of the one before. */
static void test_stokes(void **unused)
{
    (void)unused;
    const double a = 0.2107, b = 0.4503,
                 right = 4.0 * 3.14159265358979323846 * 0.1 * 1e-3 / (log(b / a) - (b * b - a * a) / (b * b + a * a));
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [-0.5, -0.5], upper: [0.5, 0.5], cell: 0.05}",
        "boundaries={x: symmetry, y: symmetry}",
        "ambient={material: liquid, pressure: 1.0, temperature: 1}",
        "materials.liquid.viscosity.shear=0.1",
        "method={pressure: implicit}",
        "bodies.cylinder={material: steel, shape: {ball: {centre: [0.011, 0.007], radius: 0.2107}}, "
        "motion: {velocity: [1e-3, 0]}}",
        "bodies.outer={material: steel, shape: {difference: {of: {box: {lower: [-0.5, -0.5], upper: [0.5, 0.5]}}, "
        "without: [{ball: {centre: [0.011, 0.007], radius: 0.4503}}]}}, motion: fixed}"};
    trial t;
    double force[3], next[3], moment[3];
    deck_begin(&t, "cylinder_channel", set, sizeof set / sizeof *set);
    check_true(t.scene->method.interface == INTERFACE_SHARP);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_run(&t, 0.6);
    trial_steps(&t, 2);
    check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
    check_ok(t.ctx, sim_step(t.sim, t.sim->time + 0.25 * 0.0021));
    check_true(mpm_motion_force(t.sim->mpm, 0, next, moment));
    print_message("Stokes: force off by %.4f, by %.4f after a short step\n", -force[0] / right - 1.0,
                  -next[0] / right - 1.0);
    check_close(-force[0] / right, 1.0, 0.075);
    check_close(next[0] / force[0], 1.0, 8e-3);
    trial_end(&t);
}

/* Measured: 0.0028 short, 0.0017 across. */
static void test_floating(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 1], cell: 0.05}",
        "boundaries={x: symmetry, y: symmetry}",
        "ambient={material: liquid, pressure: 100.0, temperature: 1}",
        "reference_pressure=100",
        "materials.liquid={eos: {acoustic: {density: 1, sound_speed: 20, pressure: 100, specific_heat: 1}}}",
        "materials.steel.density=1",
        "loads={weight: {gravity: {acceleration: [0, -2]}}}",
        "bodies.cylinder={material: steel, shape: {ball: {centre: [0.51, 0.47], radius: 0.23}}}"};
    trial t;
    double force[3];
    deck_begin(&t, "cylinder_channel", set, sizeof set / sizeof *set);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    check_true(mpm_boundary_sum_force(t.sim->mpm, 0, force));
    check_close(force[1], 0.0, 0.0);
    trial_steps(&t, 1);
    check_true(mpm_boundary_sum_force(t.sim->mpm, 0, force));
    const double weight = 2.0 * 3.14159265358979323846 * 0.23 * 0.23;
    print_message("lift off by %.3g, across %.3g\n", force[1] / weight - 1.0, force[0] / weight);
    check_close_relative(force[1], weight, 5.6e-3);
    check_close(force[0] / weight, 0.0, 3.4e-3);
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_mirror), cmocka_unit_test(test_end_within),
                                       cmocka_unit_test(test_hosts),  cmocka_unit_test(test_swept),
                                       cmocka_unit_test(test_stokes), cmocka_unit_test(test_floating)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

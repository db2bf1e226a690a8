/* The implicit pressure beside sharp interfaces (theory 7.8), in steps of 70 to 2000 times that of sound: bodies whose acceleration is that of their mass and
 * of the liquid that they move (Lamb, Hydrodynamics, 6th ed. 1932, articles 68 and 92; a cylinder of radius a in a concentric one of b moves (b^2 + a^2)/(b^2 - a^2) of
 * the liquid that it displaces), driven, pushed, lifted; a column on a gas spring; plates that deform; the same bits however it is run. */
#include "coupled_fixture.h"

#define LIQUID "{eos: {stiffened: {gamma: 4.4, p_inf: 5.11e8, specific_heat: 1000}}}"      /* sound of 1500 m/s */
#define AMBIENT "ambient={material: water, pressure: 1e5, temperature: 150.3235294117647}" /* 1000 kg/m3 */
#define STIFF "law: {linear_elastic: {bulk_modulus: 1e9, shear_modulus: 5e8}}, specific_heat: 460"
#define METHOD "method={basis: quadratic, interface: sharp, pressure: implicit}"

static const double INNER = 0.2107, OUTER = 0.4503;

static void begin_with(trial *t, const char *const *common, size_t n_common, const char *const *set, size_t n_set)
{
    const char *all[32];
    assert_true(n_common + n_set <= 32);
    memcpy(all, common, n_common * sizeof *all);
    memcpy(all + n_common, set, n_set * sizeof *set);
    deck_begin(t, "shock_plate", all, n_common + n_set);
}

static void start(trial *t)
{
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

static double iterations_of(const trial *t)
{
    return (double)t->sim->ledger.count[COUNT_CG_ITERATIONS] / (double)t->sim->ledger.count[COUNT_PRESSURE_SOLVES];
}

static void check_conserved(trial *t)
{
    check_true(ledger_worst(t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-11);
    check_true(ledger_worst(t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 3e-10); /* of what has moved */
    check_true(ledger_worst(t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
}

/* ---- a cylinder in liquid within a fixed one ---- */

static double added(void)
{
    return (OUTER * OUTER + INNER * INNER) / (OUTER * OUTER - INNER * INNER);
}

/* Half of it, above its mirror. */
static void annulus_begin(trial *t, double cell, double ratio, const char *motion, const char *load)
{
    static const char *common[] = {
        "boundaries={x: symmetry, y: symmetry}",
        "materials.water=" LIQUID,
        "materials.air=null",
        "materials.plate=null",
        "materials.wall={density: 7800, " STIFF "}",
        AMBIENT,
        "bodies.behind=null",
        "bodies.plate=null",
        "bodies.wall={material: wall, shape: {difference: {of: {box: {lower: [-0.5, -0.5], upper: [0.5, 0.5]}}, "
        "without: [{ball: {centre: [0, 0], radius: 0.4503}}]}}, motion: fixed}",
        "time={end: 1, cfl: 0.4, first_step: 1e-3, max_step: 1e-3, acoustic_cfl: 1e6}",
        METHOD};
    char cells[160], core[160], body[200];
    (void)snprintf(cells, sizeof cells,
                   "domain={dim: 2, stress_state: plane_strain, lower: [-0.5, 0], upper: [0.5, 0.5], cell: %g}", cell);
    (void)snprintf(core, sizeof core, "materials.core={density: %.17g, " STIFF "}", 1000.0 * ratio);
    (void)snprintf(body, sizeof body,
                   "bodies.core={material: core, shape: {ball: {centre: [0, 0], radius: 0.2107}}, motion: %s}", motion);
    const char *set[] = {cells, core, body, load};
    begin_with(t, common, sizeof common / sizeof *common, set, sizeof set / sizeof *set);
    start(t);
}

static double velocity_of_core(const trial *t)
{
    mpm_totals m;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &m));
    const int b = m.mass[0] > 0.0 && t->scene->material[t->sim->mpm->body[0].scene_material].density != 7800.0 ? 0 : 1;
    return m.momentum[b][0] / m.mass[b];
}

/* Acceleration over the second half, over the exact one; and iterations a solve. */
static double acceleration_off(double cell, double ratio, const char *load, double right, double *iterations)
{
    trial t;
    annulus_begin(&t, cell, ratio, "rigid", load);
    trial_run(&t, 0.01);
    const double half = velocity_of_core(&t);
    trial_run(&t, 0.02);
    const double off = (velocity_of_core(&t) - half) / (0.01 * right) - 1.0;
    *iterations = iterations_of(&t);
    print_message("h %g, ratio %g: acceleration off by %.2g, %.3g iterations, %ld steps\n", cell, ratio, off,
                  *iterations, t.sim->steps);
    check_conserved(&t);
    trial_end(&t);
    return off;
}

/* Measured: 0.010, 0.0062 and 1.6e-5; 8 iterations. */
static void test_pushed(void **unused)
{
    (void)unused;
    static const struct {
        double ratio, most;
    } cases[] = {{1e-3, 0.02}, {1.0, 0.012}, {1e3, 3.2e-5}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double r = cases[k].ratio;
        double iterations;
        const double off = acceleration_off(0.05, r, "loads={push: {body_force: {body: core, acceleration: [1, 0]}}}",
                                            r / (r + added()), &iterations);
        check_close(off, 0.0, cases[k].most);
        check_true(iterations < 16.0);
    }
}

/* Measured: 0.0093, 0.0084 with half the cells and 0.0014; 12.7 iterations and 13.6. */
static void test_lifted(void **unused)
{
    (void)unused;
    const char *weight = "loads={weight: {gravity: {acceleration: [-9.81, 0]}}}";
    for (int k = 0; k < 2; ++k) {
        const double r = k == 0 ? 1e-3 : 10.0;
        double iterations, finer;
        const double off = acceleration_off(0.05, r, weight, 9.81 * (1.0 - r) / (r + added()), &iterations);
        check_close(off, 0.0, k == 0 ? 0.018 : 0.0028);
        if (k == 0)
            check_close(acceleration_off(0.025, r, weight, 9.81 * (1.0 - r) / (r + added()), &finer), 0.0, 0.0165);
        if (k == 0) check_true(finer < 1.4 * iterations);
    }
}

/* Held, it bears the weight of what it displaces, and the liquid rests. Measured: 1.2e-4; 1e-15 m2/s2. */
static void test_held(void **unused)
{
    (void)unused;
    const double weight = 9.81 * 1000.0 * 0.5 * 3.14159265358979323846 * INNER * INNER;
    trial t;
    double force[3], moment[3], kinetic = 0.0;
    ice_totals sums;
    annulus_begin(&t, 0.025, 1.0, "fixed", "loads={weight: {gravity: {acceleration: [-9.81, 0]}}}");
    trial_run(&t, 0.05);
    const int core = t.scene->material[t.sim->mpm->body[0].scene_material].density != 7800.0 ? 0 : 1;
    check_true(mpm_motion_force(t.sim->mpm, core, force, moment));
    check_ok(t.ctx, ice_sum(t.sim->ice, &sums));
    for (int r = 0; r < t.sim->ice->n_materials; ++r) kinetic += sums.kinetic[r];
    print_message("lift off by %.2g, %.2g J\n", force[0] / weight - 1.0, kinetic);
    check_close_relative(force[0], weight, 2.4e-4);
    check_true(kinetic < 1e-13);
    trial_end(&t);
}

/* ---- a block that can turn ---- */

static double block_acceleration(const char *box)
{
    static const char *common[] = {"domain={dim: 2, lower: [0, 0], upper: [1.2, 1], cell: 0.025}",
                                   "boundaries={x: slip, y: slip}",
                                   "materials.water=" LIQUID,
                                   "materials.air=null",
                                   "materials.plate=null",
                                   "materials.wood={density: 300, " STIFF "}",
                                   AMBIENT,
                                   "bodies.behind=null",
                                   "bodies.plate=null",
                                   "loads={weight: {gravity: {acceleration: [0, -9.81]}}}",
                                   "time={end: 1, growth: 2, max_step: 4e-3}",
                                   METHOD};
    char body[160];
    trial t;
    mpm_totals m;
    (void)snprintf(body, sizeof body, "bodies.block={material: wood, shape: {box: {%s}}, motion: rigid}", box);
    const char *set[] = {body};
    begin_with(&t, common, sizeof common / sizeof *common, set, 1);
    start(&t);
    trial_run(&t, 0.03);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    const double half = m.momentum[0][1] / m.mass[0];
    trial_run(&t, 0.06);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    const double a = (m.momentum[0][1] / m.mass[0] - half) / 0.03;
    print_message("block: acceleration %.4g, %ld steps\n", a, t.sim->steps);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-11);
    trial_end(&t);
    return a;
}

/* A light block in a box of water, anywhere in its cells, rises by 9.81 (1000 - 300) 0.08/(24 + m) m/s2, m = 200.1 kg/m of water by potential flow in the
 * box (finite volumes of 1/480 of its width and less). Measured: 0.041, 0.019 and 0.016 off. With what turns it by a first guess of the pressure counted as turned,
 * not as a rate, the block shrank by half the square of the angle, and its water swung up from step to step: over 10 kJ for 2.4 J. */
static void test_turning(void **unused)
{
    (void)unused;
    static const char *const box[] = {"lower: [0.4, 0.4], upper: [0.8, 0.6]",
                                      "lower: [0.403, 0.404], upper: [0.803, 0.604]",
                                      "lower: [0.413, 0.401], upper: [0.813, 0.601]"};
    for (size_t k = 0; k < sizeof box / sizeof *box; ++k)
        check_close_relative(block_acceleration(box[k]), 9.81 * 56.0 / 224.1, 0.05);
}

/* ---- on a line ---- */

static void line_begin(trial *t, double cell, double step, const char *const *set, size_t n_set)
{
    static const char *common[] = {"materials.water=" LIQUID,
                                   "materials.air=null",
                                   "materials.plate=null",
                                   AMBIENT,
                                   "bodies.behind=null",
                                   "bodies.plate=null",
                                   METHOD};
    char cells[120], time[120];
    const char *all[16];
    (void)snprintf(cells, sizeof cells, "domain={dim: 1, stress_state: uniaxial_strain, lower: 0, upper: 1, cell: %g}",
                   cell);
    (void)snprintf(time, sizeof time, "time={end: 1, cfl: 0.4, first_step: %g, max_step: %g, acoustic_cfl: 1e6}", step,
                   step);
    assert_true(n_set + 2 <= 16);
    all[0] = cells;
    all[1] = time;
    memcpy(all + 2, set, n_set * sizeof *set);
    begin_with(t, common, sizeof common / sizeof *common, all, n_set + 2);
    start(t);
}

/* A piston draws a column of liquid behind it and drives another, ever faster, by 1 m/s2: rho a L. Measured: 0.0029. */
static void test_piston(void **unused)
{
    (void)unused;
    const char *set[] = {"boundaries={x: {lower: {outlet: {pressure: 1e5}}, upper: {outlet: {pressure: 1e5}}}}",
                         "materials.steel={density: 7800, " STIFF "}",
                         "bodies.piston={material: steel, shape: {box: {lower: 0.2037, upper: 0.3137}}, motion: "
                         "{times: [0, 1], velocities: [0, 1]}}"};
    trial t;
    double force[3], moment[3], worst = 0.0;
    line_begin(&t, 0.02, 1e-3, set, 3);
    trial_run(&t, 0.04);
    for (int k = 0; k < 20; ++k) {
        trial_steps(&t, 1);
        check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
        worst = fmax(worst, fabs(force[0] / -890.0 - 1.0));
    }
    print_message("piston: force off by %.2g\n", worst);
    check_true(worst < 0.0058);
    check_conserved(&t);
    trial_end(&t);
}

/* A rigid piston between air that is closed in and a column of water: what the air's spring makes of the mass of both, w^2 = gamma p/(l (rho L + m)).
 * Two fluids in one system. Returns how far w is off, and what a swing loses. */
static double swing_off(double step, double density, double *lost)
{
    char steel[200];
    (void)snprintf(steel, sizeof steel, "materials.steel={density: %g, " STIFF "}", density);
    const char *set[] = {
        "boundaries={x: {lower: symmetry, upper: {outlet: {pressure: 1e5}}}}", steel,
        "materials.gas={eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}",
        "bodies.gas={material: gas, shape: {box: {lower: 0, upper: 0.26}}, pressure: 1.002e5, temperature: 300}",
        "bodies.piston={material: steel, shape: {box: {lower: 0.2037, upper: 0.3137}}, motion: rigid}"};
    const double rest = 0.2037 * pow(1.002, 1.0 / 1.4), mass = 1000.0 * (0.8900 - rest) + 0.11 * density,
                 w = sqrt(1.4 * 1e5 / (rest * mass));
    trial t;
    mpm_totals m;
    double before = 0.0, at = 0.0, turn[2] = {0.0, 0.0}, way[2] = {0.0, 0.0};
    line_begin(&t, 0.02, step, set, 5);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    const double first = m.moment[0][0] / m.mass[0];
    for (int n = 0; n < 2;) {
        trial_steps(&t, 1);
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
        const double v = m.momentum[0][0] / m.mass[0], x = m.moment[0][0] / m.mass[0] - first;
        if (before * v < 0.0) { /* it turns */
            turn[n] = at + (t.sim->time - at) * before / (before - v);
            way[n++] = x;
        }
        before = v;
        at = t.sim->time;
    }
    *lost = 1.0 - (way[0] - way[1]) / way[0];
    const double off = 3.14159265358979323846 / (w * (turn[1] - turn[0])) - 1.0;
    print_message("swing at %g: frequency off by %.2g, loss %.3g\n", step, off, *lost);
    check_conserved(&t);
    trial_end(&t);
    return off;
}

/* Measured: 0.0012, 0.0014, 0.0004; a swing loses 9.1 and 4.8 %. */
static void test_gas_spring(void **unused)
{
    (void)unused;
    double lost, half;
    check_close(swing_off(2e-3, 1.0, &lost), 0.0, 2.4e-3);
    check_close(swing_off(1e-3, 1.0, &half), 0.0, 2.8e-3);
    check_true(lost > 0.0 && half > 0.0 && half < 0.6 * lost); /* first order in the step */
    check_close(swing_off(1e-3, 1e4, &lost), 0.0, 7.6e-4);
}

/* A plate that deforms, driven by a difference of pressure with the water on both sides. Its surface near the end of a cell,
 * where little of it is at the outer node. Measured: 0.0056, which is the plate taking up the load, 0.0009, and 0.011 of 50
 * steps. */
static void test_elastic(void **unused)
{
    (void)unused;
    static const double ratio[] = {1e-3, 1.0, 100.0}, tolerance[] = {0.011, 0.0018, 0.02};
    for (int k = 0; k < 3; ++k) {
        char rubber[200];
        (void)snprintf(
            rubber, sizeof rubber,
            "materials.rubber={density: %.17g, specific_heat: 460, law: {linear_elastic: {bulk_modulus: 1e6, "
            "shear_modulus: 1e5}}}",
            1000.0 * ratio[k]);
        const char *set[] = {"boundaries={x: {lower: {outlet: {pressure: 1.01e5}}, upper: {outlet: {pressure: 1e5}}}}",
                             rubber, "bodies.rubber={material: rubber, shape: {box: {lower: 0.4090, upper: 0.6090}}}"};
        const double end = k == 0 ? 0.022 : 0.05, right = 0.5 * 1000.0 / (800.0 + 200.0 * ratio[k]) * end * end;
        trial t;
        mpm_totals m;
        line_begin(&t, 0.01, 1e-3, set, 3);
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
        const double first = m.moment[0][0] / m.mass[0];
        trial_run(&t, end);
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
        const double ahead = 0.5e-3 * m.momentum[0][0] / m.mass[0]; /* a kick is before the way (theory 7.8) */
        const double off = (m.moment[0][0] / m.mass[0] - first - ahead) / right - 1.0;
        print_message("elastic, ratio %g: way off by %.2g, %ld steps, %.3g iterations\n", ratio[k], off, t.sim->steps,
                      iterations_of(&t));
        check_close(off, 0.0, tolerance[k]);
        check_conserved(&t);
        trial_end(&t);
    }
}

/* ---- the same bits ---- */

/* Two discs off the middle of their cells, one rigid. */
static void discs_begin(trial *t, int blocks)
{
    static const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1.6, 0.8], cell: 0.05}",
        "boundaries={x: {lower: {velocity: {velocity: [0.1, 0]}}, upper: {outlet: {pressure: 1e5}}}, y: symmetry}",
        "materials.water=" LIQUID,
        "materials.air=null",
        "materials.plate={density: 100, specific_heat: 1, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: "
        "5e5}}}",
        "materials.foam={density: 10, specific_heat: 1, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: "
        "5e5}}}",
        AMBIENT,
        "bodies.behind=null",
        "bodies.plate={material: plate, shape: {ball: {centre: [0.41, 0.42], radius: 0.19}}, points: 2}",
        "bodies.foam={material: foam, shape: {ball: {centre: [1.03, 0.38], radius: 0.19}}, points: 2, motion: rigid}",
        "time={end: 1, cfl: 0.4, max_step: 1e-3, acoustic_cfl: 1e6}",
        METHOD};
    deck_begin(t, "shock_plate", set, sizeof set / sizeof *set);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
}

static state run(int blocks, int threads, const char *path)
{
    return run_in_halves(discs_begin, 40, blocks, threads, path);
}

static void test_bits(void **unused)
{
    (void)unused;
    same_bits_however_run(run);
}

/* ---- a viscous stream that meets a block ---- */

static void stream_begin(trial *t, const char *body, const char *cfl)
{
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.4, 0.2], cell: 0.01}",
        "boundaries={x: {lower: {inlet: {velocity: [1, 0], pressure: 1e5, temperature: 300}}, upper: {outlet: "
        "{pressure: 1e5}}}, y: {lower: symmetry, upper: slip}}",
        "ambient={material: liquid, pressure: 1e5, temperature: 300, velocity: [1, 0]}",
        "time.end=1",
        body,
        cfl};
    deck_begin(t, "turek_hron_cfd", set, sizeof set / sizeof *set);
    start(t);
}

/* The fluid that comes to rest before a block with its faces on the mesh's keeps its head, p + rho u^2/2 (Bernoulli), but for friction, 1e-3 of rho u^2/2 at
 * this Reynolds number of 100. With velocities of covered cells that do not stick to the wall (theory 7.8) it gained 0.068 of it, with one velocity for all
 * members of a merged cell 0.0098. Measured: -0.0024. */
static void test_head(void **unused)
{
    (void)unused;
    trial t;
    double head[2] = {0.0};
    stream_begin(&t, "bodies.body.shape={box: {lower: [0.15, -0.05], upper: [0.25, 0.05]}}", "time.cfl=0.5");
    trial_run(&t, 1.0);
    const fields *f = t.sim->domain->fields[0];
    for (int k = 0; k < 2; ++k) {
        const ptrdiff_t at = mesh_index(&t.sim->mesh.block[0], k == 0 ? 4 : 14, 0, 0);
        head[k] = field_get(f, C_PRESSURE, 0, 0)[at];
        for (int a = 0; a < 2; ++a) head[k] += 500.0 * pow(field_get(f, C_VEL, 0, a)[at], 2.0);
    }
    print_message("head: %.3g of rho u^2/2 gained\n", (head[1] - head[0]) / 500.0);
    check_close((head[1] - head[0]) / 500.0, 0.0, 0.0048);
    trial_end(&t);
}

/* A block in the middle of a channel, its long sides on faces of the mesh and its end within cells: no lift, by symmetry. Measured: 0.0008 of the drag; where the
 * cells at its end had the pieces of one of its long sides -0.007. */
static void test_symmetric(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, -0.1], upper: [0.4, 0.1], cell: 0.01}",
        "boundaries={x: {lower: {inlet: {velocity: [1, 0], pressure: 1e5, temperature: 300}}, upper: {outlet: "
        "{pressure: 1e5}}}, y: slip}",
        "ambient={material: liquid, pressure: 1e5, temperature: 300, velocity: [1, 0]}",
        "bodies.body.shape={box: {lower: [0.15, -0.02], upper: [0.225, 0.02]}}", "time.end=0.3"};
    trial t;
    double force[3], moment[3];
    deck_begin(&t, "turek_hron_cfd", set, sizeof set / sizeof *set);
    start(&t);
    trial_run(&t, 0.3);
    check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
    print_message("a symmetric block: lift %.3g of the drag\n", force[1] / force[0]);
    check_close(force[1] / force[0], 0.0, 0.0016);
    trial_end(&t);
}

static double drag_with(const char *cfl)
{
    trial t;
    double force[3], moment[3];
    stream_begin(&t, "bodies.body.shape={ball: {centre: [0.2, 0], radius: 0.05}}", cfl);
    while (t.sim->time < 0.6) check_ok(t.ctx, sim_step(t.sim, 1.0));
    check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
    trial_end(&t);
    return force[0];
}

/* A stream that has settled about a cylinder does not depend on the step. Measured: drags apart by 0.021; without advection in the velocities of the faces of
 * cut cells (theory 7.8) 0.038. */
static void test_steps(void **unused)
{
    (void)unused;
    const double coarse = drag_with("time.cfl=0.9"), fine = drag_with("time.cfl=0.25");
    print_message("drag in large and in small steps: %.5g and %.5g N\n", coarse, fine);
    check_close(coarse / fine, 1.0, 0.025);
}

/* A cylinder in a channel at a Reynolds number of 20 (Schaefer and Turek 1996, 2D-1: 5.5795): mean of two units of time, in which sound of the start swings the
 * force by 2 %. Measured: 0.0043 too large; with one velocity for all members of a merged cell 0.021. */
static void test_drag(void **unused)
{
    (void)unused;
    const char *set[] = {"method={pressure: implicit}", "time={end: 6, cfl: 0.9}"};
    double sum = 0.0, force[3], moment[3];
    trial t;
    deck_begin(&t, "cylinder_channel", set, 2);
    start(&t);
    trial_run(&t, 4.0);
    while (t.sim->time < 6.0) {
        const double before = t.sim->time;
        check_ok(t.ctx, sim_step(t.sim, 6.0));
        check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
        sum += 2.0 * force[0] * (t.sim->time - before);
    }
    print_message("drag on a cylinder: %.4g off\n", 0.5 * sum / 5.5795 - 1.0);
    check_close(0.5 * sum / 5.5795, 1.0, 0.0086);
    check_conserved(&t);
    trial_end(&t);
}

/* ---- what is refused ---- */

static void refuse(const char *method, const char *change, const char *change_too, const char *words)
{
    const char *set[] = {method, change, change_too};
    trial t;
    const floe_status read = deck_try(&t, "shock_plate", set, 3);
    if (read == FLOE_OK) assert_int_equal(sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM), FLOE_BAD_INPUT);
    if (!strstr(context_message(t.ctx), words)) print_message("%s\n", context_message(t.ctx));
    assert_non_null(strstr(context_message(t.ctx), words));
    trial_end(&t);
}

static void test_refused(void **unused)
{
    (void)unused;
    refuse("method={basis: quadratic, interface: sharp, pressure: auto}", "time.end=1e-3", "time.cfl=0.5",
           "the pressure is explicit");
    refuse("method={basis: gimp, interface: sharp, pressure: implicit}", "time.end=1e-3", "time.cfl=0.5",
           "the basis is gimp");
    refuse(METHOD,
           "loads={fire: {heat: {material: air, region: {box: {lower: [0, 0], upper: [0.1, 0.02]}}, power: 1}}}",
           "time.cfl=0.5", "explicit pressure alone");
    refuse(METHOD, "materials.other={eos: {ideal: {gamma: 1.3, specific_heat: 1000}}}",
           "reactions={burn: {reactant: air, product: other, rate: {threshold: {temperature: 900, time: 1e-3}}, heat: "
           "1e5}}",
           "react with the explicit pressure alone");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pushed),    cmocka_unit_test(test_lifted), cmocka_unit_test(test_held),
        cmocka_unit_test(test_turning),   cmocka_unit_test(test_piston), cmocka_unit_test(test_gas_spring),
        cmocka_unit_test(test_elastic),   cmocka_unit_test(test_bits),   cmocka_unit_test(test_head),
        cmocka_unit_test(test_symmetric), cmocka_unit_test(test_steps),  cmocka_unit_test(test_drag),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

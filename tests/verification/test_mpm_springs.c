/* Springs between points and places of bodies, tethers, dashpots, and supports: two masses that swing against each other; a slack tether that stops a
 * fall; momentum; blocks that swing and turn on a spring off their centre, rigid ones and such as deform. */
#include "coupled_fixture.h"

static const double pi = 3.14159265358979323846;

/* A point of its own mass at a place. */
static scene_body *add_mass(trial *t, int material, double *place, double mass)
{
    scene_body *b = add_body(t, material, (shape){0}, 1);
    b->membrane = (scene_membrane){.present = true,
                                   .curve = {.kind = CURVE_POINTS, .vertex = place, .n_vertices = 1},
                                   .thickness = 1.0,
                                   .length = NAN,
                                   .heavy_point = 1,
                                   .heavy_mass = mass};
    return b;
}

static int add_string(trial *t)
{
    scene_material *m = &t->scene->material[t->scene->n_materials];
    m->kind = MATERIAL_SOLID;
    m->density = 1.0;
    m->membrane = membrane_find("string");
    assert_non_null(m->membrane);
    check_ok(t->ctx, scene_allocate(t->scene, &m->membrane_par, m->membrane->param_size));
    *(double *)m->membrane_par = 1.0;
    return t->scene->n_materials++;
}

static scene_spring *add_spring(trial *t, double stiffness, double rest_length)
{
    scene_spring *s = &t->scene->spring[t->scene->n_springs++];
    (void)snprintf(s->name, sizeof s->name, "spring");
    s->stiffness = stiffness;
    s->rest_length = rest_length;
    for (int e = 0; e < 2; ++e) s->end[e] = (scene_spring_end){.body = e, .point = 1};
    return s;
}

/* Two masses five cells apart, so that they share no node, in a box without walls near. */
static void begin(trial *t, const char *basis, double *places)
{
    const double size[3] = {2.0, 2.0, 0.0};
    trial_begin(t, 2, size, 0.1);
    set_method(t, basis, STRESS_USL, 1.0);
    t->scene->thickness = 0.5;
    t->scene->time.fixed_step = 1e-3;
    const int string = add_string(t);
    add_mass(t, string, places, 2.0);
    add_mass(t, string, places + 3, 1.0);
}

static double place_of(const trial *t, int body, int axis)
{
    double x[3];
    mpm_membrane_end(t->sim->mpm, body, false, x);
    return x[axis];
}

/* x = L + A cos(omega t), omega^2 = k (1/m + 1/M): after half a period the spring is as short as it was long, and nothing has gained
 * momentum. The step of omega dt = 0.0087 costs its square over 24 and what half a step is read late. */
static void test_masses(void **unused)
{
    (void)unused;
    static const char *const basis[] = {"linear", "gimp", "quadratic"};
    for (int k = 0; k < 3; ++k) {
        double places[] = {0.75, 1.02, 0.0, 1.25, 1.02, 0.0};
        trial t;
        begin(&t, basis[k], places);
        add_spring(&t, 50.0, 0.45);
        trial_start(&t);
        mpm_totals sum;
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
        check_close_relative(sum.springs * 0.5, 0.5 * 50.0 * 0.05 * 0.05, 1e-12);
        trial_run(&t, 0.5 * pi / sqrt(50.0 * 1.5));
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Z) < 1e-13); /* at their fastest */
        trial_run(&t, pi / sqrt(50.0 * 1.5));
        check_close(place_of(&t, 1, 0) - place_of(&t, 0, 0), 0.40, 1e-11);
        check_close(2.0 * place_of(&t, 0, 0) + place_of(&t, 1, 0), 2.75, 1e-13);
        trial_end(&t);
    }
}

/* A tether with slack s lets a mass fall freely, then stops it at s + g/w^2 + sqrt((g/w^2)^2 + 2 g s/w^2) below the start. */
static void test_tether(void **unused)
{
    (void)unused;
    double places[] = {0.55, 1.02, 0.0, 1.25, 1.32, 0.0};
    trial t;
    begin(&t, "quadratic", places);
    scene_spring *tether = add_spring(&t, 50.0, 0.2);
    tether->one_way = true;
    tether->end[0] = (scene_spring_end){.body = -1, .place = {1.25, 1.42}};
    add_load(&t, LOAD_BODY_FORCE, 1)->vector[1] = -1.0;
    trial_start(&t);
    const double slack = 0.1, sag = 1.0 / 50.0;
    double lowest = 1.32;
    trial_run(&t, sqrt(2.0 * slack) - 1e-3);
    check_close(place_of(&t, 1, 1), 1.32 - 0.5 * t.sim->time * t.sim->time, 1e-12);
    while (t.sim->time < 0.9) {
        check_ok(t.ctx, sim_step(t.sim, INFINITY));
        lowest = fmin(lowest, place_of(&t, 1, 1));
    }
    check_close(1.32 - lowest, slack + sag + sqrt(sag * sag + 2.0 * sag * slack), 6e-8);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Z) < 1e-12);
    trial_end(&t);
}

/* A support holds one of the masses: omega^2 = k / m of the other, and the ledger knows what it gave. */
static void test_support(void **unused)
{
    (void)unused;
    double places[] = {0.75, 1.02, 0.0, 1.25, 1.02, 0.0};
    trial t;
    begin(&t, "quadratic", places);
    add_spring(&t, 50.0, 0.45);
    scene_support *pin = &t.scene->support[t.scene->n_supports++];
    (void)snprintf(pin->name, sizeof pin->name, "pin");
    pin->region = make_ball(&t, (const double[]){0.75, 1.0, 0.0}, 0.22);
    trial_start(&t);
    trial_run(&t, pi / sqrt(50.0));
    check_close(place_of(&t, 0, 0), 0.75, 1e-15);
    check_close(place_of(&t, 1, 0), 1.15, 1e-11);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Z) < 1e-13);
    trial_end(&t);
}

/* A block of mass m and inertia I on a spring from (0.2, 0.5) to its place at (0.9, 0.58), 0.1 longer than at rest, at time t: Runge and Kutta's
 * method of the fourth order for the centre, the angle and their rates. */
static void rigid_rates(const double y[6], double m, double inertia, double rate[6])
{
    const double c = cos(y[2]), s = sin(y[2]), rx = -0.1 * c - 0.08 * s, ry = -0.1 * s + 0.08 * c;
    const double dx = 0.2 - y[0] - rx, dy = 0.5 - y[1] - ry, length = hypot(dx, dy);
    const double pull = 4000.0 * (1.0 - (hypot(0.7, 0.08) - 0.1) / length);
    for (int k = 0; k < 3; ++k) rate[k] = y[3 + k];
    rate[3] = pull * dx / m;
    rate[4] = pull * dy / m;
    rate[5] = pull * (rx * dy - ry * dx) / inertia;
}

static void rigid_swing(double m, double inertia, double until, double y[6])
{
    static const double ahead[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    const int n = 4000;
    const double start[6] = {1.0, 0.5};
    memcpy(y, start, sizeof start);
    for (int step = 0; step < n; ++step) {
        double sum[6] = {0.0}, rate[6] = {0.0}, at[6];
        for (int part = 0; part < 4; ++part) {
            for (int k = 0; k < 6; ++k) at[k] = y[k] + ahead[part] * until / n * rate[k];
            rigid_rates(at, m, inertia, rate);
            for (int k = 0; k < 6; ++k) sum[k] += weight[part] * rate[k];
        }
        for (int k = 0; k < 6; ++k) y[k] += until / n / 6.0 * sum[k];
    }
}

/* How far (m) the centre of that block is off after a turn of 2.5 radians. `cells` of its side. */
/* On the mesh a body resists turning with its mass spread by quadratic splines, m h^2 / 2 more than its points have (docs/limits.md). */
static double swing_of_block(int cells, bool rigid, double *energy)
{
    const double size[3] = {2.0, 1.0, 0.0}, until = 0.35, h = 0.2 / cells,
                 of_points = 40.0 * 0.08 / 12.0 * (1.0 - 1.0 / (4.0 * cells * cells));
    double y[6];
    trial t;
    mpm_totals sum;
    trial_begin(&t, 2, size, h);
    (void)snprintf(t.scene->method.transfer, sizeof t.scene->method.transfer, "afmpm");
    const int steel = add_solid(&t, "linear_elastic", 1e7, 5e6, 1000.0);
    scene_body *b =
        add_body(&t, steel, make_box(&t, (const double[]){0.9, 0.4, 0.0}, (const double[]){1.1, 0.6, 0.0}), 2);
    if (rigid) b->motion = (scene_motion){.kind = MOTION_RIGID, .about = {NAN, NAN, NAN}, .axis = {0.0, 0.0, 1.0}};
    scene_spring *spring = add_spring(&t, 4000.0, hypot(0.7, 0.08) - 0.1);
    spring->end[0] = (scene_spring_end){.body = -1, .place = {0.2, 0.5}};
    spring->end[1] = (scene_spring_end){.body = 0, .place = {0.9, 0.58}};
    trial_start(&t);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    check_close_relative(sum.springs, 0.5 * 4000.0 * 0.01, 1e-12);
    trial_run(&t, until);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    rigid_swing(40.0, of_points + (rigid ? 0.0 : 40.0 * 0.5 * h * h), until, y);
    const double off = hypot(sum.moment[0][0] / 40.0 - y[0], sum.moment[0][1] / 40.0 - y[1]);
    *energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
    print_message("block of %d cells, %s: centre %.2g m off, turned by %.3g; energy %.1e\n", cells,
                  rigid ? "rigid" : "elastic", off, y[2], *energy);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Z) < 1e-12);
    trial_end(&t);
    return off;
}

static void test_places(void **unused)
{
    (void)unused;
    double energy;
    check_true(swing_of_block(4, true, &energy) < 9e-6 && energy < 1.4e-3);
    check_true(swing_of_block(8, true, &energy) < 9e-6 && energy < 1.5e-3);
    check_true(swing_of_block(4, false, &energy) < 2e-4);
    check_true(swing_of_block(8, false, &energy) < 2.4e-4);
}

/* x = L + A exp(-zeta omega t) (cos(w t) + zeta omega / w sin(w t)), w = omega sqrt(1 - zeta^2); the ledger has what is lost. */
static void test_dashpot(void **unused)
{
    (void)unused;
    double places[] = {0.75, 1.02, 0.0, 1.25, 1.02, 0.0};
    const double reduced = 2.0 / 3.0, omega = sqrt(50.0 / reduced), zeta = 0.1, w = omega * sqrt(1.0 - zeta * zeta);
    trial t;
    mpm_totals sum;
    begin(&t, "quadratic", places);
    add_spring(&t, 50.0, 0.45)->damping = 2.0 * zeta * omega * reduced;
    trial_start(&t);
    trial_run(&t, 0.9);
    const double now = t.sim->time,
                 x = 0.45 + 0.05 * exp(-zeta * omega * now) * (cos(w * now) + zeta * omega / w * sin(w * now));
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    const ledger_sum *lost = &t.sim->ledger.entry[LEDGER_ENERGY][LEDGER_DAMPING];
    print_message("dashpot: %.2g m off; energy drift %.2g, lost %.3g of %.3g\n",
                  place_of(&t, 1, 0) - place_of(&t, 0, 0) - x, ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY),
                  -(lost->value + lost->carry), 0.5 * 50.0 / 0.5 * 0.0025);
    check_close(place_of(&t, 1, 0) - place_of(&t, 0, 0), x, 1.6e-4);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 4.2e-4 && lost->value < -0.09);
    trial_end(&t);
}

/* How far a rigid block of 160 kg sinks on two springs to (0.4, 1.9) and (1.6, 1.9) from its upper corners, and one of half their stiffness that holds it
 * up from below, or none. */
static double sag_of_block(double below)
{
    const double rest = hypot(0.4, 0.7);
    double lo = 0.0, hi = 0.5;
    for (int k = 0; k < 60; ++k) {
        const double s = 0.5 * (lo + hi), length = hypot(0.4, 0.7 + s);
        if (4e4 * (length - rest) * (0.7 + s) / length + below * s > 1600.0)
            hi = s;
        else
            lo = s;
    }
    return lo;
}

/* The same in static balance, of a block that is stiff; as a tether the lower spring is slack. Returns the relative error. */
static double balance_error(int cells, bool slack, int springs, floe_status *status)
{
    const double size[3] = {2.0, 2.0, 0.0}, from[3][2] = {{0.4, 1.9}, {1.6, 1.9}, {1.0, 0.2}},
                 to[3][2] = {{0.8, 1.2}, {1.2, 1.2}, {1.0, 0.8}};
    trial t;
    mpm_totals before, after;
    trial_begin(&t, 2, size, 0.4 / cells);
    const int steel = add_solid(&t, "linear_elastic", 1e8, 5e7, 1000.0);
    add_body(&t, steel, make_box(&t, (const double[]){0.8, 0.8, 0.0}, (const double[]){1.2, 1.2, 0.0}), 2);
    for (int k = 0; k < springs; ++k) {
        scene_spring *spring = add_spring(&t, k < 2 ? 2e4 : 1e4, NAN);
        spring->one_way = slack && k == 2;
        spring->end[0] = (scene_spring_end){.body = -1, .place = {from[k][0], from[k][1]}};
        spring->end[1] = (scene_spring_end){.body = 0, .place = {to[k][0], to[k][1]}};
    }
    add_load(&t, LOAD_BODY_FORCE, -1)->vector[1] = -10.0;
    t.scene->time.solver = SOLVER_STATIC;
    t.scene->time.end = 1.0;
    trial_start(&t);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &before));
    *status = sim_step(t.sim, 1.0);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &after));
    const double sank = (before.moment[0][1] - after.moment[0][1]) / after.mass[0],
                 error = sank / sag_of_block(slack ? 0.0 : 1e4) - 1.0,
                 drift = *status == FLOE_OK ? ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) : 0.0;
    print_message("balance, %d cells, %d springs%s: sinks by %.5f m, %.2g off; energy %.1e\n", cells, springs,
                  slack ? ", one slack" : "", sank, error, drift);
    check_true(drift < 1e-4);
    trial_end(&t);
    return fabs(error);
}

/* What the block itself gives way by: its weight over its modulus and, where springs push it, more on a finer mesh. On one spring it may turn. */
static void test_balance(void **unused)
{
    (void)unused;
    floe_status status;
    check_true(balance_error(4, false, 3, &status) < 8.8e-4);
    check_true(balance_error(8, false, 3, &status) < 1e-3);
    check_true(balance_error(4, true, 3, &status) < 1.1e-3);
    (void)balance_error(4, false, 1, &status);
    assert_int_equal(status, FLOE_DIVERGED);
}

/* Positions of the points of the first body, by their ids. */
enum { MOST_POINTS = 256 };
static void points_by_id(const trial *t, double x[MOST_POINTS][2])
{
    const fields *f = t->sim->domain->fields[0];
    const size_t n = t->sim->mpm->points[0][0].n;
    assert_true(n == MOST_POINTS);
    for (size_t k = 0; k < n; ++k)
        for (int a = 0; a < 2; ++a) x[(size_t)field_get(f, P_ID, 0, 0)[k]][a] = field_get(f, P_POS, 0, a)[k];
}

/* What is left of forces, and of moments about its centre, on a rigid block that has moved and turned as the points have, of their scale. */
static double imbalance_of_block(const trial *t, double before[MOST_POINTS][2], const double from[4][2],
                                 const double to[4][2], const double *k)
{
    double x[MOST_POINTS][2], centre[2] = {0.0, 0.0}, along = 0.0, across = 0.0, sum[3] = {0.0, -1600.0, 0.0};
    points_by_id(t, x);
    for (int p = 0; p < MOST_POINTS; ++p)
        for (int a = 0; a < 2; ++a) centre[a] += x[p][a] / MOST_POINTS;
    for (int p = 0; p < MOST_POINTS; ++p) {
        const double X = before[p][0] - 2.0, Y = before[p][1] - 2.2;
        along += X * (x[p][0] - centre[0]) + Y * (x[p][1] - centre[1]);
        across += X * (x[p][1] - centre[1]) - Y * (x[p][0] - centre[0]);
    }
    const double c = along / hypot(along, across), s = across / hypot(along, across);
    for (int e = 0; e < 4; ++e) {
        const double X = to[e][0] - 2.0, Y = to[e][1] - 2.2, arm[2] = {c * X - s * Y, s * X + c * Y};
        const double way[2] = {from[e][0] - centre[0] - arm[0], from[e][1] - centre[1] - arm[1]},
                     length = hypot(way[0], way[1]), pull = k[e] * (length - (e < 2 ? 0.8 : 1.0)) / length;
        sum[0] += pull * way[0];
        sum[1] += pull * way[1];
        sum[2] += pull * (arm[0] * way[1] - arm[1] * way[0]);
    }
    print_message("a block that sinks by %.3f m and turns by %.3f: forces %.2g, %.2g, moment %.2g\n", 2.2 - centre[1],
                  atan2(s, c), sum[0] / 1600.0, sum[1] / 1600.0, sum[2] / (0.2 * 1600.0));
    return fmax(hypot(sum[0], sum[1]) / 1600.0, fabs(sum[2]) / (0.2 * 1600.0));
}

/* Through several cells in many increments, in which its points come to be in another order, between springs that turn it. */
static void test_far_balance(void **unused)
{
    (void)unused;
    const double size[3] = {4.0, 4.0, 0.0}, from[4][2] = {{1.0, 3.2}, {3.0, 3.2}, {1.0, 1.0}, {3.0, 1.0}},
                 to[4][2] = {{1.8, 2.4}, {2.2, 2.4}, {1.8, 2.0}, {2.2, 2.0}}, k[4] = {2e3, 2.2e3, 2e3, 2.2e3};
    double before[MOST_POINTS][2];
    trial t;
    trial_begin(&t, 2, size, 0.05);
    const int steel = add_solid(&t, "linear_elastic", 1e8, 5e7, 1000.0);
    add_body(&t, steel, make_box(&t, (const double[]){1.8, 2.0, 0.0}, (const double[]){2.2, 2.4, 0.0}), 2);
    for (int e = 0; e < 4; ++e) {
        scene_spring *spring = add_spring(&t, k[e], e < 2 ? 0.8 : 1.0);
        spring->end[0] = (scene_spring_end){.body = -1, .place = {from[e][0], from[e][1]}};
        spring->end[1] = (scene_spring_end){.body = 0, .place = {to[e][0], to[e][1]}};
    }
    add_load(&t, LOAD_BODY_FORCE, -1)->vector[1] = -10.0;
    t.scene->time.solver = SOLVER_STATIC;
    t.scene->time.increments = 20;
    t.scene->time.end = 1.0;
    trial_start(&t);
    points_by_id(&t, before);
    while (t.sim->time < 1.0 - 1e-9) check_ok(t.ctx, sim_step(t.sim, 1.0));
    check_true(imbalance_of_block(&t, before, from, to, k) < 2.2e-4);
    trial_end(&t);
}

/* An end among four points a cell along each axis, with some just as far away as points belong to it: they have no weight. */
static void test_rim(void **unused)
{
    (void)unused;
    const double size[3] = {4.0, 0.0, 0.0};
    trial t;
    trial_begin(&t, 1, size, 0.125);
    const int steel = add_solid(&t, "linear_elastic", 1e8, 5e7, 1000.0);
    add_body(&t, steel, make_box(&t, (const double[]){2.0, 0.0, 0.0}, (const double[]){2.5, 0.0, 0.0}), 4);
    scene_spring *spring = add_spring(&t, 1e4, NAN);
    spring->end[0] = (scene_spring_end){.body = -1, .place = {3.5}};
    spring->end[1] = (scene_spring_end){.body = 0, .place = {2.265625}};
    add_load(&t, LOAD_BODY_FORCE, -1)->vector[0] = -1.0;
    t.scene->time.solver = SOLVER_STATIC;
    t.scene->time.end = 1.0;
    trial_start(&t);
    check_ok(t.ctx, sim_step(t.sim, 1.0));
    mpm_totals sum;
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    print_message("a bar on a spring in its middle sinks by %.8f m\n", 2.25 - sum.moment[0][0] / sum.mass[0]);
    check_close(2.25 - sum.moment[0][0] / sum.mass[0], 0.05, 1.4e-7);
    trial_end(&t);
}

/* A spring on a place that a support holds pulls the support, not the solid beyond: this stays, and the support's impulse is that of the spring. */
static void pull_support(time_solver solver)
{
    const double size[3] = {1.0, 1.0, 0.0};
    trial t;
    mpm_totals before, after;
    trial_begin(&t, 2, size, 0.05);
    const int steel = add_solid(&t, "neo_hookean", 1e7, 5e6, 1000.0);
    add_body(&t, steel, make_box(&t, (const double[]){0.2, 0.4, 0.0}, (const double[]){0.9, 0.6, 0.0}), 2);
    scene_support *clamp = &t.scene->support[t.scene->n_supports++];
    clamp->region = make_box(&t, (const double[]){0.0, 0.0, 0.0}, (const double[]){0.33, 1.0, 0.0});
    scene_spring *spring = add_spring(&t, 1e4, 0.3);
    spring->end[0] = (scene_spring_end){.body = -1, .place = {0.23, 0.9}};
    spring->end[1] = (scene_spring_end){.body = 0, .place = {0.23, 0.5}};
    t.scene->time.solver = solver;
    t.scene->time.end = 0.01;
    trial_start(&t);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &before));
    while (t.sim->time < 0.01 - 1e-12) check_ok(t.ctx, sim_step(t.sim, 0.01));
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &after));
    check_close(after.moment[0][1], before.moment[0][1], 1e-13);
    check_close(after.strain[0], 0.0, 1e-20);
    const ledger_sum *of = t.sim->ledger.entry[LEDGER_MOMENTUM_Y];
    const double given = solver == SOLVER_DYNAMIC ? 1000.0 * 0.01 : 0.0; /* balance has no impulse */
    check_close(of[LEDGER_SOURCE].value, given, 1e-2 * given);           /* velocities are half a step back */
    check_close(of[LEDGER_BOUNDARY].value, -of[LEDGER_SOURCE].value, 1e-14 * given);
    trial_end(&t);
}

static void test_held_place(void **unused)
{
    (void)unused;
    pull_support(SOLVER_DYNAMIC);
    pull_support(SOLVER_STATIC);
}

static void test_refusals(void **unused)
{
    (void)unused;
    double places[] = {0.75, 1.02, 0.0, 1.25, 1.02, 0.0};
    trial t;
    begin(&t, "quadratic", places);
    add_spring(&t, 50.0, 0.45)->end[1].point = 2;
    assert_int_equal(sim_create(&t.sim, t.ctx, t.scene, COUPLING_MPM), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(t.ctx), "point: 2: body 'body1' has only 1 point"));
    trial_end(&t);
    begin(&t, "quadratic", places);
    add_spring(&t, 50.0, 0.45)->end[1] = (scene_spring_end){.body = 1, .place = {1.4, 1.02}};
    assert_int_equal(sim_create(&t.sim, t.ctx, t.scene, COUPLING_MPM), FLOE_BAD_INPUT);
    assert_non_null(
        strstr(context_message(t.ctx), "body 'body1' is not there; its nearest point is at (1.25, 1.02, 0)"));
    trial_end(&t);
    begin(&t, "quadratic", places);
    scene_support *pin = &t.scene->support[t.scene->n_supports++];
    (void)snprintf(pin->name, sizeof pin->name, "pin");
    pin->region = make_ball(&t, (const double[]){0.75, 1.05, 0.0}, 0.02);
    assert_int_equal(sim_create(&t.sim, t.ctx, t.scene, COUPLING_MPM), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(t.ctx), "supports.pin: holds nothing"));
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_masses),      cmocka_unit_test(test_tether),  cmocka_unit_test(test_support),
        cmocka_unit_test(test_places),      cmocka_unit_test(test_dashpot), cmocka_unit_test(test_balance),
        cmocka_unit_test(test_far_balance), cmocka_unit_test(test_rim),     cmocka_unit_test(test_held_place),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

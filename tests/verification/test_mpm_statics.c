/* Steps of points that are solved for: against exact states of rest, the state that damped explicit steps settle to, and for the same
 * bits whatever the blocks and threads. */
#include "coupled_fixture.h"

static void solve_in(trial *t, long increments)
{
    t->scene->time.solver = SOLVER_STATIC;
    t->scene->time.increments = increments;
    t->scene->time.end = 1.0;
    trial_start(t);
    trial_run(t, 1.0);
}

/* Differences of a component of stress from what `expected` says, over points of body 0: the largest, and their sum. */
typedef struct stress_check {
    int component;
    double (*expected)(const double x[3]);
    double worst, sum;
} stress_check;

static void check_stress(void *user, const fields *f, int body, size_t k)
{
    stress_check *c = user;
    double x[3] = {0.0};
    for (int a = 0; a < 3 && field_get(f, P_POS, body, a); ++a) x[a] = field_get(f, P_POS, body, a)[k];
    const double error = fabs(field_get(f, P_STRESS, body, c->component)[k] - c->expected(x));
    c->worst = fmax(c->worst, error);
    c->sum += error;
}

static double worst_stress(const trial *t, int component, double (*expected)(const double x[3]))
{
    stress_check c = {component, expected, 0.0, 0.0};
    visit_points(t, 0, check_stress, &c);
    return c.worst;
}

/* A bar that hangs by its lower end from a wall and is pulled by a body force: stress falls evenly to the free end. */
static const double weight = 1000.0 * 3.0; /* Pa/m */
static double hanging(const double x[3])
{
    return weight * (1.0 - x[0]);
}

/* Bases whose points of a cell have but one gradient, where they stand midway. */
static bool has_steps(const basis_model *b)
{
    return basis_is(b, "linear") || basis_is(b, "gimp");
}

/* Bases that can be solved for: those with weights along the axes. */
#define FOR_STATIC_BASES(i)                            \
    for (size_t i = 0; i < basis_registry_size; ++(i)) \
        if (!basis_is(basis_registry[i], "cpdi"))

static void bar_under_its_weight(void **unused)
{
    (void)unused;
    FOR_STATIC_BASES(i)
    {
        trial t;
        trial_begin(&t, 1, (const double[3]){1.5}, 0.1);
        set_sides(&t, 0, BC_SLIP, BC_FREE);
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        add_body(&t, add_solid(&t, "linear_elastic", 6e8, 3e8, 1000.0),
                 make_box(&t, (const double[3]){0.0}, (const double[3]){1.0, 0.0, 0.0}), 2);
        add_load(&t, LOAD_BODY_FORCE, -1)->vector[0] = 3.0;
        solve_in(&t, 1);
        const double error = worst_stress(&t, 0, hanging) / weight;
        print_message("%s: stress off by %.1e of the largest\n", basis_registry[i]->name, error);
        /* Linear and gimp: one stress a cell, a quarter of a cell off at its points. Splines: 0.8 and 1.2 % measured, in the
         * last cell. */
        check_true(error <= (has_steps(basis_registry[i]) ? 0.0255 : 0.02));
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY) <= 2.5e-6);
        trial_end(&t);
    }
}

/* A block between walls of which one moves along and across: one strain throughout, and nothing but the wall drives it. */
static double pulled_along(const double x[3])
{
    (void)x;
    return 1e9 * 1e-5; /* bulk + 4/3 shear */
}
static double pulled_across(const double x[3])
{
    (void)x;
    return 3e8 * 2e-5;
}

static void wall_that_moves(void **unused)
{
    (void)unused;
    FOR_STATIC_BASES(i)
    {
        trial t;
        const double size[3] = {1.0, 0.5, 0.0}, from[3] = {0.0};
        trial_begin(&t, 2, size, 0.125);
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        set_sides(&t, 0, BC_NO_SLIP, BC_NO_SLIP);
        set_sides(&t, 1, BC_PERIODIC, BC_PERIODIC);
        for (int c = 0; c < 2; ++c) t.scene->bc.side[0][1].velocity[c] = c == 0 ? 1e-5 : 2e-5;
        add_body(&t, add_solid(&t, "linear_elastic", 6e8, 3e8, 1000.0), make_box(&t, from, size), 2);
        solve_in(&t, 1);
        const double along = worst_stress(&t, 0, pulled_along) / 1e4, across = worst_stress(&t, 3, pulled_across) / 6e3;
        print_message("%s: %.1e along, %.1e across\n", basis_registry[i]->name, along, across);
        check_true(along <= 2.2e-5 && across <= 3.4e-10); /* 1.1e-5, which is the strain, and 1.7e-10 measured */
        trial_end(&t);
    }
}

/* A neo-Hookean bar in uniaxial strain, drawn to 1.4 times its length in one increment: one stretch throughout. */
static const double stretch = 1.4, lambda = 2e5, mu = 1e5;
static double drawn(const double x[3])
{
    (void)x;
    return (mu * (stretch * stretch - 1.0) + lambda * log(stretch)) / stretch;
}

static void find_tip(void *user, const fields *f, int body, size_t k)
{
    double *tip = user;
    *tip = fmax(*tip, field_get(f, P_POS, body, 0)[k]);
}

static void bar_at_large_strain(void **unused)
{
    (void)unused;
    trial t;
    trial_begin(&t, 1, (const double[3]){2.0}, 0.5);
    set_sides(&t, 0, BC_SLIP, BC_FREE);
    add_body(&t, add_solid(&t, "neo_hookean", lambda + 2.0 / 3.0 * mu, mu, 1000.0),
             make_box(&t, (const double[3]){0.0}, (const double[3]){1.0, 0.0, 0.0}), 2);
    scene_load *load = add_load(&t, LOAD_TRACTION, 0);
    load->region = make_box(&t, (const double[3]){1.0, 0.0, 0.0}, (const double[3]){3.0, 0.0, 0.0});
    load->target = -drawn((const double[3]){0.0});
    solve_in(&t, 1);
    double tip = 0.0;
    visit_points(&t, 0, find_tip, &tip);
    const double error = worst_stress(&t, 0, drawn) / drawn((const double[3]){0.0});
    print_message("%ld increment, %lld iterations; stress off by %.1e, tip by %.1e\n", t.sim->steps,
                  t.sim->ledger.count[COUNT_BALANCE_ITERATIONS], error, tip - stretch * (1.0 - 0.125));
    assert_int_equal(t.sim->steps, 1);
    check_true(t.sim->ledger.count[COUNT_BALANCE_ITERATIONS] <=
               5);             /* as many as measured: its tangent is that of its forces */
    check_true(error <= 6e-9); /* time.tolerance */
    check_close(tip, stretch * (1.0 - 0.125), 3e-9);
    trial_end(&t);
}

/* A block in a box with a lid of pressure: uniaxial strain in space. */
static double pressed(const double x[3])
{
    (void)x;
    return -1e5;
}
static double beside(const double x[3])
{
    (void)x;
    return -1e5 * 0.6 / (0.6 + 2.0 * 0.6); /* lambda/(lambda + 2 mu) */
}

static void block_in_space(void **unused)
{
    (void)unused;
    FOR_STATIC_BASES(i)
    {
        trial t;
        trial_begin(&t, 3, (const double[3]){0.4, 0.5, 0.8}, 0.1);
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        for (int a = 0; a < 3; ++a) set_sides(&t, a, BC_SYMMETRY, a < 2 ? BC_SLIP : BC_FREE);
        add_body(&t, add_solid(&t, "linear_elastic", 1e9, 0.6e9, 1000.0),
                 make_box(&t, (const double[3]){0.0}, (const double[3]){0.4, 0.5, 0.5}), 2);
        scene_load *load = add_load(&t, LOAD_TRACTION, 0);
        load->region = make_box(&t, (const double[3]){-1.0, -1.0, 0.5}, (const double[3]){2.0, 2.0, 2.0});
        load->target = 1e5;
        solve_in(&t, 1);
        const double along = worst_stress(&t, 2, pressed) / 1e5, across = worst_stress(&t, 0, beside) / 1e5;
        const long long newton = t.sim->ledger.count[COUNT_BALANCE_ITERATIONS],
                        krylov = t.sim->ledger.count[COUNT_BALANCE_KRYLOV];
        print_message("%s: block %.1e along, %.1e across, %lld iterations of Newton, %lld of conjugate gradients\n",
                      basis_registry[i]->name, along, across, newton, krylov);
        check_true(newton <= 2 && krylov <= 14); /* 7 measured */
        /* Measured 0.6 % with the linear basis, whose loaded surface is sampled elsewhere than its points; with splines 12 % in
         * the last cell (cubic), where midpoints miss what is loaded. */
        check_true(along <= (has_steps(basis_registry[i]) ? 0.01 : 0.15));
        trial_end(&t);
    }
}

/* The thick ring as a section through its axis: sigma_r + sigma_theta is the same everywhere (Lame). */
static void tube_about_an_axis(void **unused)
{
    (void)unused;
    trial t;
    trial_begin(&t, 2, (const double[3]){1.2, 0.1}, 0.05);
    t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    set_sides(&t, 0, BC_FREE, BC_FREE);
    set_sides(&t, 1, BC_SYMMETRY, BC_SYMMETRY);
    add_body(&t, add_solid(&t, "linear_elastic", 117e9, 43.8e9, 8900.0),
             make_box(&t, (const double[3]){0.5, 0.0, 0.0}, (const double[3]){1.0, 0.1, 0.0}), 2);
    scene_load *load = add_load(&t, LOAD_TRACTION, 0);
    load->region = make_box(&t, (const double[3]){-1.0, -1.0, 0.0}, (const double[3]){0.5, 2.0, 0.0});
    load->target = 19.4e6;
    solve_in(&t, 1);
    double worst = 0.0;
    for (size_t k = 0; k < t.sim->mpm->points[0][0].n; ++k) {
        const fields *f = t.sim->domain->fields[0];
        const double sum = field_get(f, P_STRESS, 0, 0)[k] + field_get(f, P_STRESS, 0, 2)[k];
        worst = fmax(worst, fabs(sum / (2.0 * 19.4e6 / 3.0) - 1.0));
    }
    print_message("tube: off by %.1e\n", worst);
    check_true(worst <= 0.06); /* measured 4.5e-2, at the edge */
    trial_end(&t);
}

/* The ring of annulus_traction.yaml: iterations do not grow with the mesh, and one core needs hardly any time. */
static void iterations_stay(void **unused)
{
    (void)unused;
    static const char *const cell[] = {"domain.cell=0.1", "domain.cell=0.05", "domain.cell=0.025", "domain.cell=0.04"};
    for (size_t k = 0; k < sizeof cell / sizeof *cell; ++k) {
        const char *const set[] = {"time.solver=static", cell[k]};
        trial t;
        deck_begin(&t, "annulus_traction", set, 2);
        trial_start(&t);
        trial_run(&t, t.scene->time.end);
        const long long newton = t.sim->ledger.count[COUNT_BALANCE_ITERATIONS],
                        krylov = t.sim->ledger.count[COUNT_BALANCE_KRYLOV];
        print_message("%s: %lld of Newton, %lld of conjugate gradients\n", cell[k], newton, krylov);
        check_true(t.sim->at_rest);
        check_true(newton <= 3);
        check_true(krylov <= 15); /* measured 8 or 9 */
        trial_end(&t);
    }
}

/* An increment that is asked to end leaves the state as it was, and the next one is the same to the bit. */
static void increment_is_interrupted(void **unused)
{
    (void)unused;
    static const char *const set[] = {"time.solver=static", "domain.cell=0.1", "time.increments=2"};
    double strain[2];
    for (int interrupted = 0; interrupted < 2; ++interrupted) {
        volatile sig_atomic_t stop = interrupted;
        sim_totals totals;
        trial t;
        deck_begin(&t, "annulus_traction", set, 3);
        trial_start(&t);
        trial_steps(&t, 1);
        const double before = t.sim->time;
        context_watch(t.ctx, &stop);
        if (interrupted) {
            assert_int_equal(sim_step(t.sim, t.scene->time.end), FLOE_INTERRUPTED);
            check_true(t.sim->time == before && t.sim->steps == 1);
            stop = 0;
        }
        trial_steps(&t, 1);
        check_ok(t.ctx, sim_sum(t.sim, &totals));
        strain[interrupted] = totals.strain;
        trial_end(&t);
    }
    check_true(strain[0] == strain[1] && strain[0] > 0.0);
}

/* What damped steps settle to, as the rest that the deck asks for comes closer. */
static void rest_of_damped_steps(void **unused)
{
    (void)unused;
    double strain[3];
    static const char *const rest[] = {"stop.kinetic_over_strain=1e-6", "stop.kinetic_over_strain=1e-11"};
    for (int k = 0; k < 3; ++k) {
        const char *const set[] = {"domain.cell=0.1", k < 2 ? "time.end=0.1" : "time.solver=static",
                                   k < 2 ? rest[k] : "time.increments=4"};
        trial t;
        sim_totals totals;
        deck_begin(&t, "annulus_traction", set, 3);
        trial_start(&t);
        for (long n = 0; !t.sim->at_rest && t.sim->time < t.scene->time.end; ++n) {
            check_ok(t.ctx, sim_step(t.sim, t.scene->time.end));
            if (n % 20 != 0 || k == 2) continue;
            check_ok(t.ctx, sim_sum(t.sim, &totals));
            check_ok(t.ctx, sim_check_rest(t.sim, &totals));
        }
        check_true(t.sim->at_rest);
        check_ok(t.ctx, sim_sum(t.sim, &totals));
        strain[k] = totals.strain;
        trial_end(&t);
    }
    print_message("strain energy against the static one: %.1e, %.1e\n", strain[0] / strain[2] - 1.0,
                  strain[1] / strain[2] - 1.0);
    check_true(fabs(strain[1] / strain[2] - 1.0) <= 5e-6);
}

/* Compressed gas between a wall and a soft bar that ends at the other wall: p = p0 (V0/V)^gamma = p_ref - sigma(stretch of the bar). */
static double gas_against_bar(double stretched)
{
    const double sigma = (mu * (stretched * stretched - 1.0) + lambda * log(stretched)) / stretched;
    return 3e5 * pow(1.0 + (1.0 - stretched), -1.4) - 1e5 + sigma; /* gas and bar are 1 m long at first */
}

static double squeezed_stress;
static double squeezed(const double x[3])
{
    (void)x;
    return squeezed_stress;
}

/* `order`: the bar is the first body or the second. */
static void squeeze_bar(int order, double length)
{
    trial t;
    trial_begin(&t, 1, (const double[3]){2.0}, 0.5);
    set_sides(&t, 0, BC_SLIP, BC_SLIP);
    t.scene->reference_pressure = 1e5;
    for (int body = 0; body < 2; ++body)
        if (body == order) {
            scene_body *gas = add_body(&t, add_gas(&t, 1.4, 717.5),
                                       make_box(&t, (const double[3]){0.0}, (const double[3]){1.0, 0.0, 0.0}), 2);
            gas->pressure = 3e5;
            gas->temperature = 300.0;
        } else {
            add_body(&t, add_solid(&t, "neo_hookean", lambda + 2.0 / 3.0 * mu, mu, 1000.0),
                     make_box(&t, (const double[3]){1.0, 0.0, 0.0}, (const double[3]){2.0, 0.0, 0.0}), 2);
        }
    solve_in(&t, 4);
    double pressure;
    check_ok(t.ctx, mpm_mean_pressure(t.sim->mpm, t.scene->body[order].material, &(shape){0}, &pressure));
    stress_check c = {0, squeezed, 0.0, 0.0};
    visit_points(&t, 1 - order, check_stress, &c);
    print_message(
        "bar squeezed to %.3f of its length: gas off by %.1e, bar by %.1e of their pressure, %ld increments\n", length,
        pressure / (1e5 - squeezed_stress) - 1.0, c.worst / -squeezed_stress, t.sim->steps);
    /* Measured 6e-4 with four increments of the gas's energy, centred in each. */
    check_true(fabs(pressure / (1e5 - squeezed_stress) - 1.0) <= 1.2e-3);
    check_true(c.worst <= -2.8e-2 * squeezed_stress); /* 1.4e-2 measured */
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) == 0.0);
    trial_end(&t);
}

static void gas_and_bar(void **unused)
{
    (void)unused;
    double lo = 0.2, hi = 1.0;
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (lo + hi);
        if (gas_against_bar(middle) > 0.0)
            hi = middle;
        else
            lo = middle;
    }
    squeezed_stress = (mu * (lo * lo - 1.0) + lambda * log(lo)) / lo;
    for (int order = 0; order < 2; ++order) squeeze_bar(order, lo);
}

/* The cylinder with its gas as points, which its bore encloses: the load of annulus_traction.yaml by a gas that is heated. */
static void gas_in_a_bore(void **unused)
{
    (void)unused;
    const char *const set[] = {"time.solver=auto", "domain.cell=0.05"};
    trial t;
    deck_begin(&t, "pressurized_cylinder", set, 2);
    trial_start(&t);
    trial_run(&t, t.scene->time.end);
    double pressure;
    check_ok(t.ctx, mpm_mean_pressure(t.sim->mpm, t.scene->body[1].material, &(shape){0}, &pressure));
    check_true(t.sim->at_rest);
    check_close_relative(pressure, 19.4e6 + t.scene->reference_pressure, 1e-12);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY) <= 1.5e-8);
    trial_end(&t);
    /* A hole in the ring: the gas would flow out. */
    const char *const open[] = {"time.solver=static", "domain.cell=0.05",
                                "bodies.cylinder.shape={box: {lower: [0.5, 0], upper: [1, 1]}}"};
    deck_begin(&t, "pressurized_cylinder", open, 3);
    const floe_status status = sim_create(&t.sim, t.ctx, t.scene, COUPLING_MPM);
    assert_non_null(strstr(context_message(t.ctx), "not enclosed"));
    check_fails(t.ctx, status, FLOE_BAD_INPUT);
    trial_end(&t);
}

/* Without its mirrors the ring could go anywhere. */
static void free_bodies_are_refused(void **unused)
{
    (void)unused;
    static const char *const loose[] = {"boundaries={x: {lower: symmetry, upper: free}, y: free}",
                                        "boundaries={x: free, y: free}"};
    for (int k = 0; k < 2; ++k) {
        const char *const set[] = {"time.solver=static", "domain.cell=0.1", loose[k]};
        trial t;
        deck_begin(&t, "annulus_traction", set, 3);
        trial_start(&t);
        const floe_status status = sim_step(t.sim, t.scene->time.end);
        assert_non_null(strstr(context_message(t.ctx), "free to move"));
        check_fails(t.ctx, status, FLOE_DIVERGED);
        trial_end(&t);
    }
}

/* The clamped bar of bar_vibration.yaml in steps of 36, 18 and 9 times the explicit one: second order, and no energy lost. */
static double amplitude_error(const char *steps)
{
    const char *const set[] = {"time.solver=implicit", "domain.cell=0.015625", steps};
    trial t;
    exact solution;
    deck_begin(&t, "bar_vibration", set, 3);
    check_ok(t.ctx, initial_exact(t.scene, &solution));
    initial_attach(t.scene, &solution);
    trial_start(&t);
    trial_run(&t, t.scene->time.end);
    double worst = 0.0;
    for (size_t k = 0; k < t.sim->mpm->points[0][0].n; ++k) {
        const fields *f = t.sim->domain->fields[0];
        const double x[3] = {field_get(f, P_POS, 0, 0)[k], 0.0, 0.0};
        const double wanted = exact_value(&solution, EXACT_STRESS_XX, x, t.sim->time);
        worst = fmax(worst, fabs(field_get(f, P_STRESS, 0, 0)[k] - wanted));
    }
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_X) <= 1e-12);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 3e-3); /* measured 0.6e-3 to 1.8e-3 */
    initial_detach(t.scene);
    variant_end(&t, &solution);
    return worst;
}

static void implicit_steps(void **unused)
{
    (void)unused;
    const double error[] = {amplitude_error("time.increments=10"), amplitude_error("time.increments=20"),
                            amplitude_error("time.increments=40")};
    print_message("stress off by %g, %g, %g Pa\n", error[0], error[1], error[2]);
    check_true(log2(error[0] / error[1]) >= 1.8);
    check_true(log2(error[1] / error[2]) >= 1.6); /* the mesh's own error is near */
    const char *const set[] = {"time.solver=implicit"};
    trial t;
    deck_begin(&t, "bar_vibration", set, 1);
    check_fails(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_MPM), FLOE_BAD_INPUT);
    trial_end(&t);
}

/* A block in flight that is pulled by a body force, in space: what is left to it is its momentum. */
static void block_in_flight(void **unused)
{
    (void)unused;
    trial t;
    trial_begin(&t, 3, (const double[3]){1.0, 0.5, 0.5}, 0.1);
    t.scene->time.solver = SOLVER_IMPLICIT;
    t.scene->time.increments = 3;
    t.scene->time.end = 0.03;
    scene_body *b = add_body(&t, add_solid(&t, "neo_hookean", 1e6, 0.6e6, 1000.0),
                             make_box(&t, (const double[3]){0.1, 0.1, 0.1}, (const double[3]){0.3, 0.4, 0.3}), 2);
    b->velocity[0] = 9.0;
    b->velocity[1] = 1.0;
    add_load(&t, LOAD_BODY_FORCE, -1)->vector[1] = -20.0;
    trial_start(&t);
    trial_run(&t, 0.03);
    check_true(t.sim->steps == 3);
    for (size_t k = 0; k < t.sim->mpm->points[0][0].n; ++k) {
        const fields *f = t.sim->domain->fields[0];
        check_close(field_get(f, P_VEL, 0, 0)[k], 9.0, 1e-11);
        check_close(field_get(f, P_VEL, 0, 1)[k], 1.0 - 20.0 * 0.03, 1e-11);
    }
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY) <= 1e-12);
    trial_end(&t);
}

/* auto takes what can be solved for, and says why. */
static void auto_says_why(void **unused)
{
    (void)unused;
    static const struct {
        const char *deck, *why;
        bool is_static;
    } cases[] = {{"annulus_traction", "state of rest", true}, {"bar_vibration", "no state of rest", false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const char *const set[] = {"time.solver=auto"};
        trial t;
        deck_begin(&t, cases[k].deck, set, 1);
        trial_start(&t);
        assert_int_equal(sim_is_static(t.sim), cases[k].is_static);
        assert_non_null(strstr(t.sim->solver_reason, cases[k].why));
        trial_end(&t);
    }
    static const char *const refused[][2] = {{"two_bars", "contact={kind: friction, friction: 0.3}"},
                                             {"annulus_traction", "method.basis=cpdi"}};
    for (size_t k = 0; k < sizeof refused / sizeof *refused; ++k) {
        const char *const set[] = {"time.solver=static", refused[k][1]};
        trial t;
        deck_begin(&t, refused[k][0], set, 2);
        check_fails(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_MPM), FLOE_BAD_INPUT);
        trial_end(&t);
    }
}

static const deck_variant ring[] = {
    {"ring", "annulus_traction", COUPLING_MPM, 1, 3, {"time.solver=static", "time.increments=3", "domain.cell=0.05"}},
    {"swinging ring",
     "annulus_traction",
     COUPLING_MPM,
     1,
     4,
     {"time.solver=implicit", "time.increments=12", "domain.cell=0.05", "time.end=1e-3"}},
    {"pressed cylinder", "pressed_cylinder", COUPLING_MPM, 1, 2, {"domain.cell=0.025", "time.increments=2"}},
    {"all but incompressible ring",
     "annulus_traction",
     COUPLING_MPM,
     1,
     4,
     {"time.solver=static", "time.increments=3", "domain.cell=0.05",
      "materials.steel.law.linear_elastic.shear_modulus=1e8"}}};

static state solved(const deck_variant *v, int blocks, int threads)
{
    trial t;
    exact solution;
    deck_variant cut = *v;
    cut.blocks = blocks;
    variant_load(&t, &cut, &solution);
    use_threads(threads);
    coupled_start(&t);
    trial_run(&t, t.scene->time.end);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    state s = state_of(t.sim);
    state_add_ledger(&s, t.sim);
    variant_end(&t, &solution);
    return s;
}

static void same_bits(void **unused)
{
    (void)unused;
    static const int other[][2] = {{1, 3}, {2, 1}, {2, 2}};
    for (size_t v = 0; v < sizeof ring / sizeof *ring; ++v) {
        state expected = solved(&ring[v], 1, 1);
        for (size_t k = 0; k < sizeof other / sizeof *other; ++k) {
            state found = solved(&ring[v], other[k][0], other[k][1]);
            same_state(&expected, &found);
            state_free(&found);
        }
        state_free(&expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bar_under_its_weight),
        cmocka_unit_test(wall_that_moves),
        cmocka_unit_test(bar_at_large_strain),
        cmocka_unit_test(block_in_space),
        cmocka_unit_test(tube_about_an_axis),
        cmocka_unit_test(iterations_stay),
        cmocka_unit_test(increment_is_interrupted),
        cmocka_unit_test(rest_of_damped_steps),
        cmocka_unit_test(free_bodies_are_refused),
        cmocka_unit_test(auto_says_why),
        cmocka_unit_test(gas_and_bar),
        cmocka_unit_test(gas_in_a_bore),
        cmocka_unit_test(implicit_steps),
        cmocka_unit_test(block_in_flight),
        cmocka_unit_test(same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

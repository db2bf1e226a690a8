/* Load increments of solids beside gas on cells: against exact states of rest, and for the same bits whatever the blocks and threads. */
#include "coupled_fixture.h"

static const double lambda = 2e5, mu = 1e5; /* of a neo-Hookean bar, Pa */
static const double charge = 3e5;           /* Pa: of gas that is let go between a wall and the bar */

static double bar_stress(double stretch)
{
    return (mu * (stretch * stretch - 1.0) + lambda * log(stretch)) / stretch;
}

/* Gas that is 1 m long at first and a bar so many times as stiff, between walls: p = p0 (V0/V)^gamma = p_ref - sigma. */
static double rest_stretch(double length, double stiffer)
{
    double lo = 0.2, hi = 1.0;
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (lo + hi);
        const double more =
            charge * pow(1.0 + length * (1.0 - middle), -1.4) - COUPLED_PRESSURE + stiffer * bar_stress(middle);
        *(more > 0.0 ? &hi : &lo) = middle;
    }
    return lo;
}

static double gas_pressure(trial *t)
{
    double pressure;
    const int gas = ice_material_of(t->sim->ice, t->scene->ambient_material);
    check_ok(t->ctx, ice_mean_pressure(t->sim->ice, gas, NULL, &pressure));
    return pressure;
}

static void find_mean(void *user, const fields *f, int body, size_t k)
{
    double *sum = user;
    const double mass = field_get(f, P_MASS, body, 0)[k];
    sum[0] += mass;
    sum[1] += mass * field_get(f, P_STRESS, body, 0)[k];
}

static void make_gas_and_bar(trial *t, solid_interface interface)
{
    const int dim = interface == INTERFACE_SHARP ? 2 : 1;
    coupled_begin(t, dim, (const double[3]){2.0, 0.4, 0.0}, 0.1);
    t->scene->method.interface = interface;
    t->scene->method.edge_penalty = interface == INTERFACE_SHARP ? 0.05 : 0.0;
    t->scene->ambient_pressure = charge;
    const int solid = add_solid(t, "neo_hookean", lambda + 2.0 / 3.0 * mu, mu, 1000.0);
    t->scene->material[solid].tension_switch = COUPLED_PRESSURE;
    coupled_body(t, solid, make_box(t, (const double[3]){1.0, -1.0, 0.0}, (const double[3]){2.0, 1.0, 0.0}), 2);
    t->scene->time.solver = SOLVER_STATIC;
    t->scene->time.increments = 16;
    t->scene->time.end = 1.0;
}

static void gas_and_bar(void **unused)
{
    (void)unused;
    const double stretch = rest_stretch(1.0, 1.0), wanted = COUPLED_PRESSURE - bar_stress(stretch);
    for (int k = 0; k < 2; ++k) {
        trial t;
        double sum[2] = {0.0, 0.0};
        make_gas_and_bar(&t, k ? INTERFACE_SHARP : INTERFACE_SMEARED);
        coupled_start(&t);
        trial_run(&t, 1.0);
        visit_points(&t, 0, find_mean, sum);
        const double pressure = gas_pressure(&t) / wanted - 1.0, stress = sum[1] / sum[0] / bar_stress(stretch) - 1.0;
        print_message("%s: bar squeezed to %.3f of its length, gas off by %.1e, bar by %.1e; energy by %.1e\n",
                      k ? "sharp" : "smeared", stretch, pressure, stress,
                      ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
        /* Measured 3e-6 and 6e-6 smeared, where load and stress are sums over the same points; 3e-4 and 8e-4 sharp. */
        check_true(fabs(pressure) <= (k ? 1e-3 : 2e-5));
        check_true(fabs(stress) <= (k ? 3e-3 : 2e-5));
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) <= 1e-14);
        check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1.4e-5);
        trial_end(&t);
    }
}

/* An outlet at a pressure, at a side of x. */
static void set_outlet(trial *t, int side, double pressure)
{
    bc_side *b = &t->scene->bc.side[0][side];
    b->kind = BC_OUTLET;
    b->material = t->scene->ambient_material;
    b->pressure = pressure;
    b->temperature = COUPLED_TEMPERATURE;
}

/* The same gas and a bar that is fixed from x = 1.8 on, at a side that lets gas out: the bar is in the way. */
static void gas_shut_in_by_the_bar(void **unused)
{
    (void)unused;
    const double stretch = rest_stretch(0.8, 1e3), wanted = COUPLED_PRESSURE - 1e3 * bar_stress(stretch);
    trial t;
    make_gas_and_bar(&t, INTERFACE_SMEARED);
    scene_material *m = &t.scene->material[t.scene->body[0].material];
    set_param(m->law->params, m->law->n_params, m->law_par, "bulk_modulus", 0, 1e3 * (lambda + 2.0 / 3.0 * mu));
    set_param(m->law->params, m->law->n_params, m->law_par, "shear_modulus", 0, 1e3 * mu);
    set_outlet(&t, SIDE_UPPER, COUPLED_PRESSURE);
    scene_support *end = &t.scene->support[t.scene->n_supports++];
    end->region = make_box(&t, (const double[3]){1.75, -1.0, -1.0}, (const double[3]){3.0, 1.0, 1.0});
    coupled_start(&t);
    trial_run(&t, 1.0);
    const double pressure = gas_pressure(&t) / wanted - 1.0;
    print_message("shut in: gas off by %.1e\n", pressure);
    check_true(fabs(pressure) <= 3e-5); /* 1.7e-5 measured; with the side's it would be 2/3 */
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) <= 1e-14);
    trial_end(&t);
}

/* A bar that is pressed together draws gas in at a side that keeps one pressure: with its mass comes its energy, and no heat. */
static void gas_that_is_drawn_in(void **unused)
{
    (void)unused;
    trial t;
    make_gas_and_bar(&t, INTERFACE_SMEARED);
    t.scene->ambient_pressure = COUPLED_PRESSURE;
    t.scene->time.increments = 1;
    set_outlet(&t, SIDE_LOWER, COUPLED_PRESSURE);
    add_load(&t, LOAD_BODY_FORCE, 0)->vector[0] = 50.0;
    coupled_start(&t);
    trial_run(&t, 1.0);
    const ledger *l = &t.sim->ledger;
    const double mass = l->entry[LEDGER_MASS][LEDGER_BOUNDARY].value,
                 energy = l->entry[LEDGER_ENERGY][LEDGER_BOUNDARY].value;
    print_message("drawn in: %g kg, %g J\n", mass, energy);
    check_true(mass > 0.05);
    check_close_relative(energy, mass * 717.5 * COUPLED_TEMPERATURE, 1e-12);
    trial_end(&t);
}

/* Strain energy of a quarter of Lame's ring in plane strain: half the pressure times what the bore gains. */
static double lame_energy(double a, double b, double pressure, double bulk, double shear)
{
    const double pi = 3.14159265358979323846, poisson = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
    const double u = pressure * a * a / (2.0 * shear * (b * b - a * a)) * ((1.0 - 2.0 * poisson) * a + b * b / a);
    return 0.5 * pressure * u * 0.5 * pi * a;
}

/* Cells without a fluid have none of its volume and energy; both kinds of cell are there. */
static void check_empty_cells(const trial *t, int r)
{
    const fields *f = t->sim->domain->fields[0];
    const block *b = &t->sim->mesh.block[0];
    int empty = 0, full = 0;
    for (int j = 0; j < b->n[1]; ++j)
        for (int i = 0; i < b->n[0]; ++i) {
            const ptrdiff_t at = mesh_index(b, i, j, 0);
            const double rho = field_get(f, C_RHO, r, 0)[at], volume = field_get(f, C_VOL, r, 0)[at];
            assert_int_equal(rho > 0.0, volume > 0.0);
            if (!(rho > 0.0)) check_true(volume == 0.0 && field_get(f, C_ENERGY, r, 0)[at] == 0.0);
            *(rho > 0.0 ? &full : &empty) += 1;
        }
    check_true(empty > 0 && full > 0);
}

/* The cylinder, whose gas is heated to a pressure; the gas outside goes where it is pushed. */
static void gas_in_a_bore(void **unused)
{
    (void)unused;
    static const char *const interface[] = {"method.interface=smeared", "method.interface=sharp"};
    const double expected = lame_energy(0.5, 1.0, 19.4e6, 117e9, 43.8e9);
    for (int k = 0; k < 2; ++k) {
        const char *const set[] = {"time.solver=auto", "domain.cell=0.05", "method.edge_penalty=0.05", interface[k]};
        trial t;
        sim_totals totals;
        deck_begin(&t, "pressurized_cylinder", set, 4);
        coupled_start(&t);
        assert_non_null(strstr(t.sim->solver_reason, "state of rest, which can be solved for"));
        trial_run(&t, t.scene->time.end);
        check_true(t.sim->at_rest);
        assert_int_equal(t.sim->steps, 1);
        check_ok(t.ctx, sim_sum(t.sim, &totals));
        double pressure;
        check_ok(t.ctx, ice_mean_pressure(t.sim->ice, ice_material_of(t.sim->ice, t.scene->load[0].material),
                                          &t.scene->load[0].region, &pressure));
        print_message("%s: strain energy off by %.1e, pressure by %.1e\n", interface[k], totals.strain / expected - 1.0,
                      pressure / (19.4e6 + 101325.0) - 1.0);
        check_true(fabs(totals.strain / expected - 1.0) <= 1.7e-3);
        check_close_relative(pressure, 19.4e6 + 101325.0, 2.5e-7);
        if (k == 0) check_empty_cells(&t, ice_material_of(t.sim->ice, t.scene->load[0].material));
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY) <= 1.5e-8);
        trial_end(&t);
    }
}

/* Gas that would not come to rest, and walls that are thinner than the nodes can tell. */
static void what_has_no_rest_is_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *set, *why;
    } cases[] = {
        {"boundaries={x: {lower: symmetry, upper: {outlet: {pressure: 101325 Pa, temperature: 300 K}}}, "
         "y: {lower: symmetry, upper: {outlet: {pressure: 2e5 Pa, temperature: 300 K}}}}",
         "gas would flow between sides"},
        {"boundaries={x: {lower: symmetry, upper: free}, y: {lower: symmetry, upper: slip}}", "drives the gas"},
        {"loads.heating.pressurise.region={ball: {radius: 1.2}}", "flows out at a side"},
        {"bodies.cylinder.shape={annulus: {centre: [0, 0], inner_radius: 0.5, outer_radius: 0.8}}", "too thin"},
        {"time.solver=implicit", "fluids on cells flow"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const char *const set[] = {"time.solver=static",       "domain.cell=0.1",
                                   "time.max_step=1 ms",       "loads.heating.pressurise.region={ball: {radius: 0.5}}",
                                   "method.interface=smeared", cases[k].set};
        trial t;
        deck_begin(&t, "pressurized_cylinder", set, 6);
        floe_status status = sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling);
        if (status == FLOE_OK) status = sim_step(t.sim, t.scene->time.end);
        print_message("%s\n", context_message(t.ctx));
        assert_non_null(strstr(context_message(t.ctx), cases[k].why));
        check_fails(t.ctx, status, FLOE_BAD_INPUT);
        trial_end(&t);
    }
}

/* A plate that is too thin for its nodes to tell the gases of its two sides apart bears nothing where both are at one pressure; not so at two. */
static void thin_plate_between_equal_gases(void **unused)
{
    (void)unused;
    for (int equal = 0; equal < 2; ++equal) {
        char sides[256];
        (void)snprintf(sides, sizeof sides,
                       "boundaries={x: {lower: {outlet: {pressure: %d Pa, temperature: 300 K}}, upper: {outlet: "
                       "{pressure: 101325 Pa, "
                       "temperature: 300 K}}}, y: {lower: no_slip, upper: no_slip}}",
                       equal ? 101325 : 2 * 101325);
        const char *const set[] = {"time.solver=static",
                                   "domain.cell=0.1",
                                   "loads=null",
                                   "method.interface=smeared",
                                   "bodies.bore=null",
                                   "study=null",
                                   "verify=null",
                                   "stop=null",
                                   "bodies.cylinder.shape={box: {lower: [0.53, -1], upper: [0.68, 9]}}",
                                   sides};
        trial t;
        deck_begin(&t, "pressurized_cylinder", set, sizeof set / sizeof *set);
        floe_status status = sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling);
        if (status == FLOE_OK) status = sim_step(t.sim, t.scene->time.end);
        if (equal)
            check_ok(t.ctx, status);
        else
            check_fails(t.ctx, status, FLOE_BAD_INPUT);
        trial_end(&t);
    }
}

static state solved(const char *interface, int blocks, int threads)
{
    const char *const set[] = {"time.solver=static", "time.increments=3", "domain.cell=0.05", interface};
    trial t;
    deck_begin(&t, "pressurized_cylinder", set, 4);
    for (int a = 0; a < 2; ++a) t.scene->mesh.blocks[a] = blocks;
    use_threads(threads);
    coupled_start(&t);
    trial_run(&t, t.scene->time.end);
    return trial_finish(&t);
}

static void same_bits(void **unused)
{
    (void)unused;
    static const char *const interface[] = {"method.interface=smeared", "method.interface=sharp"};
    for (int k = 0; k < 2; ++k) {
        state expected = solved(interface[k], 1, 1), found = solved(interface[k], 2, 2);
        same_state(&expected, &found);
        state_free(&found);
        state_free(&expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gas_and_bar),
        cmocka_unit_test(gas_shut_in_by_the_bar),
        cmocka_unit_test(gas_that_is_drawn_in),
        cmocka_unit_test(gas_in_a_bore),
        cmocka_unit_test(what_has_no_rest_is_refused),
        cmocka_unit_test(thin_plate_between_equal_gases),
        cmocka_unit_test(same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Sides of the domain: what a non-reflecting one sends back, flow from a reservoir, a velocity over time, and what comes back through
 * an outlet. Everything that crosses is in the ledger. */
#include "ice_fixture.h"

#include "verify/order.h"

static void check_ledger(const fixture *f)
{
    /* Round-off of sums of pressures, a thousand times the momentum of the weak pulse; measured: 1.1e-12 at most. */
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
        if (q >= LEDGER_MOMENTUM_X && q < LEDGER_ENERGY && q - LEDGER_MOMENTUM_X >= f->mesh.dim) continue;
        if (q != LEDGER_MASS && f->ledger.scale[q] < 1e-12) continue; /* nothing moves along this axis */
        const double drift = ledger_drift(&f->ledger, (ledger_quantity)q);
        if (!(drift <= 2e-12)) printf("%s drifts by %.1e\n", ledger_quantity_name((ledger_quantity)q), drift);
        check_true(drift <= 2e-12);
    }
}

/* Pressure of an ideal gas of gamma 1.4 in a cell, from its state. */
static double pressure_at(const fixture *f, int i, int j)
{
    const ptrdiff_t at = mesh_index(&f->mesh.block[0], i, j, 0);
    return 0.4 * fixture_array(f, C_RHO, 0, 0)[at] * fixture_array(f, C_ENERGY, 0, 0)[at];
}

/* A gas at rest with c = 1, p = 1. */
static void gas_of(fixture *f, int dim, const int *cells, const double *length)
{
    fixture_create(f, dim, cells, length, false);
    fixture_fill(f, fixture_fluid(f, "ideal", 1.4, 2.5, 0.0), 1.0, (double)NAN, 1.4);
}

static void open_up(fixture *f, int axis, int side)
{
    f->scene->bc.side[axis][side] = (bc_side){.kind = BC_NON_REFLECTING, .pressure = 1.0, .material = -1};
}

/* Share of a pulse that an open end sends back: what is left of it after it has gone. The wave runs up the axis; `flip` mirrors it. */
static double reflected(int dim, int axis, bool flip, double amplitude)
{
    fixture f;
    int cells[3] = {4, 4, 4};
    double length[3] = {0.04, 0.04, 0.04}, most = 0.0;
    cells[axis] = 100;
    length[axis] = 1.0;
    gas_of(&f, dim, cells, length);
    for (int side = 0; side < 2; ++side) open_up(&f, axis, side);
    const fixture_value values[] = {{"density", 1.4, 0}, {"pressure", 1.0, 0}, {"amplitude", amplitude, 0},
                                    {"centre", 0.5, 0},  {"width", 0.08, 0},   {"axis", axis, 0}};
    fixture_exact(&f, "simple_wave", sizeof values / sizeof *values, values);
    fixture_start(&f);
    const block *b = &f.mesh.block[0];
    const ptrdiff_t st = b->stride[axis];
    const size_t first = (size_t)mesh_index(b, 0, 0, 0);
    for (size_t k = 0; flip && k < b->size; ++k) fixture_array(&f, C_VEL, 0, axis)[k] *= -1.0;
    fixture_account(&f, &f.ledger);
    memcpy(f.ledger.initial, f.ledger.total, sizeof f.ledger.initial);
    fixture_run(&f, 1.4);
    for (int i = 0; i < cells[axis]; ++i) {
        const ptrdiff_t at = (ptrdiff_t)first + i * st;
        const double p = 0.4 * fixture_array(&f, C_RHO, 0, 0)[at] * fixture_array(&f, C_ENERGY, 0, 0)[at];
        most = fmax(most, fabs(p - 1.0) / (1.4 * amplitude));
    }
    printf("pulse of %g c out along axis %d, %d-D, %s: %.3f %% sent back\n", amplitude, axis, dim, flip ? "down" : "up",
           100.0 * most);
    check_ledger(&f);
    fixture_destroy(&f);
    return most;
}

/* Measured: 0.10 % of a weak pulse, 0.17 % of one of 5 % of the sound speed, with eight cells a standard deviation. */
static void pulse_leaves(void **state)
{
    (void)state;
    check_true(reflected(1, 0, false, 1e-3) <= 8e-6);
    check_true(reflected(1, 0, true, 1e-3) <= 8e-6);
    check_true(reflected(1, 0, false, 0.05) <= 8e-4);
    check_true(reflected(2, 1, false, 1e-3) <= 1e-5);
    check_true(reflected(3, 2, true, 1e-3) <= 1e-5);
}

/* A hump of pressure in the middle of a square of `length`, at rest; the pressures of the inner 40x40 cells at t = 0.8. */
static void hump(int cells, double *p)
{
    fixture f;
    const double h = 0.025;
    gas_of(&f, 2, (const int[]){cells, cells}, (const double[]){cells * h, cells * h});
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side) open_up(&f, axis, side);
    fixture_start(&f);
    const block *b = &f.mesh.block[0];
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const double x = (i + 0.5 - 0.5 * cells) * h, y = (j + 0.5 - 0.5 * cells) * h;
            const ptrdiff_t at = mesh_index(b, i, j, 0);
            const double rise = 1.0 + 1e-3 * exp(-0.5 * (x * x + y * y) / 0.01);
            fixture_array(&f, C_RHO, 0, 0)[at] *= pow(rise, 1.0 / 1.4);
            fixture_array(&f, C_ENERGY, 0, 0)[at] *= pow(rise, 0.4 / 1.4);
        }
    fixture_account(&f, &f.ledger);
    memcpy(f.ledger.initial, f.ledger.total, sizeof f.ledger.initial);
    fixture_run(&f, 0.8);
    check_ledger(&f);
    for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) p[40 * j + i] = pressure_at(&f, cells / 2 - 20 + i, cells / 2 - 20 + j);
    fixture_destroy(&f);
}

/* At all angles, up to that of the corners: against a square so large that nothing has come back. The wave is 2.4e-4 high when it
 * meets the sides. Measured: at most 15 % of that comes back, towards the corners, where a condition of one dimension sends back
 * (1 - cos a)/(1 + cos a), 17 % at 45 degrees. */
static void all_angles(void **state)
{
    (void)state;
    static double small[1600], large[1600];
    hump(40, small);
    hump(80, large);
    double most = 0.0;
    for (int k = 0; k < 1600; ++k) most = fmax(most, fabs(small[k] - large[k]));
    printf("round wave out of a square: %.2e comes back, %.2f %% of what meets the sides\n", most,
           100.0 * most / 2.4e-4);
    check_true(most <= 0.17 * 2.4e-4);
}

/* From fluid at rest through a duct against a lower pressure: the steady flow is the isentrope of either law. A reservoir and an outlet
 * behind which such fluid is known give the same. */
static void reservoir(void **state)
{
    (void)state;
    for (int variant = 0; variant < 6; ++variant) {
        fixture f;
        const bool stiff = variant % 3 == 1, upper = variant % 3 == 2, outlet = variant >= 3;
        fixture_create(&f, 1, (const int[]){16}, (const double[]){1.0}, false);
        const int fluid =
            stiff ? fixture_fluid(&f, "stiffened", 3.0, 1.0, 2.0) : fixture_fluid(&f, "ideal", 1.4, 2.5, 0.0);
        const double gamma = stiff ? 3.0 : 1.4, cv = stiff ? 1.0 : 2.5, p_inf = stiff ? 2.0 : 0.0, p0 = 1.2;
        fixture_fill(&f, fluid, 1.0, 1.0, (double)NAN);
        f.scene->bc.side[0][upper].kind = outlet ? BC_OUTLET : BC_RESERVOIR;
        f.scene->bc.side[0][upper].pressure = p0;
        f.scene->bc.side[0][upper].temperature = 1.0;
        f.scene->bc.side[0][upper].material = fluid;
        f.scene->bc.side[0][!upper] = (bc_side){.kind = BC_OUTLET, .pressure = 1.0, .material = -1};
        fixture_start(&f);
        fixture_run(&f, 40.0);
        /* h = gamma c_v T, T ~ (p + p_inf)^((gamma - 1)/gamma) */
        const double T = pow((1.0 + p_inf) / (p0 + p_inf), (gamma - 1.0) / gamma),
                     u = sqrt(2.0 * gamma * cv * (1.0 - T));
        const ptrdiff_t at = mesh_index(&f.mesh.block[0], 8, 0, 0);
        const double found = fixture_array(&f, C_VEL, 0, 0)[at], rho = fixture_array(&f, C_RHO, 0, 0)[at];
        const double density = (1.0 + p_inf) / ((gamma - 1.0) * cv * T);
        printf("from rest, case %d: u = %.9f of %.9f, density off by %.1e\n", variant, found, upper ? -u : u,
               rho / density - 1.0);
        check_close(found, upper ? -u : u, 3e-8);
        check_close(rho, density, 8e-9);
        check_ledger(&f);
        fixture_destroy(&f);
    }
}

/* Runs from a state at rest: mass and energy that enter (kg, J). */
static void fill(fixture *f, double *mass, double *energy)
{
    ice_totals first, last;
    fixture_start(f);
    check_ok(f->ctx, ice_sum(f->ice, &first));
    fixture_run(f, 0.3);
    check_ok(f->ctx, ice_sum(f->ice, &last));
    *mass = last.mass[0] - first.mass[0];
    *energy = last.internal[0] + last.kinetic[0] - first.internal[0];
}

/* A closed vessel that a reservoir fills, or an outlet behind which such fluid is known: what enters brings the enthalpy of the fluid at rest, from the first step on. 4e-6 to 5e-4 off. */
static void filling(void **state)
{
    (void)state;
    static const double inside[] = {5.0, 1.0, 0.1, 0.01};
    for (int variant = 0; variant < 12; ++variant) {
        fixture f;
        const int dim = 1 + variant / 4 % 2;
        fixture_create(&f, dim, (const int[]){20, 8}, (const double[]){1.0, 0.4}, false);
        fixture_fluid(&f, "ideal", 1.4, 2.5, 0.0);
        fixture_fill(&f, 0, inside[variant % 4], 1.0, (double)NAN);
        f.scene->bc.side[0][0] = (bc_side){.kind = BC_RESERVOIR, .pressure = 10.0, .temperature = 1.0, .material = 0};
        if (variant >= 8) f.scene->bc.side[0][0].kind = BC_OUTLET;
        double mass, energy;
        fill(&f, &mass, &energy);
        printf("filled from %g of the reservoir's pressure: energy of what enters %.1e off\n",
               0.1 * inside[variant % 4], energy / (3.5 * mass) - 1.0);
        check_close_relative(energy, 3.5 * mass, 1e-3);
        fixture_destroy(&f);
    }
}

/* What flows out through each side of each axis, alone, is in the ledger, in space too. */
static void every_side_is_counted(void **state)
{
    (void)state;
    static const int cells[] = {10, 8, 6};
    static const double length[] = {1.0, 0.9, 0.8};
    for (int dim = 1; dim <= 3; ++dim)
        for (int axis = 0; axis < dim; ++axis)
            for (int side = 0; side < 2; ++side) {
                fixture f;
                gas_of(&f, dim, cells, length);
                open_up(&f, axis, side);
                f.scene->bc.side[axis][side].pressure = 0.8;
                fixture_start(&f);
                fixture_run(&f, 0.3);
                check_ledger(&f);
                const double *left = f.ledger.total, *had = f.ledger.initial;
                check_true(left[LEDGER_MASS] < 0.99 * had[LEDGER_MASS] &&
                           left[LEDGER_ENERGY] < 0.99 * had[LEDGER_ENERGY]);
                fixture_destroy(&f);
            }
}

static double wave_error(int cells, double speed)
{
    fixture f;
    gas_of(&f, 1, &cells, (const double[]){1.0});
    f.scene->method.limiter = ICE_LIMITER_NONE;
    bc_side *side = &f.scene->bc.side[0][0];
    side->kind = BC_VELOCITY;
    side->velocity[0] = speed;
    side->course.ramp = 0.5;
    const fixture_value values[] = {
        {"density", 1.4, 0}, {"pressure", 1.0, 0}, {"speed", speed, 0}, {"ramp", 0.5, 0}, {"moving", 0.0, 0}};
    fixture_exact(&f, "piston_wave", sizeof values / sizeof *values, values);
    fixture_start(&f);
    fixture_run(&f, 0.9);
    check_ledger(&f);
    const double error = fixture_density_error(&f).l1;
    fixture_destroy(&f);
    return error;
}

/* A side whose velocity follows time: order against the simple wave. Measured: 1.9 drawing at 0.3 c, 2.1 pushing at 0.1 c. */
static void velocity_over_time(void **state)
{
    (void)state;
    context *ctx = context_create();
    static const double speeds[] = {-0.3, 0.1};
    for (int s = 0; s < 2; ++s) {
        double h[3], error[3];
        order_fit fit;
        for (int k = 0; k < 3; ++k) {
            h[k] = 1.0 / (50 << k);
            error[k] = wave_error(50 << k, speeds[s]);
        }
        check_ok(ctx, order_fit_power(ctx, 3, h, error, &fit));
        printf("side at %g c: L1 %.3e %.3e %.3e, order %.2f\n", speeds[s], error[0], error[1], error[2], fit.order);
        check_true(fit.order >= 1.75);
    }
    context_destroy(&ctx);
}

/* Fluid that leaves an outlet faster than its sound does not feel the pressure outside. */
static void supersonic_outlet(void **state)
{
    (void)state;
    static const double outside[] = {0.2, 3.0};
    for (int k = 0; k < 2; ++k) {
        fixture f;
        fixture_create(&f, 1, (const int[]){20}, (const double[]){1.0}, false);
        fixture_fill(&f, fixture_fluid(&f, "ideal", 1.4, 2.5, 0.0), 1.0, (double)NAN, 1.4);
        f.scene->bc.side[0][0] =
            (bc_side){.kind = BC_INLET, .pressure = 1.0, .temperature = 1.0 / 1.4, .velocity = {2.0, 0.0, 0.0}};
        f.scene->bc.side[0][1] = (bc_side){.kind = BC_OUTLET, .pressure = outside[k], .material = -1};
        fixture_start(&f);
        for (int i = 0; i < 20; ++i) fixture_array(&f, C_VEL, 0, 0)[mesh_index(&f.mesh.block[0], i, 0, 0)] = 2.0;
        fixture_account(&f, &f.ledger);
        memcpy(f.ledger.initial, f.ledger.total, sizeof f.ledger.initial);
        fixture_run(&f, 1.0);
        double most = 0.0;
        for (int i = 0; i < 20; ++i) most = fmax(most, fabs(pressure_at(&f, i, 0) - 1.0));
        printf("Mach 2 against %g of its pressure: pressure off by %.1e\n", outside[k], most);
        check_true(most <= 1e-13);
        check_ledger(&f);
        fixture_destroy(&f);
    }
}

/* A gas at low pressure sucks in what lies behind an outlet that says so. */
static void backflow(void **state)
{
    (void)state;
    fixture f;
    fixture_create(&f, 1, (const int[]){50}, (const double[]){1.0}, false);
    fixture_fill(&f, fixture_fluid(&f, "ideal", 1.4, 2.5, 0.0), 0.8, 1.0, (double)NAN);
    f.scene->bc.side[0][1] = (bc_side){.kind = BC_OUTLET, .pressure = 1.0, .temperature = 2.0, .material = 0};
    fixture_start(&f);
    fixture_run(&f, 1.0);
    const double T = fixture_array(&f, C_ENERGY, 0, 0)[mesh_index(&f.mesh.block[0], 49, 0, 0)] / 2.5;
    printf("backflow: temperature at the side %.3f\n", T);
    check_true(T > 1.85 && T < 2.05);
    check_ledger(&f);
    fixture_destroy(&f);
}

/* Work that a square meter of gas of gamma 1.4 at `ratio` times the pressure 1 outside gives along its isentrope. */
static double work_of_charge(double ratio)
{
    const double v = pow(ratio, 1.0 / 1.4);
    return (ratio - v) / 0.4 - (v - 1.0);
}

/* A blast in a corner leaves through two outlets of which nothing more is known, overshoots, and is sucked back in, for five swings: there is
 * never more motion than the charge can give, and in the last third of the time next to none. Measured: 0.59 and 0.037 of that. With the
 * whole pressure on the face, however fast the gas comes in, motion grows without end. */
static void blast_swings(void **state)
{
    (void)state;
    fixture f;
    ice_totals t;
    double most = 0.0, moving = 0.0, stored, work = 0.0;
    fixture_create(&f, 2, (const int[]){24, 12}, (const double[]){1.2, 0.6}, false);
    fixture_fluid(&f, "ideal", 1.4, 2.5, 0.0);
    fixture_fill(&f, 0, 1.0, 1.0, (double)NAN);
    for (int axis = 0; axis < 2; ++axis)
        f.scene->bc.side[axis][1] = (bc_side){.kind = BC_OUTLET, .pressure = 1.0, .material = -1};
    fixture_start(&f);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 6; ++i) {
            const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, j, 0);
            fixture_array(&f, C_ENERGY, 0, 0)[at] *= 2.0;
            fixture_array(&f, C_RHO, 0, 0)[at] *= 7.5;
            work += 0.05 * 0.05 * work_of_charge(15.0);
        }
    check_ok(f.ctx, ice_stored_work(f.ice, 1.0, &stored));
    check_close_relative(stored, work, 1e-12);
    fixture_account(&f, &f.ledger);
    memcpy(f.ledger.initial, f.ledger.total, sizeof f.ledger.initial);
    for (int k = 1; k <= 90 && most <= work; ++k) {
        f.steps = 0; /* first steps are short */
        fixture_run(&f, 0.1 * k);
        check_ok(f.ctx, ice_sum(f.ice, &t));
        most = fmax(most, t.kinetic[0]);
        if (k > 60) moving = fmax(moving, t.kinetic[0]);
    }
    printf("blast: motion of %.2f of what the charge can give, %.3f at the end\n", most / work, moving / work);
    check_true(most <= work && moving <= 0.07 * work);
    check_ledger(&f);
    fixture_destroy(&f);
}

/* A liquid in tension draws in the same liquid from rest, faster than its isentrope can go: what enters brings its enthalpy. Led to the sound
 * of the liquid at rest, that isentrope had no density. */
static void liquid_fills(void **state)
{
    (void)state;
    for (int outlet = 0; outlet < 2; ++outlet) {
        fixture f;
        fixture_create(&f, 1, (const int[]){20}, (const double[]){1.0}, false);
        fixture_fluid(&f, "stiffened", 4.4, 1.0, 1.0);
        fixture_fill(&f, 0, -0.9, 1.0, (double)NAN);
        f.scene->bc.side[0][0] =
            (bc_side){.kind = outlet ? BC_OUTLET : BC_RESERVOIR, .pressure = 10.0, .temperature = 1.0, .material = 0};
        double mass, energy;
        fill(&f, &mass, &energy);
        printf("liquid: %.3f of mass entered, its energy %.1e off\n", mass, energy / (4.4 * mass) - 1.0);
        check_close_relative(energy, 4.4 * mass, 1.4e-5);
        fixture_destroy(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pulse_leaves),          cmocka_unit_test(all_angles), cmocka_unit_test(reservoir),
        cmocka_unit_test(every_side_is_counted), cmocka_unit_test(backflow),   cmocka_unit_test(velocity_over_time),
        cmocka_unit_test(supersonic_outlet),     cmocka_unit_test(filling),    cmocka_unit_test(blast_swings),
        cmocka_unit_test(liquid_fills),

    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

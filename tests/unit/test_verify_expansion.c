/* Gas that expands into a vacuum: against the plane Riemann problem, for what is conserved, for the order of its nets, and
 * against an independent Lagrangian computation. */
#include "check.h"

#include "base/memory.h"
#include "verify/exact.h"
#include "verify/radial_fan.h"
#include "verify/riemann.h"

#include <math.h>
#include <string.h>

static const double gamma = 1.4, radius = 0.376;

static fan_gas york(int geometry)
{
    return (fan_gas){.geometry = geometry, .radius = radius, .sound = sqrt(140.0), .gamma = gamma};
}

/* York (1997), section 4.2 (validation row B2): the front runs at 59.2 and reaches 1 at 0.0105. */
static void test_front(void **state)
{
    (void)state;
    const fan_gas gas = york(1);
    check_close(fan_front_speed(&gas), 59.2, 0.05);
    check_close((1.0 - 0.38) / fan_front_speed(&gas), 0.0105, 5e-5);
}

/* A slab is the Riemann problem between the gas and a vacuum. */
static void test_slab(void **state)
{
    context *ctx = *state;
    radial_fan *fan;
    riemann_solution riemann;
    const fan_gas gas = york(0);
    check_ok(ctx, memory_new(ctx, &fan, 1, sizeof *fan));
    check_ok(ctx, radial_fan_solve(ctx, &gas, fan));
    check_ok(ctx, riemann_solve(ctx, &(riemann_side){1.0, 0.0, 100.0, gamma, 0.0, 0.0},
                                &(riemann_side){0.0, 0.0, 0.0, gamma, 0.0, 0.0}, &riemann));
    for (int i = 1; i < 100; i++) {
        const double t = 0.004 + 1e-4 * i;
        const double speed = -gas.sound + (gas.sound + fan_front_speed(&gas)) * i / 100.0;
        const riemann_state plane = riemann_sample(&riemann, speed);
        const fan_state s = radial_fan_at(fan, radius + speed * t, t);
        check_close_relative(s.velocity, plane.velocity, 1e-7);
        check_close(pow(s.sound / gas.sound, 5.0), plane.density, 1e-7);
    }
    const fan_state beyond = radial_fan_at(fan, 1.5, 0.005);
    check_close(beyond.sound, 0.0, 0.0);
    check_close(beyond.velocity, fan_front_speed(&gas), 0.0);
    memory_free(ctx, &fan);
}

/* Mass and energy over those at the start, less 1, by the midpoint rule over the fan. */
static void conserved(const radial_fan *fan, double t, double *mass, double *energy)
{
    enum { PIECES = 8000 };
    const fan_gas *gas = &fan->gas;
    const double inner = gas->radius - gas->sound * t;
    const double width = (gas->sound + fan_front_speed(gas)) * t / PIECES;
    const int a = gas->geometry;
    double masses = pow(inner, a + 1) / (a + 1), energies = masses;
    for (int i = 0; i < PIECES; i++) {
        const double r = inner + (i + 0.5) * width;
        const fan_state s = radial_fan_at(fan, r, t);
        const double c2 = s.sound * s.sound, c02 = gas->sound * gas->sound;
        const double density = pow(c2 / c02, 1.0 / (gamma - 1.0));
        masses += density * pow(r, a) * width;
        /* over rho0 e0, e0 = c0^2/(gamma (gamma - 1)) */
        energies += density * (c2 + 0.5 * gamma * (gamma - 1.0) * s.velocity * s.velocity) / c02 * pow(r, a) * width;
    }
    *mass = masses * (a + 1) / pow(gas->radius, a + 1) - 1.0;
    *energy = energies * (a + 1) / pow(gas->radius, a + 1) - 1.0;
}

static void test_conserved(void **state)
{
    context *ctx = *state;
    radial_fan *fan;
    double mass[3], energy[3];
    check_ok(ctx, memory_new(ctx, &fan, 1, sizeof *fan));
    for (int geometry = 1; geometry < 3; geometry++) {
        const fan_gas gas = york(geometry);
        /* one net alone: second order */
        for (int halvings = 0; halvings < 3; halvings++) {
            check_ok(ctx, radial_fan_march(ctx, &gas, halvings, fan));
            conserved(fan, 0.005, &mass[halvings], &energy[halvings]);
        }
        for (int i = 0; i < 2; i++) {
            check_close(log2(mass[i] / mass[i + 1]), 2.0, 0.05);
            check_close(log2(energy[i] / energy[i + 1]), 2.0, 0.05);
        }
        check_ok(ctx, radial_fan_solve(ctx, &gas, fan));
        conserved(fan, 0.003, mass, energy);
        check_close(mass[0], 0.0, 1e-7);
        check_close(energy[0], 0.0, 1e-7);
        conserved(fan, fan->limit, mass, energy);
        check_close(mass[0], 0.0, 5e-5);
        check_close(energy[0], 0.0, 5e-5);
    }
    check_true(isnan(radial_fan_at(fan, 0.1, 1.01 * fan->limit).sound));
    memory_free(ctx, &fan);
}

/* von Neumann and Richtmyer's staggered scheme for a cylinder, without viscosity as there is no shock: zones of equal mass,
 * p v^gamma constant. Returns the L1 distance of its density from the exact one, weighted by mass, over the mean. */
static double lagrange_distance(context *ctx, const exact *s, int zones, double end)
{
    double *store;
    check_ok(ctx, memory_new(ctx, &store, 3 * (size_t)zones + 2, sizeof *store));
    double *r = store, *u = store + zones + 1, *rho = u + zones + 1;
    const double mass = 0.5 * radius * radius / zones;
    for (int i = 0; i <= zones; i++) r[i] = radius * sqrt((double)i / zones);
    const int steps = 40 * zones;
    const double dt = end / steps;
    for (int n = 0; n <= steps; n++) {
        const double kick = n == 0 || n == steps ? 0.5 * dt : dt;
        for (int i = 0; i < zones; i++) rho[i] = mass / (0.5 * (r[i + 1] * r[i + 1] - r[i] * r[i]));
        for (int i = 1; i <= zones; i++) {
            const double inside = 100.0 * pow(rho[i - 1], gamma);
            const double outside = i < zones ? 100.0 * pow(rho[i], gamma) : 0.0;
            u[i] += kick * (inside - outside) * r[i] / (i < zones ? mass : 0.5 * mass);
        }
        for (int i = 1; i <= zones && n < steps; i++) r[i] += dt * u[i];
    }
    double sum = 0.0, size = 0.0;
    for (int i = 0; i < zones; i++) {
        const double x[3] = {sqrt(0.5 * (r[i] * r[i] + r[i + 1] * r[i + 1])), 0.0, 0.0};
        sum += fabs(rho[i] - exact_value(s, EXACT_DENSITY, x, end));
        size += rho[i];
    }
    memory_free(ctx, &store);
    return sum / size;
}

static void test_lagrange(void **state)
{
    context *ctx = *state;
    const exact_model *model = exact_find("gas_expansion");
    exact s;
    check_ok(ctx, exact_create(ctx, model, model->sample.par, 2, &s));
    const double coarse = lagrange_distance(ctx, &s, 50, 0.005), fine = lagrange_distance(ctx, &s, 200, 0.005);
    check_true(coarse < 0.02);
    check_true(fine < 0.4 * coarse);
    exact_destroy(ctx, &s);
}

/* The balance laws by differences over 1e-4 m and 1e-6 s, in a slab, a cylinder and a sphere. */
static void test_balances(void **state)
{
    context *ctx = *state;
    const exact_model *model = exact_find("gas_expansion");
    for (int geometry = 0; geometry < 3; geometry++) {
        double par[16];
        exact s;
        memcpy(par, model->sample.par, model->param_size);
        *exact_param(model, par, "geometry") = geometry;
        check_ok(ctx, exact_create(ctx, model, par, 3, &s));
        for (int i = 0; i < 20; i++) {
            const double r = 0.335 + 0.012 * i, t = 0.005, dr = 1e-4, dt = 1e-6;
            double rate[2], slope[2], value[3];
            for (int q = 0; q < 2; q++) {
                const exact_quantity quantity = q == 0 ? EXACT_DENSITY : EXACT_VELOCITY_X;
                const double x[3] = {r, 0.0, 0.0}, on[3] = {r + dr, 0.0, 0.0}, back[3] = {r - dr, 0.0, 0.0};
                value[q] = exact_value(&s, quantity, x, t);
                rate[q] = (exact_value(&s, quantity, x, t + dt) - exact_value(&s, quantity, x, t - dt)) / (2.0 * dt);
                slope[q] = (exact_value(&s, quantity, on, t) - exact_value(&s, quantity, back, t)) / (2.0 * dr);
            }
            value[2] = gamma * 100.0 * pow(value[0], gamma - 1.0); /* c^2 */
            const double flux = value[1] * slope[0] + value[0] * slope[1] + geometry * value[0] * value[1] / r;
            check_close(rate[0], -flux, 1e-4 * (fabs(rate[0]) + fabs(value[0] * slope[1])));
            const double force = value[1] * slope[1] + value[2] / value[0] * slope[0];
            check_close(rate[1], -force, 1e-4 * (fabs(value[1] * slope[1]) + fabs(rate[1])));
        }
        exact_destroy(ctx, &s);
    }
}

static void test_refused(void **state)
{
    context *ctx = *state;
    const exact_model *model = exact_find("gas_expansion");
    exact s;
    check_fails(ctx, exact_create(ctx, model, model->sample.par, 1, &s), FLOE_BAD_INPUT); /* a cylinder in 1-D */
    const fan_gas gas = york(1);
    radial_fan *fan;
    check_ok(ctx, memory_new(ctx, &fan, 1, sizeof *fan));
    for (int k = 1; k <= 3; k++) {
        memory_inject_failure(ctx, (uint64_t)k);
        check_fails(ctx, radial_fan_solve(ctx, &gas, fan), FLOE_NO_MEMORY);
        memory_inject_failure(ctx, 0);
    }
    memory_free(ctx, &fan);
    check_true(memory_read_account(ctx).live_bytes == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_front),    cmocka_unit_test(test_slab),     cmocka_unit_test(test_conserved),
        cmocka_unit_test(test_lagrange), cmocka_unit_test(test_balances), cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests_name("expansion into a vacuum", tests, check_make_context, check_drop_context);
}

/* Exact solutions of fluids: limits, periods, conservation, exchange; and exact cell averages against integrals by hand. */
#include "exact_fixture.h"
#include "exact_values.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static double get(const fixture *f, exact_quantity quantity, double x, double y, double t)
{
    const double at[3] = {x, y, 0.0};
    return exact_value(&f->solution, quantity, at, t);
}

static void test_pulse(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "acoustic_pulse", 1, SET({"left_amplitude", 0.0}));
    const double lap = 1.0 / 370.0; /* c + u = 370 */
    check_close(get(&f, EXACT_PRESSURE, 0.5, 0.0, 0.0), 1e5 + 1.0 + 2.0 * exp(-50.0), 1e-9);
    check_close(get(&f, EXACT_PRESSURE, 0.43, 0.0, lap), get(&f, EXACT_PRESSURE, 0.43, 0.0, 0.0), 1e-9);
    check_close(get(&f, EXACT_PRESSURE, 1.43, 0.0, 0.0), get(&f, EXACT_PRESSURE, 0.43, 0.0, 0.0), 1e-9);
    check_close(get(&f, EXACT_VELOCITY_X, 0.5, 0.0, 0.0) - 30.0, 1.0 / (1.2 * 340.0), 1e-12);
    exact_destroy(ctx, &f.solution);
    /* equal amplitudes start without motion */
    make(ctx, &f, "acoustic_pulse", 2, SET({"left_amplitude", 1.0}, {"axis", 1.0}));
    check_close(get(&f, EXACT_VELOCITY_Y, 0.0, 0.45, 0.0), 30.0, 1e-13);
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.45, 1e-4), 0.0, 0.0);
    exact_destroy(ctx, &f.solution);
    refuse(ctx, "acoustic_pulse", 1, SET({"width", 0.3}));
    refuse(ctx, "acoustic_pulse", 1, SET({"axis", 1.0}));
    refuse(ctx, "acoustic_pulse", 1, SET({"axis", 0.5}));
    refuse(ctx, "simple_wave", 1, SET({"width", 0.7}));
    refuse(ctx, "simple_wave", 1, SET({"amplitude", 6.0}));
    refuse(ctx, "isentropic_vortex", 2, SET({"strength", 12.0}));
}

/* As the amplitude a falls the simple wave becomes d'Alembert's: the difference falls as a^2. */
static void test_simple_wave_limit(void **state)
{
    context *ctx = *state;
    double previous = NAN;
    for (int i = 0; i < 3; i++) {
        const double amplitude = 1e-2 * pow(0.1, i);
        fixture wave, pulse;
        make(ctx, &wave, "simple_wave", 1, SET({"amplitude", amplitude}));
        make(ctx, &pulse, "acoustic_pulse", 1,
             SET({"density", 1.4}, {"sound_speed", 1.0}, {"pressure", 1.0}, {"velocity", 0.3}, {"width", 1.0},
                 {"sine", 1.0}, {"amplitude", 1.4 * amplitude}, {"left_amplitude", 0.0}));
        const double apart =
            fabs(get(&wave, EXACT_PRESSURE, 0.3, 0.0, 0.2) - get(&pulse, EXACT_PRESSURE, 0.3, 0.0, 0.2));
        check_true(i == 0 || (apart < 0.012 * previous && apart > 0.008 * previous));
        previous = apart;
        exact_destroy(ctx, &wave.solution);
        exact_destroy(ctx, &pulse.solution);
    }
}

/* One entropy, one Riemann invariant; mass of a period kept; nothing given once it has broken. */
static void test_simple_wave(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "simple_wave", 1, NONE);
    const double broken = exact_scalar_value(&f.solution, "break_time", 0.0);
    check_close_relative(broken, 2.0 / (2.4 * 0.1 * 2.0 * pi), 1e-14);
    const double t = 0.98 * broken;
    const double lo[3] = {0.0}, hi[3] = {1.0};
    const double start = exact_cell_average(&f.solution, EXACT_DENSITY, lo, hi, 0.0, EXACT_PLAIN);
    check_close(exact_cell_average(&f.solution, EXACT_DENSITY, lo, hi, t, EXACT_PLAIN), start, 1e-11);
    for (int i = 0; i < 50; i++) {
        const double x = 0.02 * i;
        const double rho = get(&f, EXACT_DENSITY, x, 0.0, t);
        const double p = get(&f, EXACT_PRESSURE, x, 0.0, t);
        check_close_relative(p, pow(rho / 1.4, 1.4), 1e-13);
        check_close(get(&f, EXACT_VELOCITY_X, x, 0.0, t) - 5.0 * sqrt(1.4 * p / rho), 0.3 - 5.0, 1e-13);
    }
    check_true(isnan(get(&f, EXACT_DENSITY, 0.3, 0.0, broken)));
    check_true(isnan(exact_cell_average(&f.solution, EXACT_DENSITY, lo, hi, 2.0 * broken, EXACT_PLAIN)));
    exact_destroy(ctx, &f.solution);
}

static void test_vortex(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "isentropic_vortex", 2, NONE);
    const double ratio = 1.0 - 0.4 * 25.0 * exp(1.0) / (8.0 * 1.4 * pi * pi); /* temperature at the centre */
    check_close_relative(get(&f, EXACT_DENSITY, 5.0, 5.0, 0.0), pow(ratio, 2.5), 1e-13);
    check_close_relative(get(&f, EXACT_TEMPERATURE, 5.0, 5.0, 0.0), ratio, 1e-13);
    check_close(get(&f, EXACT_VELOCITY_Y, 6.0, 5.0, 0.0), 0.5 + 5.0 / (2.0 * pi), 1e-14);
    check_close(get(&f, EXACT_VELOCITY_X, 5.0, 6.0, 0.0), 1.0 - 5.0 / (2.0 * pi), 1e-14);
    /* after 20 s the stream (1, 0.5) has gone round twice along x and once along y */
    check_close(get(&f, EXACT_VELOCITY_X, 5.7, 4.2, 20.0), get(&f, EXACT_VELOCITY_X, 5.7, 4.2, 0.0), 1e-13);
    exact_destroy(ctx, &f.solution);
}

/* rho1 du1/dt = theta1 theta2 K (u2 - u1), and the heat of drag and exchange, by differences; the sums are kept. */
static void test_relaxation(void **state)
{
    context *ctx = *state;
    fixture first, second;
    make(ctx, &first, "relaxation", 1, SET({"material", 1.0}));
    make(ctx, &second, "relaxation", 1, SET({"material", 2.0}));
    const double heat1 = 0.6 * 700.0, heat2 = 2.0 * 500.0;
    double start = NAN;
    for (int i = 0; i < 20; i++) {
        const double t = 0.02 * i, dt = 1e-5;
        const double u1 = get(&first, EXACT_VELOCITY_X, 0.0, 0.0, t), u2 = get(&second, EXACT_VELOCITY_X, 0.0, 0.0, t);
        const double t1 = get(&first, EXACT_TEMPERATURE, 0.0, 0.0, t),
                     t2 = get(&second, EXACT_TEMPERATURE, 0.0, 0.0, t);
        check_close(0.6 * u1 + 2.0 * u2, 0.6 * 10.0 - 2.0 * 5.0, 1e-13);
        const double energy = heat1 * t1 + heat2 * t2 + 0.5 * 0.6 * u1 * u1 + 0.5 * 2.0 * u2 * u2;
        start = i == 0 ? energy : start;
        check_close_relative(energy, start, 1e-14);
        const double rate_u =
            (get(&first, EXACT_VELOCITY_X, 0.0, 0.0, t + dt) - get(&first, EXACT_VELOCITY_X, 0.0, 0.0, t - dt)) /
            (2.0 * dt);
        check_close(0.6 * rate_u, 0.25 * 10.0 * (u2 - u1), 1e-6);
        const double rate_t =
            (get(&first, EXACT_TEMPERATURE, 0.0, 0.0, t + dt) - get(&first, EXACT_TEMPERATURE, 0.0, 0.0, t - dt)) /
            (2.0 * dt);
        check_close(heat1 * rate_t, 0.25 * 1e4 * (t2 - t1) + 0.25 * 0.25 * 10.0 * (u1 - u2) * (u1 - u2), 1e-2);
    }
    check_close_relative(exact_scalar_value(&first.solution, "velocity_time", 0.0), 1.0 / (2.5 * (1.0 / 0.6 + 0.5)),
                         1e-14);
    exact_destroy(ctx, &first.solution);
    exact_destroy(ctx, &second.solution);

    make(ctx, &first, "relaxation", 1, SET({"momentum_exchange", 1e20}, {"heat_exchange", 1e20}));
    check_close(get(&first, EXACT_VELOCITY_X, 0.0, 0.0, 1e-6), -4.0 / 2.6, 1e-14);
    check_true(isfinite(get(&first, EXACT_TEMPERATURE, 0.0, 0.0, 1e-6)));
    exact_destroy(ctx, &first.solution);
    /* both rates the same: 2/tau of the drag and 1/tau of the heat */
    const double same = 2.0 * 2.5 * (1.0 / 0.6 + 0.5) / (0.25 * (1.0 / heat1 + 1.0 / heat2));
    make(ctx, &first, "relaxation", 1, SET({"heat_exchange", same}));
    make(ctx, &second, "relaxation", 1, SET({"heat_exchange", same * (1.0 + 1e-9)}));
    check_close_relative(get(&first, EXACT_TEMPERATURE, 0.0, 0.0, 0.1), get(&second, EXACT_TEMPERATURE, 0.0, 0.0, 0.1),
                         1e-9);
    exact_destroy(ctx, &first.solution);
    exact_destroy(ctx, &second.solution);
}

static void test_plates(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "couette", 2, NONE);
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.03, 100.0), 0.6, 1e-14);
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.05, 0.0), 0.0, 1e-15);
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.05, 1e-4), 0.0, 1e-13);
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.1, 1e-4), 2.0, 1e-12);
    /* soon after the start: Stokes' first problem, u = U erfc((H - y)/(2 sqrt(nu t))) */
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.098, 1e-4), 2.0 * erfc(0.002 / (2.0 * sqrt(0.01 / 1.2 * 1e-4))),
                1e-12);
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "couette", 2, SET({"starting", 0.0}));
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.03, 0.0), 0.6, 1e-15);
    check_close(get(&f, EXACT_STRESS_XY, 0.0, 0.03, 0.0), 0.2, 1e-15);
    exact_destroy(ctx, &f.solution);

    make(ctx, &f, "poiseuille", 2, NONE);
    const double middle = 3.0 * 1.2 * 0.01 / (8.0 * 0.01);
    check_close_relative(get(&f, EXACT_VELOCITY_X, 0.0, 0.05, 100.0), middle, 1e-14);
    check_close(get(&f, EXACT_VELOCITY_X, 0.0, 0.1, 0.05), 0.0, 1e-15);
    check_close_relative(get(&f, EXACT_VELOCITY_X, 0.0, 0.05, 1e-3), 3e-3, 1e-12); /* far from the plates: g t */
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "poiseuille", 2, SET({"starting", 0.0}));
    check_close_relative(get(&f, EXACT_VELOCITY_X, 0.0, 0.05, 0.0), middle, 1e-14);
    check_close_relative(get(&f, EXACT_STRESS_XY, 0.0, 0.0, 0.0), 3.0 * 1.2 * 0.05, 1e-14);
    exact_destroy(ctx, &f.solution);
}

/* The two series of a starting flow meet where one takes over from the other, in velocity and in stress; and the averages of cells are as
 * quick at the first step as later, beside a plate too. */
static void test_plates_soon_after_the_start(void **state)
{
    context *ctx = *state;
    const char *flow[] = {"couette", "poiseuille"};
    const double nu = 0.01 / 1.2, over = 0.05 * 0.01 / nu; /* EARLY height^2 / nu */
    for (int i = 0; i < 2; i++) {
        fixture f;
        make(ctx, &f, flow[i], 2, NONE);
        for (double y = 0.0; y <= 0.1; y += 0.005) {
            for (exact_quantity q = EXACT_VELOCITY_X; q <= EXACT_STRESS_XY; q += EXACT_STRESS_XY - EXACT_VELOCITY_X)
                check_close(get(&f, q, 0.0, y, over * (1.0 - 1e-13)), get(&f, q, 0.0, y, over * (1.0 + 1e-13)), 1e-12);
        }
        exact_destroy(ctx, &f.solution);
    }
    const double t = 1e-9, skin = 2.0 * sqrt(nu * t), wall[3] = {0.0, 0.0, 0.0}, cell[3] = {0.01, 4e-5, 0.0};
    fixture f;
    make(ctx, &f, "poiseuille", 2, NONE);
    /* what the plate holds back of g t is 4 g t times the third integral of erfc at 0, 1/(6 sqrt(pi)), times the skin */
    check_close_relative(exact_cell_average(&f.solution, EXACT_VELOCITY_X, wall, cell, t, EXACT_PLAIN),
                         3.0 * t * (1.0 - 4.0 * skin / (6.0 * sqrt(pi)) / 4e-5), 1e-9);
    check_close_relative(get(&f, EXACT_STRESS_XY, 0.0, 0.0, t), 1.2 * 3.0 * skin / sqrt(pi), 1e-12);
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "couette", 2, NONE);
    check_close_relative(get(&f, EXACT_STRESS_XY, 0.0, 0.1, t), 0.01 * 2.0 * 2.0 / (sqrt(pi) * skin), 1e-12);
    exact_destroy(ctx, &f.solution);
}

/* Averages in two dimensions, by hand: sin kx cos ky over a box, pressure with its quadratic terms. */
static void test_average_plane(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "taylor_green", 2, SET({"viscosity", 0.0}));
    const double lo[3] = {0.1, 0.3, 0.0}, hi[3] = {0.5, 0.4, 0.0};
    const double by_x = (cos(pi * 0.1) - cos(pi * 0.5)) / (0.4 * pi);
    const double by_y = (sin(pi * 0.4) - sin(pi * 0.3)) / (0.1 * pi);
    check_close(exact_cell_average(&f.solution, EXACT_VELOCITY_X, lo, hi, 3.0, EXACT_PLAIN), 1.5 * by_x * by_y, 1e-14);
    check_true(isnan(exact_cell_average(&f.solution, EXACT_VELOCITY_X, hi, lo, 3.0, EXACT_PLAIN)));
    check_true(isnan(exact_cell_average(&f.solution, EXACT_TEMPERATURE, lo, hi, 3.0, EXACT_PLAIN)));
    exact_destroy(ctx, &f.solution);
}

/* Weighted: sigma_r = A - B/r^2 by r dr; exp(-y/H) by mass exp(-y/H). */
static void test_average_weights(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "lame", 1, NONE);
    const double lo[3] = {0.5}, hi[3] = {0.6};
    const double a = 19.4e6 / 3.0, weight = 0.5 * (0.36 - 0.25);
    check_close_relative(exact_cell_average(&f.solution, EXACT_SIGMA_R, lo, hi, 0.0, EXACT_RADIAL),
                         a - a * log(0.6 / 0.5) / weight, 1e-13);
    check_close_relative(exact_cell_average(&f.solution, EXACT_SIGMA_R, lo, hi, 0.0, EXACT_PLAIN),
                         a - a * (1.0 / 0.5 - 1.0 / 0.6) / 0.1, 1e-13);
    exact_destroy(ctx, &f.solution);

    make(ctx, &f, "hydrostatic", 2, NONE);
    const double low[3] = {0.0, 0.0, 0.0}, high[3] = {1.0, 2000.0, 0.0};
    const double k = 9.80665 * 1.2 / 1e5 * 2000.0;
    check_close_relative(exact_cell_average(&f.solution, EXACT_PRESSURE, low, high, 0.0, EXACT_MASS_WEIGHTED),
                         1e5 * 0.5 * (1.0 - exp(-2.0 * k)) / (1.0 - exp(-k)), 1e-13);
    exact_destroy(ctx, &f.solution);
}

/* A lone contact, moving: the average is linear in its place, to round-off, in one and in three dimensions. */
static void test_average_jump(void **state)
{
    context *ctx = *state;
    const setting contact[] = {{"left_density", 3.0},
                               {"right_density", 1.0},
                               {"left_pressure", 1.0},
                               {"right_pressure", 1.0},
                               {"left_velocity", 0.1},
                               {"right_velocity", 0.1},
                               {"position", 0.2},
                               END,
                               END};
    fixture f;
    const double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {1.0, 1.0, 1.0};
    make(ctx, &f, "riemann", 1, contact);
    for (int i = 0; i <= 10; i++) {
        const double t = 0.7 * i;
        check_close(exact_cell_average(&f.solution, EXACT_DENSITY, lo, hi, t, EXACT_PLAIN), 1.0 + 2.0 * (0.2 + 0.1 * t),
                    1e-14);
        check_close(exact_cell_average(&f.solution, EXACT_VOLUME_FRACTION, lo, hi, t, EXACT_PLAIN), 0.2 + 0.1 * t,
                    1e-14);
        check_close(exact_cell_average(&f.solution, EXACT_VELOCITY_X, lo, hi, t, EXACT_MASS_WEIGHTED), 0.1, 1e-15);
    }
    exact_destroy(ctx, &f.solution);

    setting along_z[9];
    memcpy(along_z, contact, sizeof contact);
    along_z[7] = (setting){"axis", 2.0};
    make(ctx, &f, "riemann", 3, along_z);
    check_close(exact_cell_average(&f.solution, EXACT_DENSITY, lo, hi, 3.0, EXACT_PLAIN), 2.0, 1e-14);
    check_close(exact_cell_average(&f.solution, EXACT_VELOCITY_Z, lo, hi, 3.0, EXACT_PLAIN), 0.1, 1e-15);
    exact_destroy(ctx, &f.solution);
}

/* A jump that the solution does not announce (the piston's end, in displacement's slope): found by halving. */
static void test_average_kink(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "piston", 1, SET({"amplitude", 1.0}, {"phase", 0.5 * pi}));
    const double lo[3] = {19.3}, hi[3] = {20.9};
    const double k = exact_scalar_value(&f.solution, "omega", 0.0) / sqrt(1.58e10);
    const double fluid = (cos(k * 19.3) - cos(k * 20.0)) / (k * sin(k * 20.0));
    check_close_relative(exact_cell_average(&f.solution, EXACT_DISPLACEMENT_X, lo, hi, 0.0, EXACT_PLAIN),
                         (fluid + 0.9) / 1.6, 1e-12);
    exact_destroy(ctx, &f.solution);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pulse),
        cmocka_unit_test(test_simple_wave_limit),
        cmocka_unit_test(test_simple_wave),
        cmocka_unit_test(test_vortex),
        cmocka_unit_test(test_relaxation),
        cmocka_unit_test(test_plates),
        cmocka_unit_test(test_plates_soon_after_the_start),
        cmocka_unit_test(test_average_plane),
        cmocka_unit_test(test_average_weights),
        cmocka_unit_test(test_average_jump),
        cmocka_unit_test(test_average_kink),
    };
    return cmocka_run_group_tests_name("exact fluids and averages", tests, check_make_context, check_drop_context);
}

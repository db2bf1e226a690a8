/* References of histories against published figures and against formulas by hand. */
#include "reference_fixture.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* York (1997), box 9, with 2.199 and 2.190 for the length of the quarter membrane: validation row A3. */
static void test_dogbone(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "membrane_rest", NONE);
    check_close(at(ctx, &f, "radius", 0.0), 1.4006, 2e-4);
    check_close(at(ctx, &f, "pressure", 0.0), 30.80, 0.01);
    check_close(at(ctx, &f, "hoop_stress", 5.0), 431.4, 0.05);
    drop(ctx, &f);
    make(ctx, &f, "membrane_rest", SET({"rest_radius", 2.19 / (0.5 * pi)}));
    check_close(at(ctx, &f, "radius", 0.0), 1.3947, 1e-4);
    check_close(at(ctx, &f, "pressure", 0.0), 31.06, 0.005);
    check_close(at(ctx, &f, "hoop_stress", 0.0), 433.3, 0.15);
    drop(ctx, &f);
    /* Y00 fits a length of 2.136: exact 32.65 and 444.2 */
    make(ctx, &f, "membrane_rest", SET({"rest_radius", 2.136 / (0.5 * pi)}));
    check_close(at(ctx, &f, "pressure", 0.0), 32.65, 0.015);
    check_close(at(ctx, &f, "hoop_stress", 0.0), 444.2, 0.15);
    drop(ctx, &f);
}

/* Sulsky & York (2000), section 8: validation row A4. */
static void test_circle(void **state)
{
    context *ctx = *state;
    fixture f;
    setting circle[] = {{"rest_radius", 0.5}, {"gas_pressure", 1000.0}, {"gas_volume", 0.25 * pi},
                        {"share", 1.0},       {"constant_volume", 0.0}, END};
    make(ctx, &f, "membrane_rest", circle);
    check_close(at(ctx, &f, "radius", 0.0), 0.50227, 5e-6);
    check_close(at(ctx, &f, "pressure", 0.0), 989.2, 0.05);
    check_close(at(ctx, &f, "hoop_stress", 0.0), 4968.5, 0.05);
    check_close_relative(at(ctx, &f, "gas_energy", 0.0) + at(ctx, &f, "strain_energy", 0.0), 250.0 * pi / 0.4, 1e-12);
    drop(ctx, &f);
    circle[4].value = 1.0;
    make(ctx, &f, "membrane_rest", circle);
    check_close(at(ctx, &f, "hoop_stress", 0.0), 4990.9, 0.05);
    drop(ctx, &f);
    /* a quarter is a quarter of the whole */
    make(ctx, &f, "membrane_rest",
         SET({"rest_radius", 0.5}, {"gas_pressure", 1000.0}, {"gas_volume", 0.0625 * pi}, {"share", 0.25}));
    check_close_relative(at(ctx, &f, "gas_energy", 0.0) + at(ctx, &f, "strain_energy", 0.0), 62.5 * pi / 0.4, 1e-12);
    check_close(at(ctx, &f, "radius", 0.0), 0.50227, 5e-6);
    drop(ctx, &f);
}

/* A stiff sphere: p V stays, so that sigma = p r/(2 t). A slack membrane has no rest, nor one that thins without bound. */
static void test_sphere(void **state)
{
    context *ctx = *state;
    fixture f;
    const double volume = 4.0 / 3.0 * pi * 0.125;
    setting sphere[] = {{"sphere", 1.0},        {"share", 1.0},           {"rest_radius", 0.5}, {"modulus", 1e12},
                        {"gas_volume", volume}, {"gas_pressure", 1000.0}, {"thickness", 0.01},  END};
    make(ctx, &f, "membrane_rest", sphere);
    check_close_relative(at(ctx, &f, "hoop_stress", 0.0), 1000.0 * 0.5 / (2.0 * 0.01), 1e-6);
    check_close_relative(at(ctx, &f, "pressure", 0.0), 1000.0, 1e-6);
    drop(ctx, &f);
    sphere[3].value = 1e6; /* Newton by hand: p = 2 M ln(s) t/r at s = r/r0, energy conserved */
    make(ctx, &f, "membrane_rest", sphere);
    const double r = at(ctx, &f, "radius", 0.0), p = at(ctx, &f, "pressure", 0.0);
    check_close_relative(p, 2.0 * 1e6 * log(r / 0.5) * 0.01 / r, 1e-12);
    check_close_relative(p * 4.0 / 3.0 * pi * r * r * r / 0.4 +
                             1e6 * log(r / 0.5) * log(r / 0.5) * 4.0 * pi * 0.25 * 0.01,
                         1000.0 * volume / 0.4, 1e-12);
    drop(ctx, &f);
    /* the outside pressure takes work: with a stiff wall the pressure inside is still that of the start */
    make(ctx, &f, "membrane_rest",
         SET({"sphere", 1.0}, {"share", 1.0}, {"rest_radius", 0.5}, {"modulus", 1e12}, {"gas_volume", volume},
             {"gas_pressure", 1000.0}, {"thickness", 0.01}, {"outside_pressure", 900.0}));
    check_close_relative(at(ctx, &f, "hoop_stress", 0.0), 100.0 * 0.5 / (2.0 * 0.01), 1e-5);
    drop(ctx, &f);
    refuse(ctx, "membrane_rest", SET({"outside_pressure", 200.0}));
    refuse(ctx, "membrane_rest", SET({"small_strain", 0.5}));
}

/* y(t) = -(m g/k)(1 - cos(omega t)), omega = 316.39 rad/s: validation row B3. */
static void test_spring(void **state)
{
    context *ctx = *state;
    fixture f;
    const double k = 1e6 * 0.1 / 0.3, omega = sqrt(k / 3.33), sag = 3.33 * 250.0 / k;
    check_close(omega, 316.39, 0.005);
    const setting spring[] = {{"slack", 0.0},        {"one_way", 0.0},         {"length", 0.3},
                              {"small_strain", 1.0}, {"constant_volume", 0.0}, END};
    make(ctx, &f, "hanging_mass", spring);
    check_close_relative(scalar(&f, "period"), 2.0 * pi / omega, 1e-11);
    check_close_relative(scalar(&f, "drop"), 2.0 * sag, 1e-11);
    for (int i = 0; i < 50; i++) {
        const double t = 0.1 * i / 49.0;
        check_close(at(ctx, &f, "position", t), 1.69 - sag * (1.0 - cos(omega * t)), 1e-10 * sag);
        check_close(at(ctx, &f, "velocity", t), -sag * omega * sin(omega * t), 1e-9 * sag * omega);
    }
    drop(ctx, &f);
}

/* Free fall, a sine, free flight, by hand for Hooke's law; validation row B4 for the other laws. */
static void test_string(void **state)
{
    context *ctx = *state;
    fixture f;
    const double mass = 3.33, g = 250.0, slack = 0.02, k = 1e5 / 0.32;
    make(ctx, &f, "hanging_mass", SET({"slack", slack}, {"length", 0.32}, {"small_strain", 1.0}));
    const double fall = sqrt(2.0 * slack / g), speed = g * fall, omega = sqrt(k / mass), sag = mass * g / k;
    const double swing = (pi - atan2(speed / omega, sag)) / omega; /* x = sag - sag cos + speed/omega sin */
    check_close_relative(scalar(&f, "take_up"), fall, 1e-14);
    check_close_relative(scalar(&f, "lowest"), fall + swing, 1e-11);
    check_close_relative(scalar(&f, "rebound"), fall + 2.0 * swing, 1e-11);
    check_close_relative(scalar(&f, "period"), 2.0 * (fall + swing), 1e-11);
    for (int i = 0; i < 20; i++) {
        const double s = 2.0 * swing * i / 19.0;
        const double x = sag * (1.0 - cos(omega * s)) + speed / omega * sin(omega * s);
        check_close(at(ctx, &f, "position", fall + s), 1.69 - slack - x, 1e-11);
        check_close_relative(at(ctx, &f, "work", fall + s),
                             at(ctx, &f, "kinetic", fall + s) + at(ctx, &f, "strain_energy", fall + s), 1e-11);
    }
    drop(ctx, &f);
    for (int small = 0; small < 2; small++) {
        for (int volume = 0; volume < 2; volume++) {
            const double loose = small ? 0.020 : 0.0210;
            make(ctx, &f, "hanging_mass",
                 SET({"slack", loose}, {"length", 0.3 + loose}, {"small_strain", small}, {"constant_volume", volume}));
            check_true(scalar(&f, "take_up") > 0.01265 - 5e-5 && scalar(&f, "take_up") < 0.0130 + 5e-5);
            check_true(scalar(&f, "rebound") > 0.0241 - 5e-5 && scalar(&f, "rebound") < 0.0253 + 5e-5);
            check_true(scalar(&f, "period") > 0.0368 - 5e-5 && scalar(&f, "period") < 0.0383 + 5e-5);
            drop(ctx, &f);
        }
    }
    refuse(ctx, "hanging_mass", SET({"one_way", 0.0}));
}

/* York (1997), table 3, by his equation 6.2: 886.43 and 281.15 rad/s (validation row A2). His spring is 19 points of m/100: it
 * splits the root of the light piston into 874 and 925 rad/s. */
static void test_piston(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "piston", NONE);
    check_close(scalar(&f, "omega"), 886.43, 0.005);
    check_close(scalar(&f, "period"), 0.0070882, 5e-8);
    check_true(scalar(&f, "share") > 0.99);
    check_close(at(ctx, &f, "velocity", 0.0), -1.0, 1e-4); /* of infinitely many modes: exactly */
    check_close(at(ctx, &f, "displacement", 0.25 * scalar(&f, "period")), -1.0 / 886.43, 0.01 / 886.43);
    drop(ctx, &f);
    make(ctx, &f, "piston", SET({"mass", 1.0}));
    check_close(scalar(&f, "omega"), 281.15, 0.005);
    check_close(scalar(&f, "period"), 0.0223479, 5e-8);
    drop(ctx, &f);
    make(ctx, &f, "piston", SET({"spring_mass", 0.019}));
    const double first = fmin(scalar(&f, "omega"), scalar(&f, "second_omega"));
    const double second = fmax(scalar(&f, "omega"), scalar(&f, "second_omega"));
    check_close(first, 874.0, 0.5);
    check_close(second, 925.0, 0.5);
    check_true(scalar(&f, "share") + scalar(&f, "second_share") > 0.9);
    drop(ctx, &f);
    /* no fluid to speak of: a mass m + M/3 on a spring */
    make(ctx, &f, "piston", SET({"spring_mass", 1e-3}, {"bulk_modulus", 1e-6}, {"density", 1e-12}));
    check_close_relative(scalar(&f, "omega"), sqrt(100.0 / (0.1 + 1e-3 / 3.0)), 1e-5);
    drop(ctx, &f);
    refuse(ctx, "piston", SET({"spring_mass", 0.01}, {"stiffness", 0.0}));
}

/* Both ways through the piston agree: by modes, and as d'Alembert's waves in the fluid, integrated with small steps:
 * m dv/dt = -K x - A p, p = rho c (v - 2 r(t - 2L/c)), where r is the wave that comes back from the closed end. */
static void test_piston_waves(void **state)
{
    context *ctx = *state;
    fixture f;
    enum { LAG = 16000, LAPS = 3, STEPS = LAG * LAPS };
    static double out[STEPS + 1]; /* velocity of the wave that leaves the piston */
    const double m = 0.01, K = 2e4, c = 100.0, rho = 1e-3, L = 5.0, dt = 2.0 * L / c / LAG;
    make(ctx, &f, "piston",
         SET({"mass", m}, {"stiffness", K}, {"length", L}, {"density", rho}, {"bulk_modulus", rho * c * c},
             {"velocity", 1.0}, {"origin", 0.0}, {"modes", 1000.0}));
    double x = 0.0, v = 1.0;
    for (int i = 0; i <= STEPS; i++) {
        /* the wave comes back with the other sign, as the velocity at the closed end is 0 */
        const double back = i >= LAG ? -out[i - LAG] : 0.0;
        out[i] = v - back;
        if (i % LAG == LAG / 2) {
            check_close(at(ctx, &f, "position", i * dt), x, 2e-3 * sqrt(m / K));
            check_close(at(ctx, &f, "velocity", i * dt), v, 5e-3);
        }
        /* velocity v of the piston towards +x: pressure on its fluid side -rho c (out - back) */
        const double next_back = i + 1 >= LAG ? -out[i + 1 - LAG] : 0.0;
        const double half = v + 0.5 * dt / m * (-K * x - rho * c * (v - 2.0 * back));
        x += dt * half;
        v = (half + 0.5 * dt / m * (-K * x + 2.0 * rho * c * next_back)) / (1.0 + 0.5 * dt * rho * c / m);
    }
    drop(ctx, &f);
}

/* One bar that hangs straight down: the mass on a spring by quadrature, an independent way. */
static void test_one_bar(void **state)
{
    context *ctx = *state;
    fixture chain, mass;
    make(ctx, &chain, "bar_chain",
         SET({"points", 2.0}, {"first_x", 0.0}, {"first_y", 1.99}, {"last_x", 0.0}, {"last_y", 1.69},
             {"end_mass", 3.33}, {"area", 0.1}, {"gravity", 250.0}, {"one_way", 0.0}));
    make(ctx, &mass, "hanging_mass", SET({"slack", 0.0}, {"length", 0.3}, {"one_way", 0.0}));
    for (int i = 1; i <= 10; i++) {
        const double t = 0.01 * i;
        check_close(at(ctx, &chain, "y", t), at(ctx, &mass, "position", t), 1e-9);
        check_close(at(ctx, &chain, "velocity_y", t), at(ctx, &mass, "velocity", t), 1e-6);
        check_close(at(ctx, &chain, "strain_energy", t), at(ctx, &mass, "strain_energy", t), 1e-6);
        check_close(at(ctx, &chain, "angle", t), 0.0, 0.0);
    }
    drop(ctx, &chain);
    drop(ctx, &mass);
}

/* One stiff bar: the rigid pendulum, back after its period, at the other side after half of it; any bars keep the energy. */
static void test_pendulum(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "bar_chain", SET({"points", 2.0}, {"modulus", 1e8}));
    const double start = scalar(&f, "start_angle"), period = scalar(&f, "rigid_period");
    check_close(start, -18.44 / 180.0 * pi, 1e-4);
    check_close(scalar(&f, "length"), 0.7346, 5e-5);
    check_close(at(ctx, &f, "angle", 0.5 * period), -start, 1e-5);
    check_close(at(ctx, &f, "angle", 0.25 * period), 0.0, 5e-5);
    check_close(at(ctx, &f, "angle", period), start, 1e-5);
    drop(ctx, &f);
    for (int law = 0; law < 4; law++) {
        make(ctx, &f, "bar_chain", SET({"points", 5.0}, {"one_way", law % 2}, {"small_strain", law / 2}));
        double value[REFERENCE_MAX_QUANTITIES];
        check_ok(ctx, reference_series(ctx, &f.r, 1, (const double[]){0.15}, value));
        const double kinetic = value[reference_quantity_find(f.r.model, "kinetic")];
        const double strain = value[reference_quantity_find(f.r.model, "strain_energy")];
        check_close_relative(kinetic + strain, value[reference_quantity_find(f.r.model, "work")], 1e-8);
        drop(ctx, &f);
    }
    refuse(ctx, "bar_chain", SET({"last_x", 0.33333}, {"last_y", 0.9999}));
    refuse(ctx, "bar_chain", SET({"points", 2.5}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dogbone),      cmocka_unit_test(test_circle),  cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_spring),       cmocka_unit_test(test_string),  cmocka_unit_test(test_piston),
        cmocka_unit_test(test_piston_waves), cmocka_unit_test(test_one_bar), cmocka_unit_test(test_pendulum),
    };
    return cmocka_run_group_tests_name("references of histories", tests, check_make_context, check_drop_context);
}

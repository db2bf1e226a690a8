/* Exact solutions of solids and of the piston: boundary values, constitutive laws, published figures. */
#include "exact_fixture.h"
#include "exact_values.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static double get(const fixture *f, exact_quantity quantity, double x, double y, double z)
{
    const double at[3] = {x, y, z};
    return exact_value(&f->solution, quantity, at, 0.0);
}

static const double load = 19.4e6, bulk = 117e9, shear = 43.8e9;

/* Guilkey et al. (2003): r 0.5 to 1, P = 19.4 MPa. */
static void test_lame_values(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "lame", 2, NONE);
    check_close(get(&f, EXACT_SIGMA_R, 0.5, 0.0, 0.0), -load, 1e-8);
    check_close(get(&f, EXACT_SIGMA_R, 0.0, 1.0, 0.0), 0.0, 1e-8);
    check_close(get(&f, EXACT_SIGMA_THETA, 0.0, -0.5, 0.0), 5.0 / 3.0 * load, 1e-7);
    check_close(exact_scalar_value(&f.solution, "stress_sum", 0.0), 2.0 / 3.0 * load, 1e-8);
    check_close(exact_scalar_value(&f.solution, "bore_displacement", 0.0), 0.5 * 3.2e-4, 0.5e-6);
    check_close(exact_accuracy(&f.solution), 3.2e-4, 1e-6); /* the bore's strain, which small strains leave out */
    check_close(get(&f, EXACT_STRESS_XX, 0.7, 0.0, 0.0), get(&f, EXACT_SIGMA_R, 0.7, 0.0, 0.0), 1e-8);
    check_close(get(&f, EXACT_STRESS_YY, 0.7, 0.0, 0.0), get(&f, EXACT_SIGMA_THETA, 0.7, 0.0, 0.0), 1e-8);
    const double shear_stress =
        0.5 * (get(&f, EXACT_SIGMA_R, 0.5, 0.5, 0.0) - get(&f, EXACT_SIGMA_THETA, 0.5, 0.5, 0.0));
    check_close(get(&f, EXACT_STRESS_XY, 0.5, 0.5, 0.0), shear_stress, 1e-8);
    exact_destroy(ctx, &f.solution);

    make(ctx, &f, "lame", 2, SET({"inner_pressure", 0.1 * load}));
    check_close(exact_accuracy(&f.solution), 3.2e-5, 1e-7);
    exact_destroy(ctx, &f.solution);

    /* A sphere's bore: u/r = (P/2G) (r_o^3 (1 + nu) + 2 r_i^3 (1 - 2 nu))/(2 (1 + nu) (r_o^3 - r_i^3)), nu = 1/3. */
    make(ctx, &f, "lame_sphere", 3, NONE);
    const double nu = 0.5 * (3.0 * bulk - 2.0 * shear) / (3.0 * bulk + shear);
    check_close_relative(exact_accuracy(&f.solution),
                         0.5 * load / shear * (1.0 + nu + 0.25 * (1.0 - 2.0 * nu)) / (2.0 * (1.0 + nu) * 0.875), 1e-12);
    exact_destroy(ctx, &f.solution);

    make(ctx, &f, "lame", 2, SET({"outer_pressure", 5e6}, {"centre", 2.0}));
    check_close(get(&f, EXACT_SIGMA_R, 2.5, 0.0, 0.0), -load, 1e-8);
    check_close(get(&f, EXACT_SIGMA_R, 2.0, 1.0, 0.0), -5e6, 1e-8);
    exact_destroy(ctx, &f.solution);

    make(ctx, &f, "lame", 2, SET({"outer_pressure", load})); /* all round: hydrostatic in the plane */
    check_close(get(&f, EXACT_SIGMA_THETA, 0.6, 0.3, 0.0), -load, 1e-8);
    check_close(get(&f, EXACT_STRESS_XY, 0.6, 0.3, 0.0), 0.0, 1e-8);
    exact_destroy(ctx, &f.solution);
}

/* Johnson (1985), section 4.2: the ellipse of pressure, the stress below its middle, the largest shear. */
static void test_hertz_values(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "hertz", 2, NONE); /* force 1078.8, E = 1e6, nu = 0.3, R = 1 */
    const double a = exact_scalar_value(&f.solution, "half_width", 0.0),
                 peak = exact_scalar_value(&f.solution, "peak_pressure", 0.0);
    check_close_relative(a * a, 4.0 * 1078.8 * 2.0 * (1.0 - 0.09) / (pi * 1e6), 1e-7);
    check_close_relative(peak, 2.0 * 1078.8 / (pi * a), 1e-12);
    for (int side = -1; side <= 1; side += 2) {
        for (double x = -0.9; x < 1.0; x += 0.3)
            check_close(get(&f, EXACT_STRESS_YY, x * a, 0.0, 0.0), -peak * sqrt(1.0 - x * x), 1e-9 * peak);
        check_close(get(&f, EXACT_STRESS_YY, side * 1.5 * a, 0.0, 0.0), 0.0, 1e-9 * peak);
        for (double z = 0.1; z < 3.0; z += 0.7)
            check_close(get(&f, EXACT_STRESS_YY, 0.0, side * z * a, 0.0), -peak / sqrt(1.0 + z * z), 1e-9 * peak);
        const double deepest = 0.786 * side * a;
        check_close(0.5 * (get(&f, EXACT_STRESS_XX, 0.0, deepest, 0.0) - get(&f, EXACT_STRESS_YY, 0.0, deepest, 0.0)),
                    0.300 * peak, 1e-3 * peak);
        check_close(get(&f, EXACT_STRESS_XY, 0.3 * a, side * 0.4 * a, 0.0),
                    -get(&f, EXACT_STRESS_XY, 0.3 * a, -side * 0.4 * a, 0.0), 1e-9 * peak);
    }
    exact_destroy(ctx, &f.solution);
}

/* Stress from the displacement's gradient by Hooke's law, at a place; `lame` in plane strain has no z displacement. */
static void check_hooke(const fixture *f, const double at[3])
{
    static const exact_quantity component[3][3] = {{EXACT_STRESS_XX, EXACT_STRESS_XY, EXACT_STRESS_ZX},
                                                   {EXACT_STRESS_XY, EXACT_STRESS_YY, EXACT_STRESS_YZ},
                                                   {EXACT_STRESS_ZX, EXACT_STRESS_YZ, EXACT_STRESS_ZZ}};
    const double h = 1e-4;
    double gradient[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double sum = 0.0;
            for (int k = -2; k <= 2; k++) {
                static const double weight[5] = {1.0, -8.0, 0.0, 8.0, -1.0};
                double x[3] = {at[0], at[1], at[2]};
                x[j] += k * h;
                sum += weight[k + 2] * get(f, (exact_quantity)(EXACT_DISPLACEMENT_X + i), x[0], x[1], x[2]);
            }
            gradient[i][j] = sum / (12.0 * h);
        }
    }
    const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double sigma =
                (i == j ? (bulk - 2.0 / 3.0 * shear) * trace : 0.0) + shear * (gradient[i][j] + gradient[j][i]);
            check_close(get(f, component[i][j], at[0], at[1], at[2]), sigma, 1e-7 * load);
        }
    }
    check_close(get(f, EXACT_PRESSURE, at[0], at[1], at[2]), -bulk * trace, 1e-7 * load);
}

static void test_hooke(void **state)
{
    context *ctx = *state;
    const double at[2][3] = {{0.6, 0.3, 0.0}, {-0.4, 0.55, 0.35}};
    fixture f;
    for (int i = 0; i < 2; i++) {
        make(ctx, &f, "lame", 3, SET({"outer_pressure", 3e6}));
        check_hooke(&f, at[i]);
        exact_destroy(ctx, &f.solution);
        make(ctx, &f, "lame_sphere", 3, SET({"outer_pressure", 3e6}));
        check_hooke(&f, at[i]);
        exact_destroy(ctx, &f.solution);
    }
}

/* A free rim, one stress at the centre, Hooke's law; after a quarter of a turn what was xx is yy, and all has turned. */
static void test_disc(void **state)
{
    context *ctx = *state;
    const double at[3] = {0.6, 0.3, 0.0};
    fixture f;
    make(ctx, &f, "spinning_disc", 3,
         SET({"radius", 1.0}, {"bulk_modulus", bulk}, {"shear_modulus", shear}, {"spin", 400.0}));
    check_hooke(&f, at);
    const double scale = 1000.0 * 400.0 * 400.0;
    check_close(get(&f, EXACT_STRESS_XX, 1.0, 0.0, 0.0), 0.0, 1e-12 * scale);
    check_close(get(&f, EXACT_STRESS_XX, 0.0, 0.0, 0.0), exact_scalar_value(&f.solution, "largest_stress", 0.0),
                1e-9 * scale);
    check_close(get(&f, EXACT_STRESS_YY, 0.0, 0.0, 0.0), get(&f, EXACT_STRESS_XX, 0.0, 0.0, 0.0), 1e-12 * scale);
    const double quarter = 0.25 * exact_scalar_value(&f.solution, "period", 0.0);
    check_close(exact_value(&f.solution, EXACT_STRESS_YY, at, quarter), get(&f, EXACT_STRESS_XX, 0.6, 0.3, 0.0),
                1e-10 * scale);
    check_close(exact_value(&f.solution, EXACT_STRESS_XY, at, quarter), -get(&f, EXACT_STRESS_XY, 0.6, 0.3, 0.0),
                1e-10 * scale);
    check_close(exact_value(&f.solution, EXACT_VELOCITY_X, at, quarter), -get(&f, EXACT_VELOCITY_Y, 0.6, 0.3, 0.0),
                1e-10 * 400.0);
    check_close(exact_value(&f.solution, EXACT_DISPLACEMENT_X, at, quarter), -0.9, 1e-3);
    check_true(isnan(get(&f, EXACT_STRESS_XX, 1.0, 0.1, 0.0)));
    exact_destroy(ctx, &f.solution);
    /* thin, in plane stress: (3 + nu)/8 rho omega^2 R^2 at the centre, nothing out of the plane */
    make(ctx, &f, "spinning_disc", 2, SET({"plane_stress", 1.0}, {"radius", 1.0}, {"spin", 400.0}));
    const double poisson = 0.5 * (3.0 * 1e12 - 2.0 * 4e11) / (3.0 * 1e12 + 4e11);
    check_close_relative(get(&f, EXACT_STRESS_XX, 0.0, 0.0, 0.0), (3.0 + poisson) / 8.0 * scale, 1e-12);
    check_close(get(&f, EXACT_STRESS_ZZ, 0.2, 0.1, 0.0), 0.0, 0.0);
    exact_destroy(ctx, &f.solution);
    refuse(ctx, "spinning_disc", 2, SET({"plane_stress", 0.5}));
}

static void test_sphere_values(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "lame_sphere", 3, SET({"outer_pressure", 2e6}));
    check_close(get(&f, EXACT_SIGMA_R, 0.3, 0.0, 0.4), -load, 1e-7);
    check_close(get(&f, EXACT_SIGMA_R, 0.0, 0.6, 0.8), -2e6, 1e-7);
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "lame_sphere", 2, NONE); /* (r, z): zz is the hoop stress */
    check_close(get(&f, EXACT_STRESS_ZZ, 0.4, 0.3, 0.0), get(&f, EXACT_SIGMA_THETA, 0.4, 0.3, 0.0), 1e-8);
    check_close(get(&f, EXACT_SIGMA_THETA, 0.4, 0.3, 0.0), load * (1.0 + 0.5 * 8.0) / 7.0, 1e-7);
    exact_destroy(ctx, &f.solution);
}

static void test_annulus_refused(void **state)
{
    context *ctx = *state;
    static const char *const names[] = {"lame", "lame_sphere"};
    for (int i = 0; i < 2; i++) refuse(ctx, names[i], 2, SET({"inner_radius", 1.0}));
}

static void test_bar(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "standing_bar", 1, SET({"mode", 1.0}, {"phase", 0.5 * pi}));
    const double sound = sqrt(1e6 / 1000.0);
    check_close_relative(exact_scalar_value(&f.solution, "period", 0.0), 4.0 / sound, 1e-14);
    check_close(get(&f, EXACT_DISPLACEMENT_X, 1.0, 0.0, 0.0), 1e-4, 1e-19);
    check_close(get(&f, EXACT_STRESS_XX, 1.0, 0.0, 0.0), 0.0, 1e-13);
    check_close(get(&f, EXACT_STRESS_XX, 0.0, 0.0, 0.0), 1e6 * 1e-4 * 0.5 * pi, 1e-11);
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "standing_bar", 1, SET({"mode", 3.0}, {"free_end", 0.0}));
    check_close_relative(exact_scalar_value(&f.solution, "period", 0.0), 2.0 / (3.0 * sound), 1e-14);
    check_close(get(&f, EXACT_VELOCITY_X, 1.0, 0.0, 0.0), 0.0, 1e-16);
    exact_destroy(ctx, &f.solution);
}

/* Small strain: the force vanishes at the wave's own speed, the stress is (K + 4G/3) du/dX; large: as by hand. */
static void test_bar_mms(void **state)
{
    context *ctx = *state;
    fixture f;
    double force[3];
    const double x[3] = {0.25, 0.0, 0.0};
    const double t = 0.01;
    const double modulus = 1e6 + 4.0 / 3.0 * 4e5;
    make(ctx, &f, "bar_mms", 1, SET({"amplitude", 1e-7}));
    exact_body_force(&f.solution, x, t, force);
    const double clock = pi * sqrt(modulus / 1000.0) * t;
    check_close(force[0], 0.0, 1e-6 * pi * pi * 1e-7 * modulus / 1000.0);
    const double stress = exact_value(&f.solution, EXACT_STRESS_XX, x, t);
    check_close_relative(stress, modulus * 1e-7 * pi * cos(0.25 * pi) * sin(clock), 1e-6);
    exact_destroy(ctx, &f.solution);

    make(ctx, &f, "bar_mms", 1, SET({"amplitude", 0.1}));
    const double stretch = 1.0 + 0.1 * pi * cos(0.25 * pi) * sin(clock);
    const double lambda = 1e6 - 2.0 / 3.0 * 4e5;
    check_close_relative(exact_value(&f.solution, EXACT_STRESS_XX, x, t),
                         lambda * log(stretch) / stretch + 4e5 * (stretch - 1.0 / stretch), 1e-13);
    check_close_relative(exact_value(&f.solution, EXACT_DENSITY, x, t), 1000.0 / stretch, 1e-13);
    const double displacement = exact_value(&f.solution, EXACT_DISPLACEMENT_X, x, t);
    exact_body_force(&f.solution, x, t, force);
    check_close_relative(
        force[0],
        pi * pi * displacement *
            (4e5 / 1000.0 - modulus / 1000.0 - (lambda * (log(stretch) - 1.0) - 4e5) / (1000.0 * stretch * stretch)),
        1e-12);
    exact_destroy(ctx, &f.solution);
}

static void check_piston_motion(const fixture *f, double mass)
{
    const double omega = exact_scalar_value(&f->solution, "omega", 0.0);
    const double end[3] = {20.0, 0.0, 0.0};
    const double t = 0.7e-3;
    const double displacement = exact_value(&f->solution, EXACT_DISPLACEMENT_X, end, t);
    const double push = exact_value(&f->solution, EXACT_PRESSURE, end, t);
    /* m d2u/dt2 = p A - K u at the piston, with u harmonic */
    check_close_relative(-mass * omega * omega * displacement, push - 100.0 * displacement, 1e-12);
    const double wall[3] = {0.0, 0.0, 0.0};
    check_close(exact_value(&f->solution, EXACT_DISPLACEMENT_X, wall, t), 0.0, 0.0);
    const double beyond[3] = {25.0, 0.0, 0.0};
    check_close(exact_value(&f->solution, EXACT_DISPLACEMENT_X, beyond, t), displacement, 1e-18);
    check_true(isnan(exact_value(&f->solution, EXACT_PRESSURE, beyond, t)));
    /* rho d2u/dt2 = -dp/dx in the fluid */
    const double left[3] = {6.999, 0.0, 0.0}, middle[3] = {7.0, 0.0, 0.0}, right[3] = {7.001, 0.0, 0.0};
    const double slope =
        (exact_value(&f->solution, EXACT_PRESSURE, right, t) - exact_value(&f->solution, EXACT_PRESSURE, left, t)) /
        0.002;
    check_close_relative(-1e-4 * omega * omega * exact_value(&f->solution, EXACT_DISPLACEMENT_X, middle, t), -slope,
                         1e-6);
}

/* York (1997), table 3 (886.2 and 281.2 rad/s there; 886.43 and 281.15 by solving his equation 6.2). */
static void test_piston(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "piston", 1, SET({"mass", 0.1}));
    check_close(exact_scalar_value(&f.solution, "omega", 0.0), 886.43, 0.005);
    check_close(exact_scalar_value(&f.solution, "period", 0.0), 0.0070882, 5e-8);
    check_piston_motion(&f, 0.1);
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "piston", 1, SET({"mass", 1.0}));
    check_close(exact_scalar_value(&f.solution, "omega", 0.0), 281.15, 0.005);
    check_close(exact_scalar_value(&f.solution, "period", 0.0), 0.0223479, 5e-8);
    check_piston_motion(&f, 1.0);
    exact_destroy(ctx, &f.solution);
    /* heavy piston: the gas is a spring of rho c^2 A/L */
    make(ctx, &f, "piston", 1, SET({"mass", 1e6}));
    check_close_relative(exact_scalar_value(&f.solution, "omega", 0.0), sqrt((100.0 + 1.58e6 / 20.0) / 1e6), 1e-6);
    exact_destroy(ctx, &f.solution);
}

/* Of a sphere the way from the centre; of a cylinder without what lies along it; an axis has no place in a plane. */
static void test_round(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "round", 3, SET({"about", 0.0}, {"centre", 1.0}));
    check_close(get(&f, EXACT_NORMAL_X, 4.0, 0.2, 4.3), 0.6, 1e-15);
    check_close(get(&f, EXACT_NORMAL_Z, 4.0, 0.2, 4.3), 0.8, 1e-15);
    exact_destroy(ctx, &f.solution);
    make(ctx, &f, "round", 3, SET({"about", 3.0}, {"centre", 0.0}));
    check_close(get(&f, EXACT_NORMAL_Y, 3.0, 4.2, 7.0), 0.8, 1e-15);
    check_close(get(&f, EXACT_NORMAL_Z, 3.0, 4.2, 7.0), 0.0, 0.0);
    check_close(get(&f, EXACT_NORMAL, 3.0, 4.2, 7.0), 0.0, 0.0);
    exact_destroy(ctx, &f.solution);
    refuse(ctx, "round", 2, SET({"about", 3.0}));
    refuse(ctx, "round", 3, SET({"about", 0.5}));
}

/* Drawn out along y in the plane of y and z, taut beforehand. */
static void test_stretched_sheet(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "stretched_sheet", 3,
         SET({"modulus", 2.0}, {"poisson_ratio", 0.25}, {"rate", 3.0}, {"tautness", 0.1}, {"across", 0.0}));
    const double plane = 2.0 / (1.0 - 0.0625), at[3] = {0.3, 1.1, 0.7}, e = 0.1 + 3.0 * 0.2;
    check_close(exact_value(&f.solution, EXACT_STRESS_YY, at, 0.2), plane * (e + 0.25 * 0.1), 1e-14);
    check_close(exact_value(&f.solution, EXACT_STRESS_ZZ, at, 0.2), plane * (0.1 + 0.25 * e), 1e-14);
    check_close(exact_value(&f.solution, EXACT_STRESS_XX, at, 0.2), 0.0, 0.0);
    check_close(exact_value(&f.solution, EXACT_NORMAL_X, at, 0.2), 1.0, 0.0);
    exact_destroy(ctx, &f.solution);
    refuse(ctx, "stretched_sheet", 3, SET({"across", 0.5}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lame_values),
        cmocka_unit_test(test_hertz_values),
        cmocka_unit_test(test_hooke),
        cmocka_unit_test(test_disc),
        cmocka_unit_test(test_sphere_values),
        cmocka_unit_test(test_annulus_refused),
        cmocka_unit_test(test_bar),
        cmocka_unit_test(test_bar_mms),
        cmocka_unit_test(test_piston),
        cmocka_unit_test(test_round),
        cmocka_unit_test(test_stretched_sheet),
    };
    return cmocka_run_group_tests_name("exact solids", tests, check_make_context, check_drop_context);
}

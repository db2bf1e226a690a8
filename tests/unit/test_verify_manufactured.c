/* Manufactured solutions of solids: their stress is what floe's law makes of their displacement; the ring's motion and its free faces. (That
 * their forces balance that stress: conformance/test_exact.c.) */
#include "exact_fixture.h"
#include "exact_values.h"

#include "material/solid.h"

#include <math.h>
#include <string.h>

static double get(const fixture *f, exact_quantity quantity, const double at[3], double t)
{
    return exact_value(&f->solution, quantity, at, t);
}

/* dx_i/dX_j by differences of fourth order. */
static double gradient(const fixture *f, const double at[3], double t, int i, int j)
{
    static const double weight[5] = {1.0, -8.0, 0.0, 8.0, -1.0};
    const double h = 1e-3;
    double sum = 0.0;
    for (int k = -2; k <= 2; k++) {
        double x[3] = {at[0], at[1], at[2]};
        x[j] += k * h;
        sum += weight[k + 2] * get(f, (exact_quantity)(EXACT_DISPLACEMENT_X + i), x, t);
    }
    return (i == j ? 1.0 : 0.0) + sum / (12.0 * h);
}

static void check_law(const fixture *f, double bulk, double shear, const double at[3], double t)
{
    const double moduli[2] = {bulk, shear};
    solid_batch b = {.n = 1, .dt = 1.0};
    double F[9];
    for (int c = 0; c < 9; c++) {
        F[c] = c % 4 == 0 ? 1.0 : 0.0;
        if (c / 3 < f->solution.dim && c % 3 < f->solution.dim) F[c] = gradient(f, at, t, c / 3, c % 3);
        b.F[c][0] = F[c];
    }
    b.J_old[0] = 1.0;
    b.J[0] =
        F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
    b.rho0[0] = 1000.0;
    assert_int_equal(solid_find("neo_hookean")->stress(moduli, 0.0, &b), 0);
    for (int c = 0; c < 6; c++)
        check_close(b.stress[c][0], get(f, (exact_quantity)(EXACT_STRESS_XX + c), at, t), 1e-6 * shear);
    check_close(get(f, EXACT_DENSITY, at, t), 1000.0 / b.J[0], 1e-4);
}

static void test_bar_law(void **state)
{
    context *ctx = *state;
    const double at[3] = {0.3, 0.8, 0.45};
    fixture f;
    for (int axis = 0; axis <= 3; axis++) {
        make(ctx, &f, "bar_mms", 3, SET({"axis", axis}));
        check_law(&f, 1e6, 4e5, at, 0.012);
        exact_destroy(ctx, &f.solution);
    }
    make(ctx, &f, "bar_mms", 2, NONE); /* plane strain */
    check_law(&f, 1e6, 4e5, at, 0.012);
    exact_destroy(ctx, &f.solution);
}

/* No volume changes, so that any bulk modulus has the same stress. */
static void test_ring_law(void **state)
{
    context *ctx = *state;
    const double at[3][3] = {{0.9, 0.1, 0.0}, {-0.5, 0.75, 0.3}, {-0.2, -1.1, 0.0}};
    fixture f;
    for (int i = 0; i < 3; i++) {
        make(ctx, &f, "ring_mms", 3, NONE);
        check_law(&f, 500.0, 400.0, at[i], 0.3);
        check_law(&f, 5000.0, 400.0, at[i], 1.2);
        exact_destroy(ctx, &f.solution);
    }
}

/* The middle turns by the amplitude; on the faces there is neither motion nor stress. A spin turns all of it besides, with its stress. */
static void test_ring_motion(void **state)
{
    context *ctx = *state;
    const double middle[3] = {1.0, 0.0, 0.0}, face[2][3] = {{0.0, 0.75, 0.0}, {-1.25, 0.0, 0.0}};
    fixture f;
    make(ctx, &f, "ring_mms", 2, SET({"spin", 0.0}));
    const double peak = 0.25 * exact_scalar_value(&f.solution, "period", 0.0);
    check_close(get(&f, EXACT_DISPLACEMENT_X, middle, peak), cos(0.9) - 1.0, 1e-14);
    check_close(get(&f, EXACT_DISPLACEMENT_Y, middle, peak), sin(0.9), 1e-14);
    check_close(get(&f, EXACT_VELOCITY_Y, middle, 0.0), 0.9 * acos(-1.0), 1e-13);
    for (int i = 0; i < 2; i++) {
        check_close(get(&f, EXACT_DISPLACEMENT_X, face[i], peak), 0.0, 1e-14);
        check_close(get(&f, EXACT_VELOCITY_Y, face[i], 0.1), 0.0, 1e-14);
        for (int c = 0; c < 6; c++)
            check_close(get(&f, (exact_quantity)(EXACT_STRESS_XX + c), face[i], peak), 0.0, 1e-11);
    }
    const double layer[3] = {0.9, 0.0, 0.0}, xx = get(&f, EXACT_STRESS_XX, layer, peak),
                 yy = get(&f, EXACT_STRESS_YY, layer, peak), xy = get(&f, EXACT_STRESS_XY, layer, peak);
    exact_destroy(ctx, &f.solution);
    const double quarter = 0.5 * acos(-1.0);
    make(ctx, &f, "ring_mms", 2, SET({"spin", quarter / peak}));
    check_close(get(&f, EXACT_DISPLACEMENT_X, middle, peak), cos(0.9 + quarter) - 1.0, 1e-14);
    check_close(get(&f, EXACT_VELOCITY_Y, middle, 0.0), 0.9 * acos(-1.0) + quarter / peak, 1e-13);
    check_close_relative(get(&f, EXACT_STRESS_XX, layer, peak), yy, 1e-12);
    check_close_relative(get(&f, EXACT_STRESS_YY, layer, peak), xx, 1e-12);
    check_close_relative(get(&f, EXACT_STRESS_XY, layer, peak), -xy, 1e-12);
    exact_destroy(ctx, &f.solution);
    refuse(ctx, "ring_mms", 2, SET({"inner_radius", 1.5}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bar_law),
        cmocka_unit_test(test_ring_law),
        cmocka_unit_test(test_ring_motion),
    };
    return cmocka_run_group_tests_name("manufactured solids", tests, check_make_context, check_drop_context);
}

/* Colliding bars: cases that are known by hand, and waves shifted through arrays, with contact made and lost again. */
#include "exact_values.h"
#include "reference_fixture.h"

#include "verify/exact.h"

#include <math.h>

/* York (1997), section A.1: bars of 1.25 at 0 and 2 m/s, 0.5 m apart, exchange their velocities; contact lasts 2 L/c. */
static void test_equal(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "bar_impact",
         SET({"right_length", 1.25}, {"right_density", 1.0}, {"right_modulus", 1e5}, {"right_area", 1.0},
             {"right_velocity", 0.0}, {"gap", 0.5}));
    const double duration = 2.0 * 1.25 / sqrt(1e5);
    check_close_relative(scalar(&f, "contact"), 0.25, 1e-14);
    check_close_relative(scalar(&f, "release"), 0.25 + duration, 1e-13);
    check_close(scalar(&f, "restitution"), 1.0, 1e-12);
    check_close(scalar(&f, "left_after"), 0.0, 1e-12);
    check_close(scalar(&f, "right_after"), 2.0, 1e-12);
    /* in the middle of it both move at 1 m/s; force rho c v/2 over the section */
    check_close(at(ctx, &f, "left_velocity", 0.25 + 0.5 * duration), 1.0, 1e-12);
    check_close_relative(at(ctx, &f, "force", 0.25 + 0.7 * duration), sqrt(1e5), 1e-12);
    check_close(at(ctx, &f, "force", 0.25 + 1.1 * duration), 0.0, 1e-9);
    /* long after: no step is left, so it is known for ever */
    check_close_relative(at(ctx, &f, "right_velocity", 1e3), 2.0, 1e-9);
    check_close_relative(at(ctx, &f, "right_position", 100.0), 3.375 + 2.0 * 99.75 - duration, 1e-9);
    drop(ctx, &f);
}

/* One material, the left bar shorter: it comes to rest, and e = L1/L2 (Saint-Venant). */
static void test_unequal_lengths(void **state)
{
    context *ctx = *state;
    fixture f;
    make(ctx, &f, "bar_impact",
         SET({"right_length", 2.0}, {"right_density", 1.0}, {"right_modulus", 1e5}, {"right_area", 1.0},
             {"right_velocity", 0.0}, {"gap", 0.0}));
    check_close(scalar(&f, "contact"), 0.0, 0.0);
    check_close_relative(scalar(&f, "release"), 2.0 * 1.25 / sqrt(1e5), 1e-13);
    check_close(scalar(&f, "left_after"), 0.0, 1e-12);
    check_close_relative(scalar(&f, "right_after"), 2.0 * 1.25 / 2.0, 1e-12);
    check_close_relative(scalar(&f, "restitution"), 1.25 / 2.0, 1e-12);
    check_close_relative(at(ctx, &f, "energy", 0.05), 0.5 * 1.25 * 4.0, 1e-12);
    drop(ctx, &f);
    refuse(ctx, "bar_impact", SET({"left_velocity", 0.25}));
}

/* Waves in a bar, one entry a time step, those that run towards the face and those that leave it. */
enum { MOST = 64 };
typedef struct shifted {
    int n;
    double z, to[MOST], from[MOST]; /* index 0 is at the face */
} shifted;

/* The step of a bar: `from` moves away, `to` comes nearer, the far end is free. Returns what reaches the face. */
static double shift(shifted *b)
{
    const double arrives = b->to[0];
    const double far = b->from[b->n - 1];
    for (int i = 0; i + 1 < b->n; i++) b->to[i] = b->to[i + 1];
    for (int i = b->n - 1; i > 0; i--) b->from[i] = b->from[i - 1];
    b->to[b->n - 1] = far;
    return arrives;
}

static double mean_velocity(const shifted *b)
{
    double sum = 0.0;
    for (int i = 0; i < b->n; i++) sum += b->to[i] + b->from[i];
    return sum / b->n;
}

static void test_arrays(void **state)
{
    context *ctx = *state;
    fixture f;
    const double dt = 1e-3;
    shifted bar[2] = {{.n = 7, .z = 2.0}, {.n = 19, .z = 0.3}};
    const double speed[2] = {1.0, -0.5};
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < bar[k].n; i++) bar[k].to[i] = bar[k].from[i] = 0.5 * speed[k];
    }
    /* length = n dt at a wave speed of 1: density and modulus are the impedance */
    make(ctx, &f, "bar_impact",
         SET({"left_length", 7 * dt}, {"left_density", 2.0}, {"left_modulus", 2.0}, {"left_velocity", 1.0},
             {"right_length", 19 * dt}, {"right_density", 0.3}, {"right_modulus", 0.3}, {"right_area", 1.0},
             {"right_velocity", -0.5}, {"gap", 0.0}, {"origin", 0.0}));
    double gap = 0.0;
    int contacts = 0;
    bool before = false;
    for (int i = 0; i < 300; i++) {
        const double in[2] = {shift(&bar[0]), shift(&bar[1])};
        const bool touching = gap <= 1e-12 && in[0] > in[1] + 1e-12;
        const double v = 2.0 * (bar[0].z * in[0] + bar[1].z * in[1]) / (bar[0].z + bar[1].z);
        for (int k = 0; k < 2; k++) bar[k].from[0] = touching ? v - in[k] : in[k];
        if (!touching) gap = fmax(gap + 2.0 * (in[1] - in[0]) * dt, 0.0);
        contacts += touching && !before;
        before = touching;
        /* recontact falls between two steps: then both agree no longer to the last digit */
        if (contacts > 1) break;
        const double t = (i + 1) * dt * (1.0 - 1e-9);
        check_close(at(ctx, &f, "left_velocity", t), mean_velocity(&bar[0]), 1e-6);
        check_close(at(ctx, &f, "right_velocity", t), mean_velocity(&bar[1]), 1e-6);
        const double force = touching ? bar[0].z * (2.0 * in[0] - v) : 0.0;
        check_close(at(ctx, &f, "force", (i + 0.5) * dt), force, 1e-9);
    }
    check_true(contacts >= 1);
    drop(ctx, &f);
}

/* Inside the bars: the velocity is the rate of the displacement, stress is the modulus times its slope, both faces share the
 * force in contact, and the far ends are free. */
static void test_fields(void **state)
{
    context *ctx = *state;
    const exact_model *model = exact_find("bar_impact");
    exact s;
    check_ok(ctx, exact_create(ctx, model, model->sample.par, 1, &s));
    const double modulus[2] = {1e5, 2e5}, start[2] = {1.0, 2.252}, length[2] = {1.25, 2.0}, area[2] = {1.0, 1.2};
    uint64_t seed = 11;
    for (int i = 0; i < 200; i++) {
        const int k = i % 2;
        const double x[3] = {start[k] + length[k] * check_random(&seed, 0.01, 0.99), 0.0, 0.0};
        const double t = check_random(&seed, 1e-4, 0.03), d = 1e-7;
        const double on[3] = {x[0] + d, 0.0, 0.0}, back[3] = {x[0] - d, 0.0, 0.0};
        const double slope =
            (exact_value(&s, EXACT_DISPLACEMENT_X, on, t) - exact_value(&s, EXACT_DISPLACEMENT_X, back, t)) / (2.0 * d);
        const double rate =
            (exact_value(&s, EXACT_DISPLACEMENT_X, x, t + 1e-9) - exact_value(&s, EXACT_DISPLACEMENT_X, x, t - 1e-9)) /
            2e-9;
        const double stress[2] = {exact_value(&s, EXACT_STRESS_XX, on, t), exact_value(&s, EXACT_STRESS_XX, back, t)};
        if (stress[0] != stress[1]) continue; /* a front in between */
        check_close(modulus[k] * slope, stress[0], 1e-3 * 500.0);
        check_close(rate, exact_value(&s, EXACT_VELOCITY_X, x, t), 1e-5);
    }
    const double t = exact_scalar_value(&s, "contact", 0.0) + 0.3 * exact_scalar_value(&s, "duration", 0.0);
    const double left[3] = {2.25, 0.0, 0.0}, right[3] = {2.252, 0.0, 0.0}, far[3] = {1.0, 0.0, 0.0};
    check_close_relative(area[0] * exact_value(&s, EXACT_STRESS_XX, left, t),
                         area[1] * exact_value(&s, EXACT_STRESS_XX, right, t), 1e-12);
    check_close_relative(exact_value(&s, EXACT_VELOCITY_X, left, t), exact_value(&s, EXACT_VELOCITY_X, right, t),
                         1e-12);
    check_true(exact_value(&s, EXACT_STRESS_XX, left, t) < 0.0);
    check_close(exact_value(&s, EXACT_STRESS_XX, far, t), 0.0, 1e-9);
    check_true(isnan(exact_value(&s, EXACT_VELOCITY_X, (const double[]){2.251, 0.0, 0.0}, t)));
    const exact_breaks fronts = exact_find_breaks(&s, t);
    check_true(fronts.count >= 4);
    for (int i = 1; i < fronts.count; i++) check_true(fronts.position[i] >= fronts.position[i - 1]);
    exact_destroy(ctx, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal),
        cmocka_unit_test(test_unequal_lengths),
        cmocka_unit_test(test_arrays),
        cmocka_unit_test(test_fields),
    };
    return cmocka_run_group_tests_name("colliding bars", tests, check_make_context, check_drop_context);
}

/* Every shape of the registry, by name of none: the level's sign and size, bounds, fractions.
 *
 * Parameters: the default where there is one; else the k-th required one (a vector counts as one) is 0.25 + 0.3 k, so that
 * lower < upper and inner < outer as the tables list them; check() must agree. A shape that is nothing when its places lie on
 * a line has them on a circle instead. Samples come from a fixed sequence. */
#include "check.h"

#include "geom/shape.h"

#include <math.h>
#include <string.h>

enum { MAX_PAR = 64, SAMPLES = 4000 };

typedef struct sample {
    shape s;
    int dim;
    double par[MAX_PAR];
} sample;

/* Required places a quarter turn apart. */
static void put_on_circle(sample *a)
{
    int required = 0;
    for (size_t k = 0; k < a->s.model->n_params; k++) {
        const param_spec *spec = &a->s.model->params[k];
        if (!isnan(spec->fallback) || spec->count >= 0) continue;
        const double angle = 0.3 + 1.5707963267948966 * required++;
        a->par[spec->offset / sizeof(double)] = 0.1 + 0.8 * cos(angle);
        a->par[spec->offset / sizeof(double) + 1] = 0.7 * sin(angle);
    }
}

static void sample_fill(sample *a, const shape_model *model, int dim)
{
    memset(a, 0, sizeof *a);
    a->s.model = model;
    a->s.par = a->par;
    a->dim = dim;
    assert_true(model->param_size <= sizeof a->par);
    int required = 0;
    for (size_t k = 0; k < model->n_params; k++) {
        const param_spec *spec = &model->params[k];
        const double x = isnan(spec->fallback) ? 0.25 + 0.3 * required++ : spec->fallback;
        check_true(param_in_range(spec, x));
        const int count = spec->count < 0 ? dim : spec->count;
        for (int j = 0; j < count; j++) a->par[spec->offset / sizeof(double) + (size_t)j] = x;
    }
    if (model->check(a->par, dim)) put_on_circle(a);
    const char *wrong = model->check(a->par, dim);
    if (wrong != NULL) print_error("%s: %s\n", model->name, wrong);
    assert_null(wrong);
}

static void on_each(void (*check)(const sample *))
{
    check_true(shape_registry_size > 0);
    for (size_t i = 0; i < shape_registry_size; i++) {
        for (int dim = shape_registry[i]->min_dim; dim <= shape_registry[i]->max_dim; dim++) {
            sample a;
            sample_fill(&a, shape_registry[i], dim);
            check(&a);
        }
    }
}

/* Uniform on [-1.5, 1.5] by the golden-ratio sequence of each axis (Roberts' R3). */
static void sample_point(int i, double x[3])
{
    const double step[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    for (int k = 0; k < 3; k++) x[k] = -1.5 + 3.0 * fmod(0.5 + i * step[k], 1.0);
}

static double level(const sample *a, const double x[3])
{
    return a->s.model->level(a->par, a->dim, x);
}

static void check_inside(const sample *a)
{
    int inside = 0;
    for (int i = 0; i < SAMPLES; i++) {
        double x[3];
        sample_point(i, x);
        check_true(shape_inside(&a->s, a->dim, x) == (level(a, x) < 0.0));
        inside += level(a, x) < 0.0;
    }
    check_true(inside > 0 && inside < SAMPLES);
}

/* No step changes the level by more than its length: shape_fraction decides by it. And the slope is about 1 near the
 * surface: 1/sqrt(dim) at the least, where a step straddles a ridge. */
static void check_slope(const sample *a)
{
    for (int i = 0; i < SAMPLES; i++) {
        double x[3], y[3], slope2 = 0.0, length2 = 0.0;
        sample_point(i, x);
        sample_point(7 * i + 3, y);
        for (int k = 0; k < a->dim; k++) length2 += (x[k] - y[k]) * (x[k] - y[k]);
        check_true(fabs(level(a, x) - level(a, y)) <= sqrt(length2) + 1e-14);
        if (fabs(level(a, x)) > 0.05) continue;
        for (int k = 0; k < a->dim; k++) {
            double up[3], down[3];
            memcpy(up, x, sizeof up);
            memcpy(down, x, sizeof down);
            up[k] += 1e-6;
            down[k] -= 1e-6;
            const double slope = (level(a, up) - level(a, down)) / 2e-6;
            slope2 += slope * slope;
        }
        check_true(slope2 <= 1.0 + 1e-8 && slope2 >= 0.3);
    }
}

static void check_bounds(const sample *a)
{
    double lo[3], hi[3];
    if (!a->s.model->bounds(a->par, a->dim, lo, hi)) return;
    for (int k = 0; k < a->dim; k++) check_true(lo[k] < hi[k]);
    for (int i = 0; i < SAMPLES; i++) {
        double x[3];
        sample_point(i, x);
        bool within = true;
        for (int k = 0; k < a->dim; k++) within = within && x[k] >= lo[k] && x[k] <= hi[k];
        if (shape_inside(&a->s, a->dim, x)) check_true(within);
        if (within && a->s.model->fills_bounds) check_true(shape_inside(&a->s, a->dim, x));
    }
}

/* The fraction of [-1.5, 1.5]^dim, and its centroid, against counting the sample points. */
static void check_fraction(const sample *a)
{
    const double lo[3] = {-1.5, -1.5, -1.5}, hi[3] = {1.5, 1.5, 1.5};
    double centroid[3], mean[3] = {0.0}, count = 0.0;
    const double fraction = shape_fraction(&a->s, a->dim, lo, hi, false, 6, centroid);
    for (int i = 0; i < SAMPLES; i++) {
        double x[3];
        sample_point(i, x);
        if (!shape_inside(&a->s, a->dim, x)) continue;
        count += 1.0;
        for (int k = 0; k < a->dim; k++) mean[k] += x[k];
    }
    check_close(fraction, count / SAMPLES, 0.01); /* the sequence's discrepancy */
    for (int k = 0; k < a->dim; k++) check_close(centroid[k], mean[k] / count, 0.05);
}

/* A box and its halves hold the same, halved once less; complete to round-off for volumes weighted by r as well. */
static void check_additive(const sample *a)
{
    for (int weight = 0; weight <= (a->dim <= 2); weight++) {
        const double lo[3] = {0.1, -0.8, -0.7}, hi[3] = {1.3, 0.9, 0.8}, middle = 0.7;
        const double left_hi[3] = {middle, 0.9, 0.8}, right_lo[3] = {middle, -0.8, -0.7};
        double x[3], left_x[3], right_x[3];
        const double r_left = weight ? 0.4 * 0.6 : 0.6, r_right = weight ? 1.0 * 0.6 : 0.6;
        const double whole = (r_left + r_right) * shape_fraction(&a->s, a->dim, lo, hi, weight, 5, x);
        const double left = r_left * shape_fraction(&a->s, a->dim, lo, left_hi, weight, 5, left_x);
        const double right = r_right * shape_fraction(&a->s, a->dim, right_lo, hi, weight, 5, right_x);
        check_close(whole, left + right, 2e-3);
        for (int k = 0; k < a->dim; k++) check_close(whole * x[k], left * left_x[k] + right * right_x[k], 2e-3);
    }
}

static void check_description(const sample *a)
{
    check_true(shape_find(a->s.model->name) == a->s.model);
    check_true(a->s.model->doc[0] != '\0');
    check_true(a->s.model->min_dim >= 1 && a->s.model->max_dim <= 3);
}

#define ON_EACH(check)                     \
    static void test_##check(void **state) \
    {                                      \
        (void)state;                       \
        on_each(check_##check);            \
    }
ON_EACH(description)
ON_EACH(inside)
ON_EACH(slope)
ON_EACH(bounds)
ON_EACH(fraction)
ON_EACH(additive)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_description), cmocka_unit_test(test_inside),   cmocka_unit_test(test_slope),
        cmocka_unit_test(test_bounds),      cmocka_unit_test(test_fraction), cmocka_unit_test(test_additive),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

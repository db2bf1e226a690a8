/* Every shape of the registry, by name of none: the level's sign and size, bounds, fractions.
 *
 * Parameters: the default where there is one; else the k-th required one (a vector counts as one) is 0.25 + 0.3 k, so that
 * lower < upper and inner < outer as the tables list them; check() must agree. A shape that is nothing when its places lie on
 * a line has them on a circle instead. Points are a star. Shapes whose parameters are shapes are asked with each shape that has
 * none in each of them, and with themselves within. Samples come from a fixed sequence. */
#include "shape_fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_PAR = 128, SAMPLES = 4000, LISTED = 3, STAR = 10, DEPTH = 3 };

typedef struct sample {
    shape s;
    int dim;
    double par[MAX_PAR];
} sample;

/* Whether a shape has shapes among its parameters. */
static bool is_compound(const shape_model *model)
{
    for (size_t k = 0; k < model->n_params; k++)
        if (model->params[k].kind == PARAM_MODEL || model->params[k].kind == PARAM_MODELS) return true;
    return false;
}

static bool has_dim(const shape_model *model, int dim)
{
    return model->min_dim <= dim && dim <= model->max_dim;
}

/* Required places a quarter turn apart. */
static void put_on_circle(const shape_model *model, double *par)
{
    int required = 0;
    for (size_t k = 0; k < model->n_params; k++) {
        const param_spec *spec = &model->params[k];
        if (spec->kind != PARAM_NUMBERS || !isnan(spec->fallback) || spec->count >= 0) continue;
        const double angle = 0.3 + 1.5707963267948966 * required++;
        par[spec->offset / sizeof(double)] = 0.1 + 0.8 * cos(angle);
        par[spec->offset / sizeof(double) + 1] = 0.7 * sin(angle);
    }
}

static void fill_numbers(const param_spec *spec, int dim, int *required, double *par)
{
    const double x = isnan(spec->fallback) ? 0.25 + 0.3 * (*required)++ : spec->fallback;
    check_true(param_in_range(spec, x));
    const int count = spec->count < 0 ? dim : spec->count;
    for (int j = 0; j < count; j++) par[spec->offset / sizeof(double) + (size_t)j] = x;
}

static void fill_star(maker *m, param_list *list)
{
    double(*x)[3] = NULL;
    check_ok(m->ctx, allocate(m, &x, STAR * sizeof *x));
    for (int k = 0; k < STAR; k++) {
        const double angle = 0.2 + 6.283185307179586 * k / STAR, r = k % 2 ? 0.9 : 0.4;
        x[k][0] = 0.15 + r * cos(angle);
        x[k][1] = 0.1 + r * sin(angle);
    }
    *list = (param_list){x, STAR};
}

/* A tetrahedron. */
static void fill_file(param_file *file)
{
    static const char text[] =
        "solid tetrahedron\n"
        "facet normal 0 0 0 outer loop vertex -.7 -.5 -.6 vertex .1 .8 -.5 vertex .9 -.4 -.6 endloop endfacet\n"
        "facet normal 0 0 0 outer loop vertex -.7 -.5 -.6 vertex .9 -.4 -.6 vertex 0 .1 .8 endloop endfacet\n"
        "facet normal 0 0 0 outer loop vertex .9 -.4 -.6 vertex .1 .8 -.5 vertex 0 .1 .8 endloop endfacet\n"
        "facet normal 0 0 0 outer loop vertex .1 .8 -.5 vertex -.7 -.5 -.6 vertex 0 .1 .8 endloop endfacet\n"
        "endsolid\n";
    *file = (param_file){.path = "tetrahedron.stl", .bytes = text, .size = sizeof text - 1};
}

static void *fill_shape(maker *m, const shape_model *model, int dim, const shape_model *inner, int depth);

/* A shape among the parameters: the one that is asked for where it has that dimension, aside in each entry of a list. */
static shape make_part(maker *m, const shape_model *outer, int dim, const shape_model *inner, int depth, double aside)
{
    const shape_model *model = depth > 0 ? outer : inner;
    if (!has_dim(model, dim)) model = has_dim(inner, dim) ? inner : shape_find("box");
    shape part = {model, fill_shape(m, model, dim, inner, depth - 1)};
    if (aside == 0.0) return part;
    const shape_model *moved = shape_find("moved");
    double *par = NULL;
    char why[SHAPE_WHY];
    check_ok(m->ctx, allocate(m, &par, moved->param_size));
    for (size_t k = 0; k < moved->n_params; k++)
        if (moved->params[k].kind == PARAM_MODEL) memcpy((char *)par + moved->params[k].offset, &part, sizeof part);
    for (int a = 0; a < dim; a++)
        param_find(moved->params, moved->n_params, par, "by")[a] = -aside * (a == 1 ? -0.4 : 1.0);
    const shape there = {moved, par};
    check_ok(m->ctx, shape_prepare(&there, dim, &(shape_memory){m->ctx, allocate, m}, why));
    return there;
}

static void fill_parts(maker *m, const param_spec *spec, const shape_model *outer, int dim, const shape_model *inner,
                       int depth, char *par)
{
    const int of = spec->dim > 0 ? spec->dim : dim;
    if (spec->kind == PARAM_MODEL) {
        const shape part = make_part(m, outer, of, inner, depth, 0.0);
        memcpy(par + spec->offset, &part, sizeof part);
        return;
    }
    param_list list = {.n = LISTED};
    check_ok(m->ctx, allocate(m, &list.item, LISTED * sizeof(shape)));
    /* near enough for what they have in common, and far enough for what one leaves of another */
    const double step = outer->params[0].kind == PARAM_MODEL ? 0.2 : 0.08;
    for (int k = 0; k < LISTED; k++) ((shape *)list.item)[k] = make_part(m, outer, of, inner, depth, step * (k + 1));
    memcpy(par + spec->offset, &list, sizeof list);
}

/* Filled and prepared. */
static void *fill_shape(maker *m, const shape_model *model, int dim, const shape_model *inner, int depth)
{
    double *par = NULL;
    char why[SHAPE_WHY] = "";
    int required = 0;
    check_ok(m->ctx, allocate(m, &par, model->param_size));
    for (size_t k = 0; k < model->n_params; k++) {
        const param_spec *spec = &model->params[k];
        switch (spec->kind) {
        case PARAM_NUMBERS: fill_numbers(spec, dim, &required, par); break;
        case PARAM_POINTS: fill_star(m, (param_list *)(void *)((char *)par + spec->offset)); break;
        case PARAM_MODEL:
        case PARAM_MODELS: fill_parts(m, spec, model, dim, inner, depth, (char *)par); break;
        case PARAM_FILE: fill_file((param_file *)(void *)((char *)par + spec->offset)); break;
        }
    }
    if (model->check(par, dim)) put_on_circle(model, par);
    const shape made = {model, par};
    check_ok(m->ctx, shape_prepare(&made, dim, &(shape_memory){m->ctx, allocate, m}, why));
    if (why[0]) print_error("%s of %s: %s\n", model->name, inner->name, why);
    check_true(why[0] == '\0');
    return par;
}

static void ask_about(maker *m, const shape_model *model, int dim, const shape_model *inner, int depth,
                      void (*check)(const sample *))
{
    sample a = {.dim = dim};
    assert_true(model->param_size <= sizeof a.par);
    a.s.model = model;
    memcpy(a.par, fill_shape(m, model, dim, inner, depth), model->param_size);
    a.s.par = a.par;
    check(&a);
    free_made(m);
}

/* A shape of shapes with every one that has none within, and with itself about that. */
static void ask_with_each(maker *m, const shape_model *model, int dim, void (*check)(const sample *))
{
    int asked = 0;
    if (!is_compound(model)) {
        if (check_asks_for(model->name)) ask_about(m, model, dim, model, 0, check);
        return;
    }
    for (size_t i = 0; i < shape_registry_size; i++) {
        const shape_model *inner = shape_registry[i];
        if (!check_asks_for(model->name) && !check_asks_for(inner->name)) continue;
        if (is_compound(inner) || (!has_dim(inner, dim) && !has_dim(inner, 2))) continue;
        for (int depth = 0; depth < (asked++ == 0 ? DEPTH : 1); depth++) ask_about(m, model, dim, inner, depth, check);
    }
}

static void on_each(void (*check)(const sample *))
{
    maker m;
    maker_begin(&m);
    check_true(shape_registry_size > 0);
    for (size_t i = 0; i < shape_registry_size; i++)
        for (int dim = shape_registry[i]->min_dim; dim <= shape_registry[i]->max_dim; dim++)
            ask_with_each(&m, shape_registry[i], dim, check);
    maker_end(&m);
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
        if (within && shape_fills_bounds(&a->s, a->dim)) check_true(shape_inside(&a->s, a->dim, x));
    }
}

/* The fraction of a box about the shape, and its centroid, against counting the sample points. */
static void check_fraction(const sample *a)
{
    double lo[3], hi[3], centroid[3], mean[3] = {0.0}, count = 0.0;
    const bool bounded = a->s.model->bounds(a->par, a->dim, lo, hi);
    for (int k = 0; k < a->dim; k++) {
        lo[k] = bounded ? lo[k] - 0.1 : -1.5;
        hi[k] = bounded ? hi[k] + 0.15 : 1.5;
    }
    const double fraction = shape_fraction(&a->s, a->dim, lo, hi, false, 6, centroid);
    for (int i = 0; i < SAMPLES; i++) {
        double x[3];
        sample_point(i, x);
        for (int k = 0; k < a->dim; k++) x[k] = lo[k] + (x[k] + 1.5) / 3.0 * (hi[k] - lo[k]);
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
    /* Where it does not exist, it says what to take. */
    assert_true(a->s.model->min_dim <= 1 || a->s.model->instead_below);
    assert_true(a->s.model->max_dim >= 3 || a->s.model->instead_above);
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

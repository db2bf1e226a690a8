/* Outlines: on the surface, the shape on their right, corners where they are, ends on the sides of the mesh. */
#include "check.h"

#include "base/memory.h"
#include "geom/contour.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A shape of the registry with its parameters as a list in the order of its struct. */
static shape shape_of(const char *name, double *par)
{
    const shape_model *model = shape_find(name);
    assert_non_null(model);
    return (shape){.model = model, .par = par};
}

/* The unit square. */
static contour trace(context *ctx, const char *name, double *par, int cells)
{
    const shape s = shape_of(name, par);
    const double h = 1.0 / cells;
    const seed_spec grid = {.dim = 2, .h = {h, h, 1.0}, .n = {cells, cells, 1}};
    contour o;
    check_ok(ctx, contour_trace(&o, ctx, &s, &grid, 4));
    for (size_t k = 0; k < o.n; k++)
        check_close(s.model->level(par, 2, (const double[3]){o.x[k][0], o.x[k][1], 0.0}), 0.0, 2e-9 * h);
    return o;
}

static void done(context *ctx, contour *o)
{
    contour_free(ctx, o);
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
}

/* What a closed chain encloses: negative where it goes round with the inside on its right. */
static double enclosed(const contour *o, size_t chain)
{
    const contour_chain *c = &o->chain[chain];
    double sum = 0.0;
    for (size_t k = 0; k < c->n; k++) {
        const double *a = o->x[c->first + k], *b = o->x[c->first + (k + 1) % c->n];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
}

static void test_ball(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    double par[] = {0.52, 0.47, 0.0, 0.31};
    contour o = trace(ctx, "ball", par, 10);
    assert_int_equal(o.n_chains, 1);
    assert_true(o.chain[0].closed);
    /* Chords of a sub-box, 0.025 sqrt 2, at most: s^2/(6 R^2) of the area. */
    check_close_relative(enclosed(&o, 0), -pi * 0.31 * 0.31, 0.0013 / (6.0 * 0.31 * 0.31));
    done(ctx, &o);
    context_destroy(&ctx);
}

/* A quarter of a ring: two open chains from axis to axis; the bore is passed with the ring on the right, that is from (0, r) on. */
static void test_ring(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    double par[] = {0.0, 0.0, 0.0, 0.5, 0.9};
    contour o = trace(ctx, "annulus", par, 10);
    assert_int_equal(o.n_chains, 2);
    for (int c = 0; c < 2; c++) {
        const double *from = o.x[o.chain[c].first], *to = o.x[o.chain[c].first + o.chain[c].n - 1];
        const bool bore = hypot(from[0], from[1]) < 0.7;
        assert_false(o.chain[c].closed);
        check_close(from[bore ? 1 : 0], 0.0, 0.0);
        check_close(to[bore ? 0 : 1], 0.0, 0.0);
    }
    done(ctx, &o);
    context_destroy(&ctx);
}

/* A box anywhere has its four corners: its area is exact. Along sides of cells too. */
static void test_box(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    double boxes[][6] = {{0.213, 0.307, 0.0, 0.777, 0.611, 0.0}, {0.2, 0.3, 0.0, 0.7, 0.6, 0.0}};
    for (int k = 0; k < 2; k++) {
        const double *b = boxes[k];
        contour o = trace(ctx, "box", boxes[k], 10);
        assert_int_equal(o.n_chains, 1);
        check_close(enclosed(&o, 0), -(b[3] - b[0]) * (b[4] - b[1]), 1e-9);
        done(ctx, &o);
    }
    context_destroy(&ctx);
}

/* A wall across the domain shows two faces; one that begins on a side of it, one. */
static void test_wall(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    double walls[][6] = {{0.31, 0.0, 0.0, 0.6, 1.0, 0.0}, {0.0, 0.0, 0.0, 0.6, 1.0, 0.0}};
    for (int k = 0; k < 2; k++) {
        contour o = trace(ctx, "box", walls[k], 10);
        assert_int_equal(o.n_chains, 2 - k);
        for (size_t c = 0; c < o.n_chains; c++) {
            const double *from = o.x[o.chain[c].first], *to = o.x[o.chain[c].first + o.chain[c].n - 1];
            const bool right = from[0] > 0.5; /* its gas is beyond it: down along it */
            check_close(from[0], right ? 0.6 : 0.31, 1e-9);
            check_close(from[1], right ? 1.0 : 0.0, 0.0);
            check_close(to[1], right ? 0.0 : 1.0, 0.0);
        }
        done(ctx, &o);
    }
    context_destroy(&ctx);
}

/* On a line: two points a body, by which side of them it lies; of one that reaches a side of the mesh, where it does. */
static void test_line(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    static const struct {
        double lower, upper;
        int n, into[2];
        double x[2];
    } bodies[] = {{0.23, 0.61, 2, {1, -1}, {0.23, 0.61}}, {0.3, 0.6, 2, {1, -1}, {0.3, 0.6}},
                  {0.0, 0.41, 2, {0, -1}, {0.0, 0.41}},   {-0.2, 0.41, 2, {0, -1}, {0.0, 0.41}},
                  {0.37, 1.0, 2, {1, 0}, {0.37, 1.0}},    {0.0, 1.0, 2, {0, 0}, {0.0, 1.0}},
                  {1.2, 1.4, 0, {0, 0}, {0.0, 0.0}}};
    for (size_t k = 0; k < sizeof bodies / sizeof *bodies; k++) {
        double par[6] = {bodies[k].lower, 0.0, 0.0, bodies[k].upper, 0.0, 0.0};
        const shape s = shape_of("box", par);
        const seed_spec grid = {.dim = 1, .h = {0.1, 1.0, 1.0}, .n = {10, 1, 1}};
        contour o;
        check_ok(ctx, contour_trace(&o, ctx, &s, &grid, 4));
        assert_int_equal(o.n_chains, bodies[k].n);
        for (size_t c = 0; c < o.n_chains; c++) {
            bool found = false;
            for (int e = 0; e < 2; e++)
                found = found || (fabs(o.x[o.chain[c].first][0] - bodies[k].x[e]) < 2e-10 &&
                                  o.chain[c].into == bodies[k].into[e]);
            assert_true(found);
            assert_int_equal(o.chain[c].n, 1);
        }
        done(ctx, &o);
    }
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_ball), cmocka_unit_test(test_ring),
                                       cmocka_unit_test(test_box), cmocka_unit_test(test_wall),
                                       cmocka_unit_test(test_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

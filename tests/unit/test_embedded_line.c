/* Points that cut the cells of a line: shares add up to the gas between them, every cell's faces and points close, wherever the points lie. */
#include "check.h"

#include "embedded/cut.h"

#include <math.h>
#include <stdlib.h>

enum { CELLS = 12 };

static bool is_thin(const cut_surface *c, double x[3])
{
    bool thin;
    check_ok(c->ctx, cut_find_thin(c, &thin, x));
    return thin;
}

static void make_mesh(mesh *m, context *ctx, double h)
{
    const mesh_spec spec = {.dim = 1, .lower = {-0.3}, .upper = {-0.3 + CELLS * h}, .cell = {h}};
    check_ok(ctx, mesh_init(m, ctx, &spec));
}

/* Points at places (in cells from the lower side), by turns lower and upper surfaces of solids; `outward` of the first. */
static void lay(cut_surface *c, context *ctx, int n, const double *at, int outward)
{
    check_ok(ctx, cut_reserve(c, n, n));
    for (int k = 0; k < n; ++k) {
        c->vertex[k] = (cut_vertex){{c->mesh->lower[0] + at[k] * c->mesh->h[0], 0.0, 0.0}, k, 0};
        c->chain[k] = (cut_chain){k, 1, false, k % 2 ? -outward : outward};
    }
}

static double enclosed_length(const cut_surface *c)
{
    double sum = 0.0;
    for (int i = 0; i < CELLS; ++i) sum += cut_open(c, (const int[]){i, 0, 0});
    return sum;
}

/* First moment of the enclosed gas about the lower side, in cells. */
static double first_moment(const cut_surface *c)
{
    double sum = 0.0;
    for (int i = 0; i < CELLS; ++i) {
        const int cell[3] = {i, 0, 0};
        sum += cut_open(c, cell) * (i + 0.5) + cut_moment(c, cell, 0) / c->mesh->h[0];
    }
    return sum;
}

/* The same of what lies between the points. */
static double moment_between(int n, const double *at, int outward)
{
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += (k % 2 ? -outward : outward) * 0.5 * at[k] * at[k];
    return (n % 2 ? outward : 0) < 0 || (n % 2 == 0 && outward > 0) ? sum + 0.5 * CELLS * CELLS : sum;
}

/* What lies between the points, in cells. */
static double between(int n, const double *at, int outward)
{
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += (k % 2 ? -outward : outward) * at[k];
    return (n % 2 ? outward : 0) < 0 || (n % 2 == 0 && outward > 0) ? sum + CELLS : sum;
}

/* Faces and points of each cell close, neighbours see the same face, and no cell without gas has an open one. */
static void check_closed(const cut_surface *c)
{
    for (int k = 0; k < c->n_cells; ++k) {
        double sum = c->cell[k].face[0][SIDE_UPPER] - c->cell[k].face[0][SIDE_LOWER];
        for (int n = 0; n < c->n_pieces; ++n) sum += c->piece[n].cell == k ? c->piece[n].area[0] : 0.0;
        check_close(sum, 0.0, 0.0);
        if (c->cell[k].open == 0.0) check_close(c->cell[k].face[0][0] + c->cell[k].face[0][1], 0.0, 0.0);
    }
    for (int i = 0; i + 1 < CELLS; ++i)
        check_close(cut_face(c, (const int[]){i, 0, 0}, 0, SIDE_UPPER),
                    cut_face(c, (const int[]){i + 1, 0, 0}, 0, SIDE_LOWER), 0.0);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Places at random, some of them on nodes or all but there; solids of at least a cell. */
static void draw(unsigned *seed, int n, double *at)
{
    static const double aside[] = {0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-9, -1e-9};
    for (int k = 0; k < n; ++k) {
        *seed = *seed * 1664525u + 1013904223u;
        const double x = 0.1 + (CELLS - 0.2) * (double)(*seed >> 8) / (double)(1u << 24);
        at[k] = *seed % 64u < 24u ? fmin(fmax(round(x), 1.0), CELLS - 1.0) + aside[(*seed >> 4) % 7u] : x;
    }
    qsort(at, (size_t)n, sizeof *at, by_size);
}

static bool is_clear(int n, const double *at, int outward)
{
    for (int k = 0; k + 1 < n; ++k) {
        const bool solid = (k % 2 ? -outward : outward) > 0;
        if (solid ? at[k + 1] - at[k] < 1.0 : at[k + 1] < at[k]) return false;
    }
    return true;
}

static void test_random(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    unsigned seed = 7u;
    int n_done = 0;
    make_mesh(&m, ctx, 0.037);
    check_ok(ctx, cut_create(&c, ctx, &m));
    for (int pass = 0; pass < 4000; ++pass) {
        double at[4];
        const int n = 1 + pass % 4, outward = pass & 4 ? 1 : -1;
        draw(&seed, n, at);
        if (!is_clear(n, at, outward) || between(n, at, outward) < n) continue; /* some node is in gas */
        lay(&c, ctx, n, at, outward);
        check_ok(ctx, cut_find(&c));
        check_close(enclosed_length(&c), between(n, at, outward), 1e-10);
        check_close(first_moment(&c), moment_between(n, at, outward), 1e-9);
        check_closed(&c);
        assert_int_equal(c.n_pieces, n);
        n_done++;
    }
    assert_true(n_done > 1500);
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* A wall on a node leaves its gas a whole cell, and none of the cell behind it. */
static void test_on_a_node(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    make_mesh(&m, ctx, 0.1);
    check_ok(ctx, cut_create(&c, ctx, &m));
    for (int side = 0; side < 2; ++side) {
        lay(&c, ctx, 1, (const double[]){5.0}, side ? 1 : -1);
        check_ok(ctx, cut_find(&c));
        assert_int_equal(c.n_cells, 1);
        assert_int_equal(c.cell[0].cell[0], side ? 4 : 5);
        check_close(c.cell[0].open, 1.0, 0.0);
        assert_int_equal(c.at[side ? 5 : 4], CUT_OUTSIDE);
        assert_int_equal(c.at[side ? 3 : 6], CUT_INSIDE);
    }
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* Bodies in touch anywhere, but for round-off, leave nothing between them; what crosses by more is no place for gas. */
static void test_touch(void **unused)
{
    (void)unused;
    static const double apart[] = {0.0, 1e-15, -1e-15, 1e-10, -1e-10, 1e-7, -1e-7, -1e-5, -0.2, -1.3};
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    make_mesh(&m, ctx, 0.1);
    check_ok(ctx, cut_create(&c, ctx, &m));
    for (int place = 0; place < 2; ++place)
        for (int k = 0; k < 10; ++k) {
            const double x = place ? 5.0 : 5.37, at[4] = {2.25, x - 0.5 * apart[k], x + 0.5 * apart[k], 8.75};
            lay(&c, ctx, 4, at, 1);
            if (apart[k] < -1e-6) {
                check_fails(ctx, cut_find(&c), FLOE_RETRY);
                continue;
            }
            check_ok(ctx, cut_find(&c));
            check_close(enclosed_length(&c), 5.5 + fmax(apart[k], 0.0), 2e-7);
            check_closed(&c);
        }
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* Gas inside one cell has it to itself; a solid inside one would let the gas of its sides share it. */
static void test_in_a_cell(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    double x[3];
    make_mesh(&m, ctx, 0.1);
    check_ok(ctx, cut_create(&c, ctx, &m));
    const double inside[] = {4.3, 4.8}, across[] = {4.6, 5.2}, whole[] = {4.6, 5.6};
    lay(&c, ctx, 2, inside, -1);
    check_ok(ctx, cut_find(&c));
    check_close(enclosed_length(&c), 0.5, 1e-14);
    check_closed(&c);
    assert_false(is_thin(&c, x));
    lay(&c, ctx, 2, inside, 1);
    check_fails(ctx, cut_find(&c), FLOE_RETRY);
    assert_true(is_thin(&c, x));
    lay(&c, ctx, 2, across, 1); /* its sides lie in two cells, less than a cell apart */
    check_ok(ctx, cut_find(&c));
    assert_true(is_thin(&c, x));
    check_close(x[0], -0.3 + 0.46, 1e-14);
    lay(&c, ctx, 2, whole, 1);
    assert_false(is_thin(&c, x));
    static const double thickness[] = {2e-6, 5e-7, 0.99999, 1.00001}; /* in cells: from a millionth on */
    for (int k = 0; k < 4; ++k) {
        lay(&c, ctx, 2, (const double[]){4.3, 4.3 + thickness[k]}, 1);
        assert_int_equal(is_thin(&c, x), k % 2 == 0);
    }
    lay(&c, ctx, 4, (const double[]){4.5, 4.5, 7.25, 8.75}, 1); /* nothing is left of the first solid */
    check_ok(ctx, cut_find(&c));
    check_close(enclosed_length(&c), CELLS - 1.5, 1e-14);
    check_closed(&c);
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* A point on a side of the mesh holds nothing back; others move on. */
static void test_ahead(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c, next;
    make_mesh(&m, ctx, 0.1);
    check_ok(ctx, cut_create(&c, ctx, &m));
    check_ok(ctx, cut_create(&next, ctx, &m));
    lay(&c, ctx, 2, (const double[]){3.4, 0.0}, -1);
    c.chain[1].outward = 0;
    check_ok(ctx, cut_find(&c));
    check_close(enclosed_length(&c), CELLS - 3.4, 1e-14);
    check_ok(ctx, cut_ahead(&c, (const double[]){2.0, 0.0, 0.0, 2.0, 0.0, 0.0}, 0.05, &next));
    check_close(enclosed_length(&next), CELLS - 4.4, 1e-14);
    check_closed(&next);
    cut_destroy(&next);
    cut_destroy(&c);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random), cmocka_unit_test(test_on_a_node),
                                       cmocka_unit_test(test_touch), cmocka_unit_test(test_in_a_cell),
                                       cmocka_unit_test(test_ahead)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Who follows whom along a line in a plane, from where its points lie. */
#include "check.h"

#include "surface/surface.h"

#include <math.h>

enum { MOST = 64 };

typedef struct trial {
    context *ctx;
    mesh m;
    surface_set set;
    double x[3 * MOST];
    surface_estimate e[MOST];
    surface_link link[2 * MOST];
} trial;

static void set_up(trial *t)
{
    *t = (trial){.ctx = context_create()};
    check_ok(t->ctx,
             mesh_init(&t->m, t->ctx, &(mesh_spec){.dim = 2, .upper = {1.0, 1.0, 1.0}, .cell = {0.1, 0.1, 0.1}}));
    surface_set_init(&t->set, t->ctx, &t->m);
}

static void find(trial *t, size_t n)
{
    const double par[] = {1.0};
    check_ok(t->ctx, surface_set_points(&t->set, n, t->x));
    surface_normals(&t->set, surface_find("quadric"), par, t->e);
    check_ok(t->ctx, surface_orient(&t->set, NULL, t->e));
    surface_links(&t->set, t->e, t->link);
}

static void tear_down(trial *t)
{
    surface_set_free(&t->set);
    context_destroy(&t->ctx);
}

/* A quarter of a circle about the corner, of which each seventh point is listed in turn, between two mirrors. Its normals point
 * outwards, so that the points are followed anticlockwise; its ends by their own images. */
static void test_quarter(void **state)
{
    (void)state;
    enum { N = 30 };
    trial t;
    set_up(&t);
    t.set.mirror[0][SIDE_LOWER] = t.set.mirror[1][SIDE_LOWER] = true;
    for (size_t k = 0; k < N; ++k) {
        const double angle = 0.5 * acos(-1.0) * ((double)(k * 7 % N) + 0.5) / N;
        t.x[3 * k] = 0.5 * cos(angle);
        t.x[3 * k + 1] = 0.5 * sin(angle);
    }
    find(&t, N);
    for (size_t k = 0; k < N; ++k)
        for (int after = 0; after < 2; ++after) {
            const surface_link *l = &t.link[2 * k + (size_t)after];
            const size_t at = k * 7 % N, ends = after ? N - 1 : 0;
            assert_true(l->of >= 0);
            if (at == ends) {
                assert_int_equal(l->of, k);
                assert_int_equal(l->axis, after ? 0 : 1);
                assert_int_equal(l->side, SIDE_LOWER);
            } else {
                assert_int_equal((size_t)l->of * 7 % N, after ? at + 1 : at - 1);
                assert_int_equal(l->axis, -1);
            }
        }
    tear_down(&t);
}

/* Two lines, each within the reach of the other: each keeps to itself, and ends where it ends; a point alone has no one beside it. */
static void test_two_lines(void **state)
{
    (void)state;
    enum { N = 10 };
    trial t;
    set_up(&t);
    for (size_t k = 0; k < 2 * N; ++k) {
        t.x[3 * k] = 0.215 + 0.03 * (double)(k % N);
        t.x[3 * k + 1] = k < N ? 0.5 : 0.66;
    }
    t.x[6 * N] = 0.95;
    t.x[6 * N + 1] = 0.05;
    find(&t, 2 * N + 1);
    for (size_t k = 0; k < 2 * N; ++k) {
        const ptrdiff_t left = k % N == 0 ? -1 : (ptrdiff_t)k - 1, right = k % N == N - 1 ? -1 : (ptrdiff_t)k + 1;
        const bool swap = t.e[k].normal[1] > 0.0; /* (-n_y, n_x) leads to the left */
        assert_int_equal(t.link[2 * k].of, swap ? right : left);
        assert_int_equal(t.link[2 * k + 1].of, swap ? left : right);
    }
    assert_int_equal(t.link[4 * N].of, -1);
    assert_int_equal(t.link[4 * N + 1].of, -1);
    tear_down(&t);
}

/* Around a periodic side the line goes on. */
static void test_around(void **state)
{
    (void)state;
    enum { N = 20 };
    trial t;
    set_up(&t);
    t.m.periodic[0] = true;
    for (size_t k = 0; k < N; ++k) {
        t.x[3 * k] = ((double)k + 0.5) / N;
        t.x[3 * k + 1] = 0.33;
    }
    find(&t, N);
    for (size_t k = 0; k < N; ++k) {
        const bool swap = t.e[k].normal[1] > 0.0;
        assert_int_equal(t.link[2 * k + (swap ? 0 : 1)].of, (k + 1) % N);
        assert_int_equal(t.link[2 * k + (swap ? 1 : 0)].of, (k + N - 1) % N);
        assert_int_equal(t.link[2 * k].axis, -1);
    }
    tear_down(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quarter),
        cmocka_unit_test(test_two_lines),
        cmocka_unit_test(test_around),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

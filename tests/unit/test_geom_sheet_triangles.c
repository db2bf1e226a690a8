/* Triangles between the points of surfaces: closed, alone or with the sides of the mesh; their volume is that of the cells which they cut, and that
 * of the surface to the second order of the distance between points. */
#include "check.h"

#include "base/memory.h"
#include "embedded/cut.h"
#include "geom/sheet_triangles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

typedef struct volumes {
    double triangles, cells;
} volumes;

static double *places_of(const seed_list *list)
{
    double *x = malloc(3 * list->n * sizeof *x);
    assert_non_null(x);
    for (size_t k = 0; k < list->n; ++k)
        for (int a = 0; a < 3; ++a) x[3 * k + (size_t)a] = list->x[a][k];
    return x;
}

static double cut_volume(context *ctx, const mesh *m, const sheet_triangles *t, const double *x)
{
    cut_surface c;
    double sum = 0.0;
    check_ok(ctx, cut_create(&c, ctx, m));
    check_ok(ctx, cut_reserve(&c, t->n, 0));
    check_ok(ctx, cut_reserve_triangles(&c, t->n_facets));
    for (int k = 0; k < t->n; ++k) sheet_vertex_at(&t->vertex[k], x, m->lower, m->upper, c.vertex[k].x);
    for (int k = 0; k < t->n_facets; ++k) {
        const int *v = t->facet[k].vertex;
        c.triangle[k] = (cut_triangle){{v[0], v[1], v[2]}, t->facet[k].rim};
    }
    check_ok(ctx, cut_find(&c));
    for (int k = 0; k < m->n[2]; ++k)
        for (int j = 0; j < m->n[1]; ++j)
            for (int i = 0; i < m->n[0]; ++i) sum += cut_open(&c, (const int[]){i, j, k}) * m->h[0] * m->h[1] * m->h[2];
    cut_destroy(&c);
    return sum;
}

/* The box from (lower, lower, lower) to (1, 1, 1), in cells of 0.1. */
static volumes volumes_of(const sheet_surface *s, const double lower[3], int per_cell, floe_status expected)
{
    context *ctx = context_create();
    const mesh_spec spec = {
        .dim = 3, .lower = {lower[0], lower[1], lower[2]}, .upper = {1.0, 1.0, 1.0}, .cell = {0.1, 0.1, 0.1}};
    const sheet_seeding how = {.per_cell = per_cell, .thickness = 0.01};
    mesh m;
    seed_list list;
    sheet_rows rows;
    sheet_triangles t;
    volumes out = {0.0, 0.0};
    check_ok(ctx, mesh_init(&m, ctx, &spec));
    const seed_spec grid = {.dim = 3,
                            .lower = {lower[0], lower[1], lower[2]},
                            .h = {m.h[0], m.h[1], m.h[2]},
                            .n = {m.n[0], m.n[1], m.n[2]}};
    check_ok(ctx, seed_sheet(&list, ctx, s, &how, &grid));
    double *x = places_of(&list);
    check_ok(ctx, sheet_rows_make(&rows, ctx, s, &how, &grid));
    assert_int_equal(rows.first[rows.n], list.n);
    assert_int_equal(sheet_triangles_make(&t, ctx, &rows, x, &grid), expected);
    if (expected == FLOE_OK) {
        out.triangles = sheet_triangles_volume(&t, x, m.lower, m.upper);
        out.cells = cut_volume(ctx, &m, &t, x);
    }
    sheet_triangles_free(ctx, &t);
    sheet_rows_free(ctx, &rows);
    seed_list_free(ctx, &list);
    free(x);
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
    context_destroy(&ctx);
    return out;
}

static void check_volume(const sheet_surface *s, const double lower[3], double exact, double coarse, double fine)
{
    for (int per_cell = 2; per_cell <= 4; per_cell *= 2) {
        const volumes v = volumes_of(s, lower, per_cell, FLOE_OK);
        print_message("%g: %.2e off\n", exact, v.triangles / exact - 1.0);
        check_close_relative(v.cells, v.triangles, 1e-10);
        check_true(fabs(v.triangles / exact - 1.0) < (per_cell == 2 ? coarse : fine));
    }
}

/* A sphere as a whole, in halves, quarters and eighths, about each axis. */
static void test_spheres(void **unused)
{
    (void)unused;
    for (int cut = 0; cut < 8; ++cut)
        for (int axis = 0; axis < 3; ++axis) {
            const sheet_surface s = {.kind = SHEET_SPHERE, .axis = axis, .radius = 0.5};
            double lower[3], share = 1.0;
            for (int a = 0; a < 3; ++a) {
                lower[a] = cut >> a & 1 ? 0.0 : -1.0;
                share *= cut >> a & 1 ? 0.5 : 1.0;
            }
            check_volume(&s, lower, share * 4.0 / 3.0 * pi * 0.125, 9e-3, 2.3e-3);
        }
}

/* A tube between two sides, whole and by half; a ring; a body of revolution with an edge. */
static void test_revolved(void **unused)
{
    (void)unused;
    const double whole[3] = {-1.0, -1.0, -1.0}, half[3] = {-1.0, 0.0, -1.0};
    const sheet_surface tube = {.kind = SHEET_CYLINDER, .axis = 2, .radius = 0.5, .from = -1.0, .to = 1.0};
    const sheet_surface ring = {
        .kind = SHEET_REVOLVED, .axis = 1, .curve = {.kind = CURVE_CIRCLE, .centre = {0.6, 0.1}, .radius = 0.3}};
    double corner[9] = {0.0, -0.55, 0.0, 0.5, 0.0, 0.0, 0.0, 0.55, 0.0};
    const sheet_surface cones = {
        .kind = SHEET_REVOLVED, .axis = 1, .curve = {.kind = CURVE_POLYLINE, .vertex = corner, .n_vertices = 3}};
    check_volume(&tube, whole, 0.5 * pi, 2.6e-3, 6.7e-4);
    check_volume(&tube, half, 0.25 * pi, 2.8e-3, 7.8e-4);
    check_volume(&ring, whole, 0.6 * 0.09 * 2.0 * pi * pi, 9e-3, 2.3e-3);
    check_volume(&cones, whole, pi * 0.25 * 1.1 / 3.0, 1.4e-2, 2e-3);
}

/* A plane across the box: what lies behind first x second is inside. */
static void test_planes(void **unused)
{
    (void)unused;
    const double whole[3] = {-1.0, -1.0, -1.0};
    for (int turn = 0; turn < 2; ++turn) {
        sheet_surface s = {.kind = SHEET_PLANE, .corner = {0.33, -1.0, -1.0}};
        s.first[turn ? 2 : 1] = s.second[turn ? 1 : 2] = 2.0;
        const volumes v = volumes_of(&s, whole, 2, FLOE_OK);
        check_close_relative(v.cells, turn ? 4.0 * 0.67 : 4.0 * 1.33, 1e-12);
    }
}

static void test_open(void **unused)
{
    (void)unused;
    const double whole[3] = {-1.0, -1.0, -1.0};
    const sheet_surface tube = {.kind = SHEET_CYLINDER, .axis = 2, .radius = 0.5, .from = -1.0, .to = 0.9};
    const sheet_surface plane = {
        .kind = SHEET_PLANE, .corner = {0.3, -0.9, -1.0}, .first = {0.0, 1.9, 0.0}, .second = {0.0, 0.0, 2.0}};
    (void)volumes_of(&tube, whole, 2, FLOE_BAD_INPUT);
    (void)volumes_of(&plane, whole, 2, FLOE_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spheres), cmocka_unit_test(test_revolved),
                                       cmocka_unit_test(test_planes), cmocka_unit_test(test_open)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

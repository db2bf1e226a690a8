/* Surfaces of shapes as triangles: closed but for the sides of the mesh, edges and corners where they are, volumes exact of planes and right to a high
 * order of curved sides, wherever the shape lies in the mesh. Volumes are those of the cells that the triangles cut. */
#include "check.h"

#include "base/memory.h"
#include "embedded/cut.h"
#include "geom/facets.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

typedef struct trial {
    context *ctx;
    mesh m;
    cut_surface c;
} trial;

/* Cuts the unit cube by the surface of a shape; the part of it outside the shape. */
static double outside(const char *name, double *par, int cells, int divide)
{
    trial t = {.ctx = context_create()};
    const double h = 1.0 / cells;
    const mesh_spec spec = {.dim = 3, .upper = {1.0, 1.0, 1.0}, .cell = {h, h, h}};
    const shape s = {.model = shape_find(name), .par = par};
    facet_surface f;
    double sum = 0.0;
    check_ok(t.ctx, mesh_init(&t.m, t.ctx, &spec));
    const seed_spec grid = {.dim = 3, .h = {h, h, h}, .n = {cells, cells, cells}};
    check_ok(t.ctx, facets_make(&f, t.ctx, &s, &grid, divide));
    check_ok(t.ctx, cut_create(&t.c, t.ctx, &t.m));
    check_ok(t.ctx, cut_reserve(&t.c, f.n, 0));
    check_ok(t.ctx, cut_reserve_triangles(&t.c, f.n_facets));
    for (int k = 0; k < f.n; ++k) memcpy(t.c.vertex[k].x, f.x[k], sizeof f.x[k]);
    for (int k = 0; k < f.n_facets; ++k) {
        const int *v = f.facet[k].vertex;
        t.c.triangle[k] = (cut_triangle){{v[0], v[1], v[2]}, f.facet[k].rim};
    }
    check_ok(t.ctx, cut_find(&t.c));
    for (int n = 0; n < cells * cells * cells; ++n)
        sum += cut_open(&t.c, (const int[]){n % cells, n / cells % cells, n / cells / cells});
    facets_free(t.ctx, &f);
    cut_destroy(&t.c);
    assert_int_equal(memory_read_account(t.ctx).live_bytes, 0);
    context_destroy(&t.ctx);
    return sum * h * h * h;
}

/* Boxes on planes of the mesh, anywhere, to one, two and more sides, and through all. */
static void test_boxes(void **unused)
{
    (void)unused;
    double box[][6] = {{0.25, 0.25, 0.25, 0.75, 0.75, 0.75},
                       {0.313, 0.271, 0.22, 0.681, 0.713, 0.79},
                       {0.0, 0.25, 0.25, 0.5, 0.75, 0.75},
                       {-0.3, 0.13, 0.25, 0.5, 0.77, 1.2},
                       {0.4, 0.0, 0.0, 0.6, 1.0, 1.0},
                       {0.37, -0.1, -0.1, 0.59, 1.1, 1.1},
                       {0.0, 0.0, 0.0, 0.5, 0.43, 0.61},
                       {0.22, 0.37, -1.0, 0.61, 0.71, 2.0},
                       {0.3, 0.3, 0.3, 0.3 + 1.01 / 8, 0.7, 0.7},
                       {0.625, 0.5, 0.375, 1.0, 1.0, 1.0}};
    for (size_t k = 0; k < sizeof box / sizeof *box; ++k) {
        double volume = 1.0;
        for (int a = 0; a < 3; ++a) volume *= fmin(box[k][3 + a], 1.0) - fmax(box[k][a], 0.0);
        check_close(outside("box", box[k], 8, 1), 1.0 - volume, 1e-10);
        check_close(outside("box", box[k], 8, 2), 1.0 - volume, 1e-10);
    }
}

/* A box on planes of a mesh whose spacing is no binary fraction cuts no cell: its vertices are on the planes, not beside them by what they were
 * found with. */
static void test_planes_of_the_mesh(void **unused)
{
    double wall[6] = {0.5, 0.0, 0.0, 0.6, 0.2, 0.35};
    const shape s = {.model = shape_find("box"), .par = wall};
    const seed_spec grid = {.dim = 3, .h = {0.05, 0.05, 0.05}, .n = {24, 8, 12}};
    context *ctx = context_create();
    facet_surface f;
    (void)unused;
    check_ok(ctx, facets_make(&f, ctx, &s, &grid, 1));
    assert_true(f.n > 0);
    for (int k = 0; k < f.n; ++k) {
        int on = 0;
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i <= grid.n[a]; ++i) on += f.x[k][a] == i * 0.05;
        assert_true(on > 0);
    }
    facets_free(ctx, &f);
    context_destroy(&ctx);
}

/* Planes at any angle: the cube cut through its corner, edge, middle. */
static void test_planes(void **unused)
{
    (void)unused;
    double corner[6] = {0.6, 0.0, 0.0, 1.0, 1.0, 1.0}, tilted[6] = {0.5, 0.5, 0.5, 0.3, 0.2, 1.0};
    double edge[6] = {0.4, 0.0, 0.5, 1.0, 0.7, 0.0};
    check_close(outside("halfspace", corner, 8, 1), 1.0 - 0.6 * 0.6 * 0.6 / 6.0, 1e-8);
    check_close(outside("halfspace", tilted, 8, 1), 0.5, 1e-8);
    check_close(outside("halfspace", edge, 8, 1), 1.0 - 0.5 * 0.4 * 0.4 / 0.7, 1e-8);
}

static void test_balls(void **unused)
{
    (void)unused;
    double ball[4] = {0.513, 0.487, 0.521, 0.331}, eighth[4] = {0.0, 0.0, 0.0, 0.731};
    const double exact = 4.0 / 3.0 * pi * pow(0.331, 3), part = pi / 6.0 * pow(0.731, 3);
    const double coarse = fabs(1.0 - outside("ball", ball, 8, 1) - exact) / exact;
    const double fine = fabs(1.0 - outside("ball", ball, 16, 1) - exact) / exact;
    const double corner = fabs(1.0 - outside("ball", eighth, 8, 1) - part) / part;
    assert_true(coarse < 2.7e-3 && fine < 1.5e-4 && corner < 6e-4);
}

/* Tubes from side to side and hollow balls have two surfaces. */
static void test_hollow(void **unused)
{
    (void)unused;
    double tube[8] = {0.5, 0.52, -1.0, 0.5, 0.52, 2.0, 0.43, 0.27}, ring[5] = {0.51, 0.5, 0.5, 0.25, 0.43};
    double thin[5] = {0.5, 0.5, 0.5, 0.27, 0.42}; /* 1.5 cells: a box of a cell has both its sides */
    const double walls = pi * (0.43 * 0.43 - 0.27 * 0.27), shell = 4.0 / 3.0 * pi * (pow(0.43, 3) - pow(0.25, 3));
    const double of_tube = (1.0 - outside("cylinder", tube, 10, 1) - walls) / walls;
    const double of_ball = (1.0 - outside("annulus", ring, 10, 1) - shell) / shell;
    const double of_thin = 1.0 - outside("annulus", thin, 10, 1);
    check_close_relative(of_thin, 4.0 / 3.0 * pi * (pow(0.42, 3) - pow(0.27, 3)), 4e-4);
    assert_true(fabs(of_tube) < 1.3e-4 && fabs(of_ball) < 4.4e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_boxes), cmocka_unit_test(test_planes_of_the_mesh),
                                       cmocka_unit_test(test_planes), cmocka_unit_test(test_balls),
                                       cmocka_unit_test(test_hollow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

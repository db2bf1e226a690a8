/* Elements of surfaces: complete, and the same from whichever side they are seen. */
#include "check.h"

#include "geom/surface_elements.h"
#include "math/tensor.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

typedef struct sums {
    double area, along[3][2]; /* all; of normals along an axis, down and up */
    double first[3];          /* of the area, about the mesh's middle */
    double crossed[3];        /* area times both components of the normals across each axis */
    double closed[3];         /* of area vectors between corners, out of the shape */
} sums;

static void add(void *user, const surface_element *e)
{
    sums *s = user;
    double area[3] = {e->corner[1][1] - e->corner[0][1], e->corner[0][0] - e->corner[1][0], 0.0};
    if (e->corners == 3) triangle_normal(e->corner[0], e->corner[1], e->corner[2], area);
    for (int a = 0; a < 3; ++a) s->closed[a] += area[a];
    s->area += e->area;
    for (int a = 0; a < 3; ++a) {
        if (fabs(e->normal[a]) > 1.0 - 1e-9) s->along[a][e->normal[a] > 0.0] += e->area;
        s->first[a] += e->area * (e->x[a] - 0.5);
        s->crossed[a] += e->area * e->normal[(a + 1) % 3] * e->normal[(a + 2) % 3];
    }
}

/* Of a unit mesh of eight cells an axis, each in two. */
static sums sums_of(const char *name, double *par, int dim)
{
    seed_spec grid = {.dim = dim, .n = {8, 1, 1}, .h = {0.125, 0.125, 0.125}};
    const shape s = {.model = shape_find(name), .par = par};
    sums out = {0};
    assert_non_null(s.model);
    for (int a = 0; a < dim; ++a) grid.n[a] = 8;
    surface_visit(&s, &grid, 2, add, &out);
    return out;
}

/* A box with its corners where boxes have theirs: each side is all there, up to all of its corners, and faces along its axis. */
static void test_corners(void **unused)
{
    (void)unused;
    double par[6] = {0.25, 0.375, 0.125, 0.75, 0.625, 0.8125};
    for (int dim = 1; dim <= 3; ++dim) {
        const sums s = sums_of("box", par, dim);
        for (int a = 0; a < dim; ++a) {
            double side = 1.0;
            for (int b = 0; b < dim; ++b) side *= b == a ? 1.0 : par[3 + b] - par[b];
            for (int up = 0; up < 2; ++up) check_close_relative(s.along[a][up], side, 1e-12);
        }
    }
}

/* A ball in the middle, which is its own image in mirrors and with axes exchanged. Corners are shared, so that areas between them close. */
static void test_images(void **unused)
{
    (void)unused;
    double par[4] = {0.5, 0.5, 0.5, 0.37};
    for (int dim = 2; dim <= 3; ++dim) {
        const double exact = dim == 2 ? 2.0 * PI * par[3] : 4.0 * PI * par[3] * par[3];
        const sums s = sums_of("ball", par, dim);
        check_close_relative(s.area, exact, 0.01);
        for (int a = 0; a < dim; ++a) check_close(s.closed[a], 0.0, 3e-15);
        for (int a = 0; a < dim; ++a) check_close(s.first[a], 0.0, 1e-13);
        for (int a = 0; a < 3; ++a) check_close(s.crossed[a], 0.0, 1e-9); /* normals are differences */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_corners), cmocka_unit_test(test_images)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

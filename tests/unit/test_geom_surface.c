/* Elements of surfaces: complete, and the same from whichever side they are seen. */
#include "check.h"

#include "geom/surface_elements.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

typedef struct sums {
    double area, along[3][2]; /* all; of normals along an axis, down and up */
    double first[3];          /* of the area, about the mesh's middle */
    double crossed[3];        /* area times both components of the normals across each axis */
} sums;

static void add(void *user, const surface_element *e)
{
    sums *s = user;
    s->area += e->area;
    for (int a = 0; a < 3; ++a) {
        if (fabs(e->normal[a]) > 1.0 - 1e-9) s->along[a][e->normal[a] > 0.0] += e->area;
        s->first[a] += e->area * (e->x[a] - 0.5);
        s->crossed[a] += e->area * e->normal[(a + 1) % 3] * e->normal[(a + 2) % 3];
    }
}

/* Of a unit mesh of eight cells an axis, each in two. */
static sums sums_of(const char *name, double *par, int dim, surface_cut cut)
{
    seed_spec grid = {.dim = dim, .n = {8, 1, 1}, .h = {0.125, 0.125, 0.125}};
    const shape s = {.model = shape_find(name), .par = par};
    sums out = {0};
    assert_non_null(s.model);
    for (int a = 0; a < dim; ++a) grid.n[a] = 8;
    surface_visit(&s, &grid, 2, cut, add, &out);
    return out;
}

/* A box with its corners where boxes have theirs: each side is all there, up to all of its corners, and faces along its axis. */
static void test_corners(void **unused)
{
    (void)unused;
    double par[6] = {0.25, 0.375, 0.125, 0.75, 0.625, 0.8125};
    for (int dim = 1; dim <= 3; ++dim) {
        const sums s = sums_of("box", par, dim, SURFACE_MIDDLES);
        for (int a = 0; a < dim; ++a) {
            double side = 1.0;
            for (int b = 0; b < dim; ++b) side *= b == a ? 1.0 : par[3 + b] - par[b];
            for (int up = 0; up < 2; ++up) check_close_relative(s.along[a][up], side, 1e-12);
        }
    }
}

/* A ball in the middle, which is its own image in mirrors and with axes exchanged. With a diagonal it is not: some 1e-3 of it. */
static void test_images(void **unused)
{
    (void)unused;
    double par[4] = {0.5, 0.5, 0.5, 0.37};
    for (int dim = 2; dim <= 3; ++dim) {
        const double exact = dim == 2 ? 2.0 * PI * par[3] : 4.0 * PI * par[3] * par[3];
        const sums s = sums_of("ball", par, dim, SURFACE_MIDDLES),
                   diagonal = sums_of("ball", par, dim, SURFACE_DIAGONALS);
        check_close_relative(s.area, exact, 0.01);
        check_close_relative(diagonal.area, exact, 0.01);
        for (int a = 0; a < dim; ++a) check_close(s.first[a], 0.0, 1e-13);
        for (int a = 0; a < 3; ++a) check_close(s.crossed[a], 0.0, 1e-9); /* normals are differences */
        check_true(fabs(diagonal.crossed[2]) > 1e-5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_corners), cmocka_unit_test(test_images)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Changes of volume over patches of cells: what is linear is kept, means are, and the projection is symmetric. */
#include "check.h"

#include "mpm/state/volume_patch.h"

#include <math.h>
#include <stdlib.h>

enum { MOST = 1024 };

/* Points of one tile, two a cell along each axis where `inside` says so. */
typedef struct tile_points {
    mesh mesh;
    tile_box box;
    double x[3][MOST], volume0[MOST], J[MOST], value[MOST];
    size_t range[2];
    patch_points p;
} tile_points;

static bool everywhere(const double x[3])
{
    (void)x;
    return true;
}

/* Less than two fifths of a patch, and of another between that and three. */
static bool in_a_corner(const double x[3])
{
    return (x[0] < 2.0 && x[1] < 0.5) || (x[0] > 2.0 && x[0] < 4.0 && x[1] < 1.0);
}

static tile_points *tile_with(int dim, bool (*inside)(const double x[3]))
{
    tile_points *t = calloc(1, sizeof *t);
    assert_non_null(t);
    t->mesh.dim = dim;
    const int cells = dim == 3 ? 4 : 8;
    for (int a = 0; a < dim; ++a) {
        t->mesh.n[a] = cells;
        t->mesh.h[a] = 1.0;
        t->mesh.upper[a] = cells;
        t->box.cells[a] = cells;
    }
    for (int k = 0; k < (dim == 3 ? 2 * cells : 1); ++k)
        for (int j = 0; j < 2 * cells; ++j)
            for (int i = 0; i < 2 * cells; ++i) {
                const double x[3] = {0.5 * i + 0.25, 0.5 * j + 0.25, 0.5 * k + 0.25};
                if (!inside(x)) continue;
                const size_t n = t->range[1]++;
                for (int a = 0; a < 3; ++a) t->x[a][n] = x[a];
                t->volume0[n] = 0.2 + 0.01 * (double)(n % 7);
                t->J[n] = 1.0 + 0.02 * (double)(n % 3);
            }
    t->p = (patch_points){{t->x[0], t->x[1], t->x[2]}, t->volume0, t->J, NULL};
    return t;
}

static void what_is_linear_is_kept(void **unused)
{
    (void)unused;
    for (int dim = 2; dim <= 3; ++dim) {
        tile_points *t = tile_with(dim, everywhere);
        volume_patch patch[PATCHES_OF_TILE];
        patches_find(&t->mesh, &t->box, &t->p, t->range, patch);
        for (size_t k = 0; k < t->range[1]; ++k)
            t->value[k] = 3.0 - 2.0 * t->x[0][k] + 0.5 * t->x[1][k] + (dim == 3 ? 7.0 * t->x[2][k] : 0.0);
        patches_project(&t->mesh, &t->box, &t->p, t->range, patch, t->value);
        for (size_t k = 0; k < t->range[1]; ++k)
            check_close(t->value[k], 3.0 - 2.0 * t->x[0][k] + 0.5 * t->x[1][k] + (dim == 3 ? 7.0 * t->x[2][k] : 0.0),
                        1e-12);
        free(t);
    }
}

static double weighted_sum(const tile_points *t, const double *f, const double *g)
{
    double sum = 0.0;
    for (size_t k = 0; k < t->range[1]; ++k) sum += t->volume0[k] * t->J[k] * f[k] * g[k];
    return sum;
}

/* sum V g P f = sum V f P g, and P P = P. */
static void projections_are_symmetric(void **unused)
{
    (void)unused;
    tile_points *t = tile_with(2, everywhere);
    static double f[MOST], g[MOST], again[MOST], Pf[MOST], Pg[MOST];
    volume_patch patch[PATCHES_OF_TILE];
    patches_find(&t->mesh, &t->box, &t->p, t->range, patch);
    for (size_t k = 0; k < t->range[1]; ++k) {
        f[k] = Pf[k] = sin(3.0 * (double)k);
        g[k] = Pg[k] = cos(5.0 * (double)(k * k % 97));
    }
    patches_project(&t->mesh, &t->box, &t->p, t->range, patch, Pf);
    patches_project(&t->mesh, &t->box, &t->p, t->range, patch, Pg);
    check_close(weighted_sum(t, g, Pf), weighted_sum(t, f, Pg), 1e-12);
    for (size_t k = 0; k < t->range[1]; ++k) again[k] = Pf[k];
    patches_project(&t->mesh, &t->box, &t->p, t->range, patch, again);
    for (size_t k = 0; k < t->range[1]; ++k) check_close(again[k], Pf[k], 1e-12);
    free(t);
}

/* A patch that is filled to a quarter has a mean a cell, one that is filled to half one mean. */
static void patches_filled_in_part_have_means(void **unused)
{
    (void)unused;
    tile_points *t = tile_with(2, in_a_corner);
    double sum[3] = {0.0}, volume[3] = {0.0};
    volume_patch patch[PATCHES_OF_TILE];
    for (size_t k = 0; k < t->range[1]; ++k) {
        const int part = t->x[0][k] < 1.0 ? 0 : t->x[0][k] < 2.0 ? 1 : 2;
        t->value[k] = t->x[0][k] * t->x[0][k];
        sum[part] += t->volume0[k] * t->J[k] * t->value[k];
        volume[part] += t->volume0[k] * t->J[k];
    }
    patches_find(&t->mesh, &t->box, &t->p, t->range, patch);
    patches_project(&t->mesh, &t->box, &t->p, t->range, patch, t->value);
    for (size_t k = 0; k < t->range[1]; ++k) {
        const int part = t->x[0][k] < 1.0 ? 0 : t->x[0][k] < 2.0 ? 1 : 2;
        check_close(t->value[k], sum[part] / volume[part], 1e-13);
    }
    free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_linear_is_kept),
        cmocka_unit_test(projections_are_symmetric),
        cmocka_unit_test(patches_filled_in_part_have_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Patches of cells and projections on them (volume_patch.h). */
#include "mpm/state/volume_patch.h"

#include "mpm/mpm_constants.h"

#include <math.h>
#include <string.h>

/* Cell of a point along an axis, counted from its tile's first. */
static int cell_in_tile(const mesh *m, const tile_box *t, const patch_points *p, size_t k, int axis)
{
    const int last = t->cells[axis] - 1, cell = mesh_cell_of(m, axis, p->x[axis][k]) - t->first[axis];
    return cell < 0 ? 0 : cell > last ? last : cell;
}

/* m3; 0 of points without a patch. */
static double volume_of(const patch_points *p, size_t k)
{
    return is_patched(p, k) ? p->volume0[k] * p->J[k] : 0.0;
}

int patch_of_point(const mesh *m, const tile_box *t, const patch_points *p, size_t k)
{
    int number = 0;
    for (int a = m->dim - 1; a >= 0; --a) number = number * ((t->cells[a] + 1) / 2) + cell_in_tile(m, t, p, k, a) / 2;
    return number;
}

/* Which cell of its patch a point is in. */
static int cell_in_patch(const mesh *m, const tile_box *t, const patch_points *p, size_t k)
{
    int number = 0;
    for (int a = m->dim - 1; a >= 0; --a) number = 2 * number + cell_in_tile(m, t, p, k, a) % 2;
    return number;
}

void patch_modes(const mesh *m, const tile_box *t, const volume_patch *patch, const patch_points *p, size_t k,
                 double phi[PATCH_MODES])
{
    memset(phi, 0, PATCH_MODES * sizeof *phi);
    if (patch->modes > 1 + m->dim) {
        const int cell = cell_in_patch(m, t, p, k);
        phi[cell] = patch->mean[cell];
        return;
    }
    phi[0] = patch->mean[0];
    for (int r = 1; r < patch->modes; ++r) {
        double sum = 0.0;
        for (int a = 0; a < m->dim; ++a) sum += patch->slope[r - 1][a] * (p->x[a][k] - patch->centre[a]);
        phi[r] = patch->mean[0] * sum;
    }
}

/* Volume and moments of the points of a patch. */
typedef struct patch_sums {
    double volume, cell[PATCH_MODES], first[MESH_MAX_DIM], second[MESH_MAX_DIM][MESH_MAX_DIM];
} patch_sums;

static void sum_patches(const mesh *m, const tile_box *t, const patch_points *p, const size_t range[2],
                        patch_sums sum[PATCHES_OF_TILE])
{
    memset(sum, 0, PATCHES_OF_TILE * sizeof *sum);
    for (size_t k = range[0]; k < range[1]; ++k) {
        patch_sums *own = &sum[patch_of_point(m, t, p, k)];
        const double volume = volume_of(p, k);
        own->volume += volume;
        own->cell[cell_in_patch(m, t, p, k)] += volume;
        for (int a = 0; a < m->dim; ++a) own->first[a] += volume * p->x[a][k];
    }
    for (int n = 0; n < PATCHES_OF_TILE; ++n)
        for (int a = 0; a < m->dim && sum[n].volume > 0.0; ++a) sum[n].first[a] /= sum[n].volume;
    for (size_t k = range[0]; k < range[1]; ++k) {
        patch_sums *own = &sum[patch_of_point(m, t, p, k)];
        const double volume = volume_of(p, k);
        for (int a = 0; a < m->dim; ++a)
            for (int b = 0; b <= a; ++b)
                own->second[a][b] += volume * (p->x[a][k] - own->first[a]) * (p->x[b][k] - own->first[b]);
    }
}

/* The inverse of the Cholesky factor of the variance of the points' places. False: they lie along a line, or nearly. */
static bool find_slopes(const mesh *m, const patch_sums *sum, volume_patch *out)
{
    double factor[MESH_MAX_DIM][MESH_MAX_DIM] = {{0.0}};
    for (int i = 0; i < m->dim; ++i)
        for (int j = 0; j <= i; ++j) {
            double left = sum->second[i][j] / sum->volume;
            for (int k = 0; k < j; ++k) left -= factor[i][k] * factor[j][k];
            if (i == j && !(left > MPM_PATCH_LEAST_VARIANCE * m->h[i] * m->h[i])) return false;
            factor[i][j] = i == j ? sqrt(left) : left / factor[j][j];
        }
    for (int i = 0; i < m->dim; ++i)
        for (int j = 0; j <= i; ++j) {
            double left = i == j ? 1.0 : 0.0;
            for (int k = j; k < i; ++k) left -= factor[i][k] * out->slope[k][j];
            out->slope[i][j] = left / factor[i][i];
        }
    return true;
}

/* m3: of two cells along each axis; about an axis per radian, at the radius of the points there. */
static double whole_patch(const mesh *m, const patch_sums *sum)
{
    double volume = m->geometry == MESH_AXISYMMETRIC ? sum->first[0] : 1.0;
    for (int a = 0; a < m->dim; ++a) volume *= 2.0 * m->h[a];
    return volume;
}

void patches_find(const mesh *m, const tile_box *t, const patch_points *p, const size_t range[2],
                  volume_patch out[PATCHES_OF_TILE])
{
    patch_sums sum[PATCHES_OF_TILE];
    sum_patches(m, t, p, range, sum);
    for (int n = 0; n < PATCHES_OF_TILE; ++n) {
        volume_patch *v = &out[n];
        memset(v, 0, sizeof *v);
        if (!(sum[n].volume > 0.0)) continue;
        memcpy(v->centre, sum[n].first, sizeof v->centre);
        const double fill = sum[n].volume / whole_patch(m, &sum[n]);
        const bool linear = fill > MPM_PATCH_LINEAR && find_slopes(m, &sum[n], v);
        v->modes = linear ? 1 + m->dim : fill > MPM_PATCH_WHOLE ? 1 : 1 << m->dim;
        if (v->modes <= 1 + m->dim) v->mean[0] = 1.0 / sqrt(sum[n].volume);
        for (int c = 0; c < v->modes && v->modes > 1 + m->dim; ++c)
            v->mean[c] = sum[n].cell[c] > 0.0 ? 1.0 / sqrt(sum[n].cell[c]) : 0.0;
    }
}

void patches_project(const mesh *m, const tile_box *t, const patch_points *p, const size_t range[2],
                     const volume_patch *patch, double *value)
{
    double moment[PATCHES_OF_TILE][PATCH_MODES] = {{0.0}}, phi[PATCH_MODES];
    for (size_t k = range[0]; k < range[1]; ++k) {
        const int n = patch_of_point(m, t, p, k);
        patch_modes(m, t, &patch[n], p, k, phi);
        for (int r = 0; r < patch[n].modes; ++r) moment[n][r] += volume_of(p, k) * phi[r] * value[k];
    }
    for (size_t k = range[0]; k < range[1]; ++k) {
        const int n = patch_of_point(m, t, p, k);
        double sum = 0.0;
        patch_modes(m, t, &patch[n], p, k, phi);
        for (int r = 0; is_patched(p, k) && r < patch[n].modes; ++r) sum += moment[n][r] * phi[r];
        value[k] = sum;
    }
}

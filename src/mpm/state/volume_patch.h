/* Changes of volume that are linear over a patch of two cells along each axis: what the points of a body that is all but incompressible keep
 * (theory 4.16). The patches of a tile are its own, since tiles begin at even cells. On a patch the values f of its points become
 *
 *     P f (x) = sum_k phi_k(x) sum_p V_p phi_k(x_p) f_p,
 *
 * phi_k: 1, x - x_c, y - y_c ... made orthonormal with the points' volumes as weights. P is symmetric in these, and gives back what it is given.
 * Where a body fills less of a patch, or its points there lie along a line, its mean alone is left; and where it fills still less, each cell
 * of the patch has its own: phi_k is constant in the cell k alone. */
#ifndef MPM_VOLUME_PATCH_H
#define MPM_VOLUME_PATCH_H

#include "grid/tile_box.h"

#include <stdbool.h>
#include <stddef.h>

enum { PATCH_MODES = 8, PATCHES_OF_TILE = 16 };

typedef struct volume_patch {
    int modes; /* 0: it has no points; else one more than the mesh has axes, or 1, or as many as it has cells */
    double centre[MESH_MAX_DIM]; /* m: of its points' volumes */
    double
        mean[PATCH_MODES]; /* 1 over the root of the volume: of all its points in the first, or of those of each cell */
    double slope[MESH_MAX_DIM]
                [MESH_MAX_DIM]; /* phi_k = mean sum_a slope[k - 1][a] (x_a - centre_a), 1/m: a lower triangle */
} volume_patch;

/* Points of a body: their positions (m), volumes at rest (m3) and changes of volume since. Those without free mass (kg; NULL: all have it) belong to no patch. */
typedef struct patch_points {
    const double *x[MESH_MAX_DIM], *volume0, *J, *free_mass;
} patch_points;

static inline bool is_patched(const patch_points *p, size_t k)
{
    return !p->free_mass || p->free_mass[k] > 0.0;
}

/* The patch of a tile, by its number there, in which a point is. */
int patch_of_point(const mesh *m, const tile_box *t, const patch_points *p, size_t k);
/* Patches of the points [range[0], range[1]) of a tile. */
void patches_find(const mesh *m, const tile_box *t, const patch_points *p, const size_t range[2],
                  volume_patch out[PATCHES_OF_TILE]);
/* phi_k at point k, as many as the patch has modes. */
void patch_modes(const mesh *m, const tile_box *t, const volume_patch *patch, const patch_points *p, size_t k,
                 double phi[PATCH_MODES]);
/* Values of those points, the first of which is value[range[0]], become P f. */
void patches_project(const mesh *m, const tile_box *t, const patch_points *p, const size_t range[2],
                     const volume_patch *patch, double *value);

#endif

/* Changes of volume and pressures that points share, in nearly incompressible bodies (theory 4.16). Points of solids keep the part that is linear over
 * patches of cells (volume_patch.h), points of liquids the mean of their cell. */
#ifndef MPM_MEAN_STRAIN_H
#define MPM_MEAN_STRAIN_H

#include "grid/tile_box.h"
#include "mpm/mpm.h"

/* Whether a body's points are strained so; evaluated once, when the body is resolved. */
bool body_needs_mean_strain(const mpm *s, const mpm_body *b);
/* Whether they share over patches. */
bool shares_over_patches(const mpm *s, int body);
/* End of the chunk of a body's points, with positions x, that begins at `start`, at most `end`: the end of a cell, for bodies that share over cells. */
size_t mean_strain_chunk(const mpm *s, int body, const double *const x[MESH_MAX_DIM], size_t start, size_t end);
/* Rates of volume of a tile's points that share over patches, P_VOLUME_RATE, become what the patches keep of them. */
void share_rates(const mpm *s, int blk, int body, const tile_box *t, const size_t range[2]);
/* Replaces the rates of volume of a batch, whose first point is `start`: by P_VOLUME_RATE, or by the means of their cells; and these the growth of
 * the volumes, one a point, unless that is NULL. */
void take_mean_rates(const mpm *s, int blk, int body, size_t start, solid_batch *b, double *growth);

/* The axes that strain: two in the plane, three about an axis. */
int straining_axes(const mpm *s);
/* The place of such an axis on the diagonal of a tensor's nine components. */
int diagonal_of(const mpm *s, int axis);
/* Changes the velocity gradient of a point so that the rate of volume is `rate`, by equal parts for all axes that strain. */
void set_rate_of_volume(const mpm *s, solid_batch *b, size_t k, double rate);

#endif

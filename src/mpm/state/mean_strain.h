/* Volumetric strain and pressure by their means over a cell: points of bodies that are all but incompressible (theory 4.16). */
#ifndef MPM_MEAN_STRAIN_H
#define MPM_MEAN_STRAIN_H

#include "mpm/mpm.h"

/* Whether a body's points are strained so; asked once, when it is resolved. */
bool body_needs_mean_strain(const mpm *s, const mpm_body *b);
/* Where a chunk of a body's points, which stand at x, ends that begins at `start`, at most at `end`: with a cell, for bodies that are strained so. */
size_t mean_strain_chunk(const mpm *s, int body, const double *const x[MESH_MAX_DIM], size_t start, size_t end);
/* Replaces the rates of volume of a batch, whose first point is `start`, by the means of their cells; and the growth of the volumes, one a
 * point, unless that is NULL. */
void take_mean_rates(const mpm *s, int blk, int body, size_t start, solid_batch *b, double *growth);

#endif

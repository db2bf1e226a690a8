/* One layer of points: what curves (curve.c), surfaces in space (sheet_seeding.c) and the surfaces of bodies share as they are filled. Private to the
 * geom module. */
#ifndef GEOM_LAYER_H
#define GEOM_LAYER_H

#include "geom/seed.h"

enum { LAYER_POINTS_MOST = 100000000 }; /* points of one surface */

/* FLOE_BAD_INPUT unless a surface of n points can be filled at all; n as it was counted, before it became a whole
 * number. */
floe_status layer_check_number(context *ctx, double n);
/* Makes space for n points in an empty list. */
floe_status layer_reserve(seed_list *list, context *ctx, size_t n, int dim);
/* Puts point i into the list; the upper wall belongs to the last cell. FLOE_BAD_INPUT names a point outside the
 * mesh. */
floe_status layer_put_point(seed_list *list, context *ctx, const seed_spec *grid, size_t i, const double x[3]);
/* The smallest side of a cell (m). */
double layer_cell(const seed_spec *grid);
/* Puts a place that is on a plane of the mesh but for what it was found with (1e-8 of a cell) onto it. */
void layer_snap(const seed_spec *grid, double *x);

#endif

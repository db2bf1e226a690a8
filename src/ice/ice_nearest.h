/* The fluid beside a solid (ice_nearest.c). */
#ifndef ICE_ICE_NEAREST_H
#define ICE_ICE_NEAREST_H

#include "ice/ice_internal.h"

/* *out: of every cell of the mesh, in order, the number of the nearest one whose centre no solid of points covers: its own, or -1 where
 * there is none. The caller frees it. */
floe_status ice_nearest_find(const ice *s, int **out);

#endif

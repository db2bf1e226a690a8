/* The first state of the cells (theory 2.4). */
#ifndef ICE_START_H
#define ICE_START_H

#include "ice/ice_view.h"

/* Columns at rest (theory 2.4), where gravity acts. */
floe_status ice_hydrostatic(ice *s);
/* *out: of every cell of the mesh, in order, the number of the nearest one whose centre no solid of points covers: its own, or -1 where
 * there is none. The caller frees it. */
floe_status ice_nearest_find(const ice *s, int **out);

#endif

/* Parts of contours. Private to the module. */
#ifndef GEOM_CONTOUR_INTERNAL_H
#define GEOM_CONTOUR_INTERNAL_H

#include "geom/contour.h"

/* Joins chains of the plane across periodic sides. */
floe_status contour_join_around(context *ctx, contour *o, const seed_spec *grid);

#endif

/* The implicit pressure (theory 3). */
#ifndef ICE_IMPLICIT_H
#define ICE_IMPLICIT_H

#include "ice/ice_view.h"

/* Storage; none in scenes without it. */
floe_status ice_implicit_create(ice *s);
void ice_implicit_destroy(context *ctx, struct ice_implicit **w);
floe_status ice_implicit_pressure_of(ice *s, const ice_region *g);

#endif

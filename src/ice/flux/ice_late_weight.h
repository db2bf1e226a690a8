/* Only this folder includes it: gravity on the mass that the advection has moved (theory 2.6). */
#ifndef ICE_ICE_LATE_WEIGHT_H
#define ICE_ICE_LATE_WEIGHT_H

#include "ice/ice_view.h"

/* On a block whose fluids have been advected. */
void ice_late_weight(const ice *s, const ice_view *v);

#endif

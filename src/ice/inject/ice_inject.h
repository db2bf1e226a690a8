/* Fluid that comes into cells from sources, or passes vents (theory 2.18, 2.19): what the other parts of the solver ask. */
#ifndef ICE_INJECT_H
#define ICE_INJECT_H

#include "ice/ice_view.h"

/* Cells of sources and vents; none where the scene has neither. */
floe_status ice_injection_create(ice *s);
void ice_injection_destroy(context *ctx, struct ice_injection **w);
/* Whether the step has the stage. */
bool ice_injects(const ice *s);

#endif

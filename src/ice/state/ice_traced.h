/* Which fluids have their faces from the waves that meet there (theory 2.17). */
#ifndef ICE_TRACED_H
#define ICE_TRACED_H

#include "ice/ice_view.h"

/* Whether the faces of some region may be traced in the scene, and whether those of a region are in this step. */
bool ice_may_trace(const ice *s);
bool ice_is_traced(const ice *s, const ice_region *g);

#endif

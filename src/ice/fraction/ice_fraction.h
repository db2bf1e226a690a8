/* Volume fractions at faces (theory 2.3), sharp at interfaces between fluids (theory 2.15). */
#ifndef ICE_FRACTION_H
#define ICE_FRACTION_H

#include "ice/ice_view.h"

/* Marks the cells at interfaces between fluids of a region (ice_interface.c). */
floe_status ice_find_interfaces_of(ice *s, const ice_region *g);
/* Takes marks to the ghosts, and notes where each row has some. */
void ice_spread_interfaces(const ice *s, const ice_region *g);
/* Volume fractions at faces and volume fluxes, of several materials (2.3). */
void ice_face_fractions(const ice_view *v);
/* For ice_face_fractions: at interfaces gradients are zero, and fractions at faces are those of a sharp profile. */
void ice_flatten_interfaces(const ice_view *v);
void ice_sharpen_faces(const ice_view *v);

#endif

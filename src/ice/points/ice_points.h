/* What materials that points carry do to the fluids of their cells (theory 2.8, 5.3, 5.4). */
#ifndef ICE_POINTS_H
#define ICE_POINTS_H

#include "ice/ice_view.h"

/* Cells with extrapolated pressure take no pressure increment (ice_continue.c). */
floe_status ice_continued_create(ice *s);
void ice_continued_destroy(context *ctx, struct ice_continued **w);
floe_status ice_continue_pressure_of(ice *s, const ice_region *g);
void ice_constrain_continued(const ice *s, const ice_region *g);
bool ice_is_continued(const ice_view *v, ptrdiff_t at);

/* What stress, supports and contact do to u* of a material that points carry (ice_face_stress.c): along the faces' axis, and along any axis. */
void ice_stress_face_velocity(const ice *s, const ice_view *v, int r, int axis);
double ice_stress_kick(const ice *s, const ice_view *v, int r, int axis, int component, ptrdiff_t R);

#endif

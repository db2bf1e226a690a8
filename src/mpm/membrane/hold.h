/* Gas points held by a surface in space (hold.c). Private to the mpm room. */
#ifndef MPM_HOLD_H
#define MPM_HOLD_H

#include "mpm/work.h"

/* Whether a body's points are gas that a surface holds. */
bool is_held(const mpm *s, int body);
/* The surface that holds gas, at the start. FLOE_BAD_INPUT says why it is not closed. */
floe_status start_hold(mpm *s);
void free_hold(context *ctx, gas_hold *h);
/* The forces of the gas's mean pressure on the points of the surface. */
void scatter_hold(mpm *s, int group);
/* Brings the volumes of a batch of held gas to their share of the room. */
void fill_room(const mpm *s, int body, solid_batch *b);

#endif

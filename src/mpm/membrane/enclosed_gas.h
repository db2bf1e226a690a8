/* Gas points that a surface in three dimensions encloses (enclosed_gas.c). Private to the mpm module. */
#ifndef MPM_ENCLOSED_GAS_H
#define MPM_ENCLOSED_GAS_H

#include "mpm/work.h"

/* Whether a body's points are gas that a surface encloses. */
bool is_enclosed_gas(const mpm *s, int body);
/* Finds the enclosing surface at the start. FLOE_BAD_INPUT says why it is not closed. */
floe_status start_enclosure(mpm *s);
void free_enclosure(context *ctx, gas_enclosure *h);
/* The forces of the gas's mean pressure on the points of the surface. */
void scatter_enclosed_pressure(mpm *s, int group);
/* Scales the volumes of a batch of gas points so that together they fill the enclosed volume. */
void scale_to_enclosed_volume(const mpm *s, int body, solid_batch *b);

#endif

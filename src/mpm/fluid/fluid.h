/* Fluids on points: heat of dissipated energy, and volumes. */
#ifndef MPM_FLUID_H
#define MPM_FLUID_H

#include "mpm/mpm.h"

/* Whether some body of points is a fluid (heat.c). */
bool has_fluid_points(const mpm *s);
/* Whether lost kinetic energy is to heat fluid points (heat.c). */
bool losses_are_heat(const mpm *s);
/* Whether each fluid point gets its own kinetic loss, and nothing else, as heat. */
bool fluids_keep_losses(const mpm *s);
/* Whether volumes of gas points are scaled to the free volume (settle.c). */
bool settles_volumes(const mpm *s);

#endif

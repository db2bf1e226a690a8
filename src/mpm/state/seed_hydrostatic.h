/* Fluid points at rest under their own weight. */
#ifndef MPM_SEED_HYDROSTATIC_H
#define MPM_SEED_HYDROSTATIC_H

#include "geom/seed.h"
#include "mpm/mpm.h"
#include "scene/state.h"

/* State of a body's fluid at x with the weight of what is above it (Pa) on its pressure. The temperature stays; where all bodies of the material
 * are given by their density, the density does, unless the pressure depends on it alone. */
floe_status fluid_state_below(const mpm *s, int body, const double x[3], double weight, fluid_state *out,
                              double velocity[3]);
/* Pressure (Pa) of the fluid above every point (theory 4.8); `list`: one a body, *weight: one array a body, owned by the caller, NULL for those
 * that start with the pressure of the deck. */
floe_status find_hydrostatic_pressures(const mpm *s, const seed_list *list, double *weight[SCENE_MAX_BODIES]);

#endif

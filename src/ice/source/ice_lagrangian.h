/* Terms that are added to the Lagrangian values of whole cells; only this folder includes it. */
#ifndef ICE_LAGRANGIAN_H
#define ICE_LAGRANGIAN_H

#include "ice/source/ice_source.h"

/* Viscosity and conduction of the whole step, added to the Lagrangian values of all blocks. */
void ice_diffuse(const ice *s, const ice_region *g);
/* The same beside embedded boundaries, of the state at t^n: first order in time. */
void ice_diffuse_cut(const ice *s, const ice_region *g);
/* Besides, what fluids that are locked to each other do to each other at interfaces (ice_stress_between.c). */
void ice_diffuse_between(const ice *s, const ice_region *g);
/* Loads (pressurise, heat) on the Lagrangian energies. */
floe_status ice_apply_loads(ice *s, const ice_region *g);

#endif

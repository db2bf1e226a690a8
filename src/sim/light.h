/* Solids lighter than the fluid of the cells about them. */
#ifndef SIM_LIGHT_H
#define SIM_LIGHT_H

#include "sim/sim.h"

/* FLOE_BAD_INPUT, after the first step FLOE_DIVERGED, where a solid is lighter than the fluid beside it, in the cells of its points and those about
 * them, by more than an interface bears, with the remedy. Points and cells stand. Sets s->has_light. */
floe_status light_check(sim *s);
/* Largest stable step (s) of a sharp interface beside fluid that is heavier than the solid, `crossing` (s) being that of the cells at a CFL number of
 * one; INFINITY where nothing of the kind is. */
double light_step(const sim *s, double crossing);
/* Whether some fluid is denser than the lightest solid beside it. */
bool light_solid(const sim *s);

#endif

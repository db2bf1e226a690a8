/* Solids lighter than the fluid of the cells about them. */
#ifndef SIM_LIGHT_SOLID_CHECK_H
#define SIM_LIGHT_SOLID_CHECK_H

#include "sim/sim.h"

/* Refuses solids that are lighter than the fluid beside them (in the cells of their points and adjacent ones) by more
 * than the smeared interface is stable with: FLOE_BAD_INPUT before the first step, else FLOE_DIVERGED, with the remedy. States
 * of points and cells must be valid. Sets s->has_light. */
floe_status light_solid_check(sim *s);
/* The lightest solid of the scene that fluids move, by its number; -1: there is none. */
int lightest_moved_solid(const scene *s);
/* Whether the next step takes the pressure on sharp surfaces at their velocity at the end of the step (theory 7.6). */
bool wall_pressure_is_implicit(const sim *s);
/* Largest stable time step (s) of a sharp interface with explicit wall pressures, beside fluid heavier than the solid; `crossing` (s): the step of the
 * cells at a CFL number of one. INFINITY where there is no such solid. */
double light_solid_step(const sim *s, double crossing);
/* Whether some fluid has more than this share of the density of the scene's lightest solid. */
bool has_dense_fluid(const sim *s, double share);

#endif

/* The pressure of a fluid, whoever carries it. */
#ifndef RUN_PRESSURE_H
#define RUN_PRESSURE_H

#include "sim/sim.h"

/* The volume-weighted mean pressure (Pa, absolute) of a fluid of the scene: in the region of the load that pressurises
 * it, if there is one, else everywhere. NAN for a solid, and where there is none of the fluid. */
double mean_pressure(sim *s, int material);
/* The first load that pressurises the fluid; NULL if none. */
const scene_load *pressurising_load(const scene *s, int material);

#endif

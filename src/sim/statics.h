/* Steps of points that are solved for instead of explicit ones (mpm/balance/balance.h): which solver a scene gets, and
 * its increments. */
#ifndef SIM_STATICS_H
#define SIM_STATICS_H

#include "sim/sim.h"

/* Resolves time.solver once the points are made, and makes them solve their steps where they are to; says why. Errors:
 * FLOE_BAD_INPUT where the deck asks for what cannot be. */
floe_status sim_choose_solver(sim *s);
/* The next load increment (s), where `left` remain. */
void statics_step(const sim *s, double left, double *dt, const char **reason);
/* What a committed increment means: at the end of the run the points are at rest. */
void statics_commit(sim *s);

#endif

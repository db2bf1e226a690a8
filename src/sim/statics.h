/* Implicit steps of points (mpm/implicit/implicit.h): choice of the solver of a scene, and its load increments. */
#ifndef SIM_STATICS_H
#define SIM_STATICS_H

#include "sim/sim.h"

/* Resolves time.solver after the points are created, with a reason, and prepares implicit steps. Errors: FLOE_BAD_INPUT
 * where the deck's choice is not possible. */
floe_status sim_choose_solver(sim *s);
/* The next load increment (s), with `left` seconds remaining. */
void statics_step(const sim *s, double left, double *dt, const char **reason);
/* Commits an increment: at the end of the run the points are at rest. */
void statics_commit(sim *s);

#endif

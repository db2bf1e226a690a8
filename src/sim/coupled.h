/* The coupled step: the stages of points and cells, interleaved (theory 5.1). */
#ifndef SIM_COUPLED_H
#define SIM_COUPLED_H

#include "sim/sim.h"

floe_status transfer_create(struct transfer **out, sim *s);
void transfer_destroy(struct transfer **t);
floe_status coupled_step(sim *s);
/* The solids' densities and velocities on the cells, from their points. */
floe_status coupled_refresh(sim *s);
/* Initial state of the cells: fluids around the points, which have been seeded. */
floe_status coupled_initialise(sim *s);

#endif

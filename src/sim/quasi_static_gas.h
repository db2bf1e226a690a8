/* Quasi-static gas: in load increments of solids beside gas on cells, each connected region of gas has one pressure,
 * with which the points are in equilibrium; then the cells are set to it. */
#ifndef SIM_QUASI_STATIC_GAS_H
#define SIM_QUASI_STATIC_GAS_H

#include "sim/sim.h"

/* Why such a scene cannot be solved implicitly, in words, or NULL; `guess`: also where this is only likely. */
const char *quasi_static_gas_obstacle(const sim *s, bool guess);
floe_status quasi_static_gas_create(struct quasi_static_gas **out, sim *s);
void quasi_static_gas_destroy(struct quasi_static_gas **g);
/* The stages of an increment. */
floe_status quasi_static_gas_step(sim *s);
/* Sets the state of the cells after the points are committed. */
floe_status quasi_static_gas_commit(sim *s);

#endif

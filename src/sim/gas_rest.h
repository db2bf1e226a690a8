/* Load increments of solids in gas on cells: the gas, at rest, is one pressure a region, with which the points are in
 * balance; then the cells hold it. */
#ifndef SIM_GAS_REST_H
#define SIM_GAS_REST_H

#include "sim/sim.h"

/* Why such a scene cannot be solved for, or NULL; `guess`: also where it is only likely that it cannot. */
const char *gas_rest_obstacle(const sim *s, bool guess);
floe_status gas_rest_create(struct gas_rest **out, sim *s);
void gas_rest_destroy(struct gas_rest **g);
/* The stages of an increment. */
floe_status gas_rest_step(sim *s);
/* The state of rest on the cells, once the points' is final. */
floe_status gas_rest_commit(sim *s);

#endif

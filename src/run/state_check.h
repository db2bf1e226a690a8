/* Whether a state is worth keeping. */
#ifndef RUN_STATE_CHECK_H
#define RUN_STATE_CHECK_H

#include "sim/sim.h"

/* True when every number of the present state of points and cells is finite. */
bool state_is_finite(const sim *s);

#endif

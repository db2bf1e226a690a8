/* A fixed step beyond what is stable: what it gives is wrong, if it does not end. */
#ifndef RUN_FIXED_STEP_H
#define RUN_FIXED_STEP_H

#include "scene/remark.h"
#include "sim/sim.h"

/* Warns of one at the start of a run. */
floe_status fixed_step_remark(sim *s, remark_sink *say, void *user);

#endif

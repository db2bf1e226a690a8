/* C_p after the points have moved (carry.c). */
#ifndef MPM_CARRY_H
#define MPM_CARRY_H

#include "mpm/mpm.h"

floe_status mpm_stretch_gradients(mpm *s);

#endif

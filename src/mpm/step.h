/* The steps of the points (mpm_step.c, point_substeps.c). */
#ifndef MPM_STEP_H
#define MPM_STEP_H

#include "mpm/mpm.h"

/* Whether forces are scattered with the masses (mpm_step.c). */
bool forces_at_once(const mpm *s);
/* Frees the saved start of a step with substeps. */
void free_saved_points(mpm *s);

#endif

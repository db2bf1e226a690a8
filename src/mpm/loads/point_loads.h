/* Loads on the points themselves: body forces, heat, the force of an exact solution (point_loads.c). Private to the mpm
 * module. */
#ifndef MPM_LOAD_H
#define MPM_LOAD_H

#include "mpm/mpm.h"

/* Body forces now, into s->acceleration. */
void set_body_forces(mpm *s);
/* Whether the force of the scene's exact solution acts on a body's points. */
bool exact_drives(const mpm *s, int body);
/* Whether a force that changes with place does: that one, or a body force. */
bool is_driven(const mpm *s, int body);
/* A load as statics has it: one without a ramp grows until the run ends. */
scene_load load_as_solved(const mpm *s, const scene_load *load);
/* Fraction of the load at the start of the step; solved for at its end (implicit.h), where one without a ramp grows
 * until the run ends. */
double load_now(const mpm *s, const scene_load *load);
/* The time (s) of the forces of the step. */
double load_time(const mpm *s);
/* What heating loads add in this step, into s->heat. */
floe_status set_heating(mpm *s);

#endif

/* From points to nodes (scatter.c, points.c). */
#ifndef MPM_SCATTER_H
#define MPM_SCATTER_H

#include "mpm/mpm.h"
#include "mpm/transfer/scatter_mode.h"

/* Point-to-grid of one mode for a group: tile partials, then node fields in global tile order. */
floe_status scatter_group(mpm *s, int group, scatter_mode mode, bool next_stress, bool next_velocity);
/* Adds all nodal forces of a group but those of stress (loads, membranes, gas) to N_FORCE, and folds them at sides. */
void scatter_loads(mpm *s, int group);
/* Folds N_FORCE at periodic ends and sides. */
void fold_forces(mpm *s, int group);
/* Whether C_p is computed in the pass that moves the points, as the velocity gradient (points.c). */
bool carries_gradient(const mpm *s);
/* v_p becomes sum S v of a node field, in the next state (points.c). */
floe_status sample_velocities(mpm *s, field_id velocity);

#endif

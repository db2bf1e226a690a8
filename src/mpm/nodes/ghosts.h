/* Ghost nodes beyond the sides: sums are folded into the mesh, and values extended from it (wall.c). */
#ifndef MPM_GHOSTS_H
#define MPM_GHOSTS_H

#include "mpm/mpm.h"

/* Folds N_MASS, with N_MOMENTUM and N_FORCE if requested. */
void fold_walls(mpm *s, int group, bool momentum, bool force);
/* Folds a field of ghost nodes beyond the sides into the mesh. */
void fold_field(mpm *s, int group, field_id id);
/* The same, with components of a vector as scalars: mirrors keep their sum. */
void fold_numbers(mpm *s, int group, field_id id);
/* The same of sums of S_ip m_p (T_p + g_p (x_i - x_p)), of which `gradient` has those of S_ip m_p g_p: beyond a side without a mirror the
 * linear field is continued from the nodes that the ghost is folded into. */
void fold_linear(mpm *s, int group, field_id id, field_id gradient);
/* Sets ghost nodes beyond the sides, from which points near them interpolate: mirrored, or extrapolated. */
void extend_to_ghosts(mpm *s, int group, field_id id);

#endif

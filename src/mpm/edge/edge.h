/* Ghost penalty at the edges of solids (theory 4.10, Coombs 2022).
 *
 * At nodes whose support a solid fills only in part, few points determine the motion, and stresses there can be many
 * times too large. Along each grid line, therefore, the difference D u of the nodal displacements, of the order of the
 * basis plus one, is penalised where one of its nodes is filled in part. The penalty energy is
 *
 *   1/2 k |D u|^2,   k = gamma M V/h^2      M = rho c^2 of the solid, V of a cell, h along the line,
 *
 * It vanishes for displacements that the basis represents exactly, so that no accuracy is lost and no net force or
 * moment is added. Nodes do not store displacements: each line sums dt D v of the velocities that strain the points,
 * from the time when it becomes penalised until it no longer is.
 *
 * In an explicit step such a spring would be unstable at nodes without mass. The same differences therefore have
 * inertia, a = k (h/c)^2 for each line:
 *
 *   (m + sum a D^T D) a_i = f_i
 *
 * Its frequencies c/h are below those of the mesh, so that the stable time step does not change. Implicit damping with
 * half of the critical value is added, since the velocities of such nodes are interpolated anew from the points in each
 * step. Conjugate gradients (edge_solve.c) solve the system over the nodes of the lines, starting from the
 * accelerations of the last step, with sums in global order: the same bits for any blocks and threads.
 *
 * A line yields as its solid does: beyond |D u| = h y/(rho c^2), y the yield stress, its force is constant and its
 * damping is off. Lines lie within one body. They have no node that another solid or a membrane reaches, and do not
 * cross space outside the body: a slot, or a hole of a few cells.
 *
 * The partly filled nodes are searched again (edge_lines.c) when nodes may have moved by some hundredths of a cell
 * since the last search, or when the set of loaded nodes changes. */
#ifndef MPM_EDGE_H
#define MPM_EDGE_H

#include "mpm/mpm.h"

/* Allocates storage where the deck requests the penalty. */
floe_status edges_create(mpm *s);
void edges_free(mpm *s);
/* Lists and storage for the seeded points. */
floe_status edges_start(mpm *s);
/* Accelerations and v^L of a group with the inertia of its lines. After walls. */
floe_status edges_accelerate(mpm *s, int group);
/* The differences of the next state, by the velocities that points are strained with. */
floe_status edges_strain(mpm *s, int group, field_id velocity);
/* The next state becomes the current one. */
void edges_commit(mpm *s);
/* History of the lines: *n numbers, state outside the fields. NULL: there are none. mpm_edges_state has them for changes. */
const double *edges_history(const mpm *s, size_t *n);

#endif

/* Solids that answer the implicit pressure of fluids with their stiffness (theory 7.9): in a step without the bound of their sound
 *
 *     (M + s dt^2 K) (v^L - v) = dt f,
 *
 * f all forces with the stress at the start, K the stiffness of points and edges there, s MPM_WALL_STIFFNESS. To the rest of the step that is a force
 * -s dt K (v^L - v) on the nodes, which has neither resultant nor moment. */
#ifndef MPM_IMPLICIT_WALLS_H
#define MPM_IMPLICIT_WALLS_H

#include "mpm/mpm.h"

/* Nodes of the deforming solids, by global index inside the mesh: their change of velocity (m/s) by the forces so far, and (m/s per N) how one
 * moves by a force of its own while its neighbours stay. */
void stiff_node(const mpm *s, const int node[MESH_MAX_DIM], double change[3], double give[3]);
/* Changes of velocity by forces (N) that are given to nodes: the list is begun, filled, solved for, and read. */
void stiff_begin(const mpm *s);
void stiff_push(const mpm *s, const int node[MESH_MAX_DIM], const double force[3]);
void stiff_solve(const mpm *s);
void stiff_answer(const mpm *s, const int node[MESH_MAX_DIM], double change[3]);
/* Multiplications for the factors of the matrix of points as they are. Errors: FLOE_NO_MEMORY. */
floe_status stiff_work(mpm *s, double *work);
/* After that: whether a rigid body that is free reaches nodes of solids that deform. */
bool stiff_meets_free_body(const mpm *s);
/* N_FORCE becomes what gives nodes their change of velocity; the work of the stiffness is entered into the ledger. */
void stiff_take(mpm *s);
/* v^L and accelerations of nodes that are too light for forces. */
void stiff_lightest(mpm *s, int group);

#endif

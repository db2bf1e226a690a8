/* Edges of solids, held by a penalty (ghost penalty; numerics 8, Coombs 2022).
 *
 * Nodes that a solid fills in part have little to say for themselves: what few points lie in their support sets them, with stresses many
 * times too large. So along each grid line the differences of the order of the basis plus one, D u, of displacements at nodes of which one is filled in
 * part are penalised by the energy
 *
 *   1/2 k |D u|^2,   k = gamma M V/h^2      M = rho c^2 of the solid, V of a cell, h along the line,
 *
 * which vanishes for what the basis can represent exactly: no accuracy is lost, no force or moment added. Displacements are not known to the nodes;
 * each line keeps the sum of dt D v, of the velocities that points are strained with, since it became one, and forgets it when it is one no more.
 *
 * Nodes without mass would not bear such a spring in an explicit step. So the same differences have inertia, a = k (h/c)^2 for each line:
 *
 *   (m + sum a D^T D) a_i = f_i
 *
 * whose frequencies c/h are below those of the mesh, so that the stable step stays what it was; half of critical damping, taken implicitly, keeps
 * them quiet, for the velocities of such nodes come anew from the points in each step, and their energy goes astray. The system is solved over the nodes
 * of the lines by conjugate gradients, in global order: the same bits for any blocks and threads.
 * Private to the mpm room. */
#ifndef MPM_EDGE_H
#define MPM_EDGE_H

#include "mpm/mpm.h"
#include "mpm/work.h"

enum { EDGE_TAPS = 5 };

/* A difference along one grid line. Taps beyond a mirror are nodes inside, with the sign of the component along the axis turned. */
typedef struct edge_line {
    size_t slot;         /* of its differences among all; one a component from there on */
    int axis;            /* that it runs along */
    bool images;         /* some tap is the image of its node in a mirror */
    int node[EDGE_TAPS]; /* in the list of the group's nodes; taps that the basis does not need have no weight */
    double weight[2]
                 [EDGE_TAPS]; /* of the taps: of components across the line, and of that along it, which images turn */
    double stiffness;         /* N/m: k */
    double inertia;           /* kg: a */
    double damping;           /* kg/s */
} edge_line;

typedef struct edge_node {
    int at[MESH_MAX_DIM]; /* global */
    unsigned held;        /* bit of each component that a wall or a support holds */
} edge_node;

/* Lines of one group, found anew in each step. Owned arrays. */
typedef struct edge_group {
    edge_line *line;
    edge_node *node;
    size_t n_lines, line_room;
    int n_nodes, node_room;
    double speed; /* m/s: of the fastest solid of the group at rest */
} edge_group;

struct mpm_edges {
    edge_group group[MPM_MAX_GROUPS];
    double *difference, *next; /* m: sums of dt D v, by group, node, axis of the line, component. Owned */
    size_t slots;              /* of all */
    double *fill;              /* of the group in hand, per global node: share that its solids fill. Owned */
    int *owner;                /* the body that fills it; negative: none, or several. Owned */
    int *index;                /* per global node: in the list of the group's nodes, -1: in none. Owned */
    double *solve;             /* room of the solver; owned */
    size_t solve_room;
    int nodes[MESH_MAX_DIM]; /* of the whole mesh; a periodic end is node 0 */
};

/* Room for a scene whose deck asks for it. */
floe_status edges_create(mpm *s);
void edges_free(context *ctx, mpm_edges **e);
/* Finds the lines of a group (edge_lines.c). */
floe_status edges_find(mpm *s, int group);
/* The weights of a line's taps for a component. */
static inline const double *edge_weights(const edge_line *l, int c)
{
    return l->weight[c == l->axis ? 1 : 0];
}

/* Nodes of a line: the order of the basis and two more. */
int edge_taps(const mpm *s);
/* Accelerations and v^L of a group with the inertia of its lines. After walls. */
floe_status edges_accelerate(mpm *s, int group);
/* The differences of the next state, by the velocities that points are strained with; groups in order. */
void edges_strain(mpm *s, int group, field_id velocity);

/* The next differences become the present ones. */
void edges_commit(mpm *s);

#endif

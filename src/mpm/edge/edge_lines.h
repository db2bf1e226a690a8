/* Lines of the ghost penalty at edges of solids, their nodes and their history (edge.h has the method). Of this folder, and
 * of the implicit solver, which has their stiffness in its matrix. */
#ifndef MPM_EDGE_LINES_H
#define MPM_EDGE_LINES_H

#include "mpm/edge/edge.h"
#include "mpm/mpm.h"
#include "mpm/nodes/node.h"
#include "solve/cg.h"

enum { EDGE_TAPS = 5 };

/* A finite difference along one grid line. Taps beyond a mirror are nodes inside, with the sign of the component along
 * the axis reversed. */
typedef struct edge_line {
    size_t slot;     /* index of its differences in the history, one for each component from there on */
    int axis;        /* that it runs along */
    bool images;     /* some tap is the image of its node in a mirror, or led by a support */
    bool flows;      /* in this step it yields; it is not damped then */
    int leader;      /* the fixed body, of ours, that leads or holds some tap; -1: none */
    bool unbalanced; /* its forces on unconstrained nodes need not sum to zero: it has an image or a constrained node */
    int node[EDGE_TAPS]; /* in the list of the group's nodes; taps beyond the order of the basis have zero weight */
    /* Weights of the taps, for components across the line and for the one along it, whose sign images reverse. */
    double weight[2][EDGE_TAPS];
    double stiffness; /* N/m: k */
    double inertia;   /* kg: a */
    double most;      /* m: |D u| at which it yields, as its solid does */
    double kept;      /* of its next difference, what its yielding has left; 1: it does not yield */
} edge_line;

/* Copies of a node in blocks: owned, ghosts, and periodic images. */
typedef struct edge_copy {
    int block;
    ptrdiff_t at;
} edge_copy;

typedef struct edge_node {
    int at[MESH_MAX_DIM]; /* global */
    unsigned constrained; /* bit of each component that a wall or a support constrains */
    int body;             /* whose lines have this node */
    size_t slot;          /* index of its acceleration in the history, one for each component from there on */
    size_t copy, copies;  /* in the list of copies: the first, and how many */
} edge_node;

/* Inertia of a group's lines as a sparse matrix over its nodes: rows of equal width, the first entry of each the
 * diagonal. Owned arrays. */
typedef struct edge_matrix {
    int width;       /* reserved entries of a row */
    int *count;      /* used entries of each row */
    int *column;     /* the same for all components */
    double *inertia; /* kg: sum of a D^T D, by component (`reserved` entries apart), row and entry */
    size_t reserved; /* entries */
} edge_matrix;

/* Nodes lo to end - 1 along each axis. */
typedef struct edge_box {
    int lo[MESH_MAX_DIM], end[MESH_MAX_DIM];
} edge_box;

/* Lines of one group. Owned arrays. */
typedef struct edge_group {
    edge_box box;    /* contains all nodes of lines in the history */
    edge_box filled; /* filled nodes in the last search */
    edge_line *line;
    edge_node *node;
    edge_copy *copy;     /* of each node, first that of the block which owns it */
    double *next;        /* m: differences of the next state, by line and component */
    double *accelerated; /* m/s2: of the current step, by component and node */
    edge_matrix matrix;
    size_t n_lines, lines_reserved, n_copies, copies_reserved, nodes_reserved, next_reserved;
    int n_nodes;
    double speed;        /* m/s: of the fastest solid of the group at rest */
    double damping;      /* 1/s: damping of lines over their inertia */
    size_t n_flowing;    /* lines that yield in this step */
    double travelled;    /* cells: largest motion of nodes since the last search, at the end of the step */
    double loaded_nodes; /* hash of the set of nodes that take forces in this step */
    bool listed;         /* the lists agree with the history */
    bool looked;         /* lines were searched in this step */
} edge_group;

/* Projection of a body's residual onto the motions that its lines do not resist: uniform, and linear in each
 * coordinate. */
enum { EDGE_MOTIONS = 1 + MESH_MAX_DIM };
typedef struct edge_motion {
    double centre[MESH_MAX_DIM], nodes;         /* cells; how many */
    double inertia[EDGE_MOTIONS][EDGE_MOTIONS]; /* kg cells^2 */
    double share[EDGE_MOTIONS];                 /* N cells; then m/s2 per cell */
} edge_motion;

typedef struct mpm_edges {
    double penalty; /* gamma */
    bool starting;  /* before masses are known */
    bool spares;    /* in explicit steps lines have no nodes that bodies in contact share */
    edge_group group[MPM_MAX_GROUPS];
    /* History of the lines, for every group and node of the mesh, owned: first the differences (m) by axis of the line
     * and component; from the offsets below on, accelerations (m/s2) of the last step by component, 0 where no line is;
     * by axis the body of a line plus one, 0 where none is; by group how many cells nodes may have moved since the last
     * search; and by group the hash of the loaded nodes. */
    double *memory;
    size_t n_memory, accelerations, lines, travel, loaded_nodes;
    double *fill;            /* of the current group, per global node: share that its solids fill. Owned */
    int *owner;              /* the body that fills it; negative: none, or several. Owned */
    int *index;              /* per global node: index in the list that is being made, -1: not in it. Owned */
    edge_motion *motion;     /* of each body; owned */
    cg *solver;              /* of the accelerations; owned */
    double *solve;           /* scratch of vectors over the nodes; owned */
    size_t scratch_reserved; /* nodes */
    int nodes[MESH_MAX_DIM]; /* of the whole mesh; a periodic end is node 0 */
} mpm_edges;

/* Updates a group's lists, from the history where that is still valid; `anew`: by a new search in any case. After
 * masses. */
floe_status edges_find(mpm *s, int group, bool anew);
/* Finds the lines from the filled shares of nodes and writes them into the history; *changed: they differ from the last
 * ones (edge_detect.c). */
floe_status edges_look(mpm *s, int group, bool *changed);
/* Number of nodes of the mesh, and index of one of them. */
static inline size_t edge_all_nodes(const mpm_edges *e)
{
    return (size_t)e->nodes[0] * (size_t)e->nodes[1] * (size_t)e->nodes[2];
}

static inline size_t edge_number(const mpm_edges *e, const int at[MESH_MAX_DIM])
{
    return (size_t)at[0] + (size_t)e->nodes[0] * ((size_t)at[1] + (size_t)e->nodes[1] * (size_t)at[2]);
}

/* End of the loops over the nodes that a block owns. */
static inline void edge_own_nodes(const mesh *m, const block *b, int end[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        end[a] = a < m->dim ? b->n[a] + (b->at_side[a][SIDE_UPPER] && !m->periodic[a] ? 1 : 0) : 1;
}

/* Whether a node takes forces. */
static inline bool edge_bears(const mpm *s, const double *mass, ptrdiff_t at)
{
    return mass[at] > small_node(s);
}

/* Whether lines have no nodes that bodies in contact share. */
static inline bool edges_spare_met_nodes(const mpm *s)
{
    return s->edges->spares && !mpm_is_solved(s);
}

/* Place, among lines by group, node and axis, of that along an axis from a node on. Those from the image of the first
 * inner node have the positions of lines from the last node, which would lie beyond the mesh. */
static inline size_t edge_place(const mpm *s, int group, int axis, const int first[MESH_MAX_DIM])
{
    const mpm_edges *e = s->edges;
    int at[MESH_MAX_DIM] = {first[0], first[1], first[2]};
    if (at[axis] < 0) at[axis] += e->nodes[axis];
    return ((size_t)group * edge_all_nodes(e) + edge_number(e, at)) * (size_t)s->mesh->dim + (size_t)axis;
}

/* Whether a solid has edges: membranes have none. */
static inline bool edge_body(const mpm *s, int body)
{
    return body < s->n_deforming && !s->body[body].fluid && !s->body[body].membrane.model;
}

/* Nodes and weights of the taps of a line along l->axis from a node on; false where one is beyond the mesh. */
bool edge_find_taps(const mpm *s, int group, const int first[MESH_MAX_DIM], int tap[EDGE_TAPS][MESH_MAX_DIM],
                    edge_line *l);
/* Calls for every node of the group's box from which a line along an axis may begin, and for the image of the first inner one. */
typedef floe_status edge_visit(mpm *s, int group, int axis, const int first[MESH_MAX_DIM], void *user);
floe_status edge_visit_starts(mpm *s, int group, edge_visit *visit, void *user);

/* The weights of a line's taps for a component. */
static inline const double *edge_weights(const edge_line *l, int c)
{
    return l->weight[c == l->axis ? 1 : 0];
}

/* D u of a line, from one component at the nodes of the list. */
static inline double edge_difference(const edge_line *l, int c, const double *u)
{
    const double *w = edge_weights(l, c);
    double sum = 0.0;
    for (int t = 0; t < EDGE_TAPS; ++t) sum += w[t] * u[l->node[t]];
    return sum;
}

/* out += factor D^T. */
static inline void edge_add(const edge_line *l, int c, double factor, double *out)
{
    const double *w = edge_weights(l, c);
    for (int t = 0; t < EDGE_TAPS; ++t) out[l->node[t]] += factor * w[t];
}

static inline bool edge_constrains(const edge_node *n, int c)
{
    return ((n->constrained >> c) & 1u) != 0;
}

/* What a unit of D^T gives to the nodes, or to those that are free in component c: none, but beside walls and
 * mirrors. */
static inline double edge_sum(const edge_group *g, const edge_line *l, int c, bool free_only)
{
    double sum = 0.0;
    for (int t = 0; t < EDGE_TAPS; ++t)
        if (!free_only || !edge_constrains(&g->node[l->node[t]], c)) sum += edge_weights(l, c)[t];
    return sum;
}

/* Forces that lines give as a whole: momentum along c (N), and moments. */
typedef struct edge_giving {
    double walls, moment[3]; /* of walls, mirrors and supports */
    double bodies;           /* of fixed bodies, which have taken it */
} edge_giving;

/* Adds what D^T times `factor` gives to all nodes, or to those that are free. */
void edges_give(const mpm *s, const edge_group *g, const edge_line *l, int c, bool free_only, double factor,
                edge_giving *sum);

/* What walls and mirrors give in a step. */
static inline void edges_enter(mpm *s, int c, const edge_giving *given)
{
    ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + c), LEDGER_BOUNDARY, given->walls * s->kick);
    ledger_turn(s->ledger, LEDGER_BOUNDARY, given->moment, s->kick);
}

/* Nodes of a line: the order of the basis and two more. */
int edge_taps(const mpm *s);
/* Scratch for vectors over a group's nodes, valid until the next call. */
floe_status edges_scratch(mpm *s, const edge_group *g, size_t vectors, double **out);
/* One component of a field at the nodes of a group's list. */
void edges_values(const mpm *s, int group, field_id id, int c, double *value);
/* Adds to it, wherever blocks have the nodes. */
void edges_add_to_copies(const mpm *s, int group, field_id id, int c, const double *value);
/* Forces (N) of a group's lines along c on its nodes. */
void edges_push(const mpm *s, const edge_group *g, int c, double *force);
/* Finds the lines that yield in this step. */
void edges_mark_flow(const mpm *s, edge_group *g);
/* Lines yield where their next state would exceed the yield stress of their solid. */
void edges_let_flow(const mpm *s, edge_group *g);

#endif

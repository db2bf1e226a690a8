/* Edges of solids, held by a penalty (ghost penalty; theory 4.10, Coombs 2022).
 *
 * Nodes that a solid fills in part have little to say for themselves: what few points lie in their support sets them,
 * with stresses many times too large. So along each grid line the differences of the order of the basis plus one, D u,
 * of displacements at nodes of which one is filled in part are penalised by the energy
 *
 *   1/2 k |D u|^2,   k = gamma M V/h^2      M = rho c^2 of the solid, V of a cell, h along the line,
 *
 * which vanishes for what the basis can represent exactly: no accuracy is lost, no force or moment added. Displacements
 * are not known to the nodes; each line keeps the sum of dt D v, of the velocities that points are strained with, since
 * it became one, and forgets it when it is one no more.
 *
 * Nodes without mass would not bear such a spring in an explicit step. So the same differences have inertia, a = k
 * (h/c)^2 for each line:
 *
 *   (m + sum a D^T D) a_i = f_i
 *
 * whose frequencies c/h are below those of the mesh, so that the stable step stays what it was; half of critical
 * damping, taken implicitly, keeps them quiet, for the velocities of such nodes come anew from the points in each step,
 * and their energy goes astray. The system is solved over the nodes of the lines by conjugate gradients (edge_solve.c),
 * from the accelerations of the last step, in global order: the same bits for any blocks and threads.
 *
 * A line bears no more than its solid: beyond |D u| = h y/(rho c^2), y the yield stress, it flows; what dampens it would
 * be borne in addition, and does not then. Lines lie within one body. They neither reach nodes that another solid or a
 * membrane reaches, nor lead through what is outside: from one side of a slot, or of a hole of a few cells, to the other.
 *
 * Which nodes are filled in part is looked for (edge_lines.c) when nodes may have moved by some hundredths of a cell
 * since, or one has begun to take forces or ceased to. Private to the mpm room. */
#ifndef MPM_EDGE_H
#define MPM_EDGE_H

#include "mpm/mpm.h"
#include "mpm/work.h"

enum { EDGE_TAPS = 5 };

/* A difference along one grid line. Taps beyond a mirror are nodes inside, with the sign of the component along the
 * axis turned. */
typedef struct edge_line {
    size_t slot;     /* of its differences among what is remembered; one a component from there on */
    int axis;        /* that it runs along */
    bool images;     /* some tap is the image of its node in a mirror */
    bool flows;      /* in this step it bears the most that it can; nothing dampens it then */
    bool unbalanced; /* what it gives to the free nodes may not add up to nothing: an image, or a node that is held */
    int node[EDGE_TAPS]; /* in the list of the group's nodes; taps that the basis does not need have no weight */
    /* Of the taps: of components across the line, and of that along it, which images turn. */
    double weight[2][EDGE_TAPS];
    double stiffness; /* N/m: k */
    double inertia;   /* kg: a */
    double most;      /* m: |D u| that it bears; it flows beyond, as its solid does */
} edge_line;

/* Where a block has a node: its own, ghosts, and periodic images. */
typedef struct edge_copy {
    int block;
    ptrdiff_t at;
} edge_copy;

typedef struct edge_node {
    int at[MESH_MAX_DIM]; /* global */
    unsigned held;        /* bit of each component that a wall or a support holds */
    int body;             /* whose lines lead there */
    size_t slot;          /* of its acceleration among what is remembered; one a component from there on */
    size_t copy, copies;  /* in the list of copies: the first, and how many */
} edge_node;

/* Inertia of a group's lines as a matrix over its nodes: rows of equal room, of which the first entry is the
 * diagonal's. Owned arrays. */
typedef struct edge_matrix {
    int width;       /* entries that a row has room for */
    int *count;      /* that it has */
    int *column;     /* the same for all components */
    double *inertia; /* kg: sum of a D^T D, by component, `room` entries apart, row and entry */
    size_t room;     /* entries */
} edge_matrix;

/* Nodes lo to end - 1 along each axis. */
typedef struct edge_box {
    int lo[MESH_MAX_DIM], end[MESH_MAX_DIM];
} edge_box;

/* Lines of one group. Owned arrays. */
typedef struct edge_group {
    edge_box box;    /* has all nodes of lines that are remembered */
    edge_box filled; /* in the last look */
    edge_line *line;
    edge_node *node;
    edge_copy *copy;     /* of each node, that of the block which owns it first */
    double *next;        /* m: differences of the next state, by line and component */
    double *accelerated; /* m/s2: of the step in hand, by component and node */
    edge_matrix matrix;
    size_t n_lines, line_room, n_copies, copy_room, node_room, next_room;
    int n_nodes;
    double speed;     /* m/s: of the fastest solid of the group at rest */
    double damping;   /* 1/s: of lines over their inertia */
    size_t n_flowing; /* lines that flow in this step */
    double travelled; /* cells: by how much nodes may have moved at the end of the step since lines were looked for */
    double bearing;   /* which nodes take forces in this step, as one number */
    bool listed;      /* the lists are of the lines that are remembered */
    bool looked;      /* for lines in this step */
} edge_group;

/* A body's share of the residual in the motions that its lines do not resist: 1, and each coordinate. */
enum { EDGE_MOTIONS = 1 + MESH_MAX_DIM };
typedef struct edge_motion {
    double centre[MESH_MAX_DIM], nodes;         /* cells; how many */
    double inertia[EDGE_MOTIONS][EDGE_MOTIONS]; /* kg cells^2 */
    double share[EDGE_MOTIONS];                 /* N cells; then m/s2 per cell */
} edge_motion;

struct mpm_edges {
    double penalty; /* gamma */
    bool starting;  /* masses are not known yet */
    edge_group group[MPM_MAX_GROUPS];
    /* All that a step must know of those before, for every group and node of the mesh, owned: first the differences (m)
     * by axis of the line and component; from the following places on accelerations (m/s2) of the last step by
     * component, 0 where no line is; by axis the body of a line plus one, 0 where none is; by group how many cells
     * nodes may have moved since lines were looked for; and by group which nodes took forces. */
    double *memory;
    size_t n_memory, accelerations, lines, travel, bearing;
    double *fill;            /* of the group in hand, per global node: share that its solids fill. Owned */
    int *owner;              /* the body that fills it; negative: none, or several. Owned */
    int *index;              /* per global node: in the list that is being made, -1: not in it. Owned */
    edge_motion *motion;     /* of each body; owned */
    double *solve;           /* room of the solver; owned */
    size_t solve_room;       /* nodes */
    int nodes[MESH_MAX_DIM]; /* of the whole mesh; a periodic end is node 0 */
};

/* Room for a scene whose deck asks for it. */
floe_status edges_create(mpm *s);
void edges_free(context *ctx, mpm_edges **e);
/* Lists and room for the points as they were seeded. */
floe_status edges_start(mpm *s);
/* Makes a group's lists stand for its solids where they are, from what is remembered where that will do; `anew`: in any
 * case by a look. After masses. */
floe_status edges_find(mpm *s, int group, bool anew);
/* Which lines there are, by what solids fill of nodes, into what is remembered; *changed: others than before
 * (edge_look.c). */
floe_status edges_look(mpm *s, int group, bool *changed);
/* Nodes of the mesh, and the number of one among them. */
static inline size_t edge_all_nodes(const mpm_edges *e)
{
    return (size_t)e->nodes[0] * (size_t)e->nodes[1] * (size_t)e->nodes[2];
}

static inline size_t edge_number(const mpm_edges *e, const int at[MESH_MAX_DIM])
{
    return (size_t)at[0] + (size_t)e->nodes[0] * ((size_t)at[1] + (size_t)e->nodes[1] * (size_t)at[2]);
}

/* Where the loops over the nodes that a block owns end, from its first on. */
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

/* Place, among lines by group, node and axis, of that along an axis from a node on. Those from the image of the first
 * inner node have the places of lines from the last node, which would lie beyond the mesh. */
static inline size_t edge_place(const mpm *s, int group, int axis, const int first[MESH_MAX_DIM])
{
    const mpm_edges *e = s->work->edges;
    int at[MESH_MAX_DIM] = {first[0], first[1], first[2]};
    if (at[axis] < 0) at[axis] += e->nodes[axis];
    return ((size_t)group * edge_all_nodes(e) + edge_number(e, at)) * (size_t)s->mesh->dim + (size_t)axis;
}

/* Whether a solid has edges: membranes have none. */
static inline bool edge_body(const mpm *s, int body)
{
    return !s->body[body].fluid && !s->body[body].membrane.model;
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

static inline bool edge_holds(const edge_node *n, int c)
{
    return ((n->held >> c) & 1u) != 0;
}

/* What a unit of D^T gives to the nodes, or to those that are free in component c: none, but beside walls and
 * mirrors. */
static inline double edge_sum(const edge_group *g, const edge_line *l, int c, bool free_only)
{
    double sum = 0.0;
    for (int t = 0; t < EDGE_TAPS; ++t)
        if (!free_only || !edge_holds(&g->node[l->node[t]], c)) sum += edge_weights(l, c)[t];
    return sum;
}

/* Its moment: that of `given` along c, spread as D^T over the nodes, or over those that are free. */
static inline void edge_turn(const mesh *m, const edge_group *g, const edge_line *l, int c, bool free_only,
                             double given, double moment[3])
{
    for (int t = 0; t < EDGE_TAPS; ++t) {
        const edge_node *n = &g->node[l->node[t]];
        double x[MESH_MAX_DIM];
        if (free_only && edge_holds(n, c)) continue;
        place_of_node(m, n->at, x);
        add_moment(moment, x, c, given * edge_weights(l, c)[t]);
    }
}

/* What walls and mirrors give in a step: momentum along c, and moments. */
static inline void edges_enter(mpm *s, int c, double given, const double moment[3])
{
    ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + c), LEDGER_BOUNDARY, given * s->work->kick);
    ledger_turn(s->ledger, LEDGER_BOUNDARY, moment, s->work->kick);
}

/* Nodes of a line: the order of the basis and two more. */
int edge_taps(const mpm *s);
/* Room for some vectors over a group's nodes, until it is asked for again. */
floe_status edges_scratch(mpm *s, const edge_group *g, size_t vectors, double **out);
/* One component of a field at the nodes of a group's list. */
void edges_values(const mpm *s, int group, field_id id, int c, double *value);
/* Adds to it, wherever blocks have the nodes. */
void edges_add_to_copies(const mpm *s, int group, field_id id, int c, const double *value);
/* Forces (N) of a group's lines along c on its nodes; gives what mirrors add to their sum. */
double edges_push(const mpm *s, const edge_group *g, int c, double *force, double moment[3]);
/* Accelerations and v^L of a group with the inertia of its lines. After walls. */
floe_status edges_accelerate(mpm *s, int group);
/* Finds the lines that flow in this step. */
void edges_mark_flow(const mpm *s, edge_group *g);
/* Lines flow where those of the next state would bear more than their solid does. */
void edges_let_flow(const mpm *s, edge_group *g);
/* The differences of the next state, by the velocities that points are strained with. */
floe_status edges_strain(mpm *s, int group, field_id velocity);
/* What the next state has becomes what is remembered. */
void edges_commit(mpm *s);

#endif

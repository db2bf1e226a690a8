/* The balance of forces at the nodes, solved for the displacement of a whole load increment (statics) or of a step that
 * sound does not bind (balance_motion.c), instead of being stepped to.
 *
 *     f_ext - sum_p V0 T : grad S = 0,   T = J sigma(F_p) (I + grad u)^-T,   F_p = (I + grad u) F_p^n,
 *
 * (f_ext with the pressure of gas at rest; what gas of the cells has out of balance at the start goes away evenly up to
 * the end of the run) with the shape functions of where the points are at the start of the increment (updated
 * Lagrangian), so that it holds at any strain of the increment. Newton's method: tangents of T with respect to grad u
 * are differences of the law itself, point by point, made symmetric; the matrix of the nodes is assembled from them,
 * and conjugate gradients solve with it under multigrid (solve/node_multigrid.h). Folded bases make the walls, as in
 * the explicit step. Private to the mpm room. */
#ifndef MPM_BALANCE_H
#define MPM_BALANCE_H

#include "mpm/work.h"
#include "solve/cg.h"
#include "solve/node_multigrid.h"

enum { BALANCE_GRADIENTS = 9, BALANCE_NODES = BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT };

/* The basis at a point along each axis, with what ghosts get folded in: `plain` for components along the wall, and
 * `turned` for the one normal to a mirror, which is odd there. Slopes in 1/m. */
typedef struct axis_place {
    int first;
    double plain[BASIS_MAX_SUPPORT], plain_slope[BASIS_MAX_SUPPORT];
    double turned[BASIS_MAX_SUPPORT], turned_slope[BASIS_MAX_SUPPORT];
} axis_place;

typedef struct point_place {
    axis_place axis[MESH_MAX_DIM];
    double radius; /* m: the first coordinate, asked for about an axis alone */
} point_place;

/* A node as a point sees it: weight and gradient (1/m) for each component of what the node carries. */
typedef struct place_node {
    int node[MESH_MAX_DIM]; /* global, before it is brought around a periodic end */
    int at;                 /* of the solver's grid */
    double S[MESH_MAX_DIM], slope[MESH_MAX_DIM][MESH_MAX_DIM];
} place_node;

/* The gas of a fluid body that solids enclose, or a gas of the cells: at rest one pressure everywhere. */
typedef struct balance_room {
    int body;             /* of the points; -1: gas of the cells */
    solid_fluid_par par;  /* its law, without viscosity */
    bool open;            /* its mass comes and goes, at the pressure `scheduled` */
    double *push;         /* N/Pa, on the grid: forces of a unit of pressure; m2: what its volume gains by. Owned */
    double mass, volume0; /* kg; m3: of the points at rest; of gas of the cells at the start */
    double mass_first;    /* kg */
    double density_rest;  /* kg/m3: of one that is open, at its pressure */
    double volume_first, energy_first, pressure_first; /* m3, J/kg, Pa: at the start of the increment */
    double volume, energy, pressure;                   /* now */
    double stiffness;                                  /* Pa/m3: -dp/dV */
    double scheduled;                                  /* Pa, NAN: none; what a load makes of its pressure */
    double heat;                                       /* J, of loads */
} balance_room;

struct mpm_balance {
    solve_grid grid;
    balance_room *room; /* owned */
    int n_rooms;
    struct line_rest *line;              /* owned; NULL: solids on the mesh */
    struct balance_contact *contact;     /* owned; NULL: no bodies in contact */
    node_multigrid *solver;              /* owned */
    cg *krylov;                          /* owned */
    int layers, layer[SCENE_MAX_BODIES]; /* displacement fields: one, and with a contact one a group; that of a body */
    size_t components;                   /* entries of an array on the grid, all components of all layers */
    /* Components of grad u that the scene has, row-major in three dimensions. */
    int n_gradient, gradient[BALANCE_GRADIENTS];
    size_t points, points_room;                      /* of solids, in all blocks; and for how many there is room */
    size_t first[MESH_MAX_BLOCKS][SCENE_MAX_BODIES]; /* number of a body's first point */
    point_place *place;                              /* owned */
    double *pull;                                    /* V0 T (J), n_gradient a point; owned */
    double *tangent;                                 /* d pull / d grad u (J), n_gradient^2 a point; owned */
    /* On the grid; owned. Displacement and its change (m); forces (N): from outside, of the points at the start and
     * now, what is left. */
    double *u, *change, *outer, *pushed, *inner_first, *inner, *left, *trial;
    /* kg, in the first component, and m/s: of nodes with inertia, at the start; else NULL. Owned. */
    double *mass, *velocity;
    /* N, beside gas of the cells: loads at the start; what was not in balance there. NULL else; owned. */
    double *outer_first, *unbalanced;
    double acceleration_first[SCENE_MAX_BODIES][3]; /* m/s2: body forces at the start */
    double keep;                                    /* share of `unbalanced` that the increment leaves */
    double *target;                                 /* m: displacement of what is held; owned */
    double *way;                                    /* m: to there, and to what bodies in contact bind; owned */
    bool *held;                                     /* components of nodes that walls and supports hold; owned */
    bool *reached;                 /* components of nodes that points of their layer's solids reach; owned */
    bool *row;                     /* nodes that points of some solid reach; owned */
    bool ready;                    /* the matrix is that of some displacement of this increment */
    int newton, krylov_iterations; /* of the increment */
    int *tile_block, *tile_local;  /* of each global tile; owned */
};

/* How a solver's points are visited: a whole tile's, tiles that share no node at the same time, in an order that
 * neither blocks nor threads change. */
typedef void balance_tile(mpm *s, int blk, int tile, void *user);
void balance_for_tiles(mpm *s, balance_tile *visit, void *user);

/* Where the points are, for an increment (balance_place.c). Errors: FLOE_NO_MEMORY. */
floe_status balance_locate(mpm *s);
/* The nodes about a point, with its weights. Returns how many. */
int balance_nodes(const mpm *s, const point_place *p, place_node out[BALANCE_NODES]);

/* Stress and pull of every point at the displacement u, and its next state (balance_points.c). FLOE_RETRY where a point
 * is beyond its law. */
floe_status balance_strain(mpm *s, const double *u);
/* The tangents there. FLOE_RETRY as above. */
floe_status balance_tangents(mpm *s, const double *u);
/* inner = - sum pull : grad S. */
void balance_pull(mpm *s, double *inner);
/* outer += sum m S fall (N), `fall` the body force on each body (m/s2); with `drive` also the force of an exact
 * solution. */
void balance_weigh(mpm *s, double (*fall)[3], bool drive, double *outer);
/* share += sum m S (kg). */
void balance_share(mpm *s, double *share);
/* out -= sum V grad S (m2), about an axis with the hoop's part. */
void balance_squeeze(mpm *s, double *out);
/* The displacement of a node of a group, by global index, ghosts beyond the sides included. */
double balance_way(const mpm *s, int group, const int node[MESH_MAX_DIM], int c);
/* Next places and velocities: none in statics. FLOE_RETRY where one has gone farther than a cell. */
floe_status balance_move(mpm *s);

/* Whether bodies in contact have their gaps from their surfaces (balance_gap.c), which loaded ones are carried with. */
bool balance_measures_gaps(const mpm *s);

/* How many nodes farther along an axis lines of edges that are held couple than points do. */
int balance_arm(const mpm *s);
/* Edges held by a penalty (balance_edges.c; nothing without). The lines of an increment. Errors: FLOE_NO_MEMORY. */
floe_status balance_find_edges(mpm *s);
/* Their forces (N) at the displacement u (m), added to `inner`, and the differences that they remember then. */
void balance_pull_edges(mpm *s, const double *u, double *inner);
/* Their stiffness, added to the matrix. */
void balance_assemble_edges(mpm *s, node_matrix *m);
/* What they store in the increment, into the ledger. */
void balance_enter_edges(mpm *s);

/* Assembles the matrix of the tangents (balance_matrix.c). */
void balance_assemble(mpm *s);

/* What walls and supports hold, and where (balance_hold.c). */
void balance_hold(mpm *s);
/* Which nodes points of solids reach. */
void balance_reach(mpm *s);
/* Adds a group's node field of the blocks (N_FORCE ...) to an array of the solver's; one of one component is the first
 * of its layer. */
void balance_collect(mpm *s, field_id id, int group, double *out);
/* The layer that a group moves in. */
static inline int balance_layer(const mpm *s, int group)
{
    return s->balance->layers > 1 ? group : 0;
}
/* Place of a component of a node in the solver's arrays. */
static inline size_t balance_at(const struct mpm_balance *w, int layer, int c, int node)
{
    return (size_t)(layer * w->grid.dim + c) * w->grid.size + (size_t)node;
}
/* FLOE_DIVERGED with the cause where the points that hang together could move as a rigid body (balance_free.c). */
floe_status balance_check_free(mpm *s);

void balance_destroy(mpm *s);

/* Inertia (balance_motion.c). Mass and velocity of the nodes at the start of the step. */
void motion_begin(mpm *s);
/* A first guess of u (m): nodes go on as they move. */
void motion_guess(const mpm *s, double *u);
/* Entry k of what inertia and damping take of the forces (N), at its displacement u (m). */
double motion_force(const mpm *s, size_t k, double u);
/* From the matrix of the stiffness to that of the step: half of it, and what inertia and damping add. */
void motion_stiffen(const mpm *s, node_matrix *m);
/* Entry k of the velocity (m/s) at the end of the step. */
double motion_velocity(const mpm *s, size_t k);
/* Impulses and work of loads, damping and what holds nodes, into the ledger. */
void motion_enter(mpm *s);

/* Rooms (balance_room.c): one for each fluid body that solids enclose, found once. Errors: FLOE_NO_MEMORY. */
floe_status rooms_find(mpm *s);
void rooms_free(mpm *s);
/* Beside gas on cells (balance_gas.c): a room for each gas that there is in the increment. Errors: FLOE_NO_MEMORY. */
floe_status rooms_take_gases(mpm *s);
/* What the gas of such rooms pushes, where solids share cells with it; once the points have been located. Errors:
 * FLOE_BAD_INPUT where a solid is too thin for that. */
floe_status rooms_squeeze(mpm *s);
/* Rooms as they are at the start of an increment, and what pushes their walls. */
floe_status rooms_begin(mpm *s);
/* Pressures at the displacement u (m); adds their forces (N) to `pushed`. FLOE_RETRY where a room would lose all its
 * volume, or its gas is beyond its law. */
floe_status rooms_push(mpm *s, const double *u, double *pushed);
/* Adds the forces (N) of the pressures at the start of the increment. */
void rooms_push_first(mpm *s, double *pushed);
/* y += A x, A the stiffness of the rooms (N/m). */
void rooms_stiffen(const struct mpm_balance *w, const double *x, double *y);
/* The next state of their points, or what gas of the cells has come to. */
void rooms_store(mpm *s);
/* Enters them into the ledger; returns what they did to the solids (J). */
double rooms_enter(mpm *s);
/* Pressure, energy and stiffness of one room once it has gained a volume (m3). FLOE_RETRY as rooms_push. */
floe_status room_set(mpm *s, balance_room *r, double gain);
/* The next state of its points in a block. */
void room_store(mpm *s, const balance_room *r, int blk);
/* What gas of the cells has come to. */
void gas_store(const balance_room *r, mpm_gas *gas);

/* A membrane around gas instead (balance_line.c). Why it cannot be solved for, in words, or NULL. */
const char *line_rest_obstacle(const mpm *s);
/* Storage for it. Errors: FLOE_NO_MEMORY. */
floe_status line_rest_create(mpm *s);
void line_rest_destroy(mpm *s);

#endif

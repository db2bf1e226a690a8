/* Equilibrium of the nodes, solved by Newton's method for the displacement of a load increment (statics), or of a time
 * step of implicit dynamics, which the speed of sound does not limit (implicit_motion.c).
 *
 *     f_ext - sum_p V0 T : grad S = 0,   T = J sigma(F_p) (I + grad u)^-T,   F_p = (I + grad u) F_p^n,
 *
 * f_ext contains the pressure of gas at rest; the residual that gas on the cells has at the start decreases linearly to
 * zero over the run. Shape functions are those of the points' positions at the start of the increment (updated
 * Lagrangian), so that the increment may have any strain. The tangents dT/d(grad u) are finite differences of the
 * material law at each point, made symmetric. The stiffness matrix of the nodes is assembled from them; conjugate
 * gradients with a multigrid preconditioner (solve/multigrid.h) solve for the increment. Walls are imposed by
 * folded shape functions, as in the explicit step. Private to the mpm module. */
#ifndef MPM_IMPLICIT_H
#define MPM_IMPLICIT_H

#include "mpm/mpm.h"
#include "solve/cg.h"
#include "solve/multigrid.h"

enum { IMPLICIT_GRADIENTS = 9, IMPLICIT_NODES = 2 * BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT };

/* Shape functions at a point along one axis, those of ghost nodes folded into nodes of the mesh: `plain` for components
 * parallel to a mirror, `turned` for the component normal to it, which is odd there. Slopes in 1/m. */
typedef struct axis_weights {
    int first;
    double plain[BASIS_MAX_SUPPORT], plain_slope[BASIS_MAX_SUPPORT];
    double turned[BASIS_MAX_SUPPORT], turned_slope[BASIS_MAX_SUPPORT];
} axis_weights;

typedef struct point_weights {
    axis_weights axis[MESH_MAX_DIM];
    double radius; /* m: the first coordinate, in axisymmetric scenes only */
    int support;   /* to which the point belongs, and reaches no node; -1: none */
} point_weights;

/* A node in the support of a point: value and gradient (1/m) of its shape function, for each component of the
 * displacement. */
typedef struct weighted_node {
    int node[MESH_MAX_DIM]; /* global, before it is brought around a periodic end */
    int at;                 /* of the solver's grid */
    double S[MESH_MAX_DIM], slope[MESH_MAX_DIM][MESH_MAX_DIM];
} weighted_node;

/* Gas at rest with one pressure: of a fluid body that solids enclose, or of a region of cells. */
typedef struct enclosed_gas {
    int body;            /* of the points; -1: gas of the cells */
    solid_fluid_par par; /* its law, without viscosity */
    bool open;           /* its mass changes so that the pressure is `scheduled` */
    double *
        unit_force; /* on the grid, N/Pa: nodal forces of a unit pressure, which are the gradient of its volume (m2). Owned */
    double
        *marker_force; /* N/Pa, three a marker: the same on the markers of walls of gas on cells; NULL: none. Owned */
    double swept;      /* m3: by what its walls, where they follow the displacement, have enlarged it */
    double mass, volume0; /* kg; m3: of the points at rest, or of the gas on cells at the start */
    double mass_first;    /* kg */
    double density_rest;  /* kg/m3: of an open one, at its pressure */
    double volume_first, energy_first, pressure_first; /* m3, J/kg, Pa: at the start of the increment */
    double volume, energy, pressure;                   /* now */
    double stiffness;                                  /* Pa/m3: -dp/dV */
    double scheduled;                                  /* Pa: pressure that a load prescribes; NAN: none */
    double heat;                                       /* J, of loads */
} enclosed_gas;

/* Whether the forces on its walls follow the displacement (implicit_loads.c): of points, and of cells with a sharp interface. */
static inline bool gas_walls_follow(const enclosed_gas *gas)
{
    return gas->body >= 0 || gas->marker_force;
}

struct mpm_implicit {
    solve_grid grid;
    enclosed_gas *gas_set; /* owned */
    int n_gases;
    struct curve_rest *curve;         /* owned; NULL: solids on the mesh */
    struct implicit_contact *contact; /* owned; NULL: no bodies in contact */
    struct implicit_volume *volume;   /* owned; NULL: no body is all but incompressible */
    struct implicit_springs *springs; /* owned; NULL: there are none (implicit_loads.c) */
    struct implicit_walls *walls;     /* owned; NULL: steps are solved for (implicit_walls.h) */
    multigrid *solver;                /* owned */
    cg *krylov;                       /* owned */
    int layers,
        layer
            [SCENE_MAX_BODIES]; /* displacement fields: one, or with contact one for each group; and the field of each body */
    size_t components;          /* entries of an array on the grid: all components of all displacement fields */
    /* Components of grad u that are not zero in the scene, row-major in three dimensions. */
    int n_gradient, gradient[IMPLICIT_GRADIENTS];
    size_t points, points_reserved; /* of solids, in all blocks; and for how many storage is reserved */
    size_t first[MESH_MAX_BLOCKS][SCENE_MAX_BODIES]; /* number of a body's first point */
    point_weights *weights;                          /* owned */
    double *point_force;                             /* V0 T (J), n_gradient a point; owned */
    double *tangent;                                 /* d point_force / d grad u (J), n_gradient^2 a point; owned */
    /* On the grid; owned. Displacement and its Newton increment (m); forces (N): external, of gas, internal at the
     * start and now, residual. */
    double *u, *change, *external, *gas_force, *internal_first, *internal, *residual, *trial;
    double *steady;      /* N: the part of `external` that does not follow the displacement; owned */
    const double *tried; /* m: the displacement at which surfaces are; not owned */
    /* kg (in the first component) and m/s: nodal mass and velocity at the start, of implicit dynamics; else NULL.
     * Owned. */
    double *mass, *velocity;
    /* N, beside gas on cells: external forces and residual at the start; else NULL. Owned. */
    double *external_first, *unbalanced;
    double acceleration_first[SCENE_MAX_BODIES][3]; /* m/s2: body forces at the start */
    double unbalanced_left;                         /* share of `unbalanced` that remains after the increment */
    double law_time;         /* s: the step of laws that depend on time; 0 for the stresses that points start with */
    double *prescribed;      /* m: prescribed displacement of constrained components; owned */
    double *constraint_step; /* m: increment that satisfies the constraints and the active contact conditions; owned */
    bool *constrained;       /* components of nodes that walls and supports constrain; owned */
    bool *reached;           /* components of nodes in the support of some point of their displacement field; owned */
    bool *row;               /* nodes in the support of some solid point; owned */
    int *led;                /* place among the supports' nodes plus one, where one leads the node; owned; NULL: none */
    bool ready;              /* the matrix was assembled in this increment */
    int newton, krylov_iterations; /* of the increment */
    int *tile_block, *tile_local;  /* of each global tile; owned */
};

/* Visits points tile by tile. Tiles that share no node are visited in parallel; the order of sums depends neither on
 * blocks nor on threads. */
typedef void implicit_tile(mpm *s, int blk, int tile, void *user);
void implicit_for_tiles(mpm *s, implicit_tile *visit, void *user);

/* Shape functions of all points for an increment (implicit_weights.c). Errors: FLOE_NO_MEMORY. */
floe_status implicit_locate(mpm *s);
/* The nodes in the support of a point, with their shape functions; those that supports lead are shared by their masters and the supports. Returns how many. */
int implicit_nodes(const mpm *s, const point_weights *p, weighted_node out[IMPLICIT_NODES]);
/* A node whose shape function is a share of what it was. */
weighted_node scaled_node(const weighted_node *node, double factor);
/* The shape functions of a place (m) that belongs to no point. */
point_weights implicit_weights_at(const mpm *s, const double x[3]);

/* Stress and internal force of every point at the displacement u, and its next state (implicit_points.c). FLOE_RETRY
 * where the strain of a point is outside the range of its law. */
floe_status implicit_strain(mpm *s, const double *u);
/* The tangents at this displacement. FLOE_RETRY as above. */
floe_status implicit_tangents(mpm *s, const double *u);
/* inner = - sum point_force : grad S. */
void implicit_internal_force(mpm *s, double *internal);
/* outer += sum m S acceleration (N), with the body force of each body (m/s2); with `drive` also that of an exact
 * solution. */
void implicit_body_force(mpm *s, double (*acceleration)[3], bool drive, double *external);
/* share += sum m S (kg). */
void implicit_node_mass(mpm *s, double *share);
/* out -= sum V grad S (m2), in axisymmetric scenes with the hoop term. */
void implicit_volume_gradient(mpm *s, double *out);
/* The displacement of a node of a group that is tried, by global index, ghosts beyond the sides included. */
double implicit_displacement(const mpm *s, int group, const int node[MESH_MAX_DIM], int c);
/* Next positions and velocities of the points; velocities are zero in statics. FLOE_RETRY where a point moves farther
 * than a cell. */
floe_status implicit_move(mpm *s);

/* How far points couple nodes along each axis. */
int implicit_width(const mpm *s);
/* By how many nodes along an axis the edge penalty couples farther than points do. */
int implicit_arm(const mpm *s);
/* Ghost penalty at the edges of solids (implicit_edges.c; these do nothing without it). Lists the penalised lines of an
 * increment. Errors: FLOE_NO_MEMORY. */
floe_status implicit_find_edges(mpm *s);
/* Adds their forces (N) at the displacement u (m) to `internal`, and computes the differences that they store. */
void implicit_edge_force(mpm *s, const double *u, double *internal);
/* Their stiffness, added to the matrix. */
void implicit_assemble_edges(mpm *s, node_matrix *m);
/* The stiffness of those that do not yield, whatever they do. */
void implicit_stiffen_edges(mpm *s, node_matrix *m);
/* Enters the energy that they store in the increment into the ledger. */
void implicit_enter_edges(mpm *s);

/* Assembles a matrix of tangents, as many a point as `tangent` below (implicit_matrix.c). */
void implicit_assemble(mpm *s, node_matrix *m, const double *tangent);

/* Surfaces under loads and enclosed gas, which follow the displacement u (m) (implicit_loads.c). The external forces there, and those of a unit
 * pressure of enclosed gases of points. */
void implicit_follow_surfaces(mpm *s, const double *u);
/* Moves their corners, and the markers, to where u has them. */
void implicit_move_surfaces(mpm *s, const double *u);
/* The same, the loads (N) being added to `external`, whether nodes are reached or not. */
void implicit_load_surfaces(mpm *s, const double *u, double *external);
/* Adds what turning and stretching surfaces make of their loads to the matrix, made symmetric. */
void implicit_assemble_surfaces(const mpm *s, node_matrix *m);

/* Components that walls and supports constrain, and their prescribed displacements (implicit_constraints.c). */
void implicit_constrain(mpm *s);
/* Marks nodes in the support of solid points. */
void implicit_find_reached(mpm *s);
/* Removes forces on nodes that are in the support of none. */
void implicit_drop_unreached(const struct mpm_implicit *w, double *force);
/* Adds a group's node field (N_FORCE ...) of all blocks to an array of the solver; a scalar field goes into the first
 * component of its displacement field. */
void implicit_collect(mpm *s, field_id id, int group, double *out);
/* The displacement field of a group. */
static inline int implicit_layer(const mpm *s, int group)
{
    return s->implicit->layers > 1 ? group : 0;
}
/* The place (m) of entry i of one component's array. */
void implicit_place(const mpm *s, size_t i, double x[MESH_MAX_DIM]);
/* Index of a component of a node in the solver's arrays. */
static inline size_t implicit_index(const struct mpm_implicit *w, int layer, int c, int node)
{
    return (size_t)(layer * w->grid.dim + c) * w->grid.size + (size_t)node;
}
/* FLOE_DIVERGED, with the cause, where a connected part of the points could move as a rigid body (implicit_rigid.c). */
floe_status implicit_check_rigid_motions(mpm *s);

/* Inertia (implicit_motion.c). Mass and velocity of the nodes at the start of the step. */
void motion_begin(mpm *s);
/* A first guess of u (m): nodes keep their velocity. */
void motion_guess(const mpm *s, double *u);
/* Entry k of the forces (N) of inertia and damping at the displacement u (m). */
double motion_force(const mpm *s, size_t k, double u);
/* Turns the stiffness matrix into that of the time step: half of it, plus the terms of inertia and damping. */
void motion_stiffen(const mpm *s, node_matrix *m);
/* Entry k of the velocity (m/s) at the end of the step. */
double motion_velocity(const mpm *s, size_t k);
/* Enters impulses and work of loads, damping and constraints into the ledger. */
void motion_enter(mpm *s);

/* Walls of fluids with an implicit pressure (implicit_walls.c). Errors: FLOE_NO_MEMORY. */
floe_status stiff_create(mpm *s);
void stiff_free(mpm *s);

/* Springs (implicit_loads.c): storage; the nodes of their ends in an increment. Errors: FLOE_NO_MEMORY. */
floe_status implicit_springs_create(mpm *s);
void implicit_springs_free(mpm *s);
floe_status implicit_springs_find(mpm *s);
/* Adds their forces (N) at the displacement u (m). */
void implicit_springs_force(mpm *s, const double *u, double *external);
/* The energy (J) that they have gained by it. */
double implicit_springs_gain(mpm *s, const double *u);
/* Adds the part of their stiffness that couples the nodes of one point to the matrix, enlarged. */
void implicit_assemble_springs(const mpm *s, node_matrix *m);
/* y += the rest of their stiffness times x. */
void implicit_springs_stiffness(const mpm *s, const double *x, double *y);
/* Enclosed gases (implicit_enclosed_gas.c): one for each fluid body that solids enclose, found once. Errors:
 * FLOE_NO_MEMORY. */
floe_status enclosed_gases_find(mpm *s);
void enclosed_gases_free(mpm *s);
/* Gas on cells (implicit_gas.c): one for each region of gas in the increment. Errors: FLOE_NO_MEMORY. */
floe_status enclosed_gases_from_cells(mpm *s);
/* Forces of a unit pressure of gas that shares cells with solids; after the points have been located. Errors:
 * FLOE_BAD_INPUT where a solid is too thin for that. */
floe_status enclosed_gases_smear(mpm *s);
/* State of the enclosed gases at the start of an increment, and the forces on their walls. */
floe_status enclosed_gases_begin(mpm *s);
/* Pressures at the displacement u (m); their nodal forces (N) into `gas_force`. FLOE_RETRY where a gas would lose all its
 * volume or leave the range of its law. */
floe_status enclosed_gases_force(mpm *s, const double *u, double *gas_force);
/* Adds the forces (N) of the pressures at the start of the increment. */
void enclosed_gases_first_force(mpm *s, double *gas_force);
/* y += A x, A the stiffness of the enclosed gases (N/m). */
void enclosed_gases_stiffness(const struct mpm_implicit *w, const double *x, double *y);
/* The next state of their points, or the final state of gas on cells. */
void enclosed_gases_store(mpm *s);
/* Enters their work and heat into the ledger; returns their work on the solids (J). */
double enclosed_gases_enter(mpm *s);
/* Pressure, energy and stiffness of one gas after a change of its volume (m3). FLOE_RETRY as above. */
floe_status enclosed_gas_set(mpm *s, enclosed_gas *r, double gain);
/* The next state of its points in a block. */
void enclosed_gas_store(mpm *s, const enclosed_gas *r, int blk);
/* The final state of gas on cells. */
void enclosed_gas_to_cells(const enclosed_gas *r, mpm_gas *gas);

/* A membrane around gas (implicit_membrane.c). Why its equilibrium cannot be solved for, in words, or NULL. */
const char *curve_rest_obstacle(const mpm *s);
/* Allocates its storage. Errors: FLOE_NO_MEMORY. */
floe_status curve_rest_create(mpm *s);
void curve_rest_destroy(mpm *s);

#endif

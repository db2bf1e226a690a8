/* Shared by the files of the mpm module: the scratch of a run, and passes over tiles. */
#ifndef MPM_WORK_H
#define MPM_WORK_H

#include "embedded/cut.h"
#include "mpm/kernels.h"
#include "mpm/mpm.h"

/* Loaded surface points: massless, moved by the nodes, each with an area vector (m2) and the load that acts on it. */
typedef struct surface_point {
    double x[3], area[3];
    int load;     /* -1: none, but the pressure of an enclosed gas */
    int enclosed; /* number of the enclosed gas (implicit.h), -1: none */
    int body;     /* of the scene: the body in contact whose surface this is (implicit_gap.c); -1: none */
} surface_point;

typedef struct membrane_curve membrane_curve;
typedef struct saved_points saved_points;
typedef struct membrane_normals membrane_normals;
typedef struct mpm_edges mpm_edges;
typedef struct mpm_wetted mpm_wetted;

/* Where a point was last found: a first guess for the next search. */
typedef struct spring_end {
    int block;
    size_t index;
} spring_end;

typedef struct spring_state {
    spring_end end[2];
    double rest_length; /* m */
} spring_state;

/* Forces of gas on a membrane (boundary.c), by number of its points. Owned arrays. */
typedef struct membrane_force {
    size_t n;      /* 0: the body encloses no gas of the cells */
    double *x;     /* m, three each: positions of the points at the start of the step */
    double *v;     /* m/s, two each: scratch */
    double *force; /* N, two each */
} membrane_force;

/* A marker on the surface of a solid. */
typedef struct surface_marker {
    double x[3], v[3]; /* m, m/s */
} surface_marker;

/* Markers on the surfaces of solids, on which gas of the cells exerts its pressure (surface_markers.c). Owned arrays; n
 * = 0: the interface is not sharp. */
typedef struct surface_markers {
    size_t n;
    surface_marker *now, *next;
    int *group;    /* velocity field of each */
    int *pin;      /* axis of the side of the mesh on which it stays; -1: none */
    double *force; /* N, two each: forces of the gas in the step */
    double *path;  /* m, two each: displacement over which these forces do work */
    cut_chain *chain;
    int *beside; /* of each chain: the fluid of the cells that it holds back, by its number in the scene */
    int n_chains;
} surface_markers;

/* Gas points that a surface in three dimensions encloses (enclosed_gas.c). */
typedef struct gas_enclosure {
    size_t n;        /* points of the surface; 0: none encloses gas */
    int body;        /* the surface's */
    int material;    /* the gas's, in the scene */
    double *force;   /* N, three each: forces of the mean pressure of the gas, by number of the points; owned */
    double *area;    /* m2: by number of the points; owned */
    double pressure; /* Pa: mean pressure of the gas less the reference pressure */
    double growth;   /* the enclosed volume over the volume of all gas points */
} gas_enclosure;

/* A node, by global index, that a support constrains. */
typedef struct support_node {
    int node[MESH_MAX_DIM], support;
} support_node;

struct mpm_work {
    kernel_set kernel;
    int window[MESH_MAX_DIM]; /* nodes of a tile's window along each axis */
    int window_nodes;
    int reach;                                                   /* nodes by which the window begins before its tile */
    int (*basis_1d)(double, double, double, double *, double *); /* weights of the basis along an axis */
    int body_group[SCENE_MAX_BODIES];                            /* group of a scene body, -1: none of ours */
    bool *active; /* per global tile: the current group has points there; owned */
    mpm_wetted *
        wetted; /* wetted surfaces of solids, where fluids have a velocity field of their own (wetted.h); owned, NULL: none */
    uint32_t *moved;       /* per global tile: bit of each body of which points have changed cell in the step; owned */
    double *cell_mass;     /* kg: of a fluid, per global cell; owned, NULL without cell densities */
    double *tile_sum;      /* per global tile, MPM_TILE_SUMS values; owned */
    double kick;           /* s: the time over which forces change velocities in the step */
    double reference_mass; /* kg: heaviest point, for the small-node rule (theory 4.4) */
    double acceleration[SCENE_MAX_BODIES][3]; /* m/s2: body forces now */
    double heat[SCENE_MAX_LOADS]; /* what each heating load adds this step: pressure (Pa) or energy per volume (J/m3) */
    surface_point *surface, *surface_next; /* owned */
    size_t n_surface;
    solid_batch *batch; /* one per thread; owned */
    spring_state spring[SCENE_MAX_SPRINGS];
    membrane_force membrane_force[SCENE_MAX_BODIES]; /* of our bodies */
    double
        lost; /* J: energy lost by points and nodes in the step, heat of a gas on cells; 0 where losses are not heat */
    surface_markers markers;
    gas_enclosure enclosure;
    support_node *support; /* owned */
    size_t n_supports;
    bool burnt;                /* P_MASS_LEFT is the mass of reacting points for the rest of the step */
    membrane_curve *curve;     /* one a body (membrane_curve.h); owned, NULL without membranes */
    membrane_normals *normals; /* one a body (membrane_normal.h); owned, NULL where all membranes are connected */
    mpm_edges *edges;          /* edge.h; owned, NULL where the deck asks for none */
    saved_points *saved;       /* point_substeps.c; owned, NULL until a step has substeps */
    int threads;
};

enum { MPM_TILE_SUMS = 64 };

/* Bit of the cell of a tile that holds point k. */
uint64_t cell_bit(const mesh *m, const tile_box *t, const point_arrays *p, size_t k);
/* Whether a point may reach a node where bodies in contact meet (contact_normal.c). */
bool contact_is_near(const mpm *s, const tile_box *t, const point_arrays *p, size_t k);
/* The cells of a tile in which fluid points meet solid ones; 0 where the tile has only one kind. */
uint64_t shared_cells(const mpm *s, int blk, int tile, const tile_box *t);
/* A tile of a block, as the kernels see it. */
tile_box tile_box_of(const mesh *m, const block *b, int tile_in_block);
/* Nodes that a tile owns along each axis: the last tile owns those of the upper wall; a periodic end is node 0
 * again. */
void tile_nodes(const mesh *m, const tile_box *t, int end[MESH_MAX_DIM]);
/* Arrays of a body's current state in a block; with `next_stress`, `next_velocity` these are of the next state. */
point_arrays points_of(const mpm *s, int blk, int body, bool next_stress, bool next_velocity);

/* Calls for every tile of every block, side by side. */
typedef void tile_visitor(mpm *s, int group, int blk, int tile);
void visit_tiles(mpm *s, int group, tile_visitor *visit);

/* Point-to-grid of one mode for a group: tile partials, then node fields in global tile order (tile.c). */
floe_status scatter_group(mpm *s, int group, scatter_mode mode, bool next_stress, bool next_velocity);
/* Node arrays that tiles' partials are summed into; a tile's partials hold the nodes of its window, interleaved. */
typedef struct node_target {
    double *array[MPM_MAX_RECORD]; /* NULL: padding */
    int components;                /* doubles of a record */
    int reach;                     /* nodes by which the window begins before its tile */
    int window[MESH_MAX_DIM];      /* nodes of it along each axis */
    bool largest;                  /* instead of the sum; -INFINITY where there is nothing */
} node_target;

/* Fields of a group, their components in order. */
node_target node_target_of(const mpm *s, int blk, int group, const field_id *id, int count);
/* Every node of a block and of one ghost layer becomes the sum of the partials of its active tiles, in global order. */
void gather_nodes(const mpm *s, int blk, const node_target *out);
/* Copies the window of a tile from node arrays: records of 1, 2, 4 or 8 components (tile.c). */
void load_window(const mpm *s, int blk, const tile_box *t, const double *const *node, int count, double *window);

/* Adds all nodal forces of a group but those of stress (loads, membranes, gas) to N_FORCE, and folds them at sides
 * (tile.c). */
void scatter_loads(mpm *s, int group);
/* Folds N_FORCE at periodic ends and sides. */
void fold_forces(mpm *s, int group);

/* Whether C_p is computed in the pass that moves the points, as the velocity gradient (points.c). */
bool carries_gradient(const mpm *s);
/* v_p becomes sum S v of a node field, in the next state (points.c). */
floe_status sample_velocities(mpm *s, field_id velocity);
/* v_i = momentum over mass, zero where there is no mass, on the nodes of every block (node.c). */
void divide_momenta(mpm *s, int group, field_id out);

/* Whether forces are scattered with the masses (mpm_step.c). */
bool forces_at_once(const mpm *s);

/* Sums of a pass over the points: energy (J) of heating loads, work of the reference pressure and of body forces, and
 * the impulse (N s) of the latter by component. */
enum {
    GAIN_HEAT,
    GAIN_REFERENCE,
    GAIN_BODY_FORCE,
    GAIN_IMPULSE,
    GAIN_MOMENT = GAIN_IMPULSE + MESH_MAX_DIM,
    MPM_GAINS = GAIN_MOMENT + 3
};

/* Strain, artificial viscosity, heating and the law, for points [start, end) whose L stands in the batch (stress.c). */
floe_status update_stress(mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch,
                          double gain[MPM_GAINS]);
/* Whether a body has artificial viscosity. */
bool has_artificial(const mpm_body *b);
/* Whether the domains of a body's points deform with F (CPDI; create.c). */
bool keeps_shape(const mpm *s, int body);
/* Whether the domains of a body's points grow with their volume (GIMP, fluids). */
bool keeps_box(const mpm *s, int body);
/* Whether F is stored, for the shape of domains or for the law. */
bool keeps_F(const mpm *s, int body);
/* The time (s) over which stress is advanced (stress.c). */
double strain_step(const mpm *s);
/* Fills a batch with the state that wave speeds of points [start, end) need (stress.c). */
void load_speed_batch(const mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch);
/* Fills a batch with the current state of points [start, end) (stress.c). */
void load_batch(const mpm *s, int blk, int body, size_t start, size_t end, bool next, solid_batch *batch);
/* Makes a batch the next state of its points, from `start` (stress.c). */
void store_batch(const mpm *s, int blk, int body, size_t start, const solid_batch *b);

/* Share of a node's velocity that remains after viscous damping, which is implicit, so that any rate is stable
 * (node.c). */
double damping_left(const mpm *s);
/* Volume (m3; a radian's about an axis) of the shape function of a global node inside the mesh, which sides fold for the group (node_volume.c). */
double node_volume(const mpm *s, int group, const int at[MESH_MAX_DIM]);
/* Threshold (kg): nodes with less mass take no forces. */
double small_node(const mpm *s);
/* Whether lost kinetic energy is to heat fluid points (heat.c). */
bool losses_are_heat(const mpm *s);
/* Whether each fluid point gets its own kinetic loss, and nothing else, as heat. */
bool fluids_keep_losses(const mpm *s);
/* Whether volumes of gas points are scaled to the free volume (settle.c). */
bool settles_volumes(const mpm *s);

/* Frees the saved start of a step with substeps (point_substeps.c). */
void free_saved_points(context *ctx, struct mpm_work *w);

/* Seeding (seed_fill.c): fluids fill small gaps beside other bodies; `list`: one a body. */
floe_status fill_cells(const mpm *s, seed_list *list);

/* Commits the masses that reactions have left of the points, before sorting; points without mass are dropped then
 * (burn.c). */
void burn_commit(mpm *s);

#endif

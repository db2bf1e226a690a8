/* Material points (theory 4; Sulsky, Chen, Schreyer 1994; York 1997): solids, and fluids carried by points.
 *
 * mpm_step.c spells out the points-only step; sim/coupled.c interleaves the same stages with those of the cells. Points
 * of a body in a block are sorted by tile, then cell, then id; a tile's points are contiguous. Stages write scratch and
 * next arrays only; mpm_commit makes the step final and restores the order. */
#ifndef MPM_MPM_H
#define MPM_MPM_H

#include "grid/ledger.h"
#include "grid/stage.h"
#include "mpm/basis/basis.h"
#include "mpm/transfer/transfer.h"
#include "scene/scene.h"

#include <stdint.h>

enum { MPM_MAX_GROUPS = 16 };
_Static_assert((int)FIELD_MAX_INSTANCES >= (int)SCENE_MAX_BODIES, "the points of every body of a scene have fields");

/* Points of one body. Instance b of the point fields is body b of this list. */
typedef struct mpm_body {
    int scene_body; /* index in scene.body */
    int scene_material;
    const solid_model *law;
    const void *law_par;
    unsigned depends_on;            /* solid_dependence: what the stress depends on beside strain */
    solid_fluid_par fluid_par;      /* law_par points here for fluids */
    double specific_heat;           /* J/kg/K, of solids */
    bool warms;                     /* its points carry a temperature (thermal/thermal.h) */
    double conductivity;            /* W/m/K, of one that warms; 0: it does not conduct */
    double plastic_heat;            /* share of plastic work that heats it */
    double expansion;               /* 1/K, of one that warms */
    double stress_free_temperature; /* K; NAN: that at the start */
    bool fluid;
    bool burns;                 /* a reaction uses it up */
    bool mean_strain;           /* its points share changes of volume and pressures (state/mean_strain.h) */
    int group;                  /* velocity field it moves in: instance of the node fields */
    double artificial[2];       /* A1, A2 */
    membrane_response membrane; /* model NULL: it is none */
} mpm_body;

/* What is on cells beside the points. CELLS_SMEARED: fluids, whose pressure acts on the points. CELLS_CUT: gas that
 * embedded boundaries cut: full steps of velocity, so that gas and points get the same impulse. */
typedef enum mpm_cells { CELLS_NONE, CELLS_SMEARED, CELLS_CUT } mpm_cells;

/* Points of one body in one block: a view on the block's fields. */
typedef struct mpm_points {
    size_t n;
    size_t *tile_start; /* block.n_tiles + 1 offsets, owned */
} mpm_points;

/* Gas on cells at rest beside the points, in load increments (implicit.h): one pressure, by `law` or prescribed. */
typedef struct mpm_gas {
    const eos *law;              /* not owned */
    double mass, volume, energy; /* kg, m3, J/kg: at the start of the increment */
    double prescribed_pressure;  /* Pa: prescribed by a load or an open side; NAN: by its law */
    double heat;                 /* J: of loads */
    bool open;                   /* its mass changes through open sides */
    double *
        unit_force; /* area vectors of its surface (m2, or m2 per radian), two numbers a marker; NULL: smeared interface */
    double mass_end, volume_end, energy_end; /* at the end of the increment */
    double pressure;
} mpm_gas;

typedef struct mpm {
    context *ctx;       /* not owned */
    const scene *scene; /* not owned */
    const mesh *mesh;   /* not owned */
    domain *domain;     /* not owned */
    stage_list *stages; /* not owned */
    ledger *ledger;     /* not owned */
    const basis_model *basis;
    const transfer_model *transfer;
    double share;   /* share of FLIP in the velocities of points, in this step */
    double fastest; /* 1/s: most cells that a point of the current state crosses in a second (mpm_time_step) */
    int order;      /* of the transfer's filter or sum */
    mpm_body body[SCENE_MAX_BODIES];
    int n_bodies, n_deforming;        /* those that do not deform stand after those that do (motion/motion.h) */
    int n_groups, n_deforming_groups; /* and so do their velocity fields */
    struct mpm_contact *contact;      /* owned; NULL: all bodies share one velocity field */
    struct mpm_overlaps *overlaps;    /* owned; NULL: no side releases bodies (wall_overlap.h) */
    mpm_cells cells;                  /* what is on cells beside the points */
    bool carries[FIELD_COUNT];        /* point fields that some body carries, if a stage names them (create.c) */
    int n_history;                    /* largest number of history variables of a law */
    mpm_points points[MESH_MAX_BLOCKS][SCENE_MAX_BODIES];
    int body_group[SCENE_MAX_BODIES];  /* group of a scene body, -1: none of ours */
    double reference_mass;             /* kg: heaviest point, for the small-node rule (theory 4.4) */
    double group_mass[MPM_MAX_GROUPS]; /* kg: heaviest point of each group */
    uint32_t *moved;        /* per global tile: bit of each body of which points have changed cell in the step; owned */
    double time;            /* s: at the start of the step */
    double dt, dt_previous; /* s; dt_previous 0 before the first step */
    bool forces_at_end;     /* fluids beside surfaces push as at the end of the step (theory 7.8) */
    double kick;            /* s: the time over which forces change velocities in the step */
    double acceleration[SCENE_MAX_BODIES][3]; /* m/s2: body forces now */
    double heat
        [SCENE_MAX_LOADS]; /* what each heating load adds this step: pressure (Pa), or the time (s) in which its power does */
    double
        lost; /* J: energy lost by points and nodes in the step, heat of a gas on cells; 0 where losses are not heat */
    bool burnt;                    /* P_MASS_LEFT is the mass of reacting points for the rest of the step */
    long step;                     /* committed steps so far, kept by the owner of the run */
    int n_substeps, substep;       /* substeps of the step, and how many of them are committed (point_substeps.c) */
    time_solver solver;            /* SOLVER_AUTO has been chosen by then */
    struct mpm_implicit *implicit; /* owned; NULL: steps are explicit; so are those of SOLVER_DYNAMIC (mpm_is_solved) */
    mpm_gas *gas;                  /* gases on cells in the increment; not owned */
    int n_gases;
    const int *gas_of; /* of every global cell: the gas in it, -1: almost none; not owned */
    /* What a part of the module keeps, known to that part alone. Owned; NULL where the scene has nothing of the kind. */
    struct mpm_windows *windows;      /* transfer/windows.h */
    struct mpm_scratch *scratch;      /* transfer/scratch.h */
    struct mpm_motions *motions;      /* motion/motion.h */
    struct mpm_supports *supports;    /* nodes/supports.h */
    struct mpm_edges *edges;          /* edge/edge.h */
    struct mpm_wetted *wetted;        /* fluid/wetted.h */
    double *cell_mass;                /* kg: of a fluid, per global cell (fluid/density.c) */
    struct spring_state *springs;     /* loads/spring.h */
    struct mpm_surfaces *surfaces;    /* surface/surfaces.h */
    struct membrane_curve *curve;     /* one a body (membrane/membrane_curve.h) */
    struct membrane_normals *normals; /* one a body (membrane/membrane_normal.h) */
    struct gas_enclosure *enclosure;  /* membrane/enclosed_gas.h */
    struct saved_points *saved;       /* point_substeps.c */
} mpm;

/* Whether steps are solved for: of statics, or implicit. */
static inline bool mpm_is_solved(const mpm *s)
{
    return s->implicit && s->solver != SOLVER_DYNAMIC;
}

/* Whether explicit steps have the stiffness of solids in their inertia (implicit/implicit_walls.h). */
static inline bool walls_are_stiff(const mpm *s)
{
    return s->implicit && s->solver == SOLVER_DYNAMIC;
}

/* Resolves the scene's bodies into *out: all of them in pure MPM, those of solids beside cells. Registers nothing. */
floe_status mpm_create(mpm **out, context *ctx, const scene *s, const mesh *m, stage_list *stages, ledger *l,
                       bool beside_cells);
void mpm_destroy(mpm **s);
/* Registers the fields that the planned stages use and allocates scratch. */
floe_status mpm_register(mpm *s, domain *d);
/* Seeds the points of every body (geom/seed), sorted into blocks and tiles. */
floe_status mpm_seed(mpm *s);

/* Stages (theory 4.1; contact: contact.h). */
floe_status mpm_enclosed_pressure(mpm *s); /* force of enclosed gas on its surface (enclosed_gas.c) */
floe_status mpm_find_free_points(mpm *s);  /* P_FREE_MASS (support_find.c) */
floe_status mpm_drive_points(mpm *s);      /* b_p of an exact solution (point_loads.c) */
floe_status mpm_points_to_nodes(mpm *s);   /* m_i, m_i v_i; and f_i when nothing else will change the stress */
floe_status mpm_contact_normals(mpm *s);   /* normals where bodies in contact meet */
floe_status mpm_contact_reach(mpm *s);     /* and how far their points reach */
floe_status mpm_side_reach(mpm *s);        /* how far points reach at sides that release bodies */
floe_status mpm_node_velocity(mpm *s);     /* v_i, walls, contact */
floe_status mpm_stress_first(mpm *s);      /* USF: stress from v_i^n */
floe_status mpm_node_force(mpm *s);        /* f_i = -sum V (sigma - p_p - q) grad S + external */
floe_status mpm_share_pressures(
    mpm *s); /* whether points share changes of volume, in nearly incompressible bodies (mean_strain.h) */
floe_status mpm_share_new_pressures(mpm *s); /* the same of the stress that the step has found (USF) */
floe_status mpm_find_stiffness(mpm *s); /* that of solids beside an implicit pressure (implicit/implicit_walls.h) */
floe_status mpm_find_wall_pressures(mpm *s); /* f_i of implicit wall pressures on light solids (surface/inertia.h) */
floe_status mpm_edge_force(mpm *s);          /* f_i of the penalty on edges of solids (edge.h) */
floe_status mpm_begin_motions(mpm *s);       /* rigid motions of the step (motion/motion.h) */
floe_status mpm_motion_momenta(mpm *s);      /* m_i v_i of their nodes */
floe_status mpm_take_impulses(mpm *s);       /* what fluids have given these nodes */
floe_status mpm_join_motions(mpm *s);        /* and contact; v_i^L of what sticks to them */
floe_status mpm_node_update(mpm *s);         /* v_i^L with damping and walls */
floe_status mpm_contact_velocity(mpm *s);    /* contact: v_i^L of bodies that meet */
floe_status mpm_node_acceleration(mpm *s);   /* a_i = (v_i^L - v_i) / kick, after whatever changed v_i^L */
floe_status mpm_grid_pressure(mpm *s);       /* coupled: p_p from the nodes */
floe_status mpm_filter_velocities(mpm *s);   /* XPIC: v_p without its null space on the mesh (filter.c) */
floe_status
mpm_restore_velocities(mpm *s);          /* affine FMPM: v^L plus the part that points would not return (restore.c) */
floe_status mpm_follow_overlaps(mpm *s); /* overlaps of bodies pressed against sides (wall_overlap.h) */
floe_status mpm_nodes_to_points(mpm *s); /* v_p, x_p; USL: L_p, F, stress; TPIC: C_p */
floe_status mpm_carry_moments(mpm *s);   /* APIC: C_p from the moments of v^L about the points */
floe_status mpm_cell_density(mpm *s);    /* rho_p of fluids from the masses of cells (density.c) */
floe_status mpm_stress_last(mpm *s);     /* USL with such densities: stress from v_i^L after all points have moved */
floe_status mpm_remap_stress(mpm *s);    /* MUSL: updated momenta to nodes, then L_p, F, stress */
floe_status
mpm_membrane_normals(mpm *s); /* normals of membranes without connectivity, from the positions of the points */
floe_status mpm_turn_membranes(mpm *s); /* tangents from the positions of the points, and the stress along them */

/* Mass that reactions take from solids: N_BURNT_SHARE gives the masses that remain, and the momentum and energy of the
 * burnt mass on the nodes (burn.c). */
floe_status mpm_burn(mpm *s);

/* Heat of solids (thermal/thermal.h). */
floe_status mpm_heat_to_nodes(mpm *s);    /* C_i, T_i */
floe_status mpm_conduct(mpm *s);          /* dT_i by conduction and by heat that sides give */
floe_status mpm_heat_to_points(mpm *s);   /* T_p, grad T_p */
floe_status mpm_give_heat(mpm *s);        /* lost kinetic energy as heat of fluid points (heat.c) */
floe_status mpm_wetted_area(mpm *s);      /* wetted area of fluid points at nodes (wetted.c) */
floe_status mpm_constrain_wetted(mpm *s); /* constrains normal velocities of fluids and walls to each other */
floe_status mpm_settle_volumes(mpm *s);   /* scales volumes of gas points to the free volume (settle.c) */
floe_status mpm_keep_losses(mpm *s);      /* lost kinetic energy as heat of the same fluid point (heat.c) */

/* Before the stages: the time over which velocities change in the step, body forces. */
floe_status mpm_begin_step(mpm *s);

/* The stages above in their order, in three groups between which the coupled step puts those of the cells: nodal
 * masses, forces, motion of nodes and points. */
floe_status mpm_mass_stages(mpm *s);
floe_status mpm_burn_stages(mpm *s); /* after masses and N_BURNT_SHARE are known; nothing where nothing burns */
/* Before a step beside sharp surfaces: the temperatures of nodes, where heat passes the surfaces (surface/boundary.h). */
floe_status mpm_surface_temperature_stages(mpm *s);
/* After forces: what conducts changes the temperatures of its nodes; nothing where nothing does. */
floe_status mpm_conduction_stages(mpm *s);
floe_status mpm_force_stages(mpm *s);
floe_status mpm_motion_stages(mpm *s);
/* The last group in two: motion of the nodes with contact and supports, and update of the points. */
floe_status mpm_node_stages(mpm *s);
floe_status mpm_point_stages(mpm *s);

/* Implicit steps instead of explicit ones (implicit.h): a load increment of statics, or a step of implicit dynamics. To
 * be called before the plan is made, of scenes without an obstacle. */
floe_status mpm_solve_steps(mpm *s, time_solver solver);
/* Walls that answer the implicit pressure of fluids on cells with their stiffness, so that the sound of solids bounds no step (implicit/implicit_walls.h): what
 * in the scene this does not support, or NULL; and the storage for it, before the plan is made. Errors: FLOE_NO_MEMORY. */
const char *mpm_stiff_obstacle(const mpm *s);
floe_status mpm_stiffen_walls(mpm *s);
/* Once the points are seeded: goes back to steps that their sound bounds where they stand at slip sides, whose springs are explicit, or are too many for the
 * matrix. *why: the reason, or NULL. Errors: FLOE_NO_MEMORY. */
floe_status mpm_settle_walls(mpm *s, const char **why);
/* What in the scene the implicit solver does not support, or NULL. */
const char *mpm_implicit_obstacle(const mpm *s, time_solver solver);
/* Largest ratio of bulk to shear modulus of the solids, 0 where there is none; *body becomes the scene's body that has
 * it, and is otherwise unchanged. */
double mpm_implicit_bulk_ratio(const mpm *s, int *body);
/* The largest ratio that steps are solved for with. */
double mpm_implicit_most_bulk_ratio(void);
/* Whether solids enclose a fluid body of the scene on all sides. */
bool mpm_body_is_enclosed(const mpm *s, int body);
floe_status mpm_implicit_masses(mpm *s);      /* m_i */
floe_status mpm_implicit_loads(mpm *s);       /* f_i of surfaces */
floe_status mpm_membrane_equilibrium(mpm *s); /* equilibrium of a membrane around gas: the next state of points */
floe_status mpm_implicit_solve(mpm *s);       /* the next state of points, in equilibrium */

/* The points-only step, a list of the above. */
floe_status mpm_step(mpm *s);

/* The same in equal substeps with constant forces of the gas. All substeps but the last are committed at once, so that
 * a step that fails after the first must be rolled back. With embedded boundaries in the gas of the cells only
 * (point_substeps.c). */
floe_status mpm_step_in_substeps(mpm *s);
/* Restores the state of the points at the start of the step. Does nothing where no substep is committed. */
void mpm_rollback_step(mpm *s);

/* Commits the step: swaps state (the caller calls fields_commit), sorts points that changed their cell, moves points
 * between blocks, and handles points outside the mesh (reflected at walls within round-off, otherwise deleted and
 * entered into the ledger). */
floe_status mpm_commit(mpm *s);

/* Sorts every block's points by tile, cell and id; after seeding or a restart. */
floe_status mpm_resort(mpm *s);

/* Largest stable step (4.6) from the current state. */
floe_status mpm_time_step(mpm *s, step_limit *out);

/* Totals of the current points, in tile order. */
typedef struct mpm_totals {
    double mass[SCENE_MAX_BODIES], kinetic[SCENE_MAX_BODIES], strain[SCENE_MAX_BODIES], internal[SCENE_MAX_BODIES],
        volume[SCENE_MAX_BODIES];
    double heat[SCENE_MAX_BODIES]; /* J: sum of m_p c T_p, of bodies with a temperature; part of `internal` */
    double momentum[SCENE_MAX_BODIES][3], momentum_scale[3];
    double springs;                     /* J: energy of springs */
    double moment[SCENE_MAX_BODIES][3]; /* kg m: sum of m_p x_p, which is the mass times the centre of mass */
} mpm_totals;
floe_status mpm_sum(mpm *s, mpm_totals *out);
/* Moment of momentum of a body about the origin (kg m2/s; in the plane z alone), including that of C_p; not in
 * axisymmetric scenes. `size`: sum of its points' sizes, about the middle of the mesh. */
void mpm_angular_momentum(mpm *s, int body, double out[3], double size[3]);
/* Force (N) and moment (N m, about its centre of mass or the point about which it turns) of others on a body that does not deform, in the
 * last step; body forces are none of theirs. False: the body deforms. */
bool mpm_motion_force(const mpm *s, int body, double force[3], double moment[3]);
/* Volume-weighted mean of a fluid body's pressure over points inside a region (all where region->model is NULL). */
floe_status mpm_mean_pressure(mpm *s, int material, const shape *region, double *pressure);

/* Positions (m, three each) of the *n corners of loaded surfaces, *stride numbers apart: state outside the fields. NULL:
 * there are none. Valid until the next step. */
double *mpm_surface(mpm *s, size_t *n, size_t *stride);
/* The same of the markers on surfaces of solids that cut cells: positions and velocities (m, m/s), six numbers each. */
double *mpm_surface_markers(mpm *s, size_t *n, size_t *stride);

/* gamma of the ghost penalty at edges of solids: from the deck, else that of the basis; 0: no penalty. */
double mpm_edge_penalty(const mpm *s);
/* History of the penalised lines at edges of solids (edge.h): *n numbers, state outside the fields. NULL: there are
 * none. Valid until the next step. */
double *mpm_edges_state(mpm *s, size_t *n);
/* The same of the overlaps of bodies pressed against sides (wall_overlap.h). */
double *mpm_overlaps_state(mpm *s, size_t *n);

/* Position (m) of the first or the last point of a membrane; NAN where it is lost. */
void mpm_membrane_end(const mpm *s, int body, bool last, double x[3]);

/* Area that a membrane encloses: a closed one, or one that ends on mirrors, in the plane or axisymmetric
 * (membrane_volume.c). */
typedef struct membrane_enclosure {
    double size;     /* m2; about an axis m3 per radian; of a surface in space m3 */
    double pressure; /* Pa: of all fluid points, their volumes times pressure over the size */
    double outside;  /* kg per metre of depth (per radian): of fluid points outside */
    double stress;   /* Pa: along the membrane, the mean by volume at rest; of a surface the mean of its two */
    double hoop;     /* Pa: the same around the axis; 0 in the plane */
} membrane_enclosure;
bool mpm_membrane_encloses(const mpm *s, int body);
void mpm_membrane_enclosure(mpm *s, int body, membrane_enclosure *out);

/* Volume (m3) inside a surface in three dimensions that encloses gas points (enclosed_gas.c); NAN where the body is
 * none. */
double mpm_enclosed_volume(mpm *s, int body);

/* Number of points of a body over all blocks, and of all bodies. */
size_t mpm_body_points(const mpm *s, int body);
size_t mpm_count(const mpm *s);

#endif

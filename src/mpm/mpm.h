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

enum { MPM_MAX_GROUPS = FIELD_MAX_INSTANCES };

/* Points of one body. Instance b of the point fields is body b of this list. */
typedef struct mpm_body {
    int scene_body; /* index in scene.body */
    int scene_material;
    const solid_model *law;
    const void *law_par;
    solid_fluid_par fluid_par; /* law_par points here for fluids */
    double specific_heat;      /* J/kg/K, of solids, for the cells' view */
    bool fluid;
    bool burns;                 /* a reaction uses it up */
    int group;                  /* velocity field it moves in: instance of the node fields */
    double artificial[2];       /* A1, A2 */
    membrane_response membrane; /* model NULL: it is none */
} mpm_body;

/* Points of one body in one block: a view on the block's fields. */
typedef struct mpm_points {
    size_t n;
    size_t *tile_start; /* block.n_tiles + 1 offsets, owned */
} mpm_points;

/* Gas of the cells at rest beside the points, as load increments have it (balance.h): one pressure, that of `law` or a
 * given one. */
typedef struct mpm_gas {
    const eos *law;                          /* not owned */
    double mass, volume, energy;             /* kg, m3, J/kg: at the start of the increment */
    double held;                             /* Pa: what a load or an open side holds it at; NAN: its own */
    double heat;                             /* J: of loads */
    bool open;                               /* mass comes and goes at sides */
    double *push;                            /* m2 (a radian's): of its surface, two numbers a marker; NULL: smeared */
    double mass_end, volume_end, energy_end; /* what it has come to */
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
    double share;       /* of FLIP in the velocities of points, in this step */
    bool blends_by_way; /* it goes by the cells that points cross (mpm_begin_step) */
    double fastest;     /* 1/s: most cells that a point of the current state crosses in a second (mpm_time_step) */
    int order;          /* of the transfer's filter or sum */
    mpm_body body[SCENE_MAX_BODIES];
    int n_bodies;
    int n_groups;
    struct mpm_contact *contact;   /* owned; NULL: no body has a velocity of its own */
    struct mpm_overlaps *overlaps; /* owned; NULL: no side lets go (wall_overlap.h) */
    bool coupled;                  /* cells hold the fluids: velocities at n, grid pressure on the points */
    bool seals;  /* a membrane or surfaces cut the gas of the cells: whole kicks, so that both get the same impulse */
    bool driven; /* the force of an exact solution acts on points (load.c) */
    bool holds;  /* a surface in space holds gas points (hold.c) */
    bool boxes;  /* some fluid's points keep boxes that swell (GIMP) */
    bool needs_F, has_energy, artificial; /* some body's law keeps F, energy, artificial pressure */
    bool cell_density;                    /* fluid points take theirs from the masses of cells */
    bool burns;                           /* some body does (burn.c) */
    int n_history;                        /* the most numbers that a body's law remembers */
    bool placed;                          /* some membrane has its strain from places */
    bool membranes, hoops;                /* some body is a membrane; it has strain around the axis */
    bool lines, sheets;                   /* some membrane lies along a curve; on a surface in space */
    bool free_normals;                    /* some membrane has normals without connections */
    mpm_points points[MESH_MAX_BLOCKS][SCENE_MAX_BODIES];
    double time;                 /* s: at the start of the step */
    double dt, dt_previous;      /* s; dt_previous 0 before the first step */
    long step;                   /* committed steps so far, kept by the owner of the run */
    int parts, part;             /* sub-steps that the step is taken in, and those of it that are final (parts.c) */
    struct mpm_work *work;       /* owned: tile partials, kernel table */
    time_solver solver;          /* SOLVER_AUTO has been chosen by then */
    struct mpm_balance *balance; /* owned; NULL: steps are explicit */
    mpm_gas *gas;                /* beside cells, of the increment; not owned */
    int n_gases;
    const int *gas_of; /* of every global cell: the gas in it, -1: next to none; not owned */
} mpm;

/* Resolves the scene's bodies into *out: all of them in pure MPM, those of solids beside cells. Registers nothing. */
floe_status mpm_create(mpm **out, context *ctx, const scene *s, const mesh *m, stage_list *stages, ledger *l,
                       bool beside_cells);
void mpm_destroy(mpm **s);
/* Registers the fields that the planned stages use and allocates scratch. */
floe_status mpm_register(mpm *s, domain *d);
/* Seeds the points of every body (geom/seed), sorted into blocks and tiles. */
floe_status mpm_seed(mpm *s);

/* Stages (theory 4.1; contact: contact.h). */
floe_status mpm_hold_gas(mpm *s);          /* what gas that a surface holds pushes it with (hold.c) */
floe_status mpm_drive_points(mpm *s);      /* b_p of an exact solution (load.c) */
floe_status mpm_points_to_nodes(mpm *s);   /* m_i, m_i v_i; and f_i when nothing else will change the stress */
floe_status mpm_contact_normals(mpm *s);   /* where bodies in contact meet */
floe_status mpm_contact_reach(mpm *s);     /* and how far they come */
floe_status mpm_side_reach(mpm *s);        /* how far points reach at sides that let go */
floe_status mpm_node_velocity(mpm *s);     /* v_i, walls, contact */
floe_status mpm_stress_first(mpm *s);      /* USF: stress from v_i^n */
floe_status mpm_node_force(mpm *s);        /* f_i = -sum V (sigma - p_p - q) grad S + external */
floe_status mpm_edge_force(mpm *s);        /* f_i of the penalty on edges of solids (edge.h) */
floe_status mpm_node_update(mpm *s);       /* v_i^L with damping and walls */
floe_status mpm_contact_velocity(mpm *s);  /* v_i^L of bodies in contact */
floe_status mpm_node_acceleration(mpm *s); /* a_i = (v_i^L - v_i) / kick, after whatever changed v_i^L */
floe_status mpm_grid_pressure(mpm *s);     /* coupled: p_p from the nodes */
floe_status mpm_filter_velocities(mpm *s); /* XPIC: v_p without what the mesh does not see (filter.c) */
floe_status
mpm_restore_velocities(mpm *s);           /* affine FMPM: v^L with what points would not give back of it (restore.c) */
floe_status mpm_follow_overlaps(mpm *s);  /* how far what presses has given way (wall_overlap.h) */
floe_status mpm_nodes_to_points(mpm *s);  /* v_p, x_p; USL: L_p, F, stress; TPIC: C_p */
floe_status mpm_carry_moments(mpm *s);    /* APIC: C_p from the moments of v^L about the points */
floe_status mpm_cell_density(mpm *s);     /* rho_p of fluids from the masses of cells (density.c) */
floe_status mpm_stress_last(mpm *s);      /* USL with such densities: stress from v_i^L once all points have moved */
floe_status mpm_remap_stress(mpm *s);     /* MUSL: updated momenta to nodes, then L_p, F, stress */
floe_status mpm_membrane_normals(mpm *s); /* normals of membranes without connections, from where the points are now */
floe_status mpm_turn_membranes(mpm *s);   /* tangents from where the points are now, and the stress along them */

/* What reactions take of solids: by N_BURNT_SHARE the masses that are left, and what goes with the rest, on the nodes
 * (burn.c). */
floe_status mpm_burn(mpm *s);

floe_status mpm_give_heat(mpm *s);      /* lost kinetic energy to fluid points (heat.c) */
floe_status mpm_wetted_area(mpm *s);    /* of fluid points at their nodes (wetted.c) */
floe_status mpm_hold_wetted(mpm *s);    /* normal velocities of fluids and walls */
floe_status mpm_settle_volumes(mpm *s); /* of gas points, to the room that there is (settle.c) */
floe_status mpm_keep_losses(mpm *s);    /* of each fluid point to itself (heat.c) */

/* Before the stages: the kick of the step, body forces. */
floe_status mpm_begin_step(mpm *s);

/* The stages above in their order, in the three runs between which the coupled step puts the cells: what the nodes
 * weigh, what pushes them, how the points follow. */
floe_status mpm_mass_stages(mpm *s);
floe_status mpm_burn_stages(mpm *s); /* after masses and N_BURNT_SHARE are known; nothing where nothing burns */
floe_status mpm_force_stages(mpm *s);
floe_status mpm_motion_stages(mpm *s);
/* The last in two: what contact and supports make of the nodes, and what the points make of that. */
floe_status mpm_node_stages(mpm *s);
floe_status mpm_point_stages(mpm *s);

/* Steps that are solved for instead of explicit ones (balance.h): a load increment of statics, or a step of implicit
 * dynamics. To be called before the plan is made, of scenes that can be solved for. */
floe_status mpm_solve_steps(mpm *s, time_solver solver);
/* What of the scene cannot be solved for, or NULL. */
const char *mpm_balance_obstacle(const mpm *s, time_solver solver);
/* Largest ratio of bulk to shear modulus of the solids, 0 where there is none; *body becomes the scene's body that has
 * it, and is left alone else. */
double mpm_balance_bulk(const mpm *s, int *body);
/* The largest ratio with which the basis balances loads without locking. */
double mpm_balance_most_bulk(const mpm *s);
/* Whether solids enclose a body of the scene, a fluid, all along its shape. */
bool mpm_body_is_enclosed(const mpm *s, int body);
floe_status mpm_balance_masses(mpm *s); /* m_i */
floe_status mpm_balance_loads(mpm *s);  /* f_i of surfaces */
floe_status mpm_rest_line(mpm *s);      /* of a membrane around gas: the next state of points, at rest */
floe_status mpm_balance_solve(mpm *s);  /* the next state of points, in balance */

/* The points-only step, a list of the above. */
floe_status mpm_step(mpm *s);

/* The same in `parts` equal sub-steps, under forces of the gas that stay as they are: all but the last are made final
 * at once, so that a step that goes bad after the first has to be forgotten. Beside lines that cut the gas of the cells
 * alone (parts.c). */
floe_status mpm_step_in_parts(mpm *s);
/* Puts the points back to where the step has begun. Does nothing where no part of it is final. */
void mpm_forget_step(mpm *s);

/* Makes the step final: swaps state (fields_commit is the caller's), re-sorts where points changed cell, moves points
 * between blocks, deals with points outside the mesh (reflected at walls within round-off, else deleted into the
 * ledger). */
floe_status mpm_commit(mpm *s);

/* Sorts every block's points by tile, cell and id; for whoever has put points there (seeding, restart). */
floe_status mpm_resort(mpm *s);

/* Largest stable step (4.6) from the current state. */
floe_status mpm_time_step(mpm *s, step_limit *out);

/* Totals of the current points, in tile order. */
typedef struct mpm_totals {
    double mass[SCENE_MAX_BODIES], kinetic[SCENE_MAX_BODIES], strain[SCENE_MAX_BODIES], internal[SCENE_MAX_BODIES],
        volume[SCENE_MAX_BODIES];
    double momentum[SCENE_MAX_BODIES][3], momentum_scale[3];
    double springs;                     /* J: energy of springs */
    double moment[SCENE_MAX_BODIES][3]; /* kg m: sum of m_p x_p, which is the mass times the centre of mass */
} mpm_totals;
floe_status mpm_sum(mpm *s, mpm_totals *out);
/* Moment of momentum of a body about the origin (kg m2/s; in the plane z alone), with what C_p carries; not about an axis. `size`: sum of
 * its points' sizes, about the middle of the mesh. */
void mpm_angular_momentum(mpm *s, int body, double out[3], double size[3]);
/* Volume-weighted mean of a fluid body's pressure over points inside a region (all where region->model is NULL). */
floe_status mpm_mean_pressure(mpm *s, int material, const shape *region, double *pressure);

/* Places (m, three each) of the *n loaded surface points, *stride numbers apart: state that no field holds. NULL: there
 * are none. Valid until the next step. */
double *mpm_surface(mpm *s, size_t *n, size_t *stride);
/* The same of the markers on surfaces of solids that cut the cells: places and velocities (m, m/s), six numbers
 * each. */
double *mpm_skin(mpm *s, size_t *n, size_t *stride);

/* gamma of the penalty on edges of solids: the deck's, else the basis's own; 0: they are not held. */
double mpm_edge_penalty(const mpm *s);
/* What the lines at the edges of solids remember (edge.h): *n numbers, state that no field holds. NULL: there are none.
 * Valid until the next step. */
double *mpm_edges_state(mpm *s, size_t *n);
/* The same of what bodies that press on sides have given way (wall_overlap.h). */
double *mpm_overlaps_state(mpm *s, size_t *n);

/* Place (m) of the first or the last point of a membrane; NAN where it is lost. */
void mpm_membrane_end(const mpm *s, int body, bool last, double x[3]);

/* The room inside a membrane that is closed, or that ends on mirrors, in the plane or about an axis (room.c). */
typedef struct membrane_room {
    double size;     /* m2; about an axis m3 per radian */
    double pressure; /* Pa: of all fluid points, their volumes times pressure over the size */
    double outside;  /* kg per metre of depth (per radian): of fluid points outside */
    double stress;   /* Pa: along the membrane, the mean by volume at rest */
    double hoop;     /* Pa: the same around the axis; 0 in the plane */
} membrane_room;
bool mpm_membrane_encloses(const mpm *s, int body);
void mpm_membrane_room(mpm *s, int body, membrane_room *out);

/* Room (m3) inside a surface in space that holds gas points (hold.c); NAN where the body is none. */
double mpm_held_room(mpm *s, int body);

/* Number of points of a body over all blocks, and of all bodies. */
size_t mpm_body_points(const mpm *s, int body);
size_t mpm_count(const mpm *s);

#endif

/* ICE: cell-centred, multi-material, compressible flow on the cells (theory 2; Guilkey et al. 2003; Kashiwa).
 *
 * ice_step.c spells out the fluid-only step; sim/coupled.c interleaves the same stages with those of the points.
 * All stages work on every block of the domain, write scratch and next arrays only, and return FLOE_RETRY (with the cell,
 * the material and the values in the message) where a smaller step may help. */
#ifndef ICE_ICE_H
#define ICE_ICE_H

#include "coupling/exchange.h"
#include "coupling/wall_response.h"
#include "embedded/cut.h"
#include "grid/ledger.h"
#include "grid/stage.h"
#include "scene/scene.h"

enum { ICE_MAX_MATERIALS = SCENE_MAX_MATERIALS };

/* A material on the cells. Instance r of the cell fields is material r of this list. */
typedef struct ice_material {
    int scene_material;     /* index in scene.material */
    eos eos;                /* of a solid: its bulk response (eos "bulk") */
    double shear_viscosity; /* Pa s */
    double bulk_viscosity;  /* Pa s */
    double conductivity;    /* W/m/K */
    double energy_floor;    /* J/kg where the law's floor is constant, else NAN */
    /* Carried by material points: not advected on cells; no viscous or gravity source and no heat of compression here. */
    bool points;
    bool prescribed; /* so are the motions of its bodies: nothing accelerates them (theory 4.17) */
    bool warms;      /* its points carry a temperature (theory 12.1) */
} ice_material;

/* Gases: one inside each membrane, and one outside all. Positions of a boundary in a step: at its start (CUT_NOW),
 * ICE_CUT_PREDICTED predicted ones of equal weight whose means are the apertures of the step (from CUT_MEAN on), and at
 * its end (CUT_NEXT). */
enum {
    ICE_CUT_REGIONS = SCENE_MAX_ENCLOSING + 1,
    ICE_CUT_PREDICTED = 4,
    CUT_NOW = 0,
    CUT_MEAN = 1,
    CUT_NEXT = CUT_MEAN + ICE_CUT_PREDICTED,
    CUT_PLACES = CUT_NEXT + 1
};

/* An embedded boundary: a membrane between gases, or the surfaces of solids (ice_cut.c). Set by the owner of the
 * step before the stages that read it. */
typedef struct ice_embedded_boundary {
    int enclosed;             /* material inside, a different one for each membrane; beside solids the only gas */
    int within;               /* the boundary of the membrane about this one; -1: none is. Found by ice_cut_nest */
    const cut_surface *place; /* CUT_PLACES: at the start, predicted, and at the end; not owned */
    const double *velocity;   /* m/s: of the vertices now, three each; not owned */
    const double *path; /* m: their displacement in the step, over which the force does work, three each; not owned */
    double *force;      /* N: of all gases on the vertices, three each; not owned */
    const double
        *temperature;  /* K: of the vertices now, NAN where they are insulated; not owned; NULL: no heat passes */
    double *heat_flow; /* W: that all fluids conduct into the vertices; not owned; NULL likewise */
    double heat;       /* J: heat of the enclosed gas, of the energy that points have lost in the step */
} ice_embedded_boundary;

/* All boundaries: a gas that none encloses is outside all, and what a membrane encloses is outside those inside it. */
typedef struct ice_embedded {
    ice_embedded_boundary boundary[SCENE_MAX_ENCLOSING];
    int n_boundaries;
} ice_embedded;

/* Materials that share cells, and there one pressure, one volume flux and the exchange between them: all materials, or those on one
 * side of embedded boundaries. Its fields of common quantities (C_PRESSURE and others) are instance `number`, those of its materials
 * instances first to first + n - 1. */
typedef struct ice_region {
    int number, first, n;
} ice_region;

typedef struct ice ice;

/* Geometry of cells that embedded boundaries cut, as far as whole cells and sides must know it (cut/ice_cut.c). */
typedef struct ice_cut_geometry {
    /* Share of a face on a side of the domain that is open to a region. local: cell of the block. */
    double (*side_aperture)(const ice *s, int region, const block *b, const int local[3], int axis, int side);
    /* Whether gravity on a cell is in the sums of merged cells. */
    bool (*is_merged)(const ice *s, int region, const block *b, int i, int j, int k);
    /* Bounds what several fluids give through the faces of merged cells. */
    void (*bound_outflow)(const ice *s, const ice_region *g);
    /* Weights (m3) of a region's cells after the step, block by block: in merged cells their sum, shared by open volume. */
    void (*spread_weights)(const ice *s, const ice_region *g, double *const *weight);
    /* Restores what a step that is rejected has changed in merged cells. */
    void (*rollback)(ice *s);
} ice_cut_geometry;

struct ice {
    context *ctx;       /* not owned */
    const scene *scene; /* not owned */
    const mesh *mesh;   /* not owned */
    domain *domain;     /* not owned */
    stage_list *stages; /* not owned */
    ledger *ledger;     /* not owned */
    ice_material material[ICE_MAX_MATERIALS];
    int n_materials;
    ice_region region[ICE_MAX_MATERIALS]; /* one, or with embedded boundaries that keep fluids apart one a fluid */
    int n_regions;
    const ice_cut_geometry *cut; /* NULL: all cells are whole */
    bool with_points;            /* some material is carried by points */
    bool heats_points;           /* heat exchange changes the temperature of some of them */
    bool heats_walls;            /* heat is conducted through embedded boundaries (theory 7.10) */
    bool implicit;               /* this step's pressure is implicit; kept by the owner of the run, and checkpointed */
    ice_embedded embedded;
    struct wall_response
        *walls; /* response of wall pressures to motion in the step; not owned; NULL: they are explicit (theory 7.6) */
    double gravity[3];       /* m/s2 */
    exchange_table exchange; /* K_rs and R_rs */
    double time, dt;         /* s: of the current step */
    long step;               /* committed steps so far, kept by the owner of the run (ramps counted in steps) */
    eos_bulk_par bulk[ICE_MAX_MATERIALS]; /* parameters of the solids' cell view */
    /* Storage of the parts of the solver, each known to its part alone; owned. NULL where the scene has no use for it. */
    struct ice_storage *storage;
    struct ice_side_table *sides;
    struct ice_closure *closure;
    struct ice_continued *continued;
    struct ice_pairs *pairs;
    struct ice_reactions *reactions;
    struct ice_heated *heated;
    struct ice_injection *injection;
    struct ice_cut_cells *cut_cells;
    struct ice_implicit *rows;
};

/* Whether some region has several materials: volume fractions, specific volumes, an equilibrium pressure, exchange. */
static inline bool ice_is_mixture(const ice *s)
{
    return s->region[0].n > 1;
}

/* Gravity of the scene's loads at t (s), for the step to come. */
void ice_set_gravity(ice *s, double t);
/* Resolves the scene's fluids (and, with solids as points, their cell view) into *out; registers nothing. */
floe_status ice_create(ice **out, context *ctx, const scene *s, const mesh *m, stage_list *stages, ledger *l,
                       bool with_points);
void ice_destroy(ice **s);
/* Registers the fields that the planned stages use (stages->uses) and allocates scratch. */
floe_status ice_register(ice *s, domain *d);
/* Sets cell states from the scene's bodies (exact volume fractions by geom) and the ambient, which fills the rest;
 * fluids fill at most what `taken` leaves (volume fraction of solids; per block, size of a cell array; NULL: none).
 * Under gravity the weight of what is above a cell is added to the pressure that it was given: columns of one given pressure
 * are at rest (theory 2.4). */
floe_status ice_initialise(ice *s, double *const *taken);

/* Rolls back the current step: restores the state where its stages have changed it (closure of cells of several fluids
 * along isentropes). Everything else that they have written is scratch or the next state. */
void ice_rollback_step(ice *s);
/* Volume fractions and temperatures of several fluids in the current state, for output: between steps the fields have
 * those of the start of the last step. The state does not change. */
floe_status ice_refresh(ice *s);

/* The stages, in the order of theory 5.1 (their names are the ones timed and listed). */
floe_status ice_boundary_ghosts(ice *s); /* ghosts of the state: blocks, periodic axes, boundary conditions (2.13) */
floe_status ice_equilibrium_pressure(ice *s); /* 2.1: p, theta, c, kappa, S; one fluid: p = eos(rho, e) */
floe_status ice_find_interfaces(ice *s);      /* 2.15: the cells at interfaces between fluids */
floe_status ice_continue_pressure(ice *s);    /* beside solids: p in cells that they fill (ice_continue.c) */
floe_status ice_diffusion_rates(ice *s);      /* viscosity and conduction (2.6): their rates at the start of the step */
floe_status ice_wall_fraction(ice *s);        /* for pairs that slip: the field whose gradient gives their normals */
floe_status ice_react(ice *s);                /* step 4 of G03: masses that react in the step */
floe_status ice_face_velocity(ice *s);        /* 2.2: u*, exchange at faces */
floe_status ice_pressure_increment(ice *s);   /* 2.3: dP, P, shock sensor; theta at faces */
floe_status ice_implicit_pressure(ice *s);    /* 3, instead of 2.3: also corrects u* */
floe_status ice_face_pressure(ice *s);        /* 2.4 */
/* 2.6, 2.7, 2.8, loads: Lagrangian mass, momentum, energy of the fluids; C_SOURCE of materials on points */
floe_status ice_sources(ice *s);
/* With materials carried by points, between ice_sources and ice_exchange C_MOMENTUM_L of these must be set from the nodes
 * (V rho^r u^L without C_SOURCE); ice_exchange adds C_SOURCE and leaves C_VELOCITY_CHANGE, the change by both. */
floe_status ice_mass_exchange(ice *s);   /* sources of mass, momentum and energy by reactions */
floe_status ice_exchange(ice *s);        /* 2.9: momentum and heat between materials, mixed cells */
floe_status ice_specific_volume(ice *s); /* 2.10, 5.5 */
floe_status ice_advect(ice *s);          /* 2.11: next state of the fluids */
floe_status ice_inject(ice *s);          /* 2.18, 2.19: sources of mass, vents */

/* The stages in four groups, between which the coupled step has those of the points; ice_step is all four. */
floe_status ice_state_stages(ice *s);    /* ghosts to reactions: the state of the cells */
floe_status ice_pressure_stages(ice *s); /* face velocities to sources */
floe_status ice_exchange_stages(ice *s); /* exchange, specific volume */
floe_status ice_advection_stages(ice *s);
/* With separated gases: before the points move, and after. */
floe_status ice_cut_pressure_stages(ice *s);
floe_status ice_cut_flow_stages(ice *s);
/* Their stages (ice_cut.c). Each applies the plain stages to one gas after the other. */
floe_status ice_cut_ghosts(ice *s);        /* extrapolates states into cells without the gas, for differences */
floe_status ice_cut_pressure(ice *s);      /* 2.1 */
floe_status ice_cut_wall_flow(ice *s);     /* 7.7 */
floe_status ice_cut_velocity(ice *s);      /* 2.2 */
floe_status ice_cut_increment(ice *s);     /* 2.3 */
floe_status ice_cut_face_pressure(ice *s); /* 2.4 */
floe_status ice_cut_load(ice *s);          /* forces on the boundaries */
floe_status ice_cut_wall_pressure(ice *s); /* applies the changes of wall pressure (ice_merged_pieces.c) */
floe_status ice_cut_guess(ice *s);         /* 7.8, instead of 2.3 and 2.4: before the walls have moved */
floe_status ice_cut_take(ice *s);          /* 7.8: the pressure found with them */
floe_status ice_cut_sources(ice *s);       /* 2.6, 2.8, with the work on the boundaries */
floe_status ice_cut_advect(ice *s);        /* 2.11, with the new open fractions */
/* The pressures on walls that they move by, with all cells (7.8): a wall_solver; fluids: the ice. */
floe_status ice_cut_solve(void *fluids, const wall_motion *motion, double *pressure);
/* Which membranes are inside which, from where they are (CUT_NOW). They stay so. */
void ice_cut_nest(ice *s);
/* FLOE_RETRY where boundaries cross each other at a position (CUT_NOW to CUT_NEXT); the message says where. */
floe_status ice_cut_check(const ice *s, int place);
/* Open fractions and states at the start, with the boundaries at their current positions. */
floe_status ice_cut_initialise(ice *s);
/* The fluid-only step. */
floe_status ice_step(ice *s);

/* Largest stable step (2.14) from the current state and the last pressures. */
floe_status ice_time_step(ice *s, step_limit *out);
/* The same with the explicit and with the implicit pressure, and the rate of sound, max c (sum h_i^-2)^1/2 (1/s). */
floe_status ice_time_steps(ice *s, step_limit *direct, step_limit *implicit, double *acoustic);
/* Smallest and largest density of any fluid (kg/m3), over the cells that contain it; INFINITY and 0 where none does. */
void ice_densities(ice *s, double range[2]);
/* Largest density of any fluid (kg/m3) over the cells that `among` marks (per block, size of a cell array) and in which
 * its volume fraction exceeds `share`; 0 where none does. */
double ice_densest(const ice *s, const unsigned char *const *among, double share);

/* Totals of the current state over owned cells of the fluids (not of materials carried by points), in tile order:
 * mass, momentum, internal and kinetic energy by material. */
typedef struct ice_totals {
    double mass[ICE_MAX_MATERIALS], internal[ICE_MAX_MATERIALS], kinetic[ICE_MAX_MATERIALS];
    double momentum[ICE_MAX_MATERIALS][3], momentum_scale[3]; /* scale: sum of |m u| */
    double moment[ICE_MAX_MATERIALS][3],
        moment_scale[3]; /* kg m2/s: of momentum about the origin; scale: sum of sizes about the middle */
} ice_totals;
floe_status ice_sum(ice *s, ice_totals *out);
/* J: what the fluids would give by expanding, or closing up, along their isentropes to a pressure outside. */
floe_status ice_stored_work(const ice *s, double outside, double *work);
/* The reaction (instance of C_REACTED) that consumes a material on points, or -1. */
int ice_burning_of(const ice *s, int material);
/* Marks the materials that bodies, the ambient and the sides bring to the cells; `used`: one for each of the scene. */
void ice_find_used(const scene *s, bool with_points, bool *used);
/* The cells' material of a scene material, or -1. */
int ice_material_of(const ice *s, int scene_material);
/* Mass (kg) of a gas in cells that are closed to it: a leak. */
double ice_mass_beyond(ice *s, int material);
/* Current pressure (Pa) of a cell, local index `at` of a block: by the law of `material` (in s->material) where it is
 * alone or separated by a boundary; of several fluids, their equilibrium; beside points, the last equilibrium
 * pressure. */
double ice_pressure_now(const ice *s, int block_id, int material, ptrdiff_t at);
/* Volume-weighted mean pressure of a fluid (index in s->material) over cells whose centre lies in a region (weights theta V). */
floe_status ice_mean_pressure(ice *s, int material, const shape *region, double *pressure);

#endif

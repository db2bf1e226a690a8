/* The scene: what a deck describes, as plain structs in SI units. Filled by deck (or by a test), read by sim.
 * Arrays have fixed limits that are far beyond use; everything a pointer leads to is owned by the scene. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include "base/context.h"
#include "base/param.h"
#include "expression/expression.h"
#include "geom/seed.h"
#include "geom/shape.h"
#include "geom/sheet_seeding.h"
#include "grid/bc.h"
#include "grid/mesh.h"
#include "material/eos.h"
#include "material/membrane.h"
#include "material/solid.h"
#include "scene/scene_motion.h"
#include "surface/surface.h"

enum {
    SCENE_MAX_MATERIALS = 12,
    SCENE_MAX_BODIES = 32,
    SCENE_MAX_LOADS = 16,
    SCENE_MAX_SOURCES = 16,
    SCENE_MAX_VENTS = 16,
    SCENE_MAX_PROBES = 32,
    SCENE_MAX_TRACERS = 32,
    SCENE_MAX_REACTIONS = 8,
    SCENE_MAX_EXCHANGES = 66, /* all pairs of materials */
    SCENE_MAX_SPRINGS = 64,
    SCENE_MAX_SUPPORTS = 16,
    SCENE_MAX_ENCLOSING = 8, /* membranes that enclose gas on cells */
    SCENE_MAX_SUBSTEPS = 128,
    SCENE_MAX_METRICS = 24,
    SCENE_MAX_COLUMNS = 12,
    SCENE_MAX_PARTS = 32, /* of sides */
    SCENE_MAX_CONSTANTS = 64,
    SCENE_MAX_TABLES = 16,
    SCENE_MAX_FORMULAS = 128,
    SCENE_MAX_CONTACT = 15, /* bodies in contact: each has a velocity field of its own */
    SCENE_NAME = 64
};

typedef enum scene_coupling { COUPLING_MPM, COUPLING_ICE, COUPLING_ICE_MPM, COUPLING_COUNT } scene_coupling;
const char *coupling_name(scene_coupling coupling); /* "mpm", "ice", "ice-mpm" */

typedef enum material_kind { MATERIAL_SOLID, MATERIAL_FLUID } material_kind;

/* Physics only, never a representation (docs/structure.md, Modules and layers). */
typedef struct scene_material {
    char name[SCENE_NAME];
    material_kind kind;
    double density;         /* kg/m3 of a solid at rest; unused for fluids */
    double specific_heat;   /* J/kg/K of a solid; NAN: not given */
    double tension_switch;  /* Pa > 0: a solid's eos switches to its tension branch below this (theory 5.4) */
    const solid_model *law; /* solids; NULL for fluids and membranes */
    void *law_par;
    const membrane_model *membrane; /* solids that are membranes or strings; else NULL */
    void *membrane_par;
    bool one_way;           /* membranes: wrinkle instead of bearing compression */
    eos eos;                /* fluids; model NULL for solids */
    double shear_viscosity; /* Pa s */
    double bulk_viscosity;  /* Pa s */
    double conductivity;    /* W/m/K; 0: none */
    double plastic_heat;    /* share of a solid's plastic work that heats it; NAN: not given (scene/solid_heat.h) */
    double expansion;       /* 1/K: linear thermal expansion of a solid; 0: none */
    double
        stress_free_temperature; /* K: at which a solid that expands has no thermal strain; NAN: that of each point at the start */
    double artificial_linear;    /* A1 of Wilkins' artificial viscosity, 0 switches it off (Y00 eq. 24) */
    double artificial_quadratic; /* A2 */
} scene_material;

/* Quantities of an initial state. */
typedef enum initial_quantity {
    INITIAL_DENSITY,
    INITIAL_PRESSURE,
    INITIAL_VELOCITY, /* by axis */
    INITIAL_STRESS    /* by component, xx yy zz xy yz zx */
} initial_quantity;

/* The exact solution at t = 0, if the scene names one: a quantity at a position; NAN where it does not define it. */
typedef double initial_function(void *user, initial_quantity quantity, int component, const double x[3]);

/* What the exact solution needs at x and t beside the laws of the scene: force per mass (m/s2); returns heat per volume (W/m3). */
typedef double source_function(void *user, const double x[3], double t, double force[3]);

/* How a membrane's strain along its curve is found: from the gradient of velocity at each point, or from the positions
 * of its neighbours. */
typedef enum membrane_strain { STRAIN_BY_RATE, STRAIN_BY_POSITIONS } membrane_strain;

/* One layer of points along a curve (York 1997, chapter 5), counted from 1 along it, or on a surface in space. */
typedef struct scene_membrane {
    bool present;          /* the body is one */
    sheet_surface surface; /* in place of a curve: 3-D */
    curve_line curve;
    double thickness; /* m in 2-D and when axisymmetric; 1-D: share of the section; 3-D: m2, of a surface m */
    int number;       /* points; 0: by the points a cell */
    double length;    /* m, of CURVE_POINTS: shared alike; NAN: by the distances */
    const surface_method *normals; /* NULL: along the connections of the points */
    void *normals_par;
    membrane_section section;
    membrane_strain strain;
    double
        smoothing; /* share of the fourth difference of positions that a step removes, 0 to 1/16; only with strain by positions */
    double slack;             /* strain that must be taken up before there is tension; < 0: taut at the start */
    int slack_from, slack_to; /* points that have it; 0: the first, the last */
    int heavy_point;          /* 0: none */
    double heavy_mass;        /* kg, of the whole scene */
    int encloses;             /* material of the gas on its left, which it encloses; -1: none */
} scene_membrane;

typedef struct scene_body {
    char name[SCENE_NAME];
    int material; /* index of scene.material */
    shape shape;  /* model NULL: membranes */
    scene_membrane membrane;
    double velocity[3]; /* m/s */
    scene_motion motion;
    double pressure;         /* Pa absolute; fluids */
    double temperature;      /* K */
    double density;          /* kg/m3; fluids: NAN when given by pressure and temperature, else temperature is NAN */
    double fraction;         /* fluids in cells: share of its shape's volume that it takes; 0: all of it */
    double stress[6];        /* Pa: of a solid at the start, beside the reference pressure (xx yy zz xy yz zx) */
    bool initial_from_exact; /* density, velocity, pressure or stress come from verify.exact at t = 0 */
    int per_cell[3];         /* points along each axis of a cell */
    seed_method seeding;
    double merge;
    bool yields; /* other bodies replace it where they overlap (layout.h) */
} scene_body;

/* An end of a spring: a point of a body, a place of it, or a fixed position. */
typedef struct scene_spring_end {
    int body;        /* -1: a fixed position */
    int point;       /* of the body, counted from 1 in the order of seeding; 0: its place at the start */
    double place[3]; /* m */
} scene_spring_end;

/* A spring without mass. */
typedef struct scene_spring {
    char name[SCENE_NAME];
    scene_spring_end end[2];
    double stiffness;   /* N/m, of the whole scene */
    double damping;     /* N s/m, of the whole scene */
    double rest_length; /* m; NAN: as it is at the start */
    bool one_way;       /* a tether: it has no compression */
} scene_spring;

/* Nodes whose velocity is given. */
typedef struct scene_support {
    char name[SCENE_NAME];
    shape region;
    double velocity[3]; /* m/s */
} scene_support;

typedef enum load_kind {
    LOAD_PRESSURISE, /* energy into a fluid inside a region until its pressure reaches target; follows a linear ramp */
    LOAD_HEAT,       /* energy into a fluid inside a region at a given power density, W/m3 */
    LOAD_TRACTION,  /* pressure (compression positive), a vector or both on the surface of a shape that bounds a body */
    LOAD_BODY_FORCE /* m/s2 on a body, or on everything; in a region */
} load_kind;

typedef struct scene_load {
    char name[SCENE_NAME];
    load_kind kind;
    int material; /* LOAD_PRESSURISE, LOAD_HEAT: which fluid */
    int body;     /* LOAD_TRACTION, LOAD_BODY_FORCE: which body; -1 all */
    bool gravity; /* LOAD_BODY_FORCE: the deck calls it so */
    /* Heat, body force: where; traction: the surface of this shape is loaded (the body lies outside it or inside it). */
    shape region;
    double start; /* s */
    double ramp;  /* s; 0 with ramp_steps > 0 means that many steps */
    long ramp_steps;
    bool hold;        /* the target is kept after the ramp, until the end */
    double target;    /* Pa (pressurise: gauge to reference_pressure; traction), W/m3 (heat) */
    double vector[3]; /* m/s2; LOAD_TRACTION: Pa, force on the body per area at rest */
    bool dead;        /* LOAD_TRACTION: the pressure acts on areas at rest, and does not turn with the surface */
} scene_load;

/* Mass of a fluid that comes into the cells (theory 2.18). */
typedef struct scene_mass_source {
    char name[SCENE_NAME];
    int material;       /* index of scene.material */
    int inside;         /* body whose membrane encloses that fluid, where the deck names it; -1: none */
    shape region;       /* model NULL: everywhere */
    double mass_rate;   /* kg/s, of the whole scene */
    double temperature; /* K */
    double velocity[3]; /* m/s */
    double start, end;  /* s; end may be INFINITY */
} scene_mass_source;

/* The fluid on one side of a vent. */
typedef struct scene_vent_side {
    int material; /* index of scene.material */
    shape region; /* whose state drives the flow; model NULL: everywhere */
} scene_vent_side;

/* An orifice between two fluids of the cells, or between one and surroundings that do not change (theory 2.19). */
typedef struct scene_vent {
    char name[SCENE_NAME];
    scene_vent_side side[2]; /* from, to; the second has no meaning where it leads outside */
    bool to_fluid, to_outside;
    double outside_pressure, outside_temperature; /* Pa, K */
    double area;                                  /* m2, of the whole scene */
    double discharge;                             /* coefficient of discharge */
    bool one_way;                                 /* nothing comes back */
    double start, end;                            /* s; end may be INFINITY */
} scene_vent;

struct exchange_model; /* coupling/exchange_law.h */

/* A law of exchange with its parameters; model NULL: none is given. */
typedef struct scene_exchange_law {
    const struct exchange_model *model;
    void *par;
} scene_exchange_law;

/* Exchange between two materials. */
typedef struct scene_exchange {
    char name[SCENE_NAME];
    int material[2];               /* indices of scene.material */
    scene_exchange_law momentum;   /* none: method.exchange */
    scene_exchange_law tangential; /* across the gradient of the volume fraction; none: as momentum */
    scene_exchange_law heat;       /* none: method.heat_exchange */
} scene_exchange;

struct reaction_model; /* coupling/reaction.h */

/* Mass of one fluid that becomes another in the cells. */
typedef struct scene_reaction {
    char name[SCENE_NAME];
    int reactant, product;              /* indices of scene.material */
    const struct reaction_model *model; /* of the rate */
    void *par;
    double heat; /* J per kg */
} scene_reaction;

typedef enum stress_scheme { STRESS_USL, STRESS_USF, STRESS_MUSL } stress_scheme;
typedef enum point_density { DENSITY_CONTINUITY, DENSITY_CELL, DENSITY_QUADRATIC } point_density;
/* Use of the kinetic energy that points lose to their nodes (mpm/fluid/heat.c). */
typedef enum point_losses { LOSSES_DRIFT, LOSSES_HEAT, LOSSES_OWN } point_losses;
typedef enum ice_centring { ICE_CENTRING_AUTO, ICE_CENTRING_HALF, ICE_CENTRING_FULL } ice_centring;
typedef enum pressure_scheme { PRESSURE_EXPLICIT, PRESSURE_IMPLICIT, PRESSURE_AUTO } pressure_scheme;
/* How gas on cells acts on a solid: over the cells that both share, or on the surface of the solid (theory, sharp
 * interface). */
typedef enum solid_interface { INTERFACE_SMEARED, INTERFACE_SHARP, INTERFACE_AUTO } solid_interface;
typedef enum ice_limiter {
    ICE_LIMITER_DEFAULT, /* faces are traced where they can be (theory 2.17); others van Leer's */
    ICE_LIMITER_VAN_LEER,
    ICE_LIMITER_NONE,
    ICE_LIMITER_FIRST_ORDER
} ice_limiter;

typedef struct scene_method {
    char basis[SCENE_NAME]; /* linear, gimp, quadratic, cubic, cpdi: basis_registry */
    double domain_limit; /* cells: of basis cpdi, how far a domain may reach from its point along an axis; 0.25 to 1 */
    stress_scheme stress;
    char transfer[SCENE_NAME]; /* of transfer_registry; "": as the scene asks (scene_transfer) */
    double
        flip; /* of transfer flip: 1 FLIP, 0 PIC; 0 to 1; NAN: 0.99, with fluids on points 1 less 0.6 for each cell that
                                * the fastest point crosses in the step, where that is more */
    int filter_order;      /* of transfers xpic and afmpm, 2 to 20; 0: theirs */
    point_density density; /* of fluid points (mpm/fluid/density.c) */
    point_losses losses;
    double edge_penalty; /* gamma of the penalty on edges of solids (mpm/edge/edge.h); 0: none; NAN: the basis's own */
    ice_centring centring; /* phi of theory 2.5: auto is 1/2 smooth, 1 at shocks */
    bool conserve_energy;  /* theory 2.8 */
    ice_limiter limiter;
    double
        exchange; /* K, kg/(m3 s), between all pairs; 0 to 1e20; INFINITY: locked, one velocity; NAN: locked, liquids slip */
    double heat_exchange;      /* R, W/(m3 K) */
    double volume_relaxation;  /* beta of theory 5.5 */
    solid_interface interface; /* between solids on points and gas on cells */
    pressure_scheme pressure;  /* of ICE: theory 2.3 or 3, or whichever costs less */
    double pressure_tolerance; /* of the implicit pressure: largest error of a cell's volume, as a fraction of it */
} scene_method;

typedef enum contact_kind {
    CONTACT_STICK,   /* one velocity wherever bodies meet: the no-slip contact that is inherent in one field */
    CONTACT_RELEASE, /* the same while they approach, separate velocities while they separate (Y97 A.1) */
    CONTACT_FRICTION /* unilateral along the normal, Coulomb friction across it (Bardenhagen et al. 2000) */
} contact_kind;

/* When two bodies at a node approach (Y97 eqs 9.7 to 9.9). */
typedef enum contact_criterion { CONTACT_PAIR, CONTACT_MEAN, CONTACT_BOTH } contact_criterion;

/* Where two bodies can touch: only where their points have met, or at any node that both reach. */
typedef enum contact_touch { CONTACT_AT_POINTS, CONTACT_AT_NODES } contact_touch;

typedef struct scene_contact {
    bool enabled;
    int body[SCENE_MAX_CONTACT]; /* the bodies in contact with each other */
    int n_bodies;                /* 0: all solid bodies */
    contact_kind kind;
    contact_criterion criterion;
    contact_touch touch;
    double friction;          /* coefficient; CONTACT_FRICTION */
    char normals[SCENE_NAME]; /* colour, mass: normal_registry */
} scene_contact;

/* How the solids get from one time to the next. */
typedef enum time_solver {
    SOLVER_DYNAMIC,  /* explicit steps */
    SOLVER_STATIC,   /* load increments, each in equilibrium */
    SOLVER_IMPLICIT, /* implicit time steps, in equilibrium with inertia, which the speed of sound does not limit */
    SOLVER_AUTO      /* static where the deck asks for a state of rest and static steps support all of the scene */
} time_solver;

enum { SCENE_SUBSTEPS_OPEN = -1 };

typedef struct scene_time {
    double end; /* s */
    time_solver solver;
    long increments;  /* equal parts of the run: of the load where the solver is static, steps where it is implicit */
    double tolerance; /* residual over external forces at which implicit steps have converged */
    double cfl_mpm, cfl_ice; /* fractions of the limits of theory 4.6 and 2.14 */
    double acoustic_cfl;     /* implicit pressure: largest c dt (sum h_i^-2)^1/2 */
    double first_step;       /* s, NAN: from the CFL limit */
    double max_step;         /* s, NAN: none */
    double growth;           /* largest ratio of a step to the one before */
    long max_steps;          /* 0: no limit */
    double fixed_step;       /* s, NAN: adaptive */
    /* Of the points in a step of the cells; 0: as many as their stable steps ask for; open: the deck does not say. */
    long substeps;
} scene_time;

typedef struct scene_damping {
    double rate;       /* 1/s: force -rate m v on the points' nodes */
    double start, end; /* s; end may be INFINITY */
} scene_damping;

typedef struct scene_rest {
    bool enabled;
    double ratio;  /* kinetic energy over strain energy of the solids */
    double window; /* s: must stay below throughout this time; NAN: sim_rest_window */
    double after;  /* s: not before (the end of the ramp) */
} scene_rest;

typedef struct scene_probe {
    char name[SCENE_NAME];
    double position[3]; /* m */
} scene_probe;

/* A place of a body of points that the history follows as the body moves. */
typedef struct scene_tracer {
    char name[SCENE_NAME];
    int body;           /* of the scene */
    double position[3]; /* m, at the start */
} scene_tracer;

typedef struct scene_output {
    double interval;            /* s between field snapshots; INFINITY: first and last only */
    double history_interval;    /* s between history rows; NAN: interval / 50 */
    double checkpoint_interval; /* s of wall time; NAN: by their cost; INFINITY: none during the run */
} scene_output;

/* A column of history.csv, and the quantity of verify.reference that it is compared with. */
typedef struct scene_column {
    char quantity[SCENE_NAME], name[2 * SCENE_NAME];
} scene_column;

typedef struct scene_verify {
    char exact[SCENE_NAME];     /* "" : none. Name in exact_registry */
    void *exact_par;            /* its parameters */
    bool sources;               /* force and heat that the exact solution needs act on its solids or fluids */
    char reference[SCENE_NAME]; /* of histories, "": none. Name in reference_registry */
    void *reference_par;        /* its parameters */
    scene_column column[SCENE_MAX_COLUMNS];
    int n_columns;
    char metric[SCENE_MAX_METRICS][SCENE_NAME];
    int n_metrics;
    int body;              /* whose points are measured; -1: all points or cells of `material` */
    int material;          /* which cells are measured; -1: the first fluid */
    shape region;          /* model NULL: everywhere */
    double probe_pressure; /* Pa: pressure P of eq. 13 and of the gas error, NAN if unused */
} scene_verify;

/* Part of a side of the domain with a condition of its own. */
typedef struct scene_side_part {
    char name[SCENE_NAME];
    int axis, end; /* of the side; end: mesh_side */
    shape where;   /* asked at the middle of each face of the side */
    bc_side condition;
} scene_side_part;

/* A number of the scene that a formula gives (scene/formula.h). */
typedef struct scene_formula {
    size_t number; /* bytes from the start of the scene to it */
    expression *formula;
    bool owned; /* false: it is that of another number */
    param_range range;
    double lo, hi;           /* of PARAM_BETWEEN */
    const char *const *path; /* its key */
} scene_formula;

/* A function of one number for formulas, by its entries. */
typedef struct scene_table {
    char name[SCENE_NAME];
    char from[SCENE_NAME], to[SCENE_NAME]; /* columns of the file; "": the first, the second */
    const char *path;                      /* of the file; NULL: the entries are in the deck */
    double *at, *value;                    /* n */
    size_t n;
    value_table_between between;
    value_table_beyond beyond;
    value_table *curve;
} scene_table;

typedef struct scene_key scene_key; /* scene/deck_location.h */

typedef struct scene {
    context *ctx;   /* not owned */
    scene_key *key; /* lines and columns of its keys, those of a map after it; n_keys */
    int n_keys;
    char title[256], source[256], path[512];
    mesh_spec mesh;
    /* Of the lattices that bodies are seeded on, against the mesh; in point spacings, -0.5 to 0.5. */
    double lattice_offset[3];
    double thickness;                                  /* m, of 2-D scenes in outputs */
    stress_state stress_state;                         /* of points */
    bool dimensionless;                                /* units: none */
    expression_constant constant[SCENE_MAX_CONSTANTS]; /* of formulas */
    int n_constants;
    scene_table table[SCENE_MAX_TABLES];
    int n_tables;
    scene_formula formula[SCENE_MAX_FORMULAS];
    int n_formulas;
    double reference_pressure; /* Pa */
    scene_coupling coupling;
    scene_coupling runs_as[COUPLING_COUNT];
    int n_runs_as;
    bc_table bc;
    scene_side_part part[SCENE_MAX_PARTS]; /* of sides; earlier ones go before later ones */
    int n_parts;
    bool has_ambient;
    int ambient_material;
    double ambient_pressure, ambient_temperature;
    double ambient_velocity[3]; /* m/s */
    int ambient_points;         /* along each axis of a cell, as mpm; 0: it is left out */
    scene_material material[SCENE_MAX_MATERIALS];
    int n_materials;
    scene_body body[SCENE_MAX_BODIES];
    int n_bodies;
    scene_load load[SCENE_MAX_LOADS];
    int n_loads;
    scene_mass_source mass_source[SCENE_MAX_SOURCES];
    int n_mass_sources;
    scene_vent vent[SCENE_MAX_VENTS];
    int n_vents;
    scene_exchange exchange[SCENE_MAX_EXCHANGES];
    int n_exchanges;
    scene_reaction reaction[SCENE_MAX_REACTIONS];
    int n_reactions;
    scene_spring spring[SCENE_MAX_SPRINGS];
    int n_springs;
    scene_support support[SCENE_MAX_SUPPORTS];
    int n_supports;
    scene_contact contact;
    scene_method method;
    bool
        fluids_share; /* beside a sharp interface several fluids share cells, as nothing keeps them apart (sim/interface.h) */
    char interface_reason[400]; /* what method.interface auto has become and why (sim/interface.h); "": the deck says */
    scene_time time;
    scene_damping damping;
    scene_rest rest;
    scene_output output;
    scene_probe probe[SCENE_MAX_PROBES];
    int n_probes;
    scene_tracer tracer[SCENE_MAX_TRACERS];
    int n_tracers;
    scene_verify verify;
    struct scene_batches
        *batches;              /* of compare, study and stability (scene/batches.h); no run reads them. NULL: none */
    initial_function *initial; /* set by the run when a body asks for it */
    void *initial_user;
    /* Of fluids on the cells; set by the run when verify.sources asks for it; NULL: none. Its user: initial_user. */
    source_function *driving;
    source_function *driving_solids; /* the same of solids on points, asked at the place where a point was at rest */
    int threads;                     /* 0: OpenMP's default */
} scene;

/* A scene with every default of the schema set and no materials or bodies. The caller owns it. */
floe_status scene_create(scene **out, context *ctx);
/* Frees the scene and everything its pointers lead to. */
void scene_destroy(scene **s);
/* What follows a time in a message: " s", or nothing where the scene has no units. */
const char *scene_time_unit(const scene *s);
/* The first body whose membrane encloses gas on cells, or -1. */
int scene_enclosing_body(const scene *s);
/* The name of the transfer of points: the deck's, else what suits the bodies and the coupling best (docs/defaults.md). */
const char *scene_transfer(const scene *s);
/* Whether an implicit pressure bends solids, in steps that their sound does not bound (theory 7.9). */
bool scene_bends_walls(const scene *s);
/* The largest pressure (Pa, absolute) that the deck gives a fluid on points; 0: there is none. */
double scene_gas_pressure(const scene *s);
/* The largest (Pa, absolute) that it gives a body of a fluid. */
double scene_body_pressure(const scene *s, const scene_body *b);
/* Whether the basis is one with which gas of points beside softer walls is right: with others its points stream along the wall. */
bool scene_wall_bases(const scene *s);
/* Whether fluids on points have a velocity of their own beside solids (mpm/fluid/wetted.h). */
bool scene_fluids_apart(const scene *s);
/* All of them, up to SCENE_MAX_ENCLOSING, in their order; returns how many. */
int scene_enclosing_bodies(const scene *s, int body[SCENE_MAX_ENCLOSING]);
/* Whether ice-mpm has embedded boundaries: a membrane that encloses gas, or surfaces of solids (interface sharp). */
bool scene_is_cut(const scene *s);
/* Whether a body takes part in the scene's contact. */
bool scene_in_contact(const scene *s, int body);
/* Whether supports move beside an implicit pressure: they lead no nodes then (theory 4.13). */
bool scene_drives_beside_implicit(const scene *s);
/* Sets what no result of a single run depends on to one value: title, threads, and what only batches read. For telling scenes apart
 * by their decks. */
void scene_keep_run(scene *s);
/* Storage that lives as long as the scene (parameter structs). */
floe_status scene_allocate(scene *s, void *out, size_t size);

#endif

/* Shared by the files of the ice module: the scratch of a run, the view of a block that kernels take, and the table of
 * kernels. */
#ifndef ICE_ICE_INTERNAL_H
#define ICE_ICE_INTERNAL_H

#include "coupling/equilibrium.h"
#include "coupling/reaction.h"
#include "ice/ice.h"
#include "ice/ice_constants.h"

#include <float.h>
#include <math.h>

/* Instance of the shared fields that stages work on: the current gas where boundaries separate gases. */
static inline int ice_instance(const ice *s)
{
    return s->sealed && s->gas >= 0 ? s->gas : 0;
}

/* Whether contact discontinuities of a single fluid are sharpened (C_CONTACT). */
static inline bool ice_sharpens(const ice *s)
{
    return !s->multi && !s->sealed && s->scene->method.limiter == ICE_LIMITER_DEFAULT;
}

/* These do not treat NaN as fmin does, so that they vectorise. */
FLOE_ALWAYS_INLINE double least(double a, double b)
{
    return a < b ? a : b;
}

FLOE_ALWAYS_INLINE double most(double a, double b)
{
    return a > b ? a : b;
}

/* Cells [first, end) of a row, local i; none where end <= first. */
typedef struct ice_span {
    int first, end;
} ice_span;

/* A material's arrays in one block; NULL where the plan has no such field. Face arrays hold one axis each. */
typedef struct ice_arrays {
    double *rho, *u[3], *e, *vol; /* current state; vol: incoming v */
    double *open, *open1;         /* open fraction of the cell, now and next; NULL: 1 */
    double *v;                    /* equilibrated v of this step (lies in the next array of C_VOL) */
    double *T, *theta, *c, *kappa;
    double *fu[3], *ft[3];            /* u*, theta at faces */
    double *ul[3], *el, *vl;          /* Lagrangian values */
    double *rho1, *u1[3], *e1, *vol1; /* next state; vol1 is v */
    double *e_found, *vol_found;      /* before the closure of mixed cells; NULL where that changes no state */
    double *rhol;                     /* after the mass exchange, of solids too; NULL without reactions */
    double *source[3], *mom[3], *dv[3], *stress[3]; /* materials carried by points; stress: C_STRESS_ACCEL */
    double *diff[3], *heat, *diffT;                 /* ice_diffusion.c */
    double *mobility[3];                            /* at faces, of the implicit pressure */
    const ice_span *near; /* of each row, with ghosts: cells that may be near the material; NULL: all */
} ice_arrays;

/* View of a block for kernels. With one fluid, rho_sum, mean and flux are rho, u and fu of that fluid. */
typedef struct ice_view {
    const block *b;
    int dim, n_materials; /* those in m */
    int first;            /* material of m[0] */
    double dt, h[3], inv_h[3], gravity[3];
    /* Face area over cell volume along axis 0 at the lower and upper face of local cell i, from -2 to n + 1; 1/h if plane. */
    const double *lower0, *upper0;
    const double *volume;    /* m3 of local cell i along axis 0 */
    const double *area0;     /* of its lower face along axis 0 */
    const double *radius0;   /* m: of that face, where axis 0 is a radius */
    const double *interface; /* 1 at an interface between fluids, else 0; NULL: interfaces are not sought */
    const ice_span *sharp;   /* work.sharp of the block */
    double *p, *P, *dP, *shock, *contact, *rho_sum, *kappa_sum, *mean[3], *limiter, *mixed, *tmv, *wall, *owed;
    double *fp[3], *flux[3];
    double base, slope;        /* shock sensor: s = base + slope * sensor */
    double limit_lo, limit_hi; /* limiter factors lie between these: none 1,1; default 0,1; first order 0,0 */
    double length, finest;     /* m: the largest spacing and the smallest */
    double share[3];           /* ratio of each axis' spacing to the largest: one on square cells */
    bool burns;                /* some solid on points reacts */
    double
        advance; /* half time steps by which u* and P are ahead: 1; 2 where the implicit pressure is that of the end of the step */
    double *step, *last_step; /* implicit: phi dP of this step and of the last */
    double *reacted[REACTION_MAX];
    double *burnt_momentum[REACTION_MAX][3], *burnt_energy[REACTION_MAX]; /* NULL where the reactant is a fluid */
    ice_arrays m[ICE_MAX_MATERIALS];
} ice_view;

/* C_MIXED is the number of materials in a cell, plus this where one of them is carried by points. */
enum { ICE_WITH_POINTS = 64 };
static inline bool ice_holds_points(const ice_view *v, ptrdiff_t at)
{
    return v->mixed[at] >= ICE_WITH_POINTS;
}

/* Index of row (j, k) of a block with its ghosts. */
static inline int ice_row_number(const block *b, int j, int k)
{
    const int wide = b->dim > 1 ? b->n[1] + 2 * MESH_GHOST : 1;
    return (b->dim > 2 ? (k + MESH_GHOST) * wide : 0) + (b->dim > 1 ? j + MESH_GHOST : 0);
}

/* Of a row's values [lo, hi), those that may be non-zero for a material; `further` more at the upper end (1 for faces
 * along axis 0). */
static inline ice_span ice_near(const ice_view *v, const ice_arrays *m, int j, int k, int further, int lo, int hi)
{
    if (!m->near) return (ice_span){lo, hi};
    const ice_span s = m->near[ice_row_number(v->b, j, k)];
    const int first = s.first > lo ? s.first : lo, end = s.end + further < hi ? s.end + further : hi;
    return first < end ? (ice_span){first, end} : (ice_span){hi, hi};
}

/* Kernels work along axis 0 at local (j, k). Each has one always-inline body, instantiated for dimension 1, 2, 3 and for one
 * fluid or several; the tables are indexed [dim - 1][multi]. */
typedef void ice_row(const ice_view *v, int j, int k);
typedef void ice_material_row(const ice_view *v, int r, int axis, int j, int k);
typedef int ice_source_row(const ice *s, const ice_view *v, int j,
                           int k); /* returns the number of cells with a guard */
typedef struct ice_advect_job ice_advect_job;
typedef struct ice_advect_result {
    int bad, guarded;
} ice_advect_result;
typedef ice_advect_result ice_advect_slabs(const ice_advect_job *job);

extern ice_row *const ice_sensor_row[3][2];
extern ice_row *const ice_contact_row[3];
extern ice_row *const ice_increment_row[3][2];
extern ice_material_row *const ice_face_velocity_row[3][2];
extern ice_material_row *const ice_face_theta_row[3];
extern ice_row *const ice_limiter_row[3];
extern ice_source_row *const ice_source_row_of[3][2];
extern ice_advect_slabs *const ice_advect_of[3][2];

/* Kernels, chosen once when the scene is resolved. */
typedef struct ice_kernels {
    ice_row *sensor, *contact, *increment, *limiter;
    ice_material_row *face_velocity, *face_theta;
    ice_source_row *sources;
    ice_advect_slabs *advect;
} ice_kernels;

#define ICE_TABLE(name)                                     \
    {                                                       \
        {name##_1_0, name##_1_1}, {name##_2_0, name##_2_1}, \
        {                                                   \
            name##_3_0, name##_3_1                          \
        }                                                   \
    }
#define ICE_EACH(X) X(1, 0) X(1, 1) X(2, 0) X(2, 1) X(3, 0) X(3, 1)

/* Advection of one material over slabs [first, last) of a block: layers of cells along its slowest axis. */
struct ice_advect_job {
    const ice *s;
    const ice_view *v;
    int material, first, last;
    bool conserve;       /* theory 2.8 (iii) */
    double energy_floor; /* J/kg; -DBL_MAX where it must be evaluated cell by cell */
    double *buffer;      /* of the thread */
};

/* Sums of a step for each tile. */
enum {
    TILE_MASS,     /* advected through open sides, inward */
    TILE_MOMENTUM, /* three, and three moments (ice_push) */
    TILE_ENERGY = TILE_MOMENTUM + 6,
    TILE_DEFECT,          /* J: energy added or removed by guards */
    TILE_MASS_DEFECT,     /* kg */
    TILE_MOMENTUM_DEFECT, /* as TILE_MOMENTUM */
    TILE_GUARDS = TILE_MOMENTUM_DEFECT + 6,
    TILE_FLOORS,
    TILE_SOURCE_ENERGY,                      /* J: gravity's work */
    TILE_SOURCE_MOMENTUM,                    /* as TILE_MOMENTUM */
    TILE_SCRATCH = TILE_SOURCE_MOMENTUM + 6, /* three, scratch of any stage, otherwise zero */
    TILE_VALUES = TILE_SCRATCH + 3
};

/* State of the fluid at an inlet or beyond an outlet. */
typedef struct ice_reservoir {
    double rho, e, T, v;
} ice_reservoir;

typedef struct ice_cell_list {
    ptrdiff_t *at;
    size_t n;
} ice_cell_list;

/* Storage of the implicit pressure (ice_implicit.c); NULL in scenes without it. */
typedef struct ice_implicit ice_implicit;
floe_status ice_implicit_create(ice *s);
void ice_implicit_destroy(context *ctx, ice_implicit **w);

/* Coefficients of ice.exchange: of momentum along the normal of pairs that slip (of all momentum elsewhere), of
 * tangential momentum, of heat. */
typedef enum ice_coefficient { ICE_NORMAL, ICE_TANGENTIAL, ICE_HEAT, ICE_COEFFICIENTS } ice_coefficient;

/* An exchange law that depends on the state of its pair. */
typedef struct ice_pair_law {
    int first, second;
    ice_coefficient which; /* which coefficient it gives */
    const struct exchange_law *model;
    const void *par; /* the scene's */
} ice_pair_law;

/* Exchange laws of the deck. */
typedef struct ice_pairs {
    double (*table[ICE_COEFFICIENTS])[EXCHANGE_MAX]; /* constants, in ice.exchange */
    ice_pair_law law[3 * SCENE_MAX_EXCHANGES];
    int n;
    bool plain;                   /* constants alone */
    bool unlike;                  /* of three or more materials, pairs have different constants */
    bool heat;                    /* some pair exchanges heat */
    bool slips;                   /* some pair has a tangential law of its own */
    bool wall[ICE_MAX_MATERIALS]; /* the gradient of these materials' volume fraction is the normal */
} ice_pairs;

/* Materials at a cell or face, before exchange. */
typedef struct ice_spot {
    double theta[EXCHANGE_MAX], density[EXCHANGE_MAX], u[3][EXCHANGE_MAX]; /* 1, kg/m3 of the pure material, m/s */
    double sound[EXCHANGE_MAX], slope[3];                                  /* m/s; Pa/m: the gradient of p */
} ice_spot;

/* Reactions between materials of the cells. */
typedef struct ice_reactions {
    reaction list[REACTION_MAX];
    bool burns[REACTION_MAX]; /* the reactant is carried by points (ice_burn.c) */
    int n;
    reaction_solver **solver; /* one a thread */
} ice_reactions;

/* Effect of reactions on one cell in the step, per cell volume. */
typedef struct ice_creation {
    bool any;
    double mass[ICE_MAX_MATERIALS], volume[ICE_MAX_MATERIALS]; /* kg/m3, 1: at the pressure of the step's start */
    double theta[ICE_MAX_MATERIALS];                           /* volume fractions that dP compresses */
    double dP; /* Pa: full-step pressure increment that compensates the new volume (theory 2.3) */
} ice_creation;

/* Mixed cells whose equilibrium is solved as a batch. */
typedef struct ice_mixed_cells {
    equilibrium_batch batch;
    isentrope path[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH];
    bool frozen[EQUILIBRIUM_BATCH]; /* cells almost in equilibrium, whose T and e stay */
    /* At the paths' ends: J/kg, J/(kg K), K. */
    double e[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH], cv[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH],
        T[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH];
} ice_mixed_cells;

typedef struct ice_work {
    int threads;
    ice_reactions reactions;
    ice_pairs pairs;
    ice_implicit *implicit; /* owned */
    ice_kernels kernels;
    double *metric[MESH_MAX_BLOCKS]; /* lower0, upper0, volume, area0, radius0: five runs of n + 5 */
    double *tile;                    /* TILE_VALUES of every global tile */
    size_t tiles;
    double **buffer;                      /* one a thread */
    unsigned **set;                       /* one a thread, a row long; NULL with one fluid */
    ice_mixed_cells *cells;               /* one a thread; NULL with one fluid */
    ice_cell_list mixed[MESH_MAX_BLOCKS]; /* owned cells with more than one material, in order */
    /* owned cells inside a solid whose pressure is extrapolated from the fluid (ice_continue.c) */
    ice_cell_list continued[MESH_MAX_BLOCKS];
    /* Of each material and row, ghosts too: cells from the first to the last that have the material (ice_span.c), and the same with two
     * rows and two cells more on every side; NULL where it is not looked for. */
    ice_span *span[MESH_MAX_BLOCKS], *near[MESH_MAX_BLOCKS];
    ice_reservoir reservoir[MESH_MAX_DIM][2];
    double energy_floor[ICE_MAX_MATERIALS]; /* J/kg where the law's floor is constant, else NAN */
    /* Of each row, ghosts too: cells from the first to the last that lie at an interface (ice_interface.c). NULL: none are sharpened. */
    ice_span *sharp[MESH_MAX_BLOCKS];
    /* Mixed cells are closed along isentropes: there are several fluids, or the energy of one depends on volume at
     * given temperature. */
    bool reconcile;
    bool interfaces;             /* cells at interfaces between fluids are found */
    long found[MESH_MAX_BLOCKS]; /* 1 + the step whose e_found and vol_found a block has; 0: none */
    struct ice_sealing *sealing; /* owned (ice_merged_cells.h); NULL: no embedded boundaries */
    ice_cell_list region[SCENE_MAX_LOADS][MESH_MAX_BLOCKS]; /* owned cells of heat and pressurise loads */
} ice_work;

/* Pressures and fractions of several materials in one block (theory 2.1). */
floe_status ice_mixture(ice *s, int block_id, const ice_view *v);
/* Allocates the spans (work.span, work.near) of a block; none where reactions may produce a material in any cell. */
floe_status ice_spans_create(ice *s, int block_id);
void ice_spans_destroy(context *ctx, ice_work *w);
/* Finds the cells of a row that contain a material, from its density with ghosts. */
void ice_note_span(const ice *s, const block *b, int r, int j, int k, const double *rho);
/* Sets `near` from `span`, after all rows have been searched. */
void ice_widen_spans(const ice *s, int block_id);
/* Saves the state that the closure of a block's cells will change, for ice_rollback_step. */
void ice_save_found(ice *s, int block_id, const ice_view *v);
/* State of a law at a pressure and a temperature. */
ice_reservoir ice_state_at(const eos *law, double p, double T);
/* Whether the scene's fluids are at rest and given by pressure and temperature throughout. */
bool ice_asks_for_rest(const ice *s);
/* Columns at rest (theory 2.4), where gravity acts on fluids at rest given by pressure and temperature. */
floe_status ice_hydrostatic(ice *s);

/* Cells with extrapolated pressure take no pressure increment (ice_continue.c). */
void ice_constrain_continued(const ice *s);
bool ice_is_continued(const ice *s, const ice_view *v, ptrdiff_t at);

/* Specific volume of a material after a pressure increment (theory 2.10). Materials with a small volume fraction, and
 * `bound` ones, change by a factor of ten at most in a step. */
static inline double ice_specific_volume_after(const ice_arrays *m, ptrdiff_t at, double dP, bool bound)
{
    const double specific_volume = m->v[at], next = specific_volume - m->theta[at] * m->kappa[at] * dP / m->rho[at];
    const bool bounded = m->theta[at] < ICE_BOUND_FRACTION || bound;
    return bounded
               ? least(most(next, specific_volume / ICE_MOST_VOLUME_CHANGE), specific_volume * ICE_MOST_VOLUME_CHANGE)
               : next;
}

/* Interfaces between fluids (ice_interface.c): storage of a block's spans; the cells at interfaces; */
floe_status ice_interfaces_create(ice *s, int block_id);
void ice_interfaces_destroy(context *ctx, ice_work *w);
floe_status ice_find_interfaces(ice *s);
/* gradients there are zero, and fractions at faces are those of a sharp profile. */
void ice_flatten_interfaces(const ice_view *v);
void ice_sharpen_faces(const ice_view *v);

/* Whether a fluid's own pressure is the cell's (theory 2.15). */
static inline bool ice_near_pressure(const isentrope *own, double p)
{
    return fabs(own->p - p) < ICE_NEAR_ONE_PRESSURE * own->p && own->floor == 0.0;
}

/* Share of positive heat that is distributed by theta kappa and not by rho T: for dispersed fluids in a shock. */
static inline double ice_shocked(const ice_view *v, ptrdiff_t at, double heat)
{
    return v->interface && heat > 0.0 ? v->shock[at] * (1.0 - v->interface[at]) : 0.0;
}

/* Volume fractions at faces and volume fluxes, of several materials (2.3). */
void ice_face_fractions(const ice *s, const ice_view *v);
/* After dP and P are known: relaxes volumes, constrains cells with extrapolated pressure, sets ghosts. */
void ice_finish_increment(const ice *s);

void ice_view_make(const ice *s, int block_id, ice_view *v);

/* How ghost cells beyond a side are set. */
typedef enum ice_ghost {
    GHOST_EVEN,      /* mirrored; nearest cell at open sides */
    GHOST_ZERO_OPEN, /* mirrored; zero at open sides */
    GHOST_VELOCITY,  /* a vector: normal component odd at walls; values of the wall or inlet */
    GHOST_DENSITY,
    GHOST_ENERGY,
    GHOST_TEMPERATURE, /* temperature of walls and inlets */
    GHOST_VOLUME       /* as EVEN; the reservoir's value at inlets */
} ice_ghost;
void ice_fill_ghosts(const ice *s, field_id id, int instance, fill_which which, ice_ghost kind);
/* Sets ghost faces of F_VEL, so that the outflow of ghost cells is known. */
void ice_fill_faces(const ice *s, field_id id, int instance);
bool ice_is_wall(bc_kind kind);
/* Exchanges momentum at the faces normal to `axis`: of velocities, one array a material, or of other quantities that
 * are exchanged in the same way. */
void ice_exchange_faces(const ice *s, const ice_view *v, int axis, double *const *value);
/* Sides behind which a state of a fluid lies. */
bool ice_has_reservoir(bc_kind kind);
/* What a reservoir sends into the ghosts of an array (of kind velocity, density, energy, volume). */
void ice_reservoir_ghosts(const ice *s, const block *b, const fields *f, int axis, mesh_side side, int r,
                          ice_ghost kind, int component, double *a);
/* Values that the sides impose on faces. */
void ice_boundary_face_velocity(const ice *s, const ice_view *v, int r);
void ice_boundary_face_pressure(const ice *s, const ice_view *v);
/* One face on a side: the face's index, the owned cell beside it, and +1 where the axis points out of the domain. */
typedef struct side_face {
    ptrdiff_t face, cell;
    int i, j, k;
    double outward;
} side_face;
typedef void side_visitor(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at);
/* Pressure and outward velocity on a face of a non-reflecting side or of a reservoir. */
typedef struct ice_side_state {
    double pressure, velocity;
} ice_side_state;
ice_side_state ice_characteristic(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at);
/* Visits the owned faces of every non-periodic side that the block touches. */
void ice_visit_sides(const ice *s, const ice_view *v, int r, side_visitor *visit);
/* Mobility of a material at the faces of the sides, and what the implicit centring adds to u* there. */
void ice_boundary_mobility(const ice *s, const ice_view *v, int r);
/* The centring of the implicit pressure where the explicit one is phi. */
static inline double ice_implicit_phi(const ice_view *v, double phi)
{
    return most(phi, 0.5 * v->advance);
}
/* Momentum and work of the pressure on the sides, into the ledger. */
void ice_boundary_work(ice *s);

/* Rows of a block with `ghost` layers about it (negative axis: cells), or of the faces normal to `axis`. */
typedef struct ice_rows {
    int j0, k0, nj, n;
} ice_rows;
ice_rows ice_rows_of(const block *b, int axis, int ghost);
/* Owned rows that one thread must take together, so that no two meet in a tile: for loops that add to tiles. */
int ice_rows_chunk(const ice *s, ice_rows q);
static inline int ice_row_j(ice_rows q, int row)
{
    return q.j0 + row % q.nj;
}
static inline int ice_row_k(ice_rows q, int row)
{
    return q.k0 + row / q.nj;
}

/* The partials of the global tile that holds local cell (i, j, k) of block b. */
double *ice_tile(const ice *s, const block *b, int i, int j, int k);
/* Where a block's cell is, and the middle of its face on a side; zero along axes that the mesh does not have. */
void ice_place_of(const ice *s, const block *b, const int cell[MESH_MAX_DIM], double x[MESH_MAX_DIM]);
void ice_side_place(const ice *s, const block *b, int axis, bool upper, const int cell[MESH_MAX_DIM],
                    double x[MESH_MAX_DIM]);
/* An impulse along an axis at x, and its moment, to six of a tile's. */
static inline void ice_push(double *tile, const double x[MESH_MAX_DIM], int axis, double impulse)
{
    tile[axis] += impulse;
    add_moment(tile + 3, x, axis, impulse);
}
void ice_clear_tiles(ice *s);
/* Adds the tiles up in order and enters them in the ledger. */
void ice_enter_tiles(ice *s);

/* Momentum exchange of the only two materials, by constants, in cells [from, to) of a list of mixed ones (ice_exchange_pair.c). */
void ice_exchange_pair(const ice *s, const ice_view *v, const ice_cell_list *list, size_t from, size_t to);
/* Fills the coefficients of all pairs (ice_pairs.c). Errors: FLOE_BAD_INPUT where a law lacks something. */
floe_status ice_pairs_resolve(ice *s);
/* Coefficients at a place: the table of constants, or `own`, filled from it and the laws. */
double (*ice_coefficients(const ice *s, ice_coefficient which, const ice_spot *spot,
                          exchange_matrix own))[EXCHANGE_MAX];
/* Gradient (1/m) of the volume fraction of the walls, and its direction; false: none to speak of. */
void ice_wall_gradient(const ice_view *v, ptrdiff_t at, double gradient[3]);
/* Gradient of p (Pa/m) in a cell. */
void ice_pressure_slope(const ice_view *v, ptrdiff_t at, double slope[3]);
bool ice_wall_normal(const ice_view *v, const double gradient[3], double normal[3]);
/* Momentum exchange of whole vectors; factor: dt at a face, dt TMV/V in a cell; gradient NULL: no pair slips. */
void ice_relax_spot(const ice *s, const ice_view *v, const double *mass, const ice_spot *spot, double factor,
                    const double *gradient, double u[3][EXCHANGE_MAX]);
/* Momentum exchange at one face where coefficients depend on the state or pairs slip, of value[r][R]: u*, or what the pressure adds
 * to it along the axis (the mobility of the implicit pressure). */
void ice_exchange_face(const ice *s, const ice_view *v, int axis, double *const *value, ptrdiff_t R);

/* What stress, supports and contact do to u* of a material that points carry (ice_face_stress.c): along the faces' axis, and along any axis. */
void ice_stress_face_velocity(const ice *s, const ice_view *v, int r, int axis);
double ice_stress_kick(const ice *s, const ice_view *v, int r, int axis, int component, ptrdiff_t R);

/* Half a step's force on the face velocities, and half a step's heat on the advanced pressure (the array P); a whole step's of
 * both where the implicit pressure is at its end. */
void ice_diffusion_face_velocity(const ice *s, const ice_view *v, int r, int axis);
void ice_diffusion_pressure(const ice *s, const ice_view *v, int r, double *P);
/* Viscosity and conduction of the whole step, added to the Lagrangian values of all blocks. */
void ice_diffuse(const ice *s);
/* Mass exchange (ice_react.c). Errors of resolve: FLOE_BAD_INPUT for solids on points, FLOE_NO_MEMORY. */
floe_status ice_reactions_resolve(ice *s);
void ice_reactions_destroy(context *ctx, ice_work *w);
/* Surface (m2/m3) at which a solid on points burns, in a cell (ice_burn.c). */
double ice_burning_surface(const ice *s, const ice_view *v, int r, ptrdiff_t at);
/* Adds what reaction k has consumed of the points of a cell, local index i along axis 0, to its product. */
void ice_join_burnt(const ice *s, const ice_view *v, int k, ptrdiff_t at, int i);
ice_creation ice_created(const ice *s, const ice_view *v, ptrdiff_t at);
/* The pressure of new volume, added to the array P in owned cells. */
void ice_created_pressure(const ice *s, const ice_view *v, double *P);
/* From the mass exchange on, rho is what it left. */
void ice_view_lagrangian(ice_view *v);
/* Viscosity of the current gas that a membrane keeps apart, of the state at t^n: first order in time. */
void ice_diffuse_sealed(const ice *s);
/* Rate of compression of a cell (m/s over the largest spacing): the lesser of div u and the sum of its terms along the
 * axes, each times its spacing over the largest. Both are the same on square cells; on others the volume's own length,
 * V^(1/d), would make the viscosity along the finer axis larger than explicit steps bear. */
FLOE_ALWAYS_INLINE double ice_compression(double div, double jump)
{
    return most(-most(div, jump), 0.0);
}

/* q of theory 2.8 (iv) of a fluid squeezed at `squeeze` (m/s over a cell), s its shock sensor. */
FLOE_ALWAYS_INLINE double ice_bulk_pressure(double rho, double speed, double squeeze, double s)
{
    const double quadratic = 0.75, linear = 0.3;
    return rho * squeeze * (quadratic * squeeze + s * linear * speed);
}

/* Share of a face on a side of the domain that is open to the current gas: 1 without membranes. */
double ice_side_open(const ice *s, const block *b, const int local[2], int axis, int side);

/* Pools (ice_merged_cells.c). */
floe_status ice_seal_create(ice *s);
void ice_seal_destroy(context *ctx, struct ice_sealing **w);
void ice_merged_centring(const ice *s);
void ice_merged_increment(const ice *s);
void ice_merged_sources(const ice *s);

/* Loads (pressurise, heat) on the Lagrangian energies. */
floe_status ice_apply_loads(ice *s);
/* What heating at a given power does to the pressure over the step, at the volumes there are, onto the array of dP: for the
 * implicit pressure, in whose one step the flow relieves it. */
floe_status ice_load_pressure(ice *s);
/* Doubles that one thread needs to advect. */
size_t ice_advect_buffer(const ice *s);

/* Local (i, j, k) of a linear index. */
void ice_cell_of(const block *b, ptrdiff_t at, int cell[MESH_MAX_DIM]);
/* "cell (3, 4), material 0 (air)" for messages. */
void ice_place(const ice *s, const block *b, ptrdiff_t at, int r, char *text, size_t size);

#endif

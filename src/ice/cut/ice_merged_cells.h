/* Gases separated by embedded boundaries: merged cells, and the geometry that the step needs. Only this folder
 * includes it.
 *
 * A cut cell with a small volume of a gas cannot have a state of its own: any flux would empty it. It is therefore
 * merged with its largest neighbour through an open face: mass, momentum and energy of the merged cells are summed and
 * give one density, velocity and specific energy. This is conservative, and cells that a boundary covers or uncovers in
 * a step need no special treatment. Which cells are merged depends on the position of the boundary alone. */
#ifndef ICE_MERGED_CELLS_H
#define ICE_MERGED_CELLS_H

#include "ice/cut/ice_cut.h"
#include "scene/state.h"

/* A cut cell, or a cell that is merged with one. */
typedef struct ice_member {
    int cell[3];       /* global */
    int block, merged; /* merged: index of its merged cell */
    ptrdiff_t at;      /* index in the block */
    double open;       /* open fraction of the gas */
    double above
        [3]; /* m: of the cell's centre from the open centroid of its merged cells; 0 without gravity, viscosity and heat that passes walls */
    double own[3];     /* m: of the centroid of its own open volume from the cell's centre, as above[] */
    double face[3][2]; /* mean apertures of its faces in the step, by axis and side */
} ice_member;

/* What a stage leaves of a fluid in a member's cell: `advected` kg of its next state in the whole cell, less `closed` kg of
 * its Lagrangian state beyond the boundary. */
typedef struct ice_amount {
    double advected, closed;
    double energy; /* J: internal and kinetic */
    double momentum[MESH_MAX_DIM];
} ice_amount;

/* Sums of each fluid of a merged cell that several share. */
enum {
    FLUID_MASS,
    FLUID_VOLUME, /* m3: that its specific volume fills */
    FLUID_ENERGY, /* J: internal and kinetic */
    FLUID_MOMENTUM,
    FLUID_SUMS = FLUID_MOMENTUM + MESH_MAX_DIM
};

enum {
    MERGED_VOLUME,
    MERGED_MASS,
    MERGED_FLUX, /* m3/s: flux out of its open faces and of the boundary */
    MERGED_WORK, /* J */
    MERGED_MOMENTUM,
    MERGED_WEIGHT = MERGED_MOMENTUM + MESH_MAX_DIM,   /* N s: gravity's impulse */
    MERGED_DIFFERENCE = MERGED_WEIGHT + MESH_MAX_DIM, /* N s: of the members' velocities from that of the lead */
    MERGED_SUMS = MERGED_DIFFERENCE + MESH_MAX_DIM
};

typedef struct ice_merged_cells {
    const ice_region *region; /* not owned */
    ice_member *member;       /* owned */
    int n, count;             /* numbers of members and of merged cells */
    int *lead;                /* of each merged cell: its largest member; owned */
    int *place;               /* of every global cell: its index among the members, else -1; owned */
    double *sum;              /* MERGED_SUMS of each merged cell; owned */
    double *fluid;            /* FLUID_SUMS of each fluid of each merged cell; NULL: one fluid; owned */
    size_t reserved;
} ice_merged_cells;

/* What a member had before its velocity became one of its own, for a step that is rejected. */
typedef struct ice_before_spread {
    int block;
    ptrdiff_t at;
    double u[3], e;
} ice_before_spread;

typedef struct ice_spread {
    ice_before_spread *before; /* owned */
    size_t reserved;
    int n;
    long step; /* 1 + the step that has spread them; 0: none */
} ice_spread;

typedef struct ice_cut_cells {
    ice_merged_cells now[ICE_CUT_REGIONS], next[ICE_CUT_REGIONS];
    fluid_state rest[ICE_CUT_REGIONS]; /* state of each gas in cells far from it */
    ice_spread spread[ICE_CUT_REGIONS];
    double usual[ICE_MAX_MATERIALS];             /* kg/m3: density of each fluid at the start */
    struct ice_wall_flow *wall[ICE_CUT_REGIONS]; /* NULL where no fluid is viscous and no heat passes; owned */
    struct ice_cut_system *system;               /* of the implicit pressure (ice_cut_implicit.c); NULL: none; owned */
    ice_view *view;                              /* of every block, for one region at a time (ice_cut_views); owned */
} ice_cut_cells;

/* At which positions of the boundaries cells are merged: before the points move, over the step, and after it. */
typedef enum ice_merge_time { MERGE_BEFORE, MERGE_MOVING, MERGE_AFTER } ice_merge_time;
/* Merges the cells of a gas for the positions of the boundaries. All cells that are cut during the step are members,
 * whatever their open fraction. */
floe_status ice_merge_cells(ice *s, ice_merge_time when, ice_merged_cells *out);
/* Makes the views of a region's blocks. */
void ice_cut_views(const ice *s, const ice_region *g);
/* Mean aperture of a face for a region in the step. */
double ice_mean_face(const ice *s, int region, const int cell[3], int axis, int side);
/* ---- gravity (ice_merged_weight.c): the pressure in merged cells is linear, P + rho g . (x - centre), so that the
 * pressure of a gas at rest on walls is exact anywhere in its cells ---- */

bool ice_has_weight(const ice *s);
/* Positions of the members relative to the open centroid of their merged cells. */
void ice_merged_centre(const ice *s, int place, ice_merged_cells *p);
/* Pressure difference (Pa) from the merged cells' to that at the centre of a member's cell, which is the mean of that cell were it whole; to a place from its centre;
 * and to one of its faces. Where whole cells bear weight as it lies in them (theory 2.17), so do these. */
double ice_merged_rise(const ice *s, const ice_merged_cells *p, const ice_member *m);
double ice_rise_to_piece(const ice *s, const ice_merged_cells *p, const ice_member *m, const double from_centre[3]);
double ice_rise_to_face(const ice *s, const ice_merged_cells *p, const ice_member *m, int axis, int side);
/* Converts the pressures of a region at t^n to those at the centres of the cells. */
void ice_merged_lift(const ice *s, const ice_region *g);
/* Whether a cell is merged or closed, so that its weight is not that of the whole cell. */
bool ice_is_merged(const ice *s, int region, const block *b, int i, int j, int k);

/* ---- the step of merged cells (ice_merged_step.c) ---- */

void ice_merged_centring(const ice *s, const ice_region *g);
void ice_merged_increment(const ice *s, const ice_region *g);
/* Volumes of the merged cells and fluxes out of them, with the boundaries at the velocities of the start of the step, into the sums. */
void ice_merged_fluxes(const ice *s, ice_merged_cells *p);
/* Of several fluids the volumes in cells that solids fill stay. */
void ice_still_elsewhere(const ice *s, const ice_merged_cells *p);
void ice_merged_sources(const ice *s, const ice_region *g);
/* Force of viscosity and of the drag of walls (N/m3) on merged cells, at t^n. */
void ice_merged_diffusion_rates(const ice *s, const ice_region *g);

/* Values of a member's faces and of its block. */
double ice_member_area(const ice *s, const ice_member *k, int axis, int side);
ptrdiff_t ice_member_face(const ice_view *v, const ice_member *k, int axis, int side);
static inline const ice_view *ice_member_view(const ice *s, const ice_member *k)
{
    return &s->cut_cells->view[k->block];
}
/* The stage for whole cells has advected their full volume; the part beyond the boundary is subtracted again with its
 * old state. */
ice_amount ice_advected(const ice *s, const ice_member *k, const ice_fluid *m);
/* What gravity does to merged cells, into the ledger: its impulse at their middle, and its work (J). */
void ice_enter_weight(const ice *s, const ice_member *lead, const double *sum, double work);
/* All blocks that have a cell, their own or as a ghost: for (int id = 0; ice_next_seen(s, cell, &id, &at);) with the view
 * of block id - 1. */
bool ice_next_seen(const ice *s, const int cell[3], int *id, ptrdiff_t *at);

/* Step of the index to cell c of those around, along axis 0 first. */
static inline ptrdiff_t ice_step_to(const block *b, int c)
{
    ptrdiff_t step = (c % 3 - 1) * b->stride[0];
    if (b->dim > 1) step += (c / 3 % 3 - 1) * b->stride[1];
    return b->dim > 2 ? step + (c / 9 - 1) * b->stride[2] : step;
}
/* Merged cells have no valid state left: requests a smaller step. */
floe_status ice_bad_merged_cells(const ice *s, const ice_merged_cells *p, int merged, double e);

/* Velocities of the members of merged cells, each at the centroid of its own open volume, after the fit (ice_merged_slope.c, theory 7.7). */
floe_status ice_spread_velocities(ice *s, const ice_region *g);
/* Gives them back what they had, if the current step has done so. */
void ice_rollback_spread(ice *s);
/* Velocities and energies of ghost cells, after those of cells have changed. */
void ice_fill_changed(const ice *s, const ice_region *g);
/* The state of a gas in cells without it, for the differences near the boundary (ice_extrapolate.c). */
floe_status ice_extrapolate_states(ice *s, const ice_region *g);
/* Whether a viscous fluid sticks to the walls by what covered cells have (theory 7.8); gives them the velocities of 7.7; and whether a member keeps
 * that: it is covered throughout the step. */
bool ice_covered_stick(const ice *s);
void ice_stick_covered(const ice *s, const ice_region *g);
bool ice_keeps_sticking(const ice *s, const ice_merged_cells *p, const ice_member *m);
/* Advection in the velocities of faces beside cells that walls cut, if so (ice_merged_advance.c). */
void ice_merged_advance(const ice *s, const ice_region *g);
/* Whether no gas has reached a merged cell of so much volume (m3) and mass (kg), beside a cell's volume and the density of the thinnest fluid at the start. */
bool ice_is_void(double cell, double volume, double mass, double density, bool next);
/* Advection of a region, and its first states, after which the members of a merged cell have one state (ice_merged_contents.c). */
floe_status ice_advect_merged(ice *s, const ice_region *g);
floe_status ice_start_merged(ice *s, const ice_region *g);

/* ---- cells that several fluids share (ice_merged_fluids.c, ice_merged_flow.c) ---- */

/* State of a cell without fluids: of the first at rest; the mean of its neighbours with marks of at least `least`. */
void ice_rest_fluids(const ice *s, const ice_view *v, ptrdiff_t at);
void ice_extrapolate_fluids(const ice_view *v, ptrdiff_t at, double least);
/* Members that the boundary covers take the state of their merged cells. */
void ice_join_covered(const ice *s, const ice_region *g);
/* After the closure: one state for the members of merged cells, one mark of interfaces; and one Lagrangian state. */
void ice_agree_closed(const ice *s, const ice_region *g);
void ice_agree_reacted(const ice *s, const ice_region *g);
void ice_agree_interfaces(const ice *s, const ice_region *g);
void ice_agree_exchanged(const ice *s, const ice_region *g);
/* Volume fractions at the faces of merged cells that let none give more of a fluid than it has. */
void ice_bound_merged(const ice *s, const ice_region *g);
/* Again, once faces have what moving pieces draw through them (ice_merged_sweep). */
void ice_bound_swept(const ice *s, const ice_region *g);
/* Lagrangian velocities and energies of the fluids of merged cells, from their sums (ice_merged_step.c). */
void ice_advance_fluids(const ice *s, ice_merged_cells *p);
/* The first states, those at the start of a step, and those after advection, of merged cells. */
floe_status ice_start_fluids(ice *s, const ice_region *g);
floe_status ice_remerge_fluids(ice *s, const ice_region *g);
floe_status ice_renew_fluids(ice *s, const ice_region *g);

/* ---- the implicit pressure (ice_cut_implicit.c) ---- */

/* Forces of viscosity on all cells of a region at t^n, for the faces (theory 7.8). */
void ice_cut_viscous_rates(ice *s, const ice_region *g);
floe_status ice_cut_system_create(ice *s);
void ice_cut_system_destroy(context *ctx, struct ice_cut_system **w);

/* Sets all sums to zero. */
void ice_clear_merged(ice_merged_cells *p);
/* Adds the open volumes (m3) of their members to them. */
void ice_sum_open_volumes(const ice *s, ice_merged_cells *p);
/* Sign of a boundary's area vectors for a region: +1 for the one that it encloses, -1 for the one about it; 0: it does not
 * bound the region. */
double ice_outward(const ice *s, int region, int line);
/* Whether a boundary encloses a region, next to it. */
bool ice_encloses(const ice *s, int line, int region);
/* The boundary that encloses a region; -1: none does. */
int ice_line_about(const ice *s, int region);

#endif

/* Gases that a membrane keeps apart, as the ICE room sees them: pools of cells, and what the step needs of them.
 * Private to the room.
 *
 * A cell of which a membrane leaves little to a gas cannot have a state of its own: any flow would empty it. So it
 * shares one with its largest neighbour behind the same open faces (a pool): what flows, pushes and works on its
 * members is added up and shared out as one density, velocity and energy. The sums lose nothing, and what a membrane
 * uncovers or covers in a step needs no more than to join. Pools follow from where the membrane is, and from nothing
 * else. */
#ifndef ICE_ICE_POOL_H
#define ICE_ICE_POOL_H

#include "ice/ice_internal.h"
#include "scene/state.h"

/* A cell that the membrane cuts, or one that shares its state with such. */
typedef struct ice_member {
    int cell[2];       /* global */
    int block, pool;   /* pool: in the set */
    ptrdiff_t at;      /* index in the block */
    double open;       /* share left to the gas */
    double above[2];   /* m: of the cell's centre from that of what the pool has open; 0 without gravity */
    double face[2][2]; /* of its faces in the mean of the step, by axis and side */
} ice_member;

enum {
    POOL_VOLUME,
    POOL_MASS,
    POOL_FLUX, /* m3/s out of its open faces and of the membrane */
    POOL_WORK, /* J */
    POOL_MOMENTUM,
    POOL_WEIGHT = POOL_MOMENTUM + 2, /* N s: gravity's impulse */
    POOL_SUMS = POOL_WEIGHT + 2
};

typedef struct ice_pools {
    ice_member *member; /* owned */
    int n, count;       /* members, pools */
    int *lead;          /* of each pool: its largest member; owned */
    int *place;         /* of every global cell: its member, else -1; owned */
    double *sum;        /* POOL_SUMS of each pool; owned */
    size_t room;
} ice_pools;

struct ice_sealing {
    ice_pools now[ICE_SEALED_GASES], next[ICE_SEALED_GASES];
    fluid_state rest[ICE_SEALED_GASES]; /* what stands where a gas is far away */
    ice_view *view;                     /* of every block, of the gas in hand; owned */
};

/* When pools are made: before the points have moved; with where they will be known; and there. */
typedef enum ice_pool_time { POOLS_BEFORE, POOLS_MOVING, POOLS_AFTER } ice_pool_time;
/* Makes the pools of a gas from where the membranes are. All cells that they cut in the step are members, whatever is
 * left of them. */
floe_status ice_pools_make(ice *s, int gas, ice_pool_time when, ice_pools *out);
/* First states of all gases in what the membrane leaves them. */
floe_status ice_sealed_fill(ice *s);
/* Views of the gas in hand, one a block. */
void ice_seal_views(const ice *s);
/* Share of a cell, or of one of its faces, that the membranes leave to a gas at a place of theirs (SEAL_NOW to
 * SEAL_NEXT). */
double ice_open_cell(const ice *s, int gas, int place, const int cell[2]);
double ice_open_face(const ice *s, int gas, int place, const int cell[2], int axis, int side);
/* Share of a face that is left to a gas in the mean of the step. */
double ice_mean_face(const ice *s, int gas, const int cell[2], int axis, int side);
/* ---- gravity (ice_pool_weight.c): in a pool the pressure is linear, P + rho g . (x - centre), so that a gas at rest
 * pushes on walls anywhere in its cells as it should ---- */

bool ice_has_weight(const ice *s);
/* Where the cells of pools lie from what these have open. */
void ice_pools_centre(const ice *s, int gas, int place, ice_pools *p);
/* What the pressure of the gas in hand (Pa) is at a member's centre, and at a place from there (m), beyond that of its pool. */
double ice_pool_rise(const ice *s, const ice_pools *p, const ice_member *m, const double from_centre[2]);
/* Pressures of the gas in hand, at t^n, become those at the centres of the cells. */
void ice_pool_lift(const ice *s);
/* Whether a cell shares its state, or has none: its weight is not that of the whole cell. */
bool ice_is_pooled(const ice *s, const block *b, int i, int j);
/* First states of the gas in hand: at rest that is given by pressure and temperature, in balance; each room keeps the pressure of its
 * highest cell. */
floe_status ice_sealed_hydrostatic(ice *s);

/* Sets all sums to zero. */
void ice_pools_clear(ice_pools *p);
/* Which way a line's areas point from a gas: +1 from the one that it holds, -1 from that outside all lines; 0: it does
 * not bound the gas. */
double ice_outward(const ice *s, int gas, int line);

#endif

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
    double face[2][2]; /* of its faces in the mean of the step, by axis and side */
} ice_member;

enum {
    POOL_VOLUME,
    POOL_MASS,
    POOL_FLUX, /* m3/s out of its open faces and of the membrane */
    POOL_WORK, /* J */
    POOL_MOMENTUM,
    POOL_SUMS = POOL_MOMENTUM + 2
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
/* Sets all sums to zero. */
void ice_pools_clear(ice_pools *p);
/* Which way a line's areas point from a gas: +1 from the one that it holds, -1 from that outside all lines; 0: it does
 * not bound the gas. */
double ice_outward(const ice *s, int gas, int line);

#endif

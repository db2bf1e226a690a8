/* The outer state of each boundary face: its condition, with the values at the place and time of the face, and the fluid beyond it (theory 2.13). */
#ifndef ICE_SIDE_TABLE_H
#define ICE_SIDE_TABLE_H

#include "ice/ice.h"
#include "ice/state/ice_fluid_state.h"

typedef struct ice_side_table ice_side_table;

typedef struct ice_side_face {
    const bc_side *condition;
    ice_reservoir behind;              /* density 0: there is none */
    double acceleration[MESH_MAX_DIM]; /* m/s2, of a velocity that a formula of time gives */
    bc_side own;                       /* numbers at this face, where they change along the side; else not used */
} ice_side_face;

/* The face of a side beside an owned cell, or beyond the cells of a block in ghost columns; `cell` is local, and along the axis of no
 * account. */
const ice_side_face *ice_side_at(const ice *s, const block *b, int axis, mesh_side side, int i, int j, int k);
/* Numbers of formulas of time, for the step from s->time on. FLOE_BAD_INPUT where one has no value that its key takes. */
floe_status ice_renew_sides(ice *s);

#endif

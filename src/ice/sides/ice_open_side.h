/* Open sides (ice_open_side.c); only this folder includes it. */
#ifndef ICE_OPEN_SIDE_H
#define ICE_OPEN_SIDE_H

#include "ice/sides/ice_side_table.h"
#include "ice/sides/ice_sides.h"

/* What a reservoir sends into the ghosts beyond one face (of kind velocity, density, energy, volume); `at`: the owned cell. */
void ice_reservoir_ghosts(const ice *s, const block *b, const fields *f, const ice_side_face *here, ptrdiff_t at,
                          int axis, mesh_side side, int r, ice_ghost kind, int component, double *a);
/* Whether nothing of what is inside reaches the face of an inlet: the fluid enters faster than its sound. */
bool ice_enters_supersonic(const ice *s, const ice_side_face *here, int axis, mesh_side side);
/* Pressure and outward velocity on a face of a non-reflecting side or of a reservoir. */
typedef struct ice_side_state {
    double pressure, velocity;
} ice_side_state;
ice_side_state ice_characteristic(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at);

#endif

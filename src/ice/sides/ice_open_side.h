/* Open sides (ice_open_side.c); only this folder includes it. */
#ifndef ICE_OPEN_SIDE_H
#define ICE_OPEN_SIDE_H

#include "ice/sides/ice_sides.h"
#include "ice/state/ice_materials.h"

typedef struct ice_reservoirs {
    ice_reservoir state[MESH_MAX_DIM][2];
} ice_reservoirs;

/* What a reservoir sends into the ghosts of an array (of kind velocity, density, energy, volume). */
void ice_reservoir_ghosts(const ice *s, const block *b, const fields *f, int axis, mesh_side side, int r,
                          ice_ghost kind, int component, double *a);
/* Pressure and outward velocity on a face of a non-reflecting side or of a reservoir. */
typedef struct ice_side_state {
    double pressure, velocity;
} ice_side_state;
ice_side_state ice_characteristic(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at);

#endif

/* Open sides (ice_open_side.c); only this folder includes it. */
#ifndef ICE_OPEN_SIDE_H
#define ICE_OPEN_SIDE_H

#include "ice/sides/ice_side_table.h"
#include "ice/sides/ice_sides.h"

/* Whether a material is in the region of the one that a side brings: the density beyond the side is then none of its own. */
bool ice_shares_cells(const ice *s, int r, int side_material);
/* Whether fluid of a known state lies outside a face of an outlet, a reservoir or a non-reflecting side, and whether it is at rest. */
bool ice_known_outside(const ice_side_face *here);
bool ice_rests_behind(const ice_side_face *here);
/* The ghosts beyond one face. */
typedef struct ghost_column {
    ptrdiff_t last; /* the cell before them */
    ptrdiff_t cell; /* the owned cell whose fluids flow: the same, or in columns beyond an open side the nearest */
} ghost_column;
/* What a known fluid outside sends into the ghosts beyond one face (of kind velocity, density, energy, volume), where the cell's fluids
 * flow in. Their densities and velocities have been filled, so that all fluids and arrays agree on the direction. */
void ice_inflow_ghosts(const ice *s, const block *b, const fields *f, const ice_side_face *here, ghost_column at,
                       int axis, mesh_side side, int r, ice_ghost kind, int component, double *a);
/* Whether nothing of what is inside reaches the face of an inlet: the fluid enters faster than its sound. */
bool ice_enters_supersonic(const ice *s, const ice_side_face *here, int axis, mesh_side side);
/* Pressure on a face of an outlet: the given one; of fluid that comes back from rest outside, that of its speed;
 * `inside`, a pressure of the cell, where the fluid leaves faster than its sound, so that nothing from outside reaches it. */
double ice_outlet_pressure(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at, double inside);
/* Whether fluid enters a face as from a reservoir: at one, and at an outlet where fluid at rest outside rushes in. */
bool ice_is_reservoir(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at);
/* Pressure and outward velocity on a face of a non-reflecting side, or one of these. */
typedef struct ice_side_state {
    double pressure, velocity;
} ice_side_state;
ice_side_state ice_characteristic(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at);

#endif

/* Gases beside embedded boundaries (theory 7.1): what the other parts of the solver ask of them. The stages are in ice.h. */
#ifndef ICE_SEALED_H
#define ICE_SEALED_H

#include "ice/ice_view.h"

extern const ice_cut_geometry ice_sealed_geometry;
floe_status ice_sealing_create(ice *s);
void ice_sealing_destroy(context *ctx, struct ice_sealing **w);
/* Open fraction of a cell, and aperture of one of its faces, for a region at a position of the boundaries (SEAL_NOW to
 * SEAL_NEXT). */
double ice_open_cell(const ice *s, int region, int place, const int cell[3]);
double ice_open_face(const ice *s, int region, int place, const int cell[3], int axis, int side);
/* Merges the cells of the first states. */
floe_status ice_sealed_merge_start(ice *s);
/* Hydrostatic equilibrium of gas at rest that is given by pressure and temperature; each connected part keeps the pressure of its highest
 * cell. */
floe_status ice_sealed_hydrostatic(ice *s);

#endif

/* Gases beside embedded boundaries (theory 7.1): what the other parts of the solver ask of them. The stages are in ice.h. */
#ifndef ICE_CUT_H
#define ICE_CUT_H

#include "ice/ice_view.h"

extern const ice_cut_geometry ice_embedded_geometry;
floe_status ice_cut_cells_create(ice *s);
void ice_cut_cells_destroy(context *ctx, struct ice_cut_cells **w);
/* Open fraction of a cell, and aperture of one of its faces, for a region at a position of the boundaries (CUT_NOW to
 * CUT_NEXT). */
double ice_open_cell(const ice *s, int region, int place, const int cell[3]);
double ice_open_face(const ice *s, int region, int place, const int cell[3], int axis, int side);
/* Merges the cells of the first states. */
floe_status ice_cut_merge_start(ice *s);
/* Hydrostatic equilibrium of gas at rest that is given by pressure and temperature; each connected part keeps the pressure of its highest
 * cell. */
floe_status ice_cut_hydrostatic(ice *s);

#endif

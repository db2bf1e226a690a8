/* Cells in the region of a load. */
#ifndef ICE_ICE_REGION_H
#define ICE_ICE_REGION_H

#include "ice/ice_internal.h"

/* Share of a cell that lies in a region; 1 where that has no model. */
double ice_region_share(const mesh *m, const shape *region, const int cell[MESH_MAX_DIM]);

#endif

/* Questions about the materials of the cells. */
#ifndef ICE_MATERIALS_H
#define ICE_MATERIALS_H

#include "ice/ice_view.h"

const ice_region *ice_region_of(const ice *s, int material);
/* Cells at interfaces between fluids of a region are found. */
bool ice_has_interfaces(const ice *s, const ice_region *g);
/* Mixed cells of a region are closed along isentropes: it has several fluids, or the energy of one depends on volume at given
 * temperature. */
bool ice_follows_isentropes(const ice *s, const ice_region *g);
/* Whether contact discontinuities of a single fluid are sharpened (C_CONTACT). */
bool ice_sharpens_contacts(const ice *s);

#endif

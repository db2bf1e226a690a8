/* Points in the region of a load. */
#ifndef MPM_REGION_H
#define MPM_REGION_H

#include "mpm/mpm.h"

/* Share of a point's box that lies in a region; 1 where that is NULL or has no model. */
double point_region_share(const mpm *s, const fields *f, int body, size_t k, const shape *region);

#endif

/* The pressure increment (theory 2.3), and the bulk viscosity in it (2.8). */
#ifndef ICE_PRESSURE_H
#define ICE_PRESSURE_H

#include "ice/ice_view.h"

floe_status ice_pressure_increment_of(ice *s, const ice_region *g);
/* Its parts: dP and P of whole cells; what points in the cells change, then ghosts; the ghosts alone. */
void ice_find_increment(const ice *s, const ice_region *g);
void ice_finish_increment(const ice *s, const ice_region *g);
void ice_fill_increment(const ice *s, const ice_region *g);

#endif

/* What crosses faces: velocities (theory 2.2), pressures (2.4), advection (2.11). */
#ifndef ICE_FLUX_H
#define ICE_FLUX_H

#include "ice/ice_view.h"

/* Doubles that one thread needs to advect. */
size_t ice_advect_buffer(const ice *s);
/* The stages of a region. */
floe_status ice_face_velocity_of(ice *s, const ice_region *g);
floe_status ice_face_pressure_of(ice *s, const ice_region *g);
floe_status ice_advect_of(ice *s, const ice_region *g);
/* The parts of the first: the sensors of the cells, and with their ghosts the velocities. */
void ice_find_cell_sensors(const ice *s, const ice_region *g);
void ice_find_face_velocity(const ice *s, const ice_region *g);

#endif

/* States of one fluid at faces: reconstructed in characteristic variables, traced to half the step, and met by a Riemann problem (theory 2.17). */
#ifndef ICE_TRACE_H
#define ICE_TRACE_H

#include "ice/ice_view.h"

/* Doubles that one thread needs. */
size_t ice_trace_buffer(const ice *s);
/* F_VEL, F_PRESSURE, and what crosses the faces (F_DONOR_DENSITY, F_DONOR_ENERGY, F_DONOR_VEL), of a region. Reads ghosts of the state. */
void ice_trace_faces(const ice *s, const ice_region *g);
/* What crosses the faces of a block where sides or viscosity have changed F_VEL: it has that velocity, and where it comes from the other side it is
 * what the cell there holds. */
void ice_trace_follow(const ice *s, const ice_view *v);

#endif

/* Bulk viscosity beside walls that a fluid slips along (ice_slip.c). */
#ifndef ICE_SLIP_H
#define ICE_SLIP_H

#include "ice/ice_internal.h"

void ice_relieve_slip(const ice *s, const ice_view *v);

#endif

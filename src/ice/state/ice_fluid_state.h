/* States of a fluid by its law. */
#ifndef ICE_FLUID_STATE_H
#define ICE_FLUID_STATE_H

#include "material/eos.h"

/* Density, energy and specific volume of a fluid. */
typedef struct ice_reservoir {
    double rho, e, T, v;
} ice_reservoir;
/* State of a law at a pressure and a temperature. */
ice_reservoir ice_state_at(const eos *law, double p, double T);

#endif

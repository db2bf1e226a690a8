/* What a cell was given to start with, and its fluids at other pressures: for columns at rest (theory 2.4). */
#ifndef ICE_GIVEN_H
#define ICE_GIVEN_H

#include "ice/ice_view.h"
#include "ice/state/ice_fluid_state.h"

typedef struct ice_given {
    const eos *law[ICE_MAX_MATERIALS]; /* NULL: the cell has none of that fluid */
    double theta[ICE_MAX_MATERIALS], density[ICE_MAX_MATERIALS], T[ICE_MAX_MATERIALS];
    double own[ICE_MAX_MATERIALS];         /* Pa: pressure of each fluid */
    bool keeps_density[ICE_MAX_MATERIALS]; /* else its temperature */
    double p, stiffness;                   /* Pa: of the first fluid; largest rho c^2 */
    int n;                                 /* materials */
} ice_given;

/* Gravity along an axis; 0 where nothing bears the weight: along a periodic one, and between open sides of one pressure. */
double ice_weight_along(const ice *s, int axis);
/* Adds a fluid with its volume fraction and its state; `pure` is the density of the fluid itself. */
void ice_given_add(ice_given *g, int r, const eos *law, bool by_density, double theta, double pure, double e);
/* What was given from one cell to another: 0 where that is round-off. */
double ice_given_rise(const ice_given *from, const ice_given *to);
/* Density of the cell at a pressure. */
double ice_given_density(const ice_given *g, double p);
/* Pressure p of the cell with p = base + weight (share rho(p) + other). */
double ice_given_settle(const ice_given *g, double base, double weight, double share, double other);
/* State of one fluid of it at a pressure of the cell. */
floe_status ice_given_state(const ice *s, const ice_given *g, int r, double p, ice_reservoir *out);

#endif

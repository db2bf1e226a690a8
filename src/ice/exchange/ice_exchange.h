/* Exchange of momentum, heat and mass between the materials of a cell (theory 2.9, 2.16), and the specific volumes after it (2.10). */
#ifndef ICE_EXCHANGE_H
#define ICE_EXCHANGE_H

#include "ice/ice_view.h"

/* Fills the coefficients of all pairs (ice_pairs.c). Errors: FLOE_BAD_INPUT where a law lacks something. */
floe_status ice_pairs_create(ice *s);
void ice_pairs_destroy(context *ctx, struct ice_pairs **w);
/* Some pair has a tangential law of its own; some coefficient depends on the state, or a pair slips. */
bool ice_some_pair_slips(const ice *s);
bool ice_some_pair_asks(const ice *s);
/* Exchanges momentum at the faces normal to `axis`: of velocities, one array a material, or of other quantities that
 * are exchanged in the same way. */
void ice_exchange_faces(const ice *s, const ice_view *v, int axis, double *const *value);

/* Moves heat that a shock has given the wrong fluid of a cell at an interface (ice_shock_heat.c). */
void ice_share_shock(const ice_view *v, ptrdiff_t at);

/* Reactions (ice_react.c). Errors: FLOE_BAD_INPUT for solids on points, FLOE_NO_MEMORY. */
floe_status ice_reactions_create(ice *s);
void ice_reactions_destroy(context *ctx, struct ice_reactions **w);
int ice_reaction_count(const ice *s);
/* Whether reaction k uses up a solid on points; any does. */
bool ice_burns(const ice *s, int k);
bool ice_some_solid_burns(const ice *s);
/* The pressure of new volume, added to the array P in owned cells. */
void ice_created_pressure(const ice *s, const ice_view *v, double *P);
double ice_created_pressure_at(const ice *s, const ice_view *v, ptrdiff_t at); /* Pa: of a cell, of the whole step */

/* The stages of a region. */
floe_status ice_wall_fraction_of(ice *s, const ice_region *g);
floe_status ice_react_of(ice *s, const ice_region *g);
floe_status ice_mass_exchange_of(ice *s, const ice_region *g);
floe_status ice_exchange_of(ice *s, const ice_region *g);
floe_status ice_specific_volume_of(ice *s, const ice_region *g);

#endif

/* Equilibrium of the materials of a cell: pressure, volume fractions, specific volumes (theory 2.1, 2.10). */
#ifndef ICE_EQUILIBRIUM_H
#define ICE_EQUILIBRIUM_H

#include "coupling/equilibrium.h"
#include "ice/ice_constants.h"
#include "ice/ice_view.h"

struct ice_cell_list;

/* Storage of regions of several materials; none without them. */
floe_status ice_closure_create(ice *s);
void ice_closure_destroy(context *ctx, struct ice_closure **w);
/* Gives cells that the closure of the current step has changed their state back. */
void ice_rollback_closure(ice *s);
/* Owned cells of a view with more than one material of its region. */
const struct ice_cell_list *ice_mixed_cells(const ice *s, const ice_view *v);
/* Pressure of a region, and of several materials its volume fractions (theory 2.1). */
floe_status ice_equilibrium_pressure_of(ice *s, const ice_region *g);

/* Specific volume of a material after a pressure increment (theory 2.10). Materials with a small volume fraction, and
 * `bound` ones, change by a factor of ten at most in a step. */
static inline double ice_specific_volume_after(const ice_fluid *m, ptrdiff_t at, double dP, bool bound)
{
    const double specific_volume = m->v[at], next = specific_volume - m->theta[at] * m->kappa[at] * dP / m->rho[at];
    const bool bounded = m->theta[at] < ICE_BOUND_FRACTION || bound;
    return bounded
               ? least(most(next, specific_volume / ICE_MOST_VOLUME_CHANGE), specific_volume * ICE_MOST_VOLUME_CHANGE)
               : next;
}

#endif

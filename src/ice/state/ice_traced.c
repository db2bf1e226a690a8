/* Which fluids have their faces from waves: those alone on whole cells, with the explicit pressure. */
#include "ice/state/ice_traced.h"

bool ice_may_trace(const ice *s)
{
    const scene_method *method = &s->scene->method;
    return !ice_is_mixture(s) && !s->cut && method->limiter == ICE_LIMITER_DEFAULT &&
           method->centring == ICE_CENTRING_AUTO && method->pressure != PRESSURE_IMPLICIT;
}

bool ice_is_traced(const ice *s, const ice_region *g)
{
    return g->n == 1 && ice_may_trace(s) && !s->implicit;
}

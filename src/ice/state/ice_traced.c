/* Which fluids have their faces from waves, with the explicit pressure: those alone on whole cells. */
#include "ice/state/ice_traced.h"

#include "coupling/exchange_law.h"
#include "ice/ice_constants.h"
#include "ice/state/ice_materials.h"

#include <string.h>

bool ice_may_trace(const ice *s)
{
    const scene_method *method = &s->scene->method;
    return method->limiter == ICE_LIMITER_DEFAULT && method->centring == ICE_CENTRING_AUTO &&
           method->pressure != PRESSURE_IMPLICIT;
}

bool ice_traces_in_part(const ice *s)
{
    return ice_is_mixture(s) || s->cut;
}

bool ice_traces_shared(const ice *s, const ice_region *g)
{
    if (!ice_has_interfaces(s, g)) return false;
    for (int r = g->first; r < g->first + g->n; ++r)
        for (int q = g->first; q < r; ++q)
            if (s->exchange.K[r][q] < EXCHANGE_LOCKED || s->exchange.Kt[r][q] < EXCHANGE_LOCKED) return false;
    return true;
}

bool ice_bears_unevenly(const ice *s, const ice_region *g)
{
    return (s->implicit || (ice_is_traced(s, g) && !s->cut)) && ice_traces_shared(s, g);
}

bool ice_is_traced(const ice *s, const ice_region *g)
{
    (void)g;
    return ice_may_trace(s) && !s->implicit;
}

/* 1 where the fluid is alone in a cell, and the cell whole, but for traces: what a surface on the cell's face cuts by round-off must not choose the method.
 * theta and open; NULL: 1. */
FLOE_ALWAYS_INLINE double is_whole(const double *theta, const double *open, ptrdiff_t at, const bool multi,
                                   const bool cut)
{
    const double alone = !multi || theta[at] > 1.0 - ICE_TRACE_FRACTION ? 1.0 : 0.0;
    return !cut || open[at] > 1.0 - ICE_TRACE_FRACTION ? alone : 0.0;
}

/* Parabolas reach two cells along each axis. */
FLOE_ALWAYS_INLINE void mark_traced_row(const ice_view *v, int r, ptrdiff_t base, const bool multi, const bool cut)
{
    const double *theta = v->m[r].theta, *open = v->m[r].open;
    double *restrict found = v->alone;
    const double number = 1 + r;
#pragma omp simd
    for (ptrdiff_t at = base - 1; at < base + v->b->n[0] + 1; ++at) {
        double alone = is_whole(theta, open, at, multi, cut);
        for (int a = 0; a < v->dim; ++a) {
            const ptrdiff_t st = v->b->stride[a];
            alone *= is_whole(theta, open, at - st, multi, cut) * is_whole(theta, open, at + st, multi, cut);
            alone *= is_whole(theta, open, at - 2 * st, multi, cut) * is_whole(theta, open, at + 2 * st, multi, cut);
        }
        found[at] = alone > 0.0 ? number : found[at];
    }
}

/* Where fluids move as one: whole cells within two cells along each axis that fluids fill, and in them the fluid that is alone, or that several share. */
FLOE_ALWAYS_INLINE void mark_shared_row(const ice_view *v, ptrdiff_t base, const bool cut)
{
    double *restrict found = v->alone;
    const double shared = ice_shared_number(v), *open = v->m[0].open;
    for (ptrdiff_t at = base - 1; at < base + v->b->n[0] + 1; ++at) found[at] = shared;
    for (int r = 0; r < v->n_materials; ++r) {
        const double *restrict theta = v->m[r].theta, *restrict kappa = v->m[r].kappa, *restrict all = v->kappa_sum,
                               *restrict rho = v->m[r].rho, *restrict mass = v->rho_sum,
                               *restrict interface = v->interface, number = 1 + r;
#pragma omp simd
        for (ptrdiff_t at = base - 1; at < base + v->b->n[0] + 1; ++at) {
            const double most_of_it = interface[at] > 0.0 ? ICE_TRACE_MAJORITY : ICE_TRACE_ALL_BUT_DROPS;
            const double share = least(theta[at], theta[at] * kappa[at] / all[at]);
            found[at] = share > most_of_it && rho[at] > ICE_TRACE_HALF_OF_MASS * mass[at] ? number : found[at];
        }
    }
    for (ptrdiff_t at = base - 1; cut && at < base + v->b->n[0] + 1; ++at) {
        double whole = is_whole(NULL, open, at, false, true);
        for (int a = 0; a < v->dim; ++a)
            for (int n = 1; n <= 2; ++n)
                whole *= is_whole(NULL, open, at - n * v->b->stride[a], false, true) *
                         is_whole(NULL, open, at + n * v->b->stride[a], false, true);
        found[at] *= whole;
    }
}

FLOE_WIDE static void find_shared_row(const ice_view *v, int j, int k)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    if (v->m[0].open)
        mark_shared_row(v, base, true);
    else
        mark_shared_row(v, base, false);
}

FLOE_WIDE static void find_alone_row(const ice_view *v, int j, int k)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    memset(v->alone + base - 1, 0, ((size_t)v->b->n[0] + 2) * sizeof *v->alone);
    for (int r = 0; r < v->n_materials; ++r) {
        if (v->material[r].points) continue;
        if (!v->multi)
            mark_traced_row(v, r, base, false, true);
        else if (v->m[r].open)
            mark_traced_row(v, r, base, true, true);
        else
            mark_traced_row(v, r, base, true, false);
    }
}

void ice_find_alone(const ice *s, const ice_region *g)
{
    ice_view v;
    ice_row *const row = ice_traces_shared(s, g) ? find_shared_row : find_alone_row;
    for (int id = 0; ice_next_view(s, g, &id, &v);) ice_run_cells(&v, 1, row);
}

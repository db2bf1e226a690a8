/* The equilibrium pressure stage (theory 2.1; Guilkey et al. 2003, step 2) of one fluid: p = p(rho, e), in batches
 * over rows. Several materials: ice_mixture.c. */
#include "ice/equilibrium/ice_closure.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_walk.h"

#include <float.h>
#include <math.h>

/* Turns c^2 into c and says whether all is well: p finite, c^2 > 0. */
static bool finish_row(const double *restrict p, double *restrict c, ptrdiff_t from, ptrdiff_t to)
{
    int bad = 0;
#pragma omp simd reduction(+ : bad)
    for (ptrdiff_t at = from; at < to; ++at) {
        bad += !(c[at] > 0.0) || !(fabs(p[at]) <= DBL_MAX);
        c[at] = sqrt(c[at]);
    }
    return bad == 0;
}

static floe_status explain_pressure_fault(const ice *s, const ice_view *v)
{
    const ice_fluid *m = &v->m[0];
    for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
        if (m->c[c.at] > 0.0 && fabs(v->p[c.at]) <= DBL_MAX) continue;
        char place[160];
        ice_place(s, v->b, c.at, v->first, place, sizeof place);
        return fail(s->ctx, FLOE_RETRY,
                    "equation of state, %s: density %g kg/m3 and internal energy %g J/kg give p = %g Pa, "
                    "c = %g m/s",
                    place, m->rho[c.at], m->e[c.at], v->p[c.at], m->c[c.at]);
    }
    return fail(s->ctx, FLOE_RETRY, "equation of state: a ghost cell has no sound speed");
}

static floe_status single_fluid(ice *s, const ice_view *v)
{
    const eos *law = &v->material[0].eos;
    const ice_fluid *m = &v->m[0];
    const ice_rows q = ice_rows_of(v->b, -1, MESH_GHOST);
    int bad = 0;
#pragma omp parallel for schedule(static) reduction(+ : bad)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t from = mesh_index(v->b, -MESH_GHOST, ice_row_j(q, row), ice_row_k(q, row));
        const ptrdiff_t n = v->b->n[0] + 2 * MESH_GHOST;
        law->model->pressure(law->par, (size_t)n, m->rho + from, m->e + from, v->p + from, m->c + from);
        bad += !finish_row(v->p, m->c, from, from + n);
    }
    return bad ? explain_pressure_fault(s, v) : FLOE_OK;
}

floe_status ice_equilibrium_pressure_of(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) TRY(v.multi ? ice_mixture(s, g, v.b->id, &v) : single_fluid(s, &v));
    return FLOE_OK;
}

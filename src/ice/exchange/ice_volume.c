/* Specific volumes after the Lagrangian step (theory 2.10, 5.5; Guilkey et al. 2003, step 11):
 *     (m v)^L = (m v) - V theta kappa dP,     dP = -D/S + beta (TMV/V - 1)/S,
 * so that the sum over materials grows by V D exactly. kappa is isentropic and holds the heating by compression; the
 * terms in alpha dT of exchange and loads change only how p divides the volume in the next step, which its
 * equilibrium determines anew. */
#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/exchange/ice_reactions.h"
#include "ice/state/ice_cells.h"

#include <math.h>

static bool row_volumes(const ice *s, const ice_view *v, int r, ptrdiff_t base)
{
    const ice_fluid *m = &v->m[r];
    const double beta = s->scene->method.volume_relaxation;
    double *out = v->material[r].points ? m->vol1 : m->vl;
    bool good = true;
    for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
        const double specific_volume = m->v[at];
        if (!(m->rho[at] > 0.0)) {
            out[at] = specific_volume;
            continue;
        }
        double dP = v->dP[at];
        if (v->tmv && ice_holds_points(v, at)) dP += beta * (v->tmv[at] - 1.0) / v->kappa_sum[at];
        const double next = ice_specific_volume_after(m, at, dP, v->material[r].points);
        good = good && next > 0.0;
        out[at] = next;
    }
    return good;
}

/* With new volume: (m v)^L = m v - V theta kappa dP - V theta' kappa dP' + S_v, dP' and theta' of ice_created. */
static bool reacted_volumes(const ice *s, const ice_view *v, ptrdiff_t base)
{
    bool good = true;
    for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
        const ice_creation c = ice_created(s, v, at);
        if (!c.any) continue;
        for (int r = 0; r < v->n_materials; ++r) {
            const ice_fluid *m = &v->m[r];
            const bool points = v->material[r].points;
            double *out = points ? &m->vol1[at] : &m->vl[at];
            const double mass = m->rhol[at], before = m->rho[at] > 0.0 ? m->rho[at] * *out : 0.0;
            if (!(mass > 0.0)) continue;
            *out = (before + c.volume[r] - c.theta[r] * m->kappa[at] * c.dP) / mass;
            good = good && *out > 0.0;
        }
    }
    return good;
}

static floe_status explain_volume_fault(const ice *s, const ice_view *v, int r, ptrdiff_t base)
{
    for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
        if (v->material[r].points || !(v->m[r].rho[at] > 0.0) || v->m[r].vl[at] > 0.0) continue;
        char place[160];
        ice_place(s, v->b, at, v->first + r, place, sizeof place);
        return fail(s->ctx, FLOE_RETRY,
                    "specific volume, %s: it would become %g m3/kg (before %g, dP = %g Pa, theta = %g)", place,
                    v->m[r].vl[at], v->m[r].v[at], v->dP[at], v->m[r].theta[at]);
    }
    return FLOE_OK;
}

static floe_status add_created(const ice *s, const ice_view *v)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        if (reacted_volumes(s, v, base)) continue;
        for (int r = 0; r < v->n_materials; ++r) TRY(explain_volume_fault(s, v, r, base));
    }
    return FLOE_OK;
}

floe_status ice_specific_volume_of(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, -1, 0);
        for (int r = 0; r < v.n_materials; ++r)
            for (int row = 0; row < q.n; ++row) {
                const ptrdiff_t base = ice_row_start(v.b, q, row);
                if (!row_volumes(s, &v, r, base)) TRY(explain_volume_fault(s, &v, r, base));
            }
        if (ice_reaction_count(s) > 0) TRY(add_created(s, &v));
    }
    return FLOE_OK;
}

/* States of merged cells that several fluids share (ice_merged_cells.h; theory 7.2). Densities refer to the open volume, as for one fluid; all members of a
 * merged cell have one state. After a step the contents of the members are summed and divided in proportion to their new open volumes. No member gives more
 * of a fluid than the merged cell contains. */
#include "ice/cut/ice_merged_cells.h"

#include "base/memory.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/fraction/ice_fraction.h"
#include "ice/ice_constants.h"

#include <math.h>
#include <string.h>

static double *fluid_sums(const ice_merged_cells *p, int merged, int r)
{
    return p->fluid + (size_t)(merged * p->region->n + r) * FLUID_SUMS;
}

/* ---- cells without fluids ---- */

static void clear_fluid(const ice_fluid *m, int dim, ptrdiff_t at)
{
    m->rho[at] = m->e[at] = m->vol[at] = 0.0;
    for (int a = 0; a < dim; ++a) m->u[a][at] = 0.0;
}

void ice_rest_fluids(const ice *s, const ice_view *v, ptrdiff_t at)
{
    const fluid_state *rest = &s->cut_cells->rest[v->region];
    for (int r = 0; r < v->n_materials; ++r) clear_fluid(&v->m[r], v->dim, at);
    v->m[0].rho[at] = rest->density;
    v->m[0].e[at] = rest->energy;
    v->m[0].vol[at] = 1.0 / rest->density;
}

void ice_extrapolate_fluids(const ice_view *v, ptrdiff_t at, double least)
{
    const int around = v->b->dim == 1 ? 3 : v->b->dim == 2 ? 9 : 27;
    double n = 0.0;
    for (int c = 0; c < around; ++c) n += v->shock[at + ice_step_to(v->b, c)] >= least;
    if (n == 0.0) return;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        double rho = 0.0, e = 0.0, vol = 0.0, u[3] = {0.0};
        for (int c = 0; c < around; ++c) {
            const ptrdiff_t from = at + ice_step_to(v->b, c);
            if (!(v->shock[from] >= least)) continue;
            rho += m->rho[from];
            e += m->rho[from] * m->e[from];
            vol += m->rho[from] * m->vol[from];
            for (int a = 0; a < v->dim; ++a) u[a] += m->rho[from] * m->u[a][from];
        }
        clear_fluid(m, v->dim, at);
        if (!(rho > 0.0)) continue;
        m->rho[at] = rho / n;
        m->e[at] = e / rho;
        m->vol[at] = vol / rho;
        for (int a = 0; a < v->dim; ++a) m->u[a][at] = u[a] / rho;
    }
    v->shock[at] = 0.5 * least;
}

/* ---- one state for all members ---- */

static const ice_member *lead_of(const ice_merged_cells *p, const ice_member *m)
{
    return &p->member[p->lead[m->merged]];
}

void ice_join_covered(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = lead_of(p, m);
        if (m->open > 0.0 || !(lead->open > 0.0)) continue;
        for (int r = 0; r < g->n; ++r) {
            const ice_fluid *to = &ice_member_view(s, m)->m[r], *from = &ice_member_view(s, lead)->m[r];
            to->rho[m->at] = from->rho[lead->at];
            to->e[m->at] = from->e[lead->at];
            to->vol[m->at] = from->vol[lead->at];
            for (int a = 0; a < s->mesh->dim; ++a) to->u[a][m->at] = from->u[a][lead->at];
        }
    }
}

/* What the closure makes of a cell. */
static void copy_closed(const ice_view *to, ptrdiff_t at, const ice_view *from, ptrdiff_t lead)
{
    to->p[at] = from->p[lead];
    to->kappa_sum[at] = from->kappa_sum[lead];
    to->rho_sum[at] = from->rho_sum[lead];
    to->mixed[at] = from->mixed[lead];
    for (int a = 0; a < to->dim; ++a) to->mean[a][at] = from->mean[a][lead];
    for (int r = 0; r < to->n_materials; ++r) {
        const ice_fluid *x = &to->m[r], *y = &from->m[r];
        x->rho[at] = y->rho[lead];
        x->e[at] = y->e[lead];
        x->vol[at] = y->vol[lead];
        x->v[at] = y->v[lead];
        x->T[at] = y->T[lead];
        x->theta[at] = y->theta[lead];
        x->c[at] = y->c[lead];
        x->kappa[at] = y->kappa[lead];
        for (int a = 0; a < to->dim; ++a) x->u[a][at] = y->u[a][lead];
    }
}

void ice_agree_closed(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    ice_cut_views(s, g);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = lead_of(p, m);
        ptrdiff_t at;
        if (!(lead->open > 0.0)) continue;
        for (int id = 0; ice_next_seen(s, m->cell, &id, &at);)
            copy_closed(&s->cut_cells->view[id - 1], at, ice_member_view(s, lead), lead->at);
    }
}

void ice_agree_reacted(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = lead_of(p, m);
        for (int n = 0; n < ice_reaction_count(s); ++n)
            ice_member_view(s, m)->reacted[n][m->at] = ice_member_view(s, lead)->reacted[n][lead->at];
    }
}

/* Merged cells lie at an interface where one of them does, and then all give sharp profiles. */
void ice_agree_interfaces(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    double *const mark = p->sum;
    for (int n = 0; n < p->count; ++n) mark[n] = 0.0;
    for (int k = 0; k < p->n; ++k)
        if (ice_member_view(s, &p->member[k])->interface[p->member[k].at] > 0.0) mark[p->member[k].merged] = 1.0;
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        field_get(s->domain->fields[m->block], C_INTERFACE, g->number, 0)[m->at] = mark[m->merged];
    }
    ice_spread_interfaces(s, g);
}

void ice_agree_exchanged(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = lead_of(p, m);
        const ice_view *to = ice_member_view(s, m), *from = ice_member_view(s, lead);
        to->owed[m->at] = from->owed[lead->at];
        for (int r = 0; r < g->n; ++r) {
            to->m[r].el[m->at] = from->m[r].el[lead->at];
            for (int a = 0; a < s->mesh->dim; ++a) to->m[r].ul[a][m->at] = from->m[r].ul[a][lead->at];
        }
    }
}

/* ---- the next state ---- */

/* Adds a volume of a fluid's state in a cell, the next one or the present one. */
static void add_state(const ice_fluid *m, int dim, ptrdiff_t at, bool next, double volume, double *sum)
{
    const double mass = volume * (next ? m->rho1 : m->rho)[at];
    double e = (next ? m->e1 : m->e)[at];
    if (!(mass > 0.0)) return; /* a small volume between the boundary and the body's shape: merging fills it */
    for (int a = 0; a < dim; ++a) {
        const double u = (next ? m->u1 : m->u)[a][at];
        sum[FLUID_MOMENTUM + a] += mass * u;
        e += 0.5 * u * u;
    }
    sum[FLUID_MASS] += mass;
    sum[FLUID_VOLUME] += mass * (next ? m->vol1 : m->vol)[at];
    sum[FLUID_ENERGY] += mass * e;
}

static void add_advected(const ice *s, const ice_member *k, int r, double *sum)
{
    const ice_fluid *m = &ice_member_view(s, k)->m[r];
    const ice_amount fluid = ice_advected(s, k, m);
    for (int a = 0; a < s->mesh->dim; ++a) sum[FLUID_MOMENTUM + a] += fluid.momentum[a];
    sum[FLUID_MASS] += fluid.advected - fluid.closed;
    sum[FLUID_VOLUME] += fluid.advected * m->vol1[k->at] - fluid.closed * m->vl[k->at];
    sum[FLUID_ENERGY] += fluid.energy;
}

/* Of all cells that were merged in the step, and the volume that they have open after it. */
static void sum_advected(const ice *s, ice_merged_cells *p)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_VOLUME] +=
            ice_member_view(s, m)->m[0].open1[m->at] * mesh_cell_volume(s->mesh, m->cell[0]);
        for (int r = 0; r < p->region->n; ++r) add_advected(s, m, r, fluid_sums(p, m->merged, r));
    }
}

/* A member's part of what those with which it was merged have together; one among covered ones takes what is its own. */
static void add_part(const ice *s, const ice_merged_cells *was, const ice_member *m, ice_merged_cells *p)
{
    const int before = was->place[cut_index(s->mesh, m->cell)];
    const double volume = m->open * mesh_cell_volume(s->mesh, m->cell[0]);
    const ice_view *v = ice_member_view(s, m);
    p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_VOLUME] += volume;
    for (int r = 0; r < p->region->n; ++r) {
        double *sum = fluid_sums(p, m->merged, r);
        if (before < 0) {
            add_state(&v->m[r], v->dim, m->at, true, volume, sum);
            continue;
        }
        const int merged = was->member[before].merged;
        const double all = was->sum[(size_t)merged * MERGED_SUMS + MERGED_VOLUME];
        if (all > 0.0)
            for (int n = 0; n < FLUID_SUMS; ++n) sum[n] += volume / all * fluid_sums(was, merged, r)[n];
        else
            add_advected(s, m, r, sum);
    }
}

/* Where a fluid of merged cells is too little, or too cold, to have a state (theory 6). */
typedef struct remains {
    const ice *s;
    const ice_member *lead;
    const ice_fluid *m;
    const eos *law;
    double volume; /* m3 of the merged cells */
    double *sum;
    bool next;
} remains;

static void enter_removed(const remains *q, const double *before)
{
    double x[MESH_MAX_DIM] = {0.0};
    if (!q->next) return;
    for (int a = 0; a < q->s->mesh->dim; ++a) {
        x[a] = mesh_centre(q->s->mesh, a, q->lead->cell[a]);
        if (a > 0 || q->s->mesh->geometry != MESH_AXISYMMETRIC)
            ledger_push(q->s->ledger, LEDGER_DEFECT, a, q->sum[FLUID_MOMENTUM + a] - before[FLUID_MOMENTUM + a], x);
    }
    ledger_add(q->s->ledger, LEDGER_MASS, LEDGER_DEFECT, q->sum[FLUID_MASS] - before[FLUID_MASS]);
    ledger_add(q->s->ledger, LEDGER_ENERGY, LEDGER_DEFECT, q->sum[FLUID_ENERGY] - before[FLUID_ENERGY]);
}

static void remove_fluid(const remains *q)
{
    double before[FLUID_SUMS];
    memcpy(before, q->sum, sizeof before);
    memset(q->sum, 0, sizeof before);
    enter_removed(q, before);
}

/* Internal energy (J/kg), and whether the law has a temperature there. */
static bool has_temperature(const remains *q, double *e)
{
    const double mass = q->sum[FLUID_MASS], density = mass / q->sum[FLUID_VOLUME];
    double square = 0.0, T;
    for (int a = 0; a < q->s->mesh->dim; ++a) square += pow(q->sum[FLUID_MOMENTUM + a] / mass, 2.0);
    *e = q->sum[FLUID_ENERGY] / mass - 0.5 * square;
    if (!(density > 0.0) || !isfinite(density) || !(*e > q->law->model->energy_floor(q->law->par, density)))
        return false;
    q->law->model->temperature(q->law->par, 1, &density, e, &T);
    return T > 0.0 && isfinite(T);
}

/* A small volume fraction gets the last temperature at the last pressure. */
static bool mend_fluid(const remains *q)
{
    const ice_view *v = ice_member_view(q->s, q->lead);
    const double T = q->m->T[q->lead->at], p = v->p[q->lead->at], mass = q->sum[FLUID_MASS];
    double before[FLUID_SUMS], square = 0.0;
    if (!q->next || !(T > 0.0) || !(p > q->law->model->pressure_floor(q->law->par))) return false;
    double v_now, dvdp, e;
    q->law->model->volume(q->law->par, 1, &p, &T, &v_now, &dvdp);
    const double density = 1.0 / v_now;
    q->law->model->energy(q->law->par, 1, &density, &T, &e);
    memcpy(before, q->sum, sizeof before);
    for (int a = 0; a < q->s->mesh->dim; ++a) {
        q->sum[FLUID_MOMENTUM + a] = mass * q->m->u[a][q->lead->at];
        square += pow(q->m->u[a][q->lead->at], 2.0);
    }
    q->sum[FLUID_VOLUME] = mass * v_now;
    q->sum[FLUID_ENERGY] = mass * (e + 0.5 * square);
    enter_removed(q, before);
    ledger_tally(q->s->ledger, COUNT_FLOORS, 1);
    return true;
}

/* False if the remaining mass and energy are no valid state. */
static bool settle_fluid(const remains *q, double all)
{
    double e;
    const double fraction = q->sum[FLUID_VOLUME] / q->volume, mass = q->sum[FLUID_MASS];
    if (mass == 0.0) {
        memset(q->sum, 0, FLUID_SUMS * sizeof *q->sum);
        return true;
    }
    if (fabs(mass) < ICE_LEAST_SHARE * all || (fabs(fraction) < ICE_LEAST_FRACTION && fabs(mass) < 1e-9 * all)) {
        remove_fluid(q);
        return true;
    }
    if (!(mass > 0.0) || !isfinite(mass)) return false;
    if (has_temperature(q, &e)) return true;
    if (!(fraction < ICE_TRACE_FRACTION)) return false;
    if (!mend_fluid(q)) remove_fluid(q);
    return true;
}

/* All fluids of merged cells; none is left of a gap that closes, or that no fluid has reached. */
static floe_status settle_merged(ice *s, ice_merged_cells *p, int merged, bool next)
{
    double *sum = p->sum + (size_t)merged * MERGED_SUMS, all = 0.0, thinnest = INFINITY;
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_region *g = p->region;
    for (int r = 0; r < g->n; ++r) {
        all += fluid_sums(p, merged, r)[FLUID_MASS];
        thinnest = fmin(thinnest, s->cut_cells->usual[g->first + r]);
    }
    const double volume = sum[MERGED_VOLUME], cell = mesh_cell_volume(s->mesh, lead->cell[0]);
    if (ice_is_void(cell, volume, all, thinnest, next)) sum[MERGED_VOLUME] = 0.0;
    if (sum[MERGED_VOLUME] == 0.0 && (volume > 0.0 || all == 0.0)) return FLOE_OK;
    for (int r = 0; r < g->n; ++r) {
        const remains q = {s,
                           lead,
                           &ice_member_view(s, lead)->m[r],
                           &s->material[g->first + r].eos,
                           volume,
                           fluid_sums(p, merged, r),
                           next};
        if (volume > 0.0 && settle_fluid(&q, all)) continue;
        sum[MERGED_MASS] = q.sum[FLUID_MASS];
        return ice_bad_merged_cells(s, p, merged, q.sum[FLUID_ENERGY] / q.sum[FLUID_MASS]);
    }
    return FLOE_OK;
}

/* The state of one fluid that has `sum` in a volume. */
static void store_fluid(const ice_fluid *m, int dim, ptrdiff_t at, bool next, double volume, const double *sum)
{
    double *rho = next ? m->rho1 : m->rho, *e = next ? m->e1 : m->e, *vol = next ? m->vol1 : m->vol;
    const double mass = volume > 0.0 ? sum[FLUID_MASS] : 0.0, inverse = mass > 0.0 ? 1.0 / mass : 0.0;
    double square = 0.0;
    for (int a = 0; a < dim; ++a) {
        const double u = sum[FLUID_MOMENTUM + a] * inverse;
        (next ? m->u1 : m->u)[a][at] = u;
        square += u * u;
    }
    rho[at] = mass > 0.0 ? mass / volume : 0.0;
    vol[at] = sum[FLUID_VOLUME] * inverse;
    e[at] = mass > 0.0 ? sum[FLUID_ENERGY] * inverse - 0.5 * square : 0.0;
}

static void store_member(const ice *s, const ice_merged_cells *p, const ice_member *m, bool next)
{
    const ice_view *v = ice_member_view(s, m);
    const double volume = p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_VOLUME];
    for (int r = 0; r < p->region->n; ++r) {
        if (volume == 0.0) (next ? v->m[r].open1 : v->m[r].open)[m->at] = 0.0;
        store_fluid(&v->m[r], v->dim, m->at, next, volume, fluid_sums(p, m->merged, r));
    }
}

static floe_status store_merged(ice *s, ice_merged_cells *p, bool next)
{
    for (int merged = 0; merged < p->count; ++merged) TRY(settle_merged(s, p, merged, next));
    for (int k = 0; k < p->n; ++k)
        if (p->member[k].open > 0.0) store_member(s, p, &p->member[k], next);
    return FLOE_OK;
}

/* Cells that were merged in the step, and are not after it. */
static void release_members(const ice *s, const ice_merged_cells *was, const ice_merged_cells *p)
{
    for (int k = 0; k < was->n; ++k)
        if (p->place[cut_index(s->mesh, was->member[k].cell)] < 0) store_member(s, was, &was->member[k], true);
}

floe_status ice_renew_fluids(ice *s, const ice_region *g)
{
    ice_merged_cells *was = &s->cut_cells->now[g->number], *p = &s->cut_cells->next[g->number];
    sum_advected(s, was);
    for (int merged = 0; merged < was->count; ++merged)
        if (was->sum[(size_t)merged * MERGED_SUMS + MERGED_VOLUME] > 0.0) TRY(settle_merged(s, was, merged, true));
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) add_part(s, was, &p->member[k], p);
    release_members(s, was, p);
    return store_merged(s, p, true);
}

/* ---- the start ---- */

static bool has_fluid(const ice_view *v, ptrdiff_t at)
{
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].rho[at] > 0.0) return true;
    return false;
}

/* Sums of what all members have now. */
static void sum_members(const ice *s, ice_merged_cells *p)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const ice_view *v = ice_member_view(s, m);
        const double volume = m->open * mesh_cell_volume(s->mesh, m->cell[0]);
        if (!has_fluid(v, m->at)) continue;
        p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_VOLUME] += volume;
        for (int r = 0; r < p->region->n; ++r)
            add_state(&v->m[r], v->dim, m->at, false, volume, fluid_sums(p, m->merged, r));
    }
}

floe_status ice_start_fluids(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->now[g->number];
    sum_members(s, p);
    return store_merged(s, p, false);
}

static bool is_unlike(const ice *s, const ice_member *m, const ice_member *lead)
{
    const ice_view *a = ice_member_view(s, m), *b = ice_member_view(s, lead);
    for (int r = 0; r < a->n_materials; ++r)
        if (a->m[r].rho[m->at] != b->m[r].rho[lead->at] || a->m[r].e[m->at] != b->m[r].e[lead->at]) return true;
    return false;
}

/* Which cells are merged depends on their contents, and in the last step on those before it: cells that belong together now
 * are merged now. */
floe_status ice_remerge_fluids(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->now[g->number];
    bool *unlike;
    floe_status status = FLOE_OK;
    TRY(memory_new(s->ctx, &unlike, (size_t)p->count + 1, sizeof *unlike));
    for (int k = 0; k < p->n; ++k)
        if (p->member[k].open > 0.0 && is_unlike(s, &p->member[k], lead_of(p, &p->member[k])))
            unlike[p->member[k].merged] = true;
    sum_members(s, p);
    for (int merged = 0; merged < p->count && status == FLOE_OK; ++merged)
        if (unlike[merged]) status = settle_merged(s, p, merged, false);
    for (int k = 0; k < p->n && status == FLOE_OK; ++k)
        if (unlike[p->member[k].merged] && p->member[k].open > 0.0) store_member(s, p, &p->member[k], false);
    memory_free(s->ctx, &unlike);
    return status;
}

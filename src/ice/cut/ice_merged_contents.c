/* What merged cells hold: the sums of their members, after advection and at the start, and from them one density, velocity and energy for all members
 * (theory 7.1). */
#include "ice/cut/ice_merged_cells.h"

#include "base/memory.h"
#include "ice/flux/ice_flux.h"
#include "ice/ice_constants.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_walk.h"

#include <math.h>
#include <stdio.h>

ice_amount ice_advected(const ice *s, const ice_member *k, const ice_fluid *m)
{
    const ptrdiff_t at = k->at;
    const double volume = mesh_cell_volume(s->mesh, k->cell[0]);
    ice_amount out = {.advected = m->rho1[at] * volume, .closed = (1.0 - m->open[at]) * m->rho[at] * volume};
    double old = m->el[at], now = m->e1[at];
    for (int a = 0; a < s->mesh->dim; ++a) {
        old += 0.5 * m->ul[a][at] * m->ul[a][at];
        now += 0.5 * m->u1[a][at] * m->u1[a][at];
        out.momentum[a] = out.advected * m->u1[a][at] - out.closed * m->ul[a][at];
    }
    out.energy = out.advected * now - out.closed * old;
    return out;
}

static void add_contents(const ice *s, const ice_member *k, double *sum)
{
    const ice_amount gas = ice_advected(s, k, &ice_member_view(s, k)->m[0]);
    for (int a = 0; a < s->mesh->dim; ++a) sum[MERGED_MOMENTUM + a] += gas.momentum[a];
    sum[MERGED_MASS] += gas.advected - gas.closed;
    sum[MERGED_WORK] += gas.energy;
}

/* ---- merged cells whose members the next step has in different ones ----
 *
 * Fluxes and pressure are those of the merged cell; a member alone has more or less than its part of what they leave, by up to what passes its faces in the
 * step. That cancels in the sum. So the sum, not what each member has, is divided. */

enum { NOT_YET = -1, DIVIDED = -2 };

/* Whether gas has reached a member: a covered cell without has no part of its merged cell. */
static bool has_contents(const ice *s, const ice_merged_cells *was, const ice_member *k)
{
    const ice_amount gas = ice_advected(s, k, &ice_member_view(s, k)->m[0]);
    const double round_off =
        ICE_OPEN_ROUND_OFF * s->cut_cells->rest[was->region->number].density * mesh_cell_volume(s->mesh, k->cell[0]);
    return k->open > 0.0 || fabs(gas.advected - gas.closed) > round_off;
}

/* Sums of all merged cells of the step, with their volumes after it, and the merged cell of the next to which each goes, or that it is divided. */
static void find_divided(const ice *s, ice_merged_cells *was, const ice_merged_cells *p, int *to)
{
    ice_clear_merged(was);
    for (int n = 0; n < was->count; ++n) to[n] = NOT_YET;
    for (int k = 0; k < was->n; ++k) {
        const ice_member *m = &was->member[k];
        double *sum = was->sum + (size_t)m->merged * MERGED_SUMS;
        if (!has_contents(s, was, m)) continue;
        add_contents(s, m, sum);
        sum[MERGED_VOLUME] += ice_member_view(s, m)->m[0].open1[m->at] * mesh_cell_volume(s->mesh, m->cell[0]);
        const int place = p->place[cut_index(s->mesh, m->cell)];
        const int after = place < 0 ? p->count + k : p->member[place].merged; /* no member any more: by itself */
        to[m->merged] = to[m->merged] == NOT_YET || to[m->merged] == after ? after : DIVIDED;
    }
}

/* The sums of the merged cell of which a cell has its part by volume; NULL: it has what is its own. */
static const double *divided_sums(const ice *s, const ice_merged_cells *was, const int *to, const int cell[3])
{
    const int place = was->place[cut_index(s->mesh, cell)];
    if (place < 0 || !was->sum) return NULL;
    const ice_member *m = &was->member[place];
    const double *sum = was->sum + (size_t)m->merged * MERGED_SUMS;
    return to[m->merged] == DIVIDED && sum[MERGED_VOLUME] > 0.0 && has_contents(s, was, m) ? sum : NULL;
}

static void add_divided(const double *all, double volume, int dim, double *sum)
{
    const double share = volume / all[MERGED_VOLUME];
    sum[MERGED_MASS] += share * all[MERGED_MASS];
    sum[MERGED_WORK] += share * all[MERGED_WORK];
    for (int a = 0; a < dim; ++a) sum[MERGED_MOMENTUM + a] += share * all[MERGED_MOMENTUM + a];
}

/* The part of a cell that is no member any more. */
static void release_member(const ice *s, const ice_member *k, const double *all)
{
    const ice_fluid *m = &ice_member_view(s, k)->m[0];
    double square = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        m->u1[a][k->at] = all[MERGED_MOMENTUM + a] / all[MERGED_MASS];
        square += m->u1[a][k->at] * m->u1[a][k->at];
    }
    m->rho1[k->at] = all[MERGED_MASS] / all[MERGED_VOLUME];
    m->e1[k->at] = all[MERGED_WORK] / all[MERGED_MASS] - 0.5 * square;
}

/* What the members have after the step: each its own, or its part of what was divided. */
static floe_status collect_contents(const ice *s, ice_merged_cells *was, ice_merged_cells *p)
{
    int *to;
    TRY(memory_new(s->ctx, &to, (size_t)was->count + 1, sizeof *to));
    find_divided(s, was, p, to);
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const double *all = divided_sums(s, was, to, m->cell), volume = m->open * mesh_cell_volume(s->mesh, m->cell[0]);
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        sum[MERGED_VOLUME] += volume;
        if (all)
            add_divided(all, volume, s->mesh->dim, sum);
        else
            add_contents(s, m, sum);
    }
    for (int k = 0; k < was->n; ++k) {
        const ice_member *m = &was->member[k];
        const double *all = divided_sums(s, was, to, m->cell);
        if (all && p->place[cut_index(s->mesh, m->cell)] < 0) release_member(s, m, all);
    }
    memory_free(s->ctx, &to);
    return FLOE_OK;
}

static void renew_open(const ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);)
            for (int r = 0; r < v->n_materials; ++r)
                v->m[r].open1[c.at] = ice_open_cell(s, g->number, CUT_NEXT, c.cell);
    }
}

/* Cells away from the boundary that are closed to the gas are empty. */
static void empty_elsewhere(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);)
            for (int r = 0; r < v->n_materials; ++r) {
                const ice_fluid *m = &v->m[r];
                if (m->open1[c.at] > 0.0) continue;
                m->rho1[c.at] = m->e1[c.at] = 0.0;
                for (int a = 0; a < s->mesh->dim; ++a) m->u1[a][c.at] = 0.0;
            }
    }
}

floe_status ice_bad_merged_cells(const ice *s, const ice_merged_cells *p, int merged, double e)
{
    const double *sum = p->sum + (size_t)merged * MERGED_SUMS;
    const ice_member *lead = &p->member[p->lead[merged]];
    char place[160];
    ice_place(s, &s->mesh->block[lead->block], lead->at, p->region->first, place, sizeof place);
    const bool sharp = scene_enclosing_body(s->scene) < 0;
    return fail(s->ctx, FLOE_RETRY, "gas at the %s, %s: %g kg in %g m3 at %g J/kg would be left in its cells%s",
                sharp ? "surface of a solid" : "membrane", place, sum[MERGED_MASS], sum[MERGED_VOLUME], e,
                sharp ? ": sharp ends where solids come to touch each other or a side; use method.interface: smeared"
                      : "");
}

/* A gap between bodies in contact, closed to all others, opens by round-off where their surfaces, straight between different markers, lie on one another, and
 * may grow. At the start it holds nothing, though a fluid may fill its place in the scene; advection leaves round-off in it. */
bool ice_is_void(double cell, double volume, double mass, double density, bool next)
{
    const bool small = volume < ICE_GAP_FRACTION * cell;
    if (!next) return small;
    return fabs(mass) <= ICE_GAP_ROUND_OFF * density * cell ||
           (small && fabs(mass) <= ICE_GAP_DENSITY * density * volume);
}

static bool is_void(const ice *s, const ice_merged_cells *p, int merged, bool next)
{
    const double *sum = p->sum + (size_t)merged * MERGED_SUMS;
    return ice_is_void(mesh_cell_volume(s->mesh, p->member[p->lead[merged]].cell[0]), sum[MERGED_VOLUME],
                       sum[MERGED_MASS], s->cut_cells->rest[p->region->number].density, next);
}

static void empty_cell(const ice_fluid *m, int dim, ptrdiff_t at, bool next)
{
    (next ? m->open1 : m->open)[at] = (next ? m->rho1 : m->rho)[at] = (next ? m->e1 : m->e)[at] = 0.0;
    for (int a = 0; a < dim; ++a) (next ? m->u1 : m->u)[a][at] = 0.0;
}

/* One density, velocity and energy for the members of each merged cell. */
static floe_status share_out(ice *s, const ice_merged_cells *p, bool next)
{
    for (int merged = 0; merged < p->count; ++merged) {
        double *sum = p->sum + (size_t)merged * MERGED_SUMS, square = 0.0;
        if (sum[MERGED_VOLUME] == 0.0 && sum[MERGED_MASS] == 0.0) continue;
        if (is_void(s, p, merged, next)) {
            sum[MERGED_VOLUME] = 0.0;
            continue;
        }
        for (int a = 0; a < s->mesh->dim; ++a) {
            sum[MERGED_MOMENTUM + a] /= sum[MERGED_MASS];
            square += sum[MERGED_MOMENTUM + a] * sum[MERGED_MOMENTUM + a];
        }
        sum[MERGED_WORK] = sum[MERGED_WORK] / sum[MERGED_MASS] - 0.5 * square;
        const double rho = sum[MERGED_MASS] / sum[MERGED_VOLUME];
        const eos *law = &s->material[p->region->first].eos;
        if (!(rho > 0.0) || !isfinite(rho) || !(sum[MERGED_WORK] > law->model->energy_floor(law->par, rho)))
            return ice_bad_merged_cells(s, p, merged, sum[MERGED_WORK]);
        sum[MERGED_MASS] = rho;
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *member = &p->member[k];
        const ice_fluid *m = &s->cut_cells->view[member->block].m[0];
        const double *sum = p->sum + (size_t)member->merged * MERGED_SUMS;
        if (!(member->open > 0.0)) continue;
        if (sum[MERGED_VOLUME] == 0.0) {
            empty_cell(m, s->mesh->dim, member->at, next);
            continue;
        }
        (next ? m->rho1 : m->rho)[member->at] = sum[MERGED_MASS];
        (next ? m->e1 : m->e)[member->at] = sum[MERGED_WORK];
        for (int a = 0; a < s->mesh->dim; ++a) (next ? m->u1 : m->u)[a][member->at] = sum[MERGED_MOMENTUM + a];
    }
    return FLOE_OK;
}

floe_status ice_advect_merged(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->next[g->number];
    TRY(ice_advect_of(s, g));
    ice_cut_views(s, g);
    for (int id = 0; id < s->mesh->n_blocks; ++id) ice_view_lagrangian(&s->cut_cells->view[id]);
    TRY(ice_merge_cells(s, MERGE_AFTER, p));
    ledger_tally(s->ledger, COUNT_CELLS_MERGED, p->n - p->count);
    renew_open(s, g);
    if (g->n > 1) {
        TRY(ice_renew_fluids(s, g));
        empty_elsewhere(s);
        return FLOE_OK;
    }
    TRY(collect_contents(s, &s->cut_cells->now[g->number], p));
    empty_elsewhere(s);
    return share_out(s, p, true);
}

/* ---- the start ---- */

static void add_first_contents(const ice *s, const ice_member *k, double *sum)
{
    const ice_fluid *m = &s->cut_cells->view[k->block].m[0];
    const ptrdiff_t at = k->at;
    const double volume = k->open * mesh_cell_volume(s->mesh, k->cell[0]), mass = volume * m->rho[at];
    double e = m->e[at];
    if (!(mass > 0.0)) return; /* a small volume between the boundary and the body's shape: merging fills it */
    for (int a = 0; a < s->mesh->dim; ++a) {
        sum[MERGED_MOMENTUM + a] += mass * m->u[a][at];
        e += 0.5 * m->u[a][at] * m->u[a][at];
    }
    sum[MERGED_MASS] += mass;
    sum[MERGED_WORK] += mass * e;
    sum[MERGED_VOLUME] += volume;
}

static bool holds_fluid(const ice_view *v, ptrdiff_t at)
{
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].rho[at] > 0.0) return true;
    return false;
}

static floe_status refuse_empty(const ice *s, const ice_view *v, const int cell[3])
{
    char place[64];
    (void)snprintf(place, sizeof place, s->mesh->dim == 3 ? "(%g, %g, %g)" : "(%g, %g)", mesh_node(s->mesh, 0, cell[0]),
                   mesh_node(s->mesh, 1, cell[1]), mesh_node(s->mesh, 2, cell[2]));
    return fail_key(s->ctx, KEY("ambient"),
                    "the membrane leaves the cell at %s to gas '%s', and no body of it is there: let bodies fill its "
                    "side of the membrane (the gas that a membrane `encloses` is on the left of a curve, inside a "
                    "surface, and behind first x second of a plane), or make it the `ambient`",
                    place, s->scene->material[v->material[0].scene_material].name);
}

/* Checks that bodies fill the open volume of every gas. */
static floe_status find_empty(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        const ice_rows q = ice_rows_of(v->b, -1, 0);
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v->b->n[0]; ++i) {
                const int j = ice_row_j(q, row), k = ice_row_k(q, row);
                const ptrdiff_t at = mesh_index(v->b, i, j, k);
                if (!(v->m[0].open[at] > 0.0) || holds_fluid(v, at)) continue;
                return refuse_empty(s, v, (const int[]){v->b->lo[0] + i, v->b->lo[1] + j, v->b->lo[2] + k});
            }
    }
    return FLOE_OK;
}

floe_status ice_start_merged(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->now[g->number];
    ice_cut_views(s, g);
    TRY(ice_merge_cells(s, MERGE_BEFORE, p));
    ice_clear_merged(p);
    if (g->n > 1) TRY(ice_start_fluids(s, g));
    for (int k = 0; k < p->n && g->n == 1; ++k)
        add_first_contents(s, &p->member[k], p->sum + (size_t)p->member[k].merged * MERGED_SUMS);
    if (g->n == 1) TRY(share_out(s, p, false));
    return find_empty(s);
}

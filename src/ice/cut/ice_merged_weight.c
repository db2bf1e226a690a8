/* Gravity in merged cells (ice_merged_cells.h; theory 7.4), and gas at rest between walls. Merged cells have one density, and one pressure P at the centroid
 * of their open volume; elsewhere in them the pressure is P + rho g . (x - centroid), whose forces on faces and pieces add up to their weight (Gauss). The
 * stages of whole cells use the pressure at the centres of cells, so that their differences balance as those of a plain column do (theory 2.4). */
#include "ice/cut/ice_merged_cells.h"
#include "ice/state/ice_given.h"
#include "ice/state/ice_lean.h"
#include "ice/state/ice_traced.h"

#include "base/memory.h"
#include "scene/fluid_columns.h"

#include <math.h>
#include <string.h>

static const int most_passes = 20; /* of densities and where they lie in cells, at the start */

bool ice_has_weight(const ice *s)
{
    return s->gravity[0] != 0.0 || s->gravity[1] != 0.0 || s->gravity[2] != 0.0;
}

/* Moment (m) of what a gas has of a cell about the cell's centre, over the cell's volume. */
static double moment_of(const ice *s, int region, int place, const int cell[3], int axis)
{
    const ice_embedded_boundary *line = s->embedded.boundary;
    const int about = ice_line_about(s, region);
    double enclosed = 0.0;
    for (int l = 0; l < s->embedded.n_boundaries; ++l)
        if (line[l].within == about && l != about) enclosed += cut_moment(&line[l].place[place], cell, axis);
    if (about < 0) return -enclosed;
    const double whole = cut_moment(&line[about].place[place], cell, axis);
    return enclosed == 0.0 ? whole : whole - enclosed;
}

/* Place of a member's cell (m), of its images around periodic sides that beside the first member of its merged cell. */
static double centre_beside_lead(const ice *s, const ice_merged_cells *p, const ice_member *m, int axis)
{
    const double x = mesh_centre(s->mesh, axis, m->cell[axis]);
    return x + mesh_to_image(s->mesh, axis, x, mesh_centre(s->mesh, axis, p->member[p->lead[m->merged]].cell[axis]));
}

void ice_merged_centre(const ice *s, int place, ice_merged_cells *p)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        ice_member *m = &p->member[k];
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        const double volume = mesh_cell_volume(s->mesh, m->cell[0]);
        sum[MERGED_VOLUME] += m->open * volume;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double moment =
                m->open > 0.0 && m->open < 1.0 ? moment_of(s, p->region->number, place, m->cell, a) : 0.0;
            sum[MERGED_MOMENTUM + a] += volume * (m->open * centre_beside_lead(s, p, m, a) + moment);
            m->own[a] = m->open > 0.0 ? moment / m->open : 0.0;
        }
    }
    for (int k = 0; k < p->n; ++k) {
        ice_member *m = &p->member[k];
        const double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        for (int a = 0; a < s->mesh->dim; ++a)
            m->above[a] = sum[MERGED_VOLUME] > 0.0
                              ? centre_beside_lead(s, p, m, a) - sum[MERGED_MOMENTUM + a] / sum[MERGED_VOLUME]
                              : 0.0;
    }
}

/* Under cells that bear their weight evenly. */
static double even_rise(const ice *s, const ice_merged_cells *p, const ice_member *m, const double from_centre[3])
{
    const ice_member *lead = &p->member[p->lead[m->merged]];
    double sum = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) sum += s->gravity[a] * (m->above[a] + from_centre[a]);
    return s->cut_cells->view[lead->block].rho_sum[lead->at] * sum;
}

double ice_merged_rise(const ice *s, const ice_merged_cells *p, const ice_member *m)
{
    static const double centre[3] = {0.0};
    return even_rise(s, p, m, centre);
}

/* Along an axis, from the mean pressure of a member's cell to a place from its centre (m). */
static double rise_along(const ice *s, const ice_member *m, int axis, double from_centre)
{
    const ice_view *v = ice_member_view(s, m);
    const ptrdiff_t st = v->b->stride[axis];
    const double *rho = v->rho_sum, *open = v->m[0].open, here = rho[m->at], z = from_centre / v->h[axis];
    if (s->gravity[axis] == 0.0) return 0.0;
    const bool alone = !(open[m->at - st] > 0.0 && open[m->at] > 0.0 && open[m->at + st] > 0.0);
    return s->gravity[axis] * v->h[axis] *
           (alone ? here * z : ice_mass_up_to(rho[m->at - st], here, rho[m->at + st], z));
}

double ice_rise_to_piece(const ice *s, const ice_merged_cells *p, const ice_member *m, const double from_centre[3])
{
    if (!ice_member_view(s, m)->uneven) return even_rise(s, p, m, from_centre);
    double sum = ice_merged_rise(s, p, m);
    for (int a = 0; a < s->mesh->dim; ++a) sum += rise_along(s, m, a, from_centre[a]);
    return sum;
}

double ice_rise_to_face(const ice *s, const ice_merged_cells *p, const ice_member *m, int axis, int side)
{
    double x[3] = {0.0};
    x[axis] = (side == SIDE_UPPER ? 0.5 : -0.5) * s->mesh->h[axis];
    if (!ice_member_view(s, m)->uneven) return even_rise(s, p, m, x);
    return ice_merged_rise(s, p, m) + rise_along(s, m, axis, x[axis]);
}

bool ice_next_seen(const ice *s, const int cell[3], int *id, ptrdiff_t *at)
{
    for (; *id < s->mesh->n_blocks; ++*id) {
        const block *b = &s->mesh->block[*id];
        bool seen = true;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const int local = cell[a] - b->lo[a];
            seen = seen && local >= -MESH_GHOST && local < b->n[a] + MESH_GHOST;
        }
        if (!seen) continue;
        *at = mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], cell[2] - b->lo[2]);
        ++*id;
        return true;
    }
    return false;
}

/* Sets the pressure of a cell in its block, and in those that see it as a ghost. */
static void set_cell_pressure(const ice *s, const ice_member *m, double p)
{
    ptrdiff_t at;
    for (int id = 0; ice_next_seen(s, m->cell, &id, &at);) s->cut_cells->view[id - 1].p[at] = p;
}

void ice_merged_lift(const ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->now[g->number];
    ice_cut_views(s, g);
    for (int n = 0; n < p->count; ++n) {
        const ice_member *lead = &p->member[p->lead[n]];
        p->sum[(size_t)n * MERGED_SUMS] = s->cut_cells->view[lead->block].p[lead->at];
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        set_cell_pressure(s, m, p->sum[(size_t)m->merged * MERGED_SUMS] + ice_merged_rise(s, p, m));
    }
}

bool ice_is_merged(const ice *s, int region, const block *b, int i, int j, int k)
{
    const int cell[3] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
    const size_t at = cut_index(s->mesh, cell);
    return s->cut_cells->now[region].place[at] >= 0 || ice_open_cell(s, region, CUT_NOW, cell) == 0.0;
}

/* ---- the start ---- */

/* Connected parts of a gas, filled cell by cell from the highest one of each. */
typedef struct rest_fill {
    ice *s;
    const ice_merged_cells *p;
    double *lean[MESH_MAX_DIM]; /* kg/m3, of every cell (ice_lean.h), where cells bear weight unevenly; owned */
    double *pressure;           /* Pa, of every cell; NaN: not reached; owned */
    double *given;              /* Pa: what it was given before, once it is reached; owned */
    int *queue, n, next;        /* cells reached; owned */
    bool again;                 /* pressures at rest have been set before */
} rest_fill;

static void cell_at(const mesh *m, int number, int cell[3])
{
    cell[0] = number % m->n[0];
    cell[1] = number / m->n[0] % m->n[1];
    cell[2] = number / m->n[0] / m->n[1];
}

static const ice_view *view_at(const ice *s, const int cell[3], ptrdiff_t *at)
{
    const int id = mesh_block_of(s->mesh, cell);
    const ice_view *v = &s->cut_cells->view[id];
    *at = mesh_index(v->b, cell[0] - v->b->lo[0], cell[1] - v->b->lo[1], cell[2] - v->b->lo[2]);
    return v;
}

/* What a cell was given, also once its pressure at rest has been set but for that pressure. */
static ice_given given_in(const ice *s, const int cell[3])
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    ice_given out = {0};
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        const double pure = v->multi ? 1.0 / m->vol[at] : m->rho[at];
        if (!(m->rho[at] > 0.0)) continue;
        ice_given_add(&out, r, &v->material[r].eos, scene_is_given_by_density(s->scene, v->material[r].scene_material),
                      v->multi ? m->rho[at] * m->vol[at] : 1.0, pure, m->e[at]);
    }
    return out;
}

/* The same with the pressure that it was given. */
static ice_given given_at(const rest_fill *f, const int cell[3])
{
    ice_given out = given_in(f->s, cell);
    const double since = f->again ? f->given[cut_index(f->s->mesh, cell)] - out.p : 0.0;
    for (int r = 0; r < out.n; ++r) out.own[r] += since;
    out.p += since;
    return out;
}

static bool has_gas(const ice *s, const int cell[3])
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    return v->m[0].open[at] > 0.0;
}

static void mark_reached(rest_fill *f, int number, double given, double p)
{
    f->pressure[number] = p;
    f->given[number] = given;
    f->queue[f->n++] = number;
}

/* kg/m3: of the weight on the face between a cell and the next along an axis, what the fluids' places in both add to the sum of their densities. */
static double lean_between(const rest_fill *f, int here, int next, int axis, int step)
{
    return f->lean[axis] ? 2.0 * step * (f->lean[axis][next] - f->lean[axis][here]) : 0.0;
}

/* The cells beside one that has its pressure: as high, as it; above and below, by the densities of both. */
static void reach_beside(rest_fill *f, int number)
{
    const ice *s = f->s;
    const mesh *m = s->mesh;
    int here[3];
    cell_at(m, number, here);
    const ice_given own = given_at(f, here);
    const double rho = ice_given_density(&own, f->pressure[number]);
    for (int side = 0; side < 2 * m->dim; ++side) {
        int cell[3] = {here[0], here[1], here[2]};
        const int axis = side / 2, step = side % 2 == SIDE_UPPER ? 1 : -1;
        if (!mesh_step(m, cell, axis, step) || !has_gas(s, cell)) continue;
        if (!(ice_open_face(s, f->p->region->number, CUT_NOW, here, axis, side % 2) > 0.0)) continue;
        const int other = (int)cut_index(m, cell);
        if (!isnan(f->pressure[other])) continue;
        const double weight = 0.5 * step * ice_weight_along(s, axis) * m->h[axis];
        const ice_given next = given_at(f, cell);
        const double base = f->pressure[number] + ice_given_rise(&own, &next);
        mark_reached(f, other, next.p,
                     ice_given_settle(&next, base, weight, 1.0, rho + lean_between(f, number, other, axis, step)));
    }
}

/* How high a cell lies, against gravity (m2/s2). */
static double height_of(const ice *s, int number)
{
    int cell[3];
    double sum = 0.0;
    cell_at(s->mesh, number, cell);
    for (int a = 0; a < s->mesh->dim; ++a) sum -= ice_weight_along(s, a) * mesh_centre(s->mesh, a, cell[a]);
    return sum;
}

/* The highest cell with gas that has not been reached; -1: none. */
static int highest_cell(const rest_fill *f, int cells)
{
    int found = -1;
    for (int k = 0; k < cells; ++k) {
        int cell[3];
        cell_at(f->s->mesh, k, cell);
        if (!isnan(f->pressure[k]) || !has_gas(f->s, cell)) continue;
        if (found < 0 || height_of(f->s, k) > height_of(f->s, found)) found = k;
    }
    return found;
}

static floe_status set_state(const ice *s, const int cell[3], const ice_given *q, double p)
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    for (int r = 0; r < q->n; ++r) {
        ice_reservoir state;
        if (!q->law[r]) continue;
        TRY(ice_given_state(s, q, r, p, &state));
        v->m[r].rho[at] = q->theta[r] * state.rho;
        v->m[r].e[at] = state.e;
        if (v->multi) v->m[r].vol[at] = state.v;
    }
    if (v->multi) field_get(s->domain->fields[v->b->id], C_PRESSURE, v->region, 0)[at] = p;
    return FLOE_OK;
}

/* Pressure at the centre of merged cells: the one that balances that of a whole cell above or below it. Where it has none, that
 * of their largest cell. */
static double balance_merged_cell(const rest_fill *f, int merged, const ice_given *own)
{
    const ice *s = f->s;
    const mesh *m = s->mesh;
    const ice_member *lead = &f->p->member[f->p->lead[merged]];
    for (int k = 0; k < f->p->n; ++k) {
        const ice_member *q = &f->p->member[k];
        for (int side = 0; side < 2 * m->dim && q->merged == merged; ++side) {
            int cell[3] = {q->cell[0], q->cell[1], q->cell[2]};
            const int axis = side / 2, step = side % 2 == SIDE_UPPER ? 1 : -1;
            if (ice_weight_along(s, axis) == 0.0 || !mesh_step(m, cell, axis, step)) continue;
            if (f->p->place[cut_index(m, cell)] >= 0 || !(q->open > 0.0) || !has_gas(s, cell)) continue;
            if (!(ice_open_face(s, f->p->region->number, CUT_NOW, q->cell, axis, side % 2) > 0.0)) continue;
            const int beside = (int)cut_index(m, cell);
            double lever = 0.0, rho = 0.0;
            ptrdiff_t at;
            const ice_view *v = view_at(s, cell, &at);
            for (int r = 0; r < v->n_materials; ++r) rho += v->m[r].rho[at];
            ice_given whole = given_in(s, cell);
            whole.p = f->given[beside];
            const double half = 0.5 * step * ice_weight_along(s, axis) * m->h[axis];
            for (int a = 0; a < m->dim; ++a) lever += ice_weight_along(s, a) * q->above[a];
            /* p + rho' lever = p_cell - half (rho + rho') */
            rho += lean_between(f, (int)cut_index(m, q->cell), beside, axis, step);
            const double base = f->pressure[beside] - half * rho + ice_given_rise(&whole, own);
            return ice_given_settle(own, base, -1.0, half + lever, 0.0);
        }
    }
    double lever = 0.0;
    for (int a = 0; a < m->dim; ++a) lever += ice_weight_along(s, a) * lead->above[a];
    return ice_given_settle(own, f->pressure[cut_index(m, lead->cell)], -1.0, lever, 0.0);
}

static floe_status fill_merged_cells(const rest_fill *f)
{
    const ice *s = f->s;
    for (int n = 0; n < f->p->count; ++n) {
        const ice_member *lead = &f->p->member[f->p->lead[n]];
        if (!has_gas(s, lead->cell)) continue;
        const ice_given own = given_at(f, lead->cell);
        const double p = balance_merged_cell(f, n, &own);
        for (int k = 0; k < f->p->n; ++k)
            if (f->p->member[k].merged == n && has_gas(s, f->p->member[k].cell))
                TRY(set_state(s, f->p->member[k].cell, &own, p));
    }
    return FLOE_OK;
}

/* Whole cells first, at the temperatures or densities that they were given; then merged cells, in balance with them. */
static floe_status fill_regions(rest_fill *f, int cells)
{
    const ice *s = f->s;
    for (int k = 0; k < cells; ++k) f->pressure[k] = NAN;
    for (int top = highest_cell(f, cells); top >= 0; top = highest_cell(f, cells)) {
        int cell[3];
        cell_at(s->mesh, top, cell);
        const double given = given_at(f, cell).p;
        mark_reached(f, top, given, given);
        while (f->next < f->n) reach_beside(f, f->queue[f->next++]);
    }
    for (int k = 0; k < f->n; ++k) {
        int cell[3];
        cell_at(s->mesh, f->queue[k], cell);
        if (f->p->place[f->queue[k]] >= 0) continue;
        const ice_given own = given_in(s, cell);
        TRY(set_state(s, cell, &own, f->pressure[f->queue[k]]));
    }
    return fill_merged_cells(f);
}

static double density_of(const ice *s, const int cell[3])
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    double rho = 0.0;
    for (int r = 0; r < v->n_materials; ++r) rho += v->m[r].rho[at];
    return rho;
}

/* Where the fluids of a cell lie along an axis; evenly beside the ends and cells that solids fill. */
static double lean_in(const ice *s, int number, int axis)
{
    int here[3], lower[3], upper[3];
    cell_at(s->mesh, number, here);
    memcpy(lower, here, sizeof lower);
    memcpy(upper, here, sizeof upper);
    if (!mesh_step(s->mesh, lower, axis, -1) || !mesh_step(s->mesh, upper, axis, 1)) return 0.0;
    if (!has_gas(s, here) || !has_gas(s, lower) || !has_gas(s, upper)) return 0.0;
    return ice_lean(density_of(s, lower), density_of(s, here), density_of(s, upper));
}

/* By the densities found last; whether that has changed. */
static bool find_cell_leans(const rest_fill *f, int cells)
{
    bool changed = false;
    for (int a = 0; a < f->s->mesh->dim; ++a)
        for (int k = 0; k < cells && f->s->gravity[a] != 0.0; ++k) {
            const double lean = lean_in(f->s, k, a);
            changed = changed || lean != f->lean[a][k];
            f->lean[a][k] = lean;
        }
    return changed;
}

/* Where cells bear weight unevenly, densities and where they lie are found in turn. */
static floe_status fill_to_rest(rest_fill *f, int cells)
{
    const bool leans = ice_bears_unevenly(f->s, f->p->region);
    for (int a = 0; leans && a < f->s->mesh->dim; ++a)
        TRY(memory_new(f->s->ctx, &f->lean[a], (size_t)cells, sizeof *f->lean[a]));
    if (leans) find_cell_leans(f, cells);
    TRY(fill_regions(f, cells));
    for (int pass = 0; pass < most_passes && leans && find_cell_leans(f, cells); ++pass) {
        f->n = f->next = 0;
        f->again = true;
        TRY(fill_regions(f, cells));
    }
    return FLOE_OK;
}

static floe_status bring_to_rest(ice *s, const ice_region *g)
{
    const int cells = (int)mesh_cells(s->mesh);
    rest_fill f = {.s = s, .p = &s->cut_cells->now[g->number]};
    ice_cut_views(s, g);
    floe_status status = memory_new(s->ctx, &f.pressure, (size_t)cells, sizeof *f.pressure);
    if (status == FLOE_OK) status = memory_new(s->ctx, &f.given, (size_t)cells, sizeof *f.given);
    if (status == FLOE_OK) status = memory_new(s->ctx, &f.queue, (size_t)cells, sizeof *f.queue);
    if (status == FLOE_OK) status = fill_to_rest(&f, cells);
    for (int a = 0; a < MESH_MAX_DIM; ++a) memory_free(s->ctx, &f.lean[a]);
    memory_free(s->ctx, &f.pressure);
    memory_free(s->ctx, &f.given);
    memory_free(s->ctx, &f.queue);
    return status;
}

floe_status ice_cut_hydrostatic(ice *s)
{
    for (int g = 0; g < s->n_regions && ice_has_weight(s); ++g) TRY(bring_to_rest(s, &s->region[g]));
    return FLOE_OK;
}

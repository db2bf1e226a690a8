/* Gravity in pools (ice_merged_cells.h; theory 7.4), and gas at rest between walls. A pool has one density and one pressure, that at the centre of what
 * it has open; away from there it is P + rho g . (x - centre), whose forces on faces and pieces add up to the pool's
 * weight (Gauss). At the centres of its cells that is what the stages of whole cells ask for, whose differences then
 * balance as those of a plain column do (theory 2.4). */
#include "ice/sealed/ice_merged_cells.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

bool ice_has_weight(const ice *s)
{
    return s->gravity[0] != 0.0 || s->gravity[1] != 0.0;
}

/* Moment (m) of what a gas has of a cell about the cell's centre, over the cell's volume. */
static double moment_of(const ice *s, int gas, int place, const int cell[2], int axis)
{
    double enclosed = 0.0;
    for (int l = 0; l < s->seal.n_lines; ++l) {
        const double moment = cut_moment(&s->seal.line[l].place[place], cell, axis);
        if (s->seal.line[l].enclosed == gas) return moment;
        enclosed += moment;
    }
    return -enclosed;
}

void ice_merged_centre(const ice *s, int gas, int place, ice_merged_cells *p)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        const double volume = mesh_cell_volume(s->mesh, m->cell[0]);
        sum[MERGED_VOLUME] += m->open * volume;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double moment = m->open > 0.0 && m->open < 1.0 ? moment_of(s, gas, place, m->cell, a) : 0.0;
            sum[MERGED_MOMENTUM + a] += volume * (m->open * mesh_centre(s->mesh, a, m->cell[a]) + moment);
        }
    }
    for (int k = 0; k < p->n; ++k) {
        ice_member *m = &p->member[k];
        const double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        for (int a = 0; a < s->mesh->dim; ++a)
            m->above[a] = sum[MERGED_VOLUME] > 0.0
                              ? mesh_centre(s->mesh, a, m->cell[a]) - sum[MERGED_MOMENTUM + a] / sum[MERGED_VOLUME]
                              : 0.0;
    }
}

double ice_merged_rise(const ice *s, const ice_merged_cells *p, const ice_member *m, const double from_centre[2])
{
    const ice_member *lead = &p->member[p->lead[m->merged]];
    double sum = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) sum += s->gravity[a] * (m->above[a] + from_centre[a]);
    return s->work->sealing->view[lead->block].m[0].rho[lead->at] * sum;
}

/* Sets the pressure of a cell in its block, and in those that see it as a ghost. */
static void set_pressure(const ice *s, const ice_member *m, double p)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const block *b = &s->mesh->block[id];
        bool seen = true;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const int local = m->cell[a] - b->lo[a];
            seen = seen && local >= -MESH_GHOST && local < b->n[a] + MESH_GHOST;
        }
        if (seen) s->work->sealing->view[id].p[mesh_index(b, m->cell[0] - b->lo[0], m->cell[1] - b->lo[1], 0)] = p;
    }
}

void ice_merged_lift(const ice *s)
{
    static const double centre[2] = {0.0, 0.0};
    ice_merged_cells *p = &s->work->sealing->now[s->gas];
    ice_seal_views(s);
    for (int n = 0; n < p->count; ++n) {
        const ice_member *lead = &p->member[p->lead[n]];
        p->sum[(size_t)n * MERGED_SUMS] = s->work->sealing->view[lead->block].p[lead->at];
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        set_pressure(s, m, p->sum[(size_t)m->merged * MERGED_SUMS] + ice_merged_rise(s, p, m, centre));
    }
}

bool ice_is_merged(const ice *s, const block *b, int i, int j)
{
    const int cell[2] = {b->lo[0] + i, b->lo[1] + j};
    const size_t at = cut_index(s->mesh, cell);
    return s->work->sealing->now[s->gas].place[at] >= 0 || ice_open_cell(s, s->gas, SEAL_NOW, cell) == 0.0;
}

/* ---- the start ---- */

/* Rooms of gas, filled cell by cell from the highest one of each. */
typedef struct rest_fill {
    ice *s;
    const ice_merged_cells *p;
    double *pressure;    /* Pa, of every cell; NaN: not reached; owned */
    int *queue, n, next; /* cells reached; owned */
} rest_fill;

static void cell_at(const mesh *m, int number, int cell[2])
{
    cell[0] = number % m->n[0];
    cell[1] = number / m->n[0];
}

static const ice_view *view_at(const ice *s, const int cell[2], ptrdiff_t *at)
{
    const int whole[3] = {cell[0], cell[1], 0}, id = mesh_block_of(s->mesh, whole);
    const ice_view *v = &s->work->sealing->view[id];
    *at = mesh_index(v->b, cell[0] - v->b->lo[0], cell[1] - v->b->lo[1], 0);
    return v;
}

static double temperature_at(const ice *s, const int cell[2])
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    const eos *law = &s->material[s->gas].eos;
    double T;
    law->model->temperature(law->par, 1, &v->m[0].rho[at], &v->m[0].e[at], &T);
    return T;
}

static double pressure_at(const ice *s, const int cell[2])
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    const eos *law = &s->material[s->gas].eos;
    double p, c2;
    law->model->pressure(law->par, 1, &v->m[0].rho[at], &v->m[0].e[at], &p, &c2);
    return p;
}

/* Pressure p of a state of temperature T with p = base + weight (share rho(p) + other). */
static double solve(const ice *s, double base, double weight, double share, double other, double T)
{
    double p = base;
    for (int pass = 0; pass < 60; ++pass) {
        const double next = base + weight * (share * ice_state_at(&s->material[s->gas].eos, p, T).rho + other);
        if (next == p) break;
        p = next;
    }
    return p;
}

static bool has_gas(const ice *s, const int cell[2])
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    return v->m[0].open[at] > 0.0;
}

static void reach(rest_fill *f, int number, double p)
{
    f->pressure[number] = p;
    f->queue[f->n++] = number;
}

/* The cells beside one that has its pressure: as high, as it; above and below, by the densities of both. */
static void reach_beside(rest_fill *f, int number)
{
    const ice *s = f->s;
    const mesh *m = s->mesh;
    const eos *law = &s->material[s->gas].eos;
    int here[2];
    cell_at(m, number, here);
    const double rho = ice_state_at(law, f->pressure[number], temperature_at(s, here)).rho;
    for (int side = 0; side < 2 * m->dim; ++side) {
        int cell[2] = {here[0], here[1]};
        const int axis = side / 2, step = side % 2 == SIDE_UPPER ? 1 : -1;
        cell[axis] += step;
        if (cell[axis] < 0 || cell[axis] >= m->n[axis] || !has_gas(s, cell)) continue;
        if (!(ice_open_face(s, s->gas, SEAL_NOW, here, axis, side % 2) > 0.0)) continue;
        const int other = cell[1] * m->n[0] + cell[0];
        if (!isnan(f->pressure[other])) continue;
        const double weight = 0.5 * step * s->gravity[axis] * m->h[axis];
        reach(f, other, solve(s, f->pressure[number], weight, 1.0, rho, temperature_at(s, cell)));
    }
}

/* How high a cell lies, against gravity (m2/s2). */
static double height_of(const ice *s, int number)
{
    int cell[2];
    double sum = 0.0;
    cell_at(s->mesh, number, cell);
    for (int a = 0; a < s->mesh->dim; ++a) sum -= s->gravity[a] * mesh_centre(s->mesh, a, cell[a]);
    return sum;
}

/* The highest cell with gas that no room has reached; -1: none. */
static int highest(const rest_fill *f, int cells)
{
    int found = -1;
    for (int k = 0; k < cells; ++k) {
        int cell[2];
        cell_at(f->s->mesh, k, cell);
        if (!isnan(f->pressure[k]) || !has_gas(f->s, cell)) continue;
        if (found < 0 || height_of(f->s, k) > height_of(f->s, found)) found = k;
    }
    return found;
}

static void set_state(const ice *s, const int cell[2], ice_reservoir state)
{
    ptrdiff_t at;
    const ice_view *v = view_at(s, cell, &at);
    v->m[0].rho[at] = state.rho;
    v->m[0].e[at] = state.e;
}

/* Pressure at the centre of a pool: the one that balances that of a whole cell above or below it. Where it has none, that
 * of its largest cell. */
static double balance_merged_cell(const rest_fill *f, int merged, double T)
{
    const ice *s = f->s;
    const mesh *m = s->mesh;
    const ice_member *lead = &f->p->member[f->p->lead[merged]];
    for (int k = 0; k < f->p->n; ++k) {
        const ice_member *q = &f->p->member[k];
        for (int side = 0; side < 2 * m->dim && q->merged == merged; ++side) {
            int cell[2] = {q->cell[0], q->cell[1]};
            const int axis = side / 2, step = side % 2 == SIDE_UPPER ? 1 : -1;
            cell[axis] += step;
            if (s->gravity[axis] == 0.0 || cell[axis] < 0 || cell[axis] >= m->n[axis]) continue;
            if (f->p->place[cut_index(m, cell)] >= 0 || !(q->open > 0.0) || !has_gas(s, cell)) continue;
            if (!(ice_open_face(s, s->gas, SEAL_NOW, q->cell, axis, side % 2) > 0.0)) continue;
            ptrdiff_t at;
            const double rho = view_at(s, cell, &at)->m[0].rho[at], half = 0.5 * step * s->gravity[axis] * m->h[axis];
            double lever = 0.0;
            for (int a = 0; a < m->dim; ++a) lever += s->gravity[a] * q->above[a];
            /* p + rho' lever = p_cell - half (rho + rho') */
            return solve(s, f->pressure[cell[1] * m->n[0] + cell[0]] - half * rho, -1.0, half + lever, 0.0, T);
        }
    }
    double lever = 0.0;
    for (int a = 0; a < m->dim; ++a) lever += s->gravity[a] * lead->above[a];
    return solve(s, f->pressure[lead->cell[1] * m->n[0] + lead->cell[0]], -1.0, lever, 0.0, T);
}

static void fill_merged_cells(const rest_fill *f)
{
    const ice *s = f->s;
    const eos *law = &s->material[s->gas].eos;
    for (int n = 0; n < f->p->count; ++n) {
        const ice_member *lead = &f->p->member[f->p->lead[n]];
        if (!has_gas(s, lead->cell)) continue;
        const double T = temperature_at(s, lead->cell);
        const ice_reservoir state = ice_state_at(law, balance_merged_cell(f, n, T), T);
        for (int k = 0; k < f->p->n; ++k)
            if (f->p->member[k].merged == n && has_gas(s, f->p->member[k].cell))
                set_state(s, f->p->member[k].cell, state);
    }
}

/* Whole cells first, at the temperatures that they were given; then pools, in balance with them. */
static void fill_regions(rest_fill *f, int cells)
{
    const ice *s = f->s;
    for (int k = 0; k < cells; ++k) f->pressure[k] = NAN;
    for (int top = highest(f, cells); top >= 0; top = highest(f, cells)) {
        int cell[2];
        cell_at(s->mesh, top, cell);
        reach(f, top, pressure_at(s, cell));
        while (f->next < f->n) reach_beside(f, f->queue[f->next++]);
    }
    for (int k = 0; k < f->n; ++k) {
        int cell[2];
        cell_at(s->mesh, f->queue[k], cell);
        if (f->p->place[f->queue[k]] >= 0) continue;
        const double T = temperature_at(s, cell);
        set_state(s, cell, ice_state_at(&s->material[s->gas].eos, f->pressure[f->queue[k]], T));
    }
    fill_merged_cells(f);
}

floe_status ice_sealed_hydrostatic(ice *s)
{
    const int cells = (int)mesh_cells(s->mesh);
    if (!ice_asks_for_rest(s)) return FLOE_OK;
    rest_fill f = {.s = s, .p = &s->work->sealing->now[s->gas]};
    ice_seal_views(s);
    floe_status status = memory_new(s->ctx, &f.pressure, (size_t)cells, sizeof *f.pressure);
    if (status == FLOE_OK) status = memory_new(s->ctx, &f.queue, (size_t)cells, sizeof *f.queue);
    if (status == FLOE_OK) fill_regions(&f, cells);
    memory_free(s->ctx, &f.pressure);
    memory_free(s->ctx, &f.queue);
    return status;
}

/* The equilibrium pressure stage of several materials (numerics 2.1; Guilkey et al. 2003, step 2). Rows are taken in batches:
 * the laws see the cells in which one material is alone, then those in which it is mixed or absent; only mixed cells are solved.
 * Materials that are absent from a cell get the mean velocity and temperature of those present, and their law's v at p, so
 * that every neighbour finds a sensible value. All of it is done in ghosts too, from the same numbers. */
#include "base/threads.h"
#include "ice/ice_internal.h"

#include <math.h>

/* One row of cells, and the thread's storage. Index i counts cells from `from`. */
typedef struct mixture_row {
    ice *s;
    const ice_view *v;
    ptrdiff_t from;
    int n;
    const double *guess;       /* Pa: the last equilibrium pressure */
    int *index;                /* cells of a batch */
    int *alone;                /* of each cell, the material that is alone there; MIXED */
    int *mixed, n_mixed;       /* cells with several materials */
    double *a, *b, *c, *d, *e; /* values of a batch */
    ice_mixed_cells *batch;
    long cells, iterations, fallbacks;
} mixture_row;

enum { MIXED = -1 };

/* Numbers of materials, density sums, mean velocities, TMV. */
static floe_status count_materials(mixture_row *q)
{
    const ice_view *v = q->v;
    q->n_mixed = 0;
    for (int i = 0; i < q->n; ++i) {
        const ptrdiff_t at = q->from + i;
        double sum = 0.0, momentum[3] = {0.0, 0.0, 0.0}, volume = 0.0;
        int count = 0, points = 0, last = MIXED;
        for (int r = 0; r < v->n_materials; ++r) {
            const double rho = v->m[r].rho[at];
            if (!(rho > 0.0)) continue;
            count++;
            last = r;
            if (q->s->material[r].points) points = ICE_WITH_POINTS;
            sum += rho;
            volume += rho * v->m[r].vol[at];
            for (int a = 0; a < v->dim; ++a) momentum[a] += rho * v->m[r].u[a][at];
        }
        if (!(sum > 0.0)) {
            char place[160];
            ice_place(q->s, v->b, at, -1, place, sizeof place);
            return fail(q->s->ctx, FLOE_RETRY, "equilibrium pressure: %s holds no material", place);
        }
        v->mixed[at] = count + points;
        v->rho_sum[at] = sum;
        for (int a = 0; a < v->dim; ++a) v->mean[a][at] = count == 1 ? v->m[last].u[a][at] : momentum[a] / sum;
        if (v->tmv) v->tmv[at] = points ? volume : 1.0;
        q->alone[i] = count == 1 ? last : MIXED;
        if (count > 1) q->mixed[q->n_mixed++] = i;
    }
    return FLOE_OK;
}

static void set_compressibility(const ice_arrays *m, ptrdiff_t at, double density, double c2)
{
    m->v[at] = 1.0 / density;
    m->c[at] = sqrt(c2);
    m->kappa[at] = 1.0 / (density * c2);
}

/* Says what is wrong in cells [from, from + n), in which material r is alone, with pressure p and c2 in its array of c. */
static floe_status explain_alone(const mixture_row *q, int r, ptrdiff_t from, int n, const double *density)
{
    const ice_arrays *m = &q->v->m[r];
    for (int i = 0; i < n; ++i) {
        const double p = q->v->p[from + i], c2 = m->c[from + i];
        if (c2 > 0.0 && isfinite(p)) continue;
        char place[160];
        ice_place(q->s, q->v->b, from + i, r, place, sizeof place);
        return fail(q->s->ctx, FLOE_RETRY,
                    "equation of state, %s: density %g kg/m3 and internal energy %g J/kg give p = %g Pa, "
                    "c^2 = %g m2/s2",
                    place, density[i], m->e[from + i], p, c2);
    }
    return FLOE_OK;
}

/* Cells [from, from + n), in which material r is alone: p is its law's. A fluid fills them; a solid takes the room of its v, the points
 * bring its T, and the law has its e. */
static floe_status set_alone(mixture_row *q, int r, ptrdiff_t from, int n)
{
    const ice_arrays *m = &q->v->m[r];
    const eos *law = &q->s->material[r].eos;
    const bool points = q->s->material[r].points;
    double *restrict p = q->v->p, *restrict c = m->c;
    const double *density = points ? q->a : m->rho + from;
    for (int i = 0; i < n && points; ++i) q->a[i] = 1.0 / m->vol[from + i];
    if (points)
        law->model->energy(law->par, (size_t)n, density, m->T + from, m->e + from);
    else
        law->model->temperature(law->par, (size_t)n, density, m->e + from, m->T + from);
    law->model->pressure(law->par, (size_t)n, density, m->e + from, p + from, c + from);
    int bad = 0;
    for (int i = 0; i < n; ++i) bad += !(c[from + i] > 0.0) || !isfinite(p[from + i]);
    if (bad) return explain_alone(q, r, from, n, density);
    for (int i = 0; i < n; ++i) {
        m->theta[from + i] = 1.0;
        set_compressibility(m, from + i, density[i], c[from + i]);
    }
    return FLOE_OK;
}

/* The stretches of the row in which one material is alone. */
static floe_status set_stretches(mixture_row *q)
{
    for (int i = 0, end; i < q->n; i = end) {
        for (end = i + 1; end < q->n && q->alone[end] == q->alone[i];) ++end;
        if (q->alone[i] != MIXED) TRY(set_alone(q, q->alone[i], q->from + i, end - i));
    }
    return FLOE_OK;
}

/* Of material r where it is mixed: T of fluids; of solids the points bring T, and the law has e. */
static void set_temperatures(mixture_row *q, int r)
{
    const ice_arrays *m = &q->v->m[r];
    const eos *law = &q->s->material[r].eos;
    int n = 0;
    for (int i = 0; i < q->n_mixed; ++i)
        if (m->rho[q->from + q->mixed[i]] > 0.0) q->index[n++] = q->mixed[i];
    for (int k = 0; k < n; ++k) {
        const ptrdiff_t at = q->from + q->index[k];
        q->a[k] = 1.0 / m->vol[at];
        q->b[k] = m->e[at];
        q->c[k] = m->T[at];
    }
    if (q->s->material[r].points) {
        law->model->energy(law->par, (size_t)n, q->a, q->c, q->b);
        for (int k = 0; k < n; ++k) m->e[q->from + q->index[k]] = q->b[k];
        return;
    }
    law->model->temperature(law->par, (size_t)n, q->a, q->b, q->c);
    for (int k = 0; k < n; ++k) m->T[q->from + q->index[k]] = q->c[k];
}

static floe_status explain(const mixture_row *q, ptrdiff_t at, const equilibrium_cell *cell)
{
    char place[160], text[512];
    int used = 0;
    ice_place(q->s, q->v->b, at, -1, place, sizeof place);
    for (int r = 0; r < cell->n && used < (int)sizeof text - 80; ++r)
        used +=
            snprintf(text + used, sizeof text - (size_t)used, " [%d] %.6g kg/m3 at %.6g K", r, cell->a[r], cell->T[r]);
    return fail(q->s->ctx, FLOE_RETRY,
                "equilibrium pressure, %s: no pressure fills it after %d iterations (p = %g Pa, excess volume %g;%s)",
                place, cell->iterations, cell->p, cell->residual, text);
}

/* In laws whose energy depends on volume at a given temperature, a frozen T will not do: v(p, T) belongs to another energy than the
 * cell's, and an error of v comes back larger by (gamma - 1) p_inf/(p + p_inf) in each step, 3.4 times in water of gamma 4.4. Such
 * scenes close the cell along isentropes instead. */
static void choose_paths(const mixture_row *q, ptrdiff_t at, equilibrium_cell *cell, isentrope *path)
{
    for (int r = 0; r < cell->n; ++r) {
        const ice_arrays *m = &q->v->m[r];
        if (q->s->material[r].points || !(cell->a[r] > 0.0)) continue;
        if (isentrope_through(cell->eos[r], m->vol[at], m->e[at], &path[r])) cell->path[r] = &path[r];
    }
}

/* What the paths end in. Materials at unlike pressures do not do opposite work on their ways to one; the difference goes to all alike,
 * as one change of temperature, so that the cell keeps its energy. Materials without a path take e(v, T). */
static void follow_paths(const mixture_row *q, ptrdiff_t at, const equilibrium_cell *cell)
{
    double over = 0.0, capacity = 0.0, e[ICE_MAX_MATERIALS], cv[ICE_MAX_MATERIALS];
    for (int r = 0; r < cell->n; ++r) {
        const ice_arrays *m = &q->v->m[r];
        if (q->s->material[r].points || !(cell->a[r] > 0.0)) continue;
        const eos *law = cell->eos[r];
        const double density = 1.0 / cell->v[r];
        double alpha;
        if (cell->path[r])
            e[r] = isentrope_energy(cell->path[r], cell->v[r]);
        else
            law->model->energy(law->par, 1, &density, &cell->T[r], &e[r]);
        law->model->heat(law->par, 1, &density, &e[r], &cv[r], &alpha);
        over += m->rho[at] * (m->e[at] - e[r]);
        capacity += m->rho[at] * cv[r];
    }
    for (int r = 0; r < cell->n; ++r) {
        const ice_arrays *m = &q->v->m[r];
        if (q->s->material[r].points || !(cell->a[r] > 0.0)) continue;
        const double density = 1.0 / cell->v[r];
        m->e[at] = e[r] + cv[r] * (over / capacity);
        m->vol[at] = cell->v[r];
        cell->eos[r]->model->temperature(cell->eos[r]->par, 1, &density, &m->e[at], &m->T[at]);
    }
}

static void load_mixed(const mixture_row *q, ptrdiff_t at, equilibrium_cell *cell, isentrope *path)
{
    const ice_view *v = q->v;
    const double share = ice_holds_points(v, at) ? 1.0 / v->tmv[at] : 1.0;
    cell->n = v->n_materials;
    cell->p = q->guess[at];
    for (int r = 0; r < v->n_materials; ++r) {
        cell->eos[r] = &q->s->material[r].eos;
        cell->a[r] = v->m[r].rho[at] * share;
        cell->T[r] = v->m[r].T[at];
        cell->path[r] = NULL;
    }
    if (q->s->work->reconcile) choose_paths(q, at, cell, path);
}

static void store_mixed(mixture_row *q, ptrdiff_t at, const equilibrium_cell *cell, bool owned)
{
    const ice_view *v = q->v;
    v->p[at] = cell->p;
    for (int r = 0; r < v->n_materials; ++r) v->m[r].theta[at] = cell->a[r] > 0.0 ? cell->a[r] * cell->v[r] : 0.0;
    if (q->s->work->reconcile) follow_paths(q, at, cell);
    if (!owned) return;
    q->cells++;
    q->iterations += cell->iterations;
    q->fallbacks += cell->fallbacks;
}

/* Up to EQUILIBRIUM_BATCH mixed cells of the row. */
static floe_status solve_mixed(mixture_row *q, const int *mixed, int n, bool owned_row)
{
    equilibrium_cell *cell = q->batch->cell;
    for (int k = 0; k < n; ++k) load_mixed(q, q->from + mixed[k], &cell[k], q->batch->path[k]);
    const floe_status status = equilibrium_solve(cell, n);
    for (int k = 0; k < n; ++k) {
        if (status != FLOE_OK && !cell[k].solved) return explain(q, q->from + mixed[k], &cell[k]);
        const bool owned = owned_row && mixed[k] >= MESH_GHOST && mixed[k] < q->n - MESH_GHOST;
        store_mixed(q, q->from + mixed[k], &cell[k], owned);
    }
    return FLOE_OK;
}

/* Temperature of those present, weighted by mass, and the mean velocity, for an absent material. */
static void lend_state(const mixture_row *q, int r, ptrdiff_t at)
{
    const ice_view *v = q->v;
    double heat = 0.0;
    for (int k = 0; k < v->n_materials; ++k)
        if (v->m[k].rho[at] > 0.0) heat += v->m[k].rho[at] * v->m[k].T[at];
    v->m[r].T[at] = heat / v->rho_sum[at];
    v->m[r].theta[at] = 0.0;
    for (int a = 0; a < v->dim; ++a) v->m[r].u[a][at] = v->mean[a][at];
}

/* A pressure at which the law is defined: an absent gas beside a liquid in tension is lent a thin one. */
static double defined_pressure(double p, double floor)
{
    return p > floor ? p : floor + 1e-3 * fabs(p) + DBL_MIN;
}

/* Cells in which material r is absent, or mixed with its T frozen: v, c and kappa at (p, T). */
static void set_others(mixture_row *q, int r)
{
    const ice_arrays *m = &q->v->m[r];
    const eos *law = &q->s->material[r].eos;
    const double floor = law->model->pressure_floor(law->par);
    const bool followed = q->s->work->reconcile && !q->s->material[r].points;
    int n = 0;
    for (int i = 0; i < q->n; ++i) {
        const ptrdiff_t at = q->from + i;
        const bool absent = !(m->rho[at] > 0.0);
        if (!absent && (followed || q->alone[i] != MIXED)) continue;
        if (absent) lend_state(q, r, at);
        q->index[n] = i;
        q->a[n] = defined_pressure(q->v->p[at], floor);
        q->b[n] = m->T[at];
        n++;
    }
    law->model->volume(law->par, (size_t)n, q->a, q->b, q->c, q->d);
    for (int k = 0; k < n; ++k) q->a[k] = 1.0 / q->c[k];
    law->model->energy(law->par, (size_t)n, q->a, q->b, q->c);
    law->model->pressure(law->par, (size_t)n, q->a, q->c, q->d, q->e);
    for (int k = 0; k < n; ++k) {
        const ptrdiff_t at = q->from + q->index[k];
        if (!(m->rho[at] > 0.0)) m->e[at] = q->c[k];
        set_compressibility(m, at, q->a[k], q->e[k]);
    }
    /* Advection writes the next state of fluids alone. */
    for (int i = 0; i < q->n && q->s->material[r].points; ++i) m->e1[q->from + i] = m->e[q->from + i];
}

/* Mixed cells that have been closed along isentropes: v, c and kappa of their v and e. */
static void set_followed(mixture_row *q, int r)
{
    const ice_arrays *m = &q->v->m[r];
    const eos *law = &q->s->material[r].eos;
    int n = 0;
    for (int i = 0; i < q->n_mixed; ++i)
        if (m->rho[q->from + q->mixed[i]] > 0.0) q->index[n++] = q->mixed[i];
    for (int k = 0; k < n; ++k) {
        q->a[k] = 1.0 / m->vol[q->from + q->index[k]];
        q->b[k] = m->e[q->from + q->index[k]];
    }
    law->model->pressure(law->par, (size_t)n, q->a, q->b, q->c, q->d);
    for (int k = 0; k < n; ++k) set_compressibility(m, q->from + q->index[k], q->a[k], q->d[k]);
}

static floe_status mix_row(mixture_row *q, int j, int k)
{
    const ice_view *v = q->v;
    const bool owned_row = j >= 0 && j < v->b->n[1] && k >= 0 && k < v->b->n[2];
    TRY(count_materials(q));
    for (int r = 0; r < v->n_materials; ++r) ice_note_span(q->s, v->b, r, j, k, v->m[r].rho);
    TRY(set_stretches(q));
    for (int r = 0; r < v->n_materials; ++r) set_temperatures(q, r);
    for (int done = 0; done < q->n_mixed; done += EQUILIBRIUM_BATCH) {
        const int left = q->n_mixed - done;
        TRY(solve_mixed(q, q->mixed + done, left < EQUILIBRIUM_BATCH ? left : EQUILIBRIUM_BATCH, owned_row));
    }
    for (int r = 0; r < v->n_materials; ++r) set_others(q, r);
    for (int r = 0; r < v->n_materials && q->s->work->reconcile; ++r)
        if (!q->s->material[r].points) set_followed(q, r);
    for (ptrdiff_t at = q->from; at < q->from + q->n; ++at) {
        double sum = 0.0;
        for (int r = 0; r < v->n_materials; ++r) sum += v->m[r].theta[at] * v->m[r].kappa[at];
        v->kappa_sum[at] = sum;
    }
    return FLOE_OK;
}

static mixture_row row_of(ice *s, const ice_view *v, int id, int j, int k)
{
    const int n = v->b->n[0] + 2 * MESH_GHOST;
    double *buffer = s->work->buffer[thread_number()];
    return (mixture_row){.s = s,
                         .v = v,
                         .from = mesh_index(v->b, -MESH_GHOST, j, k),
                         .n = n,
                         .guess = field_get(s->domain->fields[id], C_PRESSURE, 0, 0),
                         .index = s->work->index[thread_number()],
                         .alone = s->work->index[thread_number()] + n,
                         .mixed = s->work->index[thread_number()] + 2 * n,
                         .a = buffer,
                         .b = buffer + n,
                         .c = buffer + 2 * n,
                         .d = buffer + 3 * n,
                         .e = buffer + 4 * n,
                         .batch = &s->work->cells[thread_number()]};
}

/* Owned cells with several materials, in order. */
static void list_mixed(ice *s, const ice_view *v, int id)
{
    const block *b = v->b;
    ice_cell_list *list = &s->work->mixed[id];
    list->n = 0;
    for (int k = 0; k < b->n[2]; ++k)
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                if (((int)v->mixed[at] & (ICE_WITH_POINTS - 1)) > 1) list->at[list->n++] = at;
            }
}

floe_status ice_mixture(ice *s, int block_id, const ice_view *v)
{
    const ice_rows rows = ice_rows_of(v->b, -1, MESH_GHOST);
    long cells = 0, iterations = 0, fallbacks = 0;
    int bad = 0;
    ice_keep_found(s, block_id, v);
#pragma omp parallel for schedule(static) reduction(+ : cells, iterations, fallbacks, bad)
    for (int row = 0; row < rows.n; ++row) {
        const int j = ice_row_j(rows, row), k = ice_row_k(rows, row);
        mixture_row q = row_of(s, v, block_id, j, k);
        bad += mix_row(&q, j, k) != FLOE_OK;
        cells += q.cells;
        iterations += q.iterations;
        fallbacks += q.fallbacks;
    }
    ledger_tally(s->ledger, COUNT_NEWTON_CELLS, cells);
    ledger_tally(s->ledger, COUNT_NEWTON_ITERATIONS, iterations);
    ledger_tally(s->ledger, COUNT_NEWTON_FALLBACKS, fallbacks);
    if (bad) return FLOE_RETRY;
    list_mixed(s, v, block_id);
    ice_widen_spans(s, block_id);
    return FLOE_OK;
}

/* The equilibrium pressure stage of several materials (theory 2.1; Guilkey et al. 2003, step 2). A row is processed by runs of cells that contain the same
 * materials, so that laws are evaluated on contiguous cells. With one material the pressure is its law's; with several, the cells of the run are solved side
 * by side. Materials that are absent from a cell get the mean velocity and temperature of those present, and the v of their law at p, so that every neighbour
 * finds a sensible value. Ghost cells are treated alike, with the same numbers. */
#include "base/text.h"
#include "base/threads.h"
#include "ice/equilibrium/ice_mixture_row.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_lists.h"
#include "ice/state/ice_state.h"

#include <float.h>
#include <math.h>
#include <string.h>

static void find_sets(const mixture_row *q)
{
    const ice_view *v = q->v;
    for (int i = 0; i < q->n; ++i) q->set[i] = 0;
    for (int r = 0; r < v->n_materials; ++r) {
        const double *rho = v->m[r].rho + q->from;
        const unsigned bit = 1u << r;
        for (int i = 0; i < q->n; ++i) q->set[i] |= rho[i] > 0.0 ? bit : 0u;
    }
}

/* The run that starts at cell i of the row; of mixed cells at most as many as are solved together. */
static mixture_run run_from(const mixture_row *q, int i)
{
    mixture_run run = {.from = q->from + i, .first = i};
    const unsigned set = q->set[i];
    for (int r = 0; r < q->v->n_materials; ++r) {
        if (!(set >> r & 1u)) continue;
        run.material[run.count++] = r;
        run.points = run.points || q->v->material[r].points;
    }
    const int last = run.count > 1 && q->n - i > EQUILIBRIUM_BATCH ? i + EQUILIBRIUM_BATCH : q->n;
    int end = i + 1;
    while (end < last && q->set[end] == set) ++end;
    run.n = end - i;
    return run;
}

/* sum over the materials of a run of rho x; x: an array of each. */
static void sum_weighted(const mixture_row *q, const mixture_run *run, const double *const *x, double *restrict sum)
{
    for (int k = 0; k < run->count; ++k) {
        const double *restrict rho = q->v->m[run->material[k]].rho + run->from, *restrict value = x[k] + run->from;
        for (int i = 0; i < run->n; ++i) sum[i] = (k > 0 ? sum[i] : 0.0) + rho[i] * value[i];
    }
}

static void set_mean_velocity(const mixture_row *q, const mixture_run *run, int axis)
{
    const double *u[ICE_MAX_MATERIALS], *rho = q->v->rho_sum + run->from;
    double *mean = q->v->mean[axis] + run->from;
    for (int k = 0; k < run->count; ++k) u[k] = q->v->m[run->material[k]].u[axis];
    if (run->count == 1) {
        memcpy(mean, u[0] + run->from, (size_t)run->n * sizeof *mean);
        return;
    }
    sum_weighted(q, run, u, mean);
    for (int i = 0; i < run->n; ++i) mean[i] /= rho[i];
}

/* Numbers of materials, density sums, mean velocities, TMV. */
static void set_sums(const mixture_row *q, const mixture_run *run)
{
    const ice_view *v = q->v;
    const double number = run->count + (run->points ? ICE_WITH_POINTS : 0);
    double *sum = v->rho_sum + run->from;
    for (int i = 0; i < run->n; ++i) v->mixed[run->from + i] = number;
    for (int k = 0; k < run->count; ++k) {
        const double *rho = v->m[run->material[k]].rho + run->from;
        for (int i = 0; i < run->n; ++i) sum[i] = (k > 0 ? sum[i] : 0.0) + rho[i];
    }
    for (int a = 0; a < v->dim; ++a) set_mean_velocity(q, run, a);
    if (!v->tmv) return;
    const double *volume[ICE_MAX_MATERIALS];
    for (int k = 0; k < run->count; ++k) volume[k] = v->m[run->material[k]].vol;
    if (run->points)
        sum_weighted(q, run, volume, v->tmv + run->from);
    else
        for (int i = 0; i < run->n; ++i) v->tmv[run->from + i] = 1.0;
}

/* v, c and kappa of cells [from, from + n) from the density; c2 is in the array of c. */
static void set_compressibility(const ice_fluid *m, ptrdiff_t from, int n, const double *restrict density)
{
    double *restrict v = m->v + from, *restrict c = m->c + from, *restrict kappa = m->kappa + from;
    for (int i = 0; i < n; ++i) {
        const double c2 = c[i];
        v[i] = 1.0 / density[i];
        c[i] = sqrt(c2);
        kappa[i] = 1.0 / (density[i] * c2);
    }
}

/* ---- one material ---- */

/* Says what is wrong in cells in which material r is alone, with pressure p and c2 in its array of c. */
static floe_status explain_alone(const mixture_row *q, int r, ptrdiff_t from, int n, const double *density)
{
    const ice_fluid *m = &q->v->m[r];
    for (int i = 0; i < n; ++i) {
        const double p = q->v->p[from + i], c2 = m->c[from + i];
        if (c2 > 0.0 && isfinite(p)) continue;
        char place[160];
        ice_place(q->s, q->v->b, from + i, q->v->first + r, place, sizeof place);
        return fail(q->s->ctx, FLOE_RETRY,
                    "equation of state, %s: density %g kg/m3 and internal energy %g J/kg give p = %g Pa, "
                    "c^2 = %g m2/s2",
                    place, density[i], m->e[from + i], p, c2);
    }
    return FLOE_OK;
}

/* Where one material is alone p is its law's. A fluid fills its cells; a solid occupies the volume of its v, the points
 * give its T, and the law has its e. */
static floe_status set_alone(const mixture_row *q, const mixture_run *run)
{
    const int r = run->material[0], n = run->n;
    const ptrdiff_t from = run->from;
    const ice_fluid *m = &q->v->m[r];
    const eos *law = &q->v->material[r].eos;
    double *restrict p = q->v->p, *restrict c = m->c;
    const double *density = run->points ? q->a : m->rho + from;
    for (int i = 0; i < n && run->points; ++i) q->a[i] = 1.0 / m->vol[from + i];
    if (run->points)
        law->model->energy(law->par, (size_t)n, density, m->T + from, m->e + from);
    else
        law->model->temperature(law->par, (size_t)n, density, m->e + from, m->T + from);
    law->model->pressure(law->par, (size_t)n, density, m->e + from, p + from, c + from);
    int bad = 0;
#pragma omp simd reduction(+ : bad)
    for (ptrdiff_t at = from; at < from + n; ++at) bad += !(c[at] > 0.0) || !(fabs(p[at]) <= DBL_MAX);
    if (bad) return explain_alone(q, r, from, n, density);
    set_compressibility(m, from, n, density);
    for (ptrdiff_t at = from; at < from + n; ++at) {
        m->theta[at] = 1.0;
        q->v->kappa_sum[at] = m->kappa[at];
    }
    return FLOE_OK;
}

/* ---- several materials ---- */

/* T of fluids; of solids the points bring T, and the law has e. */
static void set_mixture_temperatures(const mixture_row *q, const mixture_run *run)
{
    for (int k = 0; k < run->count; ++k) {
        const int r = run->material[k];
        const ice_fluid *m = &q->v->m[r];
        const eos *law = &q->v->material[r].eos;
        double *e = m->e + run->from, *T = m->T + run->from;
        for (int i = 0; i < run->n; ++i) q->a[i] = 1.0 / m->vol[run->from + i];
        if (q->v->material[r].points)
            law->model->energy(law->par, (size_t)run->n, q->a, T, e);
        else
            law->model->temperature(law->par, (size_t)run->n, q->a, e, T);
    }
}

static floe_status explain_mixture_fault(const mixture_row *q, const mixture_run *run, int i)
{
    const equilibrium_batch *b = &q->mixed->batch;
    char place[160], text[512] = "";
    ice_place(q->s, q->v->b, run->from + i, -1, place, sizeof place);
    for (int k = 0; k < run->count; ++k)
        text_add(text, sizeof text, " [%d] %.6g kg/m3 at %.6g K", q->v->first + run->material[k], b->a[k][i],
                 b->T[k][i]);
    return fail(q->s->ctx, FLOE_RETRY,
                "equilibrium pressure, %s: no pressure fills it after %d iterations (p = %g Pa, excess volume %g;%s)",
                place, b->iterations[i], b->p[i], b->residual[i], text);
}

/* Where fluids have almost no volume the last pressure was extrapolated into the solid (ice_continue.c). What the solid
 * itself had is in its volume, which the last step has carried on: without it these cells, a third of those beside a
 * cylinder, take six iterations for one or two. */
static void guess_crowded(const mixture_row *q, const mixture_run *run)
{
    equilibrium_batch *b = &q->mixed->batch;
    for (int k = 0; k < run->count; ++k) {
        const ice_fluid *m = &q->v->m[run->material[k]];
        if (!q->v->material[run->material[k]].points) continue;
        for (int i = 0; i < run->n; ++i) {
            const double specific_volume = m->vol[run->from + i], density = 1.0 / specific_volume;
            double c2;
            if (b->a[k][i] * specific_volume > 1.0 - ICE_LEAST_FLUID_FRACTION)
                b->eos[k]->model->pressure(b->eos[k]->par, 1, &density, &m->e[run->from + i], &b->p[i], &c2);
        }
    }
}

static void load_batch(const mixture_row *q, const mixture_run *run)
{
    equilibrium_batch *b = &q->mixed->batch;
    b->n = run->count;
    memcpy(b->p, q->guess + run->from, (size_t)run->n * sizeof *b->p);
    for (int i = 0; i < run->n; ++i) q->a[i] = run->points ? 1.0 / q->v->tmv[run->from + i] : 1.0;
    for (int k = 0; k < run->count; ++k) {
        const ice_fluid *m = &q->v->m[run->material[k]];
        b->eos[k] = &q->v->material[run->material[k]].eos;
        b->path[k] = ice_choose_path(q, run, k);
        memcpy(b->T[k], m->T + run->from, (size_t)run->n * sizeof *b->T[k]);
        for (int i = 0; i < run->n; ++i) b->a[k][i] = m->rho[run->from + i] * q->a[i];
    }
    ice_freeze_near(q, run);
}

static floe_status solve_batch(mixture_row *q, const mixture_run *run)
{
    const equilibrium_batch *b = &q->mixed->batch;
    const bool solved = equilibrium_solve(&q->mixed->batch, run->n) == FLOE_OK;
    for (int i = 0; i < run->n; ++i) {
        if (!solved && !b->solved[i]) return explain_mixture_fault(q, run, i);
        const int in_row = run->first + i;
        if (!q->owned || in_row < MESH_GHOST || in_row >= q->n - MESH_GHOST) continue;
        q->cells++;
        q->iterations += b->iterations[i];
        q->fallbacks += b->fallbacks[i];
    }
    return FLOE_OK;
}

/* v, c and kappa of a law at v and T, whose energy goes to e. */
static void set_response(const mixture_row *q, int r, ptrdiff_t from, int n, const double *v, double *e)
{
    const ice_fluid *m = &q->v->m[r];
    const eos *law = &q->v->material[r].eos;
    for (int i = 0; i < n; ++i) q->a[i] = 1.0 / v[i];
    law->model->energy(law->par, (size_t)n, q->a, m->T + from, e);
    law->model->pressure(law->par, (size_t)n, q->a, e, q->d, m->c + from);
    set_compressibility(m, from, n, q->a);
}

/* The same of the state that cells have been closed to along isentropes, and of frozen ones at the solver's v. */
static void set_followed(const mixture_row *q, int r, ptrdiff_t from, int n, const double *v)
{
    const ice_fluid *m = &q->v->m[r];
    const eos *law = &q->v->material[r].eos;
    const bool *frozen = q->mixed->frozen;
    for (int i = 0; i < n; ++i) q->a[i] = 1.0 / (frozen[i] ? v[i] : m->vol[from + i]);
    law->model->pressure(law->par, (size_t)n, q->a, m->e + from, q->d, m->c + from);
    set_compressibility(m, from, n, q->a);
}

/* What the solution makes of the cells. */
static void store_batch(const mixture_row *q, const mixture_run *run)
{
    const equilibrium_batch *b = &q->mixed->batch;
    const bool reconcile = q->v->reconcile;
    double *sum = q->v->kappa_sum + run->from;
    memcpy(q->v->p + run->from, b->p, (size_t)run->n * sizeof *b->p);
    if (reconcile) ice_follow_paths(q, run);
    for (int k = 0; k < run->count; ++k) {
        const int r = run->material[k];
        double *theta = q->v->m[r].theta + run->from, *kappa = q->v->m[r].kappa + run->from;
        if (b->path[k])
            set_followed(q, r, run->from, run->n, b->v[k]);
        else
            set_response(q, r, run->from, run->n, b->v[k], q->b);
        for (int i = 0; i < run->n; ++i) {
            theta[i] = b->a[k][i] * b->v[k][i];
            sum[i] = (k > 0 ? sum[i] : 0.0) + theta[i] * kappa[i];
        }
    }
}

static floe_status set_mixed(mixture_row *q, const mixture_run *run)
{
    set_mixture_temperatures(q, run);
    load_batch(q, run);
    if (run->points) guess_crowded(q, run);
    TRY(solve_batch(q, run));
    store_batch(q, run);
    return FLOE_OK;
}

/* ---- absent materials ---- */

/* A pressure at which the law is defined: an absent gas beside a liquid in tension gets a small one. */
static double defined_pressure(double p, double floor)
{
    return p > floor ? p : floor + 1e-3 * fabs(p) + DBL_MIN;
}

/* The mean velocity and temperature of those present, weighted by mass, and what the law makes of it at the cell's pressure. */
static void extrapolate_gas_state(const mixture_row *q, const mixture_run *run, int r)
{
    const ice_view *v = q->v;
    const ice_fluid *m = &v->m[r];
    const eos *law = &q->v->material[r].eos;
    const double floor = law->model->pressure_floor(law->par);
    const double *present[ICE_MAX_MATERIALS], *p = v->p + run->from, *rho = v->rho_sum + run->from;
    double *T = m->T + run->from;
    for (int k = 0; k < run->count; ++k) present[k] = v->m[run->material[k]].T;
    sum_weighted(q, run, present, T);
    for (int i = 0; i < run->n; ++i) {
        T[i] /= rho[i];
        m->theta[run->from + i] = 0.0;
        q->a[i] = defined_pressure(p[i], floor);
    }
    for (int a = 0; a < v->dim; ++a) memcpy(m->u[a] + run->from, v->mean[a] + run->from, (size_t)run->n * sizeof *T);
    law->model->volume(law->par, (size_t)run->n, q->a, T, q->b, q->c);
    set_response(q, r, run->from, run->n, q->b, m->e + run->from);
}

/* ---- rows ---- */

/* Cells that solids fill have no state, but for the step (ice_cut_ghosts). */
static bool in_a_solid(const mixture_row *q, const mixture_run *run)
{
    const double *open = q->v->m[0].open;
    for (int i = 0; open && i < run->n; ++i)
        if (open[run->from + i] > 0.0) return false;
    return open != NULL;
}

static void leave_empty(const mixture_row *q, const mixture_run *run)
{
    for (int r = 0; r < q->v->n_materials; ++r)
        for (int i = 0; i < run->n; ++i) q->v->m[r].theta[run->from + i] = 0.0;
}

static floe_status close_run(mixture_row *q, const mixture_run *run)
{
    if (run->count == 0 && in_a_solid(q, run)) {
        leave_empty(q, run);
        return FLOE_OK;
    }
    if (run->count == 0) {
        char place[160];
        ice_place(q->s, q->v->b, run->from, -1, place, sizeof place);
        return fail(
            q->s->ctx, FLOE_RETRY,
            "equilibrium pressure: %s holds no material: what was there has left it, and no fluid has followed; fill "
            "the domain with a fluid (ambient, bodies), or take method.interface: sharp, or a smaller time.cfl",
            place);
    }
    set_sums(q, run);
    if (run->count == 1)
        TRY(set_alone(q, run));
    else
        TRY(set_mixed(q, run));
    for (int r = 0; r < q->v->n_materials; ++r)
        if (!(q->set[run->first] >> r & 1u)) extrapolate_gas_state(q, run, r);
    return FLOE_OK;
}

static floe_status mix_row(mixture_row *q, int j, int k)
{
    const ice_view *v = q->v;
    q->owned = j >= 0 && j < v->b->n[1] && k >= 0 && k < v->b->n[2];
    find_sets(q);
    for (int i = 0; i < q->n;) {
        const mixture_run run = run_from(q, i);
        TRY(close_run(q, &run));
        i += run.n;
    }
    for (int r = 0; r < v->n_materials; ++r) {
        ice_find_span(q->s, v->b, v->first + r, j, k, v->m[r].rho);
        /* Advection writes the next state of fluids alone. */
        if (q->v->material[r].points) memcpy(v->m[r].e1 + q->from, v->m[r].e + q->from, (size_t)q->n * sizeof(double));
    }
    return FLOE_OK;
}

static mixture_row mixture_row_of(ice *s, const ice_view *v, int id, int j, int k)
{
    const int n = v->b->n[0] + 2 * MESH_GHOST;
    double *buffer = ice_buffer(s, thread_number());
    return (mixture_row){.s = s,
                         .v = v,
                         .from = mesh_index(v->b, -MESH_GHOST, j, k),
                         .n = n,
                         .guess = field_get(s->domain->fields[id], C_PRESSURE, v->region, 0),
                         .set = s->closure->set[thread_number()],
                         .a = buffer,
                         .b = buffer + n,
                         .c = buffer + 2 * n,
                         .d = buffer + 3 * n,
                         .mixed = &s->closure->cells[thread_number()]};
}

/* Owned cells with several materials, in order. */
static void list_mixed(ice *s, const ice_view *v)
{
    const block *b = v->b;
    ice_cell_list *list = &s->closure->mixed[v->region][b->id];
    list->n = 0;
    for (int k = 0; k < b->n[2]; ++k)
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                if (((int)v->mixed[at] & (ICE_WITH_POINTS - 1)) > 1) list->at[list->n++] = at;
            }
}

floe_status ice_mixture(ice *s, const ice_region *g, int block_id, const ice_view *v)
{
    const ice_rows rows = ice_rows_of(v->b, -1, MESH_GHOST);
    long cells = 0, iterations = 0, fallbacks = 0;
    int bad = 0;
    ice_save_found(s, block_id, v);
#pragma omp parallel for schedule(static) reduction(+ : cells, iterations, fallbacks, bad)
    for (int row = 0; row < rows.n; ++row) {
        const int j = ice_row_j(rows, row), k = ice_row_k(rows, row);
        mixture_row q = mixture_row_of(s, v, block_id, j, k);
        bad += mix_row(&q, j, k) != FLOE_OK;
        cells += q.cells;
        iterations += q.iterations;
        fallbacks += q.fallbacks;
    }
    ledger_tally(s->ledger, COUNT_NEWTON_CELLS, cells);
    ledger_tally(s->ledger, COUNT_NEWTON_ITERATIONS, iterations);
    ledger_tally(s->ledger, COUNT_NEWTON_FALLBACKS, fallbacks);
    if (bad) return FLOE_RETRY;
    list_mixed(s, v);
    ice_widen_spans(s, g, block_id);
    return FLOE_OK;
}

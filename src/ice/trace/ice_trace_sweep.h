/* The sweep of a block: edges of all cells of a row along all axes, their states at the faces (ice_trace_cell.h), and the faces between them. Theory 2.17.
 * One body, which ice_trace_one.c and ice_trace_several.c instantiate. */
#ifndef ICE_TRACE_SWEEP_H
#define ICE_TRACE_SWEEP_H

#include "ice/trace/ice_star.h"
#include "ice/trace/ice_trace_cell.h"

#include <float.h>
#include <string.h>

/* Least pressure that a fluid bears; of several, the largest of these. */
static double pressure_floor_of(const ice_view *v, int fluid)
{
    double floor = -DBL_MAX;
    for (int r = 0; r < v->n_materials; ++r) {
        const eos *law = &v->material[r].eos;
        if (fluid == r || fluid == v->n_materials) floor = most(floor, law->model->pressure_floor(law->par));
    }
    return floor;
}

/* Cells of a fluid, or, its number being that of all fluids, of several, whose velocity and density is then that of all. */
FLOE_ALWAYS_INLINE trace_block trace_block_of(const ice_view *v, int fluid, bool shares, const int dim)
{
    const ice_fluid *m = &v->m[fluid < v->n_materials ? fluid : 0];
    trace_block b = {.rho = shares ? v->rho_sum : m->rho,
                     .p = v->p,
                     .e = m->e,
                     .c = m->c,
                     .volume = m->v,
                     .theta = m->theta,
                     .kappa = v->kappa_sum,
                     .heat = m->heat,
                     .warming = v->P,
                     .lower0 = v->lower0,
                     .upper0 = v->upper0,
                     .dt = v->dt,
                     .floor = pressure_floor_of(v, fluid),
                     .radial = v->radial};
    for (int a = 0; a < dim; ++a) {
        b.force[a] = m->diff[a];
        b.u[a] = shares ? v->mean[a] : m->u[a];
        b.flat[a] = v->flat[a];
        b.stride[a] = v->b->stride[a];
        b.courant[a] = v->dt * v->inv_h[a];
        b.weight[a] = v->gravity[a] * v->h[a];
    }
    return b;
}

FLOE_ALWAYS_INLINE ice_side_of_face side_at(double *const *state, ptrdiff_t t, double c, const int dim)
{
    ice_side_of_face s = {.rho = state[STATE_DENSITY][t],
                          .p = state[STATE_PRESSURE][t],
                          .energy = state[STATE_ENERGY][t],
                          .c = c,
                          .early = state[STATE_EARLY][t]};
    for (int a = 0; a < dim; ++a) s.u[a] = state[STATE_VELOCITY + a][t];
    return s;
}

/* Share of the viscous part that a face goes without: flow far below the speed of sound, and with little dilatation. */
FLOE_ALWAYS_INLINE double slow_share(double mach, double dilatation, double jump, double c)
{
    const double fast = most(least(ICE_TRACE_SLOW * mach, 1.0),
                             least(most(ICE_SHOCK_STEEPNESS * (0.5 * fabs(jump) / c - ICE_SHOCK_FOOT), 0.0), 1.0));
    return (1.0 - fast) * (1.0 - dilatation);
}

/* The share that a face beside the interface of a liquid and a gas keeps: between cells of like impedance. */
FLOE_ALWAYS_INLINE double alike_share(double *const *lower, ptrdiff_t from, double *const *upper, ptrdiff_t t)
{
    const double below = lower[STATE_IMPEDANCE][from], above = upper[STATE_IMPEDANCE][t],
                 ratio = least(below, above) / most(below, above);
    return most(lower[STATE_CONTRAST][from], upper[STATE_CONTRAST][t]) *
           least(most(ICE_TRACE_ALIKE_RISE * (ratio - ICE_TRACE_ALIKE), 0.0), 1.0);
}

/* A face between the upper state of the cell below it, number `from` of its row, and the lower state of the cell above it. */
FLOE_ALWAYS_INLINE ice_star star_at(const trace_block *b, int axis, ptrdiff_t at, double *const *lower, ptrdiff_t from,
                                    double *const *upper, ptrdiff_t t, const int dim, const bool several)
{
    const ptrdiff_t L = at - b->stride[axis];
    const double below = several ? lower[STATE_SOUND][from] : b->c[L],
                 above = several ? upper[STATE_SOUND][t] : b->c[at];
    const ice_side_of_face left = side_at(lower, from, below, dim), right = side_at(upper, t, above, dim);
    const double dilatation = most(lower[STATE_DILATATION][from], upper[STATE_DILATATION][t]),
                 kept = several ? most(dilatation, alike_share(lower, from, upper, t)) : dilatation;
    const double slow = slow_share(most(lower[STATE_MACH][from], upper[STATE_MACH][t]), kept,
                                   b->u[axis][at] - b->u[axis][L], least(below, above));
    return ice_star_of(&left, &right, axis, slow, dim);
}

/* The faces of some cells [first, end) of a row, normal to an axis. `back`: from a cell to that below it in the rows of states. */
FLOE_ALWAYS_INLINE void find_faces(const trace_block *b, const ice_view *v, int r, int axis, ptrdiff_t base,
                                   ice_span cells, double *const *lower, ptrdiff_t back, double *const *upper,
                                   const int dim, const bool several)
{
#pragma omp simd
    for (ptrdiff_t i = cells.first; i < cells.end; ++i) {
        const ptrdiff_t at = base + i;
        const ice_star s = star_at(b, axis, at, lower, 1 + i - back, upper, 1 + i, dim, several);
        v->m[r].fu[axis][at] = s.u[axis];
        v->fp[axis][at] = s.p;
        v->donor_rho[axis][at] = s.rho;
        v->donor_e[axis][at] = s.e;
        for (int a = 0; a < dim; ++a) v->donor_u[axis][a][at] = s.u[a];
    }
}

/* Edges of some cells of a row. */
FLOE_ALWAYS_INLINE void find_row_edges(const trace_block *b, const trace_row *w, ptrdiff_t base, ice_span cells,
                                       const int dim, const trace_kind kind)
{
#pragma omp simd
    for (ptrdiff_t i = cells.first; i < cells.end; ++i) {
        const ptrdiff_t at = base + i;
        double square = 0.0;
        for (int a = 0; a < dim; ++a) square += b->u[a][at] * b->u[a][at];
        const double c = kind == TRACE_ONE ? b->c[at] : medium_of(b, at, kind).c;
        w->mach[1 + i] = sqrt(square) / c;
        w->dilatation[1 + i] = dilatation_share(b, at, c, dim);
        double contrast = 0.0;
        for (int a = 0; a < dim && kind != TRACE_ONE; ++a)
            contrast = most(contrast, contrast_share(b, at, b->stride[a]));
        w->contrast[1 + i] = contrast;
    }
    for (int axis = 0; axis < dim; ++axis) {
#pragma omp simd
        for (ptrdiff_t i = cells.first; i < cells.end; ++i) find_edges(b, w, axis, base + i, 1 + i, dim, kind);
    }
}

FLOE_ALWAYS_INLINE void trace_row_states(const trace_block *b, const trace_row *w, int axis, ptrdiff_t base,
                                         ice_span cells, const int dim, const bool diffuses, const trace_kind kind)
{
#pragma omp simd
    for (ptrdiff_t i = cells.first; i < cells.end; ++i)
        trace_cell(b, w, axis, base + i, i, w->above, dim, diffuses, kind);
}

/* What a row of a region is traced with: a block a fluid, and one where several share cells. */
typedef struct trace_blocks {
    trace_block of[ICE_MAX_MATERIALS + 1];
} trace_blocks;

/* Edges of the cells of a row, where `axis` is none, else their states at the faces along it. Returns whether there are any. */
FLOE_ALWAYS_INLINE bool trace_row_cells(const trace_blocks *blocks, const trace_job *job, const trace_row *w, int axis,
                                        ptrdiff_t base, const int dim, const bool diffuses, const bool several)
{
    const ice_view *v = job->v;
    const int n = v->b->n[0];
    bool some = false;
    for (int r = several ? 0 : job->fluid; r < (several ? v->n_materials : job->fluid + 1); ++r) {
        if (several && v->material[r].points) continue;
        const trace_kind kind = several ? TRACE_ALONE : TRACE_ONE;
        for (ice_span run = {-1, -1}; ice_next_alone(v, r, base, 0, n + 1, &run); some = true)
            if (axis < 0)
                find_row_edges(&blocks->of[r], w, base, run, dim, kind);
            else
                trace_row_states(&blocks->of[r], w, axis, base, run, dim, diffuses, kind);
    }
    if (!several || !job->shares) return some;
    const trace_block *shared = &blocks->of[v->n_materials];
    for (ice_span run = {-1, -1}; ice_next_alone(v, v->n_materials, base, 0, n + 1, &run); some = true)
        if (axis < 0)
            find_row_edges(shared, w, base, run, dim, TRACE_SHARED);
        else
            trace_row_states(shared, w, axis, base, run, dim, diffuses, TRACE_SHARED);
    return some;
}

/* Faces of a row normal to an axis, local cells [0, end). Fluids that share cells have one velocity. */
FLOE_ALWAYS_INLINE void find_row_faces(const trace_blocks *blocks, const trace_job *job, int axis, ptrdiff_t base,
                                       int end, double *const *lower, double *const *upper, const int dim,
                                       const bool several)
{
    const ice_view *v = job->v;
    const ptrdiff_t step = v->b->stride[axis], back = axis == 0 ? 1 : 0;
    for (ice_span run = {0, 0}; several && job->shares && ice_next_traced(v, base, step, end, &run);) {
        find_faces(&blocks->of[0], v, 0, axis, base, run, lower, back, upper, dim, true);
        for (int r = 1; r < v->n_materials; ++r)
            memcpy(v->m[r].fu[axis] + base + run.first, v->m[0].fu[axis] + base + run.first,
                   (size_t)(run.end - run.first) * sizeof(double));
    }
    for (int r = several ? 0 : job->fluid; r < (several ? v->n_materials : job->fluid + 1); ++r) {
        if (several && (job->shares || v->material[r].points)) continue;
        for (ice_span run = {0, 0}; ice_next_alone(v, r, base, step, end, &run);)
            find_faces(&blocks->of[r], v, r, axis, base, run, lower, back, upper, dim, several);
    }
}

/* Faces between a row and the one before it along an axis, whose upper states are kept; and then those of this row. */
FLOE_ALWAYS_INLINE void cross_row(const trace_blocks *blocks, const trace_job *job, const trace_store *s, int axis,
                                  ptrdiff_t base, double *const *kept, bool faces, const int dim, const bool diffuses,
                                  const bool several)
{
    trace_row_cells(blocks, job, &s->row, axis, base, dim, diffuses, several);
    if (faces) find_row_faces(blocks, job, axis, base, job->v->b->n[0], kept, s->row.below, dim, several);
    for (int q = 0; q < STATE_VELOCITY + dim; ++q) memcpy(kept[q], s->row.above[q], s->length * sizeof(double));
    for (int q = STATE_SOUND; several && q < STATES; ++q) memcpy(kept[q], s->row.above[q], s->length * sizeof(double));
}

/* All faces of one row of a slab: those along it where it is the sweep's own, and those to the rows before it. */
FLOE_ALWAYS_INLINE void sweep_row(const trace_blocks *blocks, const trace_job *job, const trace_store *s, int slab,
                                  int row, const int dim, const bool diffuses, const bool several)
{
    const ice_view *v = job->v;
    const int slow = dim - 1, rows = dim == 3 ? v->b->n[1] : 1, n = v->b->n[0];
    const bool own_row = row >= 0 && row < rows, own_slab = dim == 1 || (slab >= job->first && slab < job->last);
    const ptrdiff_t base = mesh_index(v->b, 0, dim == 3 ? row : slab, dim == 3 ? slab : 0);
    if (!trace_row_cells(blocks, job, &s->row, -1, base, dim, diffuses, several)) return;
    if (own_row && own_slab) {
        trace_row_cells(blocks, job, &s->row, 0, base, dim, diffuses, several);
        find_row_faces(blocks, job, 0, base, n + 1, s->row.above, s->row.below, dim, several);
    }
    if (dim == 3 && own_slab) cross_row(blocks, job, s, 1, base, s->kept[1], row >= 0, dim, diffuses, several);
    if (dim > 1 && own_row) {
        double *kept[STATES];
        for (int q = 0; q < STATES; ++q) kept[q] = s->kept[slow][q] + (size_t)row * s->length;
        cross_row(blocks, job, s, slow, base, kept, slab >= job->first && (slab < job->last || job->end), dim, diffuses,
                  several);
    }
}
FLOE_ALWAYS_INLINE double *take_rows(double *from, double **rows, int n, size_t length)
{
    for (int q = 0; q < n; ++q, from += length) rows[q] = from;
    return from;
}

FLOE_ALWAYS_INLINE trace_store divide_buffer(const trace_job *job, const int dim)
{
    const block *b = job->v->b;
    trace_store s = {.length = trace_row_length(b)};
    double *rest = job->buffer;
    for (int a = 0; a < dim; ++a) {
        rest = take_rows(rest, s.row.lower[a], WAVES, s.length);
        rest = take_rows(rest, s.row.upper[a], WAVES, s.length);
        rest = take_rows(rest, s.row.slope[a], SLOPES, s.length);
    }
    rest = take_rows(rest, s.row.below, STATES, s.length);
    rest = take_rows(rest, s.row.above, STATES, s.length);
    rest = take_rows(rest, &s.row.mach, 1, s.length);
    rest = take_rows(rest, &s.row.dilatation, 1, s.length);
    rest = take_rows(rest, &s.row.contrast, 1, s.length);
    for (int a = 1; a < dim; ++a) rest = take_rows(rest, s.kept[a], STATES, s.length * (size_t)(a == 2 ? b->n[1] : 1));
    return s;
}

FLOE_ALWAYS_INLINE void sweep_block(const trace_job *job, const int dim, const bool diffuses, const bool several)
{
    const ice_view *v = job->v;
    const trace_store s = divide_buffer(job, dim);
    const int rows = dim == 3 ? v->b->n[1] : 1, ghost = dim == 3 ? 1 : 0;
    const int end = several ? v->n_materials + job->shares : job->fluid + 1;
    int r = several ? 0 : job->fluid;
    trace_blocks blocks;
    do { /* there is one fluid at least */
        blocks.of[r] = trace_block_of(v, r, several && job->shares, dim);
        blocks.of[r].uneven = job->uneven;
    } while (++r < end);
    for (int slab = dim > 1 ? job->first - 1 : 0; slab <= (dim > 1 ? job->last : 0); ++slab) {
        if (dim > 1 && slab == job->last && !job->end) break;
        for (int row = -ghost; row < rows + ghost; ++row)
            sweep_row(&blocks, job, &s, slab, row, dim, diffuses, several);
    }
}

#endif

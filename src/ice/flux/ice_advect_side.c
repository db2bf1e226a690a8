/* Beside the sweep of ice_advect.c: storage, small volume fractions, open sides, cells that need a closer look; and the
 * stage itself. */
#include "ice/flux/ice_advect.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_tiles.h"

#include <math.h>
#include <string.h>

/* Doubles of one slab. */
static size_t slab_size(const block *b)
{
    const ptrdiff_t size = b->dim == 1 ? (ptrdiff_t)b->size : b->stride[b->dim - 1];
    return (size_t)(size + 7) / 8 * 8;
}

/* How many slabs' worth of rows a thread uses. */
static size_t count_slab_rows(int dim, bool multi)
{
    const int nq = ADVECT_COUNT(dim, multi), inside = dim == 3 ? 2 : 1, across = dim > 1 ? 2 : 0;
    const int rows = 3 * nq + (inside + across) * 2 * (nq + 1) + (inside + across) * (nq + 2) + 3 * dim + 5;
    return (size_t)rows;
}

size_t ice_advect_buffer(const ice *s)
{
    size_t largest = 0;
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const size_t size = slab_size(&s->mesh->block[id]);
        largest = size > largest ? size : largest;
    }
    return largest * count_slab_rows(s->mesh->dim, ice_is_mixture(s));
}

void ice_advect_divide(ice_advect_buffers *w, double *buffer, const block *b, int dim, bool multi)
{
    const size_t size = slab_size(b);
    const int nq = ADVECT_COUNT(dim, multi), inside = dim == 3 ? 2 : 1;
    *w = (ice_advect_buffers){.dim = dim};
    for (int ring = 0; ring < 3; ++ring)
        for (int i = 0; i < nq; ++i, buffer += size) w->q[ring][i] = buffer;
    for (int a = 0; a < inside; ++a) {
        for (int i = 0; i < 2 * (nq + 1); ++i, buffer += size) w->along[a][i] = buffer;
        for (int i = 0; i < nq + 2; ++i, buffer += size) w->flux[a][i] = buffer;
    }
    for (int ring = 0; ring < 2 && dim > 1; ++ring) {
        for (int i = 0; i < 2 * (nq + 1); ++i, buffer += size) w->across[ring][i] = buffer;
        for (int i = 0; i < nq + 2; ++i, buffer += size) w->flux_across[ring][i] = buffer;
    }
    for (int a = 0; a < dim; ++a) {
        w->M[a] = buffer;
        w->g[a] = buffer + size;
        w->y[a] = buffer + 2 * size;
        buffer += 3 * size;
    }
    w->clip = buffer;
    w->fill = buffer + size;
    w->rarest = buffer + 2 * size;
    w->leans = buffer + 3 * size;
    w->none = buffer + 4 * size;
    memset(w->none, 0, size * sizeof *w->none);
}

/* Local index along the slab's own slowest axis and rows: (i, j, k) of row k of a slab. */
static void slab_cell(int dim, int slab, int k, int *j, int *l)
{
    *j = dim == 2 ? slab : dim == 3 ? k : 0;
    *l = dim == 3 ? slab : 0;
}

void ice_advect_clip(ice_advect_buffers *w, const ice_advect_job *job, int slab)
{
    const ice_view *v = job->v;
    const ice_fluid *m = &v->m[job->material];
    const int dim = v->dim;
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab);
    for (int k = ice_slab_first(dim, 1); k < ice_slab_last(v->b, dim, 1); ++k) {
        const ptrdiff_t row = ice_slab_row(v->b, dim, k);
        for (ptrdiff_t i = -1; i <= v->b->n[0]; ++i) {
            const double theta = m->theta[start + row + i];
            double factor = 1.0;
            if (theta > 0.0 && theta <= ICE_TRACE_FRACTION) {
                const double out = ice_outflow(v, m, start + row + i, i, dim);
                if (out > ICE_MOST_TRACE_OUTFLOW) factor = ICE_MOST_TRACE_OUTFLOW / out;
            }
            w->clip[row + i] = factor;
        }
    }
}

static double face_area(const ice_view *v, int axis, int i)
{
    return axis == 0 ? v->area0[i] : v->volume[i] * v->inv_h[axis];
}

/* Enters what row-wise fluxes carry through a side into the tile of its cell; their normal points along the axis. */
static void enter_fluxes(const ice_advect_job *job, double *const *flux, ptrdiff_t t, int axis, mesh_side side,
                         const int cell[MESH_MAX_DIM])
{
    const ice *s = job->s;
    const int dim = job->v->dim, nq = ADVECT_COUNT(dim, job->v->multi);
    const bool upper = side == SIDE_UPPER;
    double *tile = ice_tile(s, job->v->b, cell[0], cell[1], cell[2]), x[MESH_MAX_DIM];
    const double scale = (upper ? -1.0 : 1.0) * face_area(job->v, axis, cell[0] + (axis == 0 && upper)) * job->v->dt;
    ice_side_place(s, job->v->b, axis, upper, cell, x);
    tile[TILE_MASS] += scale * flux[0][t];
    for (int a = 0; a < dim; ++a) ice_add_impulse(tile + TILE_MOMENTUM, x, a, scale * flux[1 + a][t]);
    tile[TILE_ENERGY] += scale * (flux[1 + dim][t] + flux[1 + nq][t]);
}

static bool is_open(bc_kind kind)
{
    return !ice_is_wall(kind);
}

static bool open_side(const ice_advect_job *job, int axis, mesh_side side)
{
    return job->v->b->at_side[axis][side] && !job->s->mesh->periodic[axis] && ice_side_has(job->s, axis, side, is_open);
}

void ice_advect_tally_across(const ice_advect_buffers *w, const ice_advect_job *job, int slab)
{
    const ice_view *v = job->v;
    const int dim = v->dim, slow = dim - 1, n = v->b->n[slow];
    const bool lower = slab == 0 && open_side(job, slow, SIDE_LOWER),
               upper = slab == n && open_side(job, slow, SIDE_UPPER);
    if (!lower && !upper) return;
    const int inside = lower ? 0 : n - 1;
    for (int k = ice_slab_first(dim, 0); k < ice_slab_last(v->b, dim, 0); ++k) {
        int j, l;
        slab_cell(dim, inside, k, &j, &l);
        for (int i = 0; i < v->b->n[0]; ++i)
            enter_fluxes(job, w->flux_across[(slab + 2) & 1], ice_slab_row(v->b, dim, k) + i, slow,
                         lower ? SIDE_LOWER : SIDE_UPPER, (const int[]){i, j, l});
    }
}

void ice_advect_tally_along(const ice_advect_buffers *w, const ice_advect_job *job, int slab)
{
    const ice_view *v = job->v;
    const int dim = v->dim, n0 = v->b->n[0];
    int j, l;
    for (int k = ice_slab_first(dim, 0); k < ice_slab_last(v->b, dim, 0); ++k) {
        slab_cell(dim, slab, k, &j, &l);
        const ptrdiff_t row = ice_slab_row(v->b, dim, k);
        if (open_side(job, 0, SIDE_LOWER)) enter_fluxes(job, w->flux[0], row, 0, SIDE_LOWER, (const int[]){0, j, l});
        if (open_side(job, 0, SIDE_UPPER))
            enter_fluxes(job, w->flux[0], row + n0, 0, SIDE_UPPER, (const int[]){n0 - 1, j, l});
    }
    if (dim < 3) return;
    for (int side = 0; side < 2; ++side) {
        if (!open_side(job, 1, (mesh_side)side)) continue;
        const int face = side == SIDE_LOWER ? 0 : v->b->n[1], inside = side == SIDE_LOWER ? 0 : v->b->n[1] - 1;
        for (int i = 0; i < n0; ++i)
            enter_fluxes(job, w->flux[1], ice_slab_row(v->b, dim, face) + i, 1, (mesh_side)side,
                         (const int[]){i, inside, slab});
    }
}

/* The remaining mass of a material may be so small that its velocity and energy are quotients of round-off; values that
 * no inflow could have produced are replaced by those before the step. */
void ice_clip_roundoff(const ice_fluid *m, ptrdiff_t at, int dim)
{
    double square = m->c[at] * m->c[at];
    for (int a = 0; a < dim; ++a) square += m->u[a][at] * m->u[a][at];
    for (int a = 0; a < dim; ++a)
        if (!(m->u1[a][at] * m->u1[a][at] <= ICE_MOST_GAIN * square)) m->u1[a][at] = m->u[a][at];
    if (!(fabs(m->e1[at]) <= ICE_MOST_GAIN * (fabs(m->e[at]) + square))) m->e1[at] = m->e[at];
}

/* Energy per volume that the update of a cell has made out of nothing: what the guard left out. */
static double defect_of(const ice_advect_buffers *w, const ice_advect_job *job, int slab, ptrdiff_t start,
                        ptrdiff_t row, ptrdiff_t i)
{
    const ice_view *v = job->v;
    const ice_fluid *m = &v->m[job->material];
    const int dim = v->dim, nq = ADVECT_COUNT(dim, job->v->multi);
    const ptrdiff_t at = start + row + i, t = row + i;
    const ice_row_flux f = ice_row_flux_of(w, v, slab);
    double before = m->el[at], after = m->e1[at];
    for (int a = 0; a < dim; ++a) {
        before += 0.5 * m->ul[a][at] * m->ul[a][at];
        after += 0.5 * m->u1[a][at] * m->u1[a][at];
    }
    const double flown = ice_flux_divergence(&f, 1 + dim, t, i, dim) + ice_flux_divergence(&f, 1 + nq, t, i, dim);
    return m->rho1[at] * after - (m->rho[at] * before - flown);
}

/* Where what flows in does not make a traced cell whole (2.17), it gets the heat of its compression as by 2.7, which is entered as a defect. */
static void mend_traced(const ice_view *v, const ice_advect_job *job, ptrdiff_t at)
{
    const ice_fluid *m = &v->m[0];
    if (m->e1[at] > job->energy_floor || !job->conserve) return;
    const double z = m->rho[at] * m->c[at], plain = m->e[at] + ice_compression_work(v, at) / (z * z);
    m->e1[at] += most(plain - m->el[at], 0.0) * m->rho[at] / m->rho1[at];
}

void ice_advect_check(const ice_advect_buffers *w, const ice_advect_job *job, int slab, int k,
                      ice_advect_result *result)
{
    const ice_view *v = job->v;
    const ice_fluid *m = &v->m[job->material];
    const int dim = v->dim;
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab), row = ice_slab_row(v->b, dim, k);
    int j, l;
    slab_cell(dim, slab, k, &j, &l);
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = start + row + i;
        const bool present = !job->v->multi || m->theta[at] > ICE_TRACE_FRACTION;
        if (v->traced && !v->alone) mend_traced(v, job, at);
        if (!ice_mass_stands(m, at, job->v->multi) ||
            (present && (!(ice_outflow(v, m, at, i, dim) <= 1.0) || !(m->e1[at] > job->energy_floor)))) {
            result->bad++;
            continue;
        }
        if (!job->conserve || !(m->rho1[at] > 0.0)) continue;
        if (job->v->multi && m->rho1[at] * m->vol1[at] < ICE_TRACE_FRACTION) ice_clip_roundoff(m, at, dim);
        const double defect = defect_of(w, job, slab, start, row, i);
        if (!(defect > ICE_COUNTED_DEFECT * m->rho1[at] * m->e1[at]))
            continue; /* round-off of cells that were not guarded */
        double *tile = ice_tile(job->s, v->b, i, j, l);
        tile[TILE_DEFECT] += defect * v->volume[i];
        tile[TILE_GUARDS] += 1.0;
        result->guarded++;
    }
}

/* The states at faces of a region (theory 2.17): its sensor, threads and storage. */
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_lean.h"
#include "ice/state/ice_state.h"
#include "ice/trace/ice_trace_rows.h"

#include <math.h>
#include <string.h>

size_t ice_trace_buffer(const ice *s)
{
    const int dim = s->mesh->dim;
    size_t largest = 0;
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const block *b = &s->mesh->block[id];
        const size_t length = trace_row_length(b), rows = (size_t)dim * (2 * WAVES + SLOPES) + 2 * STATES + 3;
        const size_t kept = dim == 1 ? 0 : STATES * (size_t)(dim == 3 ? b->n[1] + 1 : 1);
        largest = length * (rows + kept) > largest ? length * (rows + kept) : largest;
    }
    return largest;
}

/* How much of a slowly moving shock lies in a cell, 0 to 1: such a shock has oscillations behind it unless its states are flattened (Colella and Woodward
 * 1984, appendix; Quirk 1994). It is steep (the pressure's change over two cells is that over four), and nearly stationary by its mass flux and its
 * momentum. */
FLOE_ALWAYS_INLINE double slow_shock_at(const double *restrict rho, const double *restrict u, const double *restrict p,
                                        const double *restrict c, double floor, ptrdiff_t at, ptrdiff_t st)
{
    const double near = p[at + st] - p[at - st], far = p[at + 2 * st] - p[at - 2 * st];
    const bool strong =
        fabs(near) > ICE_TRACE_STRONG * (least(p[at + st], p[at - st]) - floor) && u[at - st] > u[at + st];
    const double steep = ICE_TRACE_STEEP_RISE * (near * far / (far * far + ICE_TINY) - ICE_TRACE_STEEP_FOOT);
    const double lower = rho[at - 2 * st], upper = rho[at + 2 * st],
                 flow = upper * u[at + 2 * st] - lower * u[at - 2 * st];
    const double speed = fabs(flow) / (fabs(upper - lower) + ICE_TINY),
                 fastest = most(fabs(u[at - st]) + c[at - st], fabs(u[at + st]) + c[at + st]);
    const double thrust = fabs(far + upper * u[at + 2 * st] * u[at + 2 * st] - lower * u[at - 2 * st] * u[at - 2 * st]);
    const double stands = least(2.0 - 2.0 * speed / (ICE_TRACE_SLOW_SPEED * fastest),
                                2.0 - 2.0 * thrust / (ICE_TRACE_SLOW_THRUST * fabs(far) + ICE_TINY));
    const double share = least(most(steep, 0.0), 1.0) * least(most(stands, 0.0), 1.0);
    return strong ? share : 0.0;
}

FLOE_ALWAYS_INLINE void slow_shock_run(const ice_view *v, int r, int axis, ptrdiff_t from, ptrdiff_t to, double floor)
{
    const ptrdiff_t st = v->b->stride[axis];
    const double *restrict rho = v->m[r].rho, *restrict u = v->m[r].u[axis], *restrict p = v->p,
                           *restrict c = v->m[r].c;
    double *restrict found = v->flat[axis];
#pragma omp simd
    for (ptrdiff_t at = from; at < to; ++at) found[at] = slow_shock_at(rho, u, p, c, floor, at, st);
}

FLOE_WIDE static void slow_shock_row(const ice_view *v, int j, int k)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const int n = v->b->n[0];
    for (int a = 0; a < v->dim && v->alone; ++a) memset(v->flat[a] + base, 0, (size_t)n * sizeof(double));
    for (int r = 0; r < v->n_materials; ++r) {
        const eos *law = &v->material[r].eos;
        const double floor = law->model->pressure_floor(law->par);
        for (ice_span run = {0, 0}; ice_next_alone(v, r, base, 0, n, &run);)
            for (int a = 0; a < v->dim; ++a) slow_shock_run(v, r, a, base + run.first, base + run.end, floor);
    }
}

static void trace_block_faces(const ice *s, const ice_region *g, const ice_view *v)
{
    const block *b = v->b;
    const int chunks = ice_chunks(s, b);
    const bool shares = ice_traces_shared(s, g);
    trace_slabs *const sweep = (v->multi ? ice_trace_several_kernels : ice_trace_kernels)[b->dim - 1][ice_diffuses(s)];
#pragma omp parallel for schedule(static, 1)
    for (int c = 0; c < chunks; ++c) {
        const ice_span slabs = ice_chunk_of(s, b, c, chunks);
        const trace_job job = {.v = v,
                               .shares = shares,
                               .uneven = ice_bears_unevenly(s, g) ? 1.0 : 0.0,
                               .first = slabs.first,
                               .last = slabs.end,
                               .end = c == chunks - 1,
                               .buffer = ice_buffer(s, c)};
        sweep(&job);
    }
}

/* Pressure of half a step's heat, in the array of the advanced pressure, which is not yet in use. */
static void find_warming(const ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        memset(v.P, 0, (size_t)v.b->size * sizeof *v.P);
        for (int r = 0; r < v.n_materials; ++r)
            if (v.m[r].heat) ice_diffusion_pressure(s, &v, r, v.P);
    }
    ice_fill_ghosts(s, C_PRESSURE_ADVANCED, g->number, FILL_CURRENT, GHOST_EVEN);
    for (int r = g->first; r < g->first + g->n; ++r)
        if (fields_has(s->domain->fields[0], C_DIFFUSION_HEAT, r))
            ice_fill_ghosts(s, C_DIFFUSION_HEAT, r, FILL_CURRENT, GHOST_EVEN);
}

/* Weight (Pa) by which the column in a layer of cells beyond a wall exceeds its mirror image: from the image down to the wall's cell, and beyond that. */
static double weight_beyond(const double *rho, ptrdiff_t at, ptrdiff_t out, int layer, double half, double uneven)
{
    double weight = half * (rho[at - (layer - 1) * out] + rho[at - layer * out]);
    for (int n = 0; n < layer - 1; ++n) {
        const ptrdiff_t image = at - (2 * layer - 1 - n) * out; /* has all neighbours */
        weight += 2.0 * half * ice_mass_to_next(rho, image, out, uneven);
    }
    return weight;
}

/* Beyond a wall the pressure less that of a column at rest is mirrored, and the column goes on. */
static void continue_column(const ice *s, const ice_view *v, int axis, mesh_side side, double uneven)
{
    const ptrdiff_t out = side == SIDE_LOWER ? -v->b->stride[axis] : v->b->stride[axis];
    const double half = (side == SIDE_LOWER ? -0.5 : 0.5) * v->gravity[axis] * v->h[axis], *rho = v->rho_sum;
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    for (int layer = 1; layer <= MESH_GHOST; ++layer) {
        bc_layers(v->b, axis, side, layer, layer, lo, hi);
        for (int k = lo[2]; k < hi[2]; ++k)
            for (int j = lo[1]; j < hi[1]; ++j)
                for (int i = lo[0]; i < hi[0]; ++i) {
                    const ptrdiff_t at = mesh_index(v->b, i, j, k);
                    if (ice_is_wall(ice_condition_at(s, v->b, axis, side, i, j, k)->kind))
                        v->p[at] += weight_beyond(rho, at, out, layer, half, uneven);
                }
    }
}

static void continue_columns(const ice *s, const ice_view *v, double uneven)
{
    for (int axis = 0; axis < v->dim; ++axis)
        for (int side = 0; side < 2; ++side)
            if (v->gravity[axis] != 0.0 && v->b->at_side[axis][side] && !s->mesh->periodic[axis] &&
                ice_side_has(s, axis, (mesh_side)side, ice_is_wall))
                continue_column(s, v, axis, (mesh_side)side, uneven);
}

void ice_trace_faces(const ice *s, const ice_region *g)
{
    const double uneven = ice_bears_unevenly(s, g) ? 1.0 : 0.0;
    ice_view v;
    if (ice_diffuses(s)) find_warming(s, g);
    for (int r = g->first; s->cut && r < g->first + g->n; ++r) ice_fill_ghosts(s, C_OPEN, r, FILL_CURRENT, GHOST_EVEN);
    if (ice_traces_in_part(s)) ice_find_alone(s, g);
    for (int id = 0; ice_next_view(s, g, &id, &v);) continue_columns(s, &v, uneven);
    for (int id = 0; ice_next_view(s, g, &id, &v);) ice_run_cells(&v, 0, slow_shock_row);
    ice_fill_ghosts(s, C_SLOW_SHOCK, g->number, FILL_CURRENT, GHOST_EVEN);
    for (int id = 0; ice_next_view(s, g, &id, &v);) trace_block_faces(s, g, &v);
}

static void follow_side(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t beyond = side == SIDE_LOWER ? at.cell - v->b->stride[axis] : at.cell + v->b->stride[axis];
    const double u = m->fu[axis][at.face];
    const bool enters = u * at.outward < 0.0,
               given = ice_condition_at(s, v->b, axis, side, at.i, at.j, at.k)->kind == BC_INLET;
    const ptrdiff_t from = enters ? beyond : at.cell;
    if (!ice_traced_by(v, r, v->multi ? from : at.cell)) return;
    if (given || (u > 0.0) != (v->donor_u[axis][axis][at.face] > 0.0)) {
        v->donor_rho[axis][at.face] = v->multi ? 1.0 / m->v[from] : m->rho[from];
        v->donor_e[axis][at.face] = m->e[from];
        for (int a = 0; a < v->dim; ++a) v->donor_u[axis][a][at.face] = m->u[a][from];
    }
    v->donor_u[axis][axis][at.face] = u;
}

void ice_trace_follow(const ice *s, const ice_view *v)
{
    for (int r = 0; r < v->n_materials; ++r)
        if (!v->material[r].points) ice_visit_sides(s, v, r, follow_side);
}

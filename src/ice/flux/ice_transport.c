/* The advection stage (theory 2.11): ghosts of the Lagrangian values, the sweeps, and rejection. */
#include "ice/flux/ice_advect.h"
#include "ice/flux/ice_late_weight.h"

#include "ice/exchange/ice_exchange.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_fluid_state.h"
#include "ice/state/ice_state.h"
#include "ice/state/ice_tiles.h"
#include "ice/state/ice_walk.h"

#include <float.h>
#include <math.h>

static void fill_lagrangian(const ice *s, const ice_region *g)
{
    for (int r = g->first; r < g->first + g->n; ++r) {
        if (s->material[r].points) continue;
        ice_fill_ghosts(s, C_VEL_L, r, FILL_CURRENT, GHOST_VELOCITY);
        ice_fill_ghosts(s, C_ENERGY_L, r, FILL_CURRENT, GHOST_ENERGY);
        if (g->n > 1) ice_fill_ghosts(s, C_VOLUME_L, r, FILL_CURRENT, GHOST_VOLUME);
        if (ice_reaction_count(s) > 0) ice_fill_ghosts(s, C_RHO_L, r, FILL_CURRENT, GHOST_DENSITY);
    }
}

/* What threads compute does not depend on their number. */
static ice_advect_result advect_block(ice *s, const ice_view *v, int r)
{
    const block *b = v->b;
    const int chunks = ice_chunks(s, b);
    const double floor = v->material[r].energy_floor;
    ice_advect_slabs *const sweep =
        v->traced && !v->alone ? ice_advect_traced[v->dim - 1] : ice_advect_kernels[v->dim - 1][v->multi];
    int bad = 0, guarded = 0;
#pragma omp parallel for schedule(static, 1) reduction(+ : bad, guarded)
    for (int c = 0; c < chunks; ++c) {
        const ice_span slabs = ice_chunk_of(s, b, c, chunks);
        const ice_advect_job job = {.s = s,
                                    .v = v,
                                    .material = r,
                                    .first = slabs.first,
                                    .last = slabs.end,
                                    .conserve = s->scene->method.conserve_energy,
                                    .energy_floor = isnan(floor) ? -DBL_MAX : floor,
                                    .buffer = ice_buffer(s, c)};
        const ice_advect_result result = sweep(&job);
        bad += result.bad;
        guarded += result.guarded;
    }
    return (ice_advect_result){bad, guarded};
}

/* What is wrong with the next state of a cell, or NULL. */
static const char *fault_of(const ice_view *v, int r, ptrdiff_t at, int i)
{
    const ice_fluid *m = &v->m[r];
    if (!ice_mass_stands(m, at, v->multi)) return "its mass would become negative or is no number";
    if (v->multi && !(m->theta[at] > ICE_TRACE_FRACTION)) return NULL;
    if (!(ice_outflow(v, m, at, i, v->dim) <= 1.0)) return "more would flow out than it holds";
    const eos *law = &v->material[r].eos;
    if (!(m->rho1[at] > 0.0)) return NULL;
    const double density = v->multi ? 1.0 / m->vol1[at] : m->rho1[at];
    if (!(m->e1[at] > law->model->energy_floor(law->par, density)))
        return "its internal energy would fall below the law's floor";
    return NULL;
}

/* The first faulty cell of the block, as a message. */
static floe_status explain_transport_fault(const ice *s, const ice_view *v, int r)
{
    const ice_fluid *m = &v->m[r];
    for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
        const char *fault = fault_of(v, r, c.at, c.in[0]);
        if (!fault) continue;
        char place[160];
        ice_place(s, v->b, c.at, v->first + r, place, sizeof place);
        return fail(s->ctx, FLOE_RETRY,
                    "advection, %s: %s (density %g to %g kg/m3, internal energy %g to %g J/kg, outflow %g of "
                    "the volume, step %g s)",
                    place, fault, m->rho[c.at], m->rho1[c.at], m->e[c.at], m->e1[c.at],
                    ice_outflow(v, m, c.at, c.in[0], v->dim), s->dt);
    }
    return FLOE_OK;
}

/* For laws whose energy floor depends on density, which must be evaluated cell by cell. */
static bool below_floor(const ice_view *v, int r)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    int found = 0;
#pragma omp parallel for schedule(static) reduction(+ : found)
    for (int row = 0; row < q.n; ++row)
        for (int i = 0; i < v->b->n[0]; ++i)
            found += fault_of(v, r, mesh_index(v->b, i, ice_row_j(q, row), ice_row_k(q, row)), i) != NULL;
    return found > 0;
}

/* What is left of a material below ICE_LEAST_FRACTION of a cell, or ICE_LEAST_SHARE of its mass (a trace of gas in a
 * liquid under tension may fill a lot), is dropped; in small volume fractions, what advection's round-off has left
 * without a temperature is given the last one at the last pressure (theory 6). Both are entered in the ledger. */
static double total_energy(const ice_fluid *m, ptrdiff_t at, int dim)
{
    double square = 0.0;
    for (int a = 0; a < dim; ++a) square += m->u1[a][at] * m->u1[a][at];
    return m->rho1[at] * (m->e1[at] + 0.5 * square);
}

/* The change of velocity and energy of a trace fraction is entered into the ledger. */
static void clip_roundoff(const ice_view *v, ptrdiff_t at, const ice_fluid *m, double volume, const double *x,
                          double *tile)
{
    const double before = total_energy(m, at, v->dim);
    double u[3];
    for (int a = 0; a < v->dim; ++a) u[a] = m->u1[a][at];
    ice_clip_roundoff(m, at, v->dim);
    if (!isfinite(before)) return;
    tile[TILE_DEFECT] += (total_energy(m, at, v->dim) - before) * volume;
    for (int a = 0; a < v->dim; ++a)
        ice_add_impulse(tile + TILE_MOMENTUM_DEFECT, x, a, m->rho1[at] * (m->u1[a][at] - u[a]) * volume);
}

static void drop_material(const ice_view *v, int r, ptrdiff_t at, double volume, const double *x, double *tile)
{
    const ice_fluid *m = &v->m[r];
    const double mass = m->rho1[at] * volume;
    tile[TILE_MASS_DEFECT] -= mass;
    for (int a = 0; a < v->dim; ++a) ice_add_impulse(tile + TILE_MOMENTUM_DEFECT, x, a, -mass * m->u1[a][at]);
    tile[TILE_DEFECT] -= total_energy(m, at, v->dim) * volume;
    m->rho1[at] = 0.0;
}

static void mend_material(const ice_view *v, int r, ptrdiff_t at, double volume, const double *x, double *tile)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &v->material[r].eos;
    double density = 1.0 / m->vol1[at], T;
    law->model->temperature(law->par, 1, &density, &m->e1[at], &T);
    if (T > 0.0 && m->vol1[at] > 0.0 && isfinite(T)) return;
    if (!(m->T[at] > 0.0) || !(v->p[at] > law->model->pressure_floor(law->par))) {
        drop_material(v, r, at, volume, x, tile);
        return;
    }
    tile[TILE_DEFECT] -= total_energy(m, at, v->dim) * volume;
    const ice_reservoir state = ice_state_at(law, v->p[at], m->T[at]);
    m->vol1[at] = state.v;
    m->e1[at] = state.e;
    tile[TILE_DEFECT] += total_energy(m, at, v->dim) * volume;
    tile[TILE_FLOORS] += 1.0;
}

static void clip_traces(const ice *s, const ice_view *v, int r)
{
    const block *b = v->b;
    const ice_fluid *m = &v->m[r];
    for (int k = 0; k < b->n[2]; ++k)
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                const double fraction = m->rho1[at] * m->vol1[at];
                const bool starved = m->rho1[at] < ICE_LEAST_SHARE * v->rho_sum[at];
                if (m->rho1[at] == 0.0 || (fraction >= ICE_TRACE_FRACTION && !starved)) continue;
                if (s->cut && s->cut->is_merged(s, v->region, b, i, j, k)) continue; /* as merged cells */
                double *tile = ice_tile(s, b, i, j, k), x[MESH_MAX_DIM];
                ice_place_of(s, b, (const int[]){i, j, k}, x);
                clip_roundoff(v, at, m, v->volume[i], x, tile);
                if (starved || fraction < ICE_LEAST_FRACTION)
                    drop_material(v, r, at, v->volume[i], x, tile);
                else
                    mend_material(v, r, at, v->volume[i], x, tile);
            }
}

/* Speed (m/s) that a face of a side imposes. */
static double imposed_speed(const ice *s, const bc_side *given, int axis)
{
    if (given->kind == BC_VELOCITY) return bc_velocity(given, axis, s->time + 0.5 * s->dt);
    return given->kind == BC_INLET ? given->velocity[axis] : 0.0;
}

/* A side has no volume that could run out, so nothing else bounds what it lets in. */
static floe_status check_sides(const ice *s)
{
    const mesh *m = s->mesh;
    double most[MESH_MAX_DIM][2] = {{0.0}};
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);)
        for (int a = 0; a < m->dim; ++a)
            for (int side = 0; side < 2; ++side) {
                if (!v.b->at_side[a][side]) continue;
                int hi[MESH_MAX_DIM] = {v.b->n[0], v.b->n[1], v.b->n[2]};
                hi[a] = 1;
                if (!ice_side_differs(s, a, (mesh_side)side)) hi[0] = hi[1] = hi[2] = 1;
                for (int k = 0; k < hi[2]; ++k)
                    for (int j = 0; j < hi[1]; ++j)
                        for (int i = 0; i < hi[0]; ++i) {
                            const bc_side *given = ice_condition_at(s, v.b, a, (mesh_side)side, i, j, k);
                            most[a][side] = fmax(most[a][side], fabs(imposed_speed(s, given, a)));
                        }
            }
    for (int a = 0; a < m->dim; ++a)
        for (int side = 0; side < 2; ++side)
            if (!(most[a][side] * s->dt <= m->h[a]))
                return fail(
                    s->ctx, FLOE_RETRY,
                    "advection: the velocity of %g m/s at the %s side of axis %d crosses more than a cell (%g m) in a "
                    "step of %g s",
                    most[a][side], side == SIDE_LOWER ? "lower" : "upper", a, m->h[a], s->dt);
    return FLOE_OK;
}

floe_status ice_advect_of(ice *s, const ice_region *g)
{
    TRY(check_sides(s));
    fill_lagrangian(s, g);
    ice_clear_tiles(s);
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        ice_view_lagrangian(&v);
        for (int r = 0; r < v.n_materials; ++r) {
            if (v.material[r].points) continue;
            const ice_advect_result result = advect_block(s, &v, r);
            if (result.bad || (isnan(v.material[r].energy_floor) && below_floor(&v, r)))
                TRY(explain_transport_fault(s, &v, r));
            if (v.multi) clip_traces(s, &v, r);
        }
        ice_late_weight(s, &v);
    }
    ice_enter_tiles(s);
    return FLOE_OK;
}

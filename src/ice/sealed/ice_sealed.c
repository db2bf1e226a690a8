/* Gases separated by embedded boundaries (theory 7.1). Each gas is a single fluid in the cells that are open to it,
 * with density, velocity, energy and pressure of its own. The stages are those of one fluid, applied to one region after the other, with
 * three differences: cells at the boundary are merged (ice_merged_cells.h); fluxes are multiplied by the mean aperture of the face in
 * the step; and the state of a gas is extrapolated into cells without it, for the differences near the boundary.
 * Nothing crosses the boundary, whatever the step, the mesh or the pressures. */
#include "ice/sealed/ice_merged_cells.h"
#include "ice/sealed/ice_wall_flow.h"

#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/flux/ice_flux.h"
#include "ice/fraction/ice_fraction.h"
#include "ice/ice_constants.h"
#include "ice/pressure/ice_pressure.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_traced.h"

#include <math.h>
#include <stdio.h>

static floe_status for_regions(ice *s, floe_status (*stage)(ice *, const ice_region *))
{
    for (int g = 0; g < s->n_regions; ++g) TRY(stage(s, &s->region[g]));
    return FLOE_OK;
}

/* ---- cells without the gas ---- */

/* Marks of cells that have a state, during the stage; stored in the array of the shock sensor. */
static void mark_open(const ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->sealing->view[id];
        const fluid_state *rest = &s->sealing->rest[g->number];
        const ice_fluid *m = &v->m[0];
        const ice_rows q = ice_rows_of(v->b, -1, 0);
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v->b->n[0]; ++i) {
                const int j = ice_row_j(q, row), k = ice_row_k(q, row);
                const ptrdiff_t at = mesh_index(v->b, i, j, k);
                v->shock[at] = m->open[at] > 0.0 ? 1.0 : 0.0;
                if (m->open[at] > 0.0) continue;
                if (v->multi) {
                    ice_rest_fluids(s, v, at);
                    continue;
                }
                m->rho[at] = rest->density;
                m->e[at] = rest->energy;
                for (int a = 0; a < s->mesh->dim; ++a) m->u[a][at] = 0.0;
            }
    }
}

static void fill_state(const ice *s, const ice_region *g)
{
    for (int r = g->first; r < g->first + g->n; ++r) {
        ice_fill_ghosts(s, C_RHO, r, FILL_CURRENT, GHOST_DENSITY);
        ice_fill_ghosts(s, C_VEL, r, FILL_CURRENT, GHOST_VELOCITY);
        ice_fill_ghosts(s, C_ENERGY, r, FILL_CURRENT, GHOST_ENERGY);
        if (g->n > 1) ice_fill_ghosts(s, C_VOL, r, FILL_CURRENT, GHOST_VOLUME);
    }
    ice_fill_ghosts(s, C_SHOCK, g->number, FILL_CURRENT, GHOST_EVEN);
}

/* Extrapolates a state into a cell without the gas: the mean of its neighbours with marks of at least `least`. */
static void extrapolate_state(const ice_view *v, ptrdiff_t at, double least)
{
    const ice_fluid *m = &v->m[0];
    double n = 0.0, rho = 0.0, e = 0.0, u[3] = {0.0};
    const int around = v->b->dim == 1 ? 3 : v->b->dim == 2 ? 9 : 27;
    for (int c = 0; c < around; ++c) {
        const ptrdiff_t from = at + ice_way_to(v->b, c);
        if (!(v->shock[from] >= least)) continue;
        n += 1.0;
        rho += m->rho[from];
        e += m->e[from];
        for (int a = 0; a < v->b->dim; ++a) u[a] += m->u[a][from];
    }
    if (n == 0.0) return;
    m->rho[at] = rho / n;
    m->e[at] = e / n;
    for (int a = 0; a < v->b->dim; ++a) m->u[a][at] = u[a] / n;
    v->shock[at] = 0.5 * least;
}

/* Two layers: as far as differences reach. */
static void extrapolate_layers(const ice *s, const ice_region *g)
{
    double least = 1.0;
    for (int layer = 0; layer < 2; ++layer, least *= 0.5) {
        fill_state(s, g);
        for (int id = 0; id < s->mesh->n_blocks; ++id) {
            const ice_view *v = &s->sealing->view[id];
            const ice_rows q = ice_rows_of(v->b, -1, 0);
            for (int row = 0; row < q.n; ++row) {
                const ptrdiff_t base = mesh_index(v->b, 0, ice_row_j(q, row), ice_row_k(q, row));
                for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
                    if (v->shock[at] < least) (v->multi ? ice_extrapolate_fluids : extrapolate_state)(v, at, least);
            }
        }
    }
}

static floe_status extrapolate_states(ice *s, const ice_region *g)
{
    TRY(ice_merge_cells(s, MERGE_BEFORE, &s->sealing->now[g->number]));
    ice_seal_views(s, g);
    if (g->n > 1) TRY(ice_remerge_fluids(s, g));
    mark_open(s, g);
    extrapolate_layers(s, g);
    if (g->n > 1) ice_join_covered(s, g);
    return FLOE_OK;
}

floe_status ice_sealed_ghosts(ice *s)
{
    TRY(for_regions(s, extrapolate_states));
    return ice_boundary_ghosts(s);
}

/* ---- the plain stages, gas by gas ---- */

/* In merged cells as in their lead. */
static floe_status react_alike(ice *s, const ice_region *g)
{
    TRY(ice_react_of(s, g));
    ice_agree_reacted(s, g);
    return FLOE_OK;
}

static floe_status find_pressure(ice *s, const ice_region *g)
{
    TRY(ice_equilibrium_pressure_of(s, g));
    if (g->n > 1) ice_agree_closed(s, g);
    if (ice_reaction_count(s) > 0) TRY(react_alike(s, g));
    if (ice_some_pair_slips(s)) TRY(ice_wall_fraction_of(s, g));
    if (ice_has_weight(s)) ice_merged_lift(s, g);
    if (g->n > 1) TRY(ice_find_interfaces_of(s, g));
    if (g->n > 1) ice_agree_interfaces(s, g);
    return FLOE_OK;
}

floe_status ice_sealed_pressure(ice *s)
{
    return for_regions(s, find_pressure);
}

/* What viscous fluids see of the boundaries in the step. */
floe_status ice_sealed_wall_flow(ice *s)
{
    return for_regions(s, ice_find_wall_flow);
}

static floe_status find_velocity(ice *s, const ice_region *g)
{
    ice_find_cell_sensors(s, g);
    ice_merged_centring(s, g);
    ice_find_face_velocity(s, g);
    return FLOE_OK;
}

floe_status ice_sealed_velocity(ice *s)
{
    return for_regions(s, find_velocity);
}

static floe_status find_increment(ice *s, const ice_region *g)
{
    ice_find_increment(s, g);
    ice_merged_increment(s, g);
    ice_fill_increment(s, g);
    return FLOE_OK;
}

floe_status ice_sealed_increment(ice *s)
{
    return for_regions(s, find_increment);
}

floe_status ice_sealed_face_pressure(ice *s)
{
    return for_regions(s, ice_face_pressure_of);
}

static double side_aperture(const ice *s, int region, const block *b, const int local[3], int axis, int side)
{
    return ice_mean_face(s, region, (const int[]){b->lo[0] + local[0], b->lo[1] + local[1], b->lo[2] + local[2]}, axis,
                         side);
}

const ice_cut_geometry ice_sealed_geometry = {side_aperture, ice_is_merged, ice_bound_merged};

/* ---- after the points have moved ---- */

/* Share of the lower face of a local cell that is open to the gas in the mean of the step; beyond the last cell, of its
 * upper face. */
static double mean_open(const ice *s, const ice_region *g, const block *b, int axis, int i, int j, int k)
{
    int cell[3] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k}, side = SIDE_LOWER;
    if (cell[axis] == s->mesh->n[axis]) {
        cell[axis]--;
        side = SIDE_UPPER;
    }
    return ice_mean_face(s, g->number, cell, axis, side);
}

/* From velocities of the gas to volume fluxes per area of the whole face. */
static floe_status apply_apertures(ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->sealing->view[id];
        for (int axis = 0; axis < s->mesh->dim; ++axis) {
            const ice_rows q = ice_rows_of(v->b, axis, 0);
#pragma omp parallel for schedule(static)
            for (int row = 0; row < q.n; ++row) {
                const int j = ice_row_j(q, row), k = ice_row_k(q, row);
                for (int i = 0; i < v->b->n[0] + (axis == 0); ++i) {
                    const ptrdiff_t face = mesh_index(v->b, i, j, k);
                    const double share = mean_open(s, g, v->b, axis, i, j, k);
                    for (int r = 0; r < v->n_materials; ++r) v->m[r].fu[axis][face] *= share;
                    if (v->multi) v->flux[axis][face] *= share;
                }
            }
        }
    }
    return FLOE_OK;
}

/* What several fluids of a cell do to each other is that of whole cells (theory 2.9, 2.10). */
static floe_status exchange_among(ice *s, const ice_region *g)
{
    if (ice_reaction_count(s) > 0) TRY(ice_mass_exchange_of(s, g));
    TRY(ice_exchange_of(s, g));
    ice_agree_exchanged(s, g);
    return ice_specific_volume_of(s, g);
}

/* Cells that the boundary uncovers in the step are merged by now: work is done on the gas that flows into them. */
static floe_status find_sources(ice *s, const ice_region *g)
{
    TRY(ice_merge_cells(s, MERGE_MOVING, &s->sealing->now[g->number]));
    ice_seal_views(s, g);
    TRY(apply_apertures(s, g));
    ice_find_sources(s, g);
    ice_merged_sources(s, g);
    TRY(ice_finish_sources(s, g));
    return g->n > 1 ? exchange_among(s, g) : FLOE_OK;
}

floe_status ice_sealed_sources(ice *s)
{
    return for_regions(s, find_sources);
}

/* ---- open fractions ---- */

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
    sum[MERGED_VOLUME] += k->open * mesh_cell_volume(s->mesh, k->cell[0]);
}

static void renew_open(const ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->sealing->view[id];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);)
            for (int r = 0; r < v->n_materials; ++r)
                v->m[r].open1[c.at] = ice_open_cell(s, g->number, SEAL_NEXT, c.cell);
    }
}

/* Cells away from the boundary that are closed to the gas are empty. */
static void empty_elsewhere(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->sealing->view[id];
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

/* Merged cells that no gas has reached: a gap between bodies in contact, closed to all others. It opens by round-off
 * where their surfaces, straight between different markers, lie on one another, and may grow; at the start only such
 * small volume fractions are none's. */
static bool is_void(const ice *s, const ice_merged_cells *p, int merged, bool next)
{
    const double *sum = p->sum + (size_t)merged * MERGED_SUMS;
    const double cell = mesh_cell_volume(s->mesh, p->member[p->lead[merged]].cell[0]);
    if (sum[MERGED_MASS] == 0.0 && next) return true;
    return sum[MERGED_VOLUME] < ICE_GAP_FRACTION * cell &&
           fabs(sum[MERGED_MASS]) <= ICE_GAP_DENSITY * s->sealing->rest[p->region->number].density * sum[MERGED_VOLUME];
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
        const ice_fluid *m = &s->sealing->view[member->block].m[0];
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

static floe_status advect_gas(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->sealing->next[g->number];
    TRY(ice_advect_of(s, g));
    ice_seal_views(s, g);
    for (int id = 0; id < s->mesh->n_blocks; ++id) ice_view_lagrangian(&s->sealing->view[id]);
    TRY(ice_merge_cells(s, MERGE_AFTER, p));
    ledger_tally(s->ledger, COUNT_CELLS_MERGED, p->n - p->count);
    renew_open(s, g);
    if (g->n > 1) {
        TRY(ice_renew_fluids(s, g));
        empty_elsewhere(s);
        return FLOE_OK;
    }
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) add_contents(s, &p->member[k], p->sum + (size_t)p->member[k].merged * MERGED_SUMS);
    empty_elsewhere(s);
    return share_out(s, p, true);
}

floe_status ice_sealed_advect(ice *s)
{
    return for_regions(s, advect_gas);
}

/* ---- the start ---- */

static void add_first_contents(const ice *s, const ice_member *k, double *sum)
{
    const ice_fluid *m = &s->sealing->view[k->block].m[0];
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
        const ice_view *v = &s->sealing->view[id];
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

static floe_status start_gas(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->sealing->now[g->number];
    ice_seal_views(s, g);
    TRY(ice_merge_cells(s, MERGE_BEFORE, p));
    ice_clear_merged(p);
    if (g->n > 1) TRY(ice_start_fluids(s, g));
    for (int k = 0; k < p->n && g->n == 1; ++k)
        add_first_contents(s, &p->member[k], p->sum + (size_t)p->member[k].merged * MERGED_SUMS);
    if (g->n == 1) TRY(share_out(s, p, false));
    return find_empty(s);
}

floe_status ice_sealed_merge_start(ice *s)
{
    return for_regions(s, start_gas);
}

/* ---- the stages ---- */

floe_status ice_sealed_pressure_stages(ice *s)
{
    const bool m = ice_is_mixture(s), r = ice_reaction_count(s) > 0, slips = m && ice_some_pair_slips(s),
               t = ice_may_trace(s);
    STAGE(s, ALWAYS, ice_sealed_ghosts, READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, WHEN(m, C_VOL)),
          WRITES(C_RHO, C_VEL, C_ENERGY, C_SHOCK, WHEN(m, C_VOL), WHEN(m, C_PRESSURE)));
    STAGE(s, ALWAYS, ice_sealed_pressure,
          READS(C_RHO, C_ENERGY, WHEN(m, C_VEL), WHEN(m, C_VOL), WHEN(m, C_TEMP), WHEN(m, C_PRESSURE),
                WHEN(slips, C_OPEN)),
          WRITES(C_PRESSURE, C_SOUND, WHEN(m, C_VEL), WHEN(m, C_ENERGY), WHEN(m, C_VOL), WHEN(m, C_TEMP),
                 WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_RHO_SUM), WHEN(m, C_VEL_MEAN),
                 WHEN(m, C_MIXED), WHEN(m, C_INTERFACE), WHEN(m, C_ENERGY_FOUND), WHEN(m, C_VOLUME_FOUND),
                 WHEN(r, C_REACTED), WHEN(slips, C_WALL), WHEN(slips, C_OPEN)));
    STAGE(s, ice_is_viscous(s), ice_sealed_wall_flow, READS(C_RHO, C_VEL, C_OPEN), WRITES(C_VEL_CENTRED));
    STAGE(s, ALWAYS, ice_sealed_velocity,
          READS(C_RHO, C_VEL, C_PRESSURE, C_SOUND, WHEN(m, C_THETA), WHEN(m, C_VEL_MEAN), WHEN(m, C_RHO_SUM),
                WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(m, C_VOL), WHEN(slips, C_WALL), WHEN(t, C_ENERGY),
                WHEN(t, C_OPEN), WHEN(m && t, C_KAPPA), WHEN(m && t, C_INTERFACE)),
          WRITES(F_VEL, C_SHOCK, WHEN(t, C_OPEN), WHEN(t, C_PRESSURE), WHEN(t, C_SLOW_SHOCK), WHEN(t, C_ALONE),
                 WHEN(t, F_PRESSURE), WHEN(t, F_DONOR_DENSITY), WHEN(t, F_DONOR_ENERGY), WHEN(t, F_DONOR_VEL)));
    STAGE(s, ALWAYS, ice_sealed_increment,
          READS(F_VEL, C_RHO, C_VEL, C_PRESSURE, C_SOUND, C_SHOCK, WHEN(m, C_THETA), WHEN(m, C_VEL_MEAN),
                WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(m, C_INTERFACE), WHEN(r, C_REACTED)),
          WRITES(C_DP, C_PRESSURE_ADVANCED, WHEN(m, C_LIMITER), WHEN(m, F_THETA), WHEN(m, F_FLUX)));
    STAGE(s, ALWAYS, ice_sealed_face_pressure,
          READS(C_PRESSURE_ADVANCED, C_RHO, WHEN(m, C_RHO_SUM), WHEN(t, F_PRESSURE), WHEN(t, C_ALONE)),
          WRITES(F_PRESSURE));
    STAGE(s, ALWAYS, ice_sealed_load, READS(C_PRESSURE_ADVANCED), WRITES(NOTHING));
    return FLOE_OK;
}

floe_status ice_sealed_flow_stages(ice *s)
{
    const bool m = ice_is_mixture(s), k = ice_conducts(s), r = ice_reaction_count(s) > 0,
               slips = m && ice_some_pair_slips(s), t = ice_may_trace(s);
    STAGE(s, s->walls, ice_sealed_give_way,
          READS(C_DP, C_PRESSURE_ADVANCED, C_RHO, F_PRESSURE, WHEN(m, C_RHO_SUM), WHEN(t, C_ALONE)),
          WRITES(C_DP, C_PRESSURE_ADVANCED, F_PRESSURE));
    STAGE(s, ALWAYS, ice_sealed_sources,
          READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, F_PRESSURE, F_VEL, C_DP, C_PRESSURE_ADVANCED, C_SOUND, C_PRESSURE,
                WHEN(m, F_FLUX), WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_RHO_SUM),
                WHEN(m, C_MIXED), WHEN(m, C_VOL), WHEN(m, C_TEMP), WHEN(m, C_INTERFACE), WHEN(m, C_SHOCK),
                WHEN(m && ice_has_diffusion(s), C_VEL_MEAN), WHEN(ice_is_viscous(s), C_VEL_CENTRED), WHEN(r, C_REACTED),
                WHEN(slips, C_WALL)),
          WRITES(C_VEL_L, C_ENERGY_L, F_VEL, WHEN(m, F_FLUX), WHEN(m, C_HEAT_OWED), WHEN(m, C_VOLUME_L),
                 WHEN(k, C_DIFFUSION_T), WHEN(r, C_RHO_L)));
    STAGE(s, ALWAYS, ice_sealed_advect,
          READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, C_PRESSURE, F_VEL, F_PRESSURE, C_DP, C_SHOCK, C_SOUND, C_VEL_L,
                C_ENERGY_L, WHEN(m, C_VOL), WHEN(m, C_VOLUME_L), WHEN(m, C_THETA), WHEN(m, C_KAPPA_SUM),
                WHEN(m, C_RHO_SUM), WHEN(m, C_LIMITER), WHEN(m, C_TEMP), WHEN(m, C_INTERFACE), WHEN(m, F_THETA),
                WHEN(r, C_RHO_L), WHEN(t, F_DONOR_DENSITY), WHEN(t, F_DONOR_ENERGY), WHEN(t, F_DONOR_VEL),
                WHEN(t, C_ALONE)),
          WRITES(C_RHO, C_VEL, C_ENERGY, C_OPEN, C_VEL_L, C_ENERGY_L, WHEN(m, C_VOL), WHEN(m, C_VOLUME_L),
                 WHEN(r, C_RHO_L)));
    return FLOE_OK;
}

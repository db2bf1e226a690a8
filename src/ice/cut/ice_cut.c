/* Gases separated by embedded boundaries (theory 7.1). Each gas is a single fluid in the cells that are open to it,
 * with density, velocity, energy and pressure of its own. The stages are those of one fluid, applied to one region after the other, with
 * three differences: cells at the boundary are merged (ice_merged_cells.h); fluxes are multiplied by the mean aperture of the face in
 * the step; and the state of a gas is extrapolated into cells without it, for the differences near the boundary.
 * Nothing crosses the boundary, whatever the step, the mesh or the pressures. */
#include "ice/cut/ice_merged_cells.h"
#include "ice/cut/ice_merged_pieces.h"
#include "ice/cut/ice_wall_flow.h"

#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/flux/ice_flux.h"
#include "ice/fraction/ice_fraction.h"
#include "ice/inject/ice_inject.h"
#include "ice/pressure/ice_pressure.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_traced.h"

static floe_status for_regions(ice *s, floe_status (*stage)(ice *, const ice_region *))
{
    for (int g = 0; g < s->n_regions; ++g) TRY(stage(s, &s->region[g]));
    return FLOE_OK;
}

floe_status ice_cut_ghosts(ice *s)
{
    TRY(for_regions(s, ice_extrapolate_states));
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

floe_status ice_cut_pressure(ice *s)
{
    return for_regions(s, find_pressure);
}

/* What viscous fluids see of the boundaries in the step; with the implicit pressure also what viscosity does to faces. */
static floe_status find_wall_flow(ice *s, const ice_region *g)
{
    TRY(ice_find_wall_flow(s, g));
    if (s->implicit && ice_is_viscous(s)) ice_cut_viscous_rates(s, g);
    if (ice_is_viscous(s)) TRY(ice_spread_velocities(s, g));
    if (ice_covered_stick(s)) ice_stick_covered(s, g);
    return FLOE_OK;
}

floe_status ice_cut_wall_flow(ice *s)
{
    return for_regions(s, find_wall_flow);
}

static floe_status find_velocity(ice *s, const ice_region *g)
{
    ice_find_cell_sensors(s, g);
    ice_merged_centring(s, g);
    ice_find_face_velocity(s, g);
    ice_merged_advance(s, g);
    return FLOE_OK;
}

floe_status ice_cut_velocity(ice *s)
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

floe_status ice_cut_increment(ice *s)
{
    return for_regions(s, find_increment);
}

floe_status ice_cut_face_pressure(ice *s)
{
    return for_regions(s, ice_face_pressure_of);
}

static double side_aperture(const ice *s, int region, const block *b, const int local[3], int axis, int side)
{
    return ice_mean_face(s, region, (const int[]){b->lo[0] + local[0], b->lo[1] + local[1], b->lo[2] + local[2]}, axis,
                         side);
}

/* Those that are merged after the step have one state, which they keep. */
static void spread_weights(const ice *s, const ice_region *g, double *const *weight)
{
    const ice_merged_cells *p = &s->cut_cells->next[g->number];
    ice_clear_merged(&s->cut_cells->next[g->number]);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        sum[MERGED_MASS] += weight[m->block][m->at];
        sum[MERGED_VOLUME] += m->open * mesh_cell_volume(s->mesh, m->cell[0]);
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        const double open = m->open * mesh_cell_volume(s->mesh, m->cell[0]);
        weight[m->block][m->at] = open > 0.0 ? sum[MERGED_MASS] * open / sum[MERGED_VOLUME] : 0.0;
    }
}

const ice_cut_geometry ice_embedded_geometry = {side_aperture, ice_is_merged, ice_bound_merged, spread_weights,
                                                ice_rollback_spread};

/* ---- after the points have moved ---- */

/* A cut cell without gas at the start of the step, covered or a pocket between solids that no gas has reached. */
static bool is_empty(const ice *s, const ice_merged_cells *p, const int cell[3])
{
    const int member = p->place[cut_index(s->mesh, cell)];
    return member >= 0 && p->member[member].open == 0.0;
}

/* Whether a lower face lies between two such: nothing passes from one to another. */
static bool divides_empty(const ice *s, const ice_merged_cells *p, const int cell[3], int axis)
{
    int below[3] = {cell[0], cell[1], cell[2]};
    return below[axis]-- > 0 && is_empty(s, p, cell) && is_empty(s, p, below);
}

/* Share of the lower face of a local cell that is open to the gas in the mean of the step; beyond the last cell, of its
 * upper face. A cell that no boundary cuts at any time of the step is open or closed throughout it. */
static double mean_open(const ice *s, const ice_merged_cells *p, const block *b, int axis, int i, int j, int k)
{
    int cell[3] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k}, side = SIDE_LOWER;
    if (cell[axis] == s->mesh->n[axis]) {
        cell[axis]--;
        side = SIDE_UPPER;
    }
    const int member = p->place[cut_index(s->mesh, cell)];
    if (member < 0) return ice_open_cell(s, p->region->number, CUT_NOW, cell);
    return side == SIDE_LOWER && divides_empty(s, p, cell, axis) ? 0.0 : p->member[member].face[axis][side];
}

/* From velocities of the gas to volume fluxes per area of the whole face. */
static floe_status apply_apertures(ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (int axis = 0; axis < s->mesh->dim; ++axis) {
            const ice_rows q = ice_rows_of(v->b, axis, 0);
#pragma omp parallel for schedule(static)
            for (int row = 0; row < q.n; ++row) {
                const int j = ice_row_j(q, row), k = ice_row_k(q, row);
                for (int i = 0; i < v->b->n[0] + (axis == 0); ++i) {
                    const ptrdiff_t face = mesh_index(v->b, i, j, k);
                    const double share = mean_open(s, p, v->b, axis, i, j, k);
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
    TRY(ice_merge_cells(s, MERGE_MOVING, &s->cut_cells->now[g->number]));
    ice_cut_views(s, g);
    TRY(apply_apertures(s, g));
    if (s->heats_walls)
        ice_centre_temperatures(s, g); /* they are known since the fit */
    else if (ice_conducts(s))
        ice_find_temperatures(s, g);
    ice_find_sources(s, g);
    ice_merged_sources(s, g);
    ice_merged_sweep(s, g);
    TRY(ice_finish_sources(s, g));
    return g->n > 1 ? exchange_among(s, g) : FLOE_OK;
}

floe_status ice_cut_sources(ice *s)
{
    return for_regions(s, find_sources);
}

floe_status ice_cut_advect(ice *s)
{
    return for_regions(s, ice_advect_merged);
}

floe_status ice_cut_merge_start(ice *s)
{
    return for_regions(s, ice_start_merged);
}

/* ---- the stages ---- */

floe_status ice_cut_pressure_stages(ice *s)
{
    const bool m = ice_is_mixture(s), r = ice_reaction_count(s) > 0, slips = m && ice_some_pair_slips(s),
               t = ice_may_trace(s), implicit = s->implicit, viscous = ice_is_viscous(s), heat = s->heats_walls;
    STAGE(s, ALWAYS, ice_cut_ghosts, READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, WHEN(m, C_VOL)),
          WRITES(C_RHO, C_VEL, C_ENERGY, C_SHOCK, WHEN(m, C_VOL), WHEN(m, C_PRESSURE), WHEN(m && implicit, C_OPEN)));
    STAGE(s, ALWAYS, ice_cut_pressure,
          READS(C_RHO, C_ENERGY, WHEN(m, C_VEL), WHEN(m, C_VOL), WHEN(m, C_TEMP), WHEN(m, C_PRESSURE),
                WHEN(slips, C_OPEN)),
          WRITES(C_PRESSURE, C_SOUND, WHEN(m, C_VEL), WHEN(m, C_ENERGY), WHEN(m, C_VOL), WHEN(m, C_TEMP),
                 WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_RHO_SUM), WHEN(m, C_VEL_MEAN),
                 WHEN(m, C_MIXED), WHEN(m, C_INTERFACE), WHEN(m, C_ENERGY_FOUND), WHEN(m, C_VOLUME_FOUND),
                 WHEN(r, C_REACTED), WHEN(slips, C_WALL), WHEN(slips, C_OPEN)));
    STAGE(s, ice_sees_walls(s), ice_cut_wall_flow, READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, WHEN(m && heat, C_TEMP)),
          WRITES(WHEN(viscous, C_VEL_CENTRED), WHEN(viscous, C_VEL), WHEN(viscous, C_ENERGY),
                 WHEN(implicit && viscous, C_DIFFUSION), WHEN(implicit && viscous, C_DIFFUSION_HEAT),
                 WHEN(heat, C_DIFFUSION_T)));
    STAGE(s, ALWAYS, ice_cut_velocity,
          READS(C_RHO, C_VEL, C_PRESSURE, C_SOUND, WHEN(implicit && viscous, C_DIFFUSION), WHEN(m, C_THETA),
                WHEN(m, C_VEL_MEAN), WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(m, C_VOL),
                WHEN(slips, C_WALL), WHEN(t, C_ENERGY), WHEN(t || (implicit && m), C_OPEN), WHEN(m && t, C_KAPPA),
                WHEN(m && t, C_INTERFACE)),
          WRITES(F_VEL, C_SHOCK, WHEN(t, C_OPEN), WHEN(t, C_PRESSURE), WHEN(t, C_SLOW_SHOCK), WHEN(t, C_ALONE),
                 WHEN(t, F_PRESSURE), WHEN(t, F_DONOR_DENSITY), WHEN(t, F_DONOR_ENERGY), WHEN(t, F_DONOR_VEL)));
    STAGE(s, implicit, ice_cut_guess,
          READS(F_VEL, C_RHO, C_VEL, C_PRESSURE, C_SOUND, C_SHOCK, C_OPEN, C_PRESSURE_STEP, WHEN(m, C_THETA),
                WHEN(m, C_VEL_MEAN), WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(m, C_INTERFACE),
                WHEN(slips, C_WALL)),
          WRITES(F_VEL, F_MOBILITY, C_PRESSURE_STEP, C_DP, C_PRESSURE_ADVANCED, WHEN(m, C_LIMITER), WHEN(m, F_THETA),
                 WHEN(m, F_FLUX)));
    STAGE(s, !implicit, ice_cut_increment,
          READS(F_VEL, C_RHO, C_VEL, C_PRESSURE, C_SOUND, C_SHOCK, WHEN(m, C_THETA), WHEN(m, C_VEL_MEAN),
                WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(m, C_INTERFACE), WHEN(r, C_REACTED)),
          WRITES(C_DP, C_PRESSURE_ADVANCED, WHEN(m, C_LIMITER), WHEN(m, F_THETA), WHEN(m, F_FLUX)));
    STAGE(s, !implicit, ice_cut_face_pressure,
          READS(C_PRESSURE_ADVANCED, C_RHO, WHEN(m, C_RHO_SUM), WHEN(t, F_PRESSURE), WHEN(t, C_ALONE)),
          WRITES(F_PRESSURE));
    STAGE(s, ALWAYS, ice_cut_load, READS(C_PRESSURE_ADVANCED), WRITES(NOTHING));
    return FLOE_OK;
}

floe_status ice_cut_flow_stages(ice *s)
{
    const bool m = ice_is_mixture(s), k = ice_conducts(s), r = ice_reaction_count(s) > 0,
               slips = m && ice_some_pair_slips(s), t = ice_may_trace(s);
    STAGE(s, s->implicit, ice_cut_take,
          READS(F_VEL, C_RHO, C_PRESSURE, C_SOUND, C_OPEN, C_PRESSURE_STEP, C_DP, C_PRESSURE_ADVANCED, WHEN(m, F_FLUX),
                WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM)),
          WRITES(C_DP, C_PRESSURE_ADVANCED, F_PRESSURE, WHEN(m, F_VEL)));
    STAGE(s, s->walls && !s->implicit, ice_cut_wall_pressure,
          READS(C_DP, C_PRESSURE_ADVANCED, C_RHO, F_PRESSURE, WHEN(m, C_RHO_SUM), WHEN(t, C_ALONE)),
          WRITES(C_DP, C_PRESSURE_ADVANCED, F_PRESSURE));
    STAGE(s, ALWAYS, ice_cut_sources,
          READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, F_PRESSURE, F_VEL, C_DP, C_PRESSURE_ADVANCED, C_SOUND, C_PRESSURE,
                WHEN(m, F_FLUX), WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_RHO_SUM),
                WHEN(m, C_MIXED), WHEN(m, C_VOL), WHEN(m, C_TEMP), WHEN(m, C_INTERFACE), WHEN(m, C_SHOCK),
                WHEN(m && ice_has_diffusion(s), C_VEL_MEAN), WHEN(ice_is_viscous(s), C_VEL_CENTRED),
                WHEN(s->heats_walls, C_DIFFUSION_T), WHEN(r, C_REACTED), WHEN(slips, C_WALL)),
          WRITES(C_VEL_L, C_ENERGY_L, F_VEL, WHEN(m, F_FLUX), WHEN(m, C_HEAT_OWED), WHEN(m, C_VOLUME_L),
                 WHEN(k, C_DIFFUSION_T), WHEN(r, C_RHO_L)));
    STAGE(s, ALWAYS, ice_cut_advect,
          READS(C_RHO, C_VEL, C_ENERGY, C_OPEN, C_PRESSURE, F_VEL, F_PRESSURE, C_DP, C_SHOCK, C_SOUND, C_VEL_L,
                C_ENERGY_L, WHEN(m, C_VOL), WHEN(m, C_VOLUME_L), WHEN(m, C_THETA), WHEN(m, C_KAPPA_SUM),
                WHEN(m, C_RHO_SUM), WHEN(m, C_LIMITER), WHEN(m, C_TEMP), WHEN(m, C_INTERFACE), WHEN(m, F_THETA),
                WHEN(r, C_RHO_L), WHEN(t, F_DONOR_DENSITY), WHEN(t, F_DONOR_ENERGY), WHEN(t, F_DONOR_VEL),
                WHEN(t, C_ALONE)),
          WRITES(C_RHO, C_VEL, C_ENERGY, C_OPEN, C_VEL_L, C_ENERGY_L, WHEN(m, C_VOL), WHEN(m, C_VOLUME_L),
                 WHEN(r, C_RHO_L)));
    STAGE(s, ice_injects(s), ice_inject,
          READS(C_RHO, C_VEL, C_ENERGY, C_PRESSURE, C_OPEN, WHEN(m, C_VOL), WHEN(m, C_KAPPA)),
          WRITES(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_VOL)));
    return FLOE_OK;
}

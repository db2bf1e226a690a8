/* The velocities of the members of merged cells of a viscous fluid, about that of all (theory 7.7): each has the velocity at the centroid of its own open
 * volume, by the fit of ice_wall_flow.c. */
#include "ice/cut/ice_merged_cells.h"
#include "ice/cut/ice_wall_flow.h"

#include "base/memory.h"
#include "ice/ice_constants.h"

#include <math.h>

/* kg: of the fluid in a member. */
static double mass_of(const ice *s, const ice_member *m)
{
    return ice_member_view(s, m)->m[0].rho[m->at] * m->open * mesh_cell_volume(s->mesh, m->cell[0]);
}

/* Into the sums: mass and momentum of the differences, and their kinetic energy. */
static void sum_differences(const ice *s, const ice_region *g, ice_merged_cells *p)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const double mass = mass_of(s, &p->member[k]);
        double *sum = p->sum + (size_t)p->member[k].merged * MERGED_SUMS, du[3];
        ice_wall_flow_difference(s, g, k, p->member[k].own, du);
        sum[MERGED_MASS] += mass;
        for (int a = 0; a < s->mesh->dim; ++a) {
            sum[MERGED_MOMENTUM + a] += mass * du[a];
            sum[MERGED_WORK] += 0.5 * mass * du[a] * du[a];
        }
    }
}

/* The mean of the differences takes the place of their momentum, their energy (J/kg) about it that of their kinetic energy. Returns what of them the merged
 * cell has the energy for. */
static double settle_differences(const ice *s, const ice_merged_cells *p, int merged)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_view *v = ice_member_view(s, lead);
    const double floor = v->material[0].energy_floor;
    double *sum = p->sum + (size_t)merged * MERGED_SUMS, energy = 0.0;
    if (!(sum[MERGED_MASS] > 0.0)) return 0.0;
    energy = sum[MERGED_WORK] / sum[MERGED_MASS];
    for (int a = 0; a < s->mesh->dim; ++a) {
        sum[MERGED_MOMENTUM + a] /= sum[MERGED_MASS];
        energy -= 0.5 * sum[MERGED_MOMENTUM + a] * sum[MERGED_MOMENTUM + a];
    }
    const double has = ICE_SPREAD_ENERGY * most(v->m[0].e[lead->at] - (isnan(floor) ? 0.0 : floor), 0.0);
    const double share = energy > has ? sqrt(has / energy) : 1.0;
    sum[MERGED_WORK] = share * share * energy;
    return share;
}

static floe_status save_members(ice *s, const ice_region *g)
{
    const ice_merged_cells *p = &s->cut_cells->now[g->number];
    ice_spread *to = &s->cut_cells->spread[g->number];
    if ((size_t)p->n > to->reserved) {
        const size_t wanted = (size_t)p->n + (size_t)p->n / 2;
        TRY(memory_resize(s->ctx, &to->before, wanted, sizeof *to->before));
        to->reserved = wanted;
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const ice_fluid *of = &ice_member_view(s, m)->m[0];
        ice_before_spread *b = &to->before[k];
        *b = (ice_before_spread){.block = m->block, .at = m->at, .e = of->e[m->at]};
        for (int a = 0; a < s->mesh->dim; ++a) b->u[a] = of->u[a][m->at];
    }
    to->n = p->n;
    to->step = s->step + 1;
    return FLOE_OK;
}

void ice_rollback_spread(ice *s)
{
    for (int g = 0; g < s->n_regions; ++g) {
        ice_spread *from = &s->cut_cells->spread[g];
        if (from->step != s->step + 1) continue;
        ice_cut_views(s, &s->region[g]);
        for (int k = 0; k < from->n; ++k) {
            const ice_before_spread *b = &from->before[k];
            const ice_fluid *of = &s->cut_cells->view[b->block].m[0];
            of->e[b->at] = b->e;
            for (int a = 0; a < s->mesh->dim; ++a) of->u[a][b->at] = b->u[a];
        }
        from->step = 0;
    }
}

floe_status ice_spread_velocities(ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->now[g->number];
    if (g->n > 1) return FLOE_OK;
    TRY(save_members(s, g));
    sum_differences(s, g, p);
    for (int merged = 0; merged < p->count; ++merged) {
        const double share = settle_differences(s, p, merged);
        p->sum[(size_t)merged * MERGED_SUMS + MERGED_VOLUME] = share;
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        const ice_fluid *of = &ice_member_view(s, m)->m[0];
        double du[3];
        if (!(m->open > 0.0)) continue;
        ice_wall_flow_difference(s, g, k, m->own, du);
        for (int a = 0; a < s->mesh->dim; ++a)
            of->u[a][m->at] += sum[MERGED_VOLUME] * (du[a] - sum[MERGED_MOMENTUM + a]);
        of->e[m->at] -= sum[MERGED_WORK];
    }
    ice_fill_changed(s, g);
    return FLOE_OK;
}

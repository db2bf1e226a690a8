/* Sources of mass (theory 2.18): after advection, what has come in during the step is added to the next state of the cells
 * of its region. */
#include "ice/inject/ice_injection.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_tiles.h"
#include "ice/state/ice_walk.h"

#include "base/memory.h"
#include "ice/ice_constants.h"

#include <string.h>

/* ---- making ---- */

static floe_status find_place(ice *s, inject_place *p, const shape *region, int fluid)
{
    p->region = region;
    p->material = ice_material_of(s, fluid);
    return ice_region_cells_create(s, region, &p->within);
}

bool ice_injects(const ice *s)
{
    return s->scene->n_mass_sources > 0 || s->scene->n_vents > 0;
}

static floe_status find_places(ice *s)
{
    ice_injection *w = s->injection;
    for (int k = 0; k < s->scene->n_mass_sources; ++k) {
        const scene_mass_source *given = &s->scene->mass_source[k];
        TRY(find_place(s, &w->source[k], &given->region, given->material));
    }
    for (int k = 0; k < s->scene->n_vents; ++k)
        for (int side = 0; side < (s->scene->vent[k].to_outside ? 1 : 2); ++side) {
            const scene_vent_side *given = &s->scene->vent[k].side[side];
            TRY(find_place(s, &w->vent[k][side], &given->region, given->material));
        }
    return FLOE_OK;
}

floe_status ice_injection_create(ice *s)
{
    if (!ice_injects(s)) return FLOE_OK;
    TRY(memory_new(s->ctx, &s->injection, 1, sizeof *s->injection));
    for (int id = 0; id < s->mesh->n_blocks; ++id)
        TRY(memory_new(s->ctx, &s->injection->weight[id], s->mesh->block[id].size, sizeof(double)));
    return find_places(s);
}

void ice_injection_destroy(context *ctx, ice_injection **w)
{
    if (!*w) return;
    for (int k = 0; k < SCENE_MAX_SOURCES; ++k) ice_region_cells_destroy(ctx, &(*w)->source[k].within);
    for (int k = 0; k < SCENE_MAX_VENTS; ++k)
        for (int side = 0; side < 2; ++side) ice_region_cells_destroy(ctx, &(*w)->vent[k][side].within);
    for (int id = 0; id < MESH_MAX_BLOCKS; ++id) memory_free(ctx, &(*w)->weight[id]);
    memory_free(ctx, w);
}

/* ---- weights ---- */

/* Share of a cell that fluids have after the step. Smeared solids leave it by their last volume fractions; what is left
 * of a cell that they all but fill takes nothing. */
static double fluid_share(const ice *s, const ice_view *v, ptrdiff_t at)
{
    double fluid = 1.0;
    if (v->m[0].open1) return v->m[0].open1[at];
    for (int r = 0; s->with_points && r < v->n_materials; ++r)
        if (v->material[r].points) fluid -= v->m[r].theta[at];
    return fluid > ICE_LEAST_INJECTED ? fluid : 0.0;
}

double ice_set_weights(ice *s, const inject_place *p)
{
    const ice_region *g = ice_region_of(s, p->material);
    double **weight = s->injection->weight, sum[3];
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_cell_list *list = &p->within.cells[v.b->id];
        memset(weight[v.b->id], 0, v.b->size * sizeof(double));
        for (size_t n = 0; n < list->n; ++n) {
            int local[MESH_MAX_DIM];
            ice_cell_of(v.b, list->at[n], local);
            weight[v.b->id][list->at[n]] =
                p->within.share[v.b->id][n] * v.volume[local[0]] * fluid_share(s, &v, list->at[n]);
        }
    }
    if (s->cut) s->cut->spread_weights(s, g, weight);
    for (ice_weighed c = ice_weighed_of(s, p); ice_next_weighed(&c);)
        ice_tile(s, c.v.b, c.local[0], c.local[1], c.local[2])[TILE_SCRATCH] += c.weight;
    ice_sum_scratch(s, sum);
    return sum[0];
}

ice_weighed ice_weighed_of(ice *s, const inject_place *p)
{
    const ice_region *g = ice_region_of(s, p->material);
    return (ice_weighed){.s = s, .g = g, .r = p->material - g->first};
}

bool ice_next_weighed(ice_weighed *c)
{
    for (;;) {
        if (!c->open) {
            if (!ice_next_view(c->s, c->g, &c->id, &c->v)) return false;
            c->open = true;
            c->at = -1;
        }
        const double *weight = c->s->injection->weight[c->v.b->id];
        for (++c->at; c->at < (ptrdiff_t)c->v.b->size; ++c->at) {
            if (!(weight[c->at] > 0.0)) continue;
            ice_cell_of(c->v.b, c->at, c->local);
            c->weight = weight[c->at];
            c->volume = c->v.volume[c->local[0]] * (c->v.m[0].open1 ? c->v.m[0].open1[c->at] : 1.0);
            return true;
        }
        c->open = false;
    }
}

double *ice_weighed_tile(const ice_weighed *c, double x[MESH_MAX_DIM])
{
    ice_place_of(c->s, c->v.b, c->local, x);
    return ice_tile(c->s, c->v.b, c->local[0], c->local[1], c->local[2]);
}

/* ---- the stage ---- */

void ice_let_in(ice *s, const inject_place *p, double all, const mass_intake *in, bool entered)
{
    for (ice_weighed c = ice_weighed_of(s, p); ice_next_weighed(&c);) {
        const double mass = in->mass * c.weight / all;
        cell_intake part = {.density = mass / c.volume, .temperature = in->temperature};
        memcpy(part.velocity, in->velocity, sizeof part.velocity);
        const double energy = ice_take_in(&c.v, c.r, c.at, &part) * c.volume;
        double x[MESH_MAX_DIM], *tile = ice_weighed_tile(&c, x);
        for (int a = 0; a < s->mesh->dim; ++a) {
            ice_add_impulse(tile + TILE_SOURCE_MOMENTUM, x, a, mass * in->velocity[a]);
            if (!entered) tile[TILE_SOURCE_MOMENTUM + a] -= mass * in->velocity[a];
        }
        if (entered) tile[TILE_SOURCE_ENERGY] += energy;
    }
    if (entered) ledger_add(s->ledger, LEDGER_MASS, LEDGER_SOURCE, in->mass);
}

static floe_status let_in_by(ice *s, int k)
{
    const scene_mass_source *given = &s->scene->mass_source[k];
    const inject_place *p = &s->injection->source[k];
    mass_intake in;
    TRY(mass_source_intake(s->scene, given, s->time, s->time + s->dt, &in));
    if (!(in.mass > 0.0)) return FLOE_OK;
    const double all = ice_set_weights(s, p);
    if (!(all > 0.0))
        return fail_key(s->ctx, KEY("sources", given->name),
                        "no '%s' can be where source '%s' lets it in: its region lies in solids, or beyond a membrane "
                        "or wall; move it",
                        s->scene->material[given->material].name, given->name);
    ice_let_in(s, p, all, &in, true);
    return FLOE_OK;
}

floe_status ice_inject(ice *s)
{
    ice_clear_tiles(s);
    for (int k = 0; k < s->scene->n_mass_sources; ++k) TRY(let_in_by(s, k));
    TRY(ice_pass_vents(s));
    ice_enter_tiles(s);
    return FLOE_OK;
}

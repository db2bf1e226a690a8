#include "sim/quasi_static_gas.h"

#include "base/memory.h"
#include "ice/ice_quasi_static.h"
#include "sim/coupled.h"
#include "sim/embedded.h"

#include <string.h>

/* Connects the gas regions of the cells with the enclosed gases of the points. */
typedef struct quasi_static_gas {
    context *ctx;            /* not owned */
    stage_list *stages;      /* not owned */
    sim *s;                  /* not owned */
    ice_quasi_static *cells; /* owned */
    mpm_gas *gas;            /* one a region; owned */
    double *unit_force;      /* of all of them; owned */
} quasi_static_gas;

/* Loads heat what solids enclose: else it would flow out, which is found only once there are cells. */
static bool heats_in_the_open(const sim *s)
{
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        bool enclosed = false;
        if (load->kind != LOAD_HEAT && load->kind != LOAD_PRESSURISE) continue;
        for (int b = 0; b < s->scene->n_bodies; ++b)
            enclosed = enclosed || (s->scene->body[b].material == load->material && mpm_body_is_enclosed(s->mpm, b));
        if (!enclosed) return true;
    }
    return false;
}

const char *quasi_static_gas_obstacle(const sim *s, bool guess)
{
    if (guess && heats_in_the_open(s)) return "gas that no solid encloses is heated, and would flow";
    return ice_quasi_static_obstacle(s->ice);
}

floe_status quasi_static_gas_create(quasi_static_gas **out, sim *s)
{
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    **out = (quasi_static_gas){.ctx = s->ctx, .stages = &s->stages, .s = s};
    return ice_quasi_static_create(&(*out)->cells, s->ice);
}

void quasi_static_gas_destroy(quasi_static_gas **g)
{
    if (!g || !*g) return;
    context *ctx = (*g)->ctx;
    ice_quasi_static_destroy(&(*g)->cells);
    memory_free(ctx, &(*g)->gas);
    memory_free(ctx, &(*g)->unit_force);
    memory_free(ctx, g);
}

/* Areas of the pieces of the lines, at the markers between which they lie, by the region whose gas is there. */
static floe_status push_markers(quasi_static_gas *g)
{
    /* Several lines hold gases of several kinds, which do not come here. */
    const cut_surface *c = &g->s->embedded->boundary[0].place[CUT_NOW];
    const size_t numbers = 3 * (size_t)c->n_vertices;
    TRY(memory_resize(g->ctx, &g->unit_force, numbers * (size_t)g->cells->n, sizeof *g->unit_force));
    memset(g->unit_force, 0, numbers * (size_t)g->cells->n * sizeof *g->unit_force);
    for (int r = 0; r < g->cells->n; ++r) g->gas[r].unit_force = g->unit_force + numbers * (size_t)r;
    for (int k = 0; k < c->n_pieces; ++k) {
        const cut_piece *p = &c->piece[k];
        const int *at = c->cell[p->cell].cell, region = ice_gas_region_near(g->s->ice, g->cells, at);
        for (int end = 0; end < c->mesh->dim && region >= 0; ++end)
            for (int a = 0; a < c->mesh->dim; ++a)
                g->gas[region].unit_force[3 * c->vertex[p->vertex[end]].point + a] += p->weight[end] * p->area[a];
    }
    return FLOE_OK;
}

static floe_status quasi_static_gas_find(quasi_static_gas *g)
{
    sim *s = g->s;
    if (s->embedded) TRY(embedded_find_still(s->embedded));
    TRY(ice_quasi_static_find(s->ice, g->cells));
    TRY(memory_resize(g->ctx, &g->gas, (size_t)g->cells->n, sizeof *g->gas));
    for (int r = 0; r < g->cells->n; ++r) {
        const ice_gas_region *region = &g->cells->region[r];
        g->gas[r] = (mpm_gas){.law = &s->ice->material[g->cells->material].eos,
                              .mass = region->mass,
                              .volume = region->volume,
                              .energy = region->energy / region->mass,
                              .prescribed_pressure = region->prescribed_pressure,
                              .heat = region->heat,
                              .open = region->open};
    }
    if (s->embedded) TRY(push_markers(g));
    s->mpm->gas = g->gas;
    s->mpm->n_gases = g->cells->n;
    s->mpm->gas_of = g->cells->seen;
    return FLOE_OK;
}

static floe_status quasi_static_gas_move(quasi_static_gas *g)
{
    return g->s->embedded ? embedded_find_moved(g->s->embedded) : FLOE_OK;
}

floe_status quasi_static_gas_step(sim *s)
{
    quasi_static_gas *g = s->quasi_static_gas;
    const bool cut = s->embedded, m = ice_is_mixture(s->ice);
    STAGE(g, ALWAYS, quasi_static_gas_find,
          READS(P_ID, P_POS, C_RHO, C_VEL, C_ENERGY, C_PRESSURE, C_TEMP, WHEN(cut, C_OPEN), WHEN(m, C_VOL),
                WHEN(m, C_SOUND), WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_RHO_SUM),
                WHEN(m, C_VEL_MEAN), WHEN(m, C_MIXED), WHEN(m, C_TMV_RATIO)),
          WRITES(NOTHING)); /* more than is found: what is shown of mixed cells */
    TRY(mpm_step(s->mpm));
    STAGE(g, ALWAYS, quasi_static_gas_move, READS(P_ID, P_POS), WRITES(NOTHING));
    return FLOE_OK;
}

floe_status quasi_static_gas_commit(sim *s)
{
    quasi_static_gas *g = s->quasi_static_gas;
    ice_gas_region_state *state;
    if (s->transfer) TRY(coupled_refresh(s));
    TRY(memory_new(g->ctx, &state, (size_t)g->cells->n, sizeof *state));
    for (int r = 0; r < g->cells->n; ++r)
        state[r] =
            (ice_gas_region_state){g->gas[r].mass_end, g->gas[r].volume_end, g->gas[r].energy_end, g->gas[r].pressure};
    const floe_status status = ice_quasi_static_fill(s->ice, g->cells, state);
    memory_free(g->ctx, &state);
    return status;
}

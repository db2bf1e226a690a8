/* From the scene to a simulation ready for its first step. */
#include "sim/sim.h"

#include "base/compiler.h"
#include "base/memory.h"
#include "scene/layout.h"
#include "scene/unsupported.h"
#include "sim/coupled.h"
#include "sim/embedded.h"
#include "sim/light_solid_check.h"
#include "sim/quasi_static_gas.h"
#include "sim/statics.h"
#include "sim/tracer.h"

#include <math.h>
#include <string.h>

/* Facts of a scene under a coupling: which solvers it needs. */
static bool needs_points(const scene *s, scene_coupling coupling)
{
    if (coupling == COUPLING_MPM) return true;
    if (coupling == COUPLING_ICE) return false;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->material[s->body[b].material].kind == MATERIAL_SOLID) return true;
    return false;
}

static bool needs_cells(const scene *s, scene_coupling coupling)
{
    if (coupling == COUPLING_MPM) return false;
    if (s->has_ambient) return true;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->material[s->body[b].material].kind == MATERIAL_FLUID) return true;
    return false;
}

static floe_status check_coupling(const sim *s)
{
    for (int b = 0; s->coupling == COUPLING_ICE && b < s->scene->n_bodies; ++b)
        if (s->scene->material[s->scene->body[b].material].kind == MATERIAL_SOLID)
            return fail_key(s->ctx, KEY("coupling"),
                            "ice: body '%s' is a solid, which cells cannot carry; use ice-mpm or mpm",
                            s->scene->body[b].name);
    for (int b = 0; s->coupling == COUPLING_ICE_MPM && b < s->scene->n_bodies; ++b)
        if (s->scene->material[s->scene->body[b].material].membrane && scene_enclosing_body(s->scene) < 0)
            return fail_key(
                s->ctx, KEY("coupling"),
                "ice-mpm: body '%s' is a membrane, which cells do not see unless it `encloses` a gas; use mpm",
                s->scene->body[b].name);
    if (s->scene->n_bodies == 0 && !(s->coupling == COUPLING_ICE && s->scene->has_ambient))
        return fail_key(s->ctx, KEY("bodies"),
                        "the scene has none: give one, or with `ice` an `ambient` that fills it");
    return scene_refuse_unsupported(s->scene, s->coupling);
}

floe_status sim_run_stages(sim *s)
{
    if (s->quasi_static_gas) return quasi_static_gas_step(s);
    if (s->embedded) return embedded_step(s);
    if (s->mpm && s->ice) return coupled_step(s);
    return s->mpm ? mpm_step(s->mpm) : ice_step(s->ice);
}

/* Walks the stage list without running it: that registers what the stages touch, and nothing else. */
static floe_status make_plan(sim *s)
{
    s->stages.planning = true;
    const floe_status status = sim_run_stages(s);
    s->stages.planning = false;
    return status;
}

static floe_status make_solvers(sim *s, const bool points, const bool cells)
{
    if (points) TRY(mpm_create(&s->mpm, s->ctx, s->scene, &s->mesh, &s->stages, &s->ledger, cells));
    const bool is_cut = points && cells && scene_is_cut(s->scene);
    if (cells) TRY(ice_create(&s->ice, s->ctx, s->scene, &s->mesh, &s->stages, &s->ledger, points && !is_cut));
    if (points && cells) TRY(is_cut ? embedded_create(&s->embedded, s) : transfer_create(&s->transfer, s));
    TRY(sim_choose_solver(s));
    TRY(sim_stiffen_walls(s));
    TRY(make_plan(s));
    TRY(domain_create(&s->domain, s->ctx, &s->mesh));
    s->stages.domain = s->domain;
    if (s->mpm) TRY(mpm_register(s->mpm, s->domain));
    if (s->ice) TRY(ice_register(s->ice, s->domain));
    return FLOE_OK;
}

static floe_status set_initial_state(sim *s)
{
    if (s->mpm) TRY(mpm_seed(s->mpm));
    TRY(sim_settle_walls(s));
    if (s->transfer)
        TRY(coupled_initialise(s));
    else if (s->embedded)
        TRY(embedded_initialise(s));
    else if (s->ice)
        TRY(ice_initialise(s->ice, NULL));
    if (s->scene->n_tracers > 0) TRY(tracers_create(&s->tracers, s));
    return light_solid_check(s);
}

static floe_status fill_sim(sim *s)
{
    TRY(check_coupling(s));
    TRY(mesh_init(&s->mesh, s->ctx, &s->scene->mesh));
    TRY(scene_lay_out(&s->layout, s->scene, s->coupling, &s->mesh));
    if (s->layout) s->scene = &s->layout->scene;
    stage_list_init(&s->stages, s->ctx);
    s->stages.checking = FLOE_CHECKS;
    TRY(make_solvers(s, needs_points(s->scene, s->coupling), needs_cells(s->scene, s->coupling)));
    TRY(set_initial_state(s));
    TRY(sim_choose_pressure(s));
    TRY(sim_choose_substeps(s));
    ledger_choose(&s->ledger, &s->mesh);
    if (s->embedded) ledger_leave_moments(&s->ledger);
    return sim_open_ledger(s);
}

floe_status sim_create(sim **out, context *ctx, const scene *sc, scene_coupling coupling)
{
    const uint64_t bytes = memory_read_account(ctx).live_bytes;
    TRY(memory_new(ctx, out, 1, sizeof **out));
    sim *s = *out;
    s->bytes_before = bytes;
    s->ctx = ctx;
    s->scene = sc;
    s->coupling = coupling;
    s->dt_reason = "first step";
    s->rest_since = INFINITY;
    s->most_substeps = s->n_substeps = 1;
    const floe_status status = fill_sim(s);
    if (status != FLOE_OK) sim_destroy(out);
    return status;
}

void sim_destroy(sim **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    quasi_static_gas_destroy(&(*s)->quasi_static_gas);
    tracers_destroy(ctx, &(*s)->tracers);
    transfer_destroy(&(*s)->transfer);
    embedded_destroy(&(*s)->embedded);
    ice_destroy(&(*s)->ice);
    mpm_destroy(&(*s)->mpm);
    domain_destroy(&(*s)->domain);
    stage_list_destroy(&(*s)->stages);
    memory_free(ctx, &(*s)->layout);
    memory_free(ctx, s);
}

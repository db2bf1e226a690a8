/* Making the ICE solver: which materials, which loads, which fields, which kernels. */
#include "ice/cut/ice_cut.h"
#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/flux/ice_flux.h"
#include "ice/implicit/ice_implicit.h"
#include "ice/inject/ice_inject.h"
#include "ice/points/ice_points.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_state.h"
#include "ice/state/ice_traced.h"
#include "ice/trace/ice_trace.h"

#include "base/memory.h"
#include "scene/solid_heat.h"
#include "scene/state.h"

#include <math.h>

/* The least pressure of a fluid of the scene (Pa, <= 0), at most half of a solid's bulk modulus in size: a solid beside
 * it must have a volume at this pressure. */
static double least_pressure(const scene *s, const bool *used, double bulk_modulus)
{
    double least = 0.0;
    for (int r = 0; r < s->n_materials; ++r) {
        const scene_material *m = &s->material[r];
        if (used[r] && m->kind == MATERIAL_FLUID) least = fmin(least, m->eos.model->pressure_floor(m->eos.par));
    }
    return fmax(least, -0.5 * bulk_modulus);
}

/* Whether bodies of the material move as prescribed; they have no other bodies beside them (scene/unsupported.h). */
static bool is_prescribed(const scene *s, int material)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material && motion_is_prescribed(&s->body[b].motion)) return true;
    return false;
}

/* A solid as the cells see it: the bulk response of its law (theory 5.4). */
static floe_status view_of_solid(ice *s, const scene_material *m, const bool *used, ice_material *out,
                                 eos_bulk_par *par)
{
    const eos_model *bulk = eos_find("bulk");
    if (!bulk) return fail(s->ctx, FLOE_INTERNAL, "the equation of state 'bulk' is not in the registry");
    const double K = m->law->bulk_modulus(m->law_par);
    *par = (eos_bulk_par){.density = m->density,
                          .bulk_modulus = K,
                          .specific_heat = m->specific_heat > 0.0 ? m->specific_heat : 1.0,
                          .reference_pressure = s->scene->reference_pressure,
                          .switch_pressure = m->tension_switch,
                          .least_pressure = least_pressure(s->scene, used, K)};
    *out = (ice_material){.eos = {bulk, par}, .points = true};
    return FLOE_OK;
}

/* The law's energy floor where it is the same for densities from 1e-6 to 1e6 kg/m3, else NAN. */
static double constant_floor(const eos *law)
{
    const double a = law->model->energy_floor(law->par, 1e-6), b = law->model->energy_floor(law->par, 1.0),
                 c = law->model->energy_floor(law->par, 1e6);
    if (a == b && b == c) return a;
    return NAN;
}

static floe_status resolve_materials(ice *s, bool with_points)
{
    const scene *whole = s->scene;
    bool used[SCENE_MAX_MATERIALS] = {false};
    ice_find_used(whole, with_points, used);
    for (int r = 0; r < whole->n_materials; ++r) {
        if (!used[r]) continue;
        const scene_material *m = &whole->material[r];
        ice_material *out = &s->material[s->n_materials];
        if (m->kind == MATERIAL_SOLID)
            TRY(view_of_solid(s, m, used, out, &s->bulk[s->n_materials]));
        else
            *out = (ice_material){.eos = m->eos,
                                  .shear_viscosity = m->shear_viscosity,
                                  .bulk_viscosity = m->bulk_viscosity,
                                  .conductivity = m->conductivity};
        out->scene_material = r;
        out->prescribed = out->points && is_prescribed(whole, r);
        out->warms = out->points && scene_solid_has_temperature(whole, r, true);
        s->with_points = s->with_points || out->points;
        out->energy_floor = constant_floor(&out->eos);
        s->n_materials++;
    }
    if (s->n_materials == 0)
        return fail_key(s->ctx, KEY("coupling"), "%s: no fluid is in the scene: give a body of a fluid, or `ambient`",
                        coupling_name(whole->coupling));
    return FLOE_OK;
}

/* One region; with embedded boundaries that keep the fluids apart, one a fluid. */
static void resolve_regions(ice *s)
{
    const bool apart = scene_is_cut(s->scene) && !s->scene->fluids_share;
    s->cut = scene_is_cut(s->scene) ? &ice_embedded_geometry : NULL;
    s->n_regions = apart ? s->n_materials : 1;
    for (int g = 0; g < s->n_regions; ++g) s->region[g] = (ice_region){g, g, apart ? 1 : s->n_materials};
}

void ice_set_gravity(ice *s, double t)
{
    for (int a = 0; a < s->mesh->dim; ++a) s->gravity[a] = 0.0;
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        double acceleration[3];
        if (load->kind != LOAD_BODY_FORCE || load->body >= 0 || !load_is_uniform(s->scene, load)) continue;
        load_acceleration(s->scene, load, t, acceleration);
        for (int a = 0; a < s->mesh->dim; ++a) s->gravity[a] += acceleration[a];
    }
}

static floe_status resolve_states(ice *s, bool with_points)
{
    TRY(resolve_materials(s, with_points));
    resolve_regions(s);
    ice_set_gravity(s, 0.0);
    TRY(ice_pairs_create(s));
    for (int r = 0; r < s->n_materials; ++r)
        s->heats_points = s->heats_points ||
                          (s->material[r].warms && scene_solid_exchanges_heat(s->scene, s->material[r].scene_material));
    TRY(ice_sides_create(s));
    TRY(ice_heated_create(s));
    TRY(ice_injection_create(s));
    return ice_reactions_create(s);
}

floe_status ice_create(ice **out, context *ctx, const scene *s, const mesh *m, stage_list *stages, ledger *l,
                       bool with_points)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    ice *made = *out;
    made->ctx = ctx;
    made->scene = s;
    made->mesh = m;
    made->stages = stages;
    made->ledger = l;
    made->implicit = s->method.pressure == PRESSURE_IMPLICIT;
    const floe_status status = resolve_states(made, with_points);
    if (status != FLOE_OK) ice_destroy(out);
    return status;
}

void ice_destroy(ice **s)
{
    if (!s || !*s) return;
    ice *w = *s;
    context *ctx = w->ctx;
    ice_implicit_destroy(ctx, &w->rows, w->n_regions);
    ice_cut_cells_destroy(ctx, &w->cut_cells);
    ice_injection_destroy(ctx, &w->injection);
    ice_heated_destroy(ctx, &w->heated);
    ice_reactions_destroy(ctx, &w->reactions);
    ice_pairs_destroy(ctx, &w->pairs);
    ice_continued_destroy(ctx, &w->continued);
    ice_closure_destroy(ctx, &w->closure);
    ice_sides_destroy(ctx, &w->sides);
    ice_storage_destroy(ctx, &w->storage);
    memory_free(ctx, s);
}

/* What a field has instances of. */
typedef enum field_owner {
    OWNER_REGIONS,
    OWNER_ALL,
    OWNER_FLUIDS,
    OWNER_POINTS,
    OWNER_REACTIONS,
    OWNER_BURNS
} field_owner;

static field_owner owner_of(field_id id)
{
    switch (id) {
    case C_RHO:
    case C_VEL:
    case C_ENERGY:
    case C_VOL:
    case C_TEMP:
    case C_THETA:
    case C_SOUND:
    case C_KAPPA:
    case C_OPEN:
    case C_RHO_L:
    case F_VEL:
    case F_MOBILITY:
    case F_THETA: return OWNER_ALL;
    case C_VEL_L:
    case C_ENERGY_L:
    case C_VOLUME_L:
    case C_ENERGY_FOUND:
    case C_VOLUME_FOUND:
    case C_DIFFUSION:
    case C_VEL_CENTRED:
    case C_DIFFUSION_HEAT:
    case C_DIFFUSION_T: return OWNER_FLUIDS;
    case C_STRESS_ACCEL:
    case C_SOURCE:
    case C_MOMENTUM_L:
    case C_VELOCITY_CHANGE:
    case C_TEMP_CHANGE: return OWNER_POINTS;
    case C_REACTED: return OWNER_REACTIONS;
    case C_BURNT_MOMENTUM:
    case C_BURNT_ENERGY: return OWNER_BURNS;
    default: return OWNER_REGIONS;
    }
}

static bool owns_field(const ice *s, field_owner owner, int r)
{
    switch (owner) {
    case OWNER_FLUIDS: return !s->material[r].points;
    case OWNER_POINTS: return s->material[r].points;
    case OWNER_BURNS: return ice_burns(s, r);
    default: return true;
    }
}

static floe_status register_fields(ice *s, domain *d)
{
    for (int id = 0; id < FIELD_COUNT; ++id) {
        const field_centring centring = field_describe((field_id)id)->centring;
        if (!s->stages->uses[id] || (centring != FIELD_CELL && centring != FIELD_FACE)) continue;
        const field_owner owner = owner_of((field_id)id);
        const bool reactions = owner == OWNER_REACTIONS || owner == OWNER_BURNS;
        const int instances = owner == OWNER_REGIONS ? s->n_regions
                              : reactions            ? ice_reaction_count(s)
                                                     : s->n_materials;
        for (int r = 0; r < instances; ++r)
            if (owns_field(s, owner, r)) TRY(domain_add(d, (field_id)id, r));
    }
    return FLOE_OK;
}

floe_status ice_register(ice *s, domain *d)
{
    s->domain = d;
    TRY(register_fields(s, d));
    if (s->cut) TRY(ice_cut_cells_create(s));
    const size_t advect = ice_advect_buffer(s), trace = ice_may_trace(s) ? ice_trace_buffer(s) : 0;
    TRY(ice_storage_create(s, advect > trace ? advect : trace, ice_is_mixture(s) && ice_reaction_count(s) == 0));
    if (ice_is_mixture(s)) TRY(ice_closure_create(s));
    if (s->with_points) TRY(ice_continued_create(s));
    return s->scene->method.pressure == PRESSURE_EXPLICIT ? FLOE_OK : ice_implicit_create(s);
}

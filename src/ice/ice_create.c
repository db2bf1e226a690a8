/* Making the ICE solver: which materials, which loads, which fields, which kernels. */
#include "ice/ice_internal.h"

#include "base/memory.h"
#include "base/threads.h"

#include <math.h>

void ice_find_used(const scene *s, bool with_points, bool *used)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        const int r = s->body[b].material;
        used[r] = s->material[r].kind == MATERIAL_FLUID || with_points;
    }
    if (s->has_ambient) used[s->ambient_material] = true;
    for (int k = 0; k < s->n_reactions; ++k) used[s->reaction[k].product] = true;
    for (int a = 0; a < s->mesh.dim; ++a)
        for (int side = 0; side < 2; ++side) {
            const bc_side *wall = &s->bc.side[a][side];
            const bool fluid = wall->material >= 0 && wall->material < s->n_materials &&
                               s->material[wall->material].kind == MATERIAL_FLUID;
            if ((wall->kind == BC_INLET || wall->kind == BC_RESERVOIR) && fluid && !s->mesh.periodic[a])
                used[wall->material] = true;
        }
}

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
        s->with_points = s->with_points || out->points;
        s->viscous = s->viscous || out->shear_viscosity > 0.0 || out->bulk_viscosity > 0.0;
        s->conducts = s->conducts || out->conductivity > 0.0;
        s->n_materials++;
    }
    s->diffuses = (s->viscous || s->conducts || whole->driving) && !scene_is_cut(whole);
    if (s->n_materials == 0)
        return fail_key(s->ctx, KEY("coupling"), "%s: no fluid is in the scene: give a body of a fluid, or `ambient`",
                        coupling_name(whole->coupling));
    s->sealed = scene_is_cut(whole);
    s->gas = -1;
    s->multi = s->n_materials > 1 && !s->sealed;
    return FLOE_OK;
}

static void resolve_loads(ice *s)
{
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (load->kind == LOAD_PRESSURISE || load->kind == LOAD_HEAT) s->pressurise = true;
        if (load->kind == LOAD_BODY_FORCE && load->body < 0)
            for (int a = 0; a < s->mesh->dim; ++a) s->gravity[a] += load->vector[a];
    }
}

ice_reservoir ice_state_at(const eos *law, double p, double T)
{
    ice_reservoir out = {.T = T};
    double dvdp;
    law->model->volume(law->par, 1, &p, &T, &out.v, &dvdp);
    out.rho = 1.0 / out.v;
    law->model->energy(law->par, 1, &out.rho, &T, &out.e);
    return out;
}

/* What inlets bring, what reservoirs hold, and what lies behind outlets that say so. */
static void resolve_reservoirs(ice *s)
{
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2; ++side) {
            const bc_side *wall = &s->scene->bc.side[a][side];
            if (!ice_has_reservoir(wall->kind)) continue;
            const int r = ice_material_of(s, wall->material);
            if (r < 0 || s->material[r].points || !(wall->temperature > 0.0)) continue;
            s->work->reservoir[a][side] = ice_state_at(&s->material[r].eos, wall->pressure, wall->temperature);
        }
}

/* The law's energy floor where it is the same for densities from 1e-6 to 1e6 kg/m3, else NAN. */
static double constant_floor(const eos *law)
{
    const double a = law->model->energy_floor(law->par, 1e-6), b = law->model->energy_floor(law->par, 1.0),
                 c = law->model->energy_floor(law->par, 1e6);
    if (a == b && b == c) return a;
    return NAN;
}

static void choose_kernels(ice *s)
{
    const int d = s->mesh->dim - 1, m = s->multi;
    s->work->kernels = (ice_kernels){.sensor = ice_sensor_row[d][m],
                                     .contact = ice_contact_row[d],
                                     .increment = ice_increment_row[d][m],
                                     .limiter = ice_limiter_row[d],
                                     .face_velocity = ice_face_velocity_row[d][m],
                                     .face_theta = ice_face_theta_row[d],
                                     .sources = ice_source_row_of[d][m],
                                     .advect = ice_advect_of[d][m]};
}

static floe_status resolve_states(ice *s, bool with_points)
{
    TRY(resolve_materials(s, with_points));
    resolve_loads(s);
    TRY(memory_new(s->ctx, &s->work, 1, sizeof *s->work));
    TRY(ice_pairs_resolve(s));
    s->work->threads = threads_most();
    for (int r = 0; r < s->n_materials; ++r) s->work->energy_floor[r] = constant_floor(&s->material[r].eos);
    int fluids = 0;
    for (int r = 0; r < s->n_materials; ++r) {
        s->work->reconcile = s->work->reconcile || (isnan(s->work->energy_floor[r]) && !s->material[r].points);
        fluids += !s->material[r].points;
    }
    s->work->interfaces = s->multi && fluids > 1 && !s->with_points;
    s->work->reconcile = s->work->reconcile || s->work->interfaces;
    resolve_reservoirs(s);
    choose_kernels(s);
    return ice_reactions_resolve(s);
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

static void destroy_work(context *ctx, ice_work **work)
{
    ice_work *w = *work;
    if (!w) return;
    ice_implicit_destroy(ctx, &w->implicit);
    ice_spans_destroy(ctx, w);
    ice_interfaces_destroy(ctx, w);
    for (int b = 0; b < MESH_MAX_BLOCKS; ++b) {
        memory_free(ctx, &w->metric[b]);
        memory_free(ctx, &w->mixed[b].at);
        memory_free(ctx, &w->continued[b].at);
    }
    for (int l = 0; l < SCENE_MAX_LOADS; ++l)
        for (int b = 0; b < MESH_MAX_BLOCKS; ++b) memory_free(ctx, &w->region[l][b].at);
    for (int t = 0; t < w->threads; ++t) {
        if (w->buffer) memory_free(ctx, &w->buffer[t]);
        if (w->set) memory_free(ctx, &w->set[t]);
    }
    ice_reactions_destroy(ctx, w);
    ice_seal_destroy(ctx, &w->sealing);
    memory_free(ctx, &w->buffer);
    memory_free(ctx, &w->set);
    memory_free(ctx, &w->cells);
    memory_free(ctx, &w->tile);
    memory_free(ctx, work);
}

void ice_destroy(ice **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    destroy_work(ctx, &(*s)->work);
    memory_free(ctx, s);
}

int ice_material_of(const ice *s, int wanted)
{
    for (int r = 0; r < s->n_materials; ++r)
        if (s->material[r].scene_material == wanted) return r;
    return -1;
}

/* Which materials a field has instances of. */
typedef enum field_owner {
    OWNER_SHARED,
    OWNER_ALL,
    OWNER_FLUIDS,
    OWNER_POINTS,
    OWNER_REACTIONS,
    OWNER_BURNS
} field_owner;

static field_owner owner_of(const ice *s, field_id id)
{
    switch (id) {
    case C_PRESSURE:
    case C_PRESSURE_ADVANCED:
    case C_DP:
    case C_SHOCK:
    case F_PRESSURE: return s->sealed ? OWNER_ALL : OWNER_SHARED;
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
    case C_DIFFUSION_HEAT:
    case C_DIFFUSION_T: return OWNER_FLUIDS;
    case C_STRESS_ACCEL:
    case C_SOURCE:
    case C_MOMENTUM_L:
    case C_VELOCITY_CHANGE: return OWNER_POINTS;
    case C_REACTED: return OWNER_REACTIONS;
    case C_BURNT_MOMENTUM:
    case C_BURNT_ENERGY: return OWNER_BURNS;
    default: return OWNER_SHARED;
    }
}

static bool owns_field(const ice *s, field_owner owner, int r)
{
    switch (owner) {
    case OWNER_FLUIDS: return !s->material[r].points;
    case OWNER_POINTS: return s->material[r].points;
    case OWNER_BURNS: return s->work->reactions.burns[r];
    default: return true;
    }
}

static floe_status register_fields(ice *s, domain *d)
{
    for (int id = 0; id < FIELD_COUNT; ++id) {
        const field_centring centring = field_describe((field_id)id)->centring;
        if (!s->stages->uses[id] || (centring != FIELD_CELL && centring != FIELD_FACE)) continue;
        const field_owner owner = owner_of(s, (field_id)id);
        const bool reactions = owner == OWNER_REACTIONS || owner == OWNER_BURNS;
        const int instances = owner == OWNER_SHARED ? 1 : reactions ? s->work->reactions.n : s->n_materials;
        for (int r = 0; r < instances; ++r)
            if (owns_field(s, owner, r)) TRY(domain_add(d, (field_id)id, r));
    }
    return FLOE_OK;
}

/* Volumes are positive in the ghosts beyond the axis too, which mirror the cells inside. */
static floe_status make_metrics(ice *s)
{
    const mesh *m = s->mesh;
    for (int id = 0; id < m->n_blocks; ++id) {
        const block *b = &m->block[id];
        const int run = b->n[0] + 2 * MESH_GHOST + 1;
        TRY(memory_new(s->ctx, &s->work->metric[id], (size_t)run * 5, sizeof(double)));
        double *metric = s->work->metric[id];
        for (int i = 0; i < run; ++i) {
            const int cell = b->lo[0] + i - MESH_GHOST;
            const double volume = fabs(mesh_cell_volume(m, cell));
            const bool plane = m->geometry == MESH_CARTESIAN;
            metric[i] = plane ? 1.0 / m->h[0] : fabs(mesh_face_area(m, 0, cell)) / volume;
            metric[run + i] = plane ? 1.0 / m->h[0] : fabs(mesh_face_area(m, 0, cell + 1)) / volume;
            metric[2 * run + i] = volume;
            metric[3 * run + i] = fabs(mesh_face_area(m, 0, cell));
            metric[4 * run + i] = mesh_node(m, 0, cell);
        }
    }
    return FLOE_OK;
}

static floe_status make_scratch(ice *s)
{
    ice_work *w = s->work;
    const mesh *m = s->mesh;
    w->tiles = mesh_tiles(m);
    TRY(memory_new(s->ctx, &w->tile, w->tiles * TILE_VALUES, sizeof(double)));
    TRY(memory_new(s->ctx, &w->buffer, (size_t)w->threads, sizeof *w->buffer));
    const size_t row = 16 * ((size_t)m->n[0] + 8), sweep = ice_advect_buffer(s);
    for (int t = 0; t < w->threads; ++t)
        TRY(memory_new(s->ctx, &w->buffer[t], row > sweep ? row : sweep, sizeof(double)));
    if (!s->multi) return FLOE_OK;
    TRY(memory_new(s->ctx, &w->cells, (size_t)w->threads, sizeof *w->cells));
    TRY(memory_new(s->ctx, &w->set, (size_t)w->threads, sizeof *w->set));
    for (int t = 0; t < w->threads; ++t) TRY(memory_new(s->ctx, &w->set[t], (size_t)m->n[0] + 8, sizeof(unsigned)));
    for (int b = 0; b < m->n_blocks; ++b) {
        const int *n = m->block[b].n;
        const size_t cells = (size_t)n[0] * (size_t)n[1] * (size_t)n[2];
        TRY(ice_spans_create(s, b));
        TRY(ice_interfaces_create(s, b));
        TRY(memory_new(s->ctx, &w->mixed[b].at, cells, sizeof *w->mixed[b].at));
        if (s->with_points) TRY(memory_new(s->ctx, &w->continued[b].at, cells, sizeof *w->continued[b].at));
    }
    return FLOE_OK;
}

floe_status ice_register(ice *s, domain *d)
{
    s->domain = d;
    TRY(register_fields(s, d));
    TRY(make_metrics(s));
    if (s->sealed) TRY(ice_seal_create(s));
    TRY(make_scratch(s));
    return s->scene->method.pressure == PRESSURE_EXPLICIT ? FLOE_OK : ice_implicit_create(s);
}

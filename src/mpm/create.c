/* Creates bodies, fields and kernels from the scene. */
#include "base/memory.h"
#include "mpm/contact/contact.h"
#include "mpm/edge/edge.h"
#include "mpm/fluid/fluid.h"
#include "mpm/fluid/wetted.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/loads/point_loads.h"
#include "mpm/loads/spring.h"
#include "mpm/membrane/enclosed_gas.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/membrane/membrane_normal.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/membrane/membrane_sheet.h"
#include "mpm/motion/motion.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/support_points.h"
#include "mpm/nodes/supports.h"
#include "mpm/nodes/wall_overlap.h"
#include "mpm/state/mean_strain.h"
#include "mpm/state/stress.h"
#include "mpm/step.h"
#include "mpm/surface/surfaces.h"
#include "mpm/thermal/thermal.h"
#include "mpm/transfer/lanes.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/windows.h"
#include "scene/solid_heat.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether fluid points have a velocity field of their own beside solids (wetted.h). */
static bool parts_fluids(const mpm *s)
{
    return s->cells == CELLS_NONE && scene_fluids_apart(s->scene);
}

/* Velocity fields. In pure MPM one for all points, but that a body in contact has its own, and fluids beside solids; one a solid
 * material when the cells couple them. */
static int group_of(const mpm *s, int index)
{
    if (motion_is_given(&s->scene->body[index].motion)) return s->n_groups;
    const bool apart = scene_in_contact(s->scene, index), fluid = s->body[s->n_bodies].fluid, parts = parts_fluids(s);
    for (int b = 0; b < s->n_bodies; ++b) {
        const bool same = s->cells == CELLS_SMEARED ? s->body[b].scene_material == s->scene->body[index].material
                          : parts                   ? s->body[b].fluid == fluid
                                                    : !apart && !scene_in_contact(s->scene, s->body[b].scene_body);
        if (same) return s->body[b].group;
    }
    return s->n_groups;
}

static void resolve_body(mpm *s, int index)
{
    const scene *sc = s->scene;
    mpm_body *b = &s->body[s->n_bodies];
    b->scene_body = index;
    b->scene_material = sc->body[index].material;
    const scene_material *m = &sc->material[b->scene_material];
    b->fluid = m->kind == MATERIAL_FLUID;
    b->membrane = response_of(s, &sc->body[index]);
    b->law = b->fluid ? &point_fluid : m->membrane ? &point_membrane : m->law;
    b->fluid_par = (solid_fluid_par){m->eos, m->shear_viscosity, m->bulk_viscosity};
    b->law_par = b->fluid ? (const void *)&b->fluid_par : m->law_par;
    if (m->membrane) b->law_par = &b->membrane;
    b->depends_on = solid_depends_on(b->law, b->law_par);
    b->specific_heat = m->specific_heat;
    b->warms = scene_solid_has_temperature(sc, b->scene_material, s->cells == CELLS_SMEARED);
    b->conductivity = b->warms ? m->conductivity : 0.0;
    b->plastic_heat = scene_plastic_heat(m);
    b->expansion = b->warms && !motion_is_given(&sc->body[index].motion) ? m->expansion : 0.0;
    b->stress_free_temperature = m->stress_free_temperature;
    b->artificial[0] = m->artificial_linear;
    b->artificial[1] = m->artificial_quadratic;
    b->group = group_of(s, index);
    if (b->group == s->n_groups) s->n_groups++;
    for (int k = 0; k < sc->n_reactions; ++k)
        b->burns = b->burns || (s->cells == CELLS_SMEARED && sc->reaction[k].reactant == b->scene_material);
    if (b->law->n_history > s->n_history) s->n_history = b->law->n_history;
    b->mean_strain = !motion_is_given(&sc->body[index].motion) && body_needs_mean_strain(s, b);
    s->n_bodies++;
}

/* Those that deform, then those with a motion of their own. */
static void resolve_bodies(mpm *s, bool beside)
{
    const scene *sc = s->scene;
    for (int given = 0; given < 2; ++given) {
        for (int b = 0; b < sc->n_bodies; ++b)
            if ((!beside || sc->material[sc->body[b].material].kind == MATERIAL_SOLID) &&
                motion_is_given(&sc->body[b].motion) == (given == 1))
                resolve_body(s, b);
        if (given == 1) break;
        s->n_deforming = s->n_bodies;
        s->n_deforming_groups = s->n_groups;
    }
}

bool keeps_shape(const mpm *s, int body)
{
    return s->basis->fact.shaped && !s->body[body].membrane.model;
}

bool keeps_box(const mpm *s, int body)
{
    return s->basis->fact.sized && !s->basis->fact.shaped && s->body[body].fluid;
}

bool keeps_F(const mpm *s, int body)
{
    return (s->body[body].law->needs & SOLID_NEEDS_F) != 0 || keeps_shape(s, body);
}

/* Whether a body carries a point field, if some stage uses that. */
static bool body_carries(const mpm *s, int body, field_id id)
{
    const mpm_body *b = &s->body[body];
    if (id == P_F) return keeps_F(s, body);
    if (id == P_HALF) return !keeps_box(s, body);
    if (id == P_BOX) return keeps_box(s, body);
    if (id == P_ENERGY) return (b->law->needs & SOLID_HAS_ENERGY) != 0;
    if (id == P_VISCOUS_PRESSURE) return has_artificial(b);
    if (id == P_DENSITY) return b->fluid;
    if (id == P_FREE_MASS) return supports_take_points(s, body);
    if (id == P_TEMP) return b->warms;
    if (id == P_TEMP_GRADIENT) return b->warms && b->conductivity > 0.0;
    if (id == P_THERMAL_STRETCH) return b->expansion != 0.0;
    if (id == P_STRESS_FREE) return b->expansion != 0.0 || (b->warms && b->depends_on != 0);
    if (id == P_DISSIPATED) return dissipates_heat(s, body) || b->expansion != 0.0;
    if (id == P_SHARE || id == P_MASS_LEFT) return b->burns;
    if (id == P_MEAN_PRESSURE) return b->mean_strain;
    if (id == P_VOLUME_RATE) return shares_over_patches(s, body);
    if (id >= P_HISTORY_1 && id <= P_HISTORY_24) return (int)(id - P_HISTORY_1) < b->law->n_history;
    if (id == P_TANGENT || id == P_STRAIN) return b->membrane.model && !is_sheet(s, body);
    if (id == P_STRAIN_HOOP) return b->membrane.model && !is_sheet(s, body) && s->mesh->geometry == MESH_AXISYMMETRIC;
    if (id == P_SURFACE_1 || id == P_SURFACE_2) return b->membrane.model && is_sheet(s, body);
    if (id == P_REST) return exact_drives(s, body);
    if (id == P_DRIVE) return is_driven(s, body);
    if (id == P_NORMAL) return normals_are_free(s, body);
    return true;
}

/* Whether a surface in three dimensions encloses gas points (enclosed_gas.c). */
static bool encloses_points(const mpm *s)
{
    const int body = scene_enclosing_body(s->scene);
    return s->cells == CELLS_NONE && body >= 0 && s->scene->body[body].membrane.surface.kind != SHEET_NONE;
}

/* The parts that the scene has a use for. */
static floe_status create_parts(mpm *s)
{
    TRY(memory_new(s->ctx, &s->moved, mesh_tiles(s->mesh), sizeof *s->moved));
    TRY(windows_create(s));
    TRY(scratch_create(s));
    TRY(motions_create(s));
    TRY(supports_create(s));
    TRY(memory_new(s->ctx, &s->surfaces, 1, sizeof *s->surfaces));
    TRY(create_springs(s));
    if (encloses_points(s)) TRY(memory_new(s->ctx, &s->enclosure, 1, sizeof *s->enclosure));
    if (has_fluid_points(s) && s->scene->method.density != DENSITY_CONTINUITY)
        TRY(memory_new(s->ctx, &s->cell_mass, mesh_cells(s->mesh), sizeof *s->cell_mass));
    if (s->carries[P_TANGENT] || s->carries[P_SURFACE_1])
        TRY(memory_new(s->ctx, &s->curve, SCENE_MAX_BODIES, sizeof *s->curve));
    if (s->carries[P_NORMAL]) TRY(memory_new(s->ctx, &s->normals, SCENE_MAX_BODIES, sizeof *s->normals));
    if (mpm_edge_penalty(s) > 0.0) TRY(edges_create(s));
    if (parts_fluids(s)) TRY(wetted_create(s));
    if (s->scene->contact.enabled) TRY(contact_create(s));
    return overlaps_create(s);
}

static bool any_shares_over_patches(const mpm *s)
{
    bool any = false;
    for (int b = 0; b < s->n_bodies; ++b) any = any || shares_over_patches(s, b);
    return any;
}

/* Beside cells two terms: they preserve rotation as well as four, at a third of the cost (docs/defaults.md). With hat functions also two for
 * nearly incompressible bodies: three and more are unstable at a bulk modulus of 500 times the shear modulus, whatever the step. */
static int order_of(const mpm *s)
{
    if (s->scene->method.filter_order > 0) return s->scene->method.filter_order;
    const bool few = s->cells != CELLS_NONE || (s->basis->smoothness == 0 && any_shares_over_patches(s));
    return few && s->transfer->restore ? 2 : s->transfer->order;
}

static floe_status fill_solver(mpm *s, const scene *sc, const mesh *m, stage_list *stages, ledger *l, bool beside)
{
    s->scene = sc;
    s->mesh = m;
    s->stages = stages;
    s->ledger = l;
    s->n_substeps = 1;
    s->cells = !beside ? CELLS_NONE : scene_is_cut(sc) ? CELLS_CUT : CELLS_SMEARED;
    s->basis = basis_find(sc->method.basis);
    if (!s->basis) return fail_key(s->ctx, KEY("method", "basis"), "there is no basis '%s'", sc->method.basis);
    s->transfer = transfer_find(scene_transfer(sc));
    if (!s->transfer)
        return fail_key(s->ctx, KEY("method", "transfer"), "there is no transfer '%s'", scene_transfer(sc));
    s->share = s->transfer->share;
    if (isnan(s->share)) s->share = isnan(sc->method.flip) ? MPM_FLIP_SHARE : sc->method.flip;
    resolve_bodies(s, beside);
    s->order = order_of(s);
    for (int id = 0; id < FIELD_COUNT; ++id)
        for (int b = 0; b < s->n_bodies; ++b) s->carries[id] = s->carries[id] || body_carries(s, b, (field_id)id);
    if (s->n_groups > MPM_MAX_GROUPS)
        return fail_key(s->ctx, KEY("contact"), "%d velocity fields are more than the %d that a run holds", s->n_groups,
                        MPM_MAX_GROUPS);
    for (int b = 0; b < SCENE_MAX_BODIES; ++b) s->body_group[b] = -1;
    for (int b = 0; b < s->n_bodies; ++b) s->body_group[s->body[b].scene_body] = s->body[b].group;
    return create_parts(s);
}

floe_status mpm_create(mpm **out, context *ctx, const scene *sc, const mesh *m, stage_list *stages, ledger *l,
                       bool beside_cells)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    const floe_status status = fill_solver(*out, sc, m, stages, l, beside_cells);
    if (status != FLOE_OK) mpm_destroy(out);
    return status;
}

static void free_curves(mpm *s)
{
    for (int b = 0; s->curve && b < SCENE_MAX_BODIES; ++b) membrane_curve_free(s->ctx, &s->curve[b]);
    memory_free(s->ctx, &s->curve);
    for (int b = 0; s->normals && b < SCENE_MAX_BODIES; ++b) normals_free(&s->normals[b]);
    memory_free(s->ctx, &s->normals);
}

void mpm_destroy(mpm **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    windows_free(*s);
    scratch_free(*s);
    motions_free(*s);
    supports_free(*s);
    surfaces_free(*s);
    free_curves(*s);
    free_enclosure(*s);
    free_saved_points(*s);
    edges_free(*s);
    wetted_free(*s);
    free_springs(*s);
    memory_free(ctx, &(*s)->cell_mass);
    memory_free(ctx, &(*s)->moved);
    contact_destroy(*s);
    overlaps_free(*s);
    implicit_destroy(*s);
    for (int b = 0; b < MESH_MAX_BLOCKS; ++b)
        for (int k = 0; k < SCENE_MAX_BODIES; ++k) memory_free(ctx, &(*s)->points[b][k].tile_start);
    memory_free(ctx, s);
}

static floe_status register_field(mpm *s, field_id id)
{
    const field_centring centring = field_describe(id)->centring;
    if (centring == FIELD_POINT)
        for (int b = 0; b < s->n_bodies; ++b)
            if (body_carries(s, b, id)) TRY(domain_add(s->domain, id, b));
    if (centring == FIELD_NODE)
        for (int g = 0; g < (id == N_PRESSURE || id == N_DRY_MASS ? 1 : s->n_groups); ++g)
            TRY(domain_add(s->domain, id, g));
    return FLOE_OK;
}

floe_status mpm_register(mpm *s, domain *d)
{
    s->domain = d;
    for (int id = 0; id < FIELD_COUNT; ++id)
        if (s->stages->uses[id]) TRY(register_field(s, (field_id)id));
    const size_t nodes = (size_t)s->windows->window_nodes * MPM_MAX_RECORD,
                 normals = s->contact ? contact_partials(s) : 0;
    TRY(domain_reserve_partials(d, nodes > normals ? nodes : normals));
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int k = 0; k < s->n_bodies; ++k)
            TRY(memory_new(s->ctx, &s->points[b][k].tile_start, (size_t)s->mesh->block[b].n_tiles + 1, sizeof(size_t)));
    return FLOE_OK;
}

size_t mpm_body_points(const mpm *s, int body)
{
    size_t n = 0;
    for (int b = 0; b < s->mesh->n_blocks; ++b) n += s->points[b][body].n;
    return n;
}

size_t mpm_count(const mpm *s)
{
    size_t n = 0;
    for (int body = 0; body < s->n_bodies; ++body) n += mpm_body_points(s, body);
    return n;
}

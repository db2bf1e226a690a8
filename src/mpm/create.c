/* From the scene to a set of bodies, fields and kernels. */
#include "base/memory.h"
#include "base/threads.h"
#include "mpm/contact/contact.h"
#include "mpm/edge/edge.h"
#include "mpm/implicit/implicit.h"
#include "mpm/membrane/enclosed_gas.h"
#include "mpm/membrane/membrane_normal.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/membrane/membrane_sheet.h"
#include "mpm/point_loads.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/wall_overlap.h"
#include "mpm/wetted.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether fluid points have a velocity field of their own beside solids (wetted.h). */
static bool parts_fluids(const mpm *s)
{
    return !s->coupled && !s->seals && scene_fluids_apart(s->scene);
}

/* Velocity fields. In pure MPM one for all points, but that a body in contact has its own, and fluids beside solids; one a solid
 * material when the cells couple them. */
static int group_of(const mpm *s, int index)
{
    const bool apart = scene_in_contact(s->scene, index), fluid = s->body[s->n_bodies].fluid, parts = parts_fluids(s);
    for (int b = 0; b < s->n_bodies; ++b) {
        const bool same = s->coupled ? s->body[b].scene_material == s->scene->body[index].material
                          : parts    ? s->body[b].fluid == fluid
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
    b->specific_heat = m->specific_heat;
    b->artificial[0] = m->artificial_linear;
    b->artificial[1] = m->artificial_quadratic;
    b->group = group_of(s, index);
    if (b->group == s->n_groups) s->n_groups++;
    for (int k = 0; k < sc->n_reactions; ++k)
        b->burns = b->burns || (s->coupled && sc->reaction[k].reactant == b->scene_material);
    s->burns = s->burns || b->burns;
    s->needs_F = s->needs_F || keeps_F(s, s->n_bodies);
    s->boxes = s->boxes || keeps_box(s, s->n_bodies);
    s->has_energy = s->has_energy || (b->law->needs & SOLID_HAS_ENERGY) != 0;
    s->artificial = s->artificial || has_artificial(b);
    s->cell_density = s->cell_density || (b->fluid && s->scene->method.density != DENSITY_CONTINUITY);
    if (b->law->n_history > s->n_history) s->n_history = b->law->n_history;
    s->membranes = s->membranes || m->membrane;
    s->sheets = s->sheets || (m->membrane && is_sheet(s, s->n_bodies));
    s->lines = s->lines || (m->membrane && !is_sheet(s, s->n_bodies));
    s->free_normals = s->free_normals || normals_are_free(s, s->n_bodies);
    s->placed = s->placed || (m->membrane && sc->body[index].membrane.strain == STRAIN_BY_POSITIONS);
    s->axisymmetric_membranes = s->membranes && s->mesh->geometry == MESH_AXISYMMETRIC;
    s->n_bodies++;
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

static floe_status make_work(mpm *s)
{
    TRY(memory_new(s->ctx, &s->work, 1, sizeof *s->work));
    struct mpm_work *w = s->work;
    const mesh *m = s->mesh;
    w->kernel = kernels_of(m->dim, m->geometry, s->basis->kind);
    w->basis_1d = s->basis->weights;
    w->reach = s->basis->reach;
    w->window_nodes = 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        w->window[a] = a < m->dim ? m->tile[a] + 1 + 2 * w->reach : 1;
        w->window_nodes *= w->window[a];
    }
    for (int b = 0; b < SCENE_MAX_BODIES; ++b) w->body_group[b] = -1;
    for (int b = 0; b < s->n_bodies; ++b) w->body_group[s->body[b].scene_body] = s->body[b].group;
    const size_t tiles = mesh_tiles(m);
    w->threads = threads_most();
    if (s->cell_density) TRY(memory_new(s->ctx, &w->cell_mass, mesh_cells(m), sizeof *w->cell_mass));
    TRY(memory_new(s->ctx, &w->active, tiles, sizeof *w->active));
    TRY(memory_new(s->ctx, &w->moved, tiles, sizeof *w->moved));
    TRY(memory_new(s->ctx, &w->tile_sum, tiles * MPM_TILE_SUMS, sizeof *w->tile_sum));
    if (s->membranes) TRY(memory_new(s->ctx, &w->curve, SCENE_MAX_BODIES, sizeof *w->curve));
    if (s->free_normals) TRY(memory_new(s->ctx, &w->normals, SCENE_MAX_BODIES, sizeof *w->normals));
    if (mpm_edge_penalty(s) > 0.0) TRY(edges_create(s));
    if (parts_fluids(s)) TRY(wetted_create(s));
    return memory_new(s->ctx, &w->batch, (size_t)w->threads, sizeof *w->batch);
}

/* Beside cells two terms: spin is kept as by four, at a third of their cost (docs/defaults.md). */
static int order_of(const mpm *s)
{
    if (s->scene->method.filter_order > 0) return s->scene->method.filter_order;
    return (s->coupled || s->seals) && s->transfer->restore ? 2 : s->transfer->order;
}

static floe_status fill_solver(mpm *s, const scene *sc, const mesh *m, stage_list *stages, ledger *l, bool beside)
{
    s->scene = sc;
    s->mesh = m;
    s->stages = stages;
    s->ledger = l;
    s->n_substeps = 1;
    s->seals = beside && scene_is_cut(sc);
    s->encloses = !beside && scene_enclosing_body(sc) >= 0 &&
                  sc->body[scene_enclosing_body(sc)].membrane.surface.kind != SHEET_NONE;
    s->coupled = beside && !s->seals;
    s->basis = basis_find(sc->method.basis);
    if (!s->basis) return fail_key(s->ctx, KEY("method", "basis"), "there is no basis '%s'", sc->method.basis);
    s->transfer = transfer_find(scene_transfer(sc));
    if (!s->transfer)
        return fail_key(s->ctx, KEY("method", "transfer"), "there is no transfer '%s'", scene_transfer(sc));
    s->order = order_of(s);
    s->share = s->transfer->share;
    if (isnan(s->share)) s->share = isnan(sc->method.flip) ? 0.99 : sc->method.flip;
    for (int b = 0; b < sc->n_bodies; ++b)
        if (!beside || sc->material[sc->body[b].material].kind == MATERIAL_SOLID) resolve_body(s, b);
    for (int b = 0; b < s->n_bodies; ++b)
        s->blends_by_way =
            s->blends_by_way || (s->body[b].fluid && isnan(s->transfer->share) && isnan(sc->method.flip));
    for (int b = 0; b < s->n_bodies; ++b) s->driven = s->driven || is_driven(s, b);
    if (s->n_groups > MPM_MAX_GROUPS)
        return fail_key(s->ctx, KEY("contact"), "%d velocity fields are more than the %d that a run holds", s->n_groups,
                        MPM_MAX_GROUPS);
    TRY(make_work(s));
    if (sc->contact.enabled) TRY(contact_create(s));
    return overlaps_create(s);
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

static void free_lines(context *ctx, struct mpm_work *w)
{
    for (int b = 0; w->curve && b < SCENE_MAX_BODIES; ++b) membrane_curve_free(ctx, &w->curve[b]);
    memory_free(ctx, &w->curve);
    for (int b = 0; w->normals && b < SCENE_MAX_BODIES; ++b) normals_free(&w->normals[b]);
    memory_free(ctx, &w->normals);
}

void mpm_destroy(mpm **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    if ((*s)->work) {
        free_lines(ctx, (*s)->work);
        free_membrane_force(ctx, (*s)->work);
        free_markers(ctx, &(*s)->work->markers);
        free_saved_points(ctx, (*s)->work);
        edges_free(ctx, &(*s)->work->edges);
        wetted_free(ctx, &(*s)->work->wetted);
        free_enclosure(ctx, &(*s)->work->enclosure);
        memory_free(ctx, &(*s)->work->active);
        memory_free(ctx, &(*s)->work->moved);
        memory_free(ctx, &(*s)->work->cell_mass);
        memory_free(ctx, &(*s)->work->tile_sum);
        memory_free(ctx, &(*s)->work->batch);
        memory_free(ctx, &(*s)->work->surface);
        memory_free(ctx, &(*s)->work->surface_next);
        memory_free(ctx, &(*s)->work->support);
    }
    memory_free(ctx, &(*s)->work);
    contact_destroy(*s);
    overlaps_free(*s);
    implicit_destroy(*s);
    for (int b = 0; b < MESH_MAX_BLOCKS; ++b)
        for (int k = 0; k < SCENE_MAX_BODIES; ++k) memory_free(ctx, &(*s)->points[b][k].tile_start);
    memory_free(ctx, s);
}

/* Whether a body holds a point field that some stage uses. */
static bool body_holds(const mpm *s, int body, field_id id)
{
    const mpm_body *b = &s->body[body];
    if (id == P_F) return keeps_F(s, body);
    if (id == P_HALF) return !keeps_box(s, body);
    if (id == P_BOX) return keeps_box(s, body);
    if (id == P_ENERGY) return (b->law->needs & SOLID_HAS_ENERGY) != 0;
    if (id == P_VISCOUS_PRESSURE) return has_artificial(b);
    if (id == P_DENSITY) return b->fluid;
    if (id == P_SHARE || id == P_MASS_LEFT) return b->burns;
    if (id >= P_HISTORY_1 && id <= P_HISTORY_8) return (int)(id - P_HISTORY_1) < b->law->n_history;
    if (id == P_TANGENT || id == P_STRAIN || id == P_STRAIN_HOOP) return b->membrane.model && !is_sheet(s, body);
    if (id == P_SURFACE_1 || id == P_SURFACE_2) return b->membrane.model && is_sheet(s, body);
    if (id == P_REST || id == P_DRIVE) return is_driven(s, body);
    if (id == P_NORMAL) return normals_are_free(s, body);
    return true;
}

static floe_status register_field(mpm *s, field_id id)
{
    const field_centring centring = field_describe(id)->centring;
    if (centring == FIELD_POINT)
        for (int b = 0; b < s->n_bodies; ++b)
            if (body_holds(s, b, id)) TRY(domain_add(s->domain, id, b));
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
    const size_t nodes = (size_t)s->work->window_nodes * MPM_MAX_RECORD, normals = s->contact ? contact_partials(s) : 0;
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

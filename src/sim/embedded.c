#include "sim/embedded.h"

#include "base/memory.h"
#include "mpm/surface/boundary.h"
#include "scene/solid_heat.h"
#include "sim/interface.h"
#include "sim/light_solid_check.h"

#include <stdio.h>

/* Of a cell: solids in contact overlap by less, but for those that the nodes do not keep apart. */
static const double contact_overlap = 0.25;

static floe_status create_boundary(embedded *t, const mesh *m, int holder, embedded_boundary *boundary)
{
    boundary->share = 1.0;
    boundary->fluid = -1;
    for (int b = 0; b < t->points->n_bodies; ++b)
        if (t->points->body[b].scene_body == holder) boundary->body = b;
    for (int k = 0; k < CUT_PLACES; ++k) {
        TRY(cut_create(&boundary->place[k], t->ctx, m));
        boundary->place[k].overlap = holder < 0 ? contact_overlap : 0.0;
    }
    return FLOE_OK;
}

floe_status embedded_create(embedded **out, sim *s)
{
    int holder
        [SCENE_MAX_ENCLOSING]; /* surfaces of solids have none, and a boundary for each fluid, or one for all that share cells */
    const int n = scene_enclosing_bodies(s->scene, holder);
    TRY(interface_check(s->scene, &s->mesh));
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    embedded *t = *out;
    *t = (embedded){.ctx = s->ctx,
                    .stages = &s->stages,
                    .points = s->mpm,
                    .gases = s->ice,
                    .n_boundaries = n > 0 ? n : s->ice->n_regions,
                    .walls = {.ctx = s->ctx, .solve = s->ice->implicit ? ice_cut_solve : NULL, .fluids = s->ice}};
    s->ice->heats_walls = scene_heat_passes_walls(s->scene);
    /* stages that some step may need are planned */
    embedded_use_wall_response(t, n == 0 && (lightest_moved_solid(s->scene) >= 0 || s->ice->implicit));
    for (int l = 0; l < t->n_boundaries; ++l) {
        TRY(create_boundary(t, &s->mesh, n > 0 ? holder[l] : -1, &t->boundary[l]));
        if (n == 0) t->boundary[l].fluid = s->ice->material[l].scene_material;
    }
    return FLOE_OK;
}

void embedded_destroy(embedded **t)
{
    if (!t || !*t) return;
    context *ctx = (*t)->ctx;
    for (int l = 0; l < (*t)->n_boundaries; ++l) {
        embedded_boundary *boundary = &(*t)->boundary[l];
        for (int k = 0; k < CUT_PLACES; ++k) cut_destroy(&boundary->place[k]);
        memory_free(ctx, &boundary->velocity);
        memory_free(ctx, &boundary->path);
        memory_free(ctx, &boundary->force);
        memory_free(ctx, &boundary->temperature);
        memory_free(ctx, &boundary->heat_flow);
    }
    wall_response_free(&(*t)->walls);
    memory_free(ctx, t);
}

void embedded_use_wall_response(embedded *t, bool implicit)
{
    t->gases->walls = implicit ? &t->walls : NULL;
    mpm_boundary_responds(t->points, t->gases->walls);
}

static floe_status reserve_vertices(const embedded *t, embedded_boundary *boundary, int vertices)
{
    if (vertices <= boundary->reserved) return FLOE_OK;
    TRY(memory_resize(t->ctx, &boundary->velocity, 3 * (size_t)vertices, sizeof(double)));
    TRY(memory_resize(t->ctx, &boundary->path, 3 * (size_t)vertices, sizeof(double)));
    TRY(memory_resize(t->ctx, &boundary->force, 3 * (size_t)vertices, sizeof(double)));
    if (t->gases->heats_walls) {
        TRY(memory_resize(t->ctx, &boundary->temperature, (size_t)vertices, sizeof(double)));
        TRY(memory_resize(t->ctx, &boundary->heat_flow, (size_t)vertices, sizeof(double)));
    }
    boundary->reserved = vertices;
    return FLOE_OK;
}

/* Solids that come to touch, or to a side, with gas between them are more than surfaces can follow. */
static void tell_remedy(context *ctx)
{
    char why[256];
    (void)snprintf(why, sizeof why, "%s", context_message(ctx));
    context_clear(ctx);
    (void)fail(ctx, FLOE_RETRY,
               "%s: sharp ends where solids come to touch each other or a side; use method.interface: smeared", why);
}

/* The message for a boundary that cannot be followed says what it is: a membrane, or the surface of the solids. */
static floe_status tell_of_boundary(const embedded *t, const embedded_boundary *boundary, floe_status status)
{
    const scene *s = t->points->scene;
    const scene_body *body = &s->body[t->points->body[boundary->body].scene_body];
    const bool holds = body->membrane.present && body->membrane.encloses >= 0;
    if (status == FLOE_OK) return status;
    if (holds) return fail_under(t->ctx, status, KEY("bodies", body->name, "membrane"));
    if (status == FLOE_RETRY) tell_remedy(t->ctx);
    return fail_under(t->ctx, status, KEY("method", "interface"));
}

/* Where a boundary is, or will be. */
static floe_status find_place(const embedded *t, const embedded_boundary *boundary, bool next, cut_surface *out)
{
    if (boundary->fluid >= 0)
        TRY(mpm_boundary_beside(t->points, t->points->scene->fluids_share ? -1 : boundary->fluid, next, out));
    else
        TRY(mpm_boundary_vertices(t->points, boundary->body, next, out));
    return tell_of_boundary(t, boundary, cut_find(out));
}

/* A boundary as the gases see it: what it encloses stays, the rest is of this step. */
static ice_embedded_boundary *renew_boundary(const embedded *t, int l)
{
    ice_embedded_boundary *seen = &t->gases->embedded.boundary[l];
    *seen = (ice_embedded_boundary){.enclosed = seen->enclosed, .within = seen->within, .place = t->boundary[l].place};
    return seen;
}

static floe_status find_boundary_now(embedded *t, embedded_boundary *boundary)
{
    cut_surface *now = &boundary->place[CUT_NOW];
    TRY(find_place(t, boundary, false, now));
    TRY(reserve_vertices(t, boundary, now->n_vertices));
    mpm_boundary_velocity(t->points, boundary->body, now, boundary->velocity);
    for (int k = 0; k < ICE_CUT_PREDICTED; ++k)
        TRY(tell_of_boundary(t, boundary,
                             cut_ahead(now, boundary->velocity, (k + 0.5) / ICE_CUT_PREDICTED * t->gases->dt,
                                       &boundary->place[CUT_MEAN + k])));
    return FLOE_OK;
}

/* The boundaries where they are: what they cut, and how fast they move. */
static floe_status embedded_find_now(embedded *t)
{
    for (int l = 0; l < t->n_boundaries; ++l) {
        embedded_boundary *boundary = &t->boundary[l];
        TRY(find_boundary_now(t, boundary));
        ice_embedded_boundary *seen = renew_boundary(t, l);
        seen->velocity = boundary->velocity;
        seen->path = boundary->path;
        seen->force = boundary->force;
        seen->temperature = boundary->temperature;
        seen->heat_flow = boundary->heat_flow;
    }
    if (!t->nested) ice_cut_nest(t->gases);
    t->nested = true;
    for (int place = CUT_NOW; place < CUT_NEXT; ++place) TRY(ice_cut_check(t->gases, place));
    return FLOE_OK;
}

floe_status embedded_find_still(embedded *t)
{
    for (int l = 0; l < t->n_boundaries; ++l) {
        embedded_boundary *boundary = &t->boundary[l];
        TRY(find_place(t, boundary, false, &boundary->place[CUT_NOW]));
        (void)renew_boundary(t, l);
    }
    return ice_cut_check(t->gases, CUT_NOW);
}

floe_status embedded_find_moved(embedded *t)
{
    for (int l = 0; l < t->n_boundaries; ++l)
        TRY(find_place(t, &t->boundary[l], true, &t->boundary[l].place[CUT_NEXT]));
    return ice_cut_check(t->gases, CUT_NEXT);
}

static floe_status embedded_find_temperatures(embedded *t)
{
    for (int l = 0; l < t->n_boundaries; ++l) mpm_boundary_temperature(t->points, t->boundary[l].temperature);
    return FLOE_OK;
}

static floe_status embedded_push_points(embedded *t)
{
    mpm_boundary_clear(t->points);
    for (int l = 0; l < t->n_boundaries; ++l) {
        const embedded_boundary *boundary = &t->boundary[l];
        mpm_boundary_force(t->points, boundary->body, &boundary->place[CUT_NOW], boundary->force);
        if (t->gases->heats_walls) mpm_boundary_heat(t->points, boundary->heat_flow);
    }
    return FLOE_OK;
}

/* The new positions of the points, and the displacements over which the pressure has done work. */
static floe_status embedded_find_next(embedded *t)
{
    for (int l = 0; l < t->n_boundaries; ++l) {
        embedded_boundary *boundary = &t->boundary[l];
        mpm_boundary_displacement(t->points, boundary->body, &boundary->place[CUT_NOW], boundary->path);
        t->gases->embedded.boundary[l].heat = boundary->share * mpm_boundary_lost_energy(t->points);
    }
    return embedded_find_moved(t);
}

/* Which boundary's gas takes up how much of what the points lose. */
static floe_status share_losses(embedded *t)
{
    mpm_totals sum;
    double mass = 0.0;
    for (int l = 0; l < t->n_boundaries && t->boundary[0].fluid >= 0; ++l) t->boundary[l].share = 1.0 / t->n_boundaries;
    if (t->n_boundaries == 1 || t->boundary[0].fluid >= 0) return FLOE_OK;
    TRY(mpm_sum(t->points, &sum));
    for (int l = 0; l < t->n_boundaries; ++l) mass += sum.mass[t->boundary[l].body];
    for (int l = 0; l < t->n_boundaries; ++l) t->boundary[l].share = sum.mass[t->boundary[l].body] / mass;
    return FLOE_OK;
}

/* What would only be met as a step that goes bad is said at the start. */
static floe_status check_boundaries(const sim *s, floe_status found)
{
    const int holder = scene_enclosing_body(s->scene);
    const char *const *key = holder < 0 ? KEY("method", "interface") : KEY("bodies", s->scene->body[holder].name);
    if (found == FLOE_RETRY) return fail_under(s->ctx, FLOE_BAD_INPUT, key); /* the message stands */
    return found;
}

floe_status embedded_initialise(sim *s)
{
    TRY(share_losses(s->embedded));
    TRY(check_boundaries(s, embedded_find_now(s->embedded)));
    return ice_cut_initialise(s->ice);
}

floe_status embedded_step(sim *s)
{
    embedded *t = s->embedded;
    STAGE(t, ALWAYS, embedded_find_now, READS(P_ID, P_POS, P_VEL), WRITES(NOTHING));
    TRY(mpm_surface_temperature_stages(s->mpm));
    STAGE(t, s->ice->heats_walls, embedded_find_temperatures, READS(N_CAPACITY, N_TEMP), WRITES(NOTHING));
    TRY(ice_cut_pressure_stages(s->ice));
    STAGE(t, ALWAYS, embedded_push_points, READS(P_POS), WRITES(NOTHING));
    TRY(mpm_step_in_substeps(s->mpm));
    STAGE(t, ALWAYS, embedded_find_next, READS(P_ID, P_POS, N_VEL_L, N_ACCEL), WRITES(NOTHING));
    return ice_cut_flow_stages(s->ice);
}

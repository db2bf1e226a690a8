#include "sim/sealed_gases.h"

#include "base/memory.h"
#include "mpm/surface/boundary.h"
#include "sim/interface.h"
#include "sim/light_solid_check.h"

#include <stdio.h>

/* Of a cell: solids in contact overlap by less, but for those that the nodes do not keep apart. */
static const double contact_overlap = 0.25;

static floe_status create_line(sealed *t, const mesh *m, int holder, sealed_line *line)
{
    line->share = 1.0;
    line->fluid = -1;
    for (int b = 0; b < t->points->n_bodies; ++b)
        if (t->points->body[b].scene_body == holder) line->body = b;
    for (int k = 0; k < SEAL_PLACES; ++k) {
        TRY(cut_create(&line->place[k], t->ctx, m));
        line->place[k].overlap = holder < 0 ? contact_overlap : 0.0;
    }
    return FLOE_OK;
}

floe_status sealed_create(sealed **out, sim *s)
{
    int holder
        [SCENE_MAX_ENCLOSING]; /* surfaces of solids have none, and a line for each fluid, or one for all that share cells */
    const int n = scene_enclosing_bodies(s->scene, holder);
    TRY(interface_check(s->scene, &s->mesh));
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    sealed *t = *out;
    *t = (sealed){.ctx = s->ctx,
                  .stages = &s->stages,
                  .points = s->mpm,
                  .gases = s->ice,
                  .n_lines = n > 0 ? n : s->ice->n_regions,
                  .walls = {.ctx = s->ctx, .solve = s->ice->implicit ? ice_sealed_solve : NULL, .fluids = s->ice}};
    /* stages that some step may need are planned */
    sealed_use_wall_response(t, n == 0 && (lightest_moved_solid(s->scene) >= 0 || s->ice->implicit));
    for (int l = 0; l < t->n_lines; ++l) {
        TRY(create_line(t, &s->mesh, n > 0 ? holder[l] : -1, &t->line[l]));
        if (n == 0) t->line[l].fluid = s->ice->material[l].scene_material;
    }
    return FLOE_OK;
}

void sealed_destroy(sealed **t)
{
    if (!t || !*t) return;
    context *ctx = (*t)->ctx;
    for (int l = 0; l < (*t)->n_lines; ++l) {
        sealed_line *line = &(*t)->line[l];
        for (int k = 0; k < SEAL_PLACES; ++k) cut_destroy(&line->place[k]);
        memory_free(ctx, &line->velocity);
        memory_free(ctx, &line->path);
        memory_free(ctx, &line->force);
    }
    wall_response_free(&(*t)->walls);
    memory_free(ctx, t);
}

void sealed_use_wall_response(sealed *t, bool implicit)
{
    t->gases->walls = implicit ? &t->walls : NULL;
    mpm_boundary_responds(t->points, t->gases->walls);
}

static floe_status reserve_vertices(const sealed *t, sealed_line *line, int vertices)
{
    if (vertices <= line->reserved) return FLOE_OK;
    TRY(memory_resize(t->ctx, &line->velocity, 3 * (size_t)vertices, sizeof(double)));
    TRY(memory_resize(t->ctx, &line->path, 3 * (size_t)vertices, sizeof(double)));
    TRY(memory_resize(t->ctx, &line->force, 3 * (size_t)vertices, sizeof(double)));
    line->reserved = vertices;
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
static floe_status tell_of_line(const sealed *t, const sealed_line *line, floe_status status)
{
    const scene *s = t->points->scene;
    const scene_body *body = &s->body[t->points->body[line->body].scene_body];
    const bool holds = body->membrane.present && body->membrane.encloses >= 0;
    if (status == FLOE_OK) return status;
    if (holds) return fail_under(t->ctx, status, KEY("bodies", body->name, "membrane"));
    if (status == FLOE_RETRY) tell_remedy(t->ctx);
    return fail_under(t->ctx, status, KEY("method", "interface"));
}

/* Where a line is, or will be. */
static floe_status find_place(const sealed *t, const sealed_line *line, bool next, cut_surface *out)
{
    if (line->fluid >= 0)
        TRY(mpm_boundary_beside(t->points, t->points->scene->fluids_share ? -1 : line->fluid, next, out));
    else
        TRY(mpm_boundary_vertices(t->points, line->body, next, out));
    return tell_of_line(t, line, cut_find(out));
}

/* A line as the gases see it: what it encloses stays, the rest is of this step. */
static ice_seal_line *renew_seal(const sealed *t, int l)
{
    ice_seal_line *seal = &t->gases->seal.line[l];
    *seal = (ice_seal_line){.enclosed = seal->enclosed, .within = seal->within, .place = t->line[l].place};
    return seal;
}

static floe_status find_line_now(sealed *t, sealed_line *line)
{
    cut_surface *now = &line->place[SEAL_NOW];
    TRY(find_place(t, line, false, now));
    TRY(reserve_vertices(t, line, now->n_vertices));
    mpm_boundary_velocity(t->points, line->body, now, line->velocity);
    for (int k = 0; k < ICE_SEAL_PLACES; ++k)
        TRY(tell_of_line(
            t, line,
            cut_ahead(now, line->velocity, (k + 0.5) / ICE_SEAL_PLACES * t->gases->dt, &line->place[SEAL_MEAN + k])));
    return FLOE_OK;
}

/* The lines where they are: what they cut, and how fast they move. */
static floe_status sealed_find_now(sealed *t)
{
    for (int l = 0; l < t->n_lines; ++l) {
        sealed_line *line = &t->line[l];
        TRY(find_line_now(t, line));
        ice_seal_line *seal = renew_seal(t, l);
        seal->velocity = line->velocity;
        seal->path = line->path;
        seal->force = line->force;
    }
    if (!t->nested) ice_seal_nest(t->gases);
    t->nested = true;
    for (int place = SEAL_NOW; place < SEAL_NEXT; ++place) TRY(ice_seal_check(t->gases, place));
    return FLOE_OK;
}

floe_status sealed_find_still(sealed *t)
{
    for (int l = 0; l < t->n_lines; ++l) {
        sealed_line *line = &t->line[l];
        TRY(find_place(t, line, false, &line->place[SEAL_NOW]));
        (void)renew_seal(t, l);
    }
    return ice_seal_check(t->gases, SEAL_NOW);
}

floe_status sealed_find_moved(sealed *t)
{
    for (int l = 0; l < t->n_lines; ++l) TRY(find_place(t, &t->line[l], true, &t->line[l].place[SEAL_NEXT]));
    return ice_seal_check(t->gases, SEAL_NEXT);
}

static floe_status sealed_push_points(sealed *t)
{
    mpm_boundary_clear(t->points);
    for (int l = 0; l < t->n_lines; ++l)
        mpm_boundary_force(t->points, t->line[l].body, &t->line[l].place[SEAL_NOW], t->line[l].force);
    return FLOE_OK;
}

/* The new positions of the points, and the displacements over which the pressure has done work. */
static floe_status sealed_find_next(sealed *t)
{
    for (int l = 0; l < t->n_lines; ++l) {
        sealed_line *line = &t->line[l];
        mpm_boundary_displacement(t->points, line->body, &line->place[SEAL_NOW], line->path);
        t->gases->seal.line[l].heat = line->share * mpm_boundary_lost_energy(t->points);
    }
    return sealed_find_moved(t);
}

/* Which line's gas takes up how much of what the points lose. */
static floe_status share_losses(sealed *t)
{
    mpm_totals sum;
    double mass = 0.0;
    for (int l = 0; l < t->n_lines && t->line[0].fluid >= 0; ++l) t->line[l].share = 1.0 / t->n_lines;
    if (t->n_lines == 1 || t->line[0].fluid >= 0) return FLOE_OK;
    TRY(mpm_sum(t->points, &sum));
    for (int l = 0; l < t->n_lines; ++l) mass += sum.mass[t->line[l].body];
    for (int l = 0; l < t->n_lines; ++l) t->line[l].share = sum.mass[t->line[l].body] / mass;
    return FLOE_OK;
}

/* What would only be met as a step that goes bad is said at the start. */
static floe_status check_lines(const sim *s, floe_status found)
{
    const int holder = scene_enclosing_body(s->scene);
    const char *const *key = holder < 0 ? KEY("method", "interface") : KEY("bodies", s->scene->body[holder].name);
    if (found == FLOE_RETRY) return fail_under(s->ctx, FLOE_BAD_INPUT, key); /* the message stands */
    return found;
}

floe_status sealed_initialise(sim *s)
{
    TRY(share_losses(s->sealed));
    TRY(check_lines(s, sealed_find_now(s->sealed)));
    return ice_sealed_initialise(s->ice);
}

floe_status sealed_step(sim *s)
{
    sealed *t = s->sealed;
    STAGE(t, ALWAYS, sealed_find_now, READS(P_ID, P_POS, P_VEL), WRITES(NOTHING));
    TRY(ice_sealed_pressure_stages(s->ice));
    STAGE(t, ALWAYS, sealed_push_points, READS(P_POS), WRITES(NOTHING));
    TRY(mpm_step_in_substeps(s->mpm));
    STAGE(t, ALWAYS, sealed_find_next, READS(P_ID, P_POS, N_VEL_L, N_ACCEL), WRITES(NOTHING));
    return ice_sealed_flow_stages(s->ice);
}

#include "sim/sealed.h"

#include "base/memory.h"
#include "mpm/outline.h"

/* Cells see the membrane, and no other body: another may stand in the vacuum beyond it, not in a gas. */
static floe_status check_bodies(const sim *s)
{
    for (int b = 0; b < s->scene->n_bodies; ++b) {
        const scene_material *m = &s->scene->material[s->scene->body[b].material];
        if (m->kind == MATERIAL_FLUID || b == scene_holder(s->scene)) continue;
        return fail(
            s->ctx, FLOE_BAD_INPUT,
            "body '%s' stands in the gas beside a membrane that holds one, where cells do not see it; leave the "
            "outer gas out, or use mpm",
            s->scene->body[b].name);
    }
    return FLOE_OK;
}

/* Surfaces of solids leave their cells to one gas. */
static floe_status check_sharp(const sim *s)
{
    if (scene_holder(s->scene) >= 0)
        return fail(s->ctx, FLOE_BAD_INPUT,
                    "method.interface: sharp is for solids, and body '%s' is a membrane that holds a gas: leave it out",
                    s->scene->body[scene_holder(s->scene)].name);
    if (s->ice->n_materials == 1) return FLOE_OK;
    return fail(s->ctx, FLOE_BAD_INPUT,
                "method.interface: sharp takes one gas beside the solids, and the scene has %d: use smeared",
                s->ice->n_materials);
}

static floe_status check_scene(const sim *s)
{
    const bool sharp = s->scene->method.interface == INTERFACE_SHARP;
    if (s->mesh.dim != 2 || s->mesh.periodic[0] || s->mesh.periodic[1])
        return fail(
            s->ctx, FLOE_BAD_INPUT,
            "%s needs a domain in two dimensions, plane or axisymmetric, without periodic sides (use %s for others)",
            sharp ? "method.interface: sharp" : "a membrane that holds gas", sharp ? "smeared" : "mpm");
    if (sharp) return check_sharp(s);
    return s->ice->n_materials == 1 ? FLOE_OK : check_bodies(s);
}

floe_status sealed_create(sealed **out, sim *s)
{
    TRY(check_scene(s));
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    sealed *t = *out;
    *t = (sealed){.ctx = s->ctx, .stages = &s->stages, .points = s->mpm, .gases = s->ice};
    for (int k = 0; k < ICE_SEAL_PLACES; ++k) TRY(cut_create(&t->mean[k], s->ctx, &s->mesh));
    TRY(cut_create(&t->now, s->ctx, &s->mesh));
    return cut_create(&t->next, s->ctx, &s->mesh);
}

void sealed_destroy(sealed **t)
{
    if (!t || !*t) return;
    context *ctx = (*t)->ctx;
    cut_destroy(&(*t)->now);
    cut_destroy(&(*t)->next);
    for (int k = 0; k < ICE_SEAL_PLACES; ++k) cut_destroy(&(*t)->mean[k]);
    memory_free(ctx, &(*t)->velocity);
    memory_free(ctx, &(*t)->path);
    memory_free(ctx, &(*t)->force);
    memory_free(ctx, t);
}

static floe_status make_room(sealed *t, int vertices)
{
    if (vertices <= t->room) return FLOE_OK;
    TRY(memory_resize(t->ctx, &t->velocity, 2 * (size_t)vertices, sizeof(double)));
    TRY(memory_resize(t->ctx, &t->path, 2 * (size_t)vertices, sizeof(double)));
    TRY(memory_resize(t->ctx, &t->force, 2 * (size_t)vertices, sizeof(double)));
    t->room = vertices;
    return FLOE_OK;
}

/* The lines where they are: what they cut, and how fast they move. */
static floe_status sealed_find_now(sealed *t)
{
    TRY(mpm_outline(t->points, false, &t->now));
    TRY(cut_find(&t->now));
    TRY(make_room(t, t->now.n_vertices));
    mpm_outline_velocity(t->points, &t->now, t->velocity);
    for (int k = 0; k < ICE_SEAL_PLACES; ++k)
        TRY(cut_ahead(&t->now, t->velocity, (k + 0.5) / ICE_SEAL_PLACES * t->gases->dt, &t->mean[k]));
    t->gases->seal = (ice_seal){.held = t->gases->seal.held,
                                .now = &t->now,
                                .next = &t->next,
                                .mean = t->mean,
                                .n_mean = ICE_SEAL_PLACES,
                                .velocity = t->velocity,
                                .path = t->path,
                                .force = t->force};
    return FLOE_OK;
}

floe_status sealed_find_still(sealed *t)
{
    TRY(mpm_outline(t->points, false, &t->now));
    TRY(cut_find(&t->now));
    t->gases->seal = (ice_seal){.held = t->gases->seal.held, .now = &t->now, .next = &t->next};
    return FLOE_OK;
}

floe_status sealed_find_moved(sealed *t)
{
    TRY(mpm_outline(t->points, true, &t->next));
    return cut_find(&t->next);
}

static floe_status sealed_push_points(sealed *t)
{
    mpm_outline_push(t->points, &t->now, t->force);
    return FLOE_OK;
}

/* Where the points have gone, and over which way the pressure has worked. */
static floe_status sealed_find_next(sealed *t)
{
    mpm_outline_path(t->points, &t->now, t->path);
    t->gases->seal.heat = mpm_outline_lost(t->points);
    return sealed_find_moved(t);
}

/* What would only be met as a step that goes bad is said at the start. */
static floe_status check_lines(const sim *s, floe_status found)
{
    double x[2];
    if (found == FLOE_RETRY) return FLOE_BAD_INPUT; /* the message stands */
    TRY(found);
    if (s->scene->method.interface != INTERFACE_SHARP || !cut_is_thin(&s->sealed->now, x)) return FLOE_OK;
    return fail(s->ctx, FLOE_BAD_INPUT,
                "a solid is thinner than a cell at (%g, %g), where the gas of its two sides would share it: refine "
                "'domain.cell', or leave 'method.interface' out",
                x[0], x[1]);
}

floe_status sealed_initialise(sim *s)
{
    TRY(check_lines(s, sealed_find_now(s->sealed)));
    return ice_sealed_initialise(s->ice);
}

floe_status sealed_step(sim *s)
{
    sealed *t = s->sealed;
    STAGE(t, ALWAYS, sealed_find_now, READS(P_ID, P_POS, P_VEL), WRITES(NOTHING));
    TRY(ice_sealed_pressure_stages(s->ice));
    STAGE(t, ALWAYS, sealed_push_points, READS(P_POS), WRITES(NOTHING));
    TRY(mpm_step(s->mpm));
    STAGE(t, ALWAYS, sealed_find_next, READS(P_ID, P_POS, N_VEL_L, N_ACCEL), WRITES(NOTHING));
    return ice_sealed_flow_stages(s->ice);
}

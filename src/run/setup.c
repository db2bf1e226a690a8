#include "run/setup.h"

#include "base/timer.h"
#include "run/measure.h"
#include "scene/deck_location.h"

static floe_status prepare_exact(run_setup *u)
{
    const double before = wall_seconds(), cpu = cpu_seconds();
    const floe_status status = initial_exact(u->scene, &u->solution);
    u->exact_seconds = wall_seconds() - before;
    u->exact_cpu_seconds = cpu_seconds() - cpu;
    return status;
}

static bool has_kind(const scene *s, material_kind kind)
{
    for (int b = 0; b < s->n_bodies; b++)
        if (s->material[s->body[b].material].kind == kind) return true;
    return kind == MATERIAL_FLUID && s->has_ambient;
}

/* The body or material that is measured must be of the phase of the exact solution. */
static floe_status check_kind(const run_setup *u, material_kind wanted)
{
    static const char *const name[] = {[MATERIAL_SOLID] = "a solid", [MATERIAL_FLUID] = "a fluid"};
    const scene *s = u->scene;
    const scene_verify *v = &s->verify;
    const char *exact_name = u->solution.model->name;
    const int material = v->body >= 0 ? s->body[v->body].material : v->material;
    if (material >= 0 && s->material[material].kind != wanted)
        return fail_key(s->ctx, v->body >= 0 ? KEY("verify", "body") : KEY("verify", "material"),
                        "the exact solution '%s' is of %s, and '%s' is %s: name a body of %s", exact_name, name[wanted],
                        s->material[material].name, name[s->material[material].kind], name[wanted]);
    if (has_kind(s, wanted)) return FLOE_OK;
    return fail_key(s->ctx, KEY("verify", "metrics"), "the exact solution '%s' is of %s, and the scene has none",
                    exact_name, name[wanted]);
}

/* Stresses and displacements are of solids, states behind shocks of fluids. */
static floe_status check_phase(const run_setup *u)
{
    if (!u->solution.model || u->scene->verify.n_metrics == 0) return FLOE_OK;
    if (exact_is_solid(&u->solution)) return check_kind(u, MATERIAL_SOLID);
    return exact_is_fluid(&u->solution) ? check_kind(u, MATERIAL_FLUID) : FLOE_OK;
}

static floe_status set_up(run_setup *u)
{
    TRY(prepare_exact(u));
    TRY(check_phase(u));
    initial_attach(u->scene, &u->solution);
    TRY(sim_create(&u->sim, u->scene->ctx, u->scene, u->scene->coupling));
    return measure_history_check(u->sim);
}

floe_status setup_begin(run_setup *u, scene *s)
{
    *u = (run_setup){.scene = s};
    return scene_deck_location(s, set_up(u));
}

void setup_end(run_setup *u)
{
    if (!u->scene) return; /* it was not begun */
    initial_detach(u->scene);
    sim_destroy(&u->sim);
    exact_destroy(u->scene->ctx, &u->solution);
}

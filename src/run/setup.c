#include "run/setup.h"

#include "base/timer.h"
#include "run/measure.h"
#include "scene/place.h"

static floe_status prepare_exact(run_setup *u)
{
    const double before = wall_seconds();
    const floe_status status = initial_exact(u->scene, &u->solution);
    u->exact_seconds = wall_seconds() - before;
    return status;
}

/* Stresses and displacements are of solids: fluids have none to compare. */
static floe_status check_phase(const run_setup *u)
{
    const scene *s = u->scene;
    const scene_verify *v = &s->verify;
    if (!u->solution.model || !exact_is_solid(&u->solution) || v->n_metrics == 0) return FLOE_OK;
    const int material = v->body >= 0 ? s->body[v->body].material : v->material;
    if (material >= 0 && s->material[material].kind == MATERIAL_FLUID)
        return fail_key(s->ctx, v->body >= 0 ? KEY("verify", "body") : KEY("verify", "material"),
                        "the exact solution '%s' is of a solid, and '%s' is a fluid: name a body of a solid",
                        u->solution.model->name, s->material[material].name);
    for (int b = 0; b < s->n_bodies; b++)
        if (s->material[s->body[b].material].kind == MATERIAL_SOLID) return FLOE_OK;
    return fail_key(s->ctx, KEY("verify", "metrics"), "the exact solution '%s' is of a solid, and the scene has none",
                    u->solution.model->name);
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
    return scene_place(s, set_up(u));
}

void setup_end(run_setup *u)
{
    initial_detach(u->scene);
    sim_destroy(&u->sim);
    exact_destroy(u->scene->ctx, &u->solution);
}

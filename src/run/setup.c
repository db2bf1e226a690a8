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

static floe_status set_up(run_setup *u)
{
    TRY(prepare_exact(u));
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

#include "run/ready.h"

#include "run/disk_need.h"
#include "run/memory_need.h"
#include "scene/deck_location.h"
#include "scene/unsupported.h"

#include <math.h>
#include <stdio.h>

/* A fixed step beyond the limit: what it gives is wrong, if it does not end. Some above it may be what a study of stability looks at. */
static floe_status remark_fixed_step(sim *s, remark_sink *say, void *user)
{
    static const double plainly = 1.2;
    const double fixed = s->scene->time.fixed_step;
    double limit;
    const char *reason;
    char where[512], text[1024];
    if (isnan(fixed)) return FLOE_OK;
    TRY(sim_stability_limit(s, &limit, &reason));
    if (!(fixed > plainly * limit)) return FLOE_OK;
    scene_key_place(s->scene, "time.fixed_step", where, sizeof where);
    (void)snprintf(text, sizeof text,
                   "%s%g%s is %.2g times the largest step that is stable at the start (%.3g%s, limited by %s): what it "
                   "gives is wrong, if it does not diverge. Leave it out, or take %.1g%s",
                   where, fixed, scene_time_unit(s->scene), fixed / limit, limit, scene_time_unit(s->scene), reason,
                   0.5 * limit, scene_time_unit(s->scene));
    say(user, text);
    return FLOE_OK;
}

floe_status run_make_ready(scene *s, run_ready *out, remark_sink *say, void *user)
{
    run_setup setup;
    memory_need need;
    *out = (run_ready){.cells = memory_cells(&s->mesh)};
    if (out->cells > RUN_READY_CELLS) {
        if (say) scene_remarks(s, say, user);
        TRY(scene_deck_location(s, scene_refuse_unsupported(s, s->coupling)));
        TRY(scene_deck_location(s, memory_refuse(s, &need)));
        out->bytes = need.bytes;
        out->available = need.available;
        return FLOE_OK;
    }
    floe_status status = setup_begin(&setup, s);
    if (status == FLOE_OK) status = sim_predict(setup.sim, &out->step, &out->steps, &out->reason);
    if (status == FLOE_OK && say) status = remark_fixed_step(setup.sim, say, user);
    out->points = setup.sim && setup.sim->mpm ? mpm_count(setup.sim->mpm) : 0;
    out->done = status == FLOE_OK;
    if (out->done && say && setup.sim) { /* that there is one the analyser cannot see */
        scene_remarks(setup.sim->scene, say, user);
        disk_need_remark(setup.sim, ".", say, user);
    }
    setup_end(&setup);
    return status;
}

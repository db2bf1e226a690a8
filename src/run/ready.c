#include "run/ready.h"

#include "run/disk_need.h"
#include "run/fixed_step.h"
#include "run/memory_need.h"
#include "scene/deck_location.h"
#include "scene/unsupported.h"

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
    if (status == FLOE_OK && say) status = fixed_step_remark(setup.sim, say, user);
    out->points = setup.sim && setup.sim->mpm ? mpm_count(setup.sim->mpm) : 0;
    out->done = status == FLOE_OK;
    if (out->done && say && setup.sim) { /* that there is one the analyser cannot see */
        scene_remarks(setup.sim->scene, say, user);
        disk_need_remark(setup.sim, ".", say, user);
    }
    setup_end(&setup);
    return status;
}

#include "run/fixed_step.h"

#include "scene/deck_location.h"

#include <math.h>
#include <stdio.h>

floe_status fixed_step_remark(sim *s, remark_sink *say, void *user)
{
    static const double plainly = 1.2; /* some above the limit may be what a study of stability looks at */
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

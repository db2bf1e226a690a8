#include "run/checkpoints.h"

#include "base/timer.h"

#include <math.h>

run_checkpoints run_checkpoints_start(run_output *o, sim *s, double started, double cost)
{
    run_checkpoints c = {
        .output = o, .sim = s, .clock = checkpoint_clock_start(s->scene->output.checkpoint_interval, started, cost)};
    c.steps = -1;
    c.time = output_has_checkpoint(o) ? s->time : (double)NAN;
    return c;
}

void run_checkpoints_reserve(run_checkpoints *c)
{
    context *ctx = c->sim->ctx;
    if (isinf(c->clock.interval) || output_reserve_disk(c->output, c->sim) == FLOE_OK) return;
    context_log(ctx, LOG_WARNING, "there is no disk space for a checkpoint should an output fail: %s",
                context_message(ctx));
    context_clear(ctx);
}

static floe_status write_one(run_checkpoints *c, double wall)
{
    const double begun = wall_seconds();
    const floe_status status = output_checkpoint(c->output, c->sim, wall);
    c->seconds += wall_seconds() - begun;
    if (status != FLOE_OK) return status;
    c->time = c->sim->time;
    c->steps = c->sim->steps;
    c->owed = c->output->checkpoint.owed;
    return FLOE_OK;
}

floe_status run_checkpoints_write(run_checkpoints *c, double wall)
{
    if (c->steps == c->sim->steps && c->owed == c->output->checkpoint.owed) return FLOE_OK;
    const floe_status status = write_one(c, wall);
    if (status != FLOE_IO) return status;
    context_clear(c->sim->ctx);
    output_release_disk(c->output, c->sim);
    return write_one(c, wall);
}

static floe_status skip_checkpoint(run_checkpoints *c)
{
    context *ctx = c->sim->ctx;
    if (!c->failed)
        context_log(ctx, LOG_WARNING, "no checkpoint at t = %g%s: %s; the run goes on, and the earlier ones stay",
                    c->sim->time, scene_time_unit(c->sim->scene), context_message(ctx));
    context_clear(ctx);
    c->failed = true;
    return FLOE_OK;
}

/* Once snapshots have passed without theirs. */
static void say_spacing(run_checkpoints *c)
{
    const checkpoint_clock *k = &c->clock;
    if (c->told || k->passed == 0 || k->written == 0) return;
    c->told = true;
    context_log(
        c->sim->ctx, LOG_INFO,
        "checkpoints are spaced out: one takes %.3g s, and %g %% of the wall time is for them: one every %.3g s",
        k->cost, 100.0 * CHECKPOINT_CLOCK_SHARE, k->cost / CHECKPOINT_CLOCK_SHARE);
}

floe_status run_checkpoints_way(run_checkpoints *c, double wall)
{
    const double begun = wall_seconds();
    say_spacing(c);
    /* Rows that are not on the disk are a failed output. */
    TRY(output_sync(c->output));
    const floe_status status = write_one(c, wall);
    checkpoint_clock_count(&c->clock, begun, wall_seconds());
    return status == FLOE_IO || status == FLOE_NO_MEMORY ? skip_checkpoint(c) : status;
}

void run_checkpoints_say(const run_checkpoints *c)
{
    const checkpoint_clock *k = &c->clock;
    const double wall = wall_seconds() - k->started;
    context_log(c->sim->ctx, LOG_INFO, "checkpoints on the way: %ld, %.3g s, %.2g %% of the wall time", k->written,
                k->spent, wall > 0.0 ? 100.0 * k->spent / wall : 0.0);
}

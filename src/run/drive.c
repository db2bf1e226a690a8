/* The time loop of a run, and what happens at its ends. */
#include "base/stop.h"
#include "base/threads.h"
#include "base/timer.h"
#include "run/advance.h"
#include "run/checkpoints.h"
#include "run/disk_need.h"
#include "run/fixed_step.h"
#include "run/follow.h"
#include "run/log.h"
#include "run/measure.h"
#include "run/output.h"
#include "run/progress.h"
#include "run/run.h"
#include "run/schedule.h"
#include "run/setup.h"
#include "run/state_check.h"
#include "scene/deck_location.h"
#include "scene/remark.h"
#include "sim/interface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS_PER_INTERVAL = 50 };

typedef struct run {
    context *ctx;               /* not owned */
    scene *scene;               /* not owned */
    const run_options *options; /* not owned */
    run_setup setup;            /* owned */
    sim *sim;                   /* of the setup */
    run_output output;          /* owned */
    run_log log;                /* owned */
    progress progress;
    run_truth truth;
    int n_remarks;      /* warnings of before the first step */
    double started;     /* wall clock at the start of this leg, s */
    double earlier;     /* wall time of earlier legs, s */
    double measuring;   /* wall time of references and errors, which is not the run's, s */
    double putting_out; /* wall time of outputs but checkpoints, which is the run's, s */
    double cpu_started; /* processor time at the start of this leg, s */
    double cpu_beside;  /* processor time of references, errors and outputs, s */
    run_checkpoints checkpoints;
    bool checkpoint_wanted; /* at once: the earlier ones were removed */
    double made_anew;       /* time from which on the outputs are whole, s; NAN: from the start */
} run;

/* The status of a summary for which there is more than one: "done", "at_rest", "diverged", "interrupted", "failed". */
static const char *status_of_run(floe_status status, bool at_rest)
{
    switch (status) {
    case FLOE_OK: return at_rest ? "at_rest" : "done";
    case FLOE_DIVERGED:
    case FLOE_RETRY: return "diverged";
    case FLOE_INTERRUPTED: return "interrupted";
    default: return "failed";
    }
}

static double wall_spent(const run *r)
{
    return r->earlier + wall_seconds() - r->started - r->measuring;
}

/* There are new outputs from here on. A log that cannot be made ends no run. */
static void begin_anew(run *r)
{
    if (run_log_reopen(&r->log, r->output.dir) != FLOE_OK) context_clear(r->ctx);
    r->made_anew = r->sim->time;
    r->checkpoint_wanted = true;
    r->checkpoints.steps = -1;
    run_checkpoints_reserve(&r->checkpoints);
    context_log(r->ctx, LOG_WARNING,
                "the results in '%s' were removed while the run wrote them: they are those from t = %.6g%s on",
                r->output.dir, r->made_anew, scene_time_unit(r->scene));
}

static void say_where(run *r, follow_state state)
{
    if (state == FOLLOW_MOVED)
        context_log(r->ctx, LOG_WARNING, "the folder of the results was moved to '%s': the run goes on there",
                    r->output.dir);
    if (state == FOLLOW_ANEW) begin_anew(r);
}

/* Where the folder is now, before something is written there. */
static floe_status follow_folder(run *r, follow_state *state)
{
    TRY(output_follow(&r->output, r->sim, state));
    say_where(r, *state);
    return FLOE_OK;
}

/* What has failed has, because the folder went at that moment, and is to be tried again. */
static bool has_followed(run *r)
{
    char cause[CONTEXT_MESSAGE_SIZE];
    follow_state state;
    (void)snprintf(cause, sizeof cause, "%s", context_message(r->ctx));
    context_clear(r->ctx);
    floe_status status = output_follow_failure(&r->output, r->sim, cause, &state);
    if (status == FLOE_OK) say_where(r, state);
    /* What was half done there is taken up as on a resume. */
    if (status == FLOE_OK && state == FOLLOW_MOVED) status = output_reopen(&r->output, r->sim, r->output.dir);
    if (status == FLOE_OK && state == FOLLOW_MOVED) run_checkpoints_reserve(&r->checkpoints);
    if (status == FLOE_OK && state != FOLLOW_HERE) return true;
    context_clear(r->ctx);
    (void)fail(r->ctx, FLOE_IO, "%s", cause);
    return false;
}

static floe_status write_due_checkpoint(run *r)
{
    follow_state state;
    TRY(follow_folder(r, &state));
    const double cpu = cpu_seconds();
    floe_status status = run_checkpoints_write(&r->checkpoints, wall_spent(r));
    if (status == FLOE_IO && has_followed(r)) status = run_checkpoints_write(&r->checkpoints, wall_spent(r));
    r->cpu_beside += cpu_seconds() - cpu;
    return status;
}

static floe_status checkpoint_if_due(run *r)
{
    if (!r->checkpoint_wanted && !checkpoint_clock_is_due(&r->checkpoints.clock, wall_seconds())) return FLOE_OK;
    follow_state state;
    TRY(follow_folder(r, &state));
    r->checkpoint_wanted = false;
    const double cpu = cpu_seconds();
    const floe_status status = run_checkpoints_way(&r->checkpoints, wall_spent(r));
    r->cpu_beside += cpu_seconds() - cpu;
    return status;
}

/* A row or a snapshot; the time that it takes is told apart, as of short runs it is most. */
static floe_status put_out(run *r, floe_status (*write)(run_output *o, sim *s))
{
    follow_state state;
    TRY(follow_folder(r, &state));
    const double before = wall_seconds(), cpu = cpu_seconds();
    const floe_status status = write(&r->output, r->sim);
    r->putting_out += wall_seconds() - before;
    r->cpu_beside += cpu_seconds() - cpu;
    return status;
}

/* A snapshot whose page in fields.xdmf could not be written is there, and in the page by now. */
static floe_status write_missing(run *r)
{
    const run_output *o = &r->output;
    const double now = r->sim->time;
    const int64_t owed = o->checkpoint.owed;
    if ((owed & CHECKPOINT_OWED_ROW) && history_last_time(o->history) < now) TRY(put_out(r, output_row));
    if ((owed & CHECKPOINT_OWED_SNAPSHOT) && snapshot_last_time(o->snapshots) < now) TRY(put_out(r, output_snapshot));
    return FLOE_OK;
}

static floe_status write_owed(run *r)
{
    floe_status status = write_missing(r);
    if (status == FLOE_IO && has_followed(r)) status = write_missing(r);
    if (status == FLOE_OK) r->output.checkpoint.owed = 0;
    return status;
}

static double history_interval(const scene *s)
{
    return isnan(s->output.history_interval) ? s->output.interval / ROWS_PER_INTERVAL : s->output.history_interval;
}

/* The time that the next step must not pass: that of a snapshot, or the end. */
static double next_stop(const run *r)
{
    const double end = r->scene->time.end, interval = r->scene->output.interval;
    if (sim_is_static(r->sim)) return end; /* outputs are of increments */
    const double next = schedule_next(r->sim->time, interval);
    return next < end - 1e-9 * fmin(interval, end) ? next : end;
}

/* What is due at the time that a step from `before` has reached. Rows come with the first step past their time,
 * snapshots at it. */
static floe_status write_due(run *r, double before)
{
    const double now = r->sim->time, interval = r->scene->output.interval;
    const bool row = schedule_is_passed(before, now, history_interval(r->scene));
    const bool snapshot =
        sim_is_static(r->sim) ? schedule_is_passed(before, now, interval) : schedule_is_due(now, interval);
    r->output.checkpoint.owed = (row ? CHECKPOINT_OWED_ROW : 0) | (snapshot ? CHECKPOINT_OWED_SNAPSHOT : 0);
    TRY(write_owed(r));
    if (row) progress_show_ledger(&r->progress, &r->sim->ledger);
    if (snapshot) checkpoint_clock_see_snapshot(&r->checkpoints.clock);
    return FLOE_OK;
}

static bool is_out_of_time(const run *r)
{
    return r->options->max_wall > 0.0 && wall_seconds() - r->started >= r->options->max_wall;
}

/* Asked to stop: by a signal, or by the wall clock. */
static bool run_must_stop(const run *r)
{
    return context_must_stop(r->ctx) || is_out_of_time(r);
}

static floe_status call_hook(const run *r, step_hook *hook)
{
    return hook ? hook(r->options->hook_user, r->sim) : FLOE_OK;
}

static floe_status run_time_loop(run *r)
{
    while (!advance_is_finished(r->sim)) {
        const double before = r->sim->time;
        if (run_must_stop(r)) return FLOE_INTERRUPTED;
        TRY(call_hook(r, r->options->before_step));
        TRY(sim_step(r->sim, next_stop(r)));
        TRY(advance_check_rest(r->sim, before));
        TRY(write_due(r, before));
        TRY(advance_check_ledger(r->sim, &r->truth));
        TRY(call_hook(r, r->options->after_step));
        /* Last: whoever goes on from it has all of this step behind him. At the end one is written anyway. */
        if (!advance_is_finished(r->sim)) TRY(checkpoint_if_due(r));
        progress_show(&r->progress, r->sim);
    }
    return FLOE_OK;
}

static floe_status measure_run(run *r, run_summary *out)
{
    char path[OUTPUT_PATH];
    TRY(measure_errors(r->sim, &r->setup.solution, out));
    output_path(&r->output, "history.csv", path);
    TRY(measure_history(r->sim, path, out));
    output_path(&r->output, "profile.csv", path);
    return measure_profile(r->sim, &r->setup.solution, path);
}

/* The last row and snapshot, unless the time has them, the errors, and the checkpoint. */
static floe_status finish_run(run *r, run_summary *out)
{
    r->output.checkpoint.owed = CHECKPOINT_OWED_ALL;
    TRY(write_owed(r));
    TRY(write_due_checkpoint(r));
    const double before = wall_seconds(), cpu = cpu_seconds();
    const floe_status status = measure_run(r, out);
    r->measuring += wall_seconds() - before;
    r->cpu_beside += cpu_seconds() - cpu;
    return status;
}

static floe_status interrupt_run(run *r)
{
    char by[64] = "";
    const int number = r->options->stop ? *r->options->stop : 0;
    context_clear(r->ctx); /* of what a hook has said */
    TRY(write_due_checkpoint(r));
    stop_request_text(number, by);
    if (number == 0 && !is_out_of_time(r)) (void)snprintf(by, sizeof by, " by the program");
    return fail(r->ctx, FLOE_INTERRUPTED,
                "%s at t = %.6g%s after %ld steps%s; a checkpoint was written: go on with --resume",
                by[0] ? "stopped" : "the limit of wall time was reached", r->sim->time, scene_time_unit(r->sim->scene),
                r->sim->steps, by);
}

/* The state is that of the last good step; if even that is no good, an earlier checkpoint stays. */
static floe_status end_diverged_run(run *r)
{
    char cause[CONTEXT_MESSAGE_SIZE], growth[SIM_GROWTH_TEXT];
    (void)snprintf(cause, sizeof cause, "%.1200s", context_message(r->ctx));
    context_clear(r->ctx);
    const bool good = state_is_finite(r->sim), grown = sim_has_grown(r->sim);
    if (good) TRY(write_due_checkpoint(r));
    /* What was on its way to be ended for its energy has that as its cause, whatever came first. */
    sim_describe_growth(r->sim, growth);
    const bool grew = !grown && r->sim->ledger.motion.beyond > 0.0;
    return fail(r->ctx, FLOE_DIVERGED, "%s%s%s; %s", cause, grew ? "; before, " : "", grew ? growth : "",
                grown                               ? "the state as it is now is in checkpoint.h5"
                : good                              ? "the last good state is in checkpoint.h5"
                : output_has_checkpoint(&r->output) ? "checkpoint.h5 holds an earlier state"
                                                    : "there is no checkpoint");
}

/* An output failed. The state is sound: it goes into a checkpoint, with what is owed. */
static floe_status rescue_state(run *r)
{
    char cause[CONTEXT_MESSAGE_SIZE], saved[128];
    const char *unit = scene_time_unit(r->sim->scene);
    (void)snprintf(cause, sizeof cause, "%.1200s", context_message(r->ctx));
    context_clear(r->ctx);
    const bool written = state_is_finite(r->sim) && write_due_checkpoint(r) == FLOE_OK;
    context_clear(r->ctx);
    if (!output_has_checkpoint(&r->output)) r->checkpoints.time = NAN;
    (void)snprintf(saved, sizeof saved,
                   isnan(r->checkpoints.time) ? "there is no checkpoint"
                   : written ? "a checkpoint of t = %.6g%s was written: once that is mended, go on with --resume"
                             : "the last checkpoint is of t = %.6g%s: once that is mended, go on with --resume",
                   r->checkpoints.time, unit);
    return fail(r->ctx, FLOE_IO, "%s; %s", cause, saved);
}

static floe_status begin_run(run *r)
{
    const run_options *o = r->options;
    TRY(scene_deck_location(r->scene, memory_refuse(r->scene, NULL)));
    TRY(setup_begin(&r->setup, r->scene));
    r->sim = r->setup.sim;
    r->measuring += r->setup.exact_seconds;
    r->cpu_beside += r->setup.exact_cpu_seconds;
    const double before = wall_seconds(), cpu = cpu_seconds();
    TRY(o->resume ? output_resume(&r->output, r->sim, o->dir) : output_begin(&r->output, r->sim, o->dir));
    r->putting_out += wall_seconds() - before;
    r->cpu_beside += cpu_seconds() - cpu;
    r->earlier = r->output.checkpoint.wall_seconds;
    r->checkpoints = run_checkpoints_start(&r->output, r->sim, r->started, r->putting_out);
    truth_begin(&r->truth, r->sim);
    progress_begin(&r->progress, o->progress, o->label, r->sim);
    return run_log_open(&r->log, r->ctx, o, &r->progress);
}

/* A remark: said once, and kept in the summary of every leg. */
typedef struct remarks {
    const run *run;
    run_summary *summary;
} remarks;

static void take_remark(void *user, const char *text)
{
    const remarks *m = user;
    summary_add_warning(m->summary, text);
    if (!m->run->options->resume) context_log(m->run->ctx, LOG_WARNING, "%s", text);
}

static floe_status say_start(run *r, run_summary *out)
{
    const int threads = (int)out->threads;
    const sim *s = r->sim;
    remarks into = {r, out};
    if (s->mpm) context_log(r->ctx, LOG_INFO, "solver %s", s->solver_reason);
    if (interface_in_words(s)[0]) context_log(r->ctx, LOG_INFO, "interface %s", interface_in_words(s));
    if (s->substeps_reason[0]) context_log(r->ctx, LOG_INFO, "sub-steps %s", s->substeps_reason);
    context_log(r->ctx, LOG_INFO, "%s %s as %s: %zu points, %zu cells, %d thread%s, from t = %.6g%s",
                r->options->resume ? "resume" : "start", r->scene->path, coupling_name(s->coupling),
                s->mpm ? mpm_count(s->mpm) : 0, s->ice ? mesh_cells(&s->mesh) : 0, threads, threads == 1 ? "" : "s",
                s->time, scene_time_unit(s->scene));
    if (r->output.note[0]) context_log(r->ctx, LOG_WARNING, "%s", r->output.note);
    scene_remarks(s->scene, take_remark, &into);
    if (!r->options->resume) disk_need_remark(s, r->options->dir, take_remark, &into);
    if (!r->options->resume) TRY(fixed_step_remark(r->sim, take_remark, &into));
    r->n_remarks = out->n_warnings;
    return FLOE_OK;
}

/* What could not be written of the time of the checkpoint, and what comes after it in a step. */
static floe_status catch_up(run *r)
{
    if (r->output.checkpoint.owed == 0) return FLOE_OK;
    TRY(write_owed(r));
    return r->sim->steps > 0 ? advance_check_ledger(r->sim, &r->truth) : FLOE_OK;
}

static floe_status start_outputs(run *r)
{
    if (r->options->resume) return catch_up(r);
    r->output.checkpoint.owed = CHECKPOINT_OWED_ALL;
    TRY(write_owed(r));
    /* A snapshot is much of what a checkpoint is. */
    r->checkpoints.clock.cost = r->putting_out;
    return FLOE_OK;
}

static floe_status carry_out_run(run *r, run_summary *out)
{
    floe_status status = start_outputs(r);
    context_watch(r->ctx, r->options->stop);
    if (status == FLOE_OK) status = run_time_loop(r);
    context_watch(r->ctx, NULL);
    if (status == FLOE_OK)
        status = finish_run(r, out);
    else if (status == FLOE_INTERRUPTED)
        status = interrupt_run(r);
    else if (status == FLOE_DIVERGED)
        status = end_diverged_run(r);
    return status == FLOE_IO ? rescue_state(r) : status;
}

/* What is measured of the history is of what there is of it. */
static void note_loss(const run *r, run_summary *out)
{
    char text[160];
    if (isnan(r->made_anew)) return;
    (void)snprintf(text, sizeof text,
                   "the results were removed while the run wrote them: the history is that from t = %.6g%s on",
                   r->made_anew, scene_time_unit(r->scene));
    summary_add_warning(out, text);
}

static floe_status write_summary(run *r, run_summary *out, const char *status)
{
    char path[OUTPUT_PATH];
    follow_state state;
    /* What has already gone wrong was followed as it did. */
    if (context_message(r->ctx)[0] == '\0') TRY(follow_folder(r, &state));
    out->n_counters = 0;
    out->n_warnings = r->n_remarks;
    note_loss(r, out);
    truth_summarise(r->sim, out);
    out->wall_seconds = wall_spent(r);
    out->output_seconds = r->putting_out + r->checkpoints.seconds;
    out->cpu_seconds = cpu_seconds() - r->cpu_started - r->cpu_beside;
    out->peak_rss_bytes = peak_rss_bytes();
    (void)snprintf(out->status, sizeof out->status, "%s", status);
    TRY(summary_set_sim(out, r->sim));
    output_path(&r->output, "summary.json", path);
    return summary_write(r->ctx, path, out);
}

/* Why the run is not done, for those who only see its folder. */
static void note_cause(const run *r, run_summary *out, floe_status status)
{
    const char *message = status == FLOE_OK ? "" : context_message(r->ctx);
    (void)snprintf(out->message, sizeof out->message, "%.*s", (int)sizeof out->message - 1, message);
}

static floe_status run_with_outputs(run *r, run_summary *out)
{
    TRY(say_start(r, out));
    TRY(write_summary(r, out, "running"));
    run_checkpoints_reserve(&r->checkpoints);
    const floe_status status = scene_deck_location(r->scene, carry_out_run(r, out));
    progress_clear(&r->progress);
    const char *name = status_of_run(status, r->sim->at_rest);
    /* After the checkpoint, which a look at the account must not change. */
    if (status != FLOE_OK) (void)sim_update_ledger(r->sim);
    run_checkpoints_say(&r->checkpoints);
    truth_log(&r->truth, r->sim);
    note_cause(r, out, status);
    disk_reserve_release(&r->output.reserve); /* for the summary */
    const floe_status written = write_summary(r, out, name);
    /* What went wrong is for the caller to show: here it is only noted. */
    for (int i = r->n_remarks; i < out->n_warnings && status != FLOE_DIVERGED; i++)
        context_log(r->ctx, LOG_WARNING, "%s", out->warnings[i]);
    context_log(r->ctx, LOG_INFO, "%s at t = %.6g%s after %ld steps%s%s%s%s", name, r->sim->time,
                scene_time_unit(r->sim->scene), r->sim->steps, out->notes[0] ? "; " : "", out->notes,
                status == FLOE_OK ? "" : ": ", out->message);
    return status != FLOE_OK ? status : written;
}

static void end_run(run *r)
{
    run_log_close(&r->log);
    output_end(&r->output);
    setup_end(&r->setup);
}

floe_status run_scene(context *ctx, scene *s, const run_options *options, run_summary *out)
{
    run r = {.ctx = ctx,
             .scene = s,
             .options = options,
             .made_anew = NAN,
             .started = wall_seconds(),
             .cpu_started = cpu_seconds()};
    *out = (run_summary){0};
    (void)snprintf(out->deck, sizeof out->deck, "%s", s->path);
    (void)snprintf(out->coupling, sizeof out->coupling, "%s", coupling_name(s->coupling));
    summary_set_build(out);
    /* Memory for each thread is made with the simulation. */
    (void)threads_use(options->threads > 0 ? options->threads : s->threads);
    floe_status status = begin_run(&r);
    if (status == FLOE_OK) {
        out->threads = advance_choose_threads(r.sim, options->threads);
        status = run_with_outputs(&r, out);
    } else {
        (void)snprintf(out->status, sizeof out->status, "%s", status_of_run(status, false));
        note_cause(&r, out, status);
    }
    end_run(&r);
    return status;
}

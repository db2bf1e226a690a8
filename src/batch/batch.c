#include "batch/batch_internal.h"

#include "base/memory.h"
#include "base/stop.h"
#include "base/timer.h"
#include "io/file.h"
#include "io/lock.h"

#include <math.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* A case of which no deck can be made is a result: it has ended before it began. */
static floe_status prepare_case(batch *b, batch_case *one)
{
    one->state = BATCH_WAITING;
    one->other_cores = one->process_seconds = NAN;
    one->kept = one->ran = one->timed_out = one->alone = one->resumed = one->start_over = false;
    if (!one->hash[0]) {
        const floe_status status = batch_prepare(b->ctx, b->o, one, NULL);
        if (status == FLOE_BAD_INPUT) {
            one->state = BATCH_ENDED;
            one->status = status;
            (void)snprintf(one->message, sizeof one->message, "%.500s", context_message(b->ctx));
            context_clear(b->ctx);
            batch_progress_report(b, one);
            return FLOE_OK;
        }
        TRY(status);
    }
    if (b->o->keep_finished) batch_case_keep(b, one);
    return FLOE_OK;
}

/* The next case: the first, or, with several at a time, the most expensive one, so that none is left running alone at
 * the end. b->n: none is waiting. */
static size_t next_case(const batch *b)
{
    size_t best = b->n;
    for (size_t i = 0; i < b->n; i++) {
        if (b->list[i].state != BATCH_WAITING) continue;
        if (best == b->n || b->list[i].weight > b->list[best].weight) best = i;
        if (b->n_jobs == 1) return best;
    }
    return best;
}

static bool batch_must_stop(const batch *b)
{
    return b->o->stop && *b->o->stop;
}

static floe_status start_some(batch *b)
{
    for (size_t i = next_case(b); b->running < b->n_jobs && i < b->n && !batch_must_stop(b); i = next_case(b))
        TRY(batch_process_start(b, i));
    return FLOE_OK;
}

static floe_status collect_ended(batch *b)
{
    for (int k = 0; k < b->n_jobs; k++) {
        int wait_status;
        if (b->job[k].pid == 0 || waitpid(b->job[k].pid, &wait_status, WNOHANG) != b->job[k].pid) continue;
        TRY(batch_case_collect(b, &b->job[k], wait_status));
    }
    return FLOE_OK;
}

/* A run stops by itself once its time is up; one that hangs is ended. */
static void end_hanging(batch *b)
{
    const double most = 1.5 * b->o->max_wall + 30.0; /* s */
    if (!(b->o->max_wall > 0.0)) return;
    for (int k = 0; k < b->n_jobs; k++) {
        if (b->job[k].pid != 0 && !b->job[k].killed && wall_seconds() - b->job[k].started > most)
            batch_process_kill(&b->job[k]);
    }
}

static void stop_all(const batch *b)
{
    for (int k = 0; k < b->n_jobs; k++) {
        if (b->job[k].pid != 0) batch_process_stop(&b->job[k]);
    }
}

static void pause_a_little(void)
{
    nanosleep(&(struct timespec){0, 10 * 1000 * 1000}, NULL);
}

static floe_status work_off_cases(batch *b)
{
    do {
        TRY(start_some(b));
        TRY(collect_ended(b));
        end_hanging(b);
        batch_progress_show(b);
        if (b->running > 0) pause_a_little();
    } while (!batch_must_stop(b) && (b->running > 0 || next_case(b) < b->n));
    return FLOE_OK;
}

/* The runs that are left are asked to stop and waited for; what they come to still counts. */
static floe_status wind_up(batch *b)
{
    floe_status first = FLOE_OK;
    stop_all(b);
    while (b->running > 0) {
        const floe_status status = collect_ended(b);
        if (first == FLOE_OK) first = status;
        if (b->running > 0) pause_a_little();
    }
    live_line_clear(&b->line);
    return first;
}

/* Of what goes wrong, the first is told. */
static floe_status work_and_wind_up(batch *b)
{
    char first[CONTEXT_MESSAGE_SIZE];
    const floe_status status = work_off_cases(b);
    (void)snprintf(first, sizeof first, "%s", context_message(b->ctx));
    context_clear(b->ctx);
    const floe_status end = wind_up(b);
    if (status == FLOE_OK) return end;
    context_clear(b->ctx);
    return fail(b->ctx, status, "%s", first);
}

static void say_kept(batch *b)
{
    size_t kept = 0, waiting = 0;
    for (size_t i = 0; i < b->n; i++) {
        kept += b->list[i].kept;
        waiting += b->list[i].state == BATCH_WAITING;
    }
    if (kept > 0 && b->o->progress) {
        (void)fprintf(b->o->progress, "%zu of %zu cases have ended before and are kept, %zu to run\n", kept, b->n,
                      waiting);
    }
}

static floe_status run_all_cases(batch *b)
{
    batch_progress_begin(b);
    for (size_t i = 0; i < b->n; i++) TRY(prepare_case(b, &b->list[i]));
    say_kept(b);
    b->started = wall_seconds();
    TRY(work_and_wind_up(b));
    if (next_case(b) == b->n) return FLOE_OK;
    char by[64] = "";
    if (batch_must_stop(b)) stop_request_text(*b->o->stop, by);
    return fail(b->ctx, FLOE_INTERRUPTED,
                "stopped%s; what has ended is kept in '%s': the same command goes on from there", by, b->o->dir);
}

floe_status batch_recall(context *ctx, const batch_options *o, batch_case *list, size_t n)
{
    batch b = {.ctx = ctx, .o = o, .list = list, .n = n};
    for (size_t i = 0; i < n; i++) TRY(prepare_case(&b, &list[i]));
    return FLOE_OK;
}

floe_status batch_run(context *ctx, const batch_options *o, batch_case *list, size_t n)
{
    batch b = {.ctx = ctx, .o = o, .list = list, .n = n, .n_jobs = o->jobs > 0 ? o->jobs : 1};
    folder_lock lock;
    TRY(folder_make(ctx, o->dir));
    TRY(folder_lock_take(&lock, ctx, o->dir));
    floe_status status = memory_new(ctx, &b.job, (size_t)b.n_jobs, sizeof *b.job);
    if (status == FLOE_OK) status = run_all_cases(&b);
    memory_free(ctx, &b.job);
    folder_lock_release(&lock);
    return status;
}

void batch_find_program(char path[BATCH_PATH], const char *name)
{
    const ssize_t length = readlink("/proc/self/exe", path, BATCH_PATH - 1);
    path[length > 0 ? length : 0] = '\0';
    if (length <= 0) (void)snprintf(path, BATCH_PATH, "%s", name);
}

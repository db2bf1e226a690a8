/* Where a batch stands: one bar on a terminal, a plain line now and then elsewhere, and a line for each case that
 * ends. */
#include "batch/batch_internal.h"

#include "base/ordinary.h"
#include "base/timer.h"
#include "run/run_errors.h"

#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void batch_progress_begin(batch *b)
{
    live_line_begin(&b->line, b->o->progress, 0.5, 30.0);
}

/* The time (s) in the last whole row of a history; NAN if there is none yet. */
static double last_history_time(const char *path)
{
    char text[16384];
    const char *special;
    const int file = ordinary_open(path, O_RDONLY, &special);
    if (file < 0) return NAN;
    const off_t length = lseek(file, 0, SEEK_END);
    const off_t from = length > (off_t)sizeof text - 1 ? length - (off_t)sizeof text + 1 : 0;
    const ssize_t got = pread(file, text, sizeof text - 1, from);
    (void)close(file);
    if (got <= 0) return NAN;
    text[got] = '\0';
    char *end = strrchr(text, '\n');
    if (!end) return NAN;
    *end = '\0';
    char *row = strrchr(text, '\n'), *number_end;
    if (!row) return NAN;
    const double time = strtod(row + 1, &number_end);
    return number_end == row + 1 ? (double)NAN : time;
}

static double job_fraction_done(const batch *b, const batch_job *j)
{
    const batch_case *one = &b->list[j->index];
    char path[BATCH_PATH];
    batch_path(b->o, one, "history.csv", path);
    const double share = last_history_time(path) / one->end;
    return share > 0.0 ? fmin(share, 1.0) : 0.0;
}

static double case_cost(const batch_case *one)
{
    return one->weight > 0.0 ? one->weight : 1.0;
}

typedef struct tally {
    size_t ended, failed;
    double all, kept, done; /* weights: done counts the running ones' shares, not the kept ones */
} tally;

static tally count_cases(const batch *b)
{
    tally t = {0};
    for (size_t i = 0; i < b->n; i++) {
        const batch_case *one = &b->list[i];
        const double weight = case_cost(one);
        t.all += weight;
        if (one->state != BATCH_ENDED) continue;
        t.ended++;
        t.failed += one->status != FLOE_OK;
        *(one->kept ? &t.kept : &t.done) += weight;
    }
    for (int k = 0; k < b->n_jobs; k++) {
        if (b->job[k].pid != 0) t.done += case_cost(&b->list[b->job[k].index]) * job_fraction_done(b, &b->job[k]);
    }
    return t;
}

void batch_progress_show(batch *b)
{
    char text[LIVE_LINE_SIZE], bar[LIVE_LINE_BAR] = "", left[LIVE_LINE_DURATION], failed[48] = "";
    if (!live_line_is_due(&b->line)) return;
    const tally t = count_cases(b);
    const double share = (t.kept + t.done) / t.all;
    live_line_duration((wall_seconds() - b->started) * (t.all - t.kept - t.done) / t.done, left);
    if (b->line.live) live_line_bar(share, bar);
    if (t.failed > 0) (void)snprintf(failed, sizeof failed, ", %zu failed", t.failed);
    (void)snprintf(text, sizeof text, "%s%3.0f %%  %zu of %zu cases done%s, %d running  ETA %s", bar, 100.0 * share,
                   t.ended, b->n, failed, b->running, left);
    live_line_show(&b->line, text);
}

void batch_progress_report(batch *b, const batch_case *one)
{
    char error[ERROR_TEXT];
    size_t ended = 0;
    if (!b->o->progress) return;
    live_line_clear(&b->line);
    for (size_t i = 0; i < b->n; i++) ended += b->list[i].state == BATCH_ENDED;
    (void)fprintf(b->o->progress, "[%zu/%zu] %s: %s", ended, b->n, one->label, batch_status_name(one));
    if (one->kept) (void)fprintf(b->o->progress, " before");
    if (one->ran) (void)fprintf(b->o->progress, ", %lld steps, %.3g s", one->summary.steps, one->summary.wall_seconds);
    if (one->ran && one->summary.n_errors > 0) {
        error_text(one->summary.errors[0].name, one->summary.errors[0].value, one->summary.dimensionless, error);
        (void)fprintf(b->o->progress, ", %s %s", one->summary.errors[0].name, error);
    }
    if (one->ran && one->summary.n_warnings > 0) (void)fprintf(b->o->progress, ", warned");
    (void)fprintf(b->o->progress, "%s%s\n", one->message[0] ? ": " : "", one->message);
    (void)fflush(b->o->progress);
}

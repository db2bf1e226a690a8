/* Times that can be compared, without those of outputs, which depend on the disk: each case alone, on one thread, more
 * than once; the fastest counts, as what disturbs a run can only slow it down. A short case is run until there is
 * something to measure. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "batch/machine_load.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Others that use a tenth of a core disturb, if it is more than the grain of the system's clock (s). */
static const double most_of_others = 0.1, grain = 0.05;
/* s of processor time: a case of less than `brief` is run until `enough` are spent. */
static const double brief = 0.05, enough = 0.5;
/* What a time may be off that was taken once, and one that others have disturbed. */
static const double scatter_of_one = 0.1, scatter_of_disturbed = 0.3;

static bool is_disturbed(const batch_case *run)
{
    return run->other_cores > most_of_others && run->other_cores * summary_run_seconds(&run->summary) > grain;
}

/* How often a case is timed. */
static int repeats_of(const study *s, size_t i)
{
    const batch_case *run = &s->run[i];
    const double cpu = run->summary.cpu_seconds, spent = fmax(run->process_seconds, cpu);
    if (s->plan.repeat == 0 || !(cpu < brief) || !(spent > 0.0)) return s->plan.repeat;
    const double wanted = fmin(ceil(enough / spent), STUDY_MAX_REPEAT);
    return wanted > s->plan.repeat ? (int)wanted : s->plan.repeat;
}

static int most_repeats(const study *s)
{
    int most = 0;
    for (size_t i = 0; i < s->n; i++) {
        const int repeats = study_is_done(&s->list[i]) ? repeats_of(s, i) : 0;
        most = repeats > most ? repeats : most;
    }
    return most;
}

/* The runs that are still to be made: the first one of a case may have been alone already. */
static size_t list_runs(const study *s, batch_case *list, size_t *index)
{
    size_t n = 0;
    const int most = most_repeats(s);
    for (int k = 0; k < most; k++) {
        for (size_t i = 0; i < s->n; i++) {
            const batch_case *of = &s->run[i];
            if (!study_is_done(&s->list[i]) || k >= repeats_of(s, i) || (k == 0 && of->alone)) continue;
            if (list) {
                batch_case *one = &list[n];
                *one = (batch_case){.set = of->set, .n_set = of->n_set, .end = of->end};
                one->weight = of->summary.wall_seconds;
                memcpy(one->hash, of->hash, sizeof one->hash);
                (void)snprintf(one->label, sizeof one->label, "time %d of %d: %.120s", k + 1, repeats_of(s, i),
                               of->label);
                (void)snprintf(one->folder, sizeof one->folder, "%.240s-%d", of->folder, k + 1);
                index[n] = i;
            }
            n++;
        }
    }
    return n;
}

static bool is_same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* A run that is made again has the same bits. */
static bool is_same_result(const run_summary *a, const run_summary *b)
{
    bool same = a->steps == b->steps && a->time == b->time && a->n_errors == b->n_errors;
    for (int k = 0; k < a->n_errors && same; k++) same = is_same_number(a->errors[k].value, b->errors[k].value);
    return same;
}

static void note_time(study_case *one, const batch_case *run)
{
    study_timing *t = &one->timing;
    if (t->n == STUDY_MAX_REPEAT) return;
    const double seconds = summary_run_seconds(&run->summary);
    t->seconds[t->n] = seconds;
    t->others[t->n] = run->other_cores;
    t->cpu[t->n] = run->summary.cpu_seconds;
    t->differs = t->differs || !is_same_result(&run->summary, &one->run->summary);
    if (t->n == 0 || seconds < t->best) {
        t->best = seconds;
        t->wall = run->summary.wall_seconds;
        t->disturbed = is_disturbed(run);
    }
    /* One run may be shorter than the grain of the system's clock; all of them together are not. */
    if (isfinite(run->other_cores)) {
        t->during += run->summary.wall_seconds;
        t->taken += run->other_cores * run->summary.wall_seconds;
    }
    if (t->n == 0 || t->cpu[t->n] < t->least) t->least = t->cpu[t->n];
    t->n++;
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void note_scatter(study_case *one)
{
    study_timing *t = &one->timing;
    double sorted[STUDY_MAX_REPEAT];
    memcpy(sorted, t->cpu, sizeof sorted);
    qsort(sorted, (size_t)t->n, sizeof *sorted, compare_numbers);
    t->scatter = t->n > 1 ? sorted[t->n / 2] / t->least - 1.0 : scatter_of_one;
    t->disturbed = t->disturbed || (t->taken > grain && t->taken > most_of_others * t->during);
    if (t->disturbed || (t->n == 0 && !one->run->alone)) t->scatter = fmax(t->scatter, scatter_of_disturbed);
}

static floe_status run_timed(study *s, batch_case *list, size_t *index, size_t n)
{
    char dir[BATCH_PATH];
    batch_options o = study_batch_options(s);
    (void)snprintf(dir, sizeof dir, "%s/timing", o.dir);
    o.dir = dir;
    o.jobs = o.threads = 1;
    o.thin = true;
    (void)list_runs(s, list, index);
    if (o.progress) (void)fprintf(o.progress, "%zu timed runs, one at a time on one thread\n", n);
    const floe_status status = batch_run(s->ctx, &o, list, n);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    for (size_t k = 0; k < n; k++) {
        if (list[k].state != BATCH_ENDED) continue;
        if (list[k].status == FLOE_OK)
            note_time(&s->list[index[k]], &list[k]);
        else
            context_log(s->ctx, LOG_WARNING, "a timed run of %s does not count: %s", list[k].label, list[k].message);
    }
    for (size_t i = 0; i < s->n; i++) {
        if (study_is_done(&s->list[i])) note_scatter(&s->list[i]);
    }
    return status;
}

floe_status study_time(study *s)
{
    batch_case *list;
    size_t *index;
    const size_t n = list_runs(s, NULL, NULL);
    if (n == 0) return FLOE_OK;
    TRY(memory_new(s->ctx, &list, n, sizeof *list));
    floe_status status = memory_new(s->ctx, &index, n, sizeof *index);
    if (status == FLOE_OK) status = run_timed(s, list, index, n);
    memory_free(s->ctx, &index);
    memory_free(s->ctx, &list);
    return status;
}

void study_take_times(study *s)
{
    for (size_t i = 0; i < s->n; i++) {
        study_case *one = &s->list[i];
        one->timing =
            (study_timing){.best = study_is_done(one) ? summary_run_seconds(&one->run->summary) : (double)NAN};
        if (!study_is_done(one)) continue;
        one->timing.least = one->run->summary.cpu_seconds;
        one->timing.disturbed = one->run->alone && is_disturbed(one->run);
        if (s->plan.repeat > 0 && one->run->alone) note_time(one, one->run);
        note_scatter(one);
    }
}

bool study_is_disturbed(const study *s)
{
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].timing.disturbed) return true;
    }
    return false;
}

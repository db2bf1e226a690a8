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

/* Adds a timed run, the k-th of a case. */
static void add_timed(const study *s, size_t i, int k, study_timed *timed)
{
    const batch_case *of = &s->run[i];
    batch_case *one = &timed->list[timed->n];
    *one = (batch_case){.set = of->set, .n_set = of->n_set, .end = of->end};
    one->weight = of->summary.wall_seconds;
    memcpy(one->hash, of->hash, sizeof one->hash);
    (void)snprintf(one->label, sizeof one->label, "time %d of %d: %.120s", k + 1, repeats_of(s, i), of->label);
    (void)snprintf(one->folder, sizeof one->folder, "%.240s-%d", of->folder, k + 1);
    timed->index[timed->n++] = i;
}

floe_status study_list_timed(study *s, study_timed *timed, case_round *round)
{
    const int most = most_repeats(s);
    if (most == 0) return FLOE_OK;
    TRY(memory_new(s->ctx, &timed->list, s->n * (size_t)most, sizeof *timed->list));
    TRY(memory_new(s->ctx, &timed->index, s->n * (size_t)most, sizeof *timed->index));
    for (int k = 0; k < most; k++) {
        for (size_t i = 0; i < s->n; i++) {
            /* The first run of a case may have been alone already. */
            const bool known = k == 0 && s->run[i].alone;
            if (study_is_done(&s->list[i]) && k < repeats_of(s, i) && !known) add_timed(s, i, k, timed);
        }
    }
    (void)snprintf(timed->dir, sizeof timed->dir, "%s/timing", round->batch.dir);
    round->batch.dir = timed->dir;
    round->batch.jobs = round->batch.threads = 1;
    round->batch.thin = true;
    round->list = timed->list;
    round->n = timed->n;
    if (timed->n > 0 && round->batch.progress)
        (void)fprintf(round->batch.progress, "%zu timed runs, one at a time on one thread\n", timed->n);
    return FLOE_OK;
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

void study_take_timed(study *s, const study_timed *timed)
{
    for (size_t k = 0; k < timed->n; k++) {
        const batch_case *run = &timed->list[k];
        if (run->state != BATCH_ENDED) continue;
        if (run->status == FLOE_OK)
            note_time(&s->list[timed->index[k]], run);
        else
            context_log(s->ctx, LOG_WARNING, "a timed run of %s does not count: %s", run->label, run->message);
    }
    for (size_t i = 0; i < s->n; i++) {
        if (study_is_done(&s->list[i])) note_scatter(&s->list[i]);
    }
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

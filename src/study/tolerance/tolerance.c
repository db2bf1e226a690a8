#include "study/tolerance/tolerance.h"

#include "base/memory.h"
#include "io/file.h"
#include "io/lock.h"
#include "run/run_errors.h"
#include "study/tolerance/tolerance_parts.h"

#include <math.h>
#include <string.h>

/* ---- what to measure by ---- */

static int find_quantity(const study *s, const char *name)
{
    for (int q = 0; q < s->plan.n_quantities; q++) {
        if (strcmp(s->plan.quantity[q], name) == 0) return q;
    }
    return -1;
}

static bool has_metric(const scene *of, const char *name)
{
    for (int k = 0; k < of->verify.n_metrics; k++) {
        if (strcmp(of->verify.metric[k], name) == 0) return true;
    }
    return false;
}

static const char *default_metric(const tolerance *t, const scene *of)
{
    for (int k = 0; k < of->verify.n_metrics; k++) {
        if (error_is_relative(of->verify.metric[k])) return of->verify.metric[k];
    }
    if (of->verify.n_metrics > 0) return of->verify.metric[0];
    return t->study->plan.n_quantities > 0 ? t->study->plan.quantity[0] : NULL;
}

static floe_status refuse_metric(const tolerance *t, const scene *of, const char *wanted)
{
    strbuf names;
    strbuf_init(&names, t->ctx);
    for (int k = 0; k < of->verify.n_metrics; k++) strbuf_append(&names, " %s", of->verify.metric[k]);
    for (int q = 0; q < t->study->plan.n_quantities; q++) strbuf_append(&names, " %s", t->study->plan.quantity[q]);
    const floe_status status =
        fail(t->ctx, FLOE_BAD_INPUT,
             "--metric %s: that is neither an error of verify.metrics nor one of study.quantities, which are:%s",
             wanted, names.length > 0 ? strbuf_string(&names) : " none");
    strbuf_free(&names);
    return status;
}

static floe_status choose_metric(tolerance *t, const scene *of)
{
    const char *wanted = t->options->metric ? t->options->metric : default_metric(t, of);
    if (!wanted)
        return fail(
            t->ctx, FLOE_BAD_INPUT,
            "nothing to measure an error by: give the deck an exact solution (verify.exact and verify.metrics), or "
            "columns of history.csv whose limit is to be found, as in `study: {quantities: [strain]}`");
    t->quantity = has_metric(of, wanted) ? -1 : find_quantity(t->study, wanted);
    if (t->quantity < 0 && !has_metric(of, wanted)) return refuse_metric(t, of, wanted);
    (void)snprintf(t->metric, sizeof t->metric, "%s", wanted);
    return FLOE_OK;
}

/* The deck by itself: it must have a study. Metrics are the deck's, not a case's. */
static floe_status look_at_deck(tolerance *t)
{
    const batch_options batch = study_batch_options(t->study);
    scene *of;
    TRY(judge_base_scene(t->ctx, &batch, &t->study_options.set, &of));
    floe_status status = FLOE_OK;
    if (of->batches->study.n_axes == 0)
        status = fail(
            t->ctx, FLOE_BAD_INPUT,
            "--tolerance chooses among the cases of the deck's study, and this deck has none: add what may vary, as in "
            "`study: {axes: {domain.cell: [0.1, 0.05, 0.025], method.basis: [linear, quadratic]}}`, or give it "
            "by --set study.axes=...");
    if (status == FLOE_OK) status = study_make_plan(t->study);
    if (status == FLOE_OK && t->study->over < 0)
        status = fail(t->ctx, FLOE_BAD_INPUT,
                      "--tolerance needs spacings to refine: no axis of the study has numbers (domain.cell, or that "
                      "which study.over names)");
    if (status == FLOE_OK) status = choose_metric(t, of);
    scene_destroy(&of);
    return status;
}

/* ---- curves ---- */

/* The cases of a group, from the coarsest to the finest, behind `at`; returns how many. */
static size_t list_group(tolerance *t, size_t group, size_t at)
{
    const study *s = t->study;
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].group != group) continue;
        size_t k = at + n++;
        for (; k > at && s->list[t->index[k - 1]].over < s->list[i].over; k--) t->index[k] = t->index[k - 1];
        t->index[k] = i;
    }
    return n;
}

static floe_status make_tolerance_curves(tolerance *t)
{
    const study *s = t->study;
    TRY(memory_new(t->ctx, &t->curve, s->n_groups, sizeof *t->curve));
    TRY(memory_new(t->ctx, &t->list, s->n, sizeof *t->list));
    TRY(memory_new(t->ctx, &t->index, s->n, sizeof *t->index));
    for (size_t g = 0, at = 0; g < s->n_groups; at += t->curve[g++].n)
        t->curve[g] = (choose_curve){.list = t->list + at, .n = list_group(t, g, at)};
    for (size_t k = 0; k < s->n; k++) {
        const study_case *one = &s->list[t->index[k]];
        t->list[k] = (choose_case){.h = one->over, .weight = one->run->weight, .error = NAN};
    }
    return FLOE_OK;
}

const study_case *tolerance_case(const tolerance *t, size_t curve, size_t at)
{
    return &t->study->list[t->index[(size_t)(t->curve[curve].list - t->list) + at]];
}

/* The values of the quantity at the cases of a curve that are done; `up_to` is the last one looked at. */
static size_t values_of(const tolerance *t, size_t curve, size_t up_to, double *h, double *f)
{
    size_t n = 0;
    for (size_t k = 0; k <= up_to; k++) {
        const study_case *one = tolerance_case(t, curve, k);
        if (!study_is_done(one) || !isfinite(one->quantity[t->quantity])) continue;
        h[n] = one->over;
        f[n++] = one->quantity[t->quantity];
    }
    return n;
}

tolerance_estimate tolerance_estimate_at(const tolerance *t, size_t curve, size_t at)
{
    double h[SCENE_MAX_AXIS], f[SCENE_MAX_AXIS];
    return tolerance_estimate_of(values_of(t, curve, at, h, f), h, f);
}

/* Variants tend to one value: where they differ by more than their estimates, one of these is wrong, and nobody knows
 * which. */
static void compare_variants(tolerance *t, size_t curve, size_t at)
{
    choose_case *one = &t->curve[curve].list[at];
    const double value = tolerance_case(t, curve, at)->quantity[t->quantity];
    for (size_t i = 0; i < t->study->n_groups; i++) {
        for (size_t k = 0; k < t->curve[i].n && i != curve; k++) {
            const choose_case *other = &t->curve[i].list[k];
            const double its = tolerance_case(t, i, k)->quantity[t->quantity];
            if (other->state != CHOOSE_DONE || !other->sure) continue;
            one->error = fmax(one->error, (fabs(its - value) - other->error * fabs(its)) / fabs(value));
        }
    }
}

static void add_case_result(tolerance *t, size_t curve, size_t at)
{
    const study_case *from = tolerance_case(t, curve, at);
    choose_case *one = &t->curve[curve].list[at];
    one->state = from->run->state != BATCH_ENDED ? CHOOSE_OPEN : study_is_done(from) ? CHOOSE_DONE : CHOOSE_FAILED;
    one->error = NAN;
    one->sure = false;
    one->seconds = from->run->ran ? summary_run_seconds(&from->run->summary) : 0.0;
    if (one->state != CHOOSE_DONE) return;
    one->seconds = from->timing.best;
    if (t->quantity < 0) {
        one->error = study_error(from, t->metric);
        one->sure = isfinite(one->error);
    } else {
        const tolerance_estimate e = tolerance_estimate_at(t, curve, at);
        one->error = e.relative;
        one->sure = e.sure;
        one->settled = e.settled;
    }
}

static void take_results(tolerance *t)
{
    study_take_values(t->study);
    study_judge(t->study);
    study_take_times(t->study);
    for (size_t i = 0; i < t->study->n_groups; i++) {
        for (size_t k = 0; k < t->curve[i].n; k++) add_case_result(t, i, k);
    }
    for (size_t i = 0; i < t->study->n_groups && t->quantity >= 0; i++) {
        for (size_t k = 0; k < t->curve[i].n; k++) {
            if (t->curve[i].list[k].sure && t->curve[i].list[k].error <= t->options->tolerance)
                compare_variants(t, i, k);
        }
    }
}

/* ---- cases ---- */

double tolerance_seconds(const tolerance *t)
{
    double sum = 0.0;
    for (size_t i = 0; i < t->study->n; i++) {
        if (t->study->run[i].ran) sum += t->study->run[i].summary.wall_seconds;
    }
    return sum;
}

static double seconds_left(const tolerance *t)
{
    return t->options->budget > 0.0 ? t->options->budget - tolerance_seconds(t) : (double)INFINITY;
}

/* A run to a tolerance as a judge: case by case. */
static floe_status want_next_of_tolerance(void *of, case_round *round)
{
    tolerance *t = of;
    t->step =
        choose_next(t->curve, t->study->n_groups, t->options->tolerance, t->quantity < 0 ? 1 : 3, seconds_left(t));
    t->met = t->step.action == CHOOSE_REACHED;
    if (t->step.action != CHOOSE_RUN) return FLOE_OK;
    const double left = seconds_left(t), predicted = t->curve[t->step.curve].next_seconds;
    const study_case *one = tolerance_case(t, t->step.curve, t->step.at);
    batch_options *batch = &round->batch;
    *round = (case_round){study_batch_options(t->study), one->run, 1};
    if (isfinite(left) && !(batch->max_wall > 0.0 && batch->max_wall < left)) batch->max_wall = left;
    if (batch->progress) {
        (void)fprintf(batch->progress, "%s", one->run->label);
        if (isfinite(predicted)) (void)fprintf(batch->progress, ", about %.2g s", predicted);
        (void)fprintf(batch->progress, "\n");
    }
    return FLOE_OK;
}

static floe_status take_case(void *of, const case_round *round)
{
    (void)round;
    take_results(of);
    return FLOE_OK;
}

/* The cases as a study: what `floe study` would go on with, and `floe report` reads. */
static floe_status write_tolerance_results(void *of)
{
    return study_write(((const tolerance *)of)->study);
}

static floe_status publish_choice(void *of)
{
    tolerance *t = of;
    if (t->step.curve < t->study->n_groups) TRY(tolerance_publish(t));
    return t->met ? FLOE_OK : tolerance_refuse(t);
}

static floe_status run_cases(tolerance *t)
{
    static const case_judge judge = {want_next_of_tolerance, take_case, write_tolerance_results, publish_choice};
    const batch_options batch = study_batch_options(t->study);
    TRY(batch_recall(t->ctx, &batch, t->study->run, t->study->n));
    take_results(t);
    return judge_cases(t->ctx, &judge, t);
}

/* DIR is this run's alone while it lasts. */
static floe_status run_tolerance(tolerance *t)
{
    folder_lock lock;
    TRY(look_at_deck(t));
    TRY(make_tolerance_curves(t));
    TRY(folder_make(t->ctx, t->options->dir));
    TRY(folder_lock_take(&lock, t->ctx, t->options->dir));
    const floe_status status = run_cases(t);
    folder_lock_release(&lock);
    return status;
}

floe_status tolerance_run(tolerance **out, context *ctx, const tolerance_options *options)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    tolerance *t = *out;
    t->ctx = ctx;
    t->options = options;
    t->study_options = options->study;
    (void)snprintf(t->cases, sizeof t->cases, "%s/cases", options->dir);
    t->study_options.name = "study";
    t->study_options.batch.dir = t->cases;
    t->study_options.batch.jobs = 1;
    t->study_options.repeat = 0;
    TRY(memory_new(ctx, &t->study, 1, sizeof *t->study));
    t->study->ctx = ctx;
    t->study->options = &t->study_options;
    return run_tolerance(t);
}

void tolerance_destroy(tolerance **t)
{
    if (!t || !*t) return;
    context *ctx = (*t)->ctx;
    study_destroy(&(*t)->study);
    memory_free(ctx, &(*t)->index);
    memory_free(ctx, &(*t)->list);
    memory_free(ctx, &(*t)->curve);
    memory_free(ctx, t);
}

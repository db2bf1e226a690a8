/* Verdicts: a case is right, was refused, or is wrong. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "io/file.h"
#include "run/run_errors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool study_has_verdicts(const study *s)
{
    return s->plan.n_checks > 0;
}

const char *study_verdict_name(study_verdict verdict)
{
    static const char *const name[] = {"", "right", "refused", "wrong"};
    return name[verdict];
}

size_t study_count(const study *s, study_verdict verdict)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) n += s->list[i].verdict == verdict;
    return n;
}

const char *study_refusal_of(const study *s, const study_case *one)
{
    for (int k = 0; k < s->plan.n_refusals; k++) {
        if (study_belongs(s, one, &s->plan.refusal[k].where, true)) return s->plan.refusal[k].why;
    }
    return NULL;
}

/* ---- what a check looks at ---- */

static study_range range_of_column(const csv_table *history, const char *name)
{
    study_range r = {INFINITY, -INFINITY};
    const csv_column *column = csv_find(history, name);
    for (size_t i = 0; column && i < history->n_rows; i++) {
        const double x = column->value[i];
        if (!isfinite(x)) return (study_range){NAN, NAN};
        r = (study_range){fmin(r.least, x), fmax(r.most, x)};
    }
    return column && history->n_rows > 0 ? r : (study_range){NAN, NAN};
}

/* Between two rows along the straight line. */
static study_range column_at(const csv_table *history, const char *name, double share)
{
    const csv_column *column = csv_find(history, name), *time = csv_find(history, "time");
    if (!column || !time || history->n_rows == 0) return (study_range){NAN, NAN};
    const double wanted = share * time->value[history->n_rows - 1];
    for (size_t i = 0; i < history->n_rows; i++) {
        const double t = time->value[i], x = column->value[i];
        if (!(t >= wanted)) continue;
        const double t0 = i > 0 ? time->value[i - 1] : (double)NAN, before = i > 0 ? column->value[i - 1] : (double)NAN;
        const double value = t > wanted && isfinite(t0) ? before + (x - before) * (wanted - t0) / (t - t0) : x;
        return (study_range){value, value};
    }
    return (study_range){NAN, NAN};
}

study_range study_range_of(const scene_check *check, const run_summary *errors, const run_summary *run,
                           const csv_table *history)
{
    double x = error_of(errors, check->of);
    if (strcmp(check->of, "drift_mass") == 0) x = run->drift_mass;
    if (strcmp(check->of, "drift_momentum") == 0) x = run->drift_momentum;
    if (strcmp(check->of, "drift_energy") == 0) x = run->drift_energy;
    if (!isnan(x) && isnan(check->at)) return (study_range){x, x};
    const study_range r =
        isnan(check->at) ? range_of_column(history, check->of) : column_at(history, check->of, check->at);
    const double first = check->change ? column_at(history, check->of, 0.0).least : 0.0;
    return (study_range){r.least - first, r.most - first};
}

/* ---- verdicts ---- */

bool study_keeps_to(const scene_check *check, study_range r, char why[BATCH_MESSAGE])
{
    if (!isfinite(r.least) || !isfinite(r.most))
        (void)snprintf(why, BATCH_MESSAGE, "%s: not measured, or no number", check->of);
    else if (!isnan(check->least) && !(r.least >= check->least))
        (void)snprintf(why, BATCH_MESSAGE, "%s: %.6g, at least %g is right", check->of, r.least, check->least);
    else if (!isnan(check->most) && !(r.most <= check->most))
        (void)snprintf(why, BATCH_MESSAGE, "%s: %.6g, at most %g is right", check->of, r.most, check->most);
    else
        return true;
    return false;
}

static bool is_error(const scene_check *check, const run_summary *r)
{
    return !isnan(error_of(r, check->of));
}

/* Of a wrong case nothing is found. */
static study_verdict verdict_of_done(const study *s, study_case *one, const csv_table *history, study_range *found)
{
    const run_summary *r = &one->run->summary;
    bool asked = false;
    for (int k = 0; k < s->plan.n_checks; k++) {
        const scene_check *check = &s->plan.check[k];
        if (!study_belongs(s, one, &check->where, true)) continue;
        asked = true;
        one->of_solution = one->of_solution || is_error(check, r);
        const study_range range = study_range_of(check, r, r, history);
        if (!study_keeps_to(check, range, one->why)) return STUDY_WRONG;
        found[k] = (study_range){fmin(found[k].least, range.least), fmax(found[k].most, range.most)};
    }
    if (asked) return STUDY_RIGHT;
    (void)snprintf(one->why, BATCH_MESSAGE, "no check is asked of it");
    return STUDY_WRONG;
}

static study_verdict verdict_of(const study *s, study_case *one, study_range *found)
{
    char path[BATCH_PATH];
    csv_table history;
    study_verdict verdict = STUDY_WRONG;
    const batch_case *run = one->run;
    one->why[0] = '\0';
    if (run->state != BATCH_ENDED) return STUDY_UNJUDGED;
    if (!study_is_done(one)) {
        const bool said = run->status == FLOE_DIVERGED || run->status == FLOE_BAD_INPUT;
        (void)snprintf(one->why, BATCH_MESSAGE, "%s", run->message);
        return said && run->message[0] ? STUDY_REFUSED : STUDY_WRONG;
    }
    (void)snprintf(path, sizeof path, "%s/%s/history.csv", s->options->batch.dir, run->folder);
    if (csv_read(&history, s->ctx, path) == FLOE_OK) {
        verdict = verdict_of_done(s, one, &history, found);
    } else {
        (void)snprintf(one->why, BATCH_MESSAGE, "its history.csv cannot be read");
        context_clear(s->ctx);
    }
    csv_free(&history);
    return verdict;
}

void study_judge(study *s)
{
    for (int k = 0; k < s->plan.n_checks; k++) s->found[k] = (study_range){INFINITY, -INFINITY};
    for (size_t i = 0; i < s->n && study_has_verdicts(s); i++) {
        study_range found[SCENE_MAX_BARS];
        memcpy(found, s->found, sizeof found);
        s->list[i].verdict = verdict_of(s, &s->list[i], found);
        if (s->list[i].verdict == STUDY_RIGHT) memcpy(s->found, found, sizeof found);
    }
}

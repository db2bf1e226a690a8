/* A run to a tolerance in words. */
#include "study/tolerance/tolerance_parts.h"

#include "run/run_errors.h"

#include <math.h>
#include <string.h>

void tolerance_error_text(const tolerance *t, double error, char text[TOLERANCE_TEXT])
{
    const char *name = t->quantity < 0 ? t->metric : "rel_";
    error_text(name, error, t->study->dimensionless, text);
}

static const choose_case *chosen_case(const tolerance *t)
{
    return &t->curve[t->step.curve].list[t->step.at];
}

void tolerance_how(const tolerance *t, char text[TOLERANCE_TEXT])
{
    if (t->quantity < 0) {
        (void)snprintf(text, TOLERANCE_TEXT, "measured: %s against %s", t->metric,
                       t->study->exact[0] ? t->study->exact : "the reference of the deck");
        return;
    }
    const tolerance_estimate e = tolerance_estimate_at(t, t->step.curve, t->step.at);
    const bool differ = chosen_case(t)->error > e.relative;
    (void)snprintf(text, TOLERANCE_TEXT, "estimated for %s: %s", t->metric,
                   differ ? "what it differs from other variants by, less their estimates" : e.how);
}

/* The variant that would come next: of the others with the least time to the tolerance, measured or predicted. */
static size_t runner_up(const tolerance *t, double *seconds, bool *measured)
{
    size_t best = t->study->n_groups;
    *seconds = INFINITY;
    for (size_t i = 0; i < t->study->n_groups; i++) {
        const choose_curve *c = &t->curve[i];
        for (size_t k = 0; k < c->n && i != t->step.curve; k++) {
            const bool within =
                c->list[k].state == CHOOSE_DONE && c->list[k].sure && c->list[k].error <= t->options->tolerance;
            if (!within || !(c->list[k].seconds < *seconds)) continue;
            *seconds = c->list[k].seconds;
            *measured = true;
            best = i;
        }
        if (i == t->step.curve || !(c->reach_seconds < *seconds)) continue;
        *seconds = c->reach_seconds;
        *measured = false;
        best = i;
    }
    return best;
}

void tolerance_reason(const tolerance *t, char text[TOLERANCE_TEXT])
{
    double seconds;
    bool measured = false;
    if (!t->met) {
        (void)snprintf(text, TOLERANCE_TEXT, "the smallest error of all cases that were run");
        return;
    }
    const size_t next = runner_up(t, &seconds, &measured);
    if (next == t->study->n_groups) {
        (void)snprintf(text, TOLERANCE_TEXT, "within the tolerance in %.3g s%s", chosen_case(t)->seconds,
                       t->study->n_groups > 1 ? "; no other variant is known to reach it" : "");
        return;
    }
    (void)snprintf(text, TOLERANCE_TEXT, "within the tolerance in %.3g s; the next best, %.150s, %s %.3g s",
                   chosen_case(t)->seconds, t->study->group[next], measured ? "took" : "is predicted to take", seconds);
}

void tolerance_why_left(const tolerance *t, size_t curve, char text[TOLERANCE_TEXT])
{
    const choose_curve *c = &t->curve[curve];
    text[0] = '\0';
    switch (c->standing) {
    case CHOOSE_SLOWER:
        if (isfinite(c->reach_seconds))
            (void)snprintf(text, TOLERANCE_TEXT, "left: the tolerance is predicted to take %.2g s", c->reach_seconds);
        else if (isnan(c->order))
            (void)snprintf(text, TOLERANCE_TEXT, "left: its next case alone is predicted to take %.2g s",
                           c->next_seconds);
        else
            (void)snprintf(text, TOLERANCE_TEXT, "left: it is not predicted to reach the tolerance");
        return;
    case CHOOSE_HOPELESS: (void)snprintf(text, TOLERANCE_TEXT, "left: its finest case would not do"); return;
    case CHOOSE_BROKEN: (void)snprintf(text, TOLERANCE_TEXT, "left: two of its cases have failed"); return;
    case CHOOSE_SPENT: (void)snprintf(text, TOLERANCE_TEXT, "its finest case"); return;
    case CHOOSE_RUNS: return;
    }
}

/* The variant that would be the first at the tolerance, if it had the spacings; n_groups: none can be told. */
static size_t first_beyond(const tolerance *t)
{
    size_t best = t->study->n_groups;
    for (size_t i = 0; i < t->study->n_groups; i++) {
        if (!isfinite(t->curve[i].wanted_seconds)) continue;
        if (best == t->study->n_groups || t->curve[i].wanted_seconds < t->curve[best].wanted_seconds) best = i;
    }
    return best;
}

static void say_beyond(const tolerance *t, char text[TOLERANCE_TEXT])
{
    const size_t i = first_beyond(t);
    text[0] = '\0';
    if (i == t->study->n_groups) return;
    (void)snprintf(text, TOLERANCE_TEXT, "; by extrapolation %.150s would take %s = %.2g and %.2g s (order %.2g): %s",
                   t->study->group[i], study_axis_name(&t->study->axes.axis[t->study->over]), t->curve[i].wanted_h,
                   t->curve[i].wanted_seconds, t->curve[i].order,
                   t->step.action == CHOOSE_OUT_OF_TIME ? "give it more time by --budget, the same command goes on"
                                                        : "add finer values to the axis, the same command goes on");
}

/* No case has an error: why the first one failed. */
static floe_status refuse_all(const tolerance *t)
{
    const study *s = t->study;
    if (t->step.action == CHOOSE_OUT_OF_TIME)
        return fail(t->ctx, FLOE_MISSED_BAR,
                    "no case has an error '%s' after %.3g s: give it more time by --budget, the same command goes on",
                    t->metric, t->options->budget);
    for (size_t i = 0; i < s->n; i++) {
        if (s->run[i].state == BATCH_ENDED && s->run[i].message[0])
            return fail(t->ctx, FLOE_MISSED_BAR, "no case has an error '%s'; %s: %s", t->metric, s->run[i].label,
                        s->run[i].message);
    }
    return fail(t->ctx, FLOE_MISSED_BAR, "no case has an error '%s'", t->metric);
}

floe_status tolerance_refuse(const tolerance *t)
{
    char asked[TOLERANCE_TEXT], best[TOLERANCE_TEXT], beyond[TOLERANCE_TEXT], time[64] = "";
    if (t->step.curve == t->study->n_groups) return refuse_all(t);
    tolerance_error_text(t, t->options->tolerance, asked);
    tolerance_error_text(t, chosen_case(t)->error, best);
    say_beyond(t, beyond);
    if (t->step.action == CHOOSE_OUT_OF_TIME) (void)snprintf(time, sizeof time, " in %.3g s", t->options->budget);
    return fail(t->ctx, FLOE_MISSED_BAR, "%s in %s is not reached%s: the best is %s%s, %s, which is what '%s' has%s",
                asked, t->metric, time, best, chosen_case(t)->sure ? "" : " (not certain)",
                tolerance_case(t, t->step.curve, t->step.at)->run->label, t->options->dir, beyond);
}

/* A run to a tolerance as a table. */
#include "study/tolerance/tolerance_parts.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static bool has_run(const tolerance *t, size_t k)
{
    return t->list[k].state != CHOOSE_OPEN;
}

/* Curve and place in it of the k-th of all cases. */
static choose_step step_of_case(const tolerance *t, size_t k)
{
    choose_step at = {CHOOSE_RUN, 0, k};
    while (at.at >= t->curve[at.curve].n) at.at -= t->curve[at.curve++].n;
    return at;
}

/* The next one by time, after `seconds` and the case `after` of that time; n: none. */
static size_t next_by_time(const tolerance *t, double seconds, size_t after)
{
    size_t best = t->study->n;
    for (size_t k = 0; k < t->study->n; k++) {
        const double its = t->list[k].seconds;
        if (!has_run(t, k) || its < seconds || (its == seconds && after != SIZE_MAX && k <= after)) continue;
        if (best == t->study->n || its < t->list[best].seconds) best = k;
    }
    return best;
}

/* What is to be said of a case: of the last one of its variant, why it is the last. */
static void describe_case(const tolerance *t, size_t k, char text[TOLERANCE_TEXT])
{
    const choose_step at = step_of_case(t, k);
    const study_case *one = tolerance_case(t, at.curve, at.at);
    text[0] = '\0';
    if (t->step.curve < t->study->n_groups && at.curve == t->step.curve && at.at == t->step.at)
        (void)snprintf(text, TOLERANCE_TEXT, t->met ? "chosen" : "the best");
    else if (t->list[k].state == CHOOSE_FAILED)
        (void)snprintf(text, TOLERANCE_TEXT, "%s", batch_status_name(one->run));
    else if (t->curve[at.curve].next == at.at + 1)
        tolerance_why_left(t, at.curve, text);
}

static void print_case(const tolerance *t, size_t k, FILE *file)
{
    char text[TOLERANCE_TEXT];
    const study *s = t->study;
    const study_case *one = &s->list[t->index[k]];
    for (int i = 0; i < s->axes.n; i++)
        (void)fprintf(file, "%-*s  ", axis_width(&s->axes.axis[i], study_axis_name(&s->axes.axis[i]), 0),
                      s->axes.axis[i].value[one->pick[i]]);
    tolerance_error_text(t, t->list[k].error, text);
    (void)fprintf(file, "%14s  %8.3g s", text, t->list[k].seconds);
    describe_case(t, k, text);
    (void)fprintf(file, "%s%s\n", text[0] ? "  " : "", text);
}

/* Variants of which nothing was run. */
static void print_untried(const tolerance *t, FILE *file)
{
    char text[TOLERANCE_TEXT];
    for (size_t i = 0; i < t->study->n_groups; i++) {
        if (t->curve[i].next > 0) continue;
        tolerance_why_left(t, i, text);
        (void)fprintf(file, "not tried: %s%s%s\n", t->study->group[i], text[0] ? ", " : "", text);
    }
}

void tolerance_print(const tolerance *t, FILE *file)
{
    char text[TOLERANCE_TEXT], error[TOLERANCE_TEXT];
    const study *s = t->study;
    if (!t->curve || !t->published) return;
    if (s->title[0]) (void)fprintf(file, "%s\n", s->title);
    for (int i = 0; i < s->axes.n; i++)
        (void)fprintf(file, "%-*s  ", axis_width(&s->axes.axis[i], study_axis_name(&s->axes.axis[i]), 0),
                      study_axis_name(&s->axes.axis[i]));
    (void)fprintf(file, "%14s  %10s\n", t->metric, "time");
    double seconds = -1.0;
    for (size_t k = next_by_time(t, seconds, SIZE_MAX); k < s->n; k = next_by_time(t, seconds, k)) {
        print_case(t, k, file);
        seconds = t->list[k].seconds;
    }
    print_untried(t, file);
    tolerance_error_text(t, t->curve[t->step.curve].list[t->step.at].error, error);
    tolerance_reason(t, text);
    (void)fprintf(file, "%s: %s, %s\n", t->met ? "chosen" : "not reached; the best",
                  tolerance_case(t, t->step.curve, t->step.at)->run->label, text);
    tolerance_how(t, text);
    (void)fprintf(file, "error: %s (%s); all cases took %.3g s\n", error, text, tolerance_seconds(t));
}

/* A run to a tolerance as a table. */
#include "study/table.h"
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
static void describe_try(const tolerance *t, size_t k, char text[TOLERANCE_TEXT])
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

static void add_try_row(const tolerance *t, size_t k, table *to)
{
    static const table_column stored = {.in = TABLE_JSON};
    char text[TOLERANCE_TEXT];
    const choose_case *c = &t->list[k];
    const study_case *one = &t->study->list[t->index[k]];
    table_row(to);
    table_text(to, "directory", stored, one->run->folder);
    for (int i = 0; i < t->study->axes.n; i++) {
        const scene_axis *axis = &t->study->axes.axis[i];
        const char *name = study_axis_name(axis);
        const table_column setting = {
            .in = TABLE_JSON | TABLE_SHOWN, .object = "settings", .heading = name, .left = true, .names = true};
        table_text(to, axis->key, setting, axis->value[one->pick[i]]);
    }
    table_text(to, "status", stored, batch_status_name(one->run));
    table_number(to, "seconds", stored, c->state == CHOOSE_DONE ? c->seconds : (double)NAN);
    tolerance_error_text(t, c->error, text);
    table_number_as(to, "error", (table_column){.in = TABLE_JSON | TABLE_SHOWN, .heading = t->metric, .width = 14},
                    c->error, text);
    table_flag(to, "sure", stored, c->sure);
    table_number(to, "time", (table_column){.in = TABLE_SHOWN, .format = "%.3g s", .width = 10}, c->seconds);
    describe_try(t, k, text);
    table_text(to, "", (table_column){.in = TABLE_SHOWN, .left = true}, text);
}

json_t *tolerance_cases_json(const tolerance *t)
{
    table of;
    table_init(&of, t->ctx);
    for (size_t k = 0; k < t->study->n; k++)
        if (has_run(t, k)) add_try_row(t, k, &of);
    json_t *list = table_json(&of);
    table_free(&of);
    return list;
}

static floe_status print_tries(const tolerance *t, FILE *file)
{
    table of;
    double seconds = -1.0;
    table_init(&of, t->ctx);
    for (size_t k = next_by_time(t, seconds, SIZE_MAX); k < t->study->n; k = next_by_time(t, seconds, k)) {
        add_try_row(t, k, &of);
        seconds = t->list[k].seconds;
    }
    const floe_status status = table_print(&of, file);
    table_free(&of);
    return status;
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

floe_status tolerance_print(const tolerance *t, FILE *file)
{
    char text[TOLERANCE_TEXT], error[TOLERANCE_TEXT];
    const study *s = t->study;
    if (!t->curve || !t->published) return FLOE_OK;
    if (s->title[0]) (void)fprintf(file, "%s\n", s->title);
    TRY(print_tries(t, file));
    print_untried(t, file);
    tolerance_error_text(t, t->curve[t->step.curve].list[t->step.at].error, error);
    tolerance_reason(t, text);
    (void)fprintf(file, "%s: %s, %s\n", t->met ? "chosen" : "not reached; the best",
                  tolerance_case(t, t->step.curve, t->step.at)->run->label, text);
    tolerance_how(t, text);
    (void)fprintf(file, "error: %s (%s); all cases took %.3g s\n", error, text, tolerance_seconds(t));
    return FLOE_OK;
}

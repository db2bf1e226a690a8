/* A study as a table: for people, and as CSV. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "base/text.h"
#include "base/wrapped.h"
#include "run/run_errors.h"

#include <math.h>
#include <string.h>

/* ---- cases ---- */

enum { HEADING = SCENE_NAME + 32, LEAST_WIDTH = 12 };

/* "l1_pressure (Pa)" */
static void metric_heading(const study *s, const char *metric, char text[HEADING])
{
    const char *unit = error_unit(metric, s->dimensionless);
    (void)snprintf(text, HEADING, "%s%s%s%s", metric, unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
}

static const table_column csv = {.in = TABLE_CSV}, csv_short = {.in = TABLE_CSV, .digits = 6},
                          csv_seconds = {.in = TABLE_CSV, .unit = "s", .digits = 6},
                          quoted = {.in = TABLE_FILES, .quoted = true}, json = {.in = TABLE_JSON},
                          json_timing = {.in = TABLE_JSON, .object = "timing"},
                          json_verdict = {.in = TABLE_JSON, .object = "verdict"},
                          shown_time = {.in = TABLE_SHOWN, .format = "%.3g s", .width = 10};

/* Where the case stands in the study. */
static void add_axes(const study *s, const study_case *one, table *t)
{
    if (axis_find(&s->axes, "coupling") < 0) table_text(t, "coupling", csv, coupling_name(one->coupling));
    for (int k = 0; k < s->axes.n; k++) {
        const scene_axis *axis = &s->axes.axis[k];
        table_column c = {.in = TABLE_ALL, .object = "settings", .heading = study_axis_name(axis), .width = 6};
        double x;
        const char *unit;
        c.quoted = strcmp(axis->key, "coupling") != 0;
        c.names = true;
        c.left = !axis_number(axis->value[0], &x, &unit);
        table_text(t, axis->key, c, axis->value[one->pick[k]]);
    }
    /* A comparison of couplings alone has an empty second column, so that its columns are those of any other. */
    if (s->options->compare && s->axes.n == 1)
        table_text(t, "case", (table_column){.in = TABLE_CSV, .quoted = true}, "");
}

/* What its run has come to; without a summary there are no numbers, and people see why. */
static void add_run(const study *s, const study_case *one, table *t)
{
    const table_column length = {.in = TABLE_FILES, .unit = s->dimensionless ? "1" : "m"},
                       time = {.in = TABLE_CSV, .unit = s->dimensionless ? "1" : "s"};
    const run_summary *r = &one->run->summary;
    const double any = one->run->ran ? 0.0 : (double)NAN;
    table_number(t, "h", length, one->h);
    table_text(t, "status", (table_column){.in = TABLE_FILES}, batch_status_name(one->run));
    table_number(t, "time", time, any + r->time);
    table_number(t, "steps", csv, any + (double)r->steps);
    table_number(t, "rejected_steps", csv, any + (double)r->rejected_steps);
    table_number(t, "wall_seconds", csv_seconds, any + (one->timing.n > 0 ? one->timing.wall : r->wall_seconds));
    table_number(t, "cells", csv, any + (double)r->cells);
    table_number(t, "points", csv, any + (double)r->points);
    table_number(t, "cell_updates", csv, any + r->cell_updates);
    table_number(t, "point_updates", csv, any + r->point_updates);
    table_number(t, "drift_mass", csv_short, any + r->drift_mass);
    table_number(t, "drift_momentum", csv_short, any + r->drift_momentum);
    table_number(t, "drift_energy", csv_short, any + r->drift_energy);
    if (!one->run->ran) {
        char text[BATCH_MESSAGE + 32];
        (void)snprintf(text, sizeof text, "%s: %s", batch_status_name(one->run), one->run->message);
        table_last(t, text);
    }
    table_whole(t, "points", (table_column){.in = TABLE_SHOWN, .width = 8}, r->points);
    table_whole(t, "cells", (table_column){.in = TABLE_SHOWN, .width = 8}, r->cells);
    table_whole(t, "steps", (table_column){.in = TABLE_SHOWN, .width = 7}, r->steps);
}

static void add_values(const study *s, const study_case *one, table *t)
{
    const table_column quantity = {.in = TABLE_ALL, .object = "quantities", .width = LEAST_WIDTH};
    for (int k = 0; k < s->n_metrics; k++) {
        const char *metric = s->metric[k];
        const double error = study_error(one, metric);
        char heading[HEADING], text[ERROR_TEXT];
        table_column c = {.in = TABLE_CSV | TABLE_SHOWN, .heading = heading, .width = LEAST_WIDTH};
        if (!error_is_relative(metric)) c.unit = error_unit(metric, s->dimensionless);
        metric_heading(s, metric, heading);
        error_number(metric, error, text);
        table_number_as(t, metric, c, error, text);
    }
    table_values(t, quantity, NULL, 0, NULL);
    for (int q = 0; q < s->plan.n_quantities; q++) table_number(t, s->plan.quantity[q], quantity, one->quantity[q]);
}

/* Times as they are stored, and as people see them: of a run that did not come to its end too. */
static void add_times(const study *s, const study_case *one, table *t)
{
    const run_summary *r = &one->run->summary;
    const study_timing *timing = &one->timing;
    const size_t n = (size_t)timing->n;
    const bool done = study_is_done(one);
    table_number(t, "run_seconds", csv_seconds, timing->best);
    table_number(t, "best", json_timing, timing->best);
    table_flag(t, "timed", json_timing, n > 0);
    table_value(t, "all", json_timing, json_numbers(timing->seconds, n));
    table_number(t, "cpu_seconds", csv_seconds, timing->least);
    table_number(t, "cpu", json_timing, timing->least);
    table_number(t, "scatter", (table_column){.in = TABLE_FILES, .object = "timing", .digits = 3}, timing->scatter);
    table_value(t, "all_cpu", json_timing, json_numbers(timing->cpu, n));
    table_value(t, "other_cores", json_timing, json_numbers(timing->others, n));
    table_whole(t, "timed_runs", csv, timing->n);
    table_flag(t, "disturbed", (table_column){.in = TABLE_FILES, .object = "timing"}, timing->disturbed);
    table_flag(t, "same_results", json_timing, s->plan.repeat == 0 || !timing->differs);
    table_number(t, "CPU time", shown_time, done ? timing->least : r->cpu_seconds);
    table_number(t, "run time", shown_time, done ? timing->best : summary_run_seconds(r));
}

static void add_verdict(const study *s, const study_case *one, table *t)
{
    const unsigned spoiled = s->options->spoil ? TABLE_FILES : TABLE_JSON;
    const char *reason = one->verdict == STUDY_REFUSED ? study_refusal_of(s, one) : NULL;
    char unnoticed[BATCH_MESSAGE];
    study_unnoticed_text(one, unnoticed);
    table_text(t, "verdict", csv, study_verdict_name(one->verdict));
    table_text(t, "is", json_verdict, study_verdict_name(one->verdict));
    table_text(t, "why", (table_column){.in = TABLE_FILES, .object = "verdict", .quoted = true}, one->why);
    table_value(t, "reason", json_verdict, reason ? json_plain_text(reason) : json_null());
    table_text(t, "judged_by", (table_column){.in = spoiled, .object = "verdict"}, study_kind_name(one));
    table_text(t, "unnoticed", (table_column){.in = spoiled, .object = "verdict", .quoted = true}, unnoticed);
}

enum { NOTES = 2 * BATCH_MESSAGE };

static void add_note(char notes[NOTES], const char *note)
{
    text_add(notes, NOTES, "%s%s", notes[0] ? "  " : "", note);
}

/* What is to be said of a case that has run. */
static void describe_study_case(const study *s, const study_case *one, char notes[NOTES])
{
    notes[0] = '\0';
    if (one->timing.disturbed) add_note(notes, "disturbed");
    if (!study_is_done(one)) add_note(notes, batch_status_name(one->run));
    if (one->run->summary.n_warnings > 0) add_note(notes, "warned");
    if (study_has_verdicts(s)) add_note(notes, study_verdict_name(one->verdict));
    if (one->verdict == STUDY_WRONG) text_add(notes, NOTES, " (%s)", one->why);
}

static void add_case_row(const study *s, const study_case *one, table *t)
{
    const scene_axis *over = s->over < 0 ? NULL : &s->axes.axis[s->over];
    char text[NOTES];
    table_row(t);
    add_axes(s, one, t);
    add_run(s, one, t);
    add_values(s, one, t);
    add_times(s, one, t);
    table_whole(t, "warnings", csv, one->run->ran ? one->run->summary.n_warnings : 0);
    table_text(t, "directory", quoted, one->run->folder);
    table_text(t, "message", quoted, one->run->message);
    table_text(t, "group", json, s->group[one->group]);
    table_values(t, (table_column){.in = TABLE_JSON, .object = "axis"}, over, over ? 1 : 0,
                 &one->pick[over ? s->over : 0]);
    if (study_has_verdicts(s)) add_verdict(s, one, t);
    describe_study_case(s, one, text);
    table_text(t, "", (table_column){.in = TABLE_SHOWN, .left = true}, text);
}

void study_case_table(const study *s, table *t)
{
    table_init(t, s->ctx);
    for (size_t i = 0; i < s->n; i++) add_case_row(s, &s->list[i], t);
}

floe_status study_write_csv(const study *s)
{
    table t;
    study_case_table(s, &t);
    const floe_status status = table_write_csv(&t, s->options->batch.dir, s->options->name);
    table_free(&t);
    return status;
}

/* ---- for people ---- */

enum { WARNINGS_SHOWN = 6 };

static floe_status print_study_cases(const study *s, FILE *file)
{
    table t;
    study_case_table(s, &t);
    const floe_status status = table_print(&t, file);
    table_free(&t);
    return status;
}

static void print_orders(const study *s, FILE *file)
{
    const char *over = s->over < 0 ? "h" : study_axis_name(&s->axes.axis[s->over]);
    for (size_t g = 0; g < s->n_groups; g++) {
        char text[2048] = "";
        for (int m = 0; m < s->n_metrics; m++) {
            const study_order order = study_order_of(s, g, s->metric[m]);
            if (!isfinite(order.order)) continue;
            text_add(text, sizeof text, "%s%s %.2f", text[0] ? ", " : "", s->metric[m], order.order);
            if (isfinite(order.standard_error)) text_add(text, sizeof text, " +- %.2f", order.standard_error);
        }
        if (text[0]) wrapped_printf(file, "order in %s, %s: %s\n", over, s->group[g], text);
    }
}

static void print_limit(const study *s, size_t group, int q, FILE *file)
{
    study_limit l;
    if (!study_limit_of(s, group, q, &l)) return;
    char text[256] = "";
    if (isfinite(l.limit.gci_fine)) {
        const double finest = l.values.value[l.values.n - 1];
        text_add(text, sizeof text, ", %.6g", l.limit.value);
        if (isfinite(l.limit.order)) text_add(text, sizeof text, ", order %.2f", l.limit.order);
        text_add(text, sizeof text, ", grid convergence index of the finest %.3g %%",
                 100.0 * l.limit.gci_fine / fabs(finest));
    }
    wrapped_printf(file, "limit of %s, %s: %s%s\n", s->plan.quantity[q], s->group[group], richardson_name(l.limit.kind),
                   text);
}

static void print_answers(const study *s, FILE *file)
{
    for (int m = 0; m < s->n_metrics; m++) {
        study_answer a[STUDY_MAX_TARGETS];
        const int n = study_answers(s, s->metric[m], a);
        for (int k = 0; k < n && s->n_groups > 1; k++) {
            char text[512];
            study_answer_text(s, &a[k], text, sizeof text);
            wrapped_printf(file, "%s\n", text);
        }
        const double least = study_least_level(s, s->metric[m]);
        if (least > STUDY_ROUND_OFF && s->n_groups > 1)
            wrapped_printf(file, "below %.2g %% in %s nothing is chosen: the reference is good for %.2g %%\n",
                           100.0 * least, s->metric[m], 50.0 * least);
    }
}

static void print_timing(const study *s, FILE *file)
{
    char text[256] = "";
    bool crowded = false;
    for (size_t i = 0; i < s->n; i++)
        crowded = crowded || (s->plan.repeat == 0 && study_is_done(&s->list[i]) && !s->run[i].alone);
    if (s->plan.repeat > 0)
        text_add(text, sizeof text,
                 "times: the best of %d, alone on one thread, of short cases the best of more, without that of outputs",
                 s->plan.repeat);
    if (crowded)
        text_add(text, sizeof text,
                 "times: not to be compared, as cases ran side by side (--repeat N times them alone)");
    if (study_is_disturbed(s))
        text_add(text, sizeof text, "%sother programs used the machine during the disturbed ones",
                 text[0] ? "; " : "times: ");
    if (text[0]) wrapped_printf(file, "%s\n", text);
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].timing.differs)
            wrapped_printf(file, "%s: repeated runs gave different results, which must not be: please report it\n",
                           s->run[i].label);
    }
}

static floe_status print_bars(const study *s, FILE *file)
{
    study_bar_result *list;
    size_t n;
    TRY(study_bars(s, &list, &n));
    for (size_t i = 0; i < n; i++) {
        char text[512];
        study_bar_text(s, &list[i], text, sizeof text);
        wrapped_printf(file, "%s: %s\n", list[i].met ? "met" : "MISSED", text);
    }
    memory_free(s->ctx, &list);
    return FLOE_OK;
}

static void print_verdicts(const study *s, FILE *file)
{
    if (!study_has_verdicts(s)) return;
    (void)fprintf(file, "%zu cases: %zu right, %zu refused, %zu wrong\n", s->n, study_count(s, STUDY_RIGHT),
                  study_count(s, STUDY_REFUSED), study_count(s, STUDY_WRONG));
    if (s->options->spoil) (void)fprintf(file, "checked blindly: %zu\n", study_count_unnoticed(s));
    for (size_t i = 0; i < s->n; i++) {
        const char *reason = s->list[i].verdict == STUDY_REFUSED ? study_refusal_of(s, &s->list[i]) : NULL;
        if (reason) wrapped_printf(file, "refused, %s: %s\n", s->run[i].label, reason);
    }
}

/* Whether a case before has the same warning. */
static bool is_warned_before(const study *s, size_t one, const char *text)
{
    for (size_t i = 0; i < one; i++) {
        const run_summary *r = &s->list[i].run->summary;
        for (int k = 0; s->list[i].run->ran && k < r->n_warnings; k++)
            if (strcmp(r->warnings[k], text) == 0) return true;
    }
    return false;
}

/* Each warning once, with the first case that has it. */
static void print_warnings(const study *s, FILE *file)
{
    int shown = 0, more = 0;
    for (size_t i = 0; i < s->n; i++) {
        const run_summary *r = &s->list[i].run->summary;
        for (int k = 0; s->list[i].run->ran && k < r->n_warnings; k++) {
            if (is_warned_before(s, i, r->warnings[k])) continue;
            if (shown++ < WARNINGS_SHOWN)
                wrapped_printf(file, "warned, %s: %s\n", s->list[i].run->label, r->warnings[k]);
            else
                more++;
        }
    }
    if (more > 0) (void)fprintf(file, "warned: %d more, in the summary.json of the cases\n", more);
}

floe_status study_print(const study *s, FILE *file)
{
    if (s->title[0]) (void)fprintf(file, "%s\n", s->title);
    TRY(print_study_cases(s, file));
    print_timing(s, file);
    print_orders(s, file);
    for (size_t g = 0; g < s->n_groups; g++) {
        for (int q = 0; q < s->plan.n_quantities; q++) print_limit(s, g, q, file);
    }
    print_answers(s, file);
    print_verdicts(s, file);
    print_warnings(s, file);
    return print_bars(s, file);
}

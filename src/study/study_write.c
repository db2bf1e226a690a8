/* A study as a table: for people, and as CSV. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "base/strbuf.h"
#include "run/run_errors.h"

#include <math.h>
#include <string.h>

/* ---- NAME.csv ---- */

/* A comparison of couplings alone has an empty second column, so that its columns are those of any other. */
static bool has_empty_axis(const study *s)
{
    return s->options->compare && s->axes.n == 1;
}

static void append_names(const study *s, strbuf *out)
{
    if (axis_find(&s->axes, "coupling") < 0) strbuf_append(out, "coupling,");
    for (int k = 0; k < s->axes.n; k++) strbuf_append(out, "%s,", s->axes.axis[k].key);
    if (has_empty_axis(s)) strbuf_append(out, "case,");
    strbuf_append(out,
                  "h (%s),status,time (%s),steps,rejected_steps,wall_seconds (s),cells,points,cell_updates,"
                  "point_updates,drift_mass,drift_momentum,drift_energy",
                  s->dimensionless ? "1" : "m", s->dimensionless ? "1" : "s");
    for (int k = 0; k < s->n_metrics; k++) {
        const char *unit = error_is_relative(s->metric[k]) ? "" : error_unit(s->metric[k], s->dimensionless);
        strbuf_append(out, ",%s%s%s%s", s->metric[k], unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
    }
    for (int q = 0; q < s->plan.n_quantities; q++) strbuf_append(out, ",%s", s->plan.quantity[q]);
    strbuf_append(out, ",run_seconds (s),cpu_seconds (s),scatter,timed_runs,disturbed,warnings,directory,message%s\n",
                  study_has_verdicts(s) ? s->options->spoil ? ",verdict,why,judged_by,unnoticed" : ",verdict,why" : "");
}

static void append_setting(const scene_axis *axis, int pick, strbuf *out)
{
    if (strcmp(axis->key, "coupling") == 0)
        strbuf_append(out, "%s,", axis->value[pick]);
    else
        csv_append_field(out, axis->value[pick]);
}

static void append_case(const study *s, const study_case *one, strbuf *out)
{
    const run_summary *r = &one->run->summary;
    if (axis_find(&s->axes, "coupling") < 0) strbuf_append(out, "%s,", coupling_name(one->coupling));
    for (int k = 0; k < s->axes.n; k++) append_setting(&s->axes.axis[k], one->pick[k], out);
    if (has_empty_axis(s)) strbuf_append(out, "\"\",");
    strbuf_append(out, "%.17g,%s", one->h, batch_status_name(one->run));
    if (one->run->ran) {
        const double seconds = one->timing.n > 0 ? one->timing.wall : r->wall_seconds;
        strbuf_append(out, ",%.17g,%lld,%lld,%.6g,%lld,%lld,%.17g,%.17g,%.6g,%.6g,%.6g", r->time, r->steps,
                      r->rejected_steps, seconds, r->cells, r->points, r->cell_updates, r->point_updates, r->drift_mass,
                      r->drift_momentum, r->drift_energy);
    } else {
        strbuf_append(out, ",nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan");
    }
    for (int k = 0; k < s->n_metrics; k++) strbuf_append(out, ",%.17g", study_error(one, s->metric[k]));
    for (int q = 0; q < s->plan.n_quantities; q++) strbuf_append(out, ",%.17g", one->quantity[q]);
    strbuf_append(out, ",%.6g,%.6g,%.3g,%d,%s,%d,", one->timing.best, one->timing.least, one->timing.scatter,
                  one->timing.n, one->timing.disturbed ? "yes" : "no", one->run->ran ? r->n_warnings : 0);
    csv_append_field(out, one->run->folder);
    strbuf_append_csv(out, one->run->message);
    if (study_has_verdicts(s)) {
        strbuf_append(out, ",%s,", study_verdict_name(one->verdict));
        strbuf_append_csv(out, one->why);
    }
    if (study_has_verdicts(s) && s->options->spoil) {
        char text[BATCH_MESSAGE];
        study_unnoticed_text(one, text);
        strbuf_append(out, ",%s,", study_kind_name(one));
        strbuf_append_csv(out, text);
    }
    strbuf_append(out, "\n");
}

floe_status study_write_csv(const study *s)
{
    strbuf out;
    strbuf_init(&out, s->ctx);
    append_names(s, &out);
    for (size_t i = 0; i < s->n; i++) append_case(s, &s->list[i], &out);
    return csv_write_rows(&out, s->options->batch.dir, s->options->name);
}

/* ---- for people ---- */

enum { HEADING = SCENE_NAME + 32, LEAST_WIDTH = 12, LEAST_AXIS = 6, WARNINGS_SHOWN = 6 };

/* "l1_pressure (Pa)" */
static void metric_heading(const study *s, const char *metric, char text[HEADING])
{
    const char *unit = error_unit(metric, s->dimensionless);
    (void)snprintf(text, HEADING, "%s%s%s%s", metric, unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
}

/* Width of a column of errors, of what stands in it. */
static int metric_width(const study *s, const char *metric)
{
    char text[HEADING];
    metric_heading(s, metric, text);
    int width = width_at_least(LEAST_WIDTH, text);
    for (size_t i = 0; i < s->n; i++) {
        char number[ERROR_TEXT];
        error_number(metric, study_error(&s->list[i], metric), number);
        width = width_at_least(width, number);
    }
    return width;
}

/* "%.6g" needs no more than the least width. */
static int quantity_width(const char *quantity)
{
    return width_at_least(LEAST_WIDTH, quantity);
}

static void print_axis_cell(const scene_axis *axis, const char *text, FILE *file)
{
    double x;
    const char *unit;
    const bool number = axis_number(axis->value[0], &x, &unit);
    /* A negative width is one to the left. */
    (void)fprintf(file, "%*s  ",
                  number ? axis_width(axis, study_axis_name(axis), LEAST_AXIS)
                         : -axis_width(axis, study_axis_name(axis), LEAST_AXIS),
                  text);
}

static void print_names(const study *s, FILE *file)
{
    for (int k = 0; k < s->axes.n; k++) print_axis_cell(&s->axes.axis[k], study_axis_name(&s->axes.axis[k]), file);
    (void)fprintf(file, "%8s  %8s  %7s", "points", "cells", "steps");
    for (int k = 0; k < s->n_metrics; k++) {
        char text[HEADING];
        metric_heading(s, s->metric[k], text);
        (void)fprintf(file, "  %*s", metric_width(s, s->metric[k]), text);
    }
    for (int q = 0; q < s->plan.n_quantities; q++)
        (void)fprintf(file, "  %*s", quantity_width(s->plan.quantity[q]), s->plan.quantity[q]);
    (void)fprintf(file, "  %11s  %11s\n", "CPU time", "run time");
}

static void print_case(const study *s, const study_case *one, FILE *file)
{
    const run_summary *r = &one->run->summary;
    for (int k = 0; k < s->axes.n; k++) print_axis_cell(&s->axes.axis[k], s->axes.axis[k].value[one->pick[k]], file);
    if (!one->run->ran) {
        (void)fprintf(file, "%s: %s\n", batch_status_name(one->run), one->run->message);
        return;
    }
    (void)fprintf(file, "%8lld  %8lld  %7lld", r->points, r->cells, r->steps);
    for (int k = 0; k < s->n_metrics; k++) {
        char text[ERROR_TEXT];
        error_number(s->metric[k], study_error(one, s->metric[k]), text);
        (void)fprintf(file, "  %*s", metric_width(s, s->metric[k]), text);
    }
    for (int q = 0; q < s->plan.n_quantities; q++)
        (void)fprintf(file, "  %*.6g", quantity_width(s->plan.quantity[q]), one->quantity[q]);
    (void)fprintf(file, "  %9.3g s  %9.3g s%s", study_is_done(one) ? one->timing.least : r->cpu_seconds,
                  study_is_done(one) ? one->timing.best : summary_run_seconds(r),
                  one->timing.disturbed ? " disturbed" : "");
    if (!study_is_done(one)) (void)fprintf(file, "  %s", batch_status_name(one->run));
    if (r->n_warnings > 0) (void)fprintf(file, "  warned");
    if (study_has_verdicts(s)) (void)fprintf(file, "  %s", study_verdict_name(one->verdict));
    if (one->verdict == STUDY_WRONG) (void)fprintf(file, " (%s)", one->why);
    (void)fprintf(file, "\n");
}

static void print_orders(const study *s, FILE *file)
{
    const char *over = s->over < 0 ? "h" : study_axis_name(&s->axes.axis[s->over]);
    for (size_t g = 0; g < s->n_groups; g++) {
        bool any = false;
        for (int m = 0; m < s->n_metrics; m++) {
            const study_order order = study_order_of(s, g, s->metric[m]);
            if (!isfinite(order.order)) continue;
            if (any) (void)fprintf(file, ", ");
            if (!any) (void)fprintf(file, "order in %s, %s: ", over, s->group[g]);
            (void)fprintf(file, "%s %.2f", s->metric[m], order.order);
            if (isfinite(order.standard_error)) (void)fprintf(file, " +- %.2f", order.standard_error);
            any = true;
        }
        if (any) (void)fprintf(file, "\n");
    }
}

static void print_limit(const study *s, size_t group, int q, FILE *file)
{
    study_limit l;
    if (!study_limit_of(s, group, q, &l)) return;
    (void)fprintf(file, "limit of %s, %s: %s", s->plan.quantity[q], s->group[group], richardson_name(l.limit.kind));
    if (isfinite(l.limit.gci_fine)) {
        const double finest = l.values.value[l.values.n - 1];
        (void)fprintf(file, ", %.6g", l.limit.value);
        if (isfinite(l.limit.order)) (void)fprintf(file, ", order %.2f", l.limit.order);
        (void)fprintf(file, ", grid convergence index of the finest %.3g %%", 100.0 * l.limit.gci_fine / fabs(finest));
    }
    (void)fprintf(file, "\n");
}

static void print_answers(const study *s, FILE *file)
{
    for (int m = 0; m < s->n_metrics; m++) {
        study_answer a[STUDY_MAX_TARGETS];
        const int n = study_answers(s, s->metric[m], a);
        for (int k = 0; k < n && s->n_groups > 1; k++) {
            char text[512];
            study_answer_text(s, &a[k], text, sizeof text);
            (void)fprintf(file, "%s\n", text);
        }
        const double least = study_least_level(s, s->metric[m]);
        if (least > STUDY_ROUND_OFF && s->n_groups > 1)
            (void)fprintf(file, "below %.2g %% in %s nothing is chosen: the reference is good for %.2g %%\n",
                          100.0 * least, s->metric[m], 50.0 * least);
    }
}

static void print_timing(const study *s, FILE *file)
{
    bool crowded = false;
    for (size_t i = 0; i < s->n; i++)
        crowded = crowded || (s->plan.repeat == 0 && study_is_done(&s->list[i]) && !s->run[i].alone);
    if (s->plan.repeat > 0)
        (void)fprintf(
            file,
            "times: the best of %d, alone on one thread, of short cases the best of more, without that of outputs",
            s->plan.repeat);
    if (crowded)
        (void)fprintf(file, "times: not to be compared, as cases ran side by side (--repeat N times them alone)");
    if (study_is_disturbed(s))
        (void)fprintf(file, "%sother programs used the machine during the disturbed ones",
                      s->plan.repeat > 0 || crowded ? "; " : "times: ");
    if (s->plan.repeat > 0 || crowded || study_is_disturbed(s)) (void)fprintf(file, "\n");
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].timing.differs)
            (void)fprintf(file, "%s: repeated runs gave different results, which must not be: please report it\n",
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
        (void)fprintf(file, "%s: %s\n", list[i].met ? "met" : "MISSED", text);
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
        if (reason) (void)fprintf(file, "refused, %s: %s\n", s->run[i].label, reason);
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
                (void)fprintf(file, "warned, %s: %s\n", s->list[i].run->label, r->warnings[k]);
            else
                more++;
        }
    }
    if (more > 0) (void)fprintf(file, "warned: %d more, in the summary.json of the cases\n", more);
}

floe_status study_print(const study *s, FILE *file)
{
    if (s->title[0]) (void)fprintf(file, "%s\n", s->title);
    print_names(s, file);
    for (size_t i = 0; i < s->n; i++) print_case(s, &s->list[i], file);
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

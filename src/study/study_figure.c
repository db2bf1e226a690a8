/* Figures of a study: errors against spacing, work and time; quantities against spacing. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "draw/plot.h"
#include "run/run_errors.h"
#include "study/profile.h"

#include <math.h>
#include <string.h>

enum { PANELS = STUDY_COSTS, Y_LABEL = 96 };

/* What the curves of a figure point into. */
typedef struct drawing {
    context *ctx; /* not owned */
    plot_panel *panel;
    plot_series *series;
    char (*label)[Y_LABEL];
    double *number;
    size_t n_panels, n_series, n_numbers;
} drawing;

static floe_status drawing_make(drawing *d, const study *s, size_t panels)
{
    *d = (drawing){.ctx = s->ctx};
    TRY(memory_new(d->ctx, &d->panel, panels, sizeof *d->panel));
    TRY(memory_new(d->ctx, &d->series, panels * (s->n_groups + 1), sizeof *d->series));
    TRY(memory_new(d->ctx, &d->label, panels, sizeof *d->label));
    return memory_new(d->ctx, &d->number, panels * 4 * s->n, sizeof *d->number);
}

static void drawing_free(drawing *d)
{
    memory_free(d->ctx, &d->panel);
    memory_free(d->ctx, &d->series);
    memory_free(d->ctx, &d->label);
    memory_free(d->ctx, &d->number);
}

/* A new curve with space for n points; x and y are to be filled. */
static plot_series *add_series(drawing *d, const char *name, int colour, double **x, double **y, size_t reserved)
{
    plot_series *series = &d->series[d->n_series++];
    *x = &d->number[d->n_numbers];
    *y = *x + reserved;
    d->n_numbers += 2 * reserved;
    *series = (plot_series){.name = name, .style = PLOT_LINES_POINTS, .colour = colour, .x = *x, .y = *y};
    return series;
}

static void add_point(plot_series *series, double *x, double *y, double at, double value)
{
    x[series->n] = at;
    y[series->n++] = value;
}

/* The next case of a group in the order of `over`, so that a curve goes from the coarsest case to the finest; NULL: no
 * more. */
static const study_case *next_case(const study *s, size_t group, const study_case *last)
{
    const study_case *next = NULL;
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        if (one->group != group || (last && !(one->over < last->over))) continue;
        if (!next || one->over > next->over) next = one;
    }
    return next;
}

static size_t group_size(const study *s, size_t group)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) n += s->list[i].group == group;
    return n;
}

static plot_panel *begin_panel(drawing *d, const char *x_label, const char *name, const char *unit)
{
    plot_panel *panel = &d->panel[d->n_panels];
    char *label = d->label[d->n_panels++];
    (void)snprintf(label, Y_LABEL, "%s%s%s%s", name, unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
    *panel = (plot_panel){.x_label = x_label, .y_label = label, .series = &d->series[d->n_series]};
    return panel;
}

/* The marked set: what is neither beaten in error nor in cost. */
static void add_pareto_front(const study *s, drawing *d, const char *metric, study_cost cost, double scale,
                             plot_panel *panel)
{
    double *x, *y;
    plot_series *series = add_series(d, "Pareto front", 0, &x, &y, s->n);
    series->style = PLOT_POINTS;
    series->emphasis = true;
    for (size_t i = 0; i < s->n; i++) {
        if (study_is_on_front(s, i, metric, cost))
            add_point(series, x, y, study_cost_of(&s->list[i], cost), scale * study_error(&s->list[i], metric));
    }
    panel->n_series++;
}

static void add_error_panel(const study *s, drawing *d, const char *metric, study_cost cost)
{
    const char *const x_label[] = {"processor time without outputs (s)", "updates of points and cells",
                                   study_over_label(s)};
    const double scale = error_is_relative(metric) ? 100.0 : 1.0;
    plot_panel *panel = begin_panel(d, x_label[cost], metric, error_unit(metric, s->dimensionless));
    panel->log_x = panel->log_y = true;
    for (size_t g = 0; g < s->n_groups; g++) {
        double *x, *y;
        plot_series *series = add_series(d, s->group[g], (int)g, &x, &y, group_size(s, g));
        for (const study_case *one = next_case(s, g, NULL); one; one = next_case(s, g, one)) {
            const double error = study_error(one, metric);
            if (error > 0.0) add_point(series, x, y, study_cost_of(one, cost), scale * error);
        }
        panel->n_series++;
    }
    if (cost == STUDY_H) {
        panel->slope[0] = 1.0;
        panel->slope[1] = 2.0;
        panel->n_slopes = 2;
    } else {
        add_pareto_front(s, d, metric, cost, scale, panel);
    }
}

static bool has_data(const study *s, const char *metric)
{
    for (size_t i = 0; i < s->n; i++) {
        if (study_error(&s->list[i], metric) > 0.0) return true;
    }
    return false;
}

static floe_status draw_errors(const study *s, bool *missing)
{
    static const study_cost order[PANELS] = {STUDY_H, STUDY_UPDATES, STUDY_SECONDS};
    drawing d;
    floe_status status = drawing_make(&d, s, (size_t)s->n_metrics * PANELS);
    for (int m = 0; m < s->n_metrics && status == FLOE_OK; m++) {
        for (int k = 0; k < PANELS && has_data(s, s->metric[m]); k++) add_error_panel(s, &d, s->metric[m], order[k]);
    }
    const plot_figure figure = {
        .name = "errors", .title = s->title, .columns = PANELS, .panel = d.panel, .n_panels = d.n_panels};
    if (status == FLOE_OK && d.n_panels > 0) status = figure_write(s->ctx, s->options->dir, &figure, missing);
    drawing_free(&d);
    return status;
}

static void add_quantity_panel(const study *s, drawing *d, int q)
{
    plot_panel *panel = begin_panel(d, study_over_label(s), s->plan.quantity[q], "");
    for (size_t g = 0; g < s->n_groups; g++) {
        double *x, *y;
        plot_series *series = add_series(d, s->group[g], (int)g, &x, &y, group_size(s, g));
        for (const study_case *one = next_case(s, g, NULL); one; one = next_case(s, g, one)) {
            if (isfinite(one->quantity[q])) add_point(series, x, y, one->over, one->quantity[q]);
        }
        panel->n_series++;
    }
}

static floe_status draw_quantities(const study *s, bool *missing)
{
    drawing d;
    if (s->plan.n_quantities == 0) return FLOE_OK;
    floe_status status = drawing_make(&d, s, (size_t)s->plan.n_quantities);
    for (int q = 0; q < s->plan.n_quantities && status == FLOE_OK; q++) add_quantity_panel(s, &d, q);
    const plot_figure figure = {.name = "quantities",
                                .title = s->title,
                                .columns = d.n_panels > 1 ? 2 : 1,
                                .panel = d.panel,
                                .n_panels = d.n_panels};
    if (status == FLOE_OK) status = figure_write(s->ctx, s->options->dir, &figure, missing);
    drawing_free(&d);
    return status;
}

/* The finest case of a group that has come to its end with a profile; NULL if none. */
static const study_case *finest_profile(const study *s, size_t group)
{
    const study_case *best = NULL;
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        if (one->group == group && study_is_done(one) && (!best || one->h < best->h)) best = one;
    }
    return best;
}

static floe_status draw_profile(const study *s, bool *missing)
{
    profile_source source[PLOT_COLOURS];
    size_t n = 0;
    if (s->n_groups > PLOT_COLOURS) return FLOE_OK; /* nobody could tell them apart */
    for (size_t g = 0; g < s->n_groups; g++) {
        const study_case *one = finest_profile(s, g);
        if (!one) continue;
        source[n].name = s->group[g];
        source[n].colour = (int)g;
        source[n].h = one->h;
        (void)snprintf(source[n].path, sizeof source[n].path, "%s/%s/profile.csv", s->options->dir, one->run->folder);
        n++;
    }
    return profile_draw(s->ctx, s->options->dir, s->exact, source, n, s->dimensionless, missing);
}

floe_status study_write_figures(const study *s)
{
    bool missing = false; /* gnuplot: said once */
    TRY(draw_errors(s, &missing));
    TRY(draw_quantities(s, &missing));
    return draw_profile(s, &missing);
}

/* Errors of cases as plots: over the spacing, the run time, the updates. */
#include "base/memory.h"
#include "report/case_list.h"
#include "run/run_errors.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* What stands along x. */
typedef enum measure { BY_PLACE, BY_WALL, BY_UPDATES, N_MEASURES } measure;

/* One plot; memory for its curves: each at most all cases, one for each variant and one for the front. */
typedef struct error_plot {
    char name[PLOT_STEM], title[160], x_label[300], y_label[160];
    double *x, *y;      /* counted memory */
    const char **label; /* counted memory */
    plot_series series[CASE_MAX_VARIANTS + 1];
    plot_panel panel;
} error_plot;

static double measure_of_case(const case_list *c, const case_entry *e, measure m)
{
    return m == BY_PLACE ? case_place(c, e) : m == BY_WALL ? e->wall : e->updates;
}

static double shown_error(const case_entry *e, const char *metric)
{
    return case_error(e, metric) * (error_is_relative(metric) ? 100.0 : 1.0);
}

static void add_pareto_front(error_plot *h, const case_list *c, const char *metric, size_t *front)
{
    const size_t n = case_front(c, metric, front), at = c->n * (size_t)c->n_variants;
    for (size_t i = 0; i < n; i++) {
        h->x[at + i] = c->list[front[i]].wall;
        h->y[at + i] = shown_error(&c->list[front[i]], metric);
    }
    h->series[h->panel.n_series++] = (plot_series){.name = "best for their time",
                                                   .style = PLOT_LINES_POINTS,
                                                   .emphasis = true,
                                                   .x = h->x + at,
                                                   .y = h->y + at,
                                                   .n = n};
}

static void add_variant(error_plot *h, const case_list *c, const char *metric, measure m, int variant)
{
    const size_t at = c->n * (size_t)variant;
    const bool curve = c->along_h || c->along_value;
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->list[i];
        if (e->colour != variant || !isfinite(case_error(e, metric))) continue;
        h->x[at + n] = measure_of_case(c, e, m);
        h->y[at + n] = shown_error(e, metric);
        h->label[at + n++] = m == BY_PLACE ? NULL : e->value;
    }
    h->series[h->panel.n_series++] = (plot_series){.name = c->variant[variant],
                                                   .style = curve ? PLOT_LINES_POINTS : PLOT_POINTS,
                                                   .colour = variant,
                                                   .x = h->x + at,
                                                   .y = h->y + at,
                                                   .label = m == BY_WALL ? h->label + at : NULL,
                                                   .n = n};
}

static void name_plot(error_plot *h, const case_list *c, const char *stem, const char *metric, measure m)
{
    static const char *const names[N_MEASURES] = {"place", "time", "updates"};
    static const char *const titles[N_MEASURES] = {"against spacing", "against run time", "against updates"};
    static const char *const x_labels[N_MEASURES] = {"spacing h", "run time without outputs (s)",
                                                     "updates of points and cells"};
    const char *unit = error_unit(metric, c->dimensionless);
    (void)snprintf(h->name, sizeof h->name, "%.60s-%.40s-%s", stem, metric, names[m]);
    if (m == BY_PLACE && !c->along_h) {
        (void)snprintf(h->title, sizeof h->title, "%.60s against %.60s", metric, c->axis);
        (void)snprintf(h->x_label, sizeof h->x_label, "%s", c->axis);
    } else {
        (void)snprintf(h->title, sizeof h->title, "%.60s %s", metric, titles[m]);
        (void)snprintf(h->x_label, sizeof h->x_label, "%s%s", x_labels[m],
                       m == BY_PLACE && !c->dimensionless ? " (m)" : "");
    }
    (void)snprintf(h->y_label, sizeof h->y_label, "%.60s%s%s%s", metric, unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
    h->panel.x_label = h->x_label;
    h->panel.y_label = h->y_label;
}

static void add_slopes(error_plot *h)
{
    h->panel.slope[0] = 1.0;
    h->panel.slope[1] = 2.0;
    h->panel.n_slopes = 2;
}

/* True when all that is along x is positive, and so may be logarithmic. */
static bool is_positive(const case_list *c, measure m)
{
    for (size_t i = 0; i < c->n; i++) {
        if (!(measure_of_case(c, &c->list[i], m) > 0.0)) return false;
    }
    return true;
}

static floe_status fill_error_plot(error_plot *h, const case_list *c, const char *stem, const char *metric, measure m)
{
    const size_t reserved = c->n * (size_t)(c->n_variants + 1);
    size_t *front;
    TRY(memory_new(c->ctx, &h->x, reserved, sizeof *h->x));
    TRY(memory_new(c->ctx, &h->y, reserved, sizeof *h->y));
    TRY(memory_new(c->ctx, &h->label, reserved, sizeof *h->label));
    name_plot(h, c, stem, metric, m);
    h->panel.log_x = is_positive(c, m);
    h->panel.log_y = true;
    h->panel.series = h->series;
    if (m == BY_WALL) {
        TRY(memory_new(c->ctx, &front, c->n, sizeof *front));
        add_pareto_front(h, c, metric, front);
        memory_free(c->ctx, &front);
    }
    for (int k = 0; k < c->n_variants; k++) add_variant(h, c, metric, m, k);
    if (m == BY_PLACE && c->along_h) add_slopes(h);
    return FLOE_OK;
}

static void free_plot(context *ctx, error_plot *h)
{
    memory_free(ctx, &h->x);
    memory_free(ctx, &h->y);
    memory_free(ctx, &h->label);
}

static floe_status metric_plots(page *p, const case_list *c, const char *stem, const char *metric)
{
    error_plot *plot;
    plot_figure figure[N_MEASURES];
    size_t n = 0;
    floe_status status = FLOE_OK;
    TRY(memory_new(p->ctx, &plot, N_MEASURES, sizeof *plot));
    for (int m = 0; m < N_MEASURES && status == FLOE_OK; m++) {
        if (m == BY_PLACE && !c->along_h && !c->along_value) continue;
        status = fill_error_plot(&plot[n], c, stem, metric, (measure)m);
        figure[n] = (plot_figure){
            .name = plot[n].name, .title = plot[n].title, .panel = &plot[n].panel, .untitled = true, .n_panels = 1};
        n++;
    }
    if (status == FLOE_OK) status = page_figures(p, figure, n);
    for (int m = 0; m < N_MEASURES; m++) free_plot(p->ctx, &plot[m]);
    memory_free(p->ctx, &plot);
    return status;
}

/* One quantity over the place on the curve. */
static floe_status fill_quantity(error_plot *h, const case_list *c, const char *stem, const char *quantity)
{
    TRY(memory_new(c->ctx, &h->x, c->n * (size_t)c->n_variants, sizeof *h->x));
    TRY(memory_new(c->ctx, &h->y, c->n * (size_t)c->n_variants, sizeof *h->y));
    (void)snprintf(h->name, sizeof h->name, "%.60s-%.40s", stem, quantity);
    (void)snprintf(h->title, sizeof h->title, "%.100s", quantity);
    (void)snprintf(h->x_label, sizeof h->x_label, "%s%s", c->along_h ? "spacing h" : c->axis,
                   c->along_h && !c->dimensionless ? " (m)" : "");
    for (int variant = 0; variant < c->n_variants; variant++) {
        const size_t at = c->n * (size_t)variant;
        size_t n = 0;
        for (size_t i = 0; i < c->n; i++) {
            const case_entry *e = &c->list[i];
            if (e->colour != variant || !case_is_done(e)) continue;
            h->x[at + n] = case_place(c, e);
            h->y[at + n++] = json_number_of(json_object_get(e->run, "quantities"), quantity);
        }
        h->series[h->panel.n_series++] = (plot_series){.name = c->variant[variant],
                                                       .style = PLOT_LINES_POINTS,
                                                       .colour = variant,
                                                       .x = h->x + at,
                                                       .y = h->y + at,
                                                       .n = n};
    }
    h->panel.x_label = h->x_label;
    h->panel.series = h->series;
    return FLOE_OK;
}

static floe_status quantity_plots(page *p, const case_list *c, const char *stem)
{
    error_plot *plot;
    plot_figure figure[CASE_MAX_METRICS];
    floe_status status = FLOE_OK;
    if (c->n_quantities == 0 || !(c->along_h || c->along_value)) return FLOE_OK;
    TRY(memory_new(p->ctx, &plot, (size_t)c->n_quantities, sizeof *plot));
    for (int k = 0; k < c->n_quantities && status == FLOE_OK; k++) {
        status = fill_quantity(&plot[k], c, stem, c->quantity[k]);
        figure[k] = (plot_figure){
            .name = plot[k].name, .title = plot[k].title, .panel = &plot[k].panel, .untitled = true, .n_panels = 1};
    }
    if (status == FLOE_OK) status = page_figures(p, figure, (size_t)c->n_quantities);
    for (int k = 0; k < c->n_quantities; k++) free_plot(p->ctx, &plot[k]);
    memory_free(p->ctx, &plot);
    return status;
}

floe_status case_plots(page *p, const case_list *c, const char *stem)
{
    if (c->n < 2) return FLOE_OK;
    for (int k = 0; k < c->n_metrics; k++) TRY(metric_plots(p, c, stem, c->metric[k]));
    return quantity_plots(p, c, stem);
}

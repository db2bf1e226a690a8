/* profile.csv: what was measured along a line, beside the exact solution. */
#include "report/run_section.h"

#include "base/memory.h"
#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PROFILES = 12, MAX_RUNS = 8 };

typedef struct point {
    double x, y;
} point;

static int by_place(const void *a, const void *b)
{
    const double x = ((const point *)a)->x, y = ((const point *)b)->x;
    return (x > y) - (x < y);
}

/* One quantity: the exact curve, sorted along the line, and the points of each run. */
typedef struct profile_plot {
    char name[PLOT_STEM], x_label[CSV_NAME], y_label[CSV_NAME];
    double *value; /* counted memory: x and y of all series, one after another */
    size_t used;
    plot_series series[MAX_RUNS + 1];
    plot_panel panel;
} profile_plot;

static bool is_run(const csv_column *by, size_t row, const char *run)
{
    return !by || strcmp(by->text[row], run) == 0;
}

/* Takes space for n points out of the plot's memory. */
static void reserve_curve(profile_plot *h, size_t n, double **x, double **y)
{
    *x = h->value + h->used;
    *y = *x + n;
    h->used += 2 * n;
}

static floe_status add_exact(profile_plot *h, const csv_table *t, const csv_column *at, const csv_column *exact)
{
    point *sorted;
    double *x, *y;
    TRY(memory_new(t->ctx, &sorted, t->n_rows, sizeof *sorted));
    for (size_t i = 0; i < t->n_rows; i++) sorted[i] = (point){at->value[i], exact->value[i]};
    qsort(sorted, t->n_rows, sizeof *sorted, by_place);
    reserve_curve(h, t->n_rows, &x, &y);
    for (size_t i = 0; i < t->n_rows; i++) {
        x[i] = sorted[i].x;
        y[i] = sorted[i].y;
    }
    memory_free(t->ctx, &sorted);
    h->series[h->panel.n_series++] =
        (plot_series){.name = "exact", .style = PLOT_LINES, .emphasis = true, .x = x, .y = y, .n = t->n_rows};
    return FLOE_OK;
}

static void add_run(profile_plot *h, const csv_table *t, const csv_column *at, const csv_column *measured,
                    const csv_column *by, const char *run, int colour)
{
    double *x, *y;
    size_t n = 0;
    reserve_curve(h, t->n_rows, &x, &y);
    for (size_t i = 0; i < t->n_rows; i++) {
        if (!is_run(by, i, run)) continue;
        x[n] = at->value[i];
        y[n++] = measured->value[i];
    }
    h->series[h->panel.n_series++] =
        (plot_series){.name = run, .style = PLOT_POINTS, .colour = colour, .x = x, .y = y, .n = n};
}

/* The distinct runs; one without a column that tells them apart. */
static int list_runs(const csv_table *t, const csv_column *by, const char *run[MAX_RUNS])
{
    int n = 0;
    if (!by) {
        run[0] = "floe";
        return 1;
    }
    for (size_t i = 0; i < t->n_rows; i++) {
        int k = 0;
        while (k < n && strcmp(run[k], by->text[i]) != 0) k++;
        if (k == n && n < MAX_RUNS) run[n++] = by->text[i];
    }
    return n;
}

static floe_status fill_profile_plot(profile_plot *h, const csv_table *t, const csv_column *at,
                                     const csv_column *measured, const csv_column *exact, const csv_column *by)
{
    const char *run[MAX_RUNS];
    const int runs = list_runs(t, by, run);
    TRY(memory_new(t->ctx, &h->value, 2 * t->n_rows * (size_t)(runs + 1), sizeof *h->value));
    for (int k = 0; k < runs; k++) add_run(h, t, at, measured, by, run[k], k);
    TRY(add_exact(h, t, at, exact)); /* last: over the points, which would hide it */
    (void)snprintf(h->x_label, sizeof h->x_label, "%.100s (%s)", at->name, at->unit[0] ? at->unit : "1");
    (void)snprintf(h->y_label, sizeof h->y_label, "%.100s (%s)", measured->name,
                   measured->unit[0] ? measured->unit : "1");
    h->panel.x_label = h->x_label;
    h->panel.y_label = h->y_label;
    h->panel.series = h->series;
    return FLOE_OK;
}

static floe_status make_plots(const csv_table *t, const char *stem, const char *by, profile_plot *list, size_t *n)
{
    const csv_column *runs = by ? csv_find(t, by) : NULL;
    const csv_column *at = csv_find(t, "r") ? csv_find(t, "r") : csv_find(t, "x");
    for (size_t k = 0; at && k < t->n_columns && *n < MAX_PROFILES; k++) {
        char name[CSV_NAME + 8];
        (void)snprintf(name, sizeof name, "exact_%s", t->column[k].name);
        const csv_column *exact = csv_find(t, name);
        if (!exact) continue;
        profile_plot *h = &list[(*n)++];
        (void)snprintf(h->name, sizeof h->name, "%.60s-profile-%.40s", stem, t->column[k].name);
        TRY(fill_profile_plot(h, t, at, &t->column[k], exact, runs));
    }
    return FLOE_OK;
}

static floe_status draw_profile(page *p, const csv_table *t, const char *stem, const char *by)
{
    profile_plot *list;
    plot_figure figure[MAX_PROFILES];
    size_t n = 0;
    TRY(memory_new(p->ctx, &list, MAX_PROFILES, sizeof *list));
    floe_status status = make_plots(t, stem, by, list, &n);
    for (size_t i = 0; i < n; i++)
        figure[i] = (plot_figure){.name = list[i].name,
                                  .title = list[i].panel.y_label,
                                  .panel = &list[i].panel,
                                  .untitled = true,
                                  .n_panels = 1};
    if (n > 0) page_heading(p, "Beside the exact solution, at the end");
    if (status == FLOE_OK) status = page_figures(p, figure, n);
    for (size_t i = 0; i < n; i++) memory_free(p->ctx, &list[i].value);
    memory_free(p->ctx, &list);
    return status;
}

floe_status run_profile(page *p, const char *dir, const char *file, const char *stem, const char *by)
{
    char path[PAGE_PATH + 32];
    csv_table t;
    (void)snprintf(path, sizeof path, "%s/%s", dir, file);
    if (!file_exists(path)) return FLOE_OK;
    floe_status status = csv_read(&t, p->ctx, path);
    if (status == FLOE_OK && t.n_rows > 0) status = draw_profile(p, &t, stem, by);
    csv_free(&t);
    return status;
}

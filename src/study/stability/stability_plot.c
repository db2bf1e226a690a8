/* A search or a map as a figure. */
#include "draw/plot.h"
#include "study/stability/stability.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Storage of a figure: panels, series, and the numbers of all series one after the other. */
typedef struct canvas {
    plot_panel *panel;
    plot_series *series;
    double *x, *y;
    char (*name)[STABILITY_LABEL];
    size_t used; /* of x and y */
} canvas;

static floe_status canvas_make(canvas *c, context *ctx, size_t panels, size_t series, size_t points)
{
    *c = (canvas){0};
    TRY(memory_new(ctx, &c->panel, panels, sizeof *c->panel));
    TRY(memory_new(ctx, &c->series, series, sizeof *c->series));
    TRY(memory_new(ctx, &c->name, panels + series, sizeof *c->name));
    TRY(memory_new(ctx, &c->x, points, sizeof *c->x));
    return memory_new(ctx, &c->y, points, sizeof *c->y);
}

static void canvas_free(canvas *c, context *ctx)
{
    memory_free(ctx, &c->y);
    memory_free(ctx, &c->x);
    memory_free(ctx, &c->name);
    memory_free(ctx, &c->series);
    memory_free(ctx, &c->panel);
}

static void add_point(canvas *c, plot_series *to, double x, double y)
{
    if (to->n == 0) {
        to->x = c->x + c->used;
        to->y = c->y + c->used;
    }
    /* in the order of x, as lines need it */
    size_t at = c->used++;
    for (; at > c->used - 1 - to->n && c->x[at - 1] > x; at--) {
        c->x[at] = c->x[at - 1];
        c->y[at] = c->y[at - 1];
    }
    c->x[at] = x;
    c->y[at] = y;
    to->n++;
}

/* The combination's values after the first key, which has a panel of its own where there are several. */
static void name_series(const stability *s, size_t set, char name[STABILITY_LABEL])
{
    const int first = s->n_each > 1 ? 1 : 0;
    size_t used = 0;
    name[0] = '\0';
    for (int i = first; i < s->n_each && used < STABILITY_LABEL; i++)
        used += (size_t)snprintf(name + used, STABILITY_LABEL - used, "%s%s", i > first ? ", " : "",
                                 s->each[i].value[s->set[set].value[i]]);
}

static bool is_positive(const stability *s)
{
    for (size_t i = 0; i < s->n_probes; i++) {
        if (!(s->probe[i].x[0] > 0.0)) return false;
    }
    return true;
}

static void fill_energy(const stability *s, canvas *c, size_t panels, const char *x_label)
{
    const size_t each = s->n_sets / panels;
    const double scale = isfinite(s->relative_to) ? s->relative_to : 1.0;
    for (size_t k = 0; k < s->n_sets; k++) {
        plot_series *one = &c->series[k];
        name_series(s, k, c->name[k]);
        *one = (plot_series){.name = c->name[k], .style = PLOT_LINES_POINTS, .colour = (int)(k % each)};
        for (size_t i = 0; i < s->n_probes; i++) {
            const stability_probe *p = &s->probe[i];
            if (p->set == k && p->energy.ratio > 0.0) add_point(c, one, p->x[0] / scale, p->energy.ratio);
        }
    }
    for (size_t k = 0; k < panels; k++) {
        char *title = c->name[s->n_sets + k];
        if (panels > 1) (void)snprintf(title, STABILITY_LABEL, "%s=%s", s->each[0].key, s->each[0].value[k]);
        c->panel[k] = (plot_panel){.title = title,
                                   .x_label = x_label,
                                   .y_label = "energy ratio",
                                   .log_x = is_positive(s),
                                   .log_y = true,
                                   .series = c->series + k * each,
                                   .n_series = each};
    }
}

static floe_status plot_energy(const stability *s)
{
    const size_t panels = s->n_each > 1 ? (size_t)s->each[0].n_values : 1;
    char x_label[256];
    canvas c;
    if (isfinite(s->relative_to))
        (void)snprintf(x_label, sizeof x_label, "%s / %g%s", s->over[0].key, s->relative_to, s->unit);
    else
        (void)snprintf(x_label, sizeof x_label, "%s%s", s->over[0].key, s->unit);
    floe_status status = canvas_make(&c, s->ctx, panels, s->n_sets, s->n_probes + 1);
    if (status == FLOE_OK) {
        fill_energy(s, &c, panels, x_label);
        const plot_figure figure = {
            .name = "energy", .title = s->title, .columns = panels > 1 ? 2 : 1, .panel = c.panel, .n_panels = panels};
        status = plot_write(s->ctx, s->dir, &figure);
    }
    canvas_free(&c, s->ctx);
    return status;
}

static bool is_numeric(const scene_axis *axis)
{
    for (int i = 0; i < axis->n_values; i++) {
        char *end;
        (void)strtod(axis->value[i], &end);
        if (end == axis->value[i]) return false;
    }
    return true;
}

/* Where a value stands on its axis: at its number, or, for words, at its place in the list from 1. */
static double place_of(const scene_axis *axis, int i)
{
    return is_numeric(axis) ? strtod(axis->value[i], NULL) : i + 1;
}

static bool is_logarithmic(const scene_axis *axis)
{
    double least = INFINITY, most = 0.0;
    for (int i = 0; i < axis->n_values; i++) {
        least = fmin(least, place_of(axis, i));
        most = fmax(most, place_of(axis, i));
    }
    return is_numeric(axis) && least > 0.0 && most / least > 10.0;
}

static void label_axis(const scene_axis *axis, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s", axis->key);
    if (is_numeric(axis)) return;
    for (int i = 0; i < axis->n_values && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s %d %s", i > 0 ? "," : ":", i + 1, axis->value[i]);
}

/* A series a verdict, in every panel. */
static void fill_map(const stability *s, canvas *c, size_t set)
{
    for (int v = 0; v < VERDICT_COUNT; v++) {
        plot_series *one = &c->series[set * VERDICT_COUNT + (size_t)v];
        *one = (plot_series){.name = verdict_name((verdict)v), .style = PLOT_POINTS, .colour = v};
        for (int i = 0; i < s->over[0].n_values; i++) {
            for (int k = 0; k < s->over[1].n_values; k++) {
                const stability_probe *p = stability_cell(s, set, i, k);
                if (p && p->verdict == (verdict)v)
                    add_point(c, one, place_of(&s->over[1], k), place_of(&s->over[0], i));
            }
        }
    }
}

static floe_status plot_map(const stability *s)
{
    char label[2][512];
    canvas c;
    const size_t series = s->n_sets * VERDICT_COUNT;
    for (int i = 0; i < 2; i++) label_axis(&s->over[i], label[i], sizeof label[i]);
    floe_status status = canvas_make(&c, s->ctx, s->n_sets, series, s->n_probes + 1);
    for (size_t k = 0; status == FLOE_OK && k < s->n_sets; k++) {
        char *title = c.name[series + k];
        stability_set_label(s, k, title);
        fill_map(s, &c, k);
        c.panel[k] = (plot_panel){.title = title,
                                  .x_label = label[1],
                                  .y_label = label[0],
                                  .log_x = is_logarithmic(&s->over[1]),
                                  .log_y = is_logarithmic(&s->over[0]),
                                  .series = c.series + k * VERDICT_COUNT,
                                  .n_series = VERDICT_COUNT};
    }
    const plot_figure figure = {
        .name = "map", .title = s->title, .columns = s->n_sets > 1 ? 2 : 1, .panel = c.panel, .n_panels = s->n_sets};
    if (status == FLOE_OK) status = plot_write(s->ctx, s->dir, &figure);
    canvas_free(&c, s->ctx);
    return status;
}

floe_status stability_plot(const stability *s)
{
    if (s->n_probes == 0) return FLOE_OK;
    return stability_is_map(s) ? plot_map(s) : plot_energy(s);
}

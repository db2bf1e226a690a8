#include "study/curves.h"

#include "base/memory.h"

floe_status curves_make(curves *c, context *ctx, size_t panels, size_t series, size_t points, size_t texts)
{
    *c = (curves){.ctx = ctx};
    TRY(memory_new(ctx, &c->panel, panels, sizeof *c->panel));
    TRY(memory_new(ctx, &c->series, series, sizeof *c->series));
    TRY(memory_new(ctx, &c->text, texts, sizeof *c->text));
    TRY(memory_new(ctx, &c->x, points, sizeof *c->x));
    return memory_new(ctx, &c->y, points, sizeof *c->y);
}

void curves_free(curves *c)
{
    memory_free(c->ctx, &c->panel);
    memory_free(c->ctx, &c->series);
    memory_free(c->ctx, &c->text);
    memory_free(c->ctx, &c->x);
    memory_free(c->ctx, &c->y);
}

char *curves_text(curves *c)
{
    return c->text[c->n_texts++];
}

char *curves_label(curves *c, const char *name, const char *unit)
{
    char *text = curves_text(c);
    (void)snprintf(text, CURVES_TEXT, "%s%s%s%s", name, unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
    return text;
}

plot_panel *curves_panel(curves *c, plot_panel like)
{
    plot_panel *panel = &c->panel[c->n_panels++];
    *panel = like;
    panel->series = &c->series[c->n_series];
    return panel;
}

plot_series *curves_series(curves *c, plot_series like)
{
    plot_series *series = &c->series[c->n_series++];
    *series = like;
    if (!series->x) series->x = c->x + c->n_points;
    if (!series->y) series->y = c->y + c->n_points;
    c->panel[c->n_panels - 1].n_series++;
    return series;
}

void curves_point(curves *c, double x, double y)
{
    c->x[c->n_points] = x;
    c->y[c->n_points++] = y;
    c->series[c->n_series - 1].n++;
}

void curves_point_in_order(curves *c, double x, double y)
{
    size_t at = c->n_points, first = at - c->series[c->n_series - 1].n;
    curves_point(c, x, y);
    for (; at > first && c->x[at - 1] > x; at--) {
        c->x[at] = c->x[at - 1];
        c->y[at] = c->y[at - 1];
    }
    c->x[at] = x;
    c->y[at] = y;
}

floe_status curves_write(const curves *c, const char *dir, plot_figure figure, plot_names *names)
{
    if (c->n_panels == 0) return FLOE_OK;
    if (figure.columns == 0) figure.columns = c->n_panels > 1 ? 2 : 1;
    figure.panel = c->panel;
    figure.n_panels = c->n_panels;
    return plot_write_data(c->ctx, dir, &figure, names);
}

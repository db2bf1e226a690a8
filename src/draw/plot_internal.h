/* What the files of a plot share. Private to src/draw. */
#ifndef DRAW_PLOT_INTERNAL_H
#define DRAW_PLOT_INTERNAL_H

#include "base/strbuf.h"
#include "draw/plot.h"

/* A figure whose long curves hold fewer points; the rest is the original's. */
typedef struct plot_thin {
    plot_figure figure;
    plot_panel *panel; /* owned, as are the next two; NULL where nothing was left out */
    plot_series *series;
    double *value;
} plot_thin;

/* Leaves out what `figure->most` asks for. plot_thin_free afterwards, whatever is returned. */
floe_status plot_thin_make(plot_thin *t, context *ctx, const plot_figure *figure);
void plot_thin_free(plot_thin *t, context *ctx);

/* Colours of light pages, in gnuplot's way of writing; plot_svg.c gives each its counterpart on dark ones. */
#define PLOT_INK "#24292f"
#define PLOT_GRID "#d8dee4"
#define PLOT_PAPER "#ffffff"

/* An axis as it is drawn. */
typedef struct plot_axis {
    bool log;
    bool any;      /* there is something to draw */
    double lo, hi; /* both > 0 when logarithmic */
} plot_axis;

/* True when the value can be drawn on such an axis. */
bool plot_drawable(bool log_axis, double value);
/* Number of a series' points that can be drawn. */
size_t plot_points(const plot_panel *panel, const plot_series *series);
/* The two axes of a panel, with margins around the data; `any` false on both when there are none. */
void plot_axes(const plot_panel *panel, plot_axis *x, plot_axis *y);
/* gnuplot's commands for the range and the tics of an axis, `name` being x or y. */
void plot_append_axis(strbuf *out, char name, const plot_axis *axis);
/* The script that draws the figure to STEM.svg. */
void plot_append_script(strbuf *out, const plot_figure *figure, const char *stem);
/* The figure's data, for people and other programs. */
void plot_append_csv(strbuf *out, const plot_figure *figure);
/* Makes gnuplot's DIR/STEM.svg fit for any page: names of its own for what it refers to, colours for dark pages. What
 * gnuplot has left unfinished is removed; no picture is no failure. */
floe_status plot_finish_svg(context *ctx, const char *dir, const char *stem, const char *title);

/* The palette's colour as "#rrggbb" for light pages (dark false) and dark ones. */
const char *plot_colour(int index, bool dark);

#endif

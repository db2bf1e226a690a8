/* Figures: panels of curves, as data (CSV), as a gnuplot script that runs by itself, and, where gnuplot is there, as
 * SVG. */
#ifndef DRAW_PLOT_H
#define DRAW_PLOT_H

#include "base/context.h"

enum {
    PLOT_COLOURS = 8,    /* in the palette, which colour-blind readers can tell apart; each has its own marker */
    PLOT_MAX_SLOPES = 4, /* of a panel */
    PLOT_STEM = 128      /* characters of a file's stem, NUL included */
};

typedef enum plot_style { PLOT_LINES, PLOT_POINTS, PLOT_LINES_POINTS, PLOT_STEPS } plot_style;

/* A curve. What is not finite, or has no logarithm on a logarithmic axis, is in the data and a gap in the drawing. */
typedef struct plot_series {
    const char *name; /* in the key; "" or NULL: none there */
    plot_style style;
    int colour;               /* of the palette, modulo PLOT_COLOURS: series of one variant share it across panels */
    bool emphasis;            /* a marked set: rings around points, a line in the colour of the text (a Pareto front, an
                                 exact solution) */
    const double *x, *y;      /* n each, not owned */
    const char *const *label; /* n texts beside the points, or NULL; each may be NULL */
    size_t n;
} plot_series;

typedef struct plot_panel {
    const char *title, *x_label, *y_label; /* NULL: none */
    bool log_x, log_y;
    const plot_series *series; /* n_series, not owned; earlier ones are drawn below */
    size_t n_series;
    double slope[PLOT_MAX_SLOPES]; /* for reference, drawn dashed in a corner of a panel with two logarithmic axes */
    int n_slopes;
} plot_panel;

typedef struct plot_figure {
    const char *name;  /* stem of NAME.csv, NAME.gp, NAME.svg, made plain by plot_stem */
    const char *title; /* above the panels; NULL: none */
    bool untitled;     /* the page around shows the title: in the picture it is only for programs that read it */
    int columns;       /* of panels; less than 1: one */
    /* Points of a curve in the picture, the script and the data, which then has 7 digits; 3 or more; 0: all.
     * Corners, peaks and both ends of lines stay, of clouds even parts; curves with labels stay whole. */
    size_t most;
    const plot_panel *panel;
    size_t n_panels;
} plot_figure;

/* Writes DIR/NAME.csv (columns panel, series, x, y, label) and DIR/NAME.gp, and has gnuplot make DIR/NAME.svg, which
 * follows the reader's light or dark page. Without gnuplot, or if it fails, a warning is logged and there is no
 * NAME.svg; data and script are written all the same. FLOE_IO when they cannot be. */
floe_status plot_write(context *ctx, const char *dir, const plot_figure *figure);
/* The same for several figures of different names, by one gnuplot, with one warning. */
floe_status plots_write(context *ctx, const char *dir, const plot_figure *figure, size_t n);

/* The two halves of plots_write, for pages that draw in several goes: the data and script of one figure, then the
 * pictures of several. *missing becomes true when there is no gnuplot, and is left alone otherwise. */
floe_status plot_write_data(context *ctx, const char *dir, const plot_figure *figure);
floe_status plots_draw(context *ctx, const char *dir, const plot_figure *figure, size_t n, bool *missing);

/* True when a curve has more points than the figure's `most`. */
bool plot_is_thinned(const plot_figure *figure);

/* The style that every SVG carries, for a page that holds several of them: <style> with its content. */
struct strbuf;
void plot_append_style(struct strbuf *out);

/* The stem of a file from any text: what is not a letter, a digit, '.', '_' or '-' becomes '_'; never "" or dots
 * alone. */
void plot_stem(const char *text, char stem[PLOT_STEM]);

#endif

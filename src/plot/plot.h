/* Figures: panels of curves, as data (CSV) and a description of the drawing (JSON), of which python/floe makes SVG. */
#ifndef PLOT_PLOT_H
#define PLOT_PLOT_H

#include "base/context.h"

#include <signal.h>

enum {
    PLOT_COLOURS = 8,    /* in the palette, which colour-blind readers can tell apart; each has its own marker */
    PLOT_MAX_SLOPES = 4, /* of a panel */
    PLOT_MAX_NAMES = 8   /* of figures that are drawn together */
};

typedef enum plot_style { PLOT_LINES, PLOT_POINTS, PLOT_LINES_POINTS, PLOT_STEPS } plot_style;

/* A curve. What is not finite, or has no logarithm on a logarithmic axis, is in the data and a gap in the drawing. */
typedef struct plot_series {
    const char *name; /* in the key; "" or NULL: none there */
    plot_style style;
    int colour;          /* of the palette, modulo PLOT_COLOURS: series of one variant share it across panels */
    bool emphasis;       /* a marked set: rings around points, a line in the colour of the text (a Pareto front, an
                            exact solution) */
    const double *x, *y; /* n each, not owned */
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
    const char *name;  /* of NAME.csv, NAME.json, NAME.svg */
    const char *title; /* above the panels; NULL: none */
    int columns;       /* of panels; less than 1: one */
    const plot_panel *panel;
    size_t n_panels;
} plot_figure;

/* The figures of a folder that are to be drawn together. */
typedef struct plot_names {
    const char *name[PLOT_MAX_NAMES]; /* not owned */
    size_t n;
} plot_names;

/* Writes DIR/NAME.csv (columns panel, series, x, y, label) and DIR/NAME.json (docs/outputs.md), removes an earlier
 * DIR/NAME.svg, and adds the name to `names`. FLOE_IO when a file cannot be written. */
floe_status plot_write_data(context *ctx, const char *dir, const plot_figure *figure, plot_names *names);
/* Makes DIR/NAME.svg of each, by one start of Python. Without Python or its packages, or if it fails, a warning is logged
 * and there are none; FLOE_NO_MEMORY is the only failure. */
floe_status plots_draw(context *ctx, const char *dir, const plot_names *names);

/* Runs python/floe with n arguments: "picture", "report" or "plots", and theirs (python/floe/command.py). Its output goes to
 * this process's. *exit_status is the one of floe's command. A signal in *stop (NULL: none is looked for) is passed on.
 * FLOE_IO when Python or a package of it is missing, which the message tells how to install, or when it has failed
 * otherwise than by an exit status of floe's. */
floe_status python_run(context *ctx, const char *const *argument, size_t n, const volatile sig_atomic_t *stop,
                       int *exit_status);

#endif

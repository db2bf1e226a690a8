/* Storage of a figure while it is made: panels, their series, the numbers and the texts of both. What is added belongs to
 * the latest of what it is added to. */
#ifndef STUDY_CURVES_H
#define STUDY_CURVES_H

#include "plot/plot.h"

enum { CURVES_TEXT = 640 };

typedef struct curves {
    context *ctx; /* not owned */
    plot_panel *panel;
    plot_series *series;
    double *x, *y;
    char (*text)[CURVES_TEXT];
    size_t n_panels, n_series, n_points, n_texts;
} curves;

/* Space for as many as there can be. Free it whatever comes back. */
floe_status curves_make(curves *c, context *ctx, size_t panels, size_t series, size_t points, size_t texts);
void curves_free(curves *c);

/* The next text, "" at first. */
char *curves_text(curves *c);
/* A text of a label: NAME (UNIT), or NAME where there is no unit. */
char *curves_label(curves *c, const char *name, const char *unit);
/* Begins a panel like this one, and a series like this one in it. */
plot_panel *curves_panel(curves *c, plot_panel like);
plot_series *curves_series(curves *c, plot_series like);
/* Adds a point to the series; the second keeps the order of x. */
void curves_point(curves *c, double x, double y);
void curves_point_in_order(curves *c, double x, double y);

/* Writes the data of a figure with these panels, in two columns if there are several and it names no number of them.
 * Nothing without a panel. `names`: what is to be drawn of the folder (plots_draw). */
floe_status curves_write(const curves *c, const char *dir, plot_figure figure, plot_names *names);

#endif

/* Field pictures: a PNG of points coloured by one quantity over cells coloured by another, with axes and colour bars.
 * In one dimension: the quantities over x. Drawn by cairo; large type, so that it can be read on a phone. */
#ifndef DRAW_PICTURE_H
#define DRAW_PICTURE_H

#include "base/context.h"

enum { PICTURE_SCALES = 2, PICTURE_WIDTH = 720, PICTURE_MAX_WIDTH = 8000 };

/* What colours (in one dimension: heights) mean. */
typedef struct picture_scale {
    const char *label; /* "von Mises stress" */
    const char *unit;  /* udunits2 spelling, "Pa"; "1": none */
    /* A signed quantity: where its range holds zero, the range is made symmetric and the colours say the sign. */
    bool about_zero;
    double lower, upper; /* the range; lower >= upper: chosen by the values */
} picture_scale;

/* Cells of a uniform grid. No array is owned. */
typedef struct picture_cells {
    int n[2];                    /* along each axis; n[1] is 1 in one dimension */
    double lower[2], spacing[2]; /* m */
    const double *value;         /* n[0] n[1] of them, the first axis fastest; NAN: nothing there */
    int scale;
} picture_cells;

/* Points of one body. No array is owned. */
typedef struct picture_points {
    const char *name;
    size_t n;
    const double *x;     /* m; two numbers a point */
    const double *edge;  /* m; of a square as large as the point. NULL in one dimension */
    const double *value; /* NAN: no colour of its own; NULL: none has */
    int scale;
} picture_points;

typedef struct picture {
    int dim;                   /* 1, or 2 */
    const char *title;         /* may be NULL, as the note may */
    const char *note;          /* what else is to be said: "plane z = 0.5 m" */
    double time;               /* s; NAN: not shown */
    const char *time_unit;     /* "s"; "1" */
    const char *axis[2];       /* "x", "y" */
    const char *unit;          /* of lengths */
    double lower[2], upper[2]; /* m: the domain; one dimension uses the first */
    picture_scale scale[PICTURE_SCALES];
    int n_scales;                 /* 0: points without colours */
    const picture_cells *cells;   /* may be NULL */
    const picture_points *points; /* n_points of them */
    size_t n_points;
    bool dark; /* for a dark page */
    int width; /* px, at most PICTURE_MAX_WIDTH; 0: PICTURE_WIDTH, twice what a phone shows */
} picture;

/* The range that scale `k` has in the picture. */
floe_status picture_range(context *ctx, const picture *p, int k, double *lower, double *upper);
/* Writes the picture as PNG, whole or not at all. FLOE_IO when that fails, FLOE_NO_MEMORY. */
floe_status picture_write(context *ctx, const char *path, const picture *p);

#endif

/* Field pictures of a run: from a snapshot to a PNG. */
#ifndef DRAW_FIELD_PICTURE_H
#define DRAW_FIELD_PICTURE_H

#include "io/snapshot/snapshot_read.h"

enum { FIELD_CAPTION = 512 /* bytes */ };

/* lower >= upper (as all zero): chosen by the values. */
typedef struct field_range {
    double lower, upper; /* in the unit of the snapshot's field */
} field_range;

/* All zero is fine. */
typedef struct field_picture_options {
    /* A field of the points; "none"; NULL: von_mises (in 1-D stress_xx) of solids, pressure of fluids. */
    const char *points;
    /* A field of the cells, and of fluids' points beside solids; "none"; NULL: pressure, else a density. */
    const char *cells;
    field_range range[2]; /* of the first and the second colour bar */
    bool dark;            /* for a dark page */
    int width;            /* px; 0: 720, which is sharp on a phone */
} field_picture_options;

/* Draws snapshot `number` of the run folder `dir` into the PNG `path`, whole or not at all. A field of vectors is shown
 * by its magnitude, or by a component ("velocity_x"). In 3-D it is the plane through the middle, normal to z. `caption`
 * (FIELD_CAPTION bytes, may be NULL) gets what is shown in words, for those who cannot see it. FLOE_BAD_INPUT for a
 * field that is not there; the message lists those that are. FLOE_IO for a snapshot that is missing or damaged, or when
 * the PNG cannot be written. */
floe_status field_picture_write(context *ctx, const char *dir, long number, const field_picture_options *o,
                                const char *path, char *caption);

/* Fills the ranges of `o` that are not given with ones that hold all of these snapshots, for pictures to be set side by
 * side. */
floe_status field_picture_common_range(context *ctx, const char *dir, const snapshot_times *t,
                                       field_picture_options *o);

#endif

/* Membranes as lines of points: who follows whom, and the tangents that follow from it. Private to the mpm room.
 *
 * The order along the line is that of the ids (York 2000, section 3.2). Points themselves are sorted by cell, so that each step
 * their places are first put into a table by number; an entry is written by one point alone, and the tangents have the same bits
 * for any blocks and threads. Normals to unordered points can come in behind the same functions. */
#ifndef MPM_LINE_H
#define MPM_LINE_H

#include "mpm/work.h"

/* An open end that lies on a mirror goes on behind it. */
typedef struct line_end {
    int axis;       /* that the mirror is normal to; -1: the end is free */
    double plane;   /* m: where the mirror stands */
    bool of_itself; /* the next point is the image of the end, else that of the end's neighbour */
} line_end;

typedef struct membrane_line {
    size_t n;  /* points at the start; 0: the body is no membrane */
    double *x; /* 3 n numbers, m: places by number; NAN where a point is lost. Owned */
    bool closed;
    line_end end[2];
} membrane_line;

/* Makes the line of a body from the points that have been seeded. */
floe_status line_make(mpm *s, int body);
void line_free(context *ctx, membrane_line *line);
/* Takes in the places of the points: current ones, or next. */
void line_update(mpm *s, int body, bool next);
/* Unit tangent at the point of a number (0 first), from its neighbours' places. False where it has none: t is left alone. */
bool line_tangent(const mpm *s, int body, size_t number, double t[3]);
/* Number of point k of a body in a block. */
size_t point_number(const mpm *s, int blk, int body, size_t k);

#endif

/* Membranes as lines of points: who follows whom, and the tangents that follow from it. Private to the mpm room.
 *
 * The order along the line is that of the ids (York 2000, section 3.2). Points themselves are sorted by cell, so that
 * each step their places are first put into a table by number; an entry is written by one point alone, and the tangents
 * have the same bits for any blocks and threads. Normals to unordered points can come in behind the same functions. */
#ifndef MPM_LINE_H
#define MPM_LINE_H

#include "mpm/work.h"

/* An open end that lies on a mirror goes on behind it. */
typedef struct line_end {
    int axis;       /* that the mirror is normal to; -1: the end is free */
    double plane;   /* m: where the mirror stands */
    bool of_itself; /* the next point is the image of the end, else that of the end's neighbour */
} line_end;

/* The point next to another: its number, -1 where there is none, and the mirror behind which it lies, or NULL. */
typedef struct line_side {
    ptrdiff_t of;
    const line_end *mirror;
} line_side;

/* A neighbour that has been found from where the points lie. */
typedef struct line_link {
    ptrdiff_t of;    /* its number; -1: there is none */
    line_end mirror; /* behind which it lies; axis -1: none */
} line_link;

typedef struct membrane_line {
    size_t n;  /* points at the start; 0: the body is no membrane */
    double *x; /* 3 n numbers, m: places by number; NAN where a point is lost. Owned */
    bool closed;
    bool ordered; /* the points follow each other by their numbers */
    line_end end[2];
    /* 2 n, before and after: neighbours where normals are free and strain comes from places; NULL: by number. Owned. */
    line_link *link;
    /* Where strain comes from places (line_strain.c), else NULL: n numbers each, in one piece that `rest` owns. */
    double *rest, *volume;  /* m, of each point at rest with its slack; m3 at the start */
    double *along, *across; /* strains along the line and across it */
    double *before;         /* along the line at the start of the step */
    double *pace;           /* what the nodes have stretched a point by in the step, dt t.L.t */
    double *lost;           /* J: what the step took of the strain energy; negative: gave */
    double *bend;           /* 3 n, m: second differences of places */
    double *shift;          /* 3 n, m: by how much smoothing has moved the points back in the step */
} membrane_line;

/* Makes the line of a body from the points that have been seeded. */
floe_status line_make(mpm *s, int body);
/* The arrays of a line whose strain comes from places, with what its points are at rest. */
floe_status line_measure(mpm *s, int body);
void line_free(context *ctx, membrane_line *line);
/* Takes in the places of the points: current ones, or next. */
void line_update(mpm *s, int body, bool next);
/* The neighbour before (step -1) or after (+1) a point. */
line_side line_side_of(const membrane_line *line, size_t number, int step);
/* Way (m) from the point before to the one after, its length, and its length at rest; at a free end from or to the
 * point itself. */
double line_way(const mpm *s, int body, size_t number, double way[3], double *rest);
/* Second difference of places (m) at a point. False at free ends, and beside lost points. */
bool line_bend(const mpm *s, int body, size_t number, double bend[3]);
/* Strain energy that a body's line loses in the step, into line->lost: to the difference between nodes and places, and
 * to smoothing, which straightens the next places of the points. */
void line_settle(mpm *s, int body);
/* Strains along it where line->x has it, into line->along; across it now, into line->across. */
void line_take_strains(const mpm *s, int body);
void line_read_hoops(mpm *s, int body);
/* The room (m2; about an axis m3 per radian) inside a body's line where line->x has it, and its gradient, two numbers a
 * point. */
double membrane_measure(const mpm *s, int body, double *gradient);
/* Strains along a body's line from its places, into P_STRAIN. */
void line_strain(const mpm *s, int body, bool next);
/* Unit tangent at the point of a number (0 first), from its neighbours' places. False where it has none: t is left
 * alone. */
bool line_tangent(const mpm *s, int body, size_t number, double t[3]);
/* Number of point k of a body in a block. */
size_t point_number(const mpm *s, int blk, int body, size_t k);

#endif

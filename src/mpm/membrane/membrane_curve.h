/* Membranes as curves of points: the neighbours of each point, and the tangents that follow from them. Private to the
 * mpm module.
 *
 * The order along the curve is that of the ids (York 2000, section 3.2). Since points are sorted by cell, each step
 * first writes their positions into a table by number. Each entry is written by one point alone, so that the tangents
 * have the same bits for any blocks and threads. Points without an order have their neighbours from
 * membrane_normal.c. */
#ifndef MPM_MEMBRANE_CURVE_H
#define MPM_MEMBRANE_CURVE_H

#include "mpm/mpm.h"

/* An open end on a mirror continues behind it. */
typedef struct curve_end {
    int axis;       /* that the mirror is normal to; -1: the end is free */
    double plane;   /* m: coordinate of the mirror */
    bool of_itself; /* the next point is the image of the end, else that of the end's neighbour */
} curve_end;

/* A neighbouring point: its number, -1 where there is none, and the mirror behind which its image lies, or NULL. */
typedef struct curve_neighbour {
    ptrdiff_t of;
    const curve_end *mirror;
} curve_neighbour;

/* A neighbour that was found from the positions of the points. */
typedef struct curve_link {
    ptrdiff_t of;     /* its number; -1: there is none */
    curve_end mirror; /* behind which its image lies; axis -1: none */
} curve_link;

typedef struct membrane_curve {
    size_t n;  /* points at the start; 0: the body is no membrane */
    double *x; /* 3 n numbers, m: positions by number; NAN where a point is lost. Owned */
    bool closed;
    bool ordered; /* the order of the points is that of their numbers */
    curve_end end[2];
    /* 2 n, before and after: neighbours where points have no order and strain comes from positions; NULL: by number.
     * Owned. */
    curve_link *link;
    /* Where strain comes from positions (membrane_strain.c), else NULL: n numbers each, one allocation that `rest`
     * owns. */
    double *rest, *volume;  /* length of each point at rest with its slack (m); its volume at the start (m3) */
    double *along, *across; /* strains along the curve and across it */
    double *before;         /* along the curve at the start of the step */
    double *pace;           /* strain increment of the step by the nodes' velocity gradient, dt t.L.t */
    double *lost;           /* J: strain energy lost in the step; negative: gained */
    double *bend;           /* 3 n, m: second differences of positions */
    double *shift;          /* 3 n, m: by how much smoothing has moved the points back in the step */
} membrane_curve;

/* Makes the curve of a body from its seeded points. */
floe_status membrane_curve_make(mpm *s, int body);
/* Allocates the arrays of a curve whose strain comes from positions, with the lengths of its points at rest. */
floe_status membrane_curve_measure(mpm *s, int body);
void membrane_curve_free(context *ctx, membrane_curve *curve);
/* Reads the positions of the points: current ones, or next. */
void membrane_curve_update(mpm *s, int body, bool next);
/* The neighbour before (step -1) or after (+1) a point. */
curve_neighbour membrane_curve_neighbour(const membrane_curve *curve, size_t number, int step);
/* Chord (m) from the point before to the one after, its length (returned), and its length at rest; at a free end from
 * or to the point itself. */
double membrane_curve_chord(const mpm *s, int body, size_t number, double chord[3], double *rest);
/* Second difference of positions (m) at a point. False at free ends and beside lost points. */
bool membrane_curve_second_difference(const mpm *s, int body, size_t number, double bend[3]);
/* Strain energy that a membrane loses in the step, into `lost`: by the difference between strains of nodes and of
 * positions, and by smoothing of the next positions. */
void membrane_curve_settle(mpm *s, int body);
/* Strains along the curve at the positions x, into `along`; across it now, into `across`. */
void membrane_curve_strains_at(const mpm *s, int body);
void membrane_curve_hoop_strains(mpm *s, int body);
/* Area that a membrane encloses at the positions x (m2; axisymmetric: volume, m3 per radian), and its gradient, two
 * numbers a point. */
double membrane_measure(const mpm *s, int body, double *gradient);
/* Strains along a membrane from its positions, into P_STRAIN. */
void membrane_curve_strain(const mpm *s, int body, bool next);
/* Unit tangent at a point (by number, from 0), from the positions of its neighbours. False where it has none; t is then
 * unchanged. */
bool membrane_curve_tangent(const mpm *s, int body, size_t number, double t[3]);
/* Number of point k of a body in a block. */
size_t point_number(const mpm *s, int blk, int body, size_t k);

#endif

/* Surfaces in space, and the points of membranes on them: one layer, in no order, spread evenly. */
#ifndef GEOM_SHEET_H
#define GEOM_SHEET_H

#include "geom/curve.h"

typedef enum sheet_kind {
    SHEET_NONE, /* not given */
    SHEET_SPHERE,
    SHEET_CYLINDER, /* its shell, without ends */
    SHEET_REVOLVED, /* a curve turned about an axis */
    SHEET_PLANE,    /* a parallelogram */
    SHEET_POINTS    /* the points themselves */
} sheet_kind;

/* What lies behind a side of the mesh that goes through the centre (sphere) or the axis (cylinder, revolved) is left
 * out: there the surface goes on as its image. */
typedef struct sheet_surface {
    sheet_kind kind;
    int axis;         /* of the cylinder, or about which the curve is turned: 0 to 2 */
    double centre[3]; /* m: of the sphere; a place on the axis */
    double radius;    /* m: sphere, cylinder */
    double from, to;  /* m: ends of the cylinder, along the axis */
    /* Revolved: only distance from the axis and place along it count; an arc lies in the plane of the first two
     * axes, so that it is turned about one of these. */
    curve_line curve;
    double area;                           /* m2, points: those of `curve` share it alike */
    double corner[3], first[3], second[3]; /* m, plane: a corner, and the two sides that begin there */
} sheet_surface;

/* How a surface is filled. */
typedef struct sheet_seeding {
    int number;       /* points about which it gets; 0: by per_cell */
    int per_cell;     /* along each axis of a cell, 1 to 16 */
    double thickness; /* m */
} sheet_seeding;

/* Area (m2) of the part of it that belongs to the mesh. */
double sheet_area(const sheet_surface *s, const seed_spec *grid);

/* Fills *out with the points of a surface, all of the same area, the sum of which is exact, with area times thickness
 * as volume: on surfaces of revolution in bands of nearly square pieces, the ends of the bands by area (compare
 * Leopardi 2006); on a plane in rows; of a list as they stand. Of the grid it takes the mesh, of three dimensions.
 * FLOE_BAD_INPUT names a point outside the mesh, pieces larger than a cell (such a membrane is torn), a curve that
 * crosses its axis, and a surface without area. */
floe_status seed_sheet(seed_list *out, context *ctx, const sheet_surface *s, const sheet_seeding *how,
                       const seed_spec *grid);

/* How a surface ends before its first row, or after its last. */
typedef enum sheet_end {
    SHEET_ENDS_INSIDE, /* the domain: it is open */
    SHEET_ENDS_ON_SIDE,
    SHEET_ENDS_AT_AXIS, /* it closes there */
    SHEET_ENDS_JOINED   /* the last row is beside the first */
} sheet_end;

/* The rows in which points of a surface lie: bands about its axis, or rows of a plane. Sides of the mesh are bits
 * 2 axis + side. */
typedef struct sheet_rows {
    size_t *first; /* point with which each begins, counted from 0, and the number of all; n + 1; owned */
    int n;
    bool closed; /* the last point of a row is beside its first */
    sheet_end end[2];
    unsigned end_side[2]; /* where the rows end: ENDS_ON_SIDE */
    unsigned row_side[2]; /* sides on which each row begins and ends; 0: closed, or inside the domain */
    double outward[3];    /* of a plane: first x second; else 0, and it surrounds something */
} sheet_rows;

/* The rows of what seed_sheet makes of a surface, in its order. FLOE_BAD_INPUT for listed points, which have none. */
floe_status sheet_rows_make(sheet_rows *out, context *ctx, const sheet_surface *s, const sheet_seeding *how,
                            const seed_spec *grid);
void sheet_rows_free(context *ctx, sheet_rows *rows);

#endif

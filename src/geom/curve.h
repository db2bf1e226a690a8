/* Curves, and the points of membranes along them: one layer, in order (York 1997, section 5.4.4). */
#ifndef GEOM_CURVE_H
#define GEOM_CURVE_H

#include "geom/seed.h"

typedef enum curve_kind {
    CURVE_SEGMENT,
    CURVE_ARC,      /* in the plane of the first two axes */
    CURVE_CIRCLE,   /* a whole one, closed */
    CURVE_POLYLINE, /* through its vertices */
    CURVE_POINTS    /* the points themselves */
} curve_kind;

typedef struct curve_line {
    curve_kind kind;
    double from[3], to[3];       /* m, segment */
    double centre[3], radius;    /* m, arc and circle */
    double angle_from, angle_to; /* rad, arc: anticlockwise from the first axis where angle_to is larger */
    double *vertex;              /* m, three each; polyline and points; not owned */
    const char *file;            /* that they come from; NULL: from the deck. Not owned */
    int n_vertices;
    bool closed; /* polyline and points: the last is joined to the first */
} curve_line;

/* How a curve is filled. */
typedef struct curve_seeding {
    int number;       /* points; unused for CURVE_POINTS */
    double thickness; /* m (1-D: share of the section; 3-D: m2, the section of a string) */
    double length; /* m, CURVE_POINTS: shared alike by the points (York's s / N); NAN: half the way to each neighbour */
    bool any_order; /* CURVE_POINTS: the list need not follow the line */
} curve_seeding;

/* Length (m). */
double curve_length(const curve_line *c, int dim);
bool curve_is_closed(const curve_line *c);
/* How many points it gets: those it lists, else `asked`, else (0) enough for per_cell points along a cell of the
 * grid. */
int curve_count(const curve_line *c, int asked, int per_cell, const seed_spec *grid);

/* Fills *out with the points of a curve, in order along it: in the middle of equal pieces, each with its piece's length
 * times thickness as volume (times the radius when axisymmetric). Of the grid it takes dimension, geometry and mesh.
 * FLOE_BAD_INPUT names a point outside the mesh, and neighbours more than a cell apart, unless they are in any order:
 * such a membrane is torn. */
floe_status seed_curve(seed_list *out, context *ctx, const curve_line *c, const curve_seeding *how,
                       const seed_spec *grid);

#endif

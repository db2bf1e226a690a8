/* Closed surfaces of triangles: distances from them. */
#ifndef GEOM_TRIANGLES_H
#define GEOM_TRIANGLES_H

#include "geom/shape.h"

/* Where the nearest point of a triangle may lie: on its face, on the side from corner k, at corner k. */
enum { FEATURE_FACE, FEATURE_SIDE, FEATURE_CORNER = FEATURE_SIDE + 3, FEATURES = FEATURE_CORNER + 3 };

/* Its corners are counterclockwise as seen from outside. */
typedef struct triangle {
    int corner[3];              /* vertices */
    double normal[FEATURES][3]; /* out of what it surrounds, at each feature: of any length */
} triangle;

/* A node of a tree of boxes. */
typedef struct triangle_box {
    double lo[3], hi[3]; /* m */
    int first, n;        /* triangles of a leaf; n = 0: two boxes, the next in the list and */
    int second;
} triangle_box;

typedef struct triangle_surface {
    const double (*x)[3]; /* vertices, m */
    int n_vertices;
    triangle *triangle; /* in the order of the tree */
    int n;
    triangle_box *box;
    int n_boxes;
} triangle_surface;

/* Makes a surface of n triangles, three corners each: those that are equal are one vertex. All of it may face in or out.
 * `why` says where it is open, inconsistent, or crosses itself; "" if nowhere. */
floe_status triangles_make(triangle_surface *out, const double (*corner)[3], int n, const shape_memory *memory,
                           char why[SHAPE_WHY]);
/* The signed distance (m), negative inside. */
double triangles_level(const triangle_surface *t, const double x[3]);
/* triangles_check.c: refuses surfaces that are open or inconsistent; with the tree and normals of faces, those that cross
 * themselves; then those with pieces that face the wrong way, and turns over what faces in as a whole. */
floe_status triangles_check_sides(const triangle_surface *t, context *ctx, char why[SHAPE_WHY]);
void triangles_check_crossings(const triangle_surface *t, char why[SHAPE_WHY]);
floe_status triangles_check_pieces(triangle_surface *t, context *ctx, char why[SHAPE_WHY]);
/* Normals of sides from those of the faces that meet there. */
floe_status triangles_find_side_normals(triangle_surface *t, context *ctx);
/* out: that is (b - a) x (c - a). */
void triangle_area(const triangle_surface *t, const triangle *of, double out[3]);

#endif

/* Body shapes. One file adds one: shape_<name>.c ends in a const descriptor `shape_<name>`. Shapes may have shapes among their parameters.
 * Coordinates are double[3]; unused ones are ignored. */
#ifndef GEOM_SHAPE_H
#define GEOM_SHAPE_H

#include "base/context.h"
#include "base/param.h"

#include <stdbool.h>

enum { SHAPE_WHY = 512 /* characters of what is wrong with a shape */ };

/* Storage that lives as long as the shape. */
typedef struct shape_memory {
    context *ctx;
    floe_status (*allocate)(void *owner, void *out, size_t size); /* zeroed */
    void *owner;
} shape_memory;

/* Integrals over a part of a shape: of 1 and of x, or of r and of r x when weighted by the radius. */
typedef struct shape_moments {
    double volume, first[3];
} shape_moments;

typedef struct shape_model {
    const char *name, *doc;
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    int min_dim, max_dim;
    /* What to take in fewer dimensions, and in more; NULL where it exists in all of 1 to 3. */
    const char *instead_below, *instead_above;
    /* Signed distance-like level (m): negative inside, zero on the surface, |grad| about 1 near it; never wrong in sign,
     * and never larger in size than the distance from the surface (boxes are taken as all in or all out by it). */
    double (*level)(const void *par, int dim, const double x[3]);
    /* A bounding box of the inside; false when unbounded. */
    bool (*bounds)(const void *par, int dim, double lo[3], double hi[3]);
    /* Whether all of that box is inside: fractions are then exact, and found at once. */
    bool fills_bounds;
    /* The same where it depends on the parameters. NULL: `fills_bounds` says. */
    bool (*fills)(const void *par, int dim);
    /* Moments of the part of the box [lo, hi] inside, exactly; false, or NULL: they are not known. */
    bool (*moments)(const void *par, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                    shape_moments *out);
    /* Refuses impossible parameters (inner radius over outer): NULL if fine, else what is wrong. */
    const char *(*check)(const void *par, int dim);
    /* Makes what the other functions need from the parameters, which `check` has passed; shapes among them are prepared.
     * `why` says what is wrong with them, "" if nothing is. NULL: there is nothing to make. */
    floe_status (*prepare)(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY]);
} shape_model;

extern const shape_model *const shape_registry[];
extern const size_t shape_registry_size;
/* NULL if there is none of that name. */
const shape_model *shape_find(const char *name);

/* A shape with its parameters. */
typedef struct shape {
    const shape_model *model;
    void *par; /* model->param_size bytes, owned by the scene */
} shape;

/* Checks and prepares a shape whose parameters are filled. `why` says what is wrong with them, "" if nothing is. */
floe_status shape_prepare(const shape *s, int dim, const shape_memory *memory, char why[SHAPE_WHY]);
/* The union of n prepared shapes, which stay the caller's and live as long; its `par` is the caller's, who frees it by memory_free.
 * FLOE_NO_MEMORY. */
floe_status shape_unite(context *ctx, shape *part, size_t n, int dim, shape *out);
/* Whether all of the box of its bounds is inside. */
bool shape_fills_bounds(const shape *s, int dim);
/* The greatest distance (m) that its bounds span; 0: it has none. */
double shape_extent(const shape *s, int dim);

/* Whether x (m) lies inside; the surface does not. */
bool shape_inside(const shape *s, int dim, const double x[3]);

/* Level of the shape at x (m). */
double shape_level(const shape *s, int dim, const double x[3]);
/* Differences of the level over two steps about x along each axis, which point out of the shape. */
void shape_differences(const shape *s, int dim, const double x[3], double step, double out[3]);
/* Bisection between a point inside and one outside, points whose level is `tolerance` at most being inside: x is the last point looked at. Returns the
 * largest share of the way at which a point was inside. */
double shape_crossing(const shape *s, int dim, double tolerance, const double inside[3], const double outside[3],
                      int passes, double x[3]);

/* Moments of the part of the box [lo, hi] inside the shape where they are known exactly; false: they are not. */
bool shape_exact_moments(const shape *s, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                         shape_moments *out);

/* Volume fraction and centroid of the part of the box [lo, hi] inside the shape: where moments are known exactly to round-off, else by adaptive
 * subdivision to `depth` levels with a linear cut in the smallest boxes (size h). Planes are exact; on a smooth surface of radius R the relative error of
 * a body's volume is below h^2/(100 R^2), for the errors of neighbouring boxes cancel; edges cost about h^2/10 a length.
 * centroid is that of the inside part (the middle of the box where the fraction is 0).
 * weight_by_radius: volume elements carry r = x[0] (axisymmetric). */
double shape_fraction(const shape *s, int dim, const double lo[3], const double hi[3], bool weight_by_radius, int depth,
                      double centroid[3]);

#endif

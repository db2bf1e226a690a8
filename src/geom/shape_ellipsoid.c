/* An ellipsoid along the axes: an ellipse in 2-D. */
#include "geom/shape.h"

#include <math.h>

typedef struct ellipsoid_par {
    double centre[3], radii[3]; /* m */
} ellipsoid_par;

static const param_spec ellipsoid_params[] = {
    PAR_VECTOR(ellipsoid_par, centre, "m", PARAM_ANY, 0.0, "centre"),
    PAR_VECTOR(ellipsoid_par, radii, "m", PARAM_POSITIVE, NAN, "half axes; `moved` turns them"),
};

/* The nearest place of the surface is r^2 y / (r^2 + t) along each axis, with the t at which it lies on the surface
 * (D. Eberly, Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid, Geometric Tools, 2013). What the
 * sum of squares exceeds 1 by is convex in t, and Newton's iterates come from below, where it is positive. */
static double foot_excess(const ellipsoid_par *e, int dim, const double y[3], double t, double *slope)
{
    double excess = -1.0;
    *slope = 0.0;
    for (int k = 0; k < dim; k++) {
        const double r = e->radii[k], below = r * r + t, share = below > 0.0 ? r * y[k] / below : 0.0;
        excess += share * share;
        if (below > 0.0) *slope -= 2.0 * share * share / below;
    }
    return excess;
}

/* From near the middle the nearest place lies off the plane across the shortest axis, at its greatest t. */
static double distance_across(const ellipsoid_par *e, int dim, const double y[3], int shortest)
{
    const double r = e->radii[shortest];
    double left = 1.0, square = 0.0;
    for (int k = 0; k < dim; k++) {
        const double below = e->radii[k] * e->radii[k] - r * r;
        if (!(below > 0.0)) continue;
        const double foot = e->radii[k] * e->radii[k] * y[k] / below;
        left -= foot / e->radii[k] * (foot / e->radii[k]);
        square += (y[k] - foot) * (y[k] - foot);
    }
    return sqrt(square + r * r * fmax(left, 0.0));
}

static double ellipsoid_level(const void *par, int dim, const double x[3])
{
    const ellipsoid_par *e = par;
    double y[3] = {0.0}, t = -HUGE_VAL, slope, square = 0.0;
    int shortest = 0;
    for (int k = 0; k < dim; k++) {
        y[k] = fabs(x[k] - e->centre[k]);
        t = fmax(t, e->radii[k] * (y[k] - e->radii[k]));
        if (e->radii[k] < e->radii[shortest]) shortest = k;
    }
    const bool inside = foot_excess(e, dim, y, 0.0, &slope) < 0.0;
    const double least = -e->radii[shortest] * e->radii[shortest];
    if (!(t > least) && foot_excess(e, dim, y, least, &slope) < 0.0) return -distance_across(e, dim, y, shortest);
    for (int pass = 0; pass < 60; pass++) {
        const double excess = foot_excess(e, dim, y, t, &slope), next = t - excess / slope;
        if (!(excess > 0.0) || !(next > t)) break;
        t = next;
    }
    for (int k = 0; k < dim; k++) {
        const double part = y[k] / (e->radii[k] * e->radii[k] + t);
        square += part * part;
    }
    return (inside ? -1.0 : 1.0) * fabs(t) * sqrt(square);
}

static bool ellipsoid_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const ellipsoid_par *e = par;
    for (int k = 0; k < dim; k++) {
        lo[k] = e->centre[k] - e->radii[k];
        hi[k] = e->centre[k] + e->radii[k];
    }
    return true;
}

static const char *ellipsoid_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

const shape_model shape_ellipsoid = {
    .name = "ellipsoid",
    .doc = "ellipsoid along the axes (ellipse in 2-D); `ball` is faster where its half axes are alike",
    .param_size = sizeof(ellipsoid_par),
    .params = ellipsoid_params,
    .n_params = sizeof ellipsoid_params / sizeof *ellipsoid_params,
    .min_dim = 2,
    .max_dim = 3,
    .instead_below = "it is of scenes of two and three dimensions; in one take `ball` or `box`",
    .level = ellipsoid_level,
    .bounds = ellipsoid_bounds,
    .check = ellipsoid_check,
};

/* Solutions that depend on the distance from a centre: of planes, cylinders and spheres. Only src/verify includes
 * this. */
#ifndef VERIFY_RADIAL_H
#define VERIFY_RADIAL_H

#include "verify/verify_internal.h"

/* What a deck says of it: parameters of the struct's end, in this order. */
typedef struct radial_par {
    double geometry; /* 0, 1, 2 */
    double axes;     /* 0: geometry + 1 */
    double centre[3];
} radial_par;

#define PAR_RADIAL(type, field)                                                                                       \
    {.key = "geometry",                                                                                               \
     .unit = "1",                                                                                                     \
     .range = PARAM_BETWEEN,                                                                                          \
     .lo = 0.0,                                                                                                       \
     .hi = 2.0,                                                                                                       \
     .fallback = 0.0,                                                                                                 \
     .offset = offsetof(type, field.geometry),                                                                        \
     .count = 1,                                                                                                      \
     .doc = "0: planes, 1: cylinders, 2: spheres"},                                                                   \
        {.key = "axes",                                                                                               \
         .unit = "1",                                                                                                 \
         .range = PARAM_BETWEEN,                                                                                      \
         .lo = 0.0,                                                                                                   \
         .hi = 3.0,                                                                                                   \
         .fallback = 0.0,                                                                                             \
         .offset = offsetof(type, field.axes),                                                                        \
         .count = 1,                                                                                                  \
         .doc = "over how many axes the distance is taken; 0: planes 1, cylinders 2, spheres all. About an axis r = " \
                "0 cylinders need 1"},                                                                                \
    {                                                                                                                 \
        .key = "centre", .unit = "m", .range = PARAM_ANY, .fallback = 0.0, .offset = offsetof(type, field.centre),    \
        .count = -3, .doc = "centre"                                                                                  \
    }

/* Errors: FLOE_BAD_INPUT for numbers that are not whole, or for more axes than the scene has. */
static inline floe_status radial_check(context *ctx, const radial_par *p, int dim)
{
    TRY(check_whole(ctx, "geometry", p->geometry));
    TRY(check_whole(ctx, "axes", p->axes));
    if (p->axes <= dim && (p->geometry == 0.0 || dim > 1)) return FLOE_OK;
    return fail_key(ctx, KEY("geometry"), "%g, with axes = %g: a scene of %d dimensions has no such distance",
                    p->geometry, p->axes, dim);
}

/* Axes over which the distance is taken: spheres about an axis have two, r and z. */
static inline int radial_axes(const radial_par *p, int dim)
{
    const int axes = p->axes > 0.0 ? whole_number(p->axes) : whole_number(p->geometry) + 1;
    return axes < dim ? axes : dim;
}

static inline double radial_distance(const radial_par *p, int dim, const double x[3])
{
    double square = 0.0;
    for (int a = 0; a < radial_axes(p, dim); a++) square += (x[a] - p->centre[a]) * (x[a] - p->centre[a]);
    return sqrt(square);
}

/* A velocity's component, of a radial velocity u. */
static inline double radial_component(const radial_par *p, int dim, exact_quantity quantity, const double x[3],
                                      double u)
{
    const int axis = (int)quantity - EXACT_VELOCITY_X;
    const double r = radial_distance(p, dim, x);
    return axis < radial_axes(p, dim) && r > 0.0 ? u * (x[axis] - p->centre[axis]) / r : 0.0 * u;
}

/* Jumps at distance r: planes where one axis counts, none otherwise. */
static inline void radial_breaks(const radial_par *p, double r, exact_breaks *out)
{
    const bool planes = p->axes == 1.0 || (p->axes == 0.0 && p->geometry == 0.0);
    *out = (exact_breaks){.axis = 0, .count = planes && isfinite(r) ? 3 : 0};
    for (int i = 0; i < out->count; i++) out->position[i] = p->centre[0] + (i - 1) * r;
}

#endif

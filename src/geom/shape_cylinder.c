/* A straight cylinder with flat ends, or a tube. In (r, z) a cylinder is a box. */
#include "geom/shape.h"

#include <math.h>

typedef struct cylinder_par {
    double start[3], end[3], radius, inner_radius; /* m */
} cylinder_par;

static const param_spec cylinder_params[] = {
    PAR_VECTOR(cylinder_par, start, "m", PARAM_ANY, NAN, "centre of one end"),
    PAR_VECTOR(cylinder_par, end, "m", PARAM_ANY, NAN, "centre of the other end"),
    PAR_POSITIVE(cylinder_par, radius, "m", NAN, "outer radius"),
    PAR_NONNEGATIVE(cylinder_par, inner_radius, "m", 0.0, "inner radius of a tube; 0: none"),
};

/* Unit vector from start to end; returns the length. */
static double cylinder_axis(const cylinder_par *a, double axis[3])
{
    double length2 = 0.0;
    for (int k = 0; k < 3; k++) {
        axis[k] = a->end[k] - a->start[k];
        length2 += axis[k] * axis[k];
    }
    const double length = sqrt(length2);
    for (int k = 0; k < 3; k++) axis[k] /= length;
    return length;
}

/* The distance from the rectangle that the cylinder is in (distance from the axis, height). */
static double cylinder_level(const void *par, int dim, const double x[3])
{
    const cylinder_par *a = par;
    (void)dim;
    double axis[3], height = 0.0, r2 = 0.0;
    const double length = cylinder_axis(a, axis);
    for (int k = 0; k < 3; k++) height += (x[k] - a->start[k]) * axis[k];
    for (int k = 0; k < 3; k++) {
        const double across = x[k] - a->start[k] - height * axis[k];
        r2 += across * across;
    }
    const double r = sqrt(r2);
    double radial = r - a->radius;
    if (a->inner_radius > 0.0) radial = fmax(radial, a->inner_radius - r);
    const double axial = fmax(-height, height - length);
    return radial > 0.0 && axial > 0.0 ? hypot(radial, axial) : fmax(radial, axial);
}

/* Each end is a disc across the axis: it reaches radius * sqrt(1 - axis_k^2) along axis k. */
static bool cylinder_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const cylinder_par *a = par;
    (void)dim;
    double axis[3];
    cylinder_axis(a, axis);
    for (int k = 0; k < 3; k++) {
        const double reach = a->radius * sqrt(fmax(1.0 - axis[k] * axis[k], 0.0));
        lo[k] = fmin(a->start[k], a->end[k]) - reach;
        hi[k] = fmax(a->start[k], a->end[k]) + reach;
    }
    return true;
}

static const char *cylinder_check(const void *par, int dim)
{
    const cylinder_par *a = par;
    (void)dim;
    double axis[3];
    if (!(cylinder_axis(a, axis) > 0.0)) return "start and end must differ";
    return a->inner_radius < a->radius ? NULL : "inner_radius must be less than radius";
}

const shape_model shape_cylinder = {
    .name = "cylinder",
    .doc = "straight cylinder or tube with flat ends (3-D)",
    .param_size = sizeof(cylinder_par),
    .params = cylinder_params,
    .n_params = sizeof cylinder_params / sizeof *cylinder_params,
    .min_dim = 3,
    .max_dim = 3,
    .instead_below = "it is of scenes in space; in the plane `ball` is its section and `annulus` that of a tube, about "
                     "an axis take `box`",
    .level = cylinder_level,
    .bounds = cylinder_bounds,
    .check = cylinder_check,
};

/* Everything behind a plane (a line in 2-D). */
#include "geom/shape.h"

#include <math.h>

typedef struct halfspace_par {
    double point[3], normal[3]; /* m, no unit */
} halfspace_par;

static const param_spec halfspace_params[] = {
    PAR_VECTOR(halfspace_par, point, "m", PARAM_ANY, NAN, "a point of the plane"),
    PAR_VECTOR(halfspace_par, normal, "1", PARAM_ANY, NAN, "normal of the plane, out of the shape; any length"),
};

static double halfspace_level(const void *par, int dim, const double x[3])
{
    const halfspace_par *a = par;
    double along = 0.0, n2 = 0.0;
    for (int k = 0; k < dim; k++) {
        along += (x[k] - a->point[k]) * a->normal[k];
        n2 += a->normal[k] * a->normal[k];
    }
    return along / sqrt(n2);
}

static bool halfspace_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    (void)par;
    (void)dim;
    (void)lo;
    (void)hi;
    return false;
}

static const char *halfspace_check(const void *par, int dim)
{
    const halfspace_par *a = par;
    double n2 = 0.0;
    for (int k = 0; k < dim; k++) n2 += a->normal[k] * a->normal[k];
    return n2 > 0.0 ? NULL : "normal must not be zero";
}

const shape_model shape_halfspace = {
    .name = "halfspace",
    .doc = "everything behind a plane",
    .param_size = sizeof(halfspace_par),
    .params = halfspace_params,
    .n_params = sizeof halfspace_params / sizeof *halfspace_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = halfspace_level,
    .bounds = halfspace_bounds,
    .check = halfspace_check,
};

/* What lies between two radii: a ring in 2-D, a spherical shell in 3-D. */
#include "geom/shape.h"

#include <math.h>

typedef struct annulus_par {
    double centre[3], inner_radius, outer_radius; /* m */
} annulus_par;

static const param_spec annulus_params[] = {
    PAR_VECTOR(annulus_par, centre, "m", PARAM_ANY, 0.0, "centre"),
    PAR_POSITIVE(annulus_par, inner_radius, "m", NAN, "inner radius"),
    PAR_POSITIVE(annulus_par, outer_radius, "m", NAN, "outer radius"),
};

static double annulus_level(const void *par, int dim, const double x[3])
{
    const annulus_par *a = par;
    double r2 = 0.0;
    for (int k = 0; k < dim; k++) r2 += (x[k] - a->centre[k]) * (x[k] - a->centre[k]);
    const double r = sqrt(r2);
    return fmax(a->inner_radius - r, r - a->outer_radius);
}

static bool annulus_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const annulus_par *a = par;
    for (int k = 0; k < dim; k++) {
        lo[k] = a->centre[k] - a->outer_radius;
        hi[k] = a->centre[k] + a->outer_radius;
    }
    return true;
}

static const char *annulus_check(const void *par, int dim)
{
    const annulus_par *a = par;
    (void)dim;
    return a->inner_radius < a->outer_radius ? NULL : "inner_radius must be less than outer_radius";
}

const shape_model shape_annulus = {
    .name = "annulus",
    .doc = "ring in 2-D, spherical shell in 3-D",
    .param_size = sizeof(annulus_par),
    .params = annulus_params,
    .n_params = sizeof annulus_params / sizeof *annulus_params,
    .min_dim = 2,
    .max_dim = 3,
    .instead_below = "it is of scenes of two and three dimensions; in one take `box`",
    .level = annulus_level,
    .bounds = annulus_bounds,
    .check = annulus_check,
};

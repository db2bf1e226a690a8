/* A ball: an interval in 1-D, a disc in 2-D; in (r, z) with its centre on the axis, a sphere. */
#include "geom/shape.h"

#include <math.h>

typedef struct ball_par {
    double centre[3], radius; /* m */
} ball_par;

static const param_spec ball_params[] = {
    PAR_VECTOR(ball_par, centre, "m", PARAM_ANY, 0.0, "centre"),
    PAR_POSITIVE(ball_par, radius, "m", NAN, "radius"),
};

static double ball_level(const void *par, int dim, const double x[3])
{
    const ball_par *a = par;
    double r2 = 0.0;
    for (int k = 0; k < dim; k++) r2 += (x[k] - a->centre[k]) * (x[k] - a->centre[k]);
    return sqrt(r2) - a->radius;
}

static bool ball_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const ball_par *a = par;
    for (int k = 0; k < dim; k++) {
        lo[k] = a->centre[k] - a->radius;
        hi[k] = a->centre[k] + a->radius;
    }
    return true;
}

static const char *ball_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

const shape_model shape_ball = {
    .name = "ball",
    .doc = "ball (interval in 1-D, disc in 2-D)",
    .param_size = sizeof(ball_par),
    .params = ball_params,
    .n_params = sizeof ball_params / sizeof *ball_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = ball_level,
    .bounds = ball_bounds,
    .check = ball_check,
};

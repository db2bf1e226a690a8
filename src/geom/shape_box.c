/* An axis-aligned box: an interval in 1-D, a rectangle in 2-D. */
#include "geom/shape.h"

#include <math.h>

typedef struct box_par {
    double lower[3], upper[3]; /* m */
} box_par;

static const param_spec box_params[] = {
    PAR_VECTOR(box_par, lower, "m", PARAM_ANY, NAN, "corner of the least coordinates"),
    PAR_VECTOR(box_par, upper, "m", PARAM_ANY, NAN, "corner of the greatest coordinates"),
};

/* The exact distance: inside to the nearest face, outside to the nearest face, edge or corner. */
static double box_level(const void *par, int dim, const double x[3])
{
    const box_par *a = par;
    double inside = -INFINITY, outside2 = 0.0;
    for (int k = 0; k < dim; k++) {
        const double d = fmax(a->lower[k] - x[k], x[k] - a->upper[k]);
        inside = fmax(inside, d);
        outside2 += d > 0.0 ? d * d : 0.0;
    }
    return inside > 0.0 ? sqrt(outside2) : inside;
}

static bool box_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const box_par *a = par;
    for (int k = 0; k < dim; k++) {
        lo[k] = a->lower[k];
        hi[k] = a->upper[k];
    }
    return true;
}

static const char *box_check(const void *par, int dim)
{
    const box_par *a = par;
    for (int k = 0; k < dim; k++) {
        if (!(a->lower[k] < a->upper[k])) return "lower must be less than upper along every axis";
    }
    return NULL;
}

const shape_model shape_box = {
    .name = "box",
    .doc = "box along the axes (interval in 1-D, rectangle in 2-D)",
    .param_size = sizeof(box_par),
    .params = box_params,
    .n_params = sizeof box_params / sizeof *box_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = box_level,
    .bounds = box_bounds,
    .fills_bounds = true,
    .check = box_check,
};

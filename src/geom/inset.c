#include "geom/inset.h"

#include <math.h>

static double inset_level(const void *par, int dim, const double x[3])
{
    const inset *i = par;
    double level = i->whole.model->level(i->whole.par, dim, x);
    for (int a = 0; a < dim; ++a) level = fmax(level, fmax(i->lower[a] - x[a], x[a] - i->upper[a]));
    return level;
}

static bool inset_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const inset *i = par;
    if (!i->whole.model->bounds(i->whole.par, dim, lo, hi)) return false;
    for (int a = 0; a < dim; ++a) {
        lo[a] = fmax(lo[a], i->lower[a]);
        hi[a] = fmin(hi[a], i->upper[a]);
    }
    return true;
}

static bool inset_fills(const void *par, int dim)
{
    return shape_fills_bounds(&((const inset *)par)->whole, dim);
}

static const shape_model inset_model = {
    .name = "inset",
    .doc = "the part of a shape between planes",
    .param_size = sizeof(inset),
    .min_dim = 1,
    .max_dim = 3,
    .level = inset_level,
    .bounds = inset_bounds,
    .fills = inset_fills,
};

shape inset_shape(inset *of)
{
    return (shape){&inset_model, of};
}

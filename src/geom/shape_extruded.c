/* A plane shape along z: a prism. `moved` has it along other directions. */
#include "geom/shape.h"

#include <math.h>

typedef struct extruded_par {
    shape of;
    double from, to; /* m */
} extruded_par;

static const param_spec extruded_params[] = {
    PAR_MODEL(extruded_par, of, 2, "its section: a shape of the plane of x and y"),
    PAR_ANY(extruded_par, from, "m", NAN, "z of one end"),
    PAR_ANY(extruded_par, to, "m", NAN, "z of the other end, above it"),
};

/* The distance from the prism's section and from its ends: exact where that of the section is. */
static double extruded_level(const void *par, int dim, const double x[3])
{
    const extruded_par *e = par;
    (void)dim;
    const double across = shape_level(&e->of, 2, x), along = fmax(e->from - x[2], x[2] - e->to);
    return across > 0.0 && along > 0.0 ? sqrt(across * across + along * along) : fmax(across, along);
}

static bool extruded_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const extruded_par *e = par;
    (void)dim;
    if (!e->of.model->bounds(e->of.par, 2, lo, hi)) return false;
    lo[2] = e->from;
    hi[2] = e->to;
    return true;
}

static bool extruded_fills(const void *par, int dim)
{
    const extruded_par *e = par;
    (void)dim;
    return shape_fills_bounds(&e->of, 2);
}

static bool extruded_moments(const void *par, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                             shape_moments *out)
{
    const extruded_par *e = par;
    const double from = fmax(lo[2], e->from), to = fmin(hi[2], e->to), height = fmax(to - from, 0.0);
    shape_moments own;
    (void)dim;
    if (weight_by_radius || !shape_exact_moments(&e->of, 2, lo, hi, false, &own)) return false;
    *out = (shape_moments){own.volume * height,
                           {own.first[0] * height, own.first[1] * height, own.volume * height * 0.5 * (from + to)}};
    return true;
}

static const char *extruded_check(const void *par, int dim)
{
    const extruded_par *e = par;
    (void)dim;
    return e->from < e->to ? NULL : "'from' must be less than 'to'";
}

const shape_model shape_extruded = {
    .name = "extruded",
    .doc = "a plane shape along z: a prism (3-D)",
    .param_size = sizeof(extruded_par),
    .params = extruded_params,
    .n_params = sizeof extruded_params / sizeof *extruded_params,
    .min_dim = 3,
    .max_dim = 3,
    .instead_below = "it is of scenes in space; in the plane take its section, `of`, alone",
    .level = extruded_level,
    .bounds = extruded_bounds,
    .fills = extruded_fills,
    .moments = extruded_moments,
    .check = extruded_check,
};

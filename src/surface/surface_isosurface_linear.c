#include "surface/isosurface.h"

extern const surface_method surface_isosurface_linear;

static void estimate_by_linear_isosurface(const surface_set *s, const void *par, const surface_cell *c,
                                          surface_estimate *out)
{
    (void)par;
    (void)isosurface_of_cell(s, c, 1, isosurface_enough(s->mesh->dim, 1), out);
}

const surface_method surface_isosurface_linear = {
    .name = "isosurface_linear",
    .doc = "gradient of a function with the surface as isosurface, of linear splines, on each cell; joined with others "
           "below three points (in space seven)",
    .cite = "Sulsky and York 2000, section 3; York 1997, section 7.4",
    .min_dim = 1,
    .exact = true,
    .checked = true,
    .cell = estimate_by_linear_isosurface,
};

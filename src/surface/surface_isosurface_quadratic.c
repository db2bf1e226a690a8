#include "surface/isosurface.h"

extern const surface_method surface_isosurface_quadratic;

static void estimate_by_quadratic_isosurface(const surface_set *s, const void *par, const surface_cell *c,
                                             surface_estimate *out)
{
    (void)par;
    const int dim = s->mesh->dim;
    if (!isosurface_of_cell(s, c, 2, isosurface_enough(dim, 2), out))
        (void)isosurface_of_cell(s, c, 1, isosurface_enough(dim, 1), out);
}

const surface_method surface_isosurface_quadratic = {
    .name = "isosurface_quadratic",
    .doc = "the same of quadratic splines, on cells joined to have eight points (in space 26); linear ones where four "
           "along each axis have less",
    .cite = "Sulsky and York 2000, section 5; York 1997, section 7.7",
    .min_dim = 1,
    .exact = true,
    .checked = true,
    .cell = estimate_by_quadratic_isosurface,
};

#include "surface/isosurface.h"

extern const surface_method surface_isosurface;

/* Seven points, of the eight that nine quadratic splines need (section 8); in space 25 of 26. Section 8 leaves exactly
 * three points open: linear functions are determined by them. */
static void estimate_by_isosurface(const surface_set *s, const void *par, const surface_cell *c, surface_estimate *out)
{
    (void)par;
    const int dim = s->mesh->dim;
    const bool quadratic = c->n + 1 >= isosurface_enough(dim, 2);
    if (!quadratic || !isosurface_of_cell(s, c, 2, c->n, out))
        (void)isosurface_of_cell(s, c, 1, isosurface_enough(dim, 1), out);
}

const surface_method surface_isosurface = {
    .name = "isosurface",
    .doc = "gradient of a function with the surface as isosurface, cell by cell: quadratic splines from seven points "
           "on (in space 25), linear ones from three on (seven), joined cells below",
    .cite = "Sulsky and York 2000, section 8",
    .min_dim = 1,
    .exact = true,
    .checked = true,
    .cell = estimate_by_isosurface,
};

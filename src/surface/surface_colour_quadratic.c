#include "surface/colour.h"

extern const surface_method surface_colour_quadratic;

static spline_values quadratic_splines(double xi)
{
    return spline_by_cells(xi);
}

static void estimate_by_quadratic_colour(const surface_set *s, const void *par, const surface_cell *c,
                                         surface_estimate *out)
{
    static const colour_rule rule = {.spread = quadratic_splines, .first = 0, .n = 2, .of_nodes = true};
    (void)par;
    colour_of_cell(s, &rule, c, out);
}

const surface_method surface_colour_quadratic = {
    .name = "colour_quadratic",
    .doc = "gradient of a colour that points spread over cells by quadratic splines, at the nodes, read back linearly; "
           "needs gas as points inside",
    .cite = "York 1997, section 7.2",
    .min_dim = 2,
    .needs_inside = true,
    .cell = estimate_by_quadratic_colour,
};

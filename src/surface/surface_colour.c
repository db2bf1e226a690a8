#include "surface/colour.h"

extern const surface_method surface_colour;

static spline_values linear_splines(double xi)
{
    return spline_linear(xi);
}

static void estimate_by_colour(const surface_set *s, const void *par, const surface_cell *c, surface_estimate *out)
{
    static const colour_rule rule = {.spread = linear_splines, .first = 0, .n = 2, .of_nodes = true};
    (void)par;
    colour_of_cell(s, &rule, c, out);
}

const surface_method surface_colour = {
    .name = "colour",
    .doc = "gradient of a colour that points spread over the nodes of their cells, read back linearly; needs gas as "
           "points inside",
    .cite = "York 1997, section 7.1",
    .min_dim = 2,
    .needs_inside = true,
    .cell = estimate_by_colour,
};

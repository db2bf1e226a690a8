#include "surface/colour.h"

extern const surface_method surface_colour_cubic;

static spline_values cubic_splines(double xi)
{
    return spline_cubic(xi);
}

static void estimate_by_cubic_colour(const surface_set *s, const void *par, const surface_cell *c,
                                     surface_estimate *out)
{
    static const colour_rule rule = {.spread = cubic_splines, .first = -1, .n = 4, .of_nodes = false};
    (void)par;
    colour_of_cell(s, &rule, c, out);
}

const surface_method surface_colour_cubic = {
    .name = "colour_cubic",
    .doc = "gradient of a colour that points spread over nodes by cubic splines; needs gas as points inside",
    .cite = "York 1997, section 7.3",
    .min_dim = 2,
    .needs_inside = true,
    .cell = estimate_by_cubic_colour,
};

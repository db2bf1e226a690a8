/* Y97 equations 9.10 and 9.11 in one: the points' colour goes to the centres of cells with the quadratic spline, and
 * from there to the nodes with the gradient of the linear basis. */
#include "mpm/normal/normal.h"
#include "surface/spline.h"

extern const normal_model normal_colour;

static normal_weights colour_weights(const basis_model *basis, double xi, double half, double inv_h)
{
    const spline_values by_cells = spline_by_cells(xi);
    normal_weights r = {.first = by_cells.first, .n = by_cells.n};
    (void)basis;
    (void)half;
    for (int k = 0; k < by_cells.n; ++k) {
        r.w[k] = by_cells.w[k];
        r.dw[k] = by_cells.dw[k] * inv_h;
    }
    return r;
}

const normal_model normal_colour = {
    .name = "colour",
    .doc = "gradient of a colour function, smoothed by quadratic interpolation to cells",
    .cite = "York 1997, equations 9.10, 9.11",
    .reach = 1,
    .weights = colour_weights,
};

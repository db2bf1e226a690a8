/* Y97 equations 9.10 and 9.11 in one: the points' colour goes to the centres of cells with the quadratic spline, and from there to the
 * nodes with the gradient of the linear basis. A node takes half of the cell on either side, and their difference over h. */
#include "mpm/normal/normal.h"

extern const normal_model normal_colour;

static normal_weights weights(const basis_model *basis, double xi, double half, double inv_h)
{
    const double d = xi - 0.5; /* from the centre of the point's cell, which is the middle one of three */
    const double cell[3] = {0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)};
    normal_weights r = {.first = -1, .n = 4};
    (void)basis;
    (void)half;
    for (int k = 0; k < 4; ++k) {
        const double below = k > 0 ? cell[k - 1] : 0.0, above = k < 3 ? cell[k] : 0.0;
        r.w[k] = 0.5 * (below + above);
        r.dw[k] = (below - above) * inv_h;
    }
    return r;
}

const normal_model normal_colour = {
    .name = "colour",
    .doc = "gradient of a colour function, smoothed by quadratic interpolation to cells",
    .cite = "York 1997, equations 9.10, 9.11",
    .reach = 1,
    .weights = weights,
};

#include "mpm/normal/normal.h"

extern const normal_model normal_cubic_spline;

/* Cubic B-spline of the nodes: two below and two above the point. */
static normal_weights spline_kernel(const basis_model *basis, double xi, double half, double inv_h)
{
    normal_weights r = {.first = -1, .n = 4};
    (void)basis;
    (void)half;
    const double x = xi, y = 1.0 - xi;
    r.w[0] = y * y * y / 6.0;
    r.w[1] = 2.0 / 3.0 - x * x + 0.5 * x * x * x;
    r.w[2] = 2.0 / 3.0 - y * y + 0.5 * y * y * y;
    r.w[3] = x * x * x / 6.0;
    r.dw[0] = -0.5 * y * y * inv_h;
    r.dw[1] = (-2.0 * x + 1.5 * x * x) * inv_h;
    r.dw[2] = (2.0 * y - 1.5 * y * y) * inv_h;
    r.dw[3] = 0.5 * x * x * inv_h;
    return r;
}

const normal_model normal_cubic_spline = {
    .name = "cubic_spline",
    .doc = "gradient of the volume of the body's points, smoothed by cubic splines about the nodes",
    .cite = "Monaghan 1992, section 3",
    .reach = 1,
    .weights = spline_kernel,
};

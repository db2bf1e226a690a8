/* Error norms, as the output contract states them: weighted by volume, against exact cell averages or point values, no
 * point excluded. Sums are compensated, so that the order of points matters to round-off of the result only; a NaN in a
 * value, an exact value or a weight makes every norm NaN. */
#ifndef VERIFY_NORMS_H
#define VERIFY_NORMS_H

#include <stddef.h>

/* A compensated sum (Neumaier 1974): value + carry. */
typedef struct norm_sum {
    double value, carry;
} norm_sum;

/* An accumulation. Start from {0}. */
typedef struct norm {
    norm_sum weight;       /* sum w */
    norm_sum error;        /* sum w |x - x_exact| */
    norm_sum exact;        /* sum w |x_exact| */
    norm_sum error_square; /* sum w (x - x_exact)^2 */
    norm_sum exact_square; /* sum w x_exact^2 */
    double largest_error;  /* max |x - x_exact| */
    double largest_exact;  /* max |x_exact| */
} norm;

/* l1 = sum w|e| / sum w, l2 = sqrt(sum w e^2 / sum w), linf = max |e|, in the unit of x; the relative ones are divided
 * by the same mean (or maximum) of the exact values. All NaN when nothing was added; a relative one is NaN or infinite
 * when the exact solution is zero throughout. */
typedef struct norm_result {
    double l1, l1rel, l2, l2rel, linf, linfrel;
} norm_result;

/* Adds one point or cell. `weight` is its volume, >= 0 (a negative one makes the norms NaN). */
void norm_add(norm *n, double value, double exact, double weight);
norm_result norm_finish(const norm *n);

/* Guilkey et al. (2003), eq. 13: the unweighted mean over points of | |sigma_r + sigma_theta| - S | / S with
 * S = 2 P r_i^2/(r_o^2 - r_i^2) (the paper prints 2P/3, its value for r_o = 2 r_i). `sum` holds sigma_r + sigma_theta
 * (Pa) of `n` points, `pressure` is inside minus outside (Pa), radii in m, 0 < r_i < r_o. NaN for n = 0, and when any
 * point is NaN. */
double guilkey_eq13(size_t n, const double *sum, double pressure, double inner_radius, double outer_radius);

#endif

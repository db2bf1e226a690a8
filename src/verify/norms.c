#include "verify/norms.h"

#include <math.h>

static void sum_add(norm_sum *sum, double x)
{
    const double total = sum->value + x;
    /* What the addition has lost, taken from the smaller of the two. */
    sum->carry += fabs(sum->value) >= fabs(x) ? (sum->value - total) + x : (x - total) + sum->value;
    sum->value = total;
}

static double sum_value(const norm_sum *sum)
{
    return sum->value + sum->carry;
}

/* The larger of the two; NaN if either is (fmax would drop it). */
static double larger(double a, double b)
{
    if (isnan(a)) return a;
    return b <= a ? a : b;
}

void norm_add(norm *n, double value, double exact, double weight)
{
    const double w = weight >= 0.0 ? weight : (double)NAN;
    const double error = fabs(value - exact);
    const double size = fabs(exact);
    sum_add(&n->weight, w);
    sum_add(&n->error, w * error);
    sum_add(&n->exact, w * size);
    sum_add(&n->error_square, w * error * error);
    sum_add(&n->exact_square, w * size * size);
    n->largest_error = larger(n->largest_error, isnan(w) ? w : error);
    n->largest_exact = larger(n->largest_exact, isnan(w) ? w : size);
}

norm_result norm_finish(const norm *n)
{
    const double weight = sum_value(&n->weight);
    const double error = sum_value(&n->error);
    const double square = sum_value(&n->error_square);
    const double none = weight > 0.0 ? 0.0 : (double)NAN; /* no point: there is no largest error either */
    return (norm_result){.l1 = error / weight,
                         .l1rel = error / sum_value(&n->exact),
                         .l2 = sqrt(square / weight),
                         .l2rel = sqrt(square / sum_value(&n->exact_square)),
                         .linf = n->largest_error + none,
                         .linfrel = n->largest_error / n->largest_exact + none};
}

double guilkey_eq13(size_t n, const double *sum, double pressure, double inner_radius, double outer_radius)
{
    const double inner = inner_radius * inner_radius;
    const double exact = 2.0 * pressure * inner / (outer_radius * outer_radius - inner);
    norm errors = {0};
    for (size_t i = 0; i < n; i++) norm_add(&errors, fabs(sum[i]), fabs(exact), 1.0);
    return norm_finish(&errors).l1rel;
}

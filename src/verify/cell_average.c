/* Cell averages of exact solutions: product Gauss-Legendre, split at known breaks and then adaptively. */
#include "verify/exact.h"

#include <math.h>

enum { COARSE = 4, FINE = 6 };

/* Nodes and weights on [-1, 1] (Abramowitz & Stegun, table 25.4). */
static const double coarse_node[COARSE] = {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                                           0.86113631159405257522};
static const double coarse_weight[COARSE] = {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                                             0.34785484513745385737};
static const double fine_node[FINE] = {-0.93246951420315202781, -0.66120938646626451366, -0.23861918608319690863,
                                       0.23861918608319690863,  0.66120938646626451366,  0.93246951420315202781};
static const double fine_weight[FINE] = {0.17132449237917034504, 0.36076157304813860757, 0.46791393457269104739,
                                         0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504};

/* Halvings along every axis, by dimension: where a kink lies inside a cell, the cost grows as 2^((dim-1) depth). */
static const int most_halvings[4] = {0, 46, 7, 4};
/* Boxes a piece may be split into, so that values known only to a noise above `agreement` end the search too. */
enum { MOST_BOXES = 4096 };

/* Of 4 and 6 points an axis, by dimension: what they differ by is the error of the 4, in the eighth power of a box's
 * size; that of the 6, the result, is in the twelfth. Where a box may be halved often, a kink off the breaks is
 * followed down to this. */
static const double agreement[4] = {0.0, 1e-13, 1e-12, 1e-12};

typedef struct integrand {
    const exact *solution;
    exact_quantity quantity;
    int dim;
    double t;
    int flags;
    double scale; /* largest |value| met */
    double total; /* weight of the whole piece: errors are measured against scale * total */
    int boxes;    /* split so far */
} integrand;

/* Integrals over a box: of quantity times weight, and of the weight. */
typedef struct integral {
    double value, weight;
} integral;

static double weight_at(const integrand *f, const double x[3])
{
    double weight = 1.0;
    if (f->flags & EXACT_RADIAL) weight *= x[0];
    if (f->flags & EXACT_MASS_WEIGHTED) weight *= exact_value(f->solution, EXACT_DENSITY, x, f->t);
    return weight;
}

static integral integrate_box(integrand *f, const double lo[3], const double hi[3], int n, const double *node,
                              const double *weight)
{
    const int count[3] = {n, f->dim > 1 ? n : 1, f->dim > 2 ? n : 1};
    integral sum = {0.0, 0.0};
    for (int k = 0; k < count[2]; k++) {
        for (int j = 0; j < count[1]; j++) {
            for (int i = 0; i < count[0]; i++) {
                const int at[3] = {i, j, k};
                double x[3] = {0.0, 0.0, 0.0};
                double measure = 1.0;
                for (int axis = 0; axis < f->dim; axis++) {
                    const double half = 0.5 * (hi[axis] - lo[axis]);
                    x[axis] = 0.5 * (lo[axis] + hi[axis]) + half * node[at[axis]];
                    measure *= half * weight[at[axis]];
                }
                const double value = exact_value(f->solution, f->quantity, x, f->t);
                if (!(fabs(value) <= f->scale)) f->scale = fabs(value);
                measure *= weight_at(f, x);
                sum.value += measure * value;
                sum.weight += measure;
            }
        }
    }
    return sum;
}

static integral integrate_adaptively(integrand *f, const double lo[3], const double hi[3], int depth)
{
    const integral coarse = integrate_box(f, lo, hi, COARSE, coarse_node, coarse_weight);
    const integral fine = integrate_box(f, lo, hi, FINE, fine_node, fine_weight);
    if (f->boxes == 0) f->total = fabs(fine.weight);
    const double enough = agreement[f->dim] * f->total;
    const bool agree =
        fabs(fine.value - coarse.value) <= enough * f->scale && fabs(fine.weight - coarse.weight) <= enough;
    if (agree || depth == 0 || f->boxes > MOST_BOXES || !isfinite(fine.value)) return fine;
    f->boxes++;

    integral sum = {0.0, 0.0};
    for (int part = 0; part < 1 << f->dim; part++) {
        double part_lo[3] = {lo[0], lo[1], lo[2]};
        double part_hi[3] = {hi[0], hi[1], hi[2]};
        for (int axis = 0; axis < f->dim; axis++) {
            const double middle = 0.5 * (lo[axis] + hi[axis]);
            if (part >> axis & 1) {
                part_lo[axis] = middle;
            } else {
                part_hi[axis] = middle;
            }
        }
        const integral piece = integrate_adaptively(f, part_lo, part_hi, depth - 1);
        sum.value += piece.value;
        sum.weight += piece.weight;
    }
    return sum;
}

double exact_cell_average(const exact *solution, exact_quantity quantity, const double lo[3], const double hi[3],
                          double t, int flags)
{
    const int dim = solution->dim;
    integrand f = {.solution = solution, .quantity = quantity, .dim = dim, .t = t, .flags = flags};
    for (int axis = 0; axis < dim; axis++) {
        if (!(lo[axis] < hi[axis])) return NAN;
    }
    const exact_breaks breaks = exact_find_breaks(solution, t);
    double from[3] = {0.0, 0.0, 0.0};
    double to[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < dim; axis++) {
        from[axis] = lo[axis];
        to[axis] = hi[axis];
    }

    integral sum = {0.0, 0.0};
    for (int i = 0; i <= breaks.count; i++) {
        if (i < breaks.count) {
            const double at = breaks.position[i];
            if (breaks.axis >= dim || !(at > from[breaks.axis] && at < hi[breaks.axis])) continue;
            to[breaks.axis] = at;
        } else if (breaks.count > 0 && breaks.axis < dim) {
            to[breaks.axis] = hi[breaks.axis];
        }
        f.boxes = 0;
        const integral piece = integrate_adaptively(&f, from, to, most_halvings[dim]);
        sum.value += piece.value;
        sum.weight += piece.weight;
        if (breaks.axis < dim) from[breaks.axis] = to[breaks.axis];
    }
    return sum.value / sum.weight;
}

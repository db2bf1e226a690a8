/* Weights of places, made to have a given sum and centre: each times a factor that is linear in its place. A place is a row, 1 first and then its coordinates from the centre,
 * of a size of one or so; up to three axes. */
#ifndef MATH_LINEAR_WEIGHTS_H
#define MATH_LINEAR_WEIGHTS_H

#include "math/small_solve.h"

enum { LINEAR_TERMS = 4 };

typedef struct linear_weights {
    int n; /* terms of a row: 1 and the axes */
    double moment[LINEAR_TERMS * LINEAR_TERMS], factor[LINEAR_TERMS];
    double sum[LINEAR_TERMS]; /* of the new weights, and their first moments */
} linear_weights;

static inline linear_weights linear_weights_begin(int dim)
{
    return (linear_weights){.n = 1 + dim, .factor = {1.0}};
}

static inline void linear_weights_add(linear_weights *w, const double row[LINEAR_TERMS], double weight)
{
    for (int a = 0; a < w->n; ++a)
        for (int b = 0; b < w->n; ++b) w->moment[w->n * a + b] += weight * row[a] * row[b];
}

/* Finds the factor once all have been added. False: the places do not allow it. */
static inline bool linear_weights_solve(linear_weights *w)
{
    return small_solve_symmetric(w->n, w->moment, w->factor);
}

/* The new weight of a place. */
static inline double linear_weights_take(linear_weights *w, const double row[LINEAR_TERMS], double weight)
{
    double factor = 0.0;
    for (int a = 0; a < w->n; ++a) factor += w->factor[a] * row[a];
    for (int a = 0; a < w->n; ++a) w->sum[a] += weight * factor * row[a];
    return weight * factor;
}

/* Whether those that were taken sum to one about the centre. Else the places were all but singular, and the weights are noise. */
static inline bool linear_weights_hold(const linear_weights *w)
{
    bool hold = true;
    for (int a = 0; a < w->n; ++a) hold = hold && fabs(w->sum[a] - (a == 0 ? 1.0 : 0.0)) <= 1e-12;
    return hold;
}

#endif

/* Components of a node, two at a time: node data is interleaved, and compilers do not find the pairs by themselves. Each
 * lane is an ordinary double operation, so that results do not depend on the width of the machine's registers. */
#ifndef MPM_PAIRS_H
#define MPM_PAIRS_H

#include "base/compiler.h"

/* Aligned as doubles are: nodes begin anywhere. */
typedef double pair __attribute__((vector_size(16), aligned(8), may_alias));

enum { PAIRS_MAX = 3 };

/* Up to six components; a lane beyond them is of no meaning. */
typedef struct pairs {
    pair p[PAIRS_MAX];
} pairs;

FLOE_ALWAYS_INLINE double pairs_get(const pairs *x, int component)
{
    return x->p[component / 2][component % 2];
}

FLOE_ALWAYS_INLINE pairs pairs_zero(void)
{
    return (pairs){{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}};
}

FLOE_ALWAYS_INLINE pairs pairs_of(double a, double b, double c, double d)
{
    return (pairs){{{a, b}, {c, d}, {0.0, 0.0}}};
}

/* sum += s x over n components. */
FLOE_ALWAYS_INLINE void pairs_add(pairs *sum, double s, const pairs *x, const int n)
{
    for (int c = 0; c < (n + 1) / 2; ++c) sum->p[c] += s * x->p[c];
}

/* sum += s node over n components; reads one beyond where n is odd. */
FLOE_ALWAYS_INLINE void pairs_gather(pairs *sum, double s, const double *node, const int n)
{
    for (int c = 0; c < (n + 1) / 2; ++c) sum->p[c] += s * *(const pair *)(const void *)(node + 2 * c);
}

/* node += s x over n components. */
FLOE_ALWAYS_INLINE void pairs_scatter(double *node, double s, const pairs *x, const int n)
{
    for (int c = 0; c < n / 2; ++c) *(pair *)(void *)(node + 2 * c) += s * x->p[c];
    if (n % 2) node[n - 1] += s * x->p[n / 2][0];
}

/* node += s x + t y over n components. */
FLOE_ALWAYS_INLINE void pairs_scatter_two(double *node, double s, const pairs *x, double t, const pairs *y, const int n)
{
    for (int c = 0; c < n / 2; ++c) *(pair *)(void *)(node + 2 * c) += s * x->p[c] + t * y->p[c];
    if (n % 2) node[n - 1] += s * x->p[n / 2][0] + t * y->p[n / 2][0];
}

#endif

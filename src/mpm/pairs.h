/* Components of a node, two at a time: node data is interleaved, and compilers do not find the pairs by themselves. */
#ifndef MPM_PAIRS_H
#define MPM_PAIRS_H

#include "base/compiler.h"

#include <string.h>

enum { PAIRS_MAX = 3 };

/* Up to six components; a lane beyond them is of no meaning. */
typedef struct pairs {
    floe_pair p[PAIRS_MAX];
} pairs;

/* Two neighbours of a node's components. */
FLOE_ALWAYS_INLINE floe_pair pair_at(const double *node)
{
    floe_pair p;
    memcpy(&p, node, sizeof p);
    return p;
}

FLOE_ALWAYS_INLINE double pairs_get(const pairs *x, int component)
{
    return floe_pair_lane(x->p[component / 2], component % 2);
}

FLOE_ALWAYS_INLINE pairs pairs_of(double a, double b, double c, double d)
{
    const double all[2 * PAIRS_MAX] = {a, b, c, d};
    return (pairs){{pair_at(all), pair_at(all + 2), pair_at(all + 4)}};
}

FLOE_ALWAYS_INLINE pairs pairs_zero(void)
{
    return pairs_of(0.0, 0.0, 0.0, 0.0);
}

/* sum += s x over n components. */
FLOE_ALWAYS_INLINE void pairs_add(pairs *sum, double s, const pairs *x, const int n)
{
    for (int c = 0; c < (n + 1) / 2; ++c) sum->p[c] = floe_pair_sum(sum->p[c], floe_pair_times(s, x->p[c]));
}

/* sum += s node over n components; reads one beyond where n is odd. */
FLOE_ALWAYS_INLINE void pairs_gather(pairs *sum, double s, const double *node, const int n)
{
    for (int c = 0; c < (n + 1) / 2; ++c)
        sum->p[c] = floe_pair_sum(sum->p[c], floe_pair_times(s, pair_at(node + 2 * c)));
}

/* node += change over n components. */
FLOE_ALWAYS_INLINE void pairs_add_to(double *node, const pairs *change, const int n)
{
    for (int c = 0; c < n / 2; ++c) {
        const floe_pair sum = floe_pair_sum(pair_at(node + 2 * c), change->p[c]);
        memcpy(node + 2 * c, &sum, sizeof sum);
    }
    if (n % 2) node[n - 1] += pairs_get(change, n - 1);
}

/* node += s x over n components. */
FLOE_ALWAYS_INLINE void pairs_scatter(double *node, double s, const pairs *x, const int n)
{
    pairs change;
    for (int c = 0; c < (n + 1) / 2; ++c) change.p[c] = floe_pair_times(s, x->p[c]);
    pairs_add_to(node, &change, n);
}

/* node += s x + t y over n components. */
FLOE_ALWAYS_INLINE void pairs_scatter_two(double *node, double s, const pairs *x, double t, const pairs *y, const int n)
{
    pairs change;
    for (int c = 0; c < (n + 1) / 2; ++c)
        change.p[c] = floe_pair_sum(floe_pair_times(s, x->p[c]), floe_pair_times(t, y->p[c]));
    pairs_add_to(node, &change, n);
}

#endif

/* Components of a node side by side: node data is interleaved, and compilers do not vectorise such code by themselves. */
#ifndef MPM_LANES_H
#define MPM_LANES_H

#include "base/compiler.h"

#include <string.h>

enum { MPM_MAX_RECORD = 8 }; /* doubles that a node has in a tile's window, at most */

/* Lanes that a vector of up to six components takes; what is beyond the components has no meaning. */
FLOE_ALWAYS_INLINE int lanes_of(const int components)
{
    return components > 4 ? 6 : components > 2 ? 4 : 2;
}

/* Doubles from one such vector to the next in the window of a tile: none of its quads lies across two lines of the cache. */
FLOE_ALWAYS_INLINE int lanes_reserved(const int n)
{
    return n > 4 ? 8 : n;
}

/* A vector of n lanes: a pair, a quad, or a quad and then a pair. n is a literal wherever it is used. */
typedef struct lanes {
    floe_pair pair;
    floe_quad quad;
} lanes;

/* All of it has a value, also what n leaves out: compilers may not see that nothing reads that. */
FLOE_ALWAYS_INLINE lanes lanes_zero(void)
{
    return (lanes){floe_pair_of(0.0, 0.0), floe_quad_of(0.0, 0.0, 0.0, 0.0)};
}

FLOE_ALWAYS_INLINE lanes lanes_at(const double *from, const int n)
{
    lanes x = lanes_zero();
    if (n > 2) memcpy(&x.quad, from, sizeof x.quad);
    if (n != 4) memcpy(&x.pair, n > 2 ? from + 4 : from, sizeof x.pair);
    return x;
}

FLOE_ALWAYS_INLINE void lanes_to(double *to, lanes x, const int n)
{
    if (n > 2) memcpy(to, &x.quad, sizeof x.quad);
    if (n != 4) memcpy(n > 2 ? to + 4 : to, &x.pair, sizeof x.pair);
}

/* Up to four components. */
FLOE_ALWAYS_INLINE lanes lanes_from(double a, double b, double c, double d, const int n)
{
    lanes x = lanes_zero();
    if (n > 2)
        x.quad = floe_quad_of(a, b, c, d);
    else
        x.pair = floe_pair_of(a, b);
    return x;
}

/* The first lanes of n: m of them, which may be as many or a smaller vector's. */
FLOE_ALWAYS_INLINE lanes lanes_head(lanes x, const int m, const int n)
{
    if (m == 2 && n > 2) memcpy(&x.pair, &x.quad, sizeof x.pair);
    return x;
}

FLOE_ALWAYS_INLINE double lanes_get(lanes x, int lane, const int n)
{
    if (n > 2 && lane < 4) return floe_quad_lane(x.quad, lane);
    return floe_pair_lane(x.pair, lane % 4);
}

FLOE_ALWAYS_INLINE lanes lanes_sum(lanes x, lanes y, const int n)
{
    if (n > 2) x.quad = floe_quad_sum(x.quad, y.quad);
    if (n != 4) x.pair = floe_pair_sum(x.pair, y.pair);
    return x;
}

FLOE_ALWAYS_INLINE lanes lanes_times(double s, lanes x, const int n)
{
    if (n > 2) x.quad = floe_quad_times(s, x.quad);
    if (n != 4) x.pair = floe_pair_times(s, x.pair);
    return x;
}

/* x + s y. */
FLOE_ALWAYS_INLINE lanes lanes_plus(lanes x, double s, lanes y, const int n)
{
    return lanes_sum(x, lanes_times(s, y, n), n);
}

/* to += x. */
FLOE_ALWAYS_INLINE void lanes_add_to(double *to, lanes x, const int n)
{
    lanes_to(to, lanes_sum(lanes_at(to, n), x, n), n);
}

#endif

/* One of two doubles without a branch. Compilers make branches of `c ? a : b` where several choices hang on the same
 * condition, and then do not vectorise the loop, or load and compute both sides twice over. */
#ifndef BASE_CHOICE_H
#define BASE_CHOICE_H

#include "base/compiler.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* All bits set, or none. */
typedef uint64_t choice;

FLOE_ALWAYS_INLINE choice choice_of(bool first)
{
    return first ? UINT64_MAX : 0;
}

/* `a` where the choice was made of true, else `b`; bit by bit, NaN and the sign of zero included. */
FLOE_ALWAYS_INLINE double chosen(choice c, double a, double b)
{
    uint64_t x, y;
    double z;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    x = (x & c) | (y & ~c);
    memcpy(&z, &x, sizeof z);
    return z;
}

#endif

/* What every law checks. Only src/material includes this. */
#ifndef MATERIAL_SOLID_CHECKS_H
#define MATERIAL_SOLID_CHECKS_H

#include "base/compiler.h"
#include "material/solid.h"

/* 0, or 1 + the first point whose J is not above zero (a NaN is not). The count has no branch, the search is rare. */
FLOE_ALWAYS_INLINE size_t solid_first_inverted(const solid_batch *b)
{
    long long bad = 0; /* as wide as a double, so that the loop is vectorised */
    for (size_t i = 0; i < b->n; i++) bad += !(b->J[i] > 0.0);
    if (FLOE_LIKELY(bad == 0)) return 0;
    size_t i = 0;
    while (b->J[i] > 0.0) i++;
    return i + 1;
}

#endif

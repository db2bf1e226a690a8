/* Which fluids have their faces from the waves that meet there (theory 2.17). */
#ifndef ICE_TRACED_H
#define ICE_TRACED_H

#include "ice/ice_view.h"

/* Whether faces may be traced in the scene, and whether some of a region are in this step. */
bool ice_may_trace(const ice *s);
bool ice_is_traced(const ice *s, const ice_region *g);
/* Whether some faces are not: fluids share cells, or boundaries cut them. Those are traced on both sides of which one fluid is alone (C_ALONE). */
bool ice_traces_in_part(const ice *s);
/* C_ALONE of a region, with a layer of ghosts. Reads ghosts of the state, and of C_OPEN. */
void ice_find_alone(const ice *s, const ice_region *g);

/* Whether a cell's faces are traced with a fluid, where its neighbours' are. */
static inline bool ice_traced_by(const ice_view *v, int r, ptrdiff_t at)
{
    return v->traced && (!v->alone || v->alone[at] == 1 + r);
}

/* Cells of a row, local i, that are traced with a fluid and so are those `back` before them: the next run of them from run->end on, below `end`. */
static inline bool ice_next_alone(const ice_view *v, int r, ptrdiff_t base, ptrdiff_t back, int end, ice_span *run)
{
    int i = run->end;
    if (!v->alone) {
        *run = (ice_span){i, end};
        return i < end;
    }
    const double *at = v->alone + base, *before = at - back, number = 1 + r;
    while (i < end && !(at[i] == number && before[i] == number)) ++i;
    run->first = i;
    while (i < end && at[i] == number && before[i] == number) ++i;
    run->end = i;
    return run->first < i;
}

#endif

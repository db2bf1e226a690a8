/* Which fluids have their faces from the waves that meet there (theory 2.17). */
#ifndef ICE_TRACED_H
#define ICE_TRACED_H

#include "ice/ice_view.h"

/* Whether faces may be traced in the scene, and whether some of a region are in this step. */
bool ice_may_trace(const ice *s);
bool ice_is_traced(const ice *s, const ice_region *g);
/* Whether some faces may not be: fluids share cells, or boundaries cut them. Those are traced on both sides of which cells are (C_ALONE). */
bool ice_traces_in_part(const ice *s);
/* Whether the fluids of a region move as one wherever they share cells, which are then traced too; else one is to be alone within two cells. */
bool ice_traces_shared(const ice *s, const ice_region *g);
/* Whether cells at interfaces bear their weight where it lies (ice_lean.h). Not beside boundaries that cut cells, about which faces of 2.2 bear it evenly. */
bool ice_bears_unevenly(const ice *s, const ice_region *g);
/* C_ALONE of a region, with a layer of ghosts. Reads ghosts of the state, and of C_OPEN. */
void ice_find_alone(const ice *s, const ice_region *g);

/* C_ALONE of a cell that several fluids share, in a view. */
static inline int ice_shared_number(const ice_view *v)
{
    return 1 + v->n_materials;
}

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

/* The same of cells that are traced in any way, shared ones too, and so are those `back` before them. */
static inline bool ice_next_traced(const ice_view *v, ptrdiff_t base, ptrdiff_t back, int end, ice_span *run)
{
    int i = run->end;
    const double *at = v->alone + base, *before = at - back;
    while (i < end && !(at[i] > 0.0 && before[i] > 0.0)) ++i;
    run->first = i;
    while (i < end && at[i] > 0.0 && before[i] > 0.0) ++i;
    run->end = i;
    return run->first < i;
}

#endif

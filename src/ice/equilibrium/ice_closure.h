/* Closure of cells of several materials; only this folder includes it. */
#ifndef ICE_CLOSURE_H
#define ICE_CLOSURE_H

#include "coupling/equilibrium.h"
#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/state/ice_lists.h"

/* Mixed cells whose equilibrium is solved as a batch. */
typedef struct ice_closing_cells {
    equilibrium_batch batch;
    isentrope path[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH];
    bool frozen[EQUILIBRIUM_BATCH]; /* cells almost in equilibrium, whose T and e stay */
    /* At the paths' ends: J/kg, J/(kg K), K. */
    double e[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH], cv[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH],
        T[ICE_MAX_MATERIALS][EQUILIBRIUM_BATCH];
} ice_closing_cells;

typedef struct ice_closure {
    int threads;
    unsigned **set;           /* of each thread, a row long */
    ice_closing_cells *cells; /* of each thread */
    /* Of each region and block: ice_mixed_cells; 1 + the step whose e_found and vol_found it has, 0: none. */
    ice_cell_list mixed[ICE_MAX_MATERIALS][MESH_MAX_BLOCKS];
    long saved[ICE_MAX_MATERIALS][MESH_MAX_BLOCKS];
} ice_closure;

/* Pressures and fractions of several materials in one block (theory 2.1). */
floe_status ice_mixture(ice *s, const ice_region *g, int block_id, const ice_view *v);
/* Saves the state that the closure of a block's cells will change, for ice_rollback_closure. */
void ice_save_found(ice *s, int block_id, const ice_view *v);

/* Whether a fluid's own pressure is the cell's (theory 2.15). */
static inline bool ice_near_pressure(const isentrope *own, double p)
{
    return fabs(own->p - p) < ICE_NEAR_ONE_PRESSURE * own->p && own->floor == 0.0;
}

#endif

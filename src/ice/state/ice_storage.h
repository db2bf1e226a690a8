/* Storage of the state; only this folder includes it. */
#ifndef ICE_STORAGE_H
#define ICE_STORAGE_H

#include "ice/state/ice_state.h"
#include "ice/state/ice_tiles.h"

typedef struct ice_storage ice_storage;

struct ice_storage {
    int threads;
    size_t tiles;
    double *metric[MESH_MAX_BLOCKS]; /* lower0, upper0, volume, area0, radius0: five runs of n + 5 */
    double *tile;                    /* TILE_VALUES of every global tile */
    double **buffer;                 /* one a thread */
    /* Of each material and row, ghosts too: cells from the first to the last that have the material (ice_span.c), and the same with two
     * rows and two cells more on every side; NULL where it is not looked for. */
    ice_span *span[MESH_MAX_BLOCKS], *near[MESH_MAX_BLOCKS];
    ice_span *sharp[MESH_MAX_BLOCKS]; /* ice_interface_spans */
};

#endif

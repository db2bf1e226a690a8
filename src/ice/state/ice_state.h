/* Storage of the state: scratch of the threads, and where materials and interfaces are along rows. */
#ifndef ICE_STATE_H
#define ICE_STATE_H

#include "ice/ice_view.h"

/* A thread's row of scratch: 16 times the cells of the longest row, or what it needs to advect. */
double *ice_buffer(const ice *s, int thread);
int ice_threads(const ice *s);
/* Chunks of a block for the threads, layers of cells across its slowest axis [first, end): whole tiles, so that no two threads meet in one. */
int ice_chunks(const ice *s, const block *b);
ice_span ice_chunk_of(const ice *s, const block *b, int chunk, int chunks);
/* Allocates tiles, buffers, and where `spans` the rows' spans. sweep: doubles that one thread needs to advect. */
floe_status ice_storage_create(ice *s, size_t sweep, bool spans);
void ice_storage_destroy(context *ctx, struct ice_storage **w);

/* ---- spans of rows: where a material is (ice_span.c), where interfaces are ---- */

/* Finds the cells of a row that contain a material, from its density with ghosts. */
void ice_find_span(const ice *s, const block *b, int r, int j, int k, const double *rho);
/* Sets what views have as `near`, after all rows of a region have been searched. */
void ice_widen_spans(const ice *s, const ice_region *g, int block_id);
/* Of each row of a block, ghosts too: cells from the first to the last at an interface. NULL: none are sharpened. */
ice_span *ice_interface_spans(const ice *s, int block_id);

#endif

/* Windows of tiles: the nodes that the points of a tile reach, with private sums that are added to the nodes in global tile order (docs/structure.md, Tiles),
 * and copies of nodes for interpolation back to the points. */
#ifndef MPM_WINDOWS_H
#define MPM_WINDOWS_H

#include "grid/tile_box.h"
#include "mpm/mpm.h"
#include "mpm/transfer/lanes.h"

enum { MPM_MAX_WINDOW = 343 }; /* nodes of a window, at most: 7^3, others 11^2 and 67 */

struct kernel_set;

struct mpm_windows {
    const struct kernel_set *kernel; /* of the scene's dimension, geometry and basis (kernels.h) */
    int window[MESH_MAX_DIM];        /* nodes of a tile's window along each axis */
    int window_nodes;
    int reach;    /* nodes by which the window begins before its tile */
    bool *active; /* per global tile: the current group has points there; owned */
};
floe_status windows_create(mpm *s);
void windows_free(mpm *s);

/* Calls for every tile of every block, side by side. */
typedef void tile_visitor(mpm *s, int group, int blk, int tile);
void visit_tiles(mpm *s, int group, tile_visitor *visit);

/* Node arrays that tiles' partials are summed into; a tile's partials hold the nodes of its window, interleaved. */
typedef struct node_target {
    double *array[MPM_MAX_RECORD]; /* NULL: padding */
    int components;                /* doubles of a record */
    int reach;                     /* nodes by which the window begins before its tile */
    int window[MESH_MAX_DIM];      /* nodes of it along each axis */
    bool largest;                  /* instead of the sum; -INFINITY where there is nothing */
} node_target;

/* Fields of a group, their components in order. */
node_target node_target_of(const mpm *s, int blk, int group, const field_id *id, int count);
/* Every node of a block and of one ghost layer becomes the sum of the partials of its active tiles, in global order. */
void gather_nodes(const mpm *s, int blk, const node_target *out);
/* Copies the window of a tile from node arrays: records of 1, 2, 4 or 8 components. */
void load_window(const mpm *s, int blk, const tile_box *t, const double *const *node, int count, double *window);

#endif

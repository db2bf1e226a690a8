/* Where a linear system lives: the whole mesh as one box of unknowns with a layer of ghosts, whatever blocks the fields
 * have. Unknowns are the cells, or (with one more along each axis) the nodes; every unknown may have several
 * components. */
#ifndef SOLVE_GRID_H
#define SOLVE_GRID_H

#include "grid/mesh.h"

typedef struct solve_grid {
    int dim;
    int n[MESH_MAX_DIM];            /* unknowns along each axis, 1 along unused ones */
    bool periodic[MESH_MAX_DIM];    /* unknown n is unknown 0 */
    int tile[MESH_MAX_DIM];         /* sums are taken within boxes of this many, then over these in order */
    ptrdiff_t stride[MESH_MAX_DIM]; /* of the linear index; 0 along unused axes */
    ptrdiff_t origin;               /* linear index of unknown (0, 0, 0) */
    size_t size;                    /* entries of an array, ghosts included */
} solve_grid;

/* A box of n[0] x n[1] x n[2] unknowns; `periodic` and `n` hold MESH_MAX_DIM entries, n is 1 along unused axes. */
solve_grid solve_grid_make(int dim, const int *n, const bool *periodic);
/* The entries of an array, one after the other without ghosts. */
solve_grid solve_grid_of_list(int n);
/* The cells of a mesh. */
solve_grid solve_grid_of_cells(const mesh *m);

static inline ptrdiff_t solve_index(const solve_grid *g, int i, int j, int k)
{
    return g->origin + i * g->stride[0] + j * g->stride[1] + k * g->stride[2];
}
/* Rows along axis 0: how many, and the index of the first unknown of one. */
static inline int solve_rows(const solve_grid *g)
{
    return g->n[1] * g->n[2];
}
static inline ptrdiff_t solve_row(const solve_grid *g, int row)
{
    return solve_index(g, 0, row % g->n[1], row / g->n[1]);
}
/* Threads are worth their start from so many unknowns on. */
static inline bool solve_is_large(const solve_grid *g)
{
    return (size_t)g->n[0] * (size_t)g->n[1] * (size_t)g->n[2] > 8192;
}

/* Ghosts beyond periodic ends; edges and corners stay. Others stay as they are: zero, unless someone wrote there. */
void solve_fill_periodic(const solve_grid *g, double *a);

#endif

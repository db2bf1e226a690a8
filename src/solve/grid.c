#include "solve/grid.h"

#include <string.h>

solve_grid solve_grid_make(int dim, const int *n, const bool *periodic)
{
    solve_grid g = {.dim = dim};
    ptrdiff_t stride = 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        g.n[a] = a < dim ? n[a] : 1;
        g.tile[a] = a < dim ? mesh_tile_width(dim) : 1;
        if (a >= dim) continue;
        g.periodic[a] = periodic[a];
        g.stride[a] = stride;
        g.origin += stride;
        stride *= n[a] + 2;
    }
    g.size = (size_t)stride;
    return g;
}

solve_grid solve_grid_of_list(int n)
{
    return (solve_grid){
        .dim = 1, .n = {n, 1, 1}, .tile = {mesh_tile_width(1), 1, 1}, .stride = {1, 0, 0}, .size = (size_t)n};
}

solve_grid solve_grid_of_cells(const mesh *m)
{
    return solve_grid_make(m->dim, m->n, m->periodic);
}

void solve_fill_periodic(const solve_grid *g, double *a)
{
    for (int axis = 0; axis < g->dim; ++axis) {
        if (!g->periodic[axis]) continue;
        const int across = axis == 0 ? 1 : 0, deep = axis == 2 ? 1 : 2;
        const ptrdiff_t far = g->n[axis] * g->stride[axis];
        for (int k = 0; k < g->n[deep]; ++k)
            for (int j = 0; j < g->n[across]; ++j) {
                const ptrdiff_t first = g->origin + j * g->stride[across] + k * g->stride[deep];
                a[first - g->stride[axis]] = a[first + far - g->stride[axis]];
                a[first + far] = a[first];
            }
    }
}

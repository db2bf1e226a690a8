#include "coupling/wall_response.h"

#include "base/memory.h"

void wall_response_free(wall_response *w)
{
    memory_free(w->ctx, &w->cell);
    memory_free(w->ctx, &w->push);
}

void wall_response_clear(wall_response *w)
{
    w->n_cells = w->n_pushes = 0;
}

floe_status wall_response_add_cells(wall_response *w, int n)
{
    if (w->n_cells + n > w->reserved_cells) {
        const int reserved = 2 * (w->n_cells + n);
        TRY(memory_resize(w->ctx, &w->cell, (size_t)reserved, sizeof *w->cell));
        w->reserved_cells = reserved;
    }
    for (int k = 0; k < n; ++k) w->cell[w->n_cells++] = (wall_cell){.first = -1};
    return FLOE_OK;
}

floe_status wall_response_add_push(wall_response *w, int cell, int vertex, const double area[3])
{
    int found = w->cell[cell].first;
    while (found >= 0 && w->push[found].vertex != vertex) found = w->push[found].next;
    if (found < 0) {
        if (w->n_pushes == w->reserved_pushes) {
            const int reserved = w->reserved_pushes > 0 ? 2 * w->reserved_pushes : 256;
            TRY(memory_resize(w->ctx, &w->push, (size_t)reserved, sizeof *w->push));
            w->reserved_pushes = reserved;
        }
        found = w->n_pushes++;
        w->push[found] = (wall_push){.vertex = vertex, .next = w->cell[cell].first};
        w->cell[cell].first = found;
    }
    for (int a = 0; a < 3; ++a) w->push[found].area[a] += area[a];
    return FLOE_OK;
}

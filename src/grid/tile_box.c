/* Tiles as boxes of global cells. */
#include "grid/tile_box.h"

tile_box tile_box_of(const mesh *m, const block *b, int tile_in_block)
{
    tile_box t = {.cells = {1, 1, 1}};
    int rest = tile_in_block;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        const int tile = b->tile_lo[a] + rest % b->tiles[a];
        rest /= b->tiles[a];
        t.first[a] = tile * m->tile[a];
        t.cells[a] = t.first[a] + m->tile[a] <= m->n[a] ? m->tile[a] : m->n[a] - t.first[a];
    }
    t.number = mesh_tile_of(m, t.first);
    return t;
}

void tile_nodes(const mesh *m, const tile_box *t, int end[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        end[a] = a < m->dim ? t->cells[a] + (t->first[a] + t->cells[a] == m->n[a] && !m->periodic[a] ? 1 : 0) : 1;
}

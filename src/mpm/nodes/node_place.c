/* Where nodes are in the blocks: a node has a copy in each block that sees it, and at periodic images. */
#include "mpm/nodes/node_place.h"

node_place owner_of_node(const mesh *m, const int node[MESH_MAX_DIM])
{
    int cell[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) cell[a] = a < m->dim && node[a] == m->n[a] ? node[a] - 1 : node[a];
    const int blk = mesh_block_of(m, cell);
    const block *b = &m->block[blk];
    return (node_place){blk, mesh_index(b, node[0] - b->lo[0], node[1] - b->lo[1], node[2] - b->lo[2])};
}

bool find_node_in_block(const mesh *m, const block *b, const int node[MESH_MAX_DIM], const int period[MESH_MAX_DIM],
                        ptrdiff_t *at)
{
    int local[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        local[a] = node[a] + period[a] * m->n[a] - b->lo[a];
        if (a < m->dim && (local[a] < -1 || local[a] > b->n[a] + 1)) return false;
    }
    *at = mesh_index(b, local[0], local[1], local[2]);
    return true;
}

/* Partial sums of tiles: a stage sums over the cells of a tile, and tiles are added in order, whatever the blocks and threads (docs/structure.md, Tiles). */
#include "ice/state/ice_tiles.h"
#include "ice/state/ice_storage.h"

#include <string.h>

double *ice_tile(const ice *s, const block *b, int i, int j, int k)
{
    const int cell[MESH_MAX_DIM] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
    return s->storage->tile + (size_t)mesh_tile_of(s->mesh, cell) * TILE_VALUES;
}

void ice_clear_tiles(ice *s)
{
    memset(s->storage->tile, 0, s->storage->tiles * TILE_VALUES * sizeof(double));
}

void ice_enter_tiles(ice *s)
{
    double sum[TILE_VALUES];
    domain_sum_tiles(s->mesh, s->storage->tile, TILE_VALUES, sum);
    ledger_add(s->ledger, LEDGER_MASS, LEDGER_BOUNDARY, sum[TILE_MASS]);
    ledger_add(s->ledger, LEDGER_MASS, LEDGER_DEFECT, sum[TILE_MASS_DEFECT]);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const ledger_quantity q = (ledger_quantity)(LEDGER_MOMENTUM_X + a);
        ledger_add(s->ledger, q, LEDGER_BOUNDARY, sum[TILE_MOMENTUM + a]);
        ledger_add(s->ledger, q, LEDGER_SOURCE, sum[TILE_SOURCE_MOMENTUM + a]);
        ledger_add(s->ledger, q, LEDGER_DEFECT, sum[TILE_MOMENTUM_DEFECT + a]);
    }
    ledger_turn(s->ledger, LEDGER_BOUNDARY, sum + TILE_MOMENTUM + 3, 1.0);
    ledger_turn(s->ledger, LEDGER_SOURCE, sum + TILE_SOURCE_MOMENTUM + 3, 1.0);
    ledger_turn(s->ledger, LEDGER_DEFECT, sum + TILE_MOMENTUM_DEFECT + 3, 1.0);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, sum[TILE_ENERGY]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, sum[TILE_SOURCE_ENERGY]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DEFECT, sum[TILE_DEFECT]);
    ledger_tally(s->ledger, COUNT_FLOORS, (long long)sum[TILE_FLOORS]);
    ledger_tally(s->ledger, COUNT_ENERGY_GUARDS, (long long)sum[TILE_GUARDS]);
}

void ice_sum_scratch(const ice *s, double sum[3])
{
    double *tile = s->storage->tile, all[TILE_VALUES];
    domain_sum_tiles(s->mesh, tile, TILE_VALUES, all);
    for (size_t t = 0; t < s->storage->tiles; ++t)
        for (int k = 0; k < 3; ++k) tile[t * TILE_VALUES + TILE_SCRATCH + k] = 0.0;
    for (int k = 0; k < 3; ++k) sum[k] = all[TILE_SCRATCH + k];
}

ice_rows ice_rows_of(const block *b, int axis, int ghost)
{
    ice_rows q = {0, 0, 1, 1};
    int nk = 1;
    if (b->dim > 1) {
        q.j0 = -ghost;
        q.nj = b->n[1] + 2 * ghost + (axis == 1);
    }
    if (b->dim > 2) {
        q.k0 = -ghost;
        nk = b->n[2] + 2 * ghost + (axis == 2);
    }
    q.n = q.nj * nk;
    return q;
}

int ice_rows_chunk(const ice *s, ice_rows q)
{
    return s->mesh->dim == 3 ? s->mesh->tile[2] * q.nj : s->mesh->tile[1];
}

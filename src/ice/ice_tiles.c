/* Tile partials: what a stage gathers over cells, added up in the order of tiles whatever the blocks and threads
 * (docs/structure.md, Tiles). */
#include "ice/ice_internal.h"

#include "base/text.h"

#include <stdio.h>
#include <string.h>

double *ice_tile(const ice *s, const block *b, int i, int j, int k)
{
    const int cell[MESH_MAX_DIM] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
    return s->work->tile + (size_t)mesh_tile_of(s->mesh, cell) * TILE_VALUES;
}

void ice_place_of(const ice *s, const block *b, const int cell[MESH_MAX_DIM], double x[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a) x[a] = a < b->dim ? mesh_centre(s->mesh, a, b->lo[a] + cell[a]) : 0.0;
}

void ice_side_place(const ice *s, const block *b, int axis, bool upper, const int cell[MESH_MAX_DIM],
                    double x[MESH_MAX_DIM])
{
    ice_place_of(s, b, cell, x);
    x[axis] = mesh_node(s->mesh, axis, b->lo[axis] + cell[axis] + upper);
}

void ice_clear_tiles(ice *s)
{
    memset(s->work->tile, 0, s->work->tiles * TILE_VALUES * sizeof(double));
}

void ice_enter_tiles(ice *s)
{
    double sum[TILE_VALUES];
    domain_sum_tiles(s->mesh, s->work->tile, TILE_VALUES, sum);
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

void ice_cell_of(const block *b, ptrdiff_t at, int cell[MESH_MAX_DIM])
{
    cell[0] = cell[1] = cell[2] = 0;
    for (int a = b->dim - 1; a >= 0; --a) {
        cell[a] = (int)(at / b->stride[a]) - MESH_GHOST;
        at %= b->stride[a];
    }
}

void ice_place(const ice *s, const block *b, ptrdiff_t at, int r, char *text, size_t size)
{
    ptrdiff_t rest = at;
    int cell[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = b->dim - 1; a >= 0; --a) {
        cell[a] = (int)(rest / b->stride[a]) - MESH_GHOST + b->lo[a];
        rest %= b->stride[a];
    }
    (void)snprintf(text, size, "cell (%d", cell[0]);
    for (int a = 1; a < b->dim; ++a) text_add(text, size, ", %d", cell[a]);
    const char *name = r >= 0 ? s->scene->material[s->material[r].scene_material].name : "";
    text_add(text, size, r >= 0 ? "), material %d (%s)" : ")", r, name);
}

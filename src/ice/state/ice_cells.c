/* Cells by their numbers: their positions, the block that owns them, their description in messages. */

#include "ice/state/ice_cells.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_lists.h"
#include "ice/state/ice_walk.h"

#include "base/memory.h"
#include "base/text.h"
#include "geom/compound.h"

#include <stdio.h>

bool ice_next_cell(const block *b, ice_walk *c)
{
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        if (++c->in[a] < b->n[a]) break;
        if (a == MESH_MAX_DIM - 1) return false;
        c->in[a] = 0;
    }
    for (int a = 0; a < MESH_MAX_DIM; ++a) c->cell[a] = b->lo[a] + c->in[a];
    c->at = mesh_index(b, c->in[0], c->in[1], c->in[2]);
    return true;
}

int ice_cell_number(const mesh *m, const int cell[MESH_MAX_DIM])
{
    return cell[0] + m->n[0] * (cell[1] + m->n[1] * cell[2]);
}

void ice_numbered_cell(const mesh *m, int number, int cell[MESH_MAX_DIM])
{
    cell[0] = number % m->n[0];
    cell[1] = number / m->n[0] % m->n[1];
    cell[2] = number / m->n[0] / m->n[1];
}

ice_owned_cell ice_find_cell(const ice *s, const int cell[MESH_MAX_DIM])
{
    const block *b = &s->mesh->block[mesh_block_of(s->mesh, cell)];
    return (ice_owned_cell){b, s->domain->fields[b->id],
                            mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], cell[2] - b->lo[2])};
}

floe_status ice_lists_create(ice *s, ice_cell_list list[MESH_MAX_BLOCKS])
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const int *n = s->mesh->block[id].n;
        TRY(memory_new(s->ctx, &list[id].at, (size_t)n[0] * (size_t)n[1] * (size_t)n[2], sizeof(ptrdiff_t)));
    }
    return FLOE_OK;
}

void ice_lists_destroy(context *ctx, ice_cell_list list[MESH_MAX_BLOCKS])
{
    for (int id = 0; id < MESH_MAX_BLOCKS; ++id) memory_free(ctx, &list[id].at);
}

floe_status ice_region_cells_create(ice *s, const shape *region, ice_region_cells *out)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const block *b = &s->mesh->block[id];
        ice_cell_list *list = &out->cells[id];
        size_t most = 0;
        for (ice_walk c = ICE_FIRST; ice_next_cell(b, &c);) most += ice_region_share(s->mesh, region, c.cell) > 0.0;
        TRY(memory_new(s->ctx, &list->at, most + 1, sizeof *list->at));
        TRY(memory_new(s->ctx, &out->share[id], most + 1, sizeof *out->share[id]));
        for (ice_walk c = ICE_FIRST; ice_next_cell(b, &c);) {
            const double share = ice_region_share(s->mesh, region, c.cell);
            if (!(share > 0.0)) continue;
            out->share[id][list->n] = share;
            list->at[list->n++] = c.at;
        }
    }
    return FLOE_OK;
}

void ice_region_cells_destroy(context *ctx, ice_region_cells *c)
{
    ice_lists_destroy(ctx, c->cells);
    for (int id = 0; id < MESH_MAX_BLOCKS; ++id) memory_free(ctx, &c->share[id]);
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

double ice_region_share(const mesh *m, const shape *region, const int cell[MESH_MAX_DIM])
{
    double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = mesh_node(m, a, cell[a]);
        hi[a] = lo[a] + m->h[a];
    }
    return region_share(region, m->dim, lo, hi, m->geometry == MESH_AXISYMMETRIC);
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

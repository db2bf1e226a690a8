/* The order of points: by tile, then cell, then id, independent of their history; and points that leave the domain. */
#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/edge/edge.h"
#include "mpm/nodes/wall_overlap.h"
#include "mpm/state/burn.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surfaces.h"

#include <math.h>
#include <string.h>

enum { GONE = -1 };

/* Place of a cell (local to the block) in the block's tile-major order. */
static int key_of_cell(const mesh *m, const block *b, const int local[MESH_MAX_DIM])
{
    int tile = 0, cell = 0, tile_row = 1, cell_row = 1;
    for (int a = 0; a < m->dim; ++a) {
        tile += tile_row * (local[a] / m->tile[a]);
        cell += cell_row * (local[a] % m->tile[a]);
        tile_row *= b->tiles[a];
        cell_row *= m->tile[a];
    }
    return tile * cell_row + cell;
}

static int cells_per_tile(const mesh *m)
{
    int cells = 1;
    for (int a = 0; a < m->dim; ++a) cells *= m->tile[a];
    return cells;
}

typedef struct positions {
    const double *x[MESH_MAX_DIM];
} positions;

/* Key of point k, or GONE when its cell is not in the block. */
static int key_of_point(const mesh *m, const block *b, const positions *p, size_t k)
{
    int local[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) {
        local[a] = mesh_cell_of(m, a, p->x[a][k]) - b->lo[a];
        if (local[a] < 0 || local[a] >= b->n[a]) return GONE;
    }
    return key_of_cell(m, b, local);
}

static positions positions_of(const mpm *s, int blk, int body, bool next)
{
    positions p = {{NULL}};
    for (int a = 0; a < s->mesh->dim; ++a)
        p.x[a] = next ? field_next(s->domain->fields[blk], P_POS, body, a)
                      : field_get(s->domain->fields[blk], P_POS, body, a);
    return p;
}

/* Within a cell by id: insertion, as the order is nearly right already. */
static void order_by_id(uint32_t *order, size_t n, const double *id)
{
    for (size_t k = 1; k < n; ++k) {
        const uint32_t moving = order[k];
        size_t at = k;
        while (at > 0 && id[order[at - 1]] > id[moving]) {
            order[at] = order[at - 1];
            --at;
        }
        order[at] = moving;
    }
}

/* Scratch of one sort. */
typedef struct sort_scratch {
    int *key;
    uint32_t *order, *count;
} sort_scratch;

static void free_sort_scratch(context *ctx, sort_scratch *r)
{
    memory_free(ctx, &r->key);
    memory_free(ctx, &r->order);
    memory_free(ctx, &r->count);
}

/* Counting sort on the keys; points that are GONE drop out. Returns how many stay. */
static size_t count_sort(const sort_scratch *r, size_t n, int keys, const double *id)
{
    memset(r->count, 0, ((size_t)keys + 1) * sizeof(uint32_t));
    for (size_t k = 0; k < n; ++k)
        if (r->key[k] != GONE) r->count[r->key[k] + 1]++;
    for (int c = 0; c < keys; ++c) r->count[c + 1] += r->count[c];
    for (size_t k = 0; k < n; ++k)
        if (r->key[k] != GONE) r->order[r->count[r->key[k]]++] = (uint32_t)k;
    /* Each count now holds the end of its cell. */
    for (int c = 0; c < keys; ++c) {
        const uint32_t from = c ? r->count[c - 1] : 0;
        order_by_id(r->order + from, r->count[c] - from, id);
    }
    return keys ? r->count[keys - 1] : 0;
}

static floe_status sort_with(mpm *s, int blk, int body, sort_scratch *r)
{
    const mesh *m = s->mesh;
    const block *b = &m->block[blk];
    mpm_points *points = &s->points[blk][body];
    const int per_tile = cells_per_tile(m), keys = b->n_tiles * per_tile;
    TRY(memory_new(s->ctx, &r->key, points->n, sizeof(int)));
    TRY(memory_new(s->ctx, &r->order, points->n, sizeof(uint32_t)));
    TRY(memory_new(s->ctx, &r->count, (size_t)keys + 1, sizeof(uint32_t)));
    const positions p = positions_of(s, blk, body, false);
    const double *share = field_get(s->domain->fields[blk], P_SHARE, body, 0);
    for (size_t k = 0; k < points->n; ++k) r->key[k] = share && share[k] == 0.0 ? GONE : key_of_point(m, b, &p, k);
    const size_t kept = count_sort(r, points->n, keys, field_get(s->domain->fields[blk], P_ID, body, 0));
    points->n = kept;
    points->tile_start[0] = 0;
    for (int t = 0; t < b->n_tiles; ++t) points->tile_start[t + 1] = r->count[(t + 1) * per_tile - 1];
    fields_permute_points(s->domain->fields[blk], body, kept, r->order);
    return FLOE_OK;
}

static floe_status sort_body(mpm *s, int blk, int body)
{
    sort_scratch scratch = {0};
    const floe_status status = sort_with(s, blk, body, &scratch);
    free_sort_scratch(s->ctx, &scratch);
    return status;
}

floe_status mpm_resort(mpm *s)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) TRY(sort_body(s, b, body));
    return FLOE_OK;
}

/* A point that has left takes its mass and momentum with it. */
static void enter_loss(mpm *s, int blk, int body, size_t k)
{
    const fields *f = s->domain->fields[blk];
    const double mass = field_get(f, P_MASS, body, 0)[k];
    ledger_add(s->ledger, LEDGER_MASS, LEDGER_BOUNDARY, -mass);
    double kinetic = 0.0, x[MESH_MAX_DIM] = {0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[k];
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double v = field_get(f, P_VEL, body, a)[k];
        ledger_push(s->ledger, LEDGER_BOUNDARY, a, -mass * v, x);
        kinetic += 0.5 * mass * v * v;
    }
    const double *energy = field_get(f, P_ENERGY, body, 0), *T = field_get(f, P_TEMP, body, 0);
    const double heat = (energy ? energy[k] : 0.0) + (T ? s->body[body].specific_heat * T[k] : 0.0);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, -(kinetic + mass * heat));
    ledger_tally(s->ledger, COUNT_POINTS_LOST, 1);
}

static bool is_open(bc_kind kind)
{
    return kind == BC_FREE || kind == BC_INLET || bc_gives_pressure(kind);
}

/* Brings a point that lies beyond the mesh back: around a periodic axis, or onto the wall that it cannot have passed
 * but by round-off or a step at the limit. Beyond an open side it stays outside, and is lost. */
static bool bring_back(mpm *s, int blk, int body, size_t k)
{
    const mesh *m = s->mesh;
    bool outside = false;
    for (int a = 0; a < m->dim; ++a) {
        double *x = &field_get(s->domain->fields[blk], P_POS, body, a)[k];
        const int side = *x < m->lower[a] ? SIDE_LOWER : *x > m->upper[a] ? SIDE_UPPER : -1;
        if (side < 0) continue;
        if (m->periodic[a])
            *x = mesh_brought_around(m, a, *x);
        else if (body < s->n_deforming && !is_open(s->scene->bc.side[a][side].kind))
            *x = side == SIDE_LOWER ? m->lower[a] : m->upper[a];
        else
            outside = true;
    }
    return outside;
}

/* Deals with the points that left the mesh, in the tiles where some changed cell. True when there are such tiles, so
 * that the order must be made again. */
static bool has_moved(mpm *s, int blk, int body)
{
    const block *b = &s->mesh->block[blk];
    const positions now = positions_of(s, blk, body, false);
    bool moved = false;
    for (int t = 0; t < b->n_tiles; ++t) {
        const tile_box box = tile_box_of(s->mesh, b, t);
        const size_t *range = s->points[blk][body].tile_start + t;
        if (!((s->moved[box.number] >> body) & 1)) continue;
        moved = true;
        for (size_t k = range[0]; k < range[1]; ++k)
            if (key_of_point(s->mesh, b, &now, k) == GONE && bring_back(s, blk, body, k)) enter_loss(s, blk, body, k);
    }
    return moved;
}

/* Copies point k of one block to the end of another. */
static floe_status copy_point(mpm *s, int from, int to, int body, size_t k)
{
    mpm_points *target = &s->points[to][body];
    fields *source = s->domain->fields[from], *sink = s->domain->fields[to];
    TRY(fields_reserve_points(sink, body, target->n + 1));
    for (int id = 0; id < FIELD_COUNT; ++id) {
        const field_info *info = field_describe((field_id)id);
        if (info->centring != FIELD_POINT || !fields_has(source, (field_id)id, body)) continue;
        for (int c = 0; c < field_component_count(info->components, s->mesh->dim); ++c)
            field_get(sink, (field_id)id, body, c)[target->n] = field_get(source, (field_id)id, body, c)[k];
    }
    target->n++;
    return FLOE_OK;
}

/* Points whose cell belongs to another block go there; sorting drops them here. */
static floe_status migrate_points(mpm *s, int body)
{
    const mesh *m = s->mesh;
    size_t before[MESH_MAX_BLOCKS];
    for (int b = 0; b < m->n_blocks; ++b) before[b] = s->points[b][body].n;
    for (int b = 0; b < m->n_blocks; ++b)
        for (size_t k = 0; k < before[b]; ++k) {
            int cell[MESH_MAX_DIM] = {0, 0, 0};
            bool inside = true;
            for (int a = 0; a < m->dim; ++a) {
                cell[a] = mesh_cell_of(m, a, field_get(s->domain->fields[b], P_POS, body, a)[k]);
                inside = inside && cell[a] >= 0 && cell[a] < m->n[a];
            }
            const int to = inside ? mesh_block_of(m, cell) : b;
            if (to != b) TRY(copy_point(s, b, to, body, k));
        }
    return FLOE_OK;
}

floe_status mpm_commit(mpm *s)
{
    if (s->carries[P_SHARE]) burn_commit(s);
    for (int body = 0; body < s->n_bodies; ++body) {
        bool moved = false;
        for (int b = 0; b < s->mesh->n_blocks; ++b)
            if (has_moved(s, b, body)) moved = true;
        if (!moved) continue;
        ledger_tally(s->ledger, COUNT_REORDERS, 1);
        if (s->mesh->n_blocks > 1) TRY(migrate_points(s, body));
        for (int b = 0; b < s->mesh->n_blocks; ++b) TRY(sort_body(s, b, body));
    }
    double *swap = s->surfaces->corner;
    s->surfaces->corner = s->surfaces->corner_next;
    s->surfaces->corner_next = swap;
    commit_markers(s);
    edges_commit(s);
    overlaps_commit(s);
    s->dt_previous = s->dt;
    s->time += s->dt;
    return FLOE_OK;
}

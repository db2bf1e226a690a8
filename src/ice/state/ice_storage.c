/* Storage of the state of the cells: metrics of rows, tiles, scratch of threads, spans. */
#include "ice/state/ice_storage.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_state.h"

#include "base/memory.h"
#include "base/threads.h"

#include <math.h>

/* Volumes are positive in the ghosts beyond the axis too, which mirror the cells inside. */
static floe_status make_metrics(ice *s)
{
    const mesh *m = s->mesh;
    for (int id = 0; id < m->n_blocks; ++id) {
        const block *b = &m->block[id];
        const int run = b->n[0] + 2 * MESH_GHOST + 1;
        TRY(memory_new(s->ctx, &s->storage->metric[id], (size_t)run * 5, sizeof(double)));
        double *metric = s->storage->metric[id];
        for (int i = 0; i < run; ++i) {
            const int cell = b->lo[0] + i - MESH_GHOST;
            const double volume = fabs(mesh_cell_volume(m, cell));
            const bool plane = m->geometry == MESH_CARTESIAN;
            metric[i] = plane ? 1.0 / m->h[0] : fabs(mesh_face_area(m, 0, cell)) / volume;
            metric[run + i] = plane ? 1.0 / m->h[0] : fabs(mesh_face_area(m, 0, cell + 1)) / volume;
            metric[2 * run + i] = volume;
            metric[3 * run + i] = fabs(mesh_face_area(m, 0, cell));
            metric[4 * run + i] = mesh_node(m, 0, cell);
        }
    }
    return FLOE_OK;
}

static floe_status make_spans(ice *s, bool spans)
{
    ice_storage *w = s->storage;
    const bool sharp = ice_has_interfaces(s, &s->region[0]) && s->scene->method.limiter != ICE_LIMITER_FIRST_ORDER;
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const size_t rows = (size_t)ice_rows_of(&s->mesh->block[id], -1, MESH_GHOST).n;
        if (spans) {
            TRY(memory_new(s->ctx, &w->span[id], rows * (size_t)s->n_materials, sizeof(ice_span)));
            TRY(memory_new(s->ctx, &w->near[id], rows * (size_t)s->n_materials, sizeof(ice_span)));
        }
        if (sharp) TRY(memory_new(s->ctx, &w->sharp[id], rows, sizeof(ice_span)));
    }
    return FLOE_OK;
}

floe_status ice_storage_create(ice *s, size_t sweep, bool spans)
{
    TRY(memory_new(s->ctx, &s->storage, 1, sizeof *s->storage));
    ice_storage *w = s->storage;
    const size_t row = 16 * ((size_t)s->mesh->n[0] + 8);
    w->threads = threads_most();
    w->tiles = mesh_tiles(s->mesh);
    TRY(make_metrics(s));
    TRY(memory_new(s->ctx, &w->tile, w->tiles * TILE_VALUES, sizeof(double)));
    TRY(memory_new(s->ctx, &w->buffer, (size_t)w->threads, sizeof *w->buffer));
    for (int t = 0; t < w->threads; ++t)
        TRY(memory_new(s->ctx, &w->buffer[t], row > sweep ? row : sweep, sizeof(double)));
    return make_spans(s, spans);
}

void ice_storage_destroy(context *ctx, ice_storage **storage)
{
    ice_storage *w = *storage;
    if (!w) return;
    for (int b = 0; b < MESH_MAX_BLOCKS; ++b) {
        memory_free(ctx, &w->metric[b]);
        memory_free(ctx, &w->span[b]);
        memory_free(ctx, &w->near[b]);
        memory_free(ctx, &w->sharp[b]);
    }
    for (int t = 0; w->buffer && t < w->threads; ++t) memory_free(ctx, &w->buffer[t]);
    memory_free(ctx, &w->buffer);
    memory_free(ctx, &w->tile);
    memory_free(ctx, storage);
}

double *ice_buffer(const ice *s, int thread)
{
    return s->storage->buffer[thread];
}

int ice_threads(const ice *s)
{
    return s->storage->threads;
}

static int tile_layers(const block *b)
{
    return b->dim == 1 ? 1 : b->tiles[b->dim - 1];
}

int ice_chunks(const ice *s, const block *b)
{
    return ice_threads(s) < tile_layers(b) ? ice_threads(s) : tile_layers(b);
}

ice_span ice_chunk_of(const ice *s, const block *b, int chunk, int chunks)
{
    const int slow = b->dim - 1, tile = s->mesh->tile[slow], layers = tile_layers(b),
              end = layers * (chunk + 1) / chunks * tile;
    return (ice_span){layers * chunk / chunks * tile, end < b->n[slow] ? end : b->n[slow]};
}

ice_span *ice_interface_spans(const ice *s, int block_id)
{
    return s->storage->sharp[block_id];
}

/* Scratch of passes over the points. */
#include "mpm/transfer/scratch.h"

#include "base/memory.h"
#include "base/threads.h"
#include "grid/tile_box.h"

#include <string.h>

floe_status scratch_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->scratch, 1, sizeof *s->scratch));
    struct mpm_scratch *w = s->scratch;
    TRY(memory_new(s->ctx, &w->tile_sum, mesh_tiles(s->mesh) * MPM_TILE_SUMS, sizeof *w->tile_sum));
    return memory_new(s->ctx, &w->batch, (size_t)threads_most(), sizeof *w->batch);
}

void scratch_free(mpm *s)
{
    if (!s->scratch) return;
    memory_free(s->ctx, &s->scratch->tile_sum);
    memory_free(s->ctx, &s->scratch->batch);
    memory_free(s->ctx, &s->scratch);
}

void sum_over_tiles(mpm *s, int count, tile_adder *add, void *user, double *sum)
{
    double *tile_sum = s->scratch->tile_sum;
    memset(tile_sum, 0, mesh_tiles(s->mesh) * (size_t)count * sizeof *tile_sum);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            const tile_box box = tile_box_of(s->mesh, &s->mesh->block[b], t);
            add(s, b, t, user, tile_sum + (size_t)box.number * (size_t)count);
        }
    }
    domain_sum_tiles(s->mesh, tile_sum, count, sum);
}

#include "io/gather.h"

#include "base/memory.h"

#include <stdlib.h>

static int compare_id(const void *a, const void *b)
{
    const uint64_t x = ((const point_place *)a)->id;
    const uint64_t y = ((const point_place *)b)->id;
    return (x > y) - (x < y);
}

floe_status point_list_make(point_list *out, const sim *s, int body)
{
    *out = (point_list){.body = body, .n = mpm_body_points(s->mpm, body)};
    TRY(memory_new(s->ctx, &out->place, out->n, sizeof *out->place));
    size_t at = 0;
    for (int b = 0; b < s->mesh.n_blocks; b++) {
        const double *id = field_get(s->domain->fields[b], P_ID, body, 0);
        for (size_t i = 0; i < s->mpm->points[b][body].n; i++) {
            out->place[at++] = (point_place){(uint64_t)id[i], (uint32_t)b, (uint32_t)i};
        }
    }
    qsort(out->place, out->n, sizeof *out->place, compare_id);
    return FLOE_OK;
}

void point_list_free(context *ctx, point_list *list)
{
    memory_free(ctx, &list->place);
    *list = (point_list){0};
}

void gather_points(const sim *s, const point_list *list, field_id id, int comp, size_t stride, double *to)
{
    const double *from[MESH_MAX_BLOCKS];
    for (int b = 0; b < s->mesh.n_blocks; b++) from[b] = field_get(s->domain->fields[b], id, list->body, comp);
    for (size_t i = 0; i < list->n; i++) to[i * stride] = from[list->place[i].block][list->place[i].index];
}

/* Where in global order a row of a block's owned cells begins. */
static size_t row_start(const mesh *m, const block *b, int j, int k)
{
    return ((size_t)(b->lo[2] + k) * (size_t)m->n[1] + (size_t)(b->lo[1] + j)) * (size_t)m->n[0] + (size_t)b->lo[0];
}

void gather_cells(const sim *s, field_id id, int instance, int comp, size_t stride, double *to)
{
    const mesh *m = &s->mesh;
    for (int n = 0; n < m->n_blocks; n++) {
        const block *b = &m->block[n];
        const double *from = field_get(s->domain->fields[n], id, instance, comp);
        for (int k = 0; k < b->n[2]; k++) {
            for (int j = 0; j < b->n[1]; j++) {
                double *row = to + stride * row_start(m, b, j, k);
                for (int i = 0; i < b->n[0]; i++) row[stride * (size_t)i] = from[mesh_index(b, i, j, k)];
            }
        }
    }
}

void scatter_cells(const sim *s, field_id id, int instance, int comp, const double *from)
{
    const mesh *m = &s->mesh;
    for (int n = 0; n < m->n_blocks; n++) {
        const block *b = &m->block[n];
        double *to = field_get(s->domain->fields[n], id, instance, comp);
        for (int k = 0; k < b->n[2]; k++) {
            for (int j = 0; j < b->n[1]; j++) {
                const double *row = from + row_start(m, b, j, k);
                for (int i = 0; i < b->n[0]; i++) to[mesh_index(b, i, j, k)] = row[i];
            }
        }
    }
}

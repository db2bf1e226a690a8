#include "grid/stage.h"

#include "base/memory.h"
#include "base/timer.h"

#include <math.h>
#include <string.h>

void stage_list_init(stage_list *list, context *ctx)
{
    memset(list, 0, sizeof *list);
    list->ctx = ctx;
    list->running = -1;
}

void stage_list_destroy(stage_list *list)
{
    memory_free(list->ctx, &list->checksum);
}

static void record_uses(stage_list *list, const stage_fields *f)
{
    for (int k = 0; k < f->n; ++k)
        if (f->id[k] != STAGE_NONE) list->uses[f->id[k]] = true;
}

/* The stage's row; made at its first call. */
static int find_or_add(stage_list *list, const char *name, const stage_fields *reads, const stage_fields *writes)
{
    for (int k = 0; k < list->n; ++k)
        if (strcmp(list->record[k].name, name) == 0) return k;
    if (list->n == STAGE_MAX) return STAGE_MAX - 1;
    list->record[list->n] = (stage_record){.name = name, .reads = *reads, .writes = *writes};
    return list->n++;
}

static bool stage_contains(const stage_fields *f, int id)
{
    for (int k = 0; k < f->n; ++k)
        if (f->id[k] == id) return true;
    return false;
}

/* A checksum of the bits of everything owned by field id in all blocks (FNV-1a over words). */
static uint64_t checksum_of(const domain *d, field_id id)
{
    uint64_t sum = 1469598103934665603u;
    const int components = field_component_count(field_describe(id)->components, d->mesh->dim);
    for (int b = 0; b < d->mesh->n_blocks; ++b)
        for (int i = 0; i < FIELD_MAX_INSTANCES; ++i) {
            if (!fields_has(d->fields[b], id, i)) continue;
            const size_t n = field_describe(id)->centring == FIELD_POINT ? fields_point_capacity(d->fields[b], i)
                                                                         : d->mesh->block[b].size;
            for (int c = 0; c < components; ++c) {
                const double *a = field_get(d->fields[b], id, i, c);
                for (size_t k = 0; k < n; ++k) {
                    uint64_t bits;
                    memcpy(&bits, &a[k], sizeof bits);
                    sum = (sum ^ bits) * 1099511628211u;
                }
            }
        }
    return sum;
}

/* Before a checked stage: NaN into what it writes and does not read, checksums of all the rest. */
static void begin_check(stage_list *list, const stage_record *r)
{
    if (!list->checksum && memory_new(list->ctx, &list->checksum, FIELD_COUNT, sizeof(uint64_t)) != FLOE_OK) return;
    for (int k = 0; k < r->writes.n; ++k) {
        const int id = r->writes.id[k];
        if (id == STAGE_NONE || stage_contains(&r->reads, id)) continue;
        for (int b = 0; b < list->domain->mesh->n_blocks; ++b)
            for (int i = 0; i < FIELD_MAX_INSTANCES; ++i) field_poison(list->domain->fields[b], (field_id)id, i);
    }
    for (int id = 0; id < FIELD_COUNT; ++id)
        if (!stage_contains(&r->writes, id)) list->checksum[id] = checksum_of(list->domain, (field_id)id);
}

static floe_status end_check(stage_list *list, const stage_record *r)
{
    for (int id = 0; list->checksum && id < FIELD_COUNT; ++id)
        if (!stage_contains(&r->writes, id) && list->checksum[id] != checksum_of(list->domain, (field_id)id))
            return fail(list->ctx, FLOE_INTERNAL, "stage %s changed %s, which is not among what it writes", r->name,
                        field_describe((field_id)id)->name);
    return FLOE_OK;
}

bool stage_begin(stage_list *list, const char *name, stage_fields reads, stage_fields writes)
{
    list->running = find_or_add(list, name, &reads, &writes);
    if (list->planning) {
        record_uses(list, &reads);
        record_uses(list, &writes);
        return false;
    }
    if (list->checking) begin_check(list, &list->record[list->running]);
    list->started = wall_seconds();
    return true;
}

floe_status stage_end(stage_list *list, floe_status status)
{
    stage_record *r = &list->record[list->running];
    r->seconds += wall_seconds() - list->started;
    r->calls++;
    TRY(status);
    if (list->fail_at > 0 && --list->fail_at == 0)
        return fail(list->ctx, FLOE_RETRY, "stage %s was asked to fail", r->name);
    return list->checking ? end_check(list, r) : FLOE_OK;
}

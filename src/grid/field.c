#include "grid/field.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { POINT = FIELD_POINT, NODE = FIELD_NODE, CELL = FIELD_CELL, FACE = FIELD_FACE };
enum {
    SCALAR = FIELD_SCALAR,
    VECTOR = FIELD_VECTOR,
    STRESS = FIELD_STRESS,
    GRADIENT = FIELD_GRADIENT,
    DEFORM = FIELD_DEFORM
};
enum { STATE = FIELD_STATE, FIXED = FIELD_FIXED, SCRATCH = FIELD_SCRATCH, DIAGNOSTIC = FIELD_DIAGNOSTIC };

static const field_info table[FIELD_COUNT] = {
#define FIELD_ROW(id, name, centring, components, unit, class, meaning) \
    [id] = {name, unit, meaning, (field_centring)(centring), (field_components)(components), (field_class)(class)},
    FIELD_LIST(FIELD_ROW)
#undef FIELD_ROW
};

/* One registered instance of a field. */
typedef struct entry {
    bool present;
    double *current[FIELD_MAX_COMPONENTS];
    double *next[FIELD_MAX_COMPONENTS]; /* STATE only */
} entry;

struct fields {
    context *ctx;
    const block *block;
    size_t capacity[FIELD_MAX_INSTANCES]; /* points of each body */
    double *spare;                        /* for permutation; as long as the largest body */
    size_t spare_size;
    entry entry[FIELD_COUNT][FIELD_MAX_INSTANCES];
};

const field_info *field_describe(field_id id)
{
    return &table[id];
}

int field_component_count(field_components components, int dim)
{
    switch (components) {
    case FIELD_SCALAR: return 1;
    case FIELD_VECTOR: return dim;
    case FIELD_STRESS: return dim == 1 ? 3 : dim == 2 ? 4 : 6;
    case FIELD_GRADIENT: return dim * dim;
    case FIELD_DEFORM: return dim == 1 ? 3 : dim == 2 ? 5 : 9;
    }
    return 0;
}

static int components_of(const fields *f, field_id id)
{
    return field_component_count(table[id].components, f->block->dim);
}

static size_t length_of(const fields *f, field_id id, int instance)
{
    return table[id].centring == FIELD_POINT ? f->capacity[instance] : f->block->size;
}

floe_status fields_create(fields **out, context *ctx, const block *b)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    (*out)->block = b;
    return FLOE_OK;
}

void fields_destroy(fields **f)
{
    if (!f || !*f) return;
    context *ctx = (*f)->ctx;
    for (int id = 0; id < FIELD_COUNT; ++id)
        for (int i = 0; i < FIELD_MAX_INSTANCES; ++i)
            for (int c = 0; c < FIELD_MAX_COMPONENTS; ++c) {
                memory_free(ctx, &(*f)->entry[id][i].current[c]);
                memory_free(ctx, &(*f)->entry[id][i].next[c]);
            }
    memory_free(ctx, &(*f)->spare);
    memory_free(ctx, f);
}

floe_status fields_add(fields *f, field_id id, int instance)
{
    if (instance < 0 || instance >= FIELD_MAX_INSTANCES)
        return fail(f->ctx, FLOE_BAD_INPUT, "field %s has no instance %d: at most %d bodies or materials are held",
                    table[id].name, instance, FIELD_MAX_INSTANCES);
    entry *e = &f->entry[id][instance];
    if (e->present) return FLOE_OK;
    e->present = true;
    const size_t length = length_of(f, id, instance);
    for (int c = 0; c < components_of(f, id); ++c) {
        TRY(memory_new(f->ctx, &e->current[c], length, sizeof(double)));
        if (table[id].class == FIELD_STATE) TRY(memory_new(f->ctx, &e->next[c], length, sizeof(double)));
    }
    return FLOE_OK;
}

bool fields_has(const fields *f, field_id id, int instance)
{
    return instance >= 0 && instance < FIELD_MAX_INSTANCES && f->entry[id][instance].present;
}

double *field_get(const fields *f, field_id id, int instance, int comp)
{
    return f->entry[id][instance].current[comp];
}

double *field_next(const fields *f, field_id id, int instance, int comp)
{
    return f->entry[id][instance].next[comp];
}

static void commit_field(fields *f, int id)
{
    for (int i = 0; i < FIELD_MAX_INSTANCES; ++i) {
        entry *e = &f->entry[id][i];
        for (int c = 0; e->present && c < FIELD_MAX_COMPONENTS; ++c) {
            double *swap = e->current[c];
            e->current[c] = e->next[c];
            e->next[c] = swap;
        }
    }
}

void fields_commit(fields *f)
{
    for (int id = 0; id < FIELD_COUNT; ++id)
        if (table[id].class == FIELD_STATE) commit_field(f, id);
}

void fields_commit_points(fields *f)
{
    for (int id = 0; id < FIELD_COUNT; ++id)
        if (table[id].class == FIELD_STATE && table[id].centring == FIELD_POINT) commit_field(f, id);
}

static floe_status resize_points(fields *f, int body, size_t capacity)
{
    for (int id = 0; id < FIELD_COUNT; ++id) {
        entry *e = &f->entry[id][body];
        if (table[id].centring != FIELD_POINT || !e->present) continue;
        for (int c = 0; c < components_of(f, (field_id)id); ++c) {
            TRY(memory_resize(f->ctx, &e->current[c], capacity, sizeof(double)));
            if (e->next[c]) TRY(memory_resize(f->ctx, &e->next[c], capacity, sizeof(double)));
        }
    }
    return FLOE_OK;
}

floe_status fields_reserve_points(fields *f, int body, size_t capacity)
{
    if (capacity <= f->capacity[body]) return FLOE_OK;
    const size_t grown = f->capacity[body] + f->capacity[body] / 2;
    const size_t target = capacity > grown ? capacity : grown;
    TRY(resize_points(f, body, target));
    if (target > f->spare_size) {
        TRY(memory_resize(f->ctx, &f->spare, target, sizeof(double)));
        f->spare_size = target;
    }
    f->capacity[body] = target;
    return FLOE_OK;
}

size_t fields_point_capacity(const fields *f, int body)
{
    return f->capacity[body];
}

void fields_permute_points(fields *f, int body, size_t n, const uint32_t *order)
{
    if (n == 0) return;
    for (int id = 0; id < FIELD_COUNT; ++id) {
        entry *e = &f->entry[id][body];
        if (table[id].centring != FIELD_POINT || !e->present || table[id].class == FIELD_SCRATCH) continue;
        for (int c = 0; c < components_of(f, (field_id)id); ++c) {
            double *restrict from = e->current[c];
            /* A STATE field's next array is free between steps; FIXED fields go through the spare array. */
            double *restrict to = e->next[c] ? e->next[c] : f->spare;
            for (size_t k = 0; k < n; ++k) to[k] = from[order[k]];
            if (e->next[c]) {
                e->next[c] = from;
                e->current[c] = to;
            } else {
                memcpy(from, to, n * sizeof(double));
            }
        }
    }
}

floe_status fields_visit(const fields *f, field_visitor *visit, void *user)
{
    for (int id = 0; id < FIELD_COUNT; ++id)
        for (int i = 0; i < FIELD_MAX_INSTANCES; ++i)
            if (f->entry[id][i].present) TRY(visit(user, (field_id)id, i));
    return FLOE_OK;
}

uint64_t fields_bytes(const fields *f, field_id first, field_id last)
{
    uint64_t doubles = 0;
    for (field_id id = first; id <= last; ++id)
        for (int i = 0; i < FIELD_MAX_INSTANCES; ++i)
            if (f->entry[id][i].present)
                doubles +=
                    (uint64_t)components_of(f, id) * length_of(f, id, i) * (table[id].class == FIELD_STATE ? 2 : 1);
    return doubles * sizeof(double);
}

void field_poison(const fields *f, field_id id, int instance)
{
    const entry *e = &f->entry[id][instance];
    if (!e->present) return;
    double *const *array = table[id].class == FIELD_STATE ? e->next : e->current;
    const size_t n = length_of(f, id, instance);
    for (int c = 0; c < components_of(f, id); ++c)
        for (size_t k = 0; k < n; ++k) array[c][k] = NAN;
}

/* The registry of named arrays. Output, checkpoint, memory report, poison and ghost exchange iterate it; kernels are
 * handed the pointers. A field is registered by the plan; asking for one that is not there gives NULL. */
#ifndef GRID_FIELD_H
#define GRID_FIELD_H

#include "base/context.h"
#include "grid/field_list.h"
#include "grid/mesh.h"

#include <stdint.h>

typedef enum field_id {
#define FIELD_ENUM(id, name, centring, components, unit, class, meaning) id,
    FIELD_LIST(FIELD_ENUM)
#undef FIELD_ENUM
        FIELD_COUNT
} field_id;

typedef enum field_centring { FIELD_POINT, FIELD_NODE, FIELD_CELL, FIELD_FACE } field_centring;
typedef enum field_components {
    FIELD_SCALAR,
    FIELD_VECTOR,
    FIELD_STRESS,
    FIELD_GRADIENT,
    FIELD_DEFORM
} field_components;
typedef enum field_class { FIELD_STATE, FIELD_FIXED, FIELD_SCRATCH, FIELD_DIAGNOSTIC } field_class;

enum { FIELD_MAX_COMPONENTS = 9, FIELD_MAX_INSTANCES = 32 };

typedef struct field_info {
    const char *name, *unit, *meaning;
    field_centring centring;
    field_components components;
    field_class class;
} field_info;

/* The row of FIELD_LIST. */
const field_info *field_describe(field_id id);
/* Number of arrays of a field in a scene of dimension dim (1, 2, 3). */
int field_component_count(field_components components, int dim);

/* The fields of one block. Arrays of grid fields have block.size entries, arrays of point fields `capacity` entries of
 * their body. Owned by the set. */
typedef struct fields fields;

floe_status fields_create(fields **out, context *ctx, const block *b);
void fields_destroy(fields **f);

/* Registers instance `instance` of field `id` (twice is fine). Grid arrays are made at once, zeroed. */
floe_status fields_add(fields *f, field_id id, int instance);
bool fields_has(const fields *f, field_id id, int instance);

/* Array of component comp, or NULL if it is not registered. STATE fields have a current and a next array. */
double *field_get(const fields *f, field_id id, int instance, int comp);
double *field_next(const fields *f, field_id id, int instance, int comp);

/* Makes next the current state, by exchange of pointers, for all STATE fields; for those of points alone. */
void fields_commit(fields *f);
void fields_commit_points(fields *f);

/* Point storage of a body (instance): capacity grows by half; contents of current, next and fixed arrays are kept. */
floe_status fields_reserve_points(fields *f, int body, size_t capacity);
size_t fields_point_capacity(const fields *f, int body);
/* Reorders points [0, n) of a body: new[k] = old[order[k]], for FIXED fields and the current arrays of STATE fields. */
void fields_permute_points(fields *f, int body, size_t n, const uint32_t *order);

/* Calls visit for every registered (id, instance), in the order of FIELD_LIST then instance. */
typedef floe_status field_visitor(void *user, field_id id, int instance);
floe_status fields_visit(const fields *f, field_visitor *visit, void *user);

/* Bytes of all arrays whose id lies in [first, last]. */
uint64_t fields_bytes(const fields *f, field_id first, field_id last);

/* Debug builds: fills a field with NaN before it is written (STATE: its next array). */
void field_poison(const fields *f, field_id id, int instance);

#endif

#include "run/state_check.h"

#include <math.h>

static bool points_are_finite(const sim *s, field_id id, int instance, int comp)
{
    for (int b = 0; b < s->mesh.n_blocks; b++) {
        const double *value = field_get(s->domain->fields[b], id, instance, comp);
        const size_t n = s->mpm->points[b][instance].n;
        for (size_t i = 0; value && i < n; i++) {
            if (!isfinite(value[i])) return false;
        }
    }
    return true;
}

static bool row_is_finite(const double *row, int n)
{
    for (int i = 0; i < n; i++) {
        if (!isfinite(row[i])) return false;
    }
    return true;
}

static bool cells_are_finite(const sim *s, field_id id, int instance, int comp)
{
    for (int n = 0; n < s->mesh.n_blocks; n++) {
        const block *b = &s->mesh.block[n];
        const double *value = field_get(s->domain->fields[n], id, instance, comp);
        for (int k = 0; value && k < b->n[2]; k++) {
            for (int j = 0; j < b->n[1]; j++) {
                if (!row_is_finite(value + mesh_index(b, 0, j, k), b->n[0])) return false;
            }
        }
    }
    return true;
}

/* Anything but FLOE_OK ends the walk. */
static floe_status check_field(void *user, field_id id, int instance)
{
    const sim *s = user;
    const field_info *info = field_describe(id);
    const int components = field_component_count(info->components, s->mesh.dim);
    if (info->class != FIELD_STATE && info->class != FIELD_FIXED) return FLOE_OK;
    for (int c = 0; c < components; c++) {
        const bool finite = info->centring == FIELD_POINT ? points_are_finite(s, id, instance, c)
                                                          : cells_are_finite(s, id, instance, c);
        if (!finite) return FLOE_RETRY;
    }
    return FLOE_OK;
}

bool state_is_finite(const sim *s)
{
    return fields_visit(s->domain->fields[0], check_field, (void *)s) == FLOE_OK;
}

#include "verify/reference.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

const reference_model *reference_find(const char *name)
{
    for (size_t i = 0; i < reference_registry_size; i++) {
        if (strcmp(reference_registry[i]->name, name) == 0) return reference_registry[i];
    }
    return NULL;
}

size_t reference_quantity_find(const reference_model *model, const char *name)
{
    size_t q = 0;
    while (q < model->n_quantities && strcmp(model->quantities[q].name, name) != 0) q++;
    return q;
}

floe_status reference_create(context *ctx, const reference_model *model, const void *par, reference *out)
{
    *out = (reference){0};
    void *prepared = NULL;
    TRY(memory_new(ctx, &prepared, 1, model->prepared_size));
    const floe_status status = model->prepare != NULL ? model->prepare(ctx, par, prepared) : FLOE_OK;
    if (status != FLOE_OK) {
        memory_free(ctx, &prepared);
        return fail_under(ctx, status, KEY("verify", "reference", model->name));
    }
    *out = (reference){model, par, prepared};
    return FLOE_OK;
}

void reference_destroy(context *ctx, reference *r)
{
    if (r == NULL) return;
    memory_free(ctx, &r->prepared);
    *r = (reference){0};
}

floe_status reference_series(context *ctx, const reference *r, size_t n, const double *t, double *value)
{
    for (size_t i = 0; i < n; i++) {
        if (isfinite(t[i]) && t[i] >= (i > 0 ? t[i - 1] : 0.0)) continue;
        return fail(ctx, FLOE_BAD_INPUT, "time %zu of a history is %g s: must be finite, >= 0 and not before the last",
                    i + 1, t[i]);
    }
    return fail_under(ctx, r->model->series(ctx, r->par, r->prepared, n, t, value),
                      KEY("verify", "reference", r->model->name));
}

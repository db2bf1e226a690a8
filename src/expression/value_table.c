#include "expression/value_table.h"

#include "base/memory.h"

#include <gsl/gsl_interp.h>

#include <math.h>
#include <string.h>

struct value_table {
    double *at, *value; /* n, at growing */
    size_t n;
    gsl_interp *smooth; /* NULL: straight, or in steps */
    value_table_between between;
    value_table_beyond beyond;
};

static floe_status fill_table(context *ctx, value_table *t, const double *at, const double *value)
{
    TRY(memory_new(ctx, &t->at, t->n, sizeof *t->at));
    TRY(memory_new(ctx, &t->value, t->n, sizeof *t->value));
    memcpy(t->at, at, t->n * sizeof *at);
    memcpy(t->value, value, t->n * sizeof *value);
    /* Through two entries there is but the straight line. */
    if (t->between != TABLE_SMOOTH || t->n < 3) return FLOE_OK;
    t->smooth = gsl_interp_alloc(gsl_interp_steffen, t->n);
    if (!t->smooth) return fail(ctx, FLOE_NO_MEMORY, "no memory for a table of %zu entries", t->n);
    (void)gsl_interp_init(t->smooth, t->at, t->value, t->n);
    return FLOE_OK;
}

floe_status value_table_create(context *ctx, const double *at, const double *value, size_t n,
                               value_table_between between, value_table_beyond beyond, value_table **out)
{
    *out = NULL;
    if (n < 2) return fail(ctx, FLOE_BAD_INPUT, "a table needs two entries");
    for (size_t i = 1; i < n; ++i)
        if (!(at[i] > at[i - 1]))
            return fail(ctx, FLOE_BAD_INPUT, "entry %zu of a table is not after that before it", i + 1);
    TRY(memory_new(ctx, out, 1, sizeof **out));
    **out = (value_table){.n = n, .between = between, .beyond = beyond};
    const floe_status status = fill_table(ctx, *out, at, value);
    if (status != FLOE_OK) value_table_destroy(ctx, out);
    return status;
}

void value_table_destroy(context *ctx, value_table **table)
{
    if (!*table) return;
    gsl_interp_free((*table)->smooth);
    memory_free(ctx, &(*table)->at);
    memory_free(ctx, &(*table)->value);
    memory_free(ctx, table);
}

static double value_between(const value_table *t, double at)
{
    const size_t i = gsl_interp_bsearch(t->at, at, 0, t->n - 1);
    if (t->between == TABLE_STEPS) return t->value[at < t->at[t->n - 1] ? i : t->n - 1];
    if (t->smooth) return gsl_interp_eval(t->smooth, t->at, t->value, at, NULL);
    const double share = (at - t->at[i]) / (t->at[i + 1] - t->at[i]);
    return (1.0 - share) * t->value[i] + share * t->value[i + 1];
}

double value_table_at(const value_table *t, double at)
{
    const double first = t->at[0], last = t->at[t->n - 1];
    if (isnan(at)) return at;
    if (t->beyond == TABLE_REPEAT && isfinite(at)) {
        const double period = last - first, within = fmod(at - first, period);
        at = fmin(first + (within < 0.0 ? within + period : within), last);
    }
    if (t->beyond == TABLE_ZERO && (at < first || at > last)) return 0.0;
    return value_between(t, fmin(fmax(at, first), last));
}

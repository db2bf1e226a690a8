#include "verify/metric.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct metric_entry {
    const char *name, *doc;
} metric_entry;

static const metric_entry metric_table[] = {
#define METRIC_ENTRY(enumerator, name_, doc_) [enumerator] = {name_, doc_},
    METRIC_LIST(METRIC_ENTRY)
#undef METRIC_ENTRY
};

static const char *const with_quantity[] = {
#define METRIC_PATTERN(enumerator, name_, doc_) [enumerator] = name_ "_X",
    METRIC_LIST(METRIC_PATTERN)
#undef METRIC_PATTERN
};

metric_description metric_describe(metric_kind kind)
{
    if ((size_t)kind >= METRIC_COUNT) return (metric_description){"", ""};
    const char *name = kind == METRIC_EQ13 ? metric_table[kind].name : with_quantity[kind];
    return (metric_description){name, metric_table[kind].doc};
}

floe_status metric_parse(context *ctx, const char *name, metric *out)
{
    *out = (metric){METRIC_COUNT, EXACT_QUANTITY_COUNT};
    if (strcmp(name, metric_table[METRIC_EQ13].name) == 0) {
        out->kind = METRIC_EQ13;
        return FLOE_OK;
    }
    const char *split = strchr(name, '_');
    const size_t length = split != NULL ? (size_t)(split - name) : 0;
    for (size_t kind = 0; kind < METRIC_EQ13; kind++) {
        const char *prefix = metric_table[kind].name;
        if (length != strlen(prefix) || strncmp(name, prefix, length) != 0) continue;
        const exact_quantity quantity = exact_quantity_find(split + 1);
        if (quantity == EXACT_QUANTITY_COUNT) break;
        *out = (metric){(metric_kind)kind, quantity};
        return FLOE_OK;
    }
    return fail_key(ctx, KEY("verify", "metrics"),
                    "unknown metric '%s': must be eq13, or l1_X, l1rel_X, l2_X, l2rel_X, linf_X or linfrel_X with X a "
                    "quantity such as density, velocity_x, pressure, sigma_r",
                    name);
}

double metric_pick(metric_kind kind, const norm_result *norms)
{
    switch (kind) {
    case METRIC_L1: return norms->l1;
    case METRIC_L1REL: return norms->l1rel;
    case METRIC_L2: return norms->l2;
    case METRIC_L2REL: return norms->l2rel;
    case METRIC_LINF: return norms->linf;
    case METRIC_LINFREL: return norms->linfrel;
    case METRIC_EQ13:
    case METRIC_COUNT: break;
    }
    return NAN;
}

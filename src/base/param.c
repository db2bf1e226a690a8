#include "base/param.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool param_in_range(const param_spec *spec, double x)
{
    if (!isfinite(x)) return false;
    switch (spec->range) {
    case PARAM_ANY: return true;
    case PARAM_POSITIVE: return x > 0.0;
    case PARAM_NONNEGATIVE: return x >= 0.0;
    case PARAM_BETWEEN: return x >= spec->lo && x <= spec->hi;
    }
    return false;
}

void param_describe_range(const param_spec *spec, char *text, size_t size)
{
    switch (spec->range) {
    case PARAM_ANY: snprintf(text, size, "a finite number"); return;
    case PARAM_POSITIVE: snprintf(text, size, "a number > 0"); return;
    case PARAM_NONNEGATIVE: snprintf(text, size, "a number >= 0"); return;
    case PARAM_BETWEEN: snprintf(text, size, "a number from %g to %g", spec->lo, spec->hi); return;
    }
    snprintf(text, size, "a number in an unknown range");
}

static double *param_at(const param_spec *spec, void *par)
{
    return (void *)((char *)par + spec->offset);
}

void param_fill_defaults(const param_spec *specs, size_t n, void *par)
{
    for (size_t i = 0; i < n; i++) {
        const int count = specs[i].kind == PARAM_NUMBERS ? specs[i].count : 0;
        double *to = param_at(&specs[i], par);
        for (int k = 0; k < (count < 0 ? -count : count); k++) to[k] = specs[i].fallback;
    }
}

double *param_find(const param_spec *specs, size_t n, void *par, const char *key)
{
    for (size_t i = 0; i < n; i++) {
        if (specs[i].kind == PARAM_NUMBERS && strcmp(specs[i].key, key) == 0) return param_at(&specs[i], par);
    }
    return NULL;
}

#include "base/param.h"

#include <math.h>
#include <stdio.h>

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

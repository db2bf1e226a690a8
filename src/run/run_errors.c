#include "run/run_errors.h"

#include "verify/history_metric.h"
#include "verify/metric.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

double error_of(const run_summary *r, const char *name)
{
    for (int k = 0; k < r->n_errors; k++) {
        if (strcmp(r->errors[k].name, name) == 0) return r->errors[k].value;
    }
    return NAN;
}

static bool is_ratio_to_exact(const char *name)
{
    metric m;
    if (metric_parse(NULL, name, &m) != FLOE_OK) return false;
    return m.kind == METRIC_EQ13 || m.kind == METRIC_L1REL || m.kind == METRIC_L2REL || m.kind == METRIC_LINFREL;
}

bool error_is_relative(const char *name)
{
    const char *quantity;
    if (strncmp(name, "rel_", 4) == 0 || history_metric_parse(name, &quantity) != HISTORY_METRIC_COUNT) return true;
    return is_ratio_to_exact(name);
}

double error_floor(const run_summary *r, const char *name)
{
    return is_ratio_to_exact(name) ? r->reference_accuracy : 0.0;
}

const char *error_unit(const char *name, bool dimensionless)
{
    metric m;
    if (error_is_relative(name)) return "%";
    if (dimensionless || metric_parse(NULL, name, &m) != FLOE_OK) return "";
    const char *unit = exact_quantity_unit(m.quantity);
    return strcmp(unit, "1") == 0 ? "" : unit;
}

void error_number(const char *name, double error, char text[ERROR_TEXT])
{
    if (!isfinite(error)) {
        (void)snprintf(text, ERROR_TEXT, "-");
    } else if (error_is_relative(name)) {
        (void)snprintf(text, ERROR_TEXT, error < 1e-5 ? "%.1e" : "%.3f", 100.0 * error);
    } else {
        (void)snprintf(text, ERROR_TEXT, "%.4g", error);
    }
}

void error_text(const char *name, double error, bool dimensionless, char text[ERROR_TEXT])
{
    const char *unit = isfinite(error) ? error_unit(name, dimensionless) : "";
    error_number(name, error, text);
    text_add(text, ERROR_TEXT, "%s%s", unit[0] ? " " : "", unit);
}

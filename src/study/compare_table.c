/* A comparison as numbers: metrics, orders, the table. */
#include "study/compare.h"
#include "verify/metric.h"
#include "verify/order.h"

#include <math.h>
#include <string.h>

static bool is_listed(const char *const *name, int n, const char *wanted)
{
    for (int i = 0; i < n; i++) {
        if (strcmp(name[i], wanted) == 0) return true;
    }
    return false;
}

int compare_metrics(const comparison *c, const char *name[COMPARE_MAX_METRICS])
{
    int n = 0;
    for (size_t i = 0; i < c->n; i++) {
        const run_summary *r = &c->list[i].summary;
        for (int k = 0; k < r->n_errors && n < COMPARE_MAX_METRICS; k++) {
            if (!is_listed(name, n, r->errors[k].name)) name[n++] = r->errors[k].name;
        }
    }
    return n;
}

double compare_error(const compare_case *one, const char *name)
{
    for (int k = 0; k < one->summary.n_errors; k++) {
        if (strcmp(one->summary.errors[k].name, name) == 0) return one->summary.errors[k].value;
    }
    return NAN;
}

bool compare_is_relative(const char *name)
{
    metric m;
    if (strncmp(name, "rel_", 4) == 0) return true;
    if (metric_parse(NULL, name, &m) != FLOE_OK) return false;
    return m.kind == METRIC_EQ13 || m.kind == METRIC_L1REL || m.kind == METRIC_L2REL || m.kind == METRIC_LINFREL;
}

const char *compare_unit(const char *name)
{
    metric m;
    if (compare_is_relative(name)) return "%";
    if (metric_parse(NULL, name, &m) != FLOE_OK) return "";
    const char *unit = exact_quantity_unit(m.quantity);
    return strcmp(unit, "1") == 0 ? "" : unit;
}

int compare_couplings(const comparison *c, scene_coupling coupling[COUPLING_COUNT])
{
    int n = 0;
    for (size_t i = 0; i < c->n; i++) {
        bool known = false;
        for (int k = 0; k < n; k++) known = known || coupling[k] == c->list[i].coupling;
        if (!known && n < COUPLING_COUNT) coupling[n++] = c->list[i].coupling;
    }
    return n;
}

compare_order compare_fit(const comparison *c, scene_coupling coupling, const char *name)
{
    compare_order fit = {.order = NAN, .standard_error = NAN};
    order_fit found;
    for (size_t i = 0; i < c->n && fit.n < SCENE_MAX_AXIS; i++) {
        const double error = compare_error(&c->list[i], name);
        if (c->list[i].coupling != coupling || !isfinite(error) || !(error > 0.0)) continue;
        fit.h[fit.n] = c->list[i].h;
        fit.error[fit.n++] = error;
    }
    /* One spacing, or one case, has no order: that is no failure. */
    if (order_fit_power(NULL, fit.n, fit.h, fit.error, &found) == FLOE_OK) {
        fit.order = found.order;
        fit.standard_error = found.standard_error;
    }
    return fit;
}

/* Width of a metric's column. */
static int width_of(const char *name)
{
    const int length = (int)strlen(name);
    return length > 12 ? length : 12;
}

static const char *axis_name(const comparison *c)
{
    return c->axis.n_values == 0 ? "h" : strcmp(c->axis.key, "domain.cell") == 0 ? "h" : c->axis.key;
}

static void print_value(FILE *file, const char *name, double error)
{
    char text[64];
    if (!isfinite(error)) {
        (void)snprintf(text, sizeof text, "-");
    } else if (compare_is_relative(name)) {
        (void)snprintf(text, sizeof text, error < 1e-5 ? "%.1e %%" : "%.3f %%", 100.0 * error);
    } else {
        (void)snprintf(text, sizeof text, "%.4g %s", error, compare_unit(name));
    }
    (void)fprintf(file, "  %*s", width_of(name), text);
}

static void print_case(const comparison *c, const compare_case *one, const char *const *names, int n, FILE *file)
{
    char value[64];
    (void)snprintf(value, sizeof value, "%.6g", one->h);
    (void)fprintf(file, "%-8s  %12s", coupling_name(one->coupling), c->axis.n_values > 0 ? one->value : value);
    if (!one->ran) {
        (void)fprintf(file, "  (not run)\n");
        return;
    }
    (void)fprintf(file, "  %8lld  %8lld  %7lld", one->summary.points, one->summary.cells, one->summary.steps);
    for (int k = 0; k < n; k++) print_value(file, names[k], compare_error(one, names[k]));
    (void)fprintf(file, "  %9.3g s", one->summary.wall_seconds);
    if (strcmp(one->summary.status, "done") != 0 && strcmp(one->summary.status, "at_rest") != 0)
        (void)fprintf(file, "  %s", one->summary.status);
    (void)fprintf(file, "\n");
}

static void print_orders(const comparison *c, const char *const *names, int n, FILE *file)
{
    scene_coupling coupling[COUPLING_COUNT];
    const int couplings = compare_couplings(c, coupling);
    for (int k = 0; k < couplings; k++) {
        bool any = false;
        for (int m = 0; m < n; m++) {
            const compare_order fit = compare_fit(c, coupling[k], names[m]);
            if (!isfinite(fit.order)) continue;
            (void)fprintf(file, any ? ", " : "order in h, %s: ", coupling_name(coupling[k]));
            (void)fprintf(file, "%s %.2f", names[m], fit.order);
            if (isfinite(fit.standard_error)) (void)fprintf(file, " +- %.2f", fit.standard_error);
            any = true;
        }
        if (any) (void)fprintf(file, "\n");
    }
}

floe_status compare_print(const comparison *c, FILE *file)
{
    const char *names[COMPARE_MAX_METRICS];
    const int n = compare_metrics(c, names);
    if (c->title[0]) (void)fprintf(file, "%s\n", c->title);
    (void)fprintf(file, "%-8s  %12s  %8s  %8s  %7s", "coupling", axis_name(c), "points", "cells", "steps");
    for (int k = 0; k < n; k++) (void)fprintf(file, "  %*s", width_of(names[k]), names[k]);
    (void)fprintf(file, "  %11s\n", "wall time");
    for (size_t i = 0; i < c->n; i++) print_case(c, &c->list[i], names, n, file);
    print_orders(c, names, n, file);
    if (ferror(file)) return fail(c->ctx, FLOE_IO, "cannot write the table");
    return FLOE_OK;
}

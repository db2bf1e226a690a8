/* A comparison as numbers: metrics, orders, the table. */
#include "study/compare.h"
#include "study/errors.h"
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
        const run_summary *r = &c->run[i].summary;
        for (int k = 0; k < r->n_errors && n < COMPARE_MAX_METRICS; k++) {
            if (!is_listed(name, n, r->errors[k].name)) name[n++] = r->errors[k].name;
        }
    }
    return n;
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
        const double error = error_of(&c->run[i].summary, name);
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
    char text[ERROR_TEXT];
    error_text(name, error, text);
    (void)fprintf(file, "  %*s", width_of(name), text);
}

static void print_case(const comparison *c, size_t i, const char *const *names, int n, FILE *file)
{
    const compare_case *one = &c->list[i];
    const run_summary *r = &c->run[i].summary;
    char value[64];
    (void)snprintf(value, sizeof value, "%.6g", one->h);
    (void)fprintf(file, "%-8s  %12s", coupling_name(one->coupling), c->axis.n_values > 0 ? one->value : value);
    if (!c->run[i].ran) {
        (void)fprintf(file, "  %s %s\n", batch_status_name(&c->run[i]), c->run[i].message);
        return;
    }
    (void)fprintf(file, "  %8lld  %8lld  %7lld", r->points, r->cells, r->steps);
    for (int k = 0; k < n; k++) print_value(file, names[k], error_of(r, names[k]));
    (void)fprintf(file, "  %9.3g s", r->wall_seconds);
    if (c->run[i].status != FLOE_OK) (void)fprintf(file, "  %s", batch_status_name(&c->run[i]));
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
    for (size_t i = 0; i < c->n; i++) print_case(c, i, names, n, file);
    print_orders(c, names, n, file);
    if (ferror(file)) return fail(c->ctx, FLOE_IO, "cannot write the table");
    return FLOE_OK;
}

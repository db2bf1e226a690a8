/* A comparison as files: compare.json and its twin compare.csv. */
#include "io/file.h"
#include "io/strbuf.h"
#include "study/compare.h"
#include "study/errors.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static bool set(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

/* The summary of a case, with its place in the comparison. */
static json_t *case_json(const comparison *c, size_t i)
{
    const compare_case *one = &c->list[i];
    const batch_case *run = &c->run[i];
    json_t *object = summary_json(&run->summary);
    bool fine = object && set(object, "directory", json_string(run->folder)) && set(object, "h", number(one->h)) &&
                set(object, "message", json_string(run->message));
    if (fine && one->value[0]) fine = set(object, "axis", json_pack("{s:s}", c->axis.key, one->value));
    if (fine) return object;
    json_decref(object);
    return NULL;
}

static json_t *runs_json(const comparison *c)
{
    json_t *list = json_array();
    for (size_t i = 0; list && i < c->n; i++) {
        if (!c->run[i].ran) continue;
        if (json_array_append_new(list, case_json(c, i)) == 0) continue;
        json_decref(list);
        return NULL;
    }
    return list;
}

static json_t *numbers_json(const double *x, size_t n)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++) json_array_append_new(list, number(x[i]));
    return list;
}

static json_t *order_json(const compare_order *fit)
{
    return json_pack("{s:o, s:o, s:o, s:o}", "order", number(fit->order), "stderr", number(fit->standard_error),
                     "values", numbers_json(fit->error, fit->n), "h", numbers_json(fit->h, fit->n));
}

static json_t *orders_json(const comparison *c)
{
    const char *metric[COMPARE_MAX_METRICS];
    const int n = compare_metrics(c, metric);
    scene_coupling coupling[COUPLING_COUNT];
    const int couplings = compare_couplings(c, coupling);
    json_t *object = json_object();
    for (int k = 0; object && k < couplings; k++) {
        json_t *one = json_object();
        for (int m = 0; m < n; m++) {
            const compare_order fit = compare_fit(c, coupling[k], metric[m]);
            set(one, metric[m], order_json(&fit));
        }
        set(object, coupling_name(coupling[k]), one);
    }
    return object;
}

static json_t *axis_json(const scene_axis *axis)
{
    if (axis->n_values == 0) return json_null();
    json_t *values = json_array();
    for (int i = 0; i < axis->n_values; i++) json_array_append_new(values, json_string(axis->value[i]));
    return json_pack("{s:s, s:o}", "key", axis->key, "values", values);
}

static floe_status write_json(const comparison *c, const char *path)
{
    json_t *object = json_pack("{s:i, s:s, s:s, s:o, s:o, s:o}", "schema", 1, "deck", c->deck_path, "title", c->title,
                               "axis", axis_json(&c->axis), "runs", runs_json(c), "orders", orders_json(c));
    char *text = object ? json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(object);
    if (!text) return fail(c->ctx, FLOE_NO_MEMORY, "no memory for '%s'", path);
    const file_part part[] = {{text, strlen(text)}, {"\n", 1}};
    const floe_status status = file_replace(c->ctx, path, part, 2);
    free(text);
    return status;
}

static void append_names(const comparison *c, const char *const *metric, int n, strbuf *out)
{
    strbuf_append(out,
                  "coupling,%s,h (m),status,time (s),steps,rejected_steps,wall_seconds (s),cells,points,"
                  "cell_updates,point_updates,drift_mass,drift_momentum,drift_energy",
                  c->axis.n_values > 0 ? c->axis.key : "case");
    for (int k = 0; k < n; k++) {
        const bool unit = !error_is_relative(metric[k]) && error_unit(metric[k])[0];
        strbuf_append(out, ",%s%s%s%s", metric[k], unit ? " (" : "", unit ? error_unit(metric[k]) : "",
                      unit ? ")" : "");
    }
    strbuf_append(out, ",directory\n");
}

static void append_case(const compare_case *one, const batch_case *run, const char *const *metric, int n, strbuf *out)
{
    const run_summary *r = &run->summary;
    strbuf_append(out, "%s,", coupling_name(one->coupling));
    strbuf_append_csv(out, one->value);
    strbuf_append(out, ",%.17g,%s,%.17g,%lld,%lld,%.6g,%lld,%lld,%.17g,%.17g,%.6g,%.6g,%.6g", one->h, r->status,
                  r->time, r->steps, r->rejected_steps, r->wall_seconds, r->cells, r->points, r->cell_updates,
                  r->point_updates, r->drift_mass, r->drift_momentum, r->drift_energy);
    for (int k = 0; k < n; k++) strbuf_append(out, ",%.17g", error_of(r, metric[k]));
    strbuf_append(out, ",");
    strbuf_append_csv(out, run->folder);
    strbuf_append(out, "\n");
}

static floe_status write_csv(const comparison *c, const char *path)
{
    const char *metric[COMPARE_MAX_METRICS];
    const int n = compare_metrics(c, metric);
    strbuf out;
    strbuf_init(&out, c->ctx);
    append_names(c, metric, n, &out);
    for (size_t i = 0; i < c->n; i++) {
        if (c->run[i].ran) append_case(&c->list[i], &c->run[i], metric, n, &out);
    }
    const floe_status status =
        out.status == FLOE_OK ? file_replace_text(c->ctx, path, strbuf_string(&out)) : out.status;
    strbuf_free(&out);
    return status;
}

floe_status compare_write(const comparison *c)
{
    char path[COMPARE_PATH];
    (void)snprintf(path, sizeof path, "%s/compare.json", c->dir);
    TRY(write_json(c, path));
    (void)snprintf(path, sizeof path, "%s/compare.csv", c->dir);
    return write_csv(c, path);
}

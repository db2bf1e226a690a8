#include "base/memory.h"
#include "io/file.h"
#include "io/summary.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* The work of reading; once something is wrong, the rest does nothing. */
typedef struct reader {
    context *ctx;
    const char *path;
    floe_status status;
} reader;

static void complain_of_value(reader *r, const char *key, const char *expected)
{
    if (r->status == FLOE_OK) r->status = fail(r->ctx, FLOE_IO, "'%s': '%s' should be %s", r->path, key, expected);
}

static void get_text(reader *r, const json_t *object, const char *key, char *to, size_t size)
{
    const char *text = json_string_value(json_object_get(object, key));
    if (!text) complain_of_value(r, key, "a text");
    (void)snprintf(to, size, "%s", text ? text : "");
}

static double as_number(reader *r, const char *key, const json_t *value)
{
    if (json_is_null(value)) return NAN;
    if (!json_is_number(value)) complain_of_value(r, key, "a number or null");
    return json_number_value(value);
}

static double get_summary_number(reader *r, const json_t *object, const char *key)
{
    return as_number(r, key, json_object_get(object, key));
}

/* NAN where the summary is of an earlier version that did not have it. */
static double get_later_number(reader *r, const json_t *object, const char *key)
{
    return json_object_get(object, key) ? get_summary_number(r, object, key) : (double)NAN;
}

static long long get_count(reader *r, const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (!json_is_integer(value)) complain_of_value(r, key, "a whole number");
    return json_integer_value(value);
}

static json_t *get_object(reader *r, const json_t *object, const char *key)
{
    json_t *value = json_object_get(object, key);
    if (!json_is_object(value)) complain_of_value(r, key, "an object");
    return value;
}

static void get_values(reader *r, const json_t *object, const char *key, summary_value *out, int reserved, int *n)
{
    const char *name;
    json_t *value;
    json_t *list = get_object(r, object, key);
    *n = 0;
    json_object_foreach(list, name, value)
    {
        if (*n == reserved) {
            complain_of_value(r, key, "shorter");
            return;
        }
        (void)snprintf(out[*n].name, sizeof out->name, "%s", name);
        out[(*n)++].value = as_number(r, name, value);
    }
}

static void get_counters(reader *r, const json_t *object, run_summary *out)
{
    const char *name;
    json_t *value;
    json_t *list = get_object(r, object, "counters");
    json_object_foreach(list, name, value)
    {
        if (!json_is_integer(value)) complain_of_value(r, name, "a whole number");
        if (r->status == FLOE_OK) r->status = summary_add_counter(out, r->ctx, name, json_integer_value(value));
    }
}

static void get_memory(reader *r, const json_t *object, run_summary *out)
{
    const json_t *memory = get_object(r, object, "memory");
    const json_t *bytes = get_object(r, memory, "field_bytes");
    out->peak_rss_bytes = get_count(r, memory, "peak_rss_bytes");
    out->field_bytes_mpm = get_count(r, bytes, "mpm");
    out->field_bytes_ice = get_count(r, bytes, "ice");
    out->field_bytes_coupling = get_count(r, bytes, "coupling");
}

static void get_conservation(reader *r, const json_t *object, run_summary *out)
{
    const json_t *drift = get_object(r, object, "conservation");
    out->drift_mass = get_summary_number(r, drift, "mass");
    out->drift_momentum = get_summary_number(r, drift, "momentum");
    out->drift_moment = get_later_number(r, drift, "angular_momentum");
    out->drift_energy = get_summary_number(r, drift, "energy");
    /* Summaries of earlier versions have those at the end alone. */
    const json_t *end = json_object_get(drift, "at_end") ? get_object(r, drift, "at_end") : drift;
    out->end_drift_mass = get_summary_number(r, end, "mass");
    out->end_drift_momentum = get_summary_number(r, end, "momentum");
    out->end_drift_moment = get_later_number(r, end, "angular_momentum");
    out->end_drift_energy = get_summary_number(r, end, "energy");
}

static void get_warnings(reader *r, const json_t *object, run_summary *out)
{
    size_t i;
    json_t *value;
    const json_t *list = json_object_get(object, "warnings");
    if (!list) return; /* of an earlier version */
    json_array_foreach(list, i, value)
    {
        if (!json_is_string(value)) complain_of_value(r, "warnings", "a list of texts");
        if (json_is_string(value)) summary_add_warning(out, json_string_value(value));
    }
    get_text(r, object, "notes", out->notes, sizeof out->notes);
}

static void get_build(reader *r, const json_t *object, run_summary *out)
{
    const json_t *build = get_object(r, object, "floe");
    get_text(r, build, "version", out->version, sizeof out->version);
    get_text(r, build, "git", out->git, sizeof out->git);
    get_text(r, build, "compiler", out->compiler, sizeof out->compiler);
    get_text(r, build, "flags", out->flags, sizeof out->flags);
    const char *machine = json_string_value(json_object_get(build, "machine"));
    (void)snprintf(out->machine, sizeof out->machine, "%s", machine ? machine : "");
    out->threads = get_count(r, build, "threads");
}

static void get_all(reader *r, const json_t *object, run_summary *out)
{
    if (get_count(r, object, "schema") != 1) complain_of_value(r, "schema", "1: another version of floe wrote this");
    get_text(r, object, "deck", out->deck, sizeof out->deck);
    get_text(r, object, "coupling", out->coupling, sizeof out->coupling);
    /* Those of earlier versions do not say, and were explicit. */
    if (json_object_get(object, "solver")) get_text(r, object, "solver", out->solver, sizeof out->solver);
    if (json_object_get(object, "pressure")) get_text(r, object, "pressure", out->pressure, sizeof out->pressure);
    if (json_object_get(object, "substeps")) get_text(r, object, "substeps", out->substeps, sizeof out->substeps);
    if (json_object_get(object, "interface")) get_text(r, object, "interface", out->interface, sizeof out->interface);
    const char *units = json_string_value(json_object_get(object, "units"));
    out->dimensionless = units && strcmp(units, "none") == 0;
    get_text(r, object, "status", out->status, sizeof out->status);
    /* Summaries of earlier versions have no message. */
    if (json_object_get(object, "message")) get_text(r, object, "message", out->message, sizeof out->message);
    out->time = get_summary_number(r, object, "time");
    out->steps = get_count(r, object, "steps");
    out->rejected_steps = get_count(r, object, "rejected_steps");
    out->wall_seconds = get_summary_number(r, object, "wall_seconds");
    if (json_object_get(object, "output_seconds"))
        out->output_seconds = get_summary_number(r, object, "output_seconds");
    if (json_object_get(object, "cpu_seconds")) out->cpu_seconds = get_summary_number(r, object, "cpu_seconds");
    get_values(r, object, "seconds_by_stage", out->seconds_by_stage, SUMMARY_MAX_STAGES, &out->n_stages);
    out->cells = get_count(r, object, "cells");
    out->points = get_count(r, object, "points");
    out->cell_updates = get_summary_number(r, object, "cell_updates");
    out->point_updates = get_summary_number(r, object, "point_updates");
    get_memory(r, object, out);
    get_conservation(r, object, out);
    get_warnings(r, object, out);
    if (json_object_get(object, "reference_accuracy"))
        out->reference_accuracy = get_summary_number(r, object, "reference_accuracy");
    get_values(r, object, "errors", out->errors, SUMMARY_MAX_ERRORS, &out->n_errors);
    get_counters(r, object, out);
    get_build(r, object, out);
}

static floe_status parse_summary(context *ctx, const char *path, const char *text, size_t size, run_summary *out)
{
    json_error_t error;
    json_t *object = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (!object) return fail(ctx, FLOE_IO, "%s:%d:%d: not JSON: %s", path, error.line, error.column, error.text);
    reader r = {ctx, path, FLOE_OK};
    get_all(&r, object, out);
    json_decref(object);
    return r.status;
}

floe_status summary_read(context *ctx, const char *path, run_summary *out)
{
    char *text;
    size_t size;
    *out = (run_summary){0};
    TRY(file_read(ctx, path, &text, &size));
    const floe_status status = parse_summary(ctx, path, text, size, out);
    memory_free(ctx, &text);
    return status;
}

#include "io/summary.h"

#include "base/machine.h"
#include "floe_build.h"
#include "io/json.h"

#include <math.h>
#include <string.h>

/* A count that may be beyond what an integer holds exactly. */
static json_t *json_count(double x)
{
    if (x >= 0.0 && x < 9007199254740992.0 && x == floor(x)) return json_integer((json_int_t)x);
    return json_number(x);
}

static bool set_object(json_t *object, const char *key, json_t **out)
{
    *out = json_object();
    return json_put(object, key, *out);
}

static bool set_values(json_t *object, const char *key, const summary_value *value, int n)
{
    json_t *list;
    bool fine = set_object(object, key, &list);
    for (int i = 0; i < n && fine; i++) fine = json_put(list, value[i].name, json_number(value[i].value));
    return fine;
}

static bool set_counters(json_t *object, const run_summary *r)
{
    json_t *list;
    bool fine = set_object(object, "counters", &list);
    for (int i = 0; i < r->n_counters && fine; i++) {
        fine = json_put(list, r->counters[i].name, json_integer(r->counters[i].value));
    }
    return fine;
}

static bool set_memory(json_t *object, const run_summary *r)
{
    json_t *memory, *bytes;
    return set_object(object, "memory", &memory) &&
           json_put(memory, "peak_rss_bytes", json_integer(r->peak_rss_bytes)) &&
           set_object(memory, "field_bytes", &bytes) && json_put(bytes, "mpm", json_integer(r->field_bytes_mpm)) &&
           json_put(bytes, "ice", json_integer(r->field_bytes_ice)) &&
           json_put(bytes, "coupling", json_integer(r->field_bytes_coupling));
}

static bool set_conservation(json_t *object, const run_summary *r)
{
    json_t *drift, *end;
    return set_object(object, "conservation", &drift) && json_put(drift, "mass", json_number(r->drift_mass)) &&
           json_put(drift, "momentum", json_number(r->drift_momentum)) &&
           json_put(drift, "angular_momentum", json_number(r->drift_moment)) &&
           json_put(drift, "energy", json_number(r->drift_energy)) && set_object(drift, "at_end", &end) &&
           json_put(end, "mass", json_number(r->end_drift_mass)) &&
           json_put(end, "momentum", json_number(r->end_drift_momentum)) &&
           json_put(end, "angular_momentum", json_number(r->end_drift_moment)) &&
           json_put(end, "energy", json_number(r->end_drift_energy));
}

static bool set_warnings(json_t *object, const run_summary *r)
{
    json_t *list = json_array();
    bool fine = json_put(object, "warnings", list);
    for (int i = 0; i < r->n_warnings && fine; i++)
        fine = json_array_append_new(list, json_plain_text(r->warnings[i])) == 0;
    return fine && json_put(object, "notes", json_plain_text(r->notes));
}

static bool set_build(json_t *object, const run_summary *r)
{
    json_t *build;
    return set_object(object, "floe", &build) && json_put(build, "version", json_string(r->version)) &&
           json_put(build, "git", json_string(r->git)) && json_put(build, "compiler", json_string(r->compiler)) &&
           json_put(build, "flags", json_string(r->flags)) && json_put(build, "machine", json_plain_text(r->machine)) &&
           json_put(build, "threads", json_integer(r->threads));
}

static bool set_all_values(json_t *object, const run_summary *r)
{
    return json_put(object, "schema", json_integer(1)) && json_put(object, "deck", json_plain_text(r->deck)) &&
           json_put(object, "coupling", json_string(r->coupling)) &&
           json_put(object, "solver", json_string(r->solver)) &&
           json_put(object, "pressure", json_string(r->pressure)) &&
           json_put(object, "substeps", json_string(r->substeps)) &&
           json_put(object, "interface", json_plain_text(r->interface)) &&
           json_put(object, "units", json_string(r->dimensionless ? "none" : "si")) &&
           json_put(object, "status", json_string(r->status)) &&
           json_put(object, "message", json_plain_text(r->message)) && json_put(object, "time", json_number(r->time)) &&
           json_put(object, "steps", json_integer(r->steps)) &&
           json_put(object, "rejected_steps", json_integer(r->rejected_steps)) &&
           json_put(object, "wall_seconds", json_number(r->wall_seconds)) &&
           json_put(object, "output_seconds", json_number(r->output_seconds)) &&
           json_put(object, "cpu_seconds", json_number(r->cpu_seconds)) &&
           set_values(object, "seconds_by_stage", r->seconds_by_stage, r->n_stages) &&
           json_put(object, "cells", json_integer(r->cells)) && json_put(object, "points", json_integer(r->points)) &&
           json_put(object, "cell_updates", json_count(r->cell_updates)) &&
           json_put(object, "point_updates", json_count(r->point_updates)) && set_memory(object, r) &&
           set_conservation(object, r) && set_warnings(object, r) &&
           json_put(object, "reference_accuracy", json_number(r->reference_accuracy)) &&
           set_values(object, "errors", r->errors, r->n_errors) && set_counters(object, r) && set_build(object, r);
}

struct json_t *summary_json(const run_summary *r)
{
    json_t *object = json_object();
    if (object && set_all_values(object, r)) return object;
    json_decref(object);
    return NULL;
}

double summary_run_seconds(const run_summary *r)
{
    return r->wall_seconds - r->output_seconds;
}

floe_status summary_write(context *ctx, const char *path, const run_summary *r)
{
    return json_write(ctx, path, summary_json(r));
}

static void copy_text(char *to, size_t size, const char *from)
{
    (void)snprintf(to, size, "%s", from);
}

void summary_set_build(run_summary *r)
{
    copy_text(r->version, sizeof r->version, FLOE_VERSION);
    copy_text(r->git, sizeof r->git, FLOE_GIT);
    copy_text(r->compiler, sizeof r->compiler, FLOE_COMPILER);
    copy_text(r->flags, sizeof r->flags, FLOE_FLAGS);
    machine_describe(r->machine, sizeof r->machine);
}

floe_status summary_add_error(run_summary *r, context *ctx, const char *name, double value)
{
    if (r->n_errors == SUMMARY_MAX_ERRORS)
        return fail(ctx, FLOE_INTERNAL, "a summary holds no more than %d errors", r->n_errors);
    summary_value *entry = &r->errors[r->n_errors++];
    copy_text(entry->name, sizeof entry->name, name);
    entry->value = value;
    return FLOE_OK;
}

void summary_add_warning(run_summary *r, const char *text)
{
    if (r->n_warnings == SUMMARY_MAX_WARNINGS) return;
    copy_text(r->warnings[r->n_warnings++], SUMMARY_WARNING, text);
}

floe_status summary_add_counter(run_summary *r, context *ctx, const char *name, long long value)
{
    if (r->n_counters == SUMMARY_MAX_COUNTERS) {
        return fail(ctx, FLOE_INTERNAL, "a summary holds no more than %d counters", r->n_counters);
    }
    summary_counter *entry = &r->counters[r->n_counters++];
    copy_text(entry->name, sizeof entry->name, name);
    entry->value = value;
    return FLOE_OK;
}

#include "io/summary.h"

#include "base/machine.h"
#include "floe_build.h"
#include "io/file.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sets a member; false when memory is out. json_object_set_new takes NULL for such a failure, and passes it on. */
static bool set(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

/* A number; NaN and infinities, which JSON does not have, are null. */
static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

/* A count that may be beyond what an integer holds exactly. */
static json_t *count(double x)
{
    if (x >= 0.0 && x < 9007199254740992.0 && x == floor(x)) return json_integer((json_int_t)x);
    return number(x);
}

static bool set_object(json_t *object, const char *key, json_t **out)
{
    *out = json_object();
    return set(object, key, *out);
}

static bool set_values(json_t *object, const char *key, const summary_value *value, int n)
{
    json_t *list;
    bool fine = set_object(object, key, &list);
    for (int i = 0; i < n && fine; i++) fine = set(list, value[i].name, number(value[i].value));
    return fine;
}

static bool set_counters(json_t *object, const run_summary *r)
{
    json_t *list;
    bool fine = set_object(object, "counters", &list);
    for (int i = 0; i < r->n_counters && fine; i++) {
        fine = set(list, r->counters[i].name, json_integer(r->counters[i].value));
    }
    return fine;
}

static bool set_memory(json_t *object, const run_summary *r)
{
    json_t *memory, *bytes;
    return set_object(object, "memory", &memory) && set(memory, "peak_rss_bytes", json_integer(r->peak_rss_bytes)) &&
           set_object(memory, "field_bytes", &bytes) && set(bytes, "mpm", json_integer(r->field_bytes_mpm)) &&
           set(bytes, "ice", json_integer(r->field_bytes_ice)) &&
           set(bytes, "coupling", json_integer(r->field_bytes_coupling));
}

static bool set_conservation(json_t *object, const run_summary *r)
{
    json_t *drift;
    return set_object(object, "conservation", &drift) && set(drift, "mass", number(r->drift_mass)) &&
           set(drift, "momentum", number(r->drift_momentum)) && set(drift, "energy", number(r->drift_energy));
}

/* json_stringn_nocheck would take text that is not UTF-8; a path may be that, and a message may name one, so its odd bytes are replaced. */
static json_t *plain_text(const char *text)
{
    char plain[SUMMARY_TEXT];
    json_t *value = json_string(text);
    if (value) return value;
    size_t i = 0;
    for (; text[i] && i < sizeof plain - 1; i++) plain[i] = (unsigned char)text[i] < 0x80 ? text[i] : '?';
    plain[i] = '\0';
    return json_string(plain);
}

static bool set_build(json_t *object, const run_summary *r)
{
    json_t *build;
    return set_object(object, "floe", &build) && set(build, "version", json_string(r->version)) &&
           set(build, "git", json_string(r->git)) && set(build, "compiler", json_string(r->compiler)) &&
           set(build, "flags", json_string(r->flags)) && set(build, "machine", plain_text(r->machine)) &&
           set(build, "threads", json_integer(r->threads));
}

static bool set_all(json_t *object, const run_summary *r)
{
    return set(object, "schema", json_integer(1)) && set(object, "deck", plain_text(r->deck)) &&
           set(object, "coupling", json_string(r->coupling)) && set(object, "status", json_string(r->status)) &&
           set(object, "message", plain_text(r->message)) && set(object, "time", number(r->time)) &&
           set(object, "steps", json_integer(r->steps)) &&
           set(object, "rejected_steps", json_integer(r->rejected_steps)) &&
           set(object, "wall_seconds", number(r->wall_seconds)) &&
           set_values(object, "seconds_by_stage", r->seconds_by_stage, r->n_stages) &&
           set(object, "cells", json_integer(r->cells)) && set(object, "points", json_integer(r->points)) &&
           set(object, "cell_updates", count(r->cell_updates)) &&
           set(object, "point_updates", count(r->point_updates)) && set_memory(object, r) &&
           set_conservation(object, r) && set_values(object, "errors", r->errors, r->n_errors) &&
           set_counters(object, r) && set_build(object, r);
}

struct json_t *summary_json(const run_summary *r)
{
    json_t *object = json_object();
    if (object && set_all(object, r)) return object;
    json_decref(object);
    return NULL;
}

floe_status summary_write(context *ctx, const char *path, const run_summary *r)
{
    json_t *object = summary_json(r);
    char *text = object ? json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(object);
    if (!text) return fail(ctx, FLOE_NO_MEMORY, "no memory for the summary '%s'", path);
    const file_part part[] = {{text, strlen(text)}, {"\n", 1}};
    const floe_status status = file_replace(ctx, path, part, 2);
    free(text);
    return status;
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

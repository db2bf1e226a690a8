#include "io/checkpoint/checkpoint_record.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* One entry of the record. */
typedef struct record_row {
    const char *path;
    hdf_type type;
    size_t offset;
    hdf_shape shape;
} record_row;

#define DOUBLE(path, member)                                   \
    {                                                          \
        path, HDF_DOUBLE, offsetof(checkpoint_record, member), \
        {                                                      \
            0,                                                 \
            {                                                  \
                0                                              \
            }                                                  \
        }                                                      \
    }
#define INTEGER(path, member)                                 \
    {                                                         \
        path, HDF_INT64, offsetof(checkpoint_record, member), \
        {                                                     \
            0,                                                \
            {                                                 \
                0                                             \
            }                                                 \
        }                                                     \
    }
#define DOUBLES(path, member, ...)                                         \
    {                                                                      \
        path, HDF_DOUBLE, offsetof(checkpoint_record, member), __VA_ARGS__ \
    }
#define INTEGERS(path, member, ...)                                       \
    {                                                                     \
        path, HDF_INT64, offsetof(checkpoint_record, member), __VA_ARGS__ \
    }
#define SHAPE_1(n) \
    {              \
        1,         \
        {          \
            n      \
        }          \
    }
#define SHAPE_2(n, m) \
    {                 \
        2,            \
        {             \
            n, m      \
        }             \
    }
#define SHAPE_3(n, m, l) \
    {                    \
        3,               \
        {                \
            n, m, l      \
        }                \
    }

static const record_row rows[] = {
    DOUBLE("/sim/time", time),
    DOUBLE("/sim/dt", dt),
    DOUBLE("/sim/rest_since", rest_since),
    DOUBLE("/sim/point_updates", point_updates),
    DOUBLE("/sim/cell_updates", cell_updates),
    DOUBLE("/sim/wall_seconds", wall_seconds),
    INTEGER("/sim/steps", steps),
    INTEGER("/sim/rejected", rejected),
    INTEGER("/sim/at_rest", at_rest),
    INTEGER("/sim/owed", owed),
    DOUBLE("/mpm/time", mpm_time),
    DOUBLE("/mpm/dt", mpm_dt),
    DOUBLE("/mpm/dt_previous", mpm_dt_previous),
    DOUBLE("/ice/time", ice_time),
    DOUBLE("/ice/dt", ice_dt),
    INTEGER("/ice/implicit", ice_implicit),
    DOUBLES("/ledger/initial", ledger_initial, SHAPE_1(LEDGER_QUANTITIES)),
    DOUBLES("/ledger/total", ledger_total, SHAPE_1(LEDGER_QUANTITIES)),
    DOUBLES("/ledger/scale", ledger_scale, SHAPE_1(LEDGER_QUANTITIES)),
    DOUBLES("/ledger/extent", ledger_extent, SHAPE_1(LEDGER_QUANTITIES)),
    DOUBLES("/ledger/let_in", ledger_let_in, SHAPE_2(LEDGER_QUANTITIES, LEDGER_INPUTS)),
    DOUBLES("/ledger/worst", ledger_worst, SHAPE_1(LEDGER_QUANTITIES)),
    DOUBLES("/ledger/worst_time", ledger_worst_time, SHAPE_1(LEDGER_QUANTITIES)),
    DOUBLE("/ledger/elasticity", ledger_elasticity),
    DOUBLES("/ledger/motion", ledger_motion, SHAPE_1(7)),
    DOUBLES("/ledger/entry", ledger_entry, SHAPE_3(LEDGER_QUANTITIES, LEDGER_KINDS, 2)),
    DOUBLES("/ledger/pending", ledger_pending, SHAPE_2(LEDGER_QUANTITIES, LEDGER_KINDS)),
    INTEGERS("/ledger/count", ledger_count, SHAPE_1(LEDGER_COUNTS)),
    INTEGERS("/ledger/pending_count", ledger_pending_count, SHAPE_1(LEDGER_COUNTS)),
    INTEGER("/stages/n", n_stages),
    DOUBLES("/stages/seconds", stage_seconds, SHAPE_1(STAGE_MAX)),
    INTEGERS("/stages/calls", stage_calls, SHAPE_1(STAGE_MAX)),
};
enum { ROWS = sizeof rows / sizeof rows[0] };

/* Numbers that stand in both structs alike. */
typedef struct common_field {
    size_t record, ledger, size; /* offsets and bytes */
} common_field;

#define COMMON(field)                                                                                      \
    {                                                                                                      \
        offsetof(checkpoint_record, ledger_##field), offsetof(ledger, field), sizeof(((ledger *)0)->field) \
    }
static const common_field common[] = {COMMON(initial),    COMMON(total),      COMMON(scale),
                                      COMMON(extent),     COMMON(let_in),     COMMON(worst),
                                      COMMON(worst_time), COMMON(elasticity), COMMON(pending)};
enum { COMMONS = sizeof common / sizeof common[0] };

static void take_ledger(checkpoint_record *r, const ledger *l)
{
    for (size_t k = 0; k < COMMONS; k++)
        memcpy((char *)r + common[k].record, (const char *)l + common[k].ledger, common[k].size);
    const ledger_motion *m = &l->motion;
    const double motion[] = {m->start, m->internal, m->available, m->beyond, m->last_look, m->stored, m->most};
    memcpy(r->ledger_motion, motion, sizeof motion);
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        for (int k = 0; k < LEDGER_KINDS; k++) {
            r->ledger_entry[q][k][0] = l->entry[q][k].value;
            r->ledger_entry[q][k][1] = l->entry[q][k].carry;
        }
    }
    for (int c = 0; c < LEDGER_COUNTS; c++) {
        r->ledger_count[c] = l->count[c];
        r->ledger_pending_count[c] = l->pending_count[c];
    }
}

static void put_ledger(const checkpoint_record *r, ledger *l)
{
    for (size_t k = 0; k < COMMONS; k++)
        memcpy((char *)l + common[k].ledger, (const char *)r + common[k].record, common[k].size);
    const double *m = r->ledger_motion;
    l->motion = (ledger_motion){m[0], m[1], m[2], m[3], m[4], m[5], m[6]};
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        for (int k = 0; k < LEDGER_KINDS; k++) {
            l->entry[q][k] = (ledger_sum){r->ledger_entry[q][k][0], r->ledger_entry[q][k][1]};
        }
    }
    for (int c = 0; c < LEDGER_COUNTS; c++) {
        l->count[c] = r->ledger_count[c];
        l->pending_count[c] = r->ledger_pending_count[c];
    }
}

void checkpoint_record_take(checkpoint_record *record, const sim *s, const checkpoint_run *run)
{
    *record = (checkpoint_record){.time = s->time,
                                  .dt = s->dt,
                                  .rest_since = s->rest_since,
                                  .point_updates = s->point_updates,
                                  .cell_updates = s->cell_updates,
                                  .wall_seconds = run->wall_seconds,
                                  .owed = run->owed,
                                  .steps = s->steps,
                                  .rejected = s->rejected,
                                  .at_rest = s->at_rest,
                                  .n_stages = s->stages.n};
    if (s->mpm) {
        record->mpm_time = s->mpm->time;
        record->mpm_dt = s->mpm->dt;
        record->mpm_dt_previous = s->mpm->dt_previous;
    }
    if (s->ice) {
        record->ice_time = s->ice->time;
        record->ice_dt = s->ice->dt;
        record->ice_implicit = s->ice->implicit;
    }
    take_ledger(record, &s->ledger);
    for (int i = 0; i < s->stages.n; i++) {
        record->stage_seconds[i] = s->stages.record[i].seconds;
        record->stage_calls[i] = s->stages.record[i].calls;
    }
}

void checkpoint_record_put(const checkpoint_record *record, sim *s, checkpoint_run *run)
{
    s->time = record->time;
    s->dt = record->dt;
    s->rest_since = record->rest_since;
    s->point_updates = record->point_updates;
    s->cell_updates = record->cell_updates;
    s->steps = (long)record->steps;
    s->rejected = (long)record->rejected;
    s->at_rest = record->at_rest != 0;
    run->wall_seconds = record->wall_seconds;
    run->owed = record->owed;
    if (s->mpm) {
        s->mpm->time = record->mpm_time;
        s->mpm->dt = record->mpm_dt;
        s->mpm->dt_previous = record->mpm_dt_previous;
    }
    if (s->ice) {
        s->ice->time = record->ice_time;
        s->ice->dt = record->ice_dt;
        /* What the deck names it names still. */
        if (s->scene->method.pressure == PRESSURE_AUTO) s->ice->implicit = record->ice_implicit != 0;
    }
    put_ledger(record, &s->ledger);
    for (int i = 0; i < s->stages.n; i++) {
        s->stages.record[i].seconds = record->stage_seconds[i];
        s->stages.record[i].calls = (long)record->stage_calls[i];
    }
}

floe_status checkpoint_record_write(hdf_file *hdf, const checkpoint_record *record)
{
    for (int i = 0; i < ROWS; i++) {
        const char *data = (const char *)record + rows[i].offset;
        TRY(hdf_write(hdf, rows[i].path, rows[i].type, rows[i].shape, data));
    }
    return FLOE_OK;
}

/* The record may come from a fuzzer: nothing in it is believed. rest_since alone may be infinite. */
static floe_status check_record(hdf_file *hdf, const checkpoint_record *r)
{
    if (!isfinite(r->time) || r->time < 0.0 || !isfinite(r->dt) || r->dt < 0.0 || isnan(r->rest_since)) {
        return fail(hdf->ctx, FLOE_IO, "'%s' holds an impossible time: t = %g s, dt = %g s, at rest since %g s",
                    hdf->name, r->time, r->dt, r->rest_since);
    }
    if (r->steps < 0 || r->rejected < 0 || r->at_rest < 0 || r->at_rest > 1) {
        return fail(hdf->ctx, FLOE_IO,
                    "'%s' holds an impossible count: steps %" PRId64 ", rejected %" PRId64 ", at rest %" PRId64,
                    hdf->name, r->steps, r->rejected, r->at_rest);
    }
    if (r->owed < 0 || r->owed > CHECKPOINT_OWED_ALL) {
        return fail(hdf->ctx, FLOE_IO, "'%s' says of outputs that do not exist that they are to be written: %" PRId64,
                    hdf->name, r->owed);
    }
    const double more[] = {r->point_updates, r->cell_updates, r->wall_seconds,    r->mpm_time,
                           r->mpm_dt,        r->ice_time,     r->mpm_dt_previous, r->ice_dt};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++) {
        if (isfinite(more[i]) && more[i] >= 0.0) continue;
        return fail(hdf->ctx, FLOE_IO, "'%s' holds an impossible time or number of updates: %g", hdf->name, more[i]);
    }
    return FLOE_OK;
}

floe_status checkpoint_record_read(hdf_file *hdf, checkpoint_record *record)
{
    for (int i = 0; i < ROWS; i++) {
        char *data = (char *)record + rows[i].offset;
        TRY(hdf_read(hdf, rows[i].path, rows[i].type, rows[i].shape, data));
    }
    return check_record(hdf, record);
}

/* What visit_field needs. */
typedef struct state_walk {
    const sim *s;
    state_visitor *visit;
    void *user;
} state_walk;

static floe_status visit_field(void *user, field_id id, int instance)
{
    const state_walk *walk = user;
    const field_info *info = field_describe(id);
    if (info->class != FIELD_STATE && info->class != FIELD_FIXED) return FLOE_OK;
    if (info->centring != FIELD_CELL && info->centring != FIELD_POINT) {
        return fail(walk->s->ctx, FLOE_INTERNAL, "a checkpoint cannot hold '%s': only points and cells may carry state",
                    info->name);
    }
    const int components = field_component_count(info->components, walk->s->mesh.dim);
    for (int c = 0; c < components; c++) {
        state_array array = {.id = id, .instance = instance, .comp = c};
        (void)snprintf(array.path, sizeof array.path, "/%s/%d/%s_%d", info->centring == FIELD_CELL ? "cells" : "points",
                       instance, info->name, c);
        TRY(walk->visit(walk->user, &array));
    }
    return FLOE_OK;
}

floe_status checkpoint_visit_state(const sim *s, state_visitor *visit, void *user)
{
    state_walk walk = {s, visit, user};
    return fields_visit(s->domain->fields[0], visit_field, &walk);
}

static floe_status append_array(void *user, const state_array *array)
{
    strbuf *out = user;
    strbuf_append(out, "array %s\n", array->path);
    return out->status;
}

static void append_mesh(const mesh *m, strbuf *out)
{
    strbuf_append(out, "mesh of %d dimensions, %s\n", m->dim,
                  m->geometry == MESH_AXISYMMETRIC ? "axisymmetric" : "cartesian");
    for (int a = 0; a < m->dim; a++) {
        strbuf_append(out, "axis %d: %d cells of %.17g m from %.17g m, tiles of %d%s\n", a, m->n[a], m->h[a],
                      m->lower[a], m->tile[a], m->periodic[a] ? ", periodic" : "");
    }
}

static void append_parts(const sim *s, strbuf *out)
{
    const int bodies = s->mpm ? s->mpm->n_bodies : 0;
    const int materials = s->ice ? s->ice->n_materials : 0;
    for (int b = 0; b < bodies; b++) {
        const scene_body *body = &s->scene->body[s->mpm->body[b].scene_body];
        strbuf_append(out, "points %d: body '%s' of '%s'\n", b, body->name, s->scene->material[body->material].name);
    }
    for (int r = 0; r < materials; r++) {
        strbuf_append(out, "cells %d: '%s'\n", r, s->scene->material[s->ice->material[r].scene_material].name);
    }
    for (int i = 0; i < s->stages.n; i++) strbuf_append(out, "stage %s\n", s->stages.record[i].name);
}

void checkpoint_extra_path(char path[128], const checkpoint_extra *extra)
{
    (void)snprintf(path, 128, "/extra/%s", extra->name);
}

floe_status checkpoint_manifest(const sim *s, const checkpoint_run *run, strbuf *out)
{
    strbuf_append(out, "coupling %s\n", coupling_name(s->coupling));
    append_mesh(&s->mesh, out);
    append_parts(s, out);
    for (int i = 0; i < run->n_extra; i++) {
        const checkpoint_extra *extra = &run->extra[i];
        strbuf_append(out, "extra %s: %zu of %zu\n", extra->name, extra->n, extra->components);
    }
    return checkpoint_visit_state(s, append_array, out);
}

/* "time.cfl." of a line "    mpm: 0.5" of a deck: the maps that it is in; "" of one that is in none. */
static void name_maps(const char *text, size_t line, char path[256])
{
    size_t indent = strspn(text + line, " ");
    path[0] = '\0';
    while (line > 0 && indent > 0) {
        size_t above = line - 1;
        while (above > 0 && text[above - 1] != '\n') above--;
        const size_t own = strspn(text + above, " "), length = strcspn(text + above + own, ":\n");
        if (own < indent) {
            char below[256];
            (void)snprintf(below, sizeof below, "%s", path);
            (void)snprintf(path, 256, "%.*s.%.180s", length < 64 ? (int)length : 64, text + above + own, below);
            indent = own;
        }
        line = above;
    }
}

floe_status checkpoint_compare(context *ctx, const char *path, const char *what, const char *in_file, const char *here)
{
    size_t line = 0;
    size_t i = 0;
    for (; in_file[i] && in_file[i] == here[i]; i++) {
        if (in_file[i] == '\n') line = i + 1;
    }
    if (in_file[i] == here[i]) return FLOE_OK;
    char before[256], now[256];
    name_maps(in_file, line, before);
    name_maps(here, line, now);
    const char *old = in_file + line + strspn(in_file + line, " "), *fresh = here + line + strspn(here + line, " ");
    const int n = (int)strcspn(old, "\n");
    const int m = (int)strcspn(fresh, "\n");
    return fail(ctx, FLOE_BAD_INPUT,
                "'%s' is of another %s: it has \"%s%.*s\" where this run has \"%s%.*s\"; resume with what it was "
                "written for, or "
                "start again in another folder",
                path, what, before, n < 160 ? n : 160, old, now, m < 160 ? m : 160, fresh);
}

#include "io/snapshot/snapshot_read.h"

#include "base/memory.h"
#include "io/hdf_look.h"
#include "io/snapshot/snapshot_check.h"
#include "io/snapshot/snapshot_folder.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { PATH = 2 * SNAPSHOT_TEXT + 16 };

_Static_assert((int)SNAPSHOT_TEXT == (int)HDF_NAME, "texts are read straight into their places");

static floe_status make_path(context *ctx, char **out, const char *dir, long number)
{
    char name[SNAPSHOT_NAME];
    snapshot_file_name(name, number);
    return snapshot_join(ctx, out, dir, name);
}

static floe_status read_time(context *ctx, const char *path, double *time)
{
    hdf_file hdf;
    floe_status status = snapshot_file_open(ctx, path, &hdf);
    if (status == FLOE_OK) status = hdf_read(&hdf, "/time", HDF_DOUBLE, (hdf_shape){0}, time);
    if (status == FLOE_OK) status = snapshot_check_time(ctx, path, *time);
    hdf_close(&hdf);
    return status;
}

/* Adds one to the list, which has space reserved, unless it is damaged. */
static floe_status add_time(snapshot_times *out, context *ctx, const char *dir, long number)
{
    char *path;
    double time = 0.0;
    TRY(make_path(ctx, &path, dir, number));
    const floe_status status = read_time(ctx, path, &time);
    memory_free(ctx, &path);
    if (status == FLOE_IO) {
        context_log(ctx, LOG_WARNING, "passed over: %s", context_message(ctx));
        context_clear(ctx);
        return FLOE_OK;
    }
    TRY(status);
    out->entry[out->n++] = (snapshot_time){number, time};
    return FLOE_OK;
}

static int compare_times(const void *a, const void *b)
{
    const snapshot_time *x = a, *y = b;
    return (x->number > y->number) - (x->number < y->number);
}

/* From the last one on, at most `most`. */
static floe_status add_times(snapshot_times *out, context *ctx, const char *dir, const snapshot_numbers *list,
                             size_t most)
{
    TRY(memory_new(ctx, &out->entry, list->n, sizeof *out->entry));
    for (size_t i = list->n; i > 0 && out->n < most; i--) TRY(add_time(out, ctx, dir, list->number[i - 1]));
    if (out->n > 1) qsort(out->entry, out->n, sizeof *out->entry, compare_times);
    if (out->n > 0) return FLOE_OK;
    return fail(ctx, FLOE_IO, "'%s/fields' holds no %ssnapshot: is '%s' the folder of a run?", dir,
                list->n > 0 ? "readable " : "", dir);
}

static floe_status read_times(snapshot_times *out, context *ctx, const char *dir, size_t most)
{
    snapshot_numbers list = {0};
    char *folder;
    *out = (snapshot_times){0};
    TRY(snapshot_join(ctx, &folder, dir, "fields"));
    floe_status status = snapshot_numbers_list(ctx, folder, false, &list);
    if (status == FLOE_OK) status = add_times(out, ctx, dir, &list, most);
    if (status != FLOE_OK) snapshot_times_free(ctx, out);
    memory_free(ctx, &list.number);
    memory_free(ctx, &folder);
    return status;
}

floe_status snapshot_times_read(snapshot_times *out, context *ctx, const char *dir)
{
    return read_times(out, ctx, dir, SIZE_MAX);
}

floe_status snapshot_last(snapshot_time *out, context *ctx, const char *dir)
{
    snapshot_times times;
    TRY(read_times(&times, ctx, dir, 1));
    *out = times.entry[0];
    snapshot_times_free(ctx, &times);
    return FLOE_OK;
}

void snapshot_times_free(context *ctx, snapshot_times *t)
{
    memory_free(ctx, &t->entry);
    *t = (snapshot_times){0};
}

static floe_status read_domain(snapshot *s)
{
    char geometry[SNAPSHOT_TEXT];
    int n, one;
    TRY(hdf_get_attribute(s->hdf, "/", "domain_lower", 3, s->lower, &s->dim));
    TRY(hdf_get_attribute(s->hdf, "/", "domain_upper", 3, s->upper, &n));
    TRY(hdf_get_attribute(s->hdf, "/", "cell", 3, s->cell, &one));
    if (n != s->dim || one != s->dim) return fail(s->ctx, FLOE_IO, "'%s': its domain is of no dimension", s->path);
    TRY(hdf_get_attribute(s->hdf, "/", "volume_scale", 1, &s->volume_scale, &one));
    TRY(hdf_get_text(s->hdf, "/", "length_unit", s->unit));
    TRY(hdf_get_text(s->hdf, "/", "geometry", geometry));
    s->axisymmetric = strcmp(geometry, "axisymmetric") == 0;
    for (int a = 0; a < 3; a++) {
        s->cells[a] = 1;
        if (a < s->dim) TRY(snapshot_count_cells(s, a));
    }
    return FLOE_OK;
}

static floe_status read_head(snapshot *s)
{
    TRY(snapshot_check_version(s));
    TRY(hdf_read(s->hdf, "/time", HDF_DOUBLE, (hdf_shape){0}, &s->time));
    TRY(snapshot_check_time(s->ctx, s->path, s->time));
    TRY(hdf_get_text(s->hdf, "/time", "unit", s->time_unit));
    TRY(hdf_get_text(s->hdf, "/", "title", s->title));
    TRY(hdf_get_text(s->hdf, "/", "coupling", s->coupling));
    return read_domain(s);
}

/* Name, unit and kind of one array; the number of entries of the group must be that of the array. */
static floe_status read_field(const snapshot *s, const char *group, size_t entries, size_t n, snapshot_field *field)
{
    char path[PATH];
    hdf_type type;
    hdf_shape shape;
    TRY(hdf_entry(s->hdf, group, n, field->name));
    (void)snprintf(path, sizeof path, "%s/%s", group, field->name);
    TRY(hdf_get_text(s->hdf, path, "unit", field->unit));
    TRY(hdf_get_text(s->hdf, path, "meaning", field->meaning));
    TRY(hdf_describe(s->hdf, path, &type, &shape));
    const size_t numbers = hdf_count(shape);
    field->components = numbers == entries ? 1 : 3;
    if (numbers == entries * (size_t)field->components && entries > 0)
        return snapshot_check_field(s, path, field, numbers);
    return fail(s->ctx, FLOE_IO, "'%s': '%s' has %zu numbers for %zu entries", s->path, path, numbers, entries);
}

static floe_status read_fields(const snapshot *s, const char *path, snapshot_group *group)
{
    const size_t n = hdf_entries(s->hdf, path);
    TRY(memory_new(s->ctx, &group->field, n, sizeof *group->field));
    for (size_t i = 0; i < n; i++) {
        TRY(read_field(s, path, group->n, i, &group->field[i]));
        group->n_fields++;
    }
    return FLOE_OK;
}

static floe_status read_grid(snapshot *s)
{
    (void)snprintf(s->grid.name, sizeof s->grid.name, "cells");
    if (!hdf_has(s->hdf, "/cells")) return FLOE_OK;
    s->grid.n = (size_t)s->cells[0] * (size_t)s->cells[1] * (size_t)s->cells[2];
    TRY(snapshot_check_mesh(s));
    return read_fields(s, "/cells", &s->grid);
}

static floe_status read_body(const snapshot *s, snapshot_group *body)
{
    char path[PATH], position[2 * PATH], phase[SNAPSHOT_TEXT];
    hdf_type type;
    hdf_shape shape;
    (void)snprintf(path, sizeof path, "/points/%s", body->name);
    (void)snprintf(position, sizeof position, "%s/position", path);
    TRY(hdf_get_text(s->hdf, path, "material", body->material));
    TRY(hdf_get_text(s->hdf, path, "phase", phase));
    body->fluid = strcmp(phase, "fluid") == 0;
    TRY(hdf_describe(s->hdf, position, &type, &shape));
    body->n = shape.rank == 2 ? shape.extent[0] : 0;
    if (body->n == 0 || shape.extent[1] != 3)
        return fail(s->ctx, FLOE_IO, "'%s': '%s' is no list of places", s->path, position);
    TRY(read_fields(s, path, body));
    return snapshot_check_points(s, path, body);
}

static floe_status read_bodies(snapshot *s)
{
    const size_t n = hdf_entries(s->hdf, "/points");
    TRY(memory_new(s->ctx, &s->body, n, sizeof *s->body));
    for (size_t i = 0; i < n; i++) {
        s->n_bodies++; /* so that what a failure leaves is freed */
        TRY(hdf_entry(s->hdf, "/points", i, s->body[i].name));
        TRY(read_body(s, &s->body[i]));
    }
    return FLOE_OK;
}

floe_status snapshot_read(snapshot *out, context *ctx, const char *dir, long number)
{
    *out = (snapshot){.ctx = ctx, .number = number};
    TRY(make_path(ctx, &out->path, dir, number));
    TRY(memory_new(ctx, &out->hdf, 1, sizeof *out->hdf));
    TRY(snapshot_file_open(ctx, out->path, out->hdf));
    TRY(read_head(out));
    TRY(read_grid(out));
    return read_bodies(out);
}

void snapshot_free(snapshot *s)
{
    if (!s->ctx) return;
    if (s->hdf && s->hdf->name) hdf_close(s->hdf);
    for (size_t i = 0; i < s->n_bodies; i++) memory_free(s->ctx, &s->body[i].field);
    memory_free(s->ctx, &s->body);
    memory_free(s->ctx, &s->grid.field);
    memory_free(s->ctx, &s->hdf);
    memory_free(s->ctx, &s->path);
    *s = (snapshot){0};
}

const snapshot_field *snapshot_find(const snapshot_group *group, const char *name)
{
    for (size_t i = 0; i < group->n_fields; i++) {
        if (strcmp(group->field[i].name, name) == 0) return &group->field[i];
    }
    return NULL;
}

floe_status snapshot_values(const snapshot *s, const snapshot_group *group, const snapshot_field *field, double **out)
{
    char path[PATH];
    const size_t n = group->n * (size_t)field->components;
    (void)snprintf(path, sizeof path, "%s%s/%s", group == &s->grid ? "/" : "/points/", group->name, field->name);
    TRY(memory_new(s->ctx, out, n, sizeof **out));
    const floe_status status = hdf_read_numbers(s->hdf, path, n, *out);
    if (status != FLOE_OK) memory_free(s->ctx, out);
    return status;
}

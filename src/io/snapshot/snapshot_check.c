#include "io/snapshot/snapshot_check.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static const double cells_most = 1e9; /* along one axis */

floe_status snapshot_check_version(const snapshot *s)
{
    char content[HDF_NAME];
    double schema;
    int one;
    TRY(hdf_get_text(s->hdf, "/", "content", content));
    if (strcmp(content, "floe snapshot") != 0)
        return fail(s->ctx, FLOE_IO, "'%s': its content is '%.60s', not 'floe snapshot'", s->path, content);
    TRY(hdf_get_attribute(s->hdf, "/", "schema", 1, &schema, &one));
    if (schema == 1.0) return FLOE_OK;
    return fail(s->ctx, FLOE_IO, "'%s' is of schema %g, and this floe reads schema 1", s->path, schema);
}

floe_status snapshot_check_time(context *ctx, const char *path, double time)
{
    if (isfinite(time) && time >= 0.0) return FLOE_OK;
    return fail(ctx, FLOE_IO, "'%s': '/time' is %g, must be finite and >= 0", path, time);
}

floe_status snapshot_count_cells(snapshot *s, int axis)
{
    static const double slack = 1e-6; /* of a cell */
    const double length = s->upper[axis] - s->lower[axis], cell = s->cell[axis], cells = length / cell;
    const bool fine = isfinite(s->lower[axis]) && isfinite(length) && cell > 0.0 && cells >= 0.5 && cells <= cells_most;
    if (!fine || !(fabs(cells - nearbyint(cells)) <= slack * cells))
        return fail(s->ctx, FLOE_IO,
                    "'%s': from domain_lower to domain_upper along axis %d, %g to %g, is no whole number of cells of "
                    "cell = %g",
                    s->path, axis, s->lower[axis], s->upper[axis], cell);
    s->cells[axis] = (int)lround(cells);
    if (s->volume_scale > 0.0 && isfinite(s->volume_scale)) return FLOE_OK;
    return fail(s->ctx, FLOE_IO, "'%s': its volume_scale is %g, must be > 0", s->path, s->volume_scale);
}

floe_status snapshot_check_mesh(const snapshot *s)
{
    double cells[3], spacing[3];
    int n, m;
    TRY(hdf_get_attribute(s->hdf, "/cells", "cells", 3, cells, &n));
    TRY(hdf_get_attribute(s->hdf, "/cells", "spacing", 3, spacing, &m));
    bool fine = n == s->dim && m == s->dim;
    for (int a = 0; a < s->dim && fine; a++) fine = cells[a] == s->cells[a] && spacing[a] == s->cell[a];
    return fine ? FLOE_OK : fail(s->ctx, FLOE_IO, "'%s': '/cells' is of another mesh than its domain", s->path);
}

/* What numbers of a name are beside finite. */
typedef struct sign {
    const char *name; /* the whole of it, or its first part */
    bool above;       /* > 0; else >= 0 */
} sign;

static const sign *sign_of(const char *path, const char *name)
{
    static const sign of_points[] = {{"mass", true},
                                     {"initial_volume", true},
                                     {"mass_share", true},
                                     {"volume_ratio", true}},
                      of_cells[] = {{"density_", false},
                                    {"volume_fraction_", false},
                                    {"specific_volume_", false},
                                    {"open_fraction_", false}};
    const bool cells = strncmp(path, "/cells/", 7) == 0;
    for (size_t i = 0; i < 4; i++) {
        const sign *one = cells ? &of_cells[i] : &of_points[i];
        if (cells ? strncmp(name, one->name, strlen(one->name)) == 0 : strcmp(name, one->name) == 0) return one;
    }
    return NULL;
}

floe_status snapshot_check_field(const snapshot *s, const char *path, const snapshot_field *field, size_t numbers)
{
    double *x;
    TRY(memory_new(s->ctx, &x, numbers, sizeof *x));
    floe_status status = hdf_read_numbers(s->hdf, path, numbers, x);
    const sign *must = sign_of(path, field->name);
    for (size_t i = 0; i < numbers && status == FLOE_OK; i++) {
        if (isfinite(x[i]) && (!must || (must->above ? x[i] > 0.0 : x[i] >= 0.0))) continue;
        status = fail(s->ctx, FLOE_IO, "'%s': '%s' has %g at place %zu, must be %s", s->path, path, x[i], i,
                      !must         ? "finite"
                      : must->above ? "> 0"
                                    : ">= 0");
    }
    memory_free(s->ctx, &x);
    return status;
}

static floe_status check_places(const snapshot *s, const char *path, const double *x, size_t n)
{
    static const double slack = 1e-9; /* of the domain */
    for (size_t i = 0; i < n; i++)
        for (int a = 0; a < s->dim; a++) {
            const double at = x[3 * i + (size_t)a], reach = slack * (s->upper[a] - s->lower[a]);
            if (at >= s->lower[a] - reach && at <= s->upper[a] + reach) continue;
            return fail(s->ctx, FLOE_IO, "'%s': '%s/position' has point %zu outside of the domain, at %g along axis %d",
                        s->path, path, i, at, a);
        }
    return FLOE_OK;
}

static floe_status check_ids(const snapshot *s, const char *path, const double *id, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (id[i] >= 0.0 && (i == 0 || id[i] > id[i - 1])) continue;
        return fail(s->ctx, FLOE_IO, "'%s': '%s/id' has %.17g at place %zu: numbers of points must rise", s->path, path,
                    id[i], i);
    }
    return FLOE_OK;
}

floe_status snapshot_check_points(const snapshot *s, const char *path, const snapshot_group *body)
{
    static const char *const needed[] = {"position", "id", "mass"};
    double *x;
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        const snapshot_field *field = snapshot_find(body, needed[i]);
        if (!field || field->components != (i == 0 ? 3 : 1))
            return fail(s->ctx, FLOE_IO, "'%s': '%s' has no '%s' of its points", s->path, path, needed[i]);
    }
    TRY(snapshot_values(s, body, snapshot_find(body, "position"), &x));
    floe_status status = check_places(s, path, x, body->n);
    memory_free(s->ctx, &x);
    TRY(status);
    TRY(snapshot_values(s, body, snapshot_find(body, "id"), &x));
    status = check_ids(s, path, x, body->n);
    memory_free(s->ctx, &x);
    return status;
}

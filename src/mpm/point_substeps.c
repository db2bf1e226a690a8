/* A step of the points in equal substeps, beside gas that takes it as one (theory 7.3). The forces of the gas on the
 * boundaries are constant, and the points' own forces are computed in each substep. Every substep but the last is
 * committed before the next, so the state at the start of the step is saved, and restored if a later stage requires a
 * smaller step. */
#include "base/memory.h"
#include "mpm/edge/edge.h"
#include "mpm/step.h"
#include "mpm/surface/surfaces.h"

#include <string.h>

/* Points of one body in one block. Owned arrays. */
typedef struct saved_body {
    size_t n, reserved, *tile_start;
    double *value; /* the arrays of their state, `n` numbers each, one after the other */
} saved_body;

/* State outside the fields. Owned. */
typedef struct saved_extra {
    size_t n, reserved;
    double *value;
} saved_extra;

enum { SAVED_SURFACE, SAVED_MARKERS, SAVED_EDGES, SAVED_OVERLAPS, SAVED_EXTRAS };

typedef struct saved_points {
    saved_body body[MESH_MAX_BLOCKS][SCENE_MAX_BODIES];
    saved_extra extra[SAVED_EXTRAS];
    double dt_previous; /* s */
} saved_points;

void free_saved_points(mpm *s)
{
    for (int b = 0; s->saved && b < MESH_MAX_BLOCKS; ++b)
        for (int k = 0; k < SCENE_MAX_BODIES; ++k) {
            memory_free(s->ctx, &s->saved->body[b][k].tile_start);
            memory_free(s->ctx, &s->saved->body[b][k].value);
        }
    for (int k = 0; s->saved && k < SAVED_EXTRAS; ++k) memory_free(s->ctx, &s->saved->extra[k].value);
    memory_free(s->ctx, &s->saved);
}

static floe_status reserve_values(context *ctx, double **value, size_t *reserved, size_t n)
{
    if (n <= *reserved) return FLOE_OK;
    *reserved = n + n / 2;
    return memory_resize(ctx, value, *reserved, sizeof **value);
}

/* ---- points ---- */

/* Visits an array of a body's state in a block, with its copy. */
typedef void array_visitor(double *array, size_t n, double *saved);

static void save_array(double *array, size_t n, double *saved)
{
    memcpy(saved, array, n * sizeof *array);
}

static void restore_array(double *array, size_t n, double *saved)
{
    memcpy(array, saved, n * sizeof *array);
}

/* Calls for each of them (NULL: for none); returns how many there are. */
static size_t visit_arrays(const mpm *s, int blk, int body, size_t n, array_visitor *visit, double *saved)
{
    const fields *f = s->domain->fields[blk];
    size_t count = 0;
    for (int id = 0; id < FIELD_COUNT; ++id) {
        const field_info *info = field_describe((field_id)id);
        const bool state = info->class == FIELD_STATE || info->class == FIELD_FIXED;
        if (info->centring != FIELD_POINT || !state || !fields_has(f, (field_id)id, body)) continue;
        for (int c = 0; c < field_component_count(info->components, s->mesh->dim); ++c, ++count)
            if (visit && n > 0) visit(field_get(f, (field_id)id, body, c), n, saved + count * n);
    }
    return count;
}

static floe_status save_body(mpm *s, int blk, int body)
{
    saved_body *k = &s->saved->body[blk][body];
    const mpm_points *p = &s->points[blk][body];
    const size_t tiles = (size_t)s->mesh->block[blk].n_tiles + 1;
    TRY(reserve_values(s->ctx, &k->value, &k->reserved, p->n * visit_arrays(s, blk, body, 0, NULL, NULL)));
    if (!k->tile_start) TRY(memory_new(s->ctx, &k->tile_start, tiles, sizeof *k->tile_start));
    k->n = p->n;
    memcpy(k->tile_start, p->tile_start, tiles * sizeof *k->tile_start);
    (void)visit_arrays(s, blk, body, k->n, save_array, k->value);
    return FLOE_OK;
}

static void restore_body(mpm *s, int blk, int body)
{
    const saved_body *k = &s->saved->body[blk][body];
    mpm_points *p = &s->points[blk][body];
    p->n = k->n;
    memcpy(p->tile_start, k->tile_start, ((size_t)s->mesh->block[blk].n_tiles + 1) * sizeof *k->tile_start);
    (void)visit_arrays(s, blk, body, k->n, restore_array, k->value);
}

/* ---- state outside the fields ---- */

/* All but the history of edges, whose lists are invalid once it may have been changed. */
static double *extra_of(mpm *s, int which, size_t *n)
{
    size_t count = 0, stride = 1;
    double *value = which == SAVED_SURFACE   ? mpm_surface(s, &count, &stride)
                    : which == SAVED_MARKERS ? mpm_surface_markers(s, &count, &stride)
                                             : mpm_overlaps_state(s, &count);
    *n = count * stride;
    return value;
}

static floe_status save_extra(mpm *s, int which)
{
    saved_extra *k = &s->saved->extra[which];
    const double *from = which == SAVED_EDGES ? edges_history(s, &k->n) : extra_of(s, which, &k->n);
    TRY(reserve_values(s->ctx, &k->value, &k->reserved, k->n));
    if (k->n > 0) memcpy(k->value, from, k->n * sizeof *from);
    return FLOE_OK;
}

static void restore_extra(mpm *s, int which)
{
    const saved_extra *k = &s->saved->extra[which];
    size_t n;
    double *to = which == SAVED_EDGES ? mpm_edges_state(s, &n) : extra_of(s, which, &n);
    if (k->n > 0) memcpy(to, k->value, k->n * sizeof *to);
}

/* ---- the step ---- */

static floe_status save_state(mpm *s)
{
    if (!s->saved) TRY(memory_new(s->ctx, &s->saved, 1, sizeof *s->saved));
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) TRY(save_body(s, b, body));
    for (int k = 0; k < SAVED_EXTRAS; ++k) TRY(save_extra(s, k));
    s->saved->dt_previous = s->dt_previous;
    return FLOE_OK;
}

void mpm_rollback_step(mpm *s)
{
    size_t n;
    if (s->substep == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) restore_body(s, b, body);
    for (int e = 0; e < SAVED_EXTRAS; ++e) restore_extra(s, e);
    (void)mpm_edges_state(s, &n); /* lists of edges belong to the step that was rolled back */
    s->dt_previous = s->saved->dt_previous;
    s->substep = 0;
}

/* Commits the substep: the next one starts from its state. */
static floe_status commit_substep(mpm *s)
{
    s->substep++;
    for (int b = 0; b < s->mesh->n_blocks; ++b) fields_commit_points(s->domain->fields[b]);
    return mpm_commit(s);
}

/* Markers have the mean velocity of the whole step: that of the last substep would sample motions that the gas cannot
 * follow. */
static void steady_markers(mpm *s, double dt)
{
    const surface_markers *k = &s->surfaces->markers;
    const double *start = s->saved->extra[SAVED_MARKERS].value;
    const size_t stride = sizeof(surface_marker) / sizeof(double);
    for (size_t n = 0; n < k->n; ++n)
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double x = start[n * stride + (size_t)a];
            k->next[n].v[a] = (k->next[n].x[a] - x - mesh_to_image(s->mesh, a, x, k->next[n].x[a])) / dt;
        }
}

floe_status mpm_step_in_substeps(mpm *s)
{
    const double dt = s->dt;
    if (s->n_substeps == 1 || s->stages->planning) return mpm_step(s);
    TRY(save_state(s));
    s->dt = dt / s->n_substeps;
    while (s->substep < s->n_substeps - 1) {
        TRY(mpm_step(s));
        TRY(commit_substep(s));
    }
    TRY(mpm_step(s));
    steady_markers(s, dt);
    return FLOE_OK;
}

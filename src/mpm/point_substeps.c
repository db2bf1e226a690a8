/* A step of the points in equal parts, beside gas that takes it as one (theory 7.3): the gas's forces on
 * the lines stay as they are, and the points' own are renewed in each part. Every part but the last is made final
 * before the next, so the start of the step is kept, to be put back where a later stage asks for a smaller one. */
#include "base/memory.h"
#include "mpm/edge/edge.h"

#include <string.h>

/* Points of one body in one block. Owned arrays. */
typedef struct saved_body {
    size_t n, reserved, *tile_start;
    double *value; /* the arrays of their state, `n` numbers each, one after the other */
} saved_body;

/* State that no field holds. Owned. */
typedef struct saved_extra {
    size_t n, reserved;
    double *value;
} saved_extra;

enum { KEPT_SURFACE, KEPT_SKIN, KEPT_EDGES, KEPT_OVERLAPS, KEPT_EXTRAS };

struct saved_points {
    saved_body body[MESH_MAX_BLOCKS][SCENE_MAX_BODIES];
    saved_extra extra[KEPT_EXTRAS];
    double dt_previous; /* s */
};

void free_saved_points(context *ctx, struct mpm_work *w)
{
    for (int b = 0; w->saved && b < MESH_MAX_BLOCKS; ++b)
        for (int k = 0; k < SCENE_MAX_BODIES; ++k) {
            memory_free(ctx, &w->saved->body[b][k].tile_start);
            memory_free(ctx, &w->saved->body[b][k].value);
        }
    for (int k = 0; w->saved && k < KEPT_EXTRAS; ++k) memory_free(ctx, &w->saved->extra[k].value);
    memory_free(ctx, &w->saved);
}

static floe_status reserve_values(context *ctx, double **value, size_t *reserved, size_t n)
{
    if (n <= *reserved) return FLOE_OK;
    *reserved = n + n / 2;
    return memory_resize(ctx, value, *reserved, sizeof **value);
}

/* ---- points ---- */

/* Takes an array of a body's state in a block, and its place among what is kept. */
typedef void array_visitor(double *array, size_t n, double *saved);

static void save_array(double *array, size_t n, double *saved)
{
    memcpy(saved, array, n * sizeof *array);
}

static void put_array(double *array, size_t n, double *saved)
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
    saved_body *k = &s->work->saved->body[blk][body];
    const mpm_points *p = &s->points[blk][body];
    const size_t tiles = (size_t)s->mesh->block[blk].n_tiles + 1;
    TRY(reserve_values(s->ctx, &k->value, &k->reserved, p->n * visit_arrays(s, blk, body, 0, NULL, NULL)));
    if (!k->tile_start) TRY(memory_new(s->ctx, &k->tile_start, tiles, sizeof *k->tile_start));
    k->n = p->n;
    memcpy(k->tile_start, p->tile_start, tiles * sizeof *k->tile_start);
    (void)visit_arrays(s, blk, body, k->n, save_array, k->value);
    return FLOE_OK;
}

static void put_body(mpm *s, int blk, int body)
{
    const saved_body *k = &s->work->saved->body[blk][body];
    mpm_points *p = &s->points[blk][body];
    p->n = k->n;
    memcpy(p->tile_start, k->tile_start, ((size_t)s->mesh->block[blk].n_tiles + 1) * sizeof *k->tile_start);
    (void)visit_arrays(s, blk, body, k->n, put_array, k->value);
}

/* ---- what no field holds ---- */

static double *extra_of(mpm *s, int which, size_t *n)
{
    const mpm_edges *e = s->work->edges;
    size_t count = e ? e->n_memory : 0, stride = 1;
    double *value = which == KEPT_SURFACE    ? mpm_surface(s, &count, &stride)
                    : which == KEPT_SKIN     ? mpm_surface_markers(s, &count, &stride)
                    : which == KEPT_OVERLAPS ? mpm_overlaps_state(s, &count)
                    : e                      ? e->memory
                                             : NULL;
    *n = count * stride;
    return value;
}

static floe_status save_extra(mpm *s, int which)
{
    saved_extra *k = &s->work->saved->extra[which];
    const double *from = extra_of(s, which, &k->n);
    TRY(reserve_values(s->ctx, &k->value, &k->reserved, k->n));
    if (k->n > 0) memcpy(k->value, from, k->n * sizeof *from);
    return FLOE_OK;
}

static void put_extra(mpm *s, int which)
{
    const saved_extra *k = &s->work->saved->extra[which];
    size_t n;
    double *to = which == KEPT_EDGES ? mpm_edges_state(s, &n) : extra_of(s, which, &n);
    if (k->n > 0) memcpy(to, k->value, k->n * sizeof *to);
}

/* ---- the step ---- */

static floe_status save_state(mpm *s)
{
    if (!s->work->saved) TRY(memory_new(s->ctx, &s->work->saved, 1, sizeof *s->work->saved));
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) TRY(save_body(s, b, body));
    for (int k = 0; k < KEPT_EXTRAS; ++k) TRY(save_extra(s, k));
    s->work->saved->dt_previous = s->dt_previous;
    return FLOE_OK;
}

void mpm_rollback_step(mpm *s)
{
    size_t n;
    if (s->substep == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) put_body(s, b, body);
    for (int e = 0; e < KEPT_EXTRAS; ++e) put_extra(s, e);
    (void)mpm_edges_state(s, &n); /* lists of edges belong to the step that was rolled back */
    s->dt_previous = s->work->saved->dt_previous;
    s->substep = 0;
}

/* The part in hand becomes what the next one starts from. */
static floe_status next_part(mpm *s)
{
    s->substep++;
    for (int b = 0; b < s->mesh->n_blocks; ++b) fields_commit_points(s->domain->fields[b]);
    return mpm_commit(s);
}

/* Markers have the mean velocity of the whole step: that of the last substep would sample motions that the gas cannot
 * follow. */
static void steady_markers(mpm *s, double dt)
{
    const surface_markers *k = &s->work->markers;
    const double *start = s->work->saved->extra[KEPT_SKIN].value;
    const size_t stride = sizeof(surface_marker) / sizeof(double);
    for (size_t n = 0; n < k->n; ++n)
        for (size_t a = 0; a < 2; ++a) k->next[n].v[a] = (k->next[n].x[a] - start[n * stride + a]) / dt;
}

floe_status mpm_step_in_substeps(mpm *s)
{
    const double dt = s->dt;
    if (s->n_substeps == 1 || s->stages->planning) return mpm_step(s);
    TRY(save_state(s));
    s->dt = dt / s->n_substeps;
    while (s->substep < s->n_substeps - 1) {
        TRY(mpm_step(s));
        TRY(next_part(s));
    }
    TRY(mpm_step(s));
    steady_markers(s, dt);
    return FLOE_OK;
}

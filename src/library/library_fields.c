/* Fields as views, copies and values at a place (floe/floe.h). */
#include "library/library_internal.h"

#include "base/memory.h"
#include "base/text.h"
#include "io/gather.h"
#include "io/output_field.h"
#include "io/probe.h"

#include <math.h>
#include <string.h>

/* ---- the list ---- */

/* One walk: counts first, then fills. */
typedef struct list_walk {
    floe_simulation *s;
    const char *group; /* "cells", "nodes", "points/BODY" */
    floe_centring centring;
    int body;
    size_t n;
} list_walk;

static floe_status count_field(void *user, const output_field *field)
{
    (void)field;
    ((list_walk *)user)->n++;
    return FLOE_OK;
}

static floe_status list_field(void *user, const output_field *field)
{
    list_walk *w = user;
    floe_simulation *s = w->s;
    named_field *out = &s->field[w->n++];
    char name[3 * NAME_SIZE];
    *out = (named_field){.centring = w->centring,
                         .body = w->body,
                         .id = field->id,
                         .instance = field->instance,
                         .comp = field->comp,
                         .components = field->components,
                         .scale = field->scale};
    s->n_fields = w->n;
    (void)snprintf(name, sizeof name, "%s/%s", w->group, field->name);
    (void)snprintf(out->unit, sizeof out->unit, "%s", output_unit(s->sim, field->unit));
    TRY(memory_string(s->ctx, &out->meaning, field->meaning));
    return memory_string(s->ctx, &out->name, name);
}

static floe_status walk_fields(list_walk *w, output_field_visitor *visit)
{
    const sim *s = w->s->sim;
    w->n = 0;
    *w = (list_walk){.s = w->s, .group = "cells", .centring = FLOE_CELLS};
    TRY(output_fields_of_cells(s, visit, w));
    w->group = "nodes";
    w->centring = FLOE_NODES;
    TRY(output_fields_of_nodes(s, visit, w));
    w->centring = FLOE_POINTS;
    for (w->body = 0; s->mpm && w->body < s->mpm->n_bodies; w->body++) {
        char label[NAME_SIZE], group[NAME_SIZE + 8];
        body_label(s, s->mpm->body[w->body].scene_body, label);
        (void)snprintf(group, sizeof group, "points/%s", label);
        w->group = group;
        TRY(output_fields_of_points(s, w->body, visit, w));
    }
    return FLOE_OK;
}

floe_status field_list_make(floe_simulation *s)
{
    list_walk w = {.s = s};
    TRY(walk_fields(&w, count_field));
    TRY(memory_new(s->ctx, &s->field, w.n, sizeof *s->field));
    return walk_fields(&w, list_field);
}

void field_list_free(floe_simulation *s)
{
    for (size_t i = 0; i < s->n_fields; i++) {
        memory_free(s->ctx, &s->field[i].name);
        memory_free(s->ctx, &s->field[i].meaning);
    }
    memory_free(s->ctx, &s->field);
    s->n_fields = 0;
}

const char *floe_field_name(const floe_simulation *s, int i)
{
    return i >= 0 && (size_t)i < s->n_fields ? s->field[i].name : NULL;
}

static floe_status refuse_field(floe_simulation *s, const char *name)
{
    char names[CONTEXT_MESSAGE_SIZE - 256] = "";
    for (size_t i = 0; i < s->n_fields; i++) text_add(names, sizeof names, "%s%s", i > 0 ? ", " : "", s->field[i].name);
    return fail(s->ctx, FLOE_BAD_INPUT, "there is no field '%.100s'; there are: %s", name, names);
}

/* The field of that name, with what is derived from the state brought up to date. */
static floe_status find_field(floe_simulation *s, const char *name, const named_field **out)
{
    library_clear_messages(s->deck->floe);
    *out = NULL;
    for (size_t i = 0; i < s->n_fields && !*out; i++)
        if (strcmp(s->field[i].name, name) == 0) *out = &s->field[i];
    if (!*out) return refuse_field(s, name);
    if (s->refreshed != s->sim->steps) TRY(sim_refresh(s->sim));
    s->refreshed = s->sim->steps;
    return FLOE_OK;
}

/* ---- views ---- */

/* Entries of so many cells along an axis, of a block or of the whole mesh. */
static size_t entries_along(const floe_simulation *s, const named_field *f, const int n[MESH_MAX_DIM], int axis)
{
    return (size_t)n[axis] + (f->centring == FLOE_NODES && axis < s->sim->mesh.dim ? 1 : 0);
}

static void view_of_grid(const floe_simulation *s, const named_field *f, int n, floe_view *view)
{
    const block *b = &s->sim->mesh.block[n];
    for (int a = 0; a < 3; a++) {
        view->shape[a] = entries_along(s, f, b->n, a);
        view->stride[a] = b->stride[a];
        view->first[a] = (size_t)b->lo[a];
    }
    for (int c = 0; c < f->components; c++)
        view->data[c] = field_get(s->sim->domain->fields[n], f->id, f->instance, f->comp + c) + mesh_index(b, 0, 0, 0);
}

static void view_of_points(const floe_simulation *s, const named_field *f, int n, floe_view *view)
{
    view->shape[0] = s->sim->mpm->points[n][f->body].n;
    view->shape[1] = view->shape[2] = 1;
    view->stride[0] = 1;
    for (int c = 0; c < f->components; c++)
        view->data[c] = field_get(s->sim->domain->fields[n], f->id, f->instance, f->comp + c);
}

static floe_view view_of(const floe_simulation *s, const named_field *f, int n)
{
    floe_view view = {.components = f->components,
                      .centring = f->centring,
                      .scale = f->scale,
                      .unit = f->unit,
                      .meaning = f->meaning};
    if (f->centring == FLOE_POINTS)
        view_of_points(s, f, n, &view);
    else
        view_of_grid(s, f, n, &view);
    return view;
}

floe_status floe_field(floe_simulation *s, const char *name, int n, floe_view *view)
{
    const named_field *f;
    *view = (floe_view){0};
    TRY(find_field(s, name, &f));
    if (n < 0 || n >= s->sim->mesh.n_blocks)
        return fail(s->ctx, FLOE_BAD_INPUT, "there is no block %d: the mesh has %d", n, s->sim->mesh.n_blocks);
    *view = view_of(s, f, n);
    return FLOE_OK;
}

floe_mesh floe_get_mesh(const floe_simulation *s)
{
    const mesh *m = &s->sim->mesh;
    floe_mesh out = {.dimension = m->dim, .axisymmetric = m->geometry == MESH_AXISYMMETRIC, .blocks = m->n_blocks};
    for (int a = 0; a < 3; a++) {
        out.lower[a] = a < m->dim ? m->lower[a] : 0.0;
        out.spacing[a] = m->h[a];
        out.cells[a] = (size_t)m->n[a];
    }
    return out;
}

/* ---- copies ---- */

static void copy_block(const floe_simulation *s, const named_field *f, int n, double *to)
{
    const floe_view v = view_of(s, f, n);
    const int *cells = s->sim->mesh.n;
    const size_t nx = entries_along(s, f, cells, 0), ny = entries_along(s, f, cells, 1), width = (size_t)v.components;
    for (size_t k = 0; k < v.shape[2]; k++)
        for (size_t j = 0; j < v.shape[1]; j++)
            for (size_t i = 0; i < v.shape[0]; i++) {
                const ptrdiff_t at =
                    (ptrdiff_t)i * v.stride[0] + (ptrdiff_t)j * v.stride[1] + (ptrdiff_t)k * v.stride[2];
                double *entry = to + width * (((k + v.first[2]) * ny + j + v.first[1]) * nx + i + v.first[0]);
                for (size_t c = 0; c < width; c++) entry[c] = v.data[c][at] * v.scale;
            }
}

static floe_status copy_points(floe_simulation *s, const named_field *f, size_t n, double *to)
{
    point_list list;
    const size_t width = (size_t)f->components;
    TRY(point_list_make(&list, s->sim, f->body));
    for (size_t c = 0; c < width; c++) gather_points(s->sim, &list, f->id, f->comp + (int)c, width, to + c);
    for (size_t i = 0; i < n; i++) to[i] *= f->scale;
    point_list_free(s->ctx, &list);
    return FLOE_OK;
}

static size_t count_numbers(const floe_simulation *s, const named_field *f)
{
    const int *cells = s->sim->mesh.n;
    if (f->centring != FLOE_POINTS)
        return (size_t)f->components * entries_along(s, f, cells, 0) * entries_along(s, f, cells, 1) *
               entries_along(s, f, cells, 2);
    return (size_t)f->components * mpm_body_points(s->sim->mpm, f->body);
}

floe_status floe_copy_field(floe_simulation *s, const char *name, double *to, size_t n, size_t *needed)
{
    const named_field *f;
    if (needed) *needed = 0;
    TRY(find_field(s, name, &f));
    const size_t numbers = count_numbers(s, f);
    if (needed) *needed = numbers;
    if (!to) return FLOE_OK;
    if (n != numbers)
        return fail(s->ctx, FLOE_BAD_INPUT, "the field '%s' has %zu numbers, and there is space for %zu", name, numbers,
                    n);
    if (f->centring == FLOE_POINTS) return copy_points(s, f, n, to);
    for (int b = 0; b < s->sim->mesh.n_blocks; b++) copy_block(s, f, b, to);
    return FLOE_OK;
}

/* ---- at a place ---- */

floe_probe floe_probe_at(const floe_simulation *s, const double *x)
{
    double at[3] = {0};
    for (int a = 0; a < s->sim->mesh.dim; a++) at[a] = x[a];
    const probe_value value = probe_read(s->sim, at);
    floe_probe out = {.pressure = value.pressure, .velocity = {NAN, NAN, NAN}};
    for (int a = 0; a < s->sim->mesh.dim; a++) out.velocity[a] = value.velocity[a];
    return out;
}

floe_status floe_field_at(floe_simulation *s, const char *name, const double *x, double *value)
{
    const mesh *m = &s->sim->mesh;
    const named_field *f;
    int cell[MESH_MAX_DIM] = {0};
    for (int c = 0; c < FLOE_MAX_COMPONENTS; c++) value[c] = (double)NAN;
    TRY(find_field(s, name, &f));
    if (!f || f->centring != FLOE_CELLS) return fail(s->ctx, FLOE_BAD_INPUT, "the field '%s' is not of cells", name);
    for (int a = 0; a < m->dim; a++) {
        if (!(x[a] >= m->lower[a] && x[a] <= m->upper[a]))
            return fail(s->ctx, FLOE_BAD_INPUT, "the place is outside the mesh: %g, not from %g to %g", x[a],
                        m->lower[a], m->upper[a]);
        cell[a] = mesh_cell_of(m, a, x[a]);
    }
    const int n = mesh_block_of(m, cell);
    const block *b = &m->block[n];
    const floe_view v = view_of(s, f, n);
    ptrdiff_t at = 0;
    for (int a = 0; a < m->dim; a++) at += (ptrdiff_t)(cell[a] - b->lo[a]) * v.stride[a];
    for (int c = 0; c < v.components; c++) value[c] = v.data[c][at];
    return FLOE_OK;
}

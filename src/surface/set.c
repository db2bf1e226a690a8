/* Points into cells, with their images. */
#include "base/memory.h"
#include "surface/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An image as near to its point as this share of a cell is the point. */
static const double same_place = 1e-6;

const surface_method *surface_find(const char *name)
{
    for (size_t k = 0; k < surface_registry_size; ++k)
        if (strcmp(surface_registry[k]->name, name) == 0) return surface_registry[k];
    return NULL;
}

void surface_set_init(surface_set *s, context *ctx, const mesh *m)
{
    *s = (surface_set){.ctx = ctx, .mesh = m, .measures = true};
}

static void free_list(context *ctx, surface_bins *l)
{
    memory_free(ctx, &l->entry);
    memory_free(ctx, &l->cell);
    *l = (surface_bins){0};
}

void surface_set_free(surface_set *s)
{
    free_list(s->ctx, &s->points);
    free_list(s->ctx, &s->inside);
}

/* Places of a point along an axis: its own first, then those of its images. */
typedef struct axis_images {
    double x[4];
    uint32_t code[4];
    int n;
} axis_images;

static void add_image(const surface_set *s, int axis, double own, double image, uint32_t code, axis_images *out)
{
    const double reach = SURFACE_HALO * s->mesh->h[axis];
    const bool near = image >= s->mesh->lower[axis] - reach && image <= s->mesh->upper[axis] + reach;
    if (!near || fabs(image - own) < same_place * s->mesh->h[axis]) return;
    out->x[out->n] = image;
    out->code[out->n++] = code;
}

static axis_images images_along(const surface_set *s, int axis, double x)
{
    const mesh *m = s->mesh;
    axis_images r = {.x = {x}, .n = 1};
    if (axis >= m->dim) return r;
    if (m->periodic[axis]) {
        add_image(s, axis, x, x - (m->upper[axis] - m->lower[axis]), 1, &r);
        add_image(s, axis, x, x + (m->upper[axis] - m->lower[axis]), 2, &r);
        return r;
    }
    if (s->mirror[axis][SIDE_LOWER]) add_image(s, axis, x, 2.0 * m->lower[axis] - x, 1, &r);
    if (s->mirror[axis][SIDE_UPPER]) add_image(s, axis, x, 2.0 * m->upper[axis] - x, 2, &r);
    return r;
}

/* False where a point is too far out to be told a cell. */
static bool find_cell(const mesh *m, surface_entry *e)
{
    for (int a = 0; a < 3; ++a) {
        const double scaled = a < m->dim ? (e->x[a] - m->lower[a]) / m->h[a] : 0.0;
        if (!(scaled > -1e6 && scaled < 1e9)) return false;
        e->cell[a] = (int)floor(scaled);
    }
    return true;
}

static void add_entries(surface_set *s, surface_bins *l, uint32_t number, const double *x)
{
    axis_images at[3];
    for (int a = 0; a < 3; ++a) at[a] = images_along(s, a, x[a]);
    for (int k = 0; k < at[2].n; ++k)
        for (int j = 0; j < at[1].n; ++j)
            for (int i = 0; i < at[0].n; ++i) {
                surface_entry e = {.x = {at[0].x[i], at[1].x[j], at[2].x[k]},
                                   .number = number,
                                   .image = at[0].code[i] + 3 * at[1].code[j] + 9 * at[2].code[k]};
                if (find_cell(s->mesh, &e)) l->entry[l->n++] = e;
            }
}

static int compare_cells(const int a[3], const int b[3])
{
    for (int k = 2; k >= 0; --k)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

static int compare_entries(const void *a, const void *b)
{
    const surface_entry *p = a, *q = b;
    const int cells = compare_cells(p->cell, q->cell);
    if (cells != 0) return cells;
    if (p->number != q->number) return p->number < q->number ? -1 : 1;
    return (p->image > q->image) - (p->image < q->image);
}

/* The cells of sorted entries. */
static void mark_cells(surface_bins *l)
{
    l->n_cells = 0;
    for (size_t k = 0; k < l->n; ++k) {
        if (k == 0 || compare_cells(l->entry[k].cell, l->entry[k - 1].cell) != 0) {
            surface_cell *c = &l->cell[l->n_cells++];
            *c = (surface_cell){.first = k};
            memcpy(c->at, l->entry[k].cell, sizeof c->at);
        }
        surface_cell *c = &l->cell[l->n_cells - 1];
        c->n++;
        c->own = c->own || l->entry[k].image == 0;
    }
}

/* The most entries that n points make. */
static size_t most_entries(const surface_set *s, size_t n)
{
    for (int a = 0; a < s->mesh->dim; ++a)
        n *= s->mesh->periodic[a] ? 3 : 1 + (size_t)s->mirror[a][SIDE_LOWER] + (size_t)s->mirror[a][SIDE_UPPER];
    return n;
}

static floe_status reserve_entries(surface_set *s, surface_bins *l, size_t n)
{
    const size_t entries = most_entries(s, n);
    if (entries <= l->reserved) return FLOE_OK;
    TRY(memory_resize(s->ctx, &l->entry, entries, sizeof *l->entry));
    TRY(memory_resize(s->ctx, &l->cell, entries, sizeof *l->cell));
    l->reserved = entries;
    return FLOE_OK;
}

static floe_status fill_bins(surface_set *s, surface_bins *l, size_t n, const double *place)
{
    TRY(reserve_entries(s, l, n));
    l->n = 0;
    for (size_t k = 0; k < n; ++k)
        if (isfinite(place[3 * k] + place[3 * k + 1] + place[3 * k + 2])) add_entries(s, l, (uint32_t)k, place + 3 * k);
    qsort(l->entry, l->n, sizeof *l->entry, compare_entries);
    mark_cells(l);
    return FLOE_OK;
}

floe_status surface_set_points(surface_set *s, size_t n, const double *place)
{
    s->n_points = n;
    s->place = place;
    return fill_bins(s, &s->points, n, place);
}

floe_status surface_set_inside(surface_set *s, size_t n, const double *place)
{
    return fill_bins(s, &s->inside, n, place);
}

const surface_cell *surface_cell_at(const surface_bins *l, const int at[3])
{
    size_t low = 0, high = l->n_cells;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const int order = compare_cells(l->cell[middle].at, at);
        if (order == 0) return &l->cell[middle];
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

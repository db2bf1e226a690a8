#include "geom/seed.h"

#include "base/memory.h"

#include <math.h>

/* Halvings of a cut sub-cell, by dimension: some 2^depth (2-D) or 4^depth (3-D) boxes a cut sub-cell. A disc of 20
 * cells across and 2 points a cell has its area to 1e-8, a ball its volume to 1e-7; edges and corners of a shape cost
 * more (tests/unit/test_geom_seed.c). */
static const int cut_depth[4] = {0, 40, 4, 3};

/* Sub-cells with less than this share always join a neighbour, or are left out where there is none: they are round-off of a surface along
 * a cell face. A point of next to no mass between two bodies that share a face goes with their round-off, until it is beyond its law. */
static const double least_share = 1e-9;

/* A range of global cells, and how sub-cells are numbered: by cell (axis 0 fastest), then within the cell. */
typedef struct sub_grid {
    const seed_spec *spec;
    int first[3], last[3]; /* cells [first, last) */
    int per[3];            /* points a cell along each axis; 1 along unused axes */
    int per_cell;          /* their product */
} sub_grid;

/* A sub-cell by its global index along each axis. */
typedef struct sub_cell {
    int at[3];
} sub_cell;

static sub_grid sub_grid_make(const shape *s, const seed_spec *spec)
{
    sub_grid g = {.spec = spec, .per_cell = 1};
    double lo[3], hi[3];
    const bool bounded = s->model->bounds(s->par, spec->dim, lo, hi);
    for (int k = 0; k < 3; k++) {
        const bool used = k < spec->dim;
        g.per[k] = used ? spec->per_cell[k] : 1;
        g.per_cell *= g.per[k];
        g.first[k] = 0;
        g.last[k] = used ? spec->n[k] : 1;
        if (!used || !bounded) continue;
        /* clamped as doubles, so that a far shape does not overflow an int; a cell more on each side for round-off */
        const double n = spec->n[k];
        g.first[k] = (int)fmin(fmax(floor((lo[k] - spec->lower[k]) / spec->h[k]) - 1.0, 0.0), n);
        g.last[k] = (int)fmin(fmax(ceil((hi[k] - spec->lower[k]) / spec->h[k]) + 1.0, g.first[k]), n);
    }
    return g;
}

static uint64_t sub_cell_key(const sub_grid *g, sub_cell c)
{
    uint64_t cell = 0, sub = 0;
    for (int k = 2; k >= 0; k--) {
        cell = cell * (uint64_t)(k < g->spec->dim ? g->spec->n[k] : 1) + (uint64_t)(c.at[k] / g->per[k]);
        sub = sub * (uint64_t)g->per[k] + (uint64_t)(c.at[k] % g->per[k]);
    }
    return cell * (uint64_t)g->per_cell + sub;
}

/* A face of the sub-grid, from the cell and the share of it: neighbours compute the same bits. With an offset of half a
 * sub-cell at most, every centre stays in the mesh, and none from beyond it comes in. */
static double sub_face(const sub_grid *g, int axis, int at)
{
    const int per = g->per[axis];
    const int cell = at / per;
    return g->spec->lower[axis] + g->spec->h[axis] * (cell + (at % per + g->spec->offset[axis]) / per);
}

static void sub_cell_box(const sub_grid *g, sub_cell c, double lo[3], double hi[3])
{
    for (int k = 0; k < g->spec->dim; k++) {
        lo[k] = sub_face(g, k, c.at[k]);
        hi[k] = sub_face(g, k, c.at[k] + 1);
    }
}

/* Whole volume: per radian where axisymmetric, r dr dz at the middle radius being exact. */
static double sub_cell_volume(const sub_grid *g, const double lo[3], const double hi[3])
{
    double volume = g->spec->axisymmetric ? 0.5 * (lo[0] + hi[0]) : 1.0;
    for (int k = 0; k < g->spec->dim; k++) volume *= g->spec->h[k] / g->per[k];
    return volume;
}

/* Steps to the next sub-cell in seeding order; false after the last. */
static bool sub_cell_next(const sub_grid *g, int cell[3], int sub[3])
{
    for (int k = 0; k < 3; k++) {
        if (++sub[k] < g->per[k]) return true;
        sub[k] = 0;
    }
    for (int k = 0; k < 3; k++) {
        if (++cell[k] < g->last[k]) return true;
        cell[k] = g->first[k];
    }
    return false;
}

/* What a sub-cell holds of the shape: its share of the sub-cell's volume, 0 if none, and where. */
static double sub_cell_share(const sub_grid *g, const shape *s, sub_cell c, double centre[3], double *volume)
{
    const seed_spec *spec = g->spec;
    double lo[3] = {0.0}, hi[3] = {0.0}, share;
    sub_cell_box(g, c, lo, hi);
    for (int k = 0; k < spec->dim; k++) centre[k] = 0.5 * (lo[k] + hi[k]);
    if (spec->method == SEED_LATTICE)
        share = shape_inside(s, spec->dim, centre) ? 1.0 : 0.0;
    else
        share = shape_fraction(s, spec->dim, lo, hi, spec->axisymmetric, cut_depth[spec->dim], centre);
    *volume = share * sub_cell_volume(g, lo, hi);
    return share;
}

/* The points as they are found, with what merging needs. */
typedef struct seeding {
    seed_list list;
    size_t reserved;
    uint64_t *key;  /* ascending */
    double *share;  /* of the sub-cell */
    size_t *target; /* where a sliver goes; itself for what stays */
} seeding;

static floe_status seeding_grow(seeding *w, context *ctx, int dim)
{
    if (w->list.n < w->reserved) return FLOE_OK;
    const size_t reserved = w->reserved == 0 ? 256 : 2 * w->reserved;
    for (int k = 0; k < dim; k++) TRY(memory_resize(ctx, &w->list.x[k], reserved, sizeof(double)));
    TRY(memory_resize(ctx, &w->list.volume, reserved, sizeof(double)));
    TRY(memory_resize(ctx, &w->key, reserved, sizeof(uint64_t)));
    TRY(memory_resize(ctx, &w->share, reserved, sizeof(double)));
    w->reserved = reserved;
    return FLOE_OK;
}

/* All sub-cells with a share, in seeding order. */
static floe_status seeding_collect(seeding *w, context *ctx, const shape *s, const sub_grid *g)
{
    for (int k = 0; k < 3; k++) {
        if (g->first[k] >= g->last[k]) return FLOE_OK;
    }
    int cell[3] = {g->first[0], g->first[1], g->first[2]}, sub[3] = {0};
    do {
        sub_cell c;
        double x[3] = {0.0}, volume;
        for (int k = 0; k < 3; k++) c.at[k] = cell[k] * g->per[k] + sub[k];
        const double share = sub_cell_share(g, s, c, x, &volume);
        if (!(volume > 0.0)) continue;
        TRY(seeding_grow(w, ctx, g->spec->dim));
        const size_t i = w->list.n++;
        for (int k = 0; k < g->spec->dim; k++) w->list.x[k][i] = x[k];
        w->list.volume[i] = volume;
        w->key[i] = sub_cell_key(g, c);
        w->share[i] = share;
    } while (sub_cell_next(g, cell, sub));
    return FLOE_OK;
}

static sub_cell sub_cell_of_key(const sub_grid *g, uint64_t key)
{
    sub_cell c = {{0, 0, 0}};
    uint64_t cell = key / (uint64_t)g->per_cell, sub = key % (uint64_t)g->per_cell;
    for (int k = 0; k < 3; k++) {
        const uint64_t n = (uint64_t)(k < g->spec->dim ? g->spec->n[k] : 1), per = (uint64_t)g->per[k];
        c.at[k] = (int)((cell % n) * per + sub % per);
        cell /= n;
        sub /= per;
    }
    return c;
}

/* The index of the sub-cell of that key, list.n if it holds nothing. */
static size_t seeding_find(const seeding *w, uint64_t key)
{
    size_t lo = 0, hi = w->list.n;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (w->key[middle] < key)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo < w->list.n && w->key[lo] == key ? lo : w->list.n;
}

/* The face neighbour with the largest share, if that is larger than the sub-cell's own (or equal and earlier, so that
 * chains of small volume fractions end); else the sub-cell itself. */
static size_t largest_neighbour(const seeding *w, const sub_grid *g, size_t i)
{
    const sub_cell c = sub_cell_of_key(g, w->key[i]);
    size_t best = i;
    for (int k = 0; k < g->spec->dim; k++) {
        for (int side = -1; side <= 1; side += 2) {
            sub_cell next = c;
            next.at[k] += side;
            if (next.at[k] < 0 || next.at[k] >= g->spec->n[k] * g->per[k]) continue;
            const size_t j = seeding_find(w, sub_cell_key(g, next));
            if (j == w->list.n) continue;
            if (w->share[j] > w->share[best] || (w->share[j] == w->share[best] && j < best)) best = j;
        }
    }
    return best;
}

/* Adds point i to point j: volume and first moments are kept. */
static void merge_points(seed_list *list, int dim, size_t j, size_t i)
{
    const double volume = list->volume[j] + list->volume[i];
    for (int k = 0; k < dim; k++) list->x[k][j] += (list->x[k][i] - list->x[k][j]) * (list->volume[i] / volume);
    list->volume[j] = volume;
}

static bool is_round_off(const seeding *w, const sub_grid *g, size_t i)
{
    double lo[3] = {0.0}, hi[3] = {0.0};
    sub_cell_box(g, sub_cell_of_key(g, w->key[i]), lo, hi);
    return w->list.volume[i] < least_share * sub_cell_volume(g, lo, hi);
}

/* Each sliver goes, neighbour by neighbour, to the first that is none, or to the largest of its group. */
static floe_status seeding_merge(seeding *w, context *ctx, const sub_grid *g)
{
    const int dim = g->spec->dim;
    const double merge = fmax(g->spec->merge, least_share);
    TRY(memory_new(ctx, &w->target, w->list.n, sizeof(size_t)));
    for (size_t i = 0; i < w->list.n; i++) w->target[i] = w->share[i] < merge ? largest_neighbour(w, g, i) : i;

    size_t kept = 0;
    for (size_t i = 0; i < w->list.n; i++) {
        size_t j = i;
        while (w->target[j] != j) j = w->target[j];
        if (j != i) merge_points(&w->list, dim, j, i);
    }
    for (size_t i = 0; i < w->list.n; i++) {
        if (w->target[i] != i || is_round_off(w, g, i)) continue;
        for (int k = 0; k < dim; k++) w->list.x[k][kept] = w->list.x[k][i];
        w->list.volume[kept++] = w->list.volume[i];
    }
    w->list.n = kept;
    return FLOE_OK;
}

/* The cell of each point by its place (the upper wall belongs to the last cell), the half widths, and arrays of just
 * the length needed. */
static floe_status seeding_finish(seeding *w, context *ctx, const sub_grid *g)
{
    const seed_spec *spec = g->spec;
    seed_list *list = &w->list;
    TRY(memory_resize(ctx, &list->volume, list->n, sizeof(double)));
    for (int k = 0; k < spec->dim; k++) {
        TRY(memory_resize(ctx, &list->x[k], list->n, sizeof(double)));
        TRY(memory_new(ctx, &list->half[k], list->n, sizeof(double)));
        TRY(memory_new(ctx, &list->cell[k], list->n, sizeof(int)));
        for (size_t i = 0; i < list->n; i++) {
            const double cell = floor((list->x[k][i] - spec->lower[k]) / spec->h[k]);
            list->cell[k][i] = (int)fmin(fmax(cell, 0.0), spec->n[k] - 1.0);
            list->half[k][i] = 0.5 * spec->h[k] / g->per[k];
        }
    }
    return FLOE_OK;
}

static floe_status seeding_run(seeding *w, context *ctx, const shape *s, const seed_spec *spec)
{
    const sub_grid g = sub_grid_make(s, spec);
    TRY(seeding_collect(w, ctx, s, &g));
    if (spec->method == SEED_FITTED) TRY(seeding_merge(w, ctx, &g));
    return seeding_finish(w, ctx, &g);
}

floe_status seed_shape(seed_list *out, context *ctx, const shape *s, const seed_spec *spec)
{
    seeding w = {0};
    const floe_status status = seeding_run(&w, ctx, s, spec);
    memory_free(ctx, &w.target);
    memory_free(ctx, &w.share);
    memory_free(ctx, &w.key);
    if (status != FLOE_OK) seed_list_free(ctx, &w.list);
    *out = w.list; /* empty after a failure */
    return status;
}

void seed_list_free(context *ctx, seed_list *list)
{
    for (int k = 0; k < 3; k++) {
        memory_free(ctx, &list->x[k]);
        memory_free(ctx, &list->half[k]);
        memory_free(ctx, &list->cell[k]);
    }
    memory_free(ctx, &list->volume);
    list->n = 0;
}

/* Seeding of bodies that supports hold in part: no point lies on both sides of the surface of a support, so that what bends and what is clamped have their exact
 * volumes (theory 4.13). In the cells that this surface cuts and beside them both parts are seeded apart; all others have the points of the whole body. */
#include "base/memory.h"
#include "geom/compound.h"
#include "mpm/nodes/support_points.h"
#include "mpm/state/seed_fill.h"

typedef struct seed_parts {
    seed_list whole, part[2];
    bool *cut; /* cells at the surface of a support, and those beside them, with which they may share a small part */
} seed_parts;

static size_t number_of_cell(const mesh *m, const int cell[MESH_MAX_DIM])
{
    return (size_t)cell[0] + (size_t)m->n[0] * ((size_t)cell[1] + (size_t)m->n[1] * (size_t)cell[2]);
}

static void mark_beside(const mesh *m, const int cell[MESH_MAX_DIM], bool *cut)
{
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = cell[a] > 0 ? cell[a] - 1 : 0;
        end[a] = cell[a] + 2 < m->n[a] ? cell[a] + 2 : m->n[a];
    }
    for (int k = lo[2]; k < end[2]; ++k)
        for (int j = lo[1]; j < end[1]; ++j)
            for (int i = lo[0]; i < end[0]; ++i) cut[number_of_cell(m, (const int[]){i, j, k})] = true;
}

static void mark_supported_cells(const mpm *s, bool *cut)
{
    const mesh *m = s->mesh;
    const int end[3] = {m->n[0], m->dim > 1 ? m->n[1] : 1, m->dim > 2 ? m->n[2] : 1};
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i)
                if (supports_cut(s, (const int[]){i, j, k})) mark_beside(m, (const int[]){i, j, k}, cut);
}

static floe_status reserve_list(context *ctx, int dim, size_t n, seed_list *list)
{
    TRY(memory_new(ctx, &list->volume, n, sizeof *list->volume));
    for (int a = 0; a < dim; ++a) {
        TRY(memory_new(ctx, &list->x[a], n, sizeof *list->x[a]));
        TRY(memory_new(ctx, &list->half[a], n, sizeof *list->half[a]));
        TRY(memory_new(ctx, &list->cell[a], n, sizeof *list->cell[a]));
    }
    return FLOE_OK;
}

/* The points of a list in the cells that are cut, or in the others. */
static void take_points(const mpm *s, const seed_parts *p, const seed_list *from, bool cut, seed_list *to)
{
    for (size_t n = 0; n < from->n; ++n) {
        if (p->cut[seed_cell_of(s->mesh, from, n)] != cut) continue;
        to->volume[to->n] = from->volume[n];
        for (int a = 0; a < s->mesh->dim; ++a) {
            to->x[a][to->n] = from->x[a][n];
            to->half[a][to->n] = from->half[a][n];
            to->cell[a][to->n] = from->cell[a][n];
        }
        to->n++;
    }
}

static floe_status join_parts(const mpm *s, seed_parts *p, seed_list *out)
{
    TRY(memory_new(s->ctx, &p->cut, mesh_cells(s->mesh), sizeof *p->cut));
    mark_supported_cells(s, p->cut);
    TRY(reserve_list(s->ctx, s->mesh->dim, p->whole.n + p->part[0].n + p->part[1].n, out));
    take_points(s, p, &p->whole, false, out);
    for (int k = 0; k < 2; ++k) take_points(s, p, &p->part[k], true, out);
    return FLOE_OK;
}

floe_status seed_supported(const mpm *s, int body, const seed_spec *spec, seed_list *out)
{
    const shape *whole = &s->scene->body[s->body[body].scene_body].shape;
    compound bending = {.whole = *whole}, clamped = {.whole = *whole, .n = 1};
    for (int k = 0; k < s->scene->n_supports; ++k) bending.less[bending.n++] = s->scene->support[k].region;
    clamped.less[0] = compound_shape(&bending);
    const shape outside = compound_shape(&bending), inside = compound_shape(&clamped);
    seed_parts p = {.cut = NULL};
    *out = (seed_list){0};
    floe_status status = seed_shape(&p.whole, s->ctx, whole, spec);
    if (status == FLOE_OK) status = seed_shape(&p.part[0], s->ctx, &outside, spec);
    if (status == FLOE_OK) status = seed_shape(&p.part[1], s->ctx, &inside, spec);
    if (status == FLOE_OK) status = join_parts(s, &p, out);
    memory_free(s->ctx, &p.cut);
    seed_list_free(s->ctx, &p.whole);
    for (int k = 0; k < 2; ++k) seed_list_free(s->ctx, &p.part[k]);
    return status;
}

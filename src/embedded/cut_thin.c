/* Finds solids that are thinner than a cell, with gas on both sides in the same cell. */
#include "embedded/cut_internal.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void middle_of(const cut_surface *c, const cut_piece *q, double x[3])
{
    for (int a = 0; a < c->mesh->dim; ++a) x[a] = cut_at_middle(c, q, a);
}

/* Pieces of neighbouring sides meet at a corner, however sharp. */
static bool is_near_along(const cut_piece *q, const cut_piece *r)
{
    return abs(q->vertex[0] - r->vertex[0]) <= 2 || q->vertex[0] == r->vertex[1] || q->vertex[1] == r->vertex[0];
}

static double dot_along(const double a[3], const double b[3], int dim)
{
    double sum = 0.0;
    for (int k = 0; k < dim; ++k) sum += a[k] * b[k];
    return sum;
}

/* Each lies on the outer side of the other. */
static bool are_back_to_back(const cut_surface *c, const cut_piece *q, const cut_piece *r)
{
    const int dim = c->mesh->dim;
    double from[3], to[3], between[3];
    if (c->vertex[q->vertex[0]].body != c->vertex[r->vertex[0]].body) return false;
    middle_of(c, q, from);
    middle_of(c, r, to);
    for (int a = 0; a < dim; ++a) between[a] = to[a] - from[a];
    const double size_q = sqrt(dot_along(q->area, q->area, dim)), size_r = sqrt(dot_along(r->area, r->area, dim)),
                 least = 1e-6 * c->mesh->h[0];
    return dot_along(q->area, r->area, dim) < -0.1 * size_q * size_r &&
           dot_along(between, q->area, dim) > least * size_q && dot_along(between, r->area, dim) < -least * size_r;
}

/* Of points: a solid between two, wherever they are in their cells, for it may move. */
static bool is_thin_on_line(const cut_surface *c, const cut_chain *lower, const cut_chain *upper)
{
    const double thickness = c->vertex[upper->first].x[0] - c->vertex[lower->first].x[0];
    const double h =
        c->mesh->h[0]; /* of bodies in touch the one's upper may lie beyond the other's lower by round-off */
    return lower->outward > 0 && upper->outward < 0 && thickness > 1e-6 * h && thickness < (1.0 - 1e-9) * h;
}

static bool find_thin_on_line(const cut_surface *c, double x[3])
{
    for (int n = 0; n < c->n_chains; ++n)
        for (int k = 0; k < c->n_chains; ++k) {
            if (!is_thin_on_line(c, &c->chain[n], &c->chain[k])) continue;
            memcpy(x, c->vertex[c->chain[n].first].x, 3 * sizeof *x);
            return true;
        }
    return false;
}

/* A piece with the direction that its segment has, of which it may have given a part away (cut_shade.c). */
static cut_piece along_segment(const cut_surface *c, const cut_piece *q)
{
    const double *from = c->vertex[q->vertex[0]].x, *to = c->vertex[q->vertex[1]].x;
    cut_piece whole = *q;
    double along[2];
    for (int a = 0; a < 2; ++a) along[a] = to[a] + mesh_to_image(c->mesh, a, to[a], from[a]) - from[a];
    whole.area[0] = along[1];
    whole.area[1] = -along[0];
    return whole;
}

static bool find_thin_in_plane(const cut_surface *c, double x[3])
{
    for (int n = 0; n < c->n_pieces; ++n)
        for (int k = n + 1; k < c->n_pieces; ++k) {
            const cut_piece *q = &c->piece[n], *r = &c->piece[k];
            if (q->cell != r->cell || q->through > 0 || r->through > 0 || is_near_along(q, r)) continue;
            const cut_piece own = along_segment(c, q), other = along_segment(c, r);
            if (!are_back_to_back(c, &own, &other)) continue;
            middle_of(c, q, x);
            return true;
        }
    return false;
}

/* ---- in space ---- */

/* Pieces cell by cell, and the patches of pieces that are connected through vertices within a cell. */
typedef struct patches {
    const cut_surface *c;
    int *first; /* of each cell: its first piece, in `piece`; one more at the end; owned */
    int *piece; /* owned */
    int *patch; /* of each piece, in the same order: the lowest of its patch; owned */
} patches;

static bool share_vertex(const cut_piece *q, const cut_piece *r)
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (q->vertex[i] == r->vertex[k]) return true;
    return false;
}

static int root_of(const int *up, int k)
{
    while (up[k] != k) k = up[k];
    return k;
}

static void sort_by_cell(patches *p)
{
    const cut_surface *c = p->c;
    for (int k = 0; k < c->n_pieces; ++k) p->first[c->piece[k].cell + 1]++;
    for (int k = 0; k < c->n_cells; ++k) p->first[k + 1] += p->first[k];
    for (int k = 0; k < c->n_pieces; ++k) p->piece[p->first[c->piece[k].cell]++] = k;
    for (int k = c->n_cells; k > 0; --k) p->first[k] = p->first[k - 1];
    p->first[0] = 0;
}

static void join_patches(patches *p, int cell)
{
    const cut_piece *piece = p->c->piece;
    for (int i = p->first[cell]; i < p->first[cell + 1]; ++i) {
        p->patch[i] = i;
        for (int k = p->first[cell]; k < i; ++k) {
            if (!share_vertex(&piece[p->piece[i]], &piece[p->piece[k]])) continue;
            const int a = root_of(p->patch, i), b = root_of(p->patch, k);
            p->patch[a > b ? a : b] = a < b ? a : b;
        }
    }
}

static bool find_thin_in_cell(const patches *p, int cell, double x[3])
{
    for (int i = p->first[cell]; i < p->first[cell + 1]; ++i)
        for (int k = p->first[cell]; k < i; ++k) {
            const cut_piece *q = &p->c->piece[p->piece[i]], *r = &p->c->piece[p->piece[k]];
            if (root_of(p->patch, i) == root_of(p->patch, k) || !are_back_to_back(p->c, q, r)) continue;
            middle_of(p->c, q, x);
            return true;
        }
    return false;
}

static floe_status find_thin_in_space(const cut_surface *c, bool *thin, double x[3])
{
    patches p = {.c = c};
    floe_status status = memory_new(c->ctx, &p.first, (size_t)c->n_cells + 2, sizeof *p.first);
    if (status == FLOE_OK) status = memory_new(c->ctx, &p.piece, (size_t)c->n_pieces + 1, sizeof *p.piece);
    if (status == FLOE_OK) status = memory_new(c->ctx, &p.patch, (size_t)c->n_pieces + 1, sizeof *p.patch);
    if (status == FLOE_OK) sort_by_cell(&p);
    for (int k = 0; k < c->n_cells && status == FLOE_OK && !*thin; ++k) {
        join_patches(&p, k);
        *thin = find_thin_in_cell(&p, k, x);
    }
    memory_free(c->ctx, &p.first);
    memory_free(c->ctx, &p.piece);
    memory_free(c->ctx, &p.patch);
    return status;
}

floe_status cut_find_thin(const cut_surface *c, bool *thin, double x[3])
{
    *thin = false;
    if (c->mesh->dim == 3) return find_thin_in_space(c, thin, x);
    *thin = c->mesh->dim == 1 ? find_thin_on_line(c, x) : find_thin_in_plane(c, x);
    return FLOE_OK;
}

/* Faces in the shade of a solid's corner (theory 7.2). Within a cell that a corner cuts, fluid lies along one side of the body and behind its end, and the cell
 * has one state for both. A piece a short way behind a face then has the pressure and the shear of a place around the corner, and fluid passes the face where the
 * piece leaves it no room. So a piece is shared with the cell in front of it: of its area the part
 *
 *     lambda = t (1 - d),    d: its distance from the face, in cells;    t: 0 where the surface turns by 30 degrees, 1 from 60 on
 *
 * belongs there, and as much of the face is closed: the areas of both cells still sum to zero. What of its own cell the piece sweeps passes the closed part of
 * the face (cut_piece.through). In the plane. */
#include "embedded/cut_internal.h"

#include "base/memory.h"

#include <math.h>

/* Cosines of 30 and 60 degrees. */
static const double hardly_turned = 0.8660254037844387, sharp = 0.5;
/* A cell that is open by less is merged with a neighbour, whose pieces its own are. */
static const double small_cell = 0.5;
/* Neighbours that differ by less are alike, and the first is taken. */
static const double alike = 1e-3;

/* Pieces by their cells, as lists, their sizes, and what of each goes through the lower and upper face along each axis. */
typedef struct shade {
    int *first, *next;
    double *size, (*part)[4];
} shade;

/* How sharp a corner of the solid a piece belongs to, from 0 to 1, by the pieces of its cell: each of the two lies behind the plane of the other. */
static double corner_at(const cut_surface *c, const shade *s, int piece)
{
    const cut_piece *q = &c->piece[piece];
    double cosine = 1.0;
    for (int n = s->first[q->cell]; n >= 0; n = s->next[n]) {
        const double *other = c->piece[n].area, sizes = s->size[piece] * s->size[n];
        const double product = q->area[0] * other[0] + q->area[1] * other[1];
        if (!(product < hardly_turned * sizes)) continue; /* as most are, on smooth surfaces */
        double behind = 0.0, ahead = 0.0;
        for (int a = 0; a < 2; ++a) {
            const double way = cut_at_middle(c, &c->piece[n], a) - cut_at_middle(c, q, a);
            behind += way * q->area[a];
            ahead += way * other[a];
        }
        if (behind > 0.0 && ahead < 0.0 && sizes > 0.0) cosine = fmin(cosine, product / sizes);
    }
    return fmin(1.0, fmax(0.0, (hardly_turned - cosine) / (hardly_turned - sharp)));
}

/* The cell behind face f; false: none. */
static bool behind_face(const cut_surface *c, const cut_cell *k, int f, int cell[3])
{
    for (int a = 0; a < 3; ++a) cell[a] = k->cell[a];
    return mesh_step(c->mesh, cell, f / 2, f % 2 == SIDE_UPPER ? 1 : -1);
}

/* The face through which a small cell is merged; -1: it is not. */
static int way_out(const cut_surface *c, const cut_cell *k)
{
    double best = 0.0;
    int out = -1, cell[3];
    for (int f = 0; f < 4 && k->open < small_cell; ++f) {
        if (!behind_face(c, k, f, cell)) continue;
        const int at = c->at[cut_index(c->mesh, cell)];
        const double score = (at >= 0 ? c->cell[at].open : 1.0) * k->face[f / 2][f % 2];
        if (!(score > (1.0 + alike) * best)) continue;
        best = score;
        out = f;
    }
    return out;
}

static void find_parts(const cut_surface *c, shade *s, int piece)
{
    const cut_piece *q = &c->piece[piece];
    const cut_cell *k = &c->cell[q->cell];
    if (k->overlap || !(k->open > 0.0)) return;
    /* Beneath bodies that leave a side of the mesh films open, with the gas of their cells. */
    for (int a = 0; a < 2; ++a)
        if (!c->mesh->periodic[a] && (k->cell[a] == 0 || k->cell[a] == c->mesh->n[a] - 1)) return;
    const double corner = corner_at(c, s, piece);
    const int way = corner > 0.0 ? way_out(c, k) : -1;
    for (int f = 0; f < 4 && corner > 0.0; ++f) {
        const int a = f / 2, node = k->cell[a] + (f % 2 == SIDE_UPPER);
        const double facing = f % 2 == SIDE_UPPER ? -q->area[a] : q->area[a];
        if (f == way || !(facing > 0.0)) continue;
        const double away = fabs(cut_at_middle(c, q, a) - mesh_node(c->mesh, a, node)) / c->mesh->h[a];
        s->part[piece][f] = corner * fmax(0.0, 1.0 - away);
    }
}

static double face_size(const cut_surface *c, const cut_cell *k, int f)
{
    return mesh_face_area(c->mesh, f / 2, k->cell[0] + (f == SIDE_UPPER));
}

/* Gives the cell behind face f a part of a piece's area along the axis, as far as the face is open. */
static floe_status hand_over(cut_surface *c, int piece, int f, double part, cut_finisher *finish)
{
    const int axis = f / 2, side = f % 2, own = c->piece[piece].cell;
    int at;
    TRY(cut_reach_behind(c, own, f, finish, &at));
    if (at < 0) return FLOE_OK;
    const double size = face_size(c, &c->cell[own], f), area = c->piece[piece].area[axis];
    const double open = fmin(c->cell[own].face[axis][side], c->cell[at].face[axis][1 - side]);
    const double share = fmin(part * fabs(area) / size, open);
    if (!(share > 0.0)) return FLOE_OK;
    cut_close_share(c, &c->cell[own], f, share);
    cut_close_share(c, &c->cell[at], f ^ 1, share);
    cut_piece given = c->piece[piece];
    for (int a = 0; a < 3; ++a) given.area[a] = 0.0;
    given.area[axis] = copysign(share * size, area);
    given.through = 1 + 2 * axis + (1 - side);
    c->piece[piece].area[axis] -= given.area[axis];
    return cut_add_piece(c, c->cell[at].cell, &given, &(cut_part){0});
}

static floe_status share_pieces(cut_surface *c, shade *s, int cells, int pieces, cut_finisher *finish)
{
    TRY(memory_new(c->ctx, &s->first, (size_t)cells, sizeof *s->first));
    TRY(memory_new(c->ctx, &s->next, (size_t)pieces, sizeof *s->next));
    TRY(memory_new(c->ctx, &s->size, (size_t)pieces, sizeof *s->size));
    TRY(memory_new(c->ctx, &s->part, (size_t)pieces, sizeof *s->part));
    for (int k = 0; k < cells; ++k) s->first[k] = -1;
    for (int n = 0; n < pieces; ++n) {
        s->next[n] = s->first[c->piece[n].cell];
        s->first[c->piece[n].cell] = n;
        s->size[n] = hypot(c->piece[n].area[0], c->piece[n].area[1]);
    }
    for (int n = 0; n < pieces; ++n) find_parts(c, s, n);
    for (int n = 0; n < pieces; ++n)
        for (int f = 0; f < 4; ++f)
            if (s->part[n][f] > 0.0) TRY(hand_over(c, n, f, s->part[n][f], finish));
    return FLOE_OK;
}

floe_status cut_shade_corners(cut_surface *c, cut_finisher *finish)
{
    shade s = {NULL, NULL, NULL, NULL};
    if (c->n_pieces == 0) return FLOE_OK;
    const floe_status status = share_pieces(c, &s, c->n_cells, c->n_pieces, finish);
    memory_free(c->ctx, &s.first);
    memory_free(c->ctx, &s.next);
    memory_free(c->ctx, &s.size);
    memory_free(c->ctx, &s.part);
    return status;
}

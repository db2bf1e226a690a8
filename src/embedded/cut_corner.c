/* Corners of solids at nodes of the mesh (theory 7.2). A surface that lies on faces of the mesh belongs to the cells of one side of them, which may be those
 * that the solid fills. Such a cell has no volume, and open faces behind its pieces. Around a corner it has two, to different neighbours, and fluid would
 * pass from one to the other through it. There each piece goes to the cell in front of it, and the face between them is closed. The same where a body ends
 * within such a cell: it would have the pressure behind the body's end, half way along the side, and let fluid in where the body lies on its face. */
#include "embedded/cut_internal.h"

#include "base/memory.h"

#include <math.h>

/* Of a cell: how far from its side a piece on the side may be. */
static const double on_side = 1e-9;
/* A cell that is open by less is one that the solid fills and that its surface is about to enter or to leave: it stays as it is. */
static const double hardly_open = 1e-3;

static bool is_corner(const cut_surface *c, const cut_cell *k)
{
    int n = 0;
    for (int f = 0; f < 2 * c->mesh->dim; ++f) n += k->face[f / 2][f % 2] > 0.0;
    return !k->overlap && (k->open > hardly_open ? n > 0 : k->open == 0.0 && n > 1);
}

/* The face of its cell in which a piece lies, and the share of it that it covers; false: in none. */
static bool face_of(const cut_surface *c, const cut_piece *q, const cut_cell *k, int *axis, int *side, double *share)
{
    const mesh *m = c->mesh;
    for (int f = 0; f < 2 * m->dim; ++f) {
        const int a = f / 2, node = k->cell[a] + (f % 2 == SIDE_UPPER);
        const double size = mesh_face_area(m, a, k->cell[0] + (a == 0 && f % 2 == SIDE_UPPER));
        const double out = f % 2 == SIDE_UPPER ? 1.0 : -1.0,
                     across = -out * q->area[a]; /* out of the gas: into the cell */
        if (!(fabs(cut_at_middle(c, q, a) - mesh_node(m, a, node)) < on_side * m->h[a])) continue;
        if (!(across > 0.0) || !(k->face[a][f % 2] > 0.0) || !(size > 0.0)) continue;
        *axis = a;
        *side = f % 2;
        *share = across / size;
        return true;
    }
    return false;
}

floe_status cut_reach_behind(cut_surface *c, int cell, int face, cut_finisher *finish, int *at)
{
    const cut_cell *k = &c->cell[cell];
    int behind[3] = {k->cell[0], k->cell[1], k->cell[2]};
    *at = -1;
    if (!mesh_step(c->mesh, behind, face / 2, face % 2 == SIDE_UPPER ? 1 : -1)) return FLOE_OK;
    const bool is_new = c->at[cut_index(c->mesh, behind)] == CUT_NEW;
    TRY(cut_touch(c, behind, at));
    return is_new ? finish(c, &c->cell[*at]) : FLOE_OK;
}

void cut_close_share(const cut_surface *c, cut_cell *k, int face, double share)
{
    double *open = &k->face[face / 2][face % 2];
    cut_shares found = {.sound = true};
    *open = cut_snapped_face(c, *open - share, &found);
}

static floe_status free_piece(cut_surface *c, int piece, cut_finisher *finish)
{
    const cut_cell *k = &c->cell[c->piece[piece].cell];
    int axis, side, at;
    double share;
    if (!face_of(c, &c->piece[piece], k, &axis, &side, &share)) return FLOE_OK;
    if (k->open > 0.0 && !(share > hardly_open)) return FLOE_OK; /* round-off of a line that touches the side */
    const int face = 2 * axis + side;
    TRY(cut_reach_behind(c, c->piece[piece].cell, face, finish, &at));
    if (at < 0) return FLOE_OK;
    cut_close_share(c, &c->cell[c->piece[piece].cell], face, share);
    cut_close_share(c, &c->cell[at], face ^ 1, share);
    c->piece[piece].cell = at;
    return FLOE_OK;
}

floe_status cut_free_corners(cut_surface *c, cut_finisher *finish)
{
    const int cells = c->n_cells;
    bool *corner = NULL;
    int found = 0;
    for (int k = 0; k < cells && found == 0; ++k) found += is_corner(c, &c->cell[k]);
    if (found == 0) return FLOE_OK;
    TRY(memory_new(c->ctx, &corner, (size_t)cells, sizeof *corner));
    for (int k = 0; k < cells; ++k) corner[k] = is_corner(c, &c->cell[k]);
    floe_status status = FLOE_OK;
    for (int n = 0; n < c->n_pieces && status == FLOE_OK; ++n)
        if (c->piece[n].cell < cells && corner[c->piece[n].cell]) status = free_piece(c, n, finish);
    memory_free(c->ctx, &corner);
    return status;
}

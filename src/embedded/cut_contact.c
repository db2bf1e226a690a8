/* Cells in which solids overlap or touch (theory 7.2). In contact they overlap by round-off and because surfaces are straight between vertices. The open area
 * of a face, or the open volume, is then negative and is set to zero. The remaining areas do not close; the pieces close them, each in proportion to the part
 * of its area that gas can reach:
 *
 *     A_i' = A_i - D max(A_i . D, 0) / sum_j max(A_j . D, 0),    D = sum of the areas of open faces and pieces
 */
#include "embedded/cut_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Of one cell: what its areas leave open, and the pieces that face it. */
typedef struct defect {
    double area[3], facing;
} defect;

static double common_area(const defect *d, const cut_piece *q)
{
    return fmax(q->area[0] * d->area[0] + q->area[1] * d->area[1] + q->area[2] * d->area[2], 0.0);
}

/* A cell that solids more than fill needs no side of the mesh. */
static void close_sides(const cut_surface *c, cut_cell *k)
{
    for (int a = 0; a < c->mesh->dim && k->open == 0.0; ++a) {
        if (c->mesh->periodic[a]) continue;
        if (k->cell[a] == 0) k->face[a][SIDE_LOWER] = 0.0;
        if (k->cell[a] == c->mesh->n[a] - 1) k->face[a][SIDE_UPPER] = 0.0;
    }
}

static void add_open_faces(const cut_surface *c, const cut_cell *k, defect *d)
{
    const mesh *m = c->mesh;
    for (int a = 0; a < m->dim; ++a)
        d->area[a] += k->face[a][SIDE_UPPER] * mesh_face_area(m, a, k->cell[0] + (a == 0)) -
                      k->face[a][SIDE_LOWER] * mesh_face_area(m, a, k->cell[0]);
    if (m->geometry == MESH_AXISYMMETRIC) /* of a ring the radial areas sum to that of its section */
        d->area[0] -= k->open * mesh_cell_volume(m, k->cell[0]) / mesh_centre(m, 0, k->cell[0]);
}

static void close_cells(cut_surface *c, defect *of)
{
    for (int k = 0; k < c->n_cells; ++k) {
        if (!c->cell[k].overlap) continue;
        close_sides(c, &c->cell[k]);
        add_open_faces(c, &c->cell[k], &of[k]);
    }
    for (int n = 0; n < c->n_pieces; ++n)
        for (int a = 0; a < 3; ++a) of[c->piece[n].cell].area[a] += c->piece[n].area[a];
    for (int n = 0; n < c->n_pieces; ++n)
        of[c->piece[n].cell].facing += common_area(&of[c->piece[n].cell], &c->piece[n]);
    for (int n = 0; n < c->n_pieces; ++n) {
        cut_piece *q = &c->piece[n];
        const defect *d = &of[q->cell];
        if (!c->cell[q->cell].overlap || !(d->facing > 0.0)) continue;
        const double share = common_area(d, q) / d->facing;
        for (int a = 0; a < c->mesh->dim; ++a) q->area[a] -= share * d->area[a];
    }
}

floe_status cut_close_contacts(cut_surface *c)
{
    defect *of = NULL;
    bool any = false;
    for (int k = 0; k < c->n_cells && !any; ++k) any = c->cell[k].overlap;
    if (!any) return FLOE_OK;
    TRY(memory_new(c->ctx, &of, (size_t)c->n_cells, sizeof *of));
    close_cells(c, of);
    memory_free(c->ctx, &of);
    return FLOE_OK;
}

/* Embedded boundaries in one dimension: points on a line. */
#include "embedded/cut_internal.h"

#include <math.h>

/* Of a cell: a point this near to a node lies on it, and bounds the cell on the side of its gas, whole. */
static const double on_node = 1e-11;

/* Place of a point in a cell (m), right of its lower side. */
static double place_in(const mesh *m, int cell, double x)
{
    const double offset = x - mesh_node(m, 0, cell);
    return fabs(offset) < on_node * m->h[0] ? 0.0 : fabs(offset - m->h[0]) < on_node * m->h[0] ? m->h[0] : offset;
}

floe_status cut_point(cut_surface *c, const cut_chain *chain)
{
    const mesh *m = c->mesh;
    const double x = c->vertex[chain->first].x[0];
    if (chain->outward == 0) return FLOE_OK;
    int cell[3] = {mesh_cell_of(m, 0, x), 0, 0}, at;
    const double offset = place_in(m, cell[0], x);
    if (chain->outward > 0 && offset == 0.0) cell[0]--;
    if (chain->outward < 0 && offset == m->h[0]) cell[0]++;
    cell[0] = cell[0] < 0 ? 0 : cell[0] >= m->n[0] ? m->n[0] - 1 : cell[0];
    TRY(cut_touch(c, cell, &at));
    c->cell[at].jump[0][0] += chain->outward;
    const double left = place_in(m, cell[0], x);
    const cut_piece piece = {.vertex = {chain->first, chain->first}, .weight = {1.0}, .area = {chain->outward, 0.0}};
    const cut_part part = {chain->outward * left, {chain->outward * 0.5 * left * (left - m->h[0])}};
    return cut_add_piece(c, cell, &piece, &part);
}

floe_status cut_join_points(cut_surface *c)
{
    for (int n = 0; n < c->n_pieces; ++n) {
        cut_piece *q = &c->piece[n];
        const int next[3] = {c->cell[q->cell].cell[0] + 1, 0, 0};
        const double x = c->vertex[q->vertex[0]].x[0];
        int at;
        if (q->area[0] < 0.0 || c->node[next[0]] >= 0 || next[0] == c->mesh->n[0]) continue;
        c->cell[q->cell].open -= place_in(c->mesh, next[0] - 1, x);
        TRY(cut_touch(c, next, &at));
        c->cell[at].open += place_in(c->mesh, next[0], x);
        c->node[next[0]]++;
        q->cell = at;
    }
    return FLOE_OK;
}

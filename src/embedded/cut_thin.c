/* Places where gas lies on two sides of something thinner than a cell. */
#include "embedded/cut_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void middle_of(const cut_surface *c, const cut_piece *q, double x[2])
{
    for (int a = 0; a < 2; ++a)
        x[a] = (1.0 - q->share) * c->vertex[q->vertex[0]].x[a] + q->share * c->vertex[q->vertex[1]].x[a];
}

/* Pieces of neighbouring sides meet at a corner, however sharp. */
static bool is_near_along(const cut_piece *q, const cut_piece *r)
{
    return abs(q->vertex[0] - r->vertex[0]) <= 2 || q->vertex[0] == r->vertex[1] || q->vertex[1] == r->vertex[0];
}

/* Each lies on the outer side of the other. */
static bool are_back_to_back(const cut_surface *c, const cut_piece *q, const cut_piece *r)
{
    double from[2], to[2];
    middle_of(c, q, from);
    middle_of(c, r, to);
    const double way[2] = {to[0] - from[0], to[1] - from[1]}, least = 1e-6 * c->mesh->h[0];
    const double length_q = hypot(q->area[0], q->area[1]), length_r = hypot(r->area[0], r->area[1]);
    return q->area[0] * r->area[0] + q->area[1] * r->area[1] < -0.1 * length_q * length_r &&
           way[0] * q->area[0] + way[1] * q->area[1] > least * length_q &&
           way[0] * r->area[0] + way[1] * r->area[1] < -least * length_r;
}

/* Of points: a solid between two, wherever they are in their cells, for it may move. */
static bool is_thin_on_line(const cut_surface *c, const cut_chain *lower, const cut_chain *upper)
{
    const double thickness = c->vertex[upper->first].x[0] - c->vertex[lower->first].x[0];
    const double h =
        c->mesh->h[0]; /* of bodies in touch the one's upper may lie beyond the other's lower by round-off */
    return lower->outward > 0 && upper->outward < 0 && thickness > 1e-6 * h && thickness < (1.0 - 1e-9) * h;
}

static bool find_thin_on_line(const cut_surface *c, double x[2])
{
    for (int n = 0; n < c->n_chains; ++n)
        for (int k = 0; k < c->n_chains; ++k) {
            if (!is_thin_on_line(c, &c->chain[n], &c->chain[k])) continue;
            memcpy(x, c->vertex[c->chain[n].first].x, 2 * sizeof *x);
            return true;
        }
    return false;
}

bool cut_is_thin(const cut_surface *c, double x[2])
{
    if (c->mesh->dim == 1) return find_thin_on_line(c, x);
    for (int n = 0; n < c->n_pieces; ++n)
        for (int k = n + 1; k < c->n_pieces; ++k) {
            const cut_piece *q = &c->piece[n], *r = &c->piece[k];
            if (q->cell != r->cell || is_near_along(q, r) || !are_back_to_back(c, q, r)) continue;
            middle_of(c, q, x);
            return true;
        }
    return false;
}

#include "mpm/surface/standing.h"

#include "scene/scene_reach.h"

#include <math.h>

/* Of a cell: so thin a gap has the state of the gas at its end (theory 7.2), and its volume is nothing. */
static const double hairs_breadth = 1e-6;

shape standing_shape(const scene *s, const mesh *m, const scene_body *body, const shape *whole, inset *part)
{
    bool leaves = false;
    *part = (inset){.whole = *whole};
    for (int a = 0; a < 3; ++a) {
        part->lower[a] = -INFINITY;
        part->upper[a] = INFINITY;
        if (a >= m->dim) continue;
        if (scene_can_leave_side(s, body, a, SIDE_LOWER)) part->lower[a] = m->lower[a] + hairs_breadth * m->h[a];
        if (scene_can_leave_side(s, body, a, SIDE_UPPER)) part->upper[a] = m->upper[a] - hairs_breadth * m->h[a];
        leaves = leaves || isfinite(part->lower[a]) || isfinite(part->upper[a]);
    }
    return leaves ? inset_shape(part) : *whole;
}

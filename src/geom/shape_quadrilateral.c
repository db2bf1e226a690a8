/* A quadrilateral, convex or not: the regions of York's decks. In (r, z) a ring of that section. */
#include "geom/shape.h"

#include <math.h>

enum { CORNERS = 4 };

typedef struct quadrilateral_par {
    double corner[CORNERS][3]; /* m */
} quadrilateral_par;

#define CORNER(name, number)                                                                      \
    {                                                                                             \
        .key = name, .unit = "m", .range = PARAM_ANY, .fallback = NAN,                            \
        .offset = offsetof(quadrilateral_par, corner) + (number)*3 * sizeof(double), .count = -3, \
        .doc = "a corner; in order around it"                                                     \
    }

static const param_spec quadrilateral_params[] = {CORNER("a", 0), CORNER("b", 1), CORNER("c", 2), CORNER("d", 3)};

/* Square of the distance of x from the line between two corners, and whether the line crosses the ray from x along the
 * first axis. */
static double edge_distance(const double *a, const double *b, const double *x, bool *crosses)
{
    const double along[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {x[0] - a[0], x[1] - a[1]};
    const double square = along[0] * along[0] + along[1] * along[1];
    const double share = square > 0.0 ? (along[0] * from[0] + along[1] * from[1]) / square : 0.0;
    const double clamped = fmin(fmax(share, 0.0), 1.0);
    const double gap[2] = {from[0] - clamped * along[0], from[1] - clamped * along[1]};
    *crosses = (a[1] > x[1]) != (b[1] > x[1]) && from[0] < along[0] * from[1] / along[1];
    return gap[0] * gap[0] + gap[1] * gap[1];
}

static double quadrilateral_level(const void *par, int dim, const double x[3])
{
    const quadrilateral_par *q = par;
    double nearest = INFINITY;
    bool inside = false;
    (void)dim;
    for (int k = 0; k < CORNERS; k++) {
        bool crosses;
        nearest = fmin(nearest, edge_distance(q->corner[k], q->corner[(k + 1) % CORNERS], x, &crosses));
        inside = inside != crosses;
    }
    return inside ? -sqrt(nearest) : sqrt(nearest);
}

static bool quadrilateral_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const quadrilateral_par *q = par;
    for (int a = 0; a < dim; a++) {
        lo[a] = a < 2 ? INFINITY : -INFINITY;
        hi[a] = -lo[a];
        for (int k = 0; a < 2 && k < CORNERS; k++) {
            lo[a] = fmin(lo[a], q->corner[k][a]);
            hi[a] = fmax(hi[a], q->corner[k][a]);
        }
    }
    return true;
}

static double turn_of_corner(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Whether the lines from a to b and from c to d cross. */
static bool lines_cross(const double *a, const double *b, const double *c, const double *d)
{
    return turn_of_corner(a, b, c) * turn_of_corner(a, b, d) < 0.0 &&
           turn_of_corner(c, d, a) * turn_of_corner(c, d, b) < 0.0;
}

static const char *quadrilateral_check(const void *par, int dim)
{
    const quadrilateral_par *q = par;
    const double(*p)[3] = q->corner;
    (void)dim;
    if (lines_cross(p[0], p[1], p[2], p[3]) || lines_cross(p[1], p[2], p[3], p[0]))
        return "its sides cross: give the corners in order around it";
    if (!(fabs(turn_of_corner(p[0], p[1], p[2]) + turn_of_corner(p[0], p[2], p[3])) > 0.0)) return "it has no area";
    return NULL;
}

const shape_model shape_quadrilateral = {
    .name = "quadrilateral",
    .doc = "quadrilateral, corners in order around it; two corners may be one",
    .param_size = sizeof(quadrilateral_par),
    .params = quadrilateral_params,
    .n_params = sizeof quadrilateral_params / sizeof *quadrilateral_params,
    .min_dim = 2,
    .max_dim = 2,
    .instead_below = "it is of the plane; in one dimension take `box`",
    .instead_above = "it is of the plane; in space take `extruded: {of: {quadrilateral: ...}}` or `revolved`",
    .level = quadrilateral_level,
    .bounds = quadrilateral_bounds,
    .check = quadrilateral_check,
};

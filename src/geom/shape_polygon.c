/* A simple polygon, convex or not. In (r, z) a ring of that section. */
#include "geom/shape.h"

#include <math.h>
#include <stdio.h>

typedef struct polygon_par {
    param_list vertices; /* double[3], m */
} polygon_par;

static const param_spec polygon_params[] = {
    PAR_POINTS(polygon_par, vertices, "m", 3,
               "its corners in order around it, either way; the last is joined to the first"),
};

typedef double position[3];

static const position *vertices_of(const polygon_par *p)
{
    return p->vertices.item;
}

/* Square of the distance of x from the side from a to b, and whether the side crosses the ray from x along the first
 * axis. */
static double side_distance(const double *a, const double *b, const double *x, bool *crosses)
{
    const double along[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {x[0] - a[0], x[1] - a[1]};
    const double square = along[0] * along[0] + along[1] * along[1];
    const double share = fmin(fmax((along[0] * from[0] + along[1] * from[1]) / square, 0.0), 1.0);
    const double gap[2] = {from[0] - share * along[0], from[1] - share * along[1]};
    *crosses = (a[1] > x[1]) != (b[1] > x[1]) && from[0] < along[0] * from[1] / along[1];
    return gap[0] * gap[0] + gap[1] * gap[1];
}

static double polygon_level(const void *par, int dim, const double x[3])
{
    const polygon_par *p = par;
    const position *v = vertices_of(p);
    double nearest = HUGE_VAL;
    bool inside = false;
    (void)dim;
    for (size_t k = 0, last = p->vertices.n - 1; k < p->vertices.n; last = k++) {
        bool crosses;
        nearest = fmin(nearest, side_distance(v[last], v[k], x, &crosses));
        inside = inside != crosses;
    }
    return inside ? -sqrt(nearest) : sqrt(nearest);
}

static bool polygon_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const polygon_par *p = par;
    const position *v = vertices_of(p);
    for (int a = 0; a < dim; a++) {
        lo[a] = hi[a] = v[0][a];
        for (size_t k = 1; k < p->vertices.n; k++) {
            lo[a] = fmin(lo[a], v[k][a]);
            hi[a] = fmax(hi[a], v[k][a]);
        }
    }
    return true;
}

/* ---- moments ---- */

typedef struct strip {
    const double *lo, *hi; /* of the box */
    bool weight_by_radius;
    shape_moments *sum;
} strip;

/* Between two heights of a side, along which x lies on one side of both ends of the box or between them: all to the left
 * of it. The integrands are cubic at most, and two Gauss points exact. */
static void add_trapezoid(const strip *s, const double *a, const double *b)
{
    for (int g = -1; g <= 1; g += 2) {
        const double share = 0.5 + g * 0.28867513459481287, y = a[1] + share * (b[1] - a[1]);
        const double x = fmin(fmax(a[0] + share * (b[0] - a[0]), s->lo[0]), s->hi[0]), dy = 0.5 * (b[1] - a[1]);
        const double width = x - s->lo[0], middle = 0.5 * (x + s->lo[0]);
        const double square = middle * middle + width * width / 12.0; /* mean of x^2 */
        const double volume = dy * width * (s->weight_by_radius ? middle : 1.0);
        s->sum->volume += volume;
        s->sum->first[0] += dy * width * (s->weight_by_radius ? square : middle);
        s->sum->first[1] += volume * y;
    }
}

/* Where the side from a to b has x = at, if that is between its ends. */
static bool find_share(const double *a, const double *b, int axis, double at, double *share)
{
    if ((a[axis] < at) == (b[axis] < at)) return false;
    *share = (at - a[axis]) / (b[axis] - a[axis]);
    return *share > 0.0 && *share < 1.0;
}

/* A side cut at the box's ends: the part within its heights, in pieces at its ends along the first axis. */
static void add_side(const strip *s, const double *a, const double *b)
{
    double cut[6] = {0.0, 1.0}, share;
    int n = 2;
    for (int axis = 0; axis < 2; axis++)
        for (int end = 0; end < 2; end++)
            if (find_share(a, b, axis, end ? s->hi[axis] : s->lo[axis], &share)) cut[n++] = share;
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && cut[k] < cut[k - 1]; k--) {
            const double swap = cut[k];
            cut[k] = cut[k - 1];
            cut[k - 1] = swap;
        }
    for (int i = 0; i + 1 < n; i++) {
        double end[2][2];
        for (int k = 0; k < 2; k++)
            for (int axis = 0; axis < 2; axis++) {
                const double t = cut[i + k];
                end[k][axis] = t >= 1.0 ? b[axis] : a[axis] + t * (b[axis] - a[axis]);
            }
        const double height = 0.5 * (end[0][1] + end[1][1]);
        if (height <= s->lo[1] || height >= s->hi[1]) continue;
        for (int k = 0; k < 2; k++) end[k][1] = fmin(fmax(end[k][1], s->lo[1]), s->hi[1]);
        add_trapezoid(s, end[0], end[1]);
    }
}

/* Green's theorem: over each height the part of the box to the left of the sides, of which those that go up count
 * positive in a polygon that runs counterclockwise. */
static bool polygon_moments(const void *par, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                            shape_moments *out)
{
    const polygon_par *p = par;
    const position *v = vertices_of(p);
    shape_moments sum = {.volume = 0.0};
    const strip s = {lo, hi, weight_by_radius, &sum};
    (void)dim;
    for (size_t k = 0, last = p->vertices.n - 1; k < p->vertices.n; last = k++) add_side(&s, v[last], v[k]);
    const double sign = sum.volume < 0.0 ? -1.0 : 1.0;
    *out = (shape_moments){sign * sum.volume, {sign * sum.first[0], sign * sum.first[1], 0.0}};
    return true;
}

/* ---- what is refused ---- */

/* Twice the area of a triangle, positive counterclockwise. */
static double double_area(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool lies_between(const double *a, const double *b, const double *x)
{
    return fmin(a[0], b[0]) <= x[0] && x[0] <= fmax(a[0], b[0]) && fmin(a[1], b[1]) <= x[1] && x[1] <= fmax(a[1], b[1]);
}

/* Whether the sides from a to b and from c to d have a point in common, and which. */
static bool polygon_sides_meet(const double *a, const double *b, const double *c, const double *d, double at[2])
{
    const double to_c = double_area(a, b, c), to_d = double_area(a, b, d), to_a = double_area(c, d, a),
                 to_b = double_area(c, d, b);
    const double *touching = NULL;
    if (to_c == 0.0 && lies_between(a, b, c)) touching = c;
    if (to_d == 0.0 && lies_between(a, b, d)) touching = d;
    if (to_a == 0.0 && lies_between(c, d, a)) touching = a;
    if (to_b == 0.0 && lies_between(c, d, b)) touching = b;
    const double share = to_c / (to_c - to_d);
    for (int axis = 0; axis < 2; axis++) at[axis] = touching ? touching[axis] : c[axis] + share * (d[axis] - c[axis]);
    return touching || ((to_c < 0.0) != (to_d < 0.0) && (to_a < 0.0) != (to_b < 0.0) && to_c != 0.0 && to_d != 0.0 &&
                        to_a != 0.0 && to_b != 0.0);
}

/* Whether the side from b to c runs back over the one from a to b. */
static bool folds_back(const double *a, const double *b, const double *c)
{
    const double along = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    return double_area(a, b, c) == 0.0 && along < 0.0;
}

static bool are_apart(const double *a, const double *b, const double *c, const double *d)
{
    return fmax(a[0], b[0]) < fmin(c[0], d[0]) || fmax(c[0], d[0]) < fmin(a[0], b[0]) ||
           fmax(a[1], b[1]) < fmin(c[1], d[1]) || fmax(c[1], d[1]) < fmin(a[1], b[1]);
}

static void refuse_meeting(const polygon_par *p, size_t i, size_t k, const double at[2], char why[SHAPE_WHY])
{
    const position *v = vertices_of(p);
    const double *a = v[i], *b = v[(i + 1) % p->vertices.n], *c = v[k], *d = v[(k + 1) % p->vertices.n];
    (void)snprintf(why, SHAPE_WHY,
                   "side %zu, from (%g, %g) to (%g, %g), meets side %zu, from (%g, %g) to (%g, %g), at (%g, %g): give "
                   "the vertices in order around it",
                   i + 1, a[0], a[1], b[0], b[1], k + 1, c[0], c[1], d[0], d[1], at[0], at[1]);
}

/* Sides one after another: neither of length zero, nor folded back. */
static bool refuse_corner(const polygon_par *p, size_t k, char why[SHAPE_WHY])
{
    const position *v = vertices_of(p);
    const size_t n = p->vertices.n;
    const double *a = v[k], *b = v[(k + 1) % n], *c = v[(k + 2) % n];
    if (a[0] == b[0] && a[1] == b[1])
        (void)snprintf(why, SHAPE_WHY, "vertices %zu and %zu are one, (%g, %g): leave one out", k + 1, (k + 1) % n + 1,
                       a[0], a[1]);
    else if (folds_back(a, b, c))
        (void)snprintf(why, SHAPE_WHY, "it runs back over itself at vertex %zu, (%g, %g)", (k + 1) % n + 1, b[0], b[1]);
    return why[0] != '\0';
}

static floe_status polygon_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    polygon_par *p = par;
    const position *v = vertices_of(p);
    const size_t n = p->vertices.n;
    (void)dim;
    (void)memory;
    for (size_t k = 0; k < n; k++)
        if (refuse_corner(p, k, why)) return FLOE_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t k = i + 2; k < n; k++) {
            double at[2];
            const double *a = v[i], *b = v[i + 1], *c = v[k], *d = v[(k + 1) % n];
            if ((k + 1) % n == i || are_apart(a, b, c, d) || !polygon_sides_meet(a, b, c, d, at)) continue;
            refuse_meeting(p, i, k, at, why);
            return FLOE_OK;
        }
    return FLOE_OK;
}

static const char *polygon_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

const shape_model shape_polygon = {
    .name = "polygon",
    .doc = "simple polygon, convex or not",
    .param_size = sizeof(polygon_par),
    .params = polygon_params,
    .n_params = sizeof polygon_params / sizeof *polygon_params,
    .min_dim = 2,
    .max_dim = 2,
    .instead_below = "it is of the plane; in one dimension take `box`",
    .instead_above = "it is of the plane; in space take `extruded: {of: {polygon: ...}}` or `revolved`",
    .level = polygon_level,
    .bounds = polygon_bounds,
    .moments = polygon_moments,
    .check = polygon_check,
    .prepare = polygon_prepare,
};

/* The part of a box inside a shape. Where the shape knows its moments they are taken. Else the box is halved along every axis where the surface may pass, `depth` times. The
 * smallest boxes are cut into simplices (2 triangles, 6 tetrahedra), and each simplex by the linear function through the
 * levels at its corners, exactly. */
#include "geom/shape.h"

#include "base/compiler.h"

#include <math.h>

typedef shape_moments moments;

typedef struct cutter {
    const shape *s;
    int dim;
    bool weight_by_radius;
    moments sum;
} cutter;

typedef struct vertex {
    double x[3], level;
} vertex;

static void add_moments(cutter *c, double sign, const moments *m)
{
    c->sum.volume += sign * m->volume;
    for (int k = 0; k < c->dim; k++) c->sum.first[k] += sign * m->first[k];
}

/* r over [lo, hi] has the mean r_c = (lo + hi)/2; r^2 the mean r_c^2 + (hi - lo)^2/12. */
static moments box_moments(const cutter *c, const double lo[3], const double hi[3])
{
    moments m = {.volume = 1.0};
    for (int k = 0; k < c->dim; k++) m.volume *= hi[k] - lo[k];
    const double r = 0.5 * (lo[0] + hi[0]), width = hi[0] - lo[0];
    if (c->weight_by_radius) m.volume *= r;
    for (int k = 0; k < c->dim; k++) m.first[k] = m.volume * 0.5 * (lo[k] + hi[k]);
    if (c->weight_by_radius) m.first[0] += m.volume / r * width * width / 12.0;
    return m;
}

static void add_box(cutter *c, const double lo[3], const double hi[3])
{
    const moments all = box_moments(c, lo, hi);
    add_moments(c, 1.0, &all);
}

/* |det of the edges from corner 0| / dim!. */
FLOE_ALWAYS_INLINE double simplex_volume(int dim, const vertex *v)
{
    double e[3][3] = {{0.0}};
    for (int a = 0; a < dim; a++) {
        for (int k = 0; k < dim; k++) e[a][k] = v[a + 1].x[k] - v[0].x[k];
    }
    if (dim == 1) return fabs(e[0][0]);
    if (dim == 2) return 0.5 * fabs(e[0][0] * e[1][1] - e[0][1] * e[1][0]);
    return fabs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6.0;
}

/* Over a simplex of d + 1 corners: the mean of x is that of the corners, and the mean of r x is
 * [sum r x + (sum r)(sum x)] / [(d + 1)(d + 2)]. */
FLOE_ALWAYS_INLINE void add_simplex(cutter *c, int dim, double sign, const vertex *v)
{
    const int corners = dim + 1;
    double sum[3] = {0.0};
    for (int a = 0; a < corners; a++) {
        for (int k = 0; k < dim; k++) sum[k] += v[a].x[k];
    }
    moments m = {.volume = simplex_volume(dim, v)};
    if (c->weight_by_radius) {
        double product[3] = {0.0};
        for (int a = 0; a < corners; a++) {
            for (int k = 0; k < dim; k++) product[k] += v[a].x[0] * v[a].x[k];
        }
        for (int k = 0; k < dim; k++)
            m.first[k] = m.volume * (product[k] + sum[0] * sum[k]) / (corners * (corners + 1.0));
        m.volume *= sum[0] / corners;
    } else {
        for (int k = 0; k < dim; k++) m.first[k] = m.volume * sum[k] / corners;
    }
    add_moments(c, sign, &m);
}

/* Where the linear function is zero between `in` (level < 0) and `out` (level >= 0). */
FLOE_ALWAYS_INLINE vertex crossing(int dim, const vertex *in, const vertex *out)
{
    const double t = in->level / (in->level - out->level);
    vertex v = {.level = 0.0};
    for (int k = 0; k < dim; k++) v.x[k] = in->x[k] + t * (out->x[k] - in->x[k]);
    return v;
}

/* The corner simplex cut off at `apex`, whose side of the surface no other corner shares. */
FLOE_ALWAYS_INLINE void add_corner(cutter *c, int dim, double sign, const vertex *v, int apex)
{
    const bool apex_inside = v[apex].level < 0.0;
    vertex cut[4];
    for (int a = 0; a <= dim; a++) {
        if (a == apex)
            cut[a] = v[a];
        else
            cut[a] = apex_inside ? crossing(dim, &v[apex], &v[a]) : crossing(dim, &v[a], &v[apex]);
    }
    add_simplex(c, dim, sign, cut);
}

/* A tetrahedron with corners i, j inside and k, l outside leaves a prism of triangles (i, ik, il) and (j, jk, jl). */
FLOE_ALWAYS_INLINE void add_prism(cutter *c, int dim, const vertex *i, const vertex *j, const vertex *k,
                                  const vertex *l)
{
    const vertex a[3] = {*i, crossing(dim, i, k), crossing(dim, i, l)};
    const vertex b[3] = {*j, crossing(dim, j, k), crossing(dim, j, l)};
    add_simplex(c, dim, 1.0, (const vertex[4]){a[0], a[1], a[2], b[2]});
    add_simplex(c, dim, 1.0, (const vertex[4]){a[0], a[1], b[1], b[2]});
    add_simplex(c, dim, 1.0, (const vertex[4]){a[0], b[0], b[1], b[2]});
}

FLOE_ALWAYS_INLINE void add_cut_simplex(cutter *c, int dim, const vertex *v)
{
    int in[4], out[4], n_in = 0, n_out = 0;
    for (int a = 0; a <= dim; a++) {
        if (v[a].level < 0.0)
            in[n_in++] = a;
        else
            out[n_out++] = a;
    }
    if (n_in == 0) return;
    if (n_out == 0) {
        add_simplex(c, dim, 1.0, v);
    } else if (n_in == 1) {
        add_corner(c, dim, 1.0, v, in[0]);
    } else if (n_out == 1) {
        add_simplex(c, dim, 1.0, v);
        add_corner(c, dim, -1.0, v, out[0]);
    } else {
        add_prism(c, dim, &v[in[0]], &v[in[1]], &v[out[0]], &v[out[1]]);
    }
}

/* Corner j of a box: bit k of j says which end along axis k. */
FLOE_ALWAYS_INLINE void box_corner(int dim, const double lo[3], const double hi[3], int j, double x[3])
{
    for (int k = 0; k < dim; k++) x[k] = (j >> k) & 1 ? hi[k] : lo[k];
}

/* The corner from which the box's main diagonal is drawn: that diagonal on which the linear function agrees best with the
 * level at the centre, so that an edge or a corner of a shape that lies along the box's own is kept whole. */
FLOE_ALWAYS_INLINE int best_diagonal(const double *level, int corners, double centre)
{
    int best = 0;
    double least = INFINITY;
    for (int j = 0; j < corners / 2; j++) {
        const double gap = fabs(0.5 * (level[j] + level[corners - 1 - j]) - centre);
        if (gap < least) {
            least = gap;
            best = j;
        }
    }
    return best;
}

/* Kuhn's division of a box into `n` simplices of equal volume: one for each order of the axes, along the path of corners
 * that crosses axis by axis from one end of a main diagonal to the other. */
typedef struct kuhn {
    int n;
    int corner[6][4];
} kuhn;

FLOE_ALWAYS_INLINE kuhn kuhn_from(int dim, int start)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static const int n_orders[4] = {0, 1, 2, 6};
    kuhn division = {.n = n_orders[dim]};
    for (int o = 0; o < division.n; o++) {
        int corner = start;
        for (int k = 0; k <= dim; k++) {
            division.corner[o][k] = corner;
            if (k < dim) corner ^= 1 << orders[o][k];
        }
    }
    return division;
}

/* The functions that are linear in each simplex lie on one side of a curved surface. What is taken off here is their mean
 * less that of the level, (2 centre + mean of the corners)/3 for any quadratic: the errors of neighbouring boxes then
 * cancel instead of adding up, and flat surfaces are still exact. Where the corners' mean is far from the centre the shape
 * has an edge or a corner there, no curvature: it is left alone. */
FLOE_ALWAYS_INLINE double curvature_shift(const kuhn *division, int dim, const double *level, double centre,
                                          double size)
{
    const int corners = 1 << dim;
    double corner_mean = 0.0, linear_mean = 0.0;
    for (int j = 0; j < corners; j++) corner_mean += level[j] / corners;
    if (!(fabs(corner_mean - centre) < 0.05 * size)) return 0.0;
    for (int o = 0; o < division->n; o++) {
        for (int k = 0; k <= dim; k++) linear_mean += level[division->corner[o][k]];
    }
    linear_mean /= division->n * (dim + 1);
    return linear_mean - (2.0 * centre + corner_mean) / 3.0;
}

FLOE_ALWAYS_INLINE void cut_box_in(cutter *c, int dim, const double lo[3], const double hi[3], double centre)
{
    const int corners = 1 << dim;
    vertex v[8];
    double level[8];
    for (int j = 0; j < corners; j++) {
        box_corner(dim, lo, hi, j, v[j].x);
        level[j] = c->s->model->level(c->s->par, dim, v[j].x);
    }
    const kuhn division = kuhn_from(dim, best_diagonal(level, corners, centre));
    const double shift = curvature_shift(&division, dim, level, centre, hi[0] - lo[0]);
    int inside = 0;
    for (int j = 0; j < corners; j++) {
        v[j].level = level[j] - shift;
        if (v[j].level < 0.0) inside++;
    }
    if (inside == 0) return;
    if (inside == corners) {
        add_box(c, lo, hi);
        return;
    }
    for (int o = 0; o < division.n; o++) {
        vertex simplex[4];
        for (int k = 0; k <= dim; k++) simplex[k] = v[division.corner[o][k]];
        add_cut_simplex(c, dim, simplex);
    }
}

/* The dimension as a literal: half as fast again in space. */
static void clip_box_by_dimension(cutter *c, const double lo[3], const double hi[3], double centre)
{
    switch (c->dim) {
    case 1: cut_box_in(c, 1, lo, hi, centre); break;
    case 2: cut_box_in(c, 2, lo, hi, centre); break;
    default: cut_box_in(c, 3, lo, hi, centre); break;
    }
}

/* |level| is at most the distance from the surface: a box whose half diagonal is shorter than it is all in or all out. */
static void subdivide_box(cutter *c, const double lo[3], const double hi[3], int depth)
{
    double centre[3], diagonal2 = 0.0;
    for (int k = 0; k < c->dim; k++) {
        centre[k] = 0.5 * (lo[k] + hi[k]);
        diagonal2 += (hi[k] - lo[k]) * (hi[k] - lo[k]);
    }
    const double level = c->s->model->level(c->s->par, c->dim, centre);
    if (4.0 * level * level >= diagonal2) {
        if (level < 0.0) add_box(c, lo, hi);
        return;
    }
    if (depth == 0) {
        clip_box_by_dimension(c, lo, hi, level);
        return;
    }
    for (int j = 0; j < 1 << c->dim; j++) {
        double child_lo[3], child_hi[3];
        for (int k = 0; k < c->dim; k++) {
            child_lo[k] = (j >> k) & 1 ? centre[k] : lo[k];
            child_hi[k] = (j >> k) & 1 ? hi[k] : centre[k];
        }
        subdivide_box(c, child_lo, child_hi, depth - 1);
    }
}

/* |level| is at most the distance from the surface: a box whose half diagonal is shorter than it is all in or all out. */
static bool is_whole_or_empty(const shape *s, int dim, const double lo[3], const double hi[3], bool *inside)
{
    double centre[3] = {0.0}, diagonal2 = 0.0;
    for (int k = 0; k < dim; k++) {
        centre[k] = 0.5 * (lo[k] + hi[k]);
        diagonal2 += (hi[k] - lo[k]) * (hi[k] - lo[k]);
    }
    const double level = shape_level(s, dim, centre);
    *inside = level < 0.0;
    return 4.0 * level * level >= diagonal2;
}

/* What the shape's bounds leave of the box. */
static void add_box_in_bounds(cutter *c, const double lo[3], const double hi[3])
{
    double from[3], to[3], part_lo[3] = {0.0}, part_hi[3] = {0.0};
    c->s->model->bounds(c->s->par, c->dim, from, to);
    for (int k = 0; k < c->dim; k++) {
        part_lo[k] = fmax(lo[k], from[k]);
        part_hi[k] = fmin(hi[k], to[k]);
        if (!(part_lo[k] < part_hi[k])) return;
    }
    add_box(c, part_lo, part_hi);
}

/* What is all of the box, or none, but for round-off. */
static void clip_round_off(cutter *c, const double lo[3], const double hi[3])
{
    static const double round_off = 1e-14;
    const moments all = box_moments(c, lo, hi);
    if (c->sum.volume > (1.0 - round_off) * all.volume) c->sum = all;
    if (c->sum.volume < round_off * all.volume) c->sum = (moments){.volume = 0.0};
}

bool shape_exact_moments(const shape *s, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                         shape_moments *out)
{
    cutter c = {.s = s, .dim = dim, .weight_by_radius = weight_by_radius};
    bool inside;
    if (shape_fills_bounds(s, dim)) {
        add_box_in_bounds(&c, lo, hi);
    } else if (!s->model->moments) {
        return false;
    } else if (is_whole_or_empty(s, dim, lo, hi, &inside)) {
        if (inside) add_box(&c, lo, hi);
    } else {
        if (!s->model->moments(s->par, dim, lo, hi, weight_by_radius, &c.sum)) return false;
        clip_round_off(&c, lo, hi);
    }
    *out = c.sum;
    return true;
}

double shape_fraction(const shape *s, int dim, const double lo[3], const double hi[3], bool weight_by_radius, int depth,
                      double centroid[3])
{
    cutter c = {.s = s, .dim = dim, .weight_by_radius = weight_by_radius};
    if (!shape_exact_moments(s, dim, lo, hi, weight_by_radius, &c.sum)) subdivide_box(&c, lo, hi, depth);
    const moments all = box_moments(&c, lo, hi);
    for (int k = 0; k < dim; k++) {
        const double x = c.sum.volume > 0.0 ? c.sum.first[k] / c.sum.volume : 0.5 * (lo[k] + hi[k]);
        centroid[k] = fmin(fmax(x, lo[k]), hi[k]); /* round-off of a sliver must not leave the box */
    }
    return fmax(c.sum.volume / all.volume, 0.0);
}

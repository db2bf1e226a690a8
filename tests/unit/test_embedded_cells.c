/* Every cell that a surface cuts, against its intersection with what the surface encloses, found in another way: polygons are clipped by the four sides
 * of the cell, and solids in space are cut into slices, which are polygons. Open fractions, apertures of all faces, moments; in the plane, about an
 * axis, in space; cells with three different edges. */
#include "check.h"

#include "embedded/cut.h"

#include <math.h>
#include <string.h>

enum { MOST = 64 };

typedef struct flat {
    int n;
    double x[MOST][2];
} flat;

/* What of a convex or other polygon lies below (sign 1) or above (-1) a line across an axis (Sutherland and Hodgman). */
static flat clipped(const flat *p, int axis, double at, double sign)
{
    flat out = {0};
    for (int k = 0; k < p->n; ++k) {
        const double *a = p->x[k], *b = p->x[(k + 1) % p->n];
        const double da = sign * (at - a[axis]), db = sign * (at - b[axis]);
        assert_in_range(out.n, 0, MOST - 2);
        if (da >= 0.0) memcpy(out.x[out.n++], a, sizeof *out.x);
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
            for (int c = 0; c < 2; ++c) out.x[out.n][c] = a[c] + da / (da - db) * (b[c] - a[c]);
            out.n++;
        }
    }
    return out;
}

static flat within(const flat *p, const double lo[2], const double hi[2])
{
    flat out = *p;
    for (int axis = 0; axis < 2; ++axis) {
        out = clipped(&out, axis, hi[axis], 1.0);
        out = clipped(&out, axis, lo[axis], -1.0);
    }
    return out;
}

/* Integrals of 1, x and y over a polygon; about an axis with the weight x. By triangles from the first corner, in which the mean of a product of two
 * linear functions is that of their products in the middles of the sides. */
static void integrals(const flat *p, bool radial, double sum[3])
{
    sum[0] = sum[1] = sum[2] = 0.0;
    for (int k = 1; k + 1 < p->n; ++k) {
        const double *at[3] = {p->x[0], p->x[k], p->x[k + 1]};
        const double area =
            0.5 * ((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]));
        for (int side = 0; side < 3; ++side) {
            const double *a = at[side], *b = at[(side + 1) % 3], x = 0.5 * (a[0] + b[0]), y = 0.5 * (a[1] + b[1]);
            const double w = area / 3.0 * (radial ? x : 1.0);
            sum[0] += w;
            sum[1] += w * x;
            sum[2] += w * y;
        }
    }
}

/* The share of the edge of a cell along an axis that a polygon covers, at a place across it; weighted with x. The two places where a star about its
 * centre crosses a line are found side by side. */
static double covered(const flat *p, int along, double at, double from, double to, bool weighted)
{
    double place[MOST], sum = 0.0;
    int n = 0;
    for (int k = 0; k < p->n; ++k) {
        const double *a = p->x[k], *b = p->x[(k + 1) % p->n];
        const double da = a[1 - along] - at, db = b[1 - along] - at;
        if ((da > 0.0) != (db > 0.0)) place[n++] = a[along] + da / (da - db) * (b[along] - a[along]);
    }
    for (int i = 0; i < n; ++i)
        for (int k = i + 1; k < n; ++k)
            if (place[k] < place[i]) {
                const double kept = place[i];
                place[i] = place[k];
                place[k] = kept;
            }
    for (int k = 0; k + 1 < n; k += 2) {
        const double a = fmax(place[k], from), b = fmin(place[k + 1], to);
        if (b > a) sum += weighted ? 0.5 * (b * b - a * a) : b - a;
    }
    return sum / (weighted ? 0.5 * (to * to - from * from) : to - from);
}

static double worst_of(double worst, double found, double wanted)
{
    const double off = fabs(found - wanted);
    return off <= worst ? worst : off;
}

/* The farthest from the exact of shares of volumes, of faces, and of moments over the cell's edges. */
static void compare_plane(const cut_surface *c, const flat *p, double worst[3])
{
    const mesh *m = c->mesh;
    const bool radial = m->geometry == MESH_AXISYMMETRIC;
    for (int j = 0; j < m->n[1]; ++j)
        for (int i = 0; i < m->n[0]; ++i) {
            const int cell[3] = {i, j, 0};
            const double lo[2] = {m->lower[0] + i * m->h[0], m->lower[1] + j * m->h[1]},
                         hi[2] = {lo[0] + m->h[0], lo[1] + m->h[1]};
            const flat part = within(p, lo, hi),
                       whole = {4, {{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}}};
            double sum[3], all[3];
            integrals(&part, radial, sum);
            integrals(&whole, radial, all);
            worst[0] = worst_of(worst[0], cut_open(c, cell), sum[0] / all[0]);
            for (int a = 0; a < 2; ++a) {
                const double moment = (sum[1 + a] - sum[0] * all[1 + a] / all[0]) / all[0];
                worst[2] = worst_of(worst[2], cut_moment(c, cell, a) / m->h[a], moment / m->h[a]);
                for (int side = 0; side < 2; ++side)
                    worst[1] =
                        worst_of(worst[1], cut_face(c, cell, a, side),
                                 covered(p, 1 - a, side ? hi[a] : lo[a], lo[1 - a], hi[1 - a], radial && a == 1));
            }
        }
}

/* A star of random rays about a place. */
static flat random_star(uint64_t *seed, int n)
{
    const double centre[2] = {check_random(seed, 0.45, 0.55), check_random(seed, 0.4, 0.5)};
    flat p = {.n = n};
    for (int k = 0; k < n; ++k) {
        const double angle = 6.283185307179586 * (k + check_random(seed, 0.1, 0.9)) / n,
                     r = check_random(seed, 0.1, 0.37);
        p.x[k][0] = centre[0] + r * cos(angle);
        p.x[k][1] = centre[1] + r * sin(angle);
    }
    return p;
}

static void polygons_are_clipped(void **state)
{
    context *ctx = *state;
    uint64_t seed = 20;
    for (int radial = 0; radial < 2; ++radial)
        for (int times = 0; times < 30; ++times) {
            const mesh_spec spec = {.dim = 2,
                                    .geometry = radial ? MESH_AXISYMMETRIC : MESH_CARTESIAN,
                                    .lower = {radial ? 0.0 : -0.3, -0.2},
                                    .upper = {radial ? 1.1 : 1.1, 1.0},
                                    .cell = {0.1, times % 2 ? 0.15 : 0.08}};
            mesh m;
            cut_surface c;
            double worst[3] = {0.0, 0.0, 0.0};
            check_ok(ctx, mesh_init(&m, ctx, &spec));
            check_ok(ctx, cut_create(&c, ctx, &m));
            const flat p = random_star(&seed, 5 + times % 7);
            check_ok(ctx, cut_reserve(&c, p.n, 1));
            c.chain[0] = (cut_chain){0, p.n, true, 0};
            for (int k = 0; k < p.n; ++k) c.vertex[k] = (cut_vertex){{p.x[k][0], p.x[k][1]}, k, 0};
            check_ok(ctx, cut_find(&c));
            compare_plane(&c, &p, worst);
            for (int k = 0; k < 3; ++k) check_close(worst[k], 0.0, 1e-12);
            cut_destroy(&c);
        }
}

/* ---- in space ---- */

/* The slice of a tetrahedron at a place along an axis, seen along the next two. */
static flat slice(double x[4][3], int axis, double at)
{
    static const int edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    flat p = {0};
    double middle[2] = {0.0, 0.0}, angle[6];
    for (int e = 0; e < 6; ++e) {
        const double *a = x[edge[e][0]], *b = x[edge[e][1]], da = a[axis] - at, db = b[axis] - at;
        if ((da > 0.0) == (db > 0.0)) continue;
        for (int c = 0; c < 2; ++c) {
            const int k = (axis + 1 + c) % 3;
            p.x[p.n][c] = a[k] + da / (da - db) * (b[k] - a[k]);
        }
        p.n++;
    }
    for (int k = 0; k < p.n; ++k)
        for (int c = 0; c < 2; ++c) middle[c] += p.x[k][c] / p.n;
    for (int k = 0; k < p.n; ++k) angle[k] = atan2(p.x[k][1] - middle[1], p.x[k][0] - middle[0]);
    for (int i = 0; i < p.n; ++i)
        for (int k = i + 1; k < p.n; ++k)
            if (angle[k] < angle[i]) {
                const double kept[3] = {angle[i], p.x[i][0], p.x[i][1]};
                angle[i] = angle[k];
                memcpy(p.x[i], p.x[k], sizeof *p.x);
                angle[k] = kept[0];
                memcpy(p.x[k], kept + 1, sizeof *p.x);
            }
    return p;
}

static void compare_space(const cut_surface *c, double x[4][3], double worst[3])
{
    enum { SLICES = 40 }; /* Simpson's rule on so many parts of a cell: kinks leave 1e-4 of it */
    const mesh *m = c->mesh;
    for (int j = 0; j < m->n[2]; ++j)
        for (int i = 0; i < m->n[1]; ++i)
            for (int l = 0; l < m->n[0]; ++l) {
                const int cell[3] = {l, i, j};
                double lo[3], hi[3], size = 1.0;
                for (int a = 0; a < 3; ++a) {
                    lo[a] = m->lower[a] + cell[a] * m->h[a];
                    hi[a] = lo[a] + m->h[a];
                    size *= m->h[a];
                }
                for (int axis = 0; axis < 3; ++axis) {
                    const int b = (axis + 1) % 3, d = (axis + 2) % 3;
                    const double low[2] = {lo[b], lo[d]}, high[2] = {hi[b], hi[d]};
                    double volume = 0.0, moment = 0.0;
                    for (int n = 0; n <= 2 * SLICES; ++n) {
                        const double at = lo[axis] + m->h[axis] * n / (2.0 * SLICES);
                        const double weight = (n == 0 || n == 2 * SLICES ? 1.0 : n % 2 ? 4.0 : 2.0) / (6.0 * SLICES);
                        const flat all = slice(x, axis, at), part = within(&all, low, high);
                        double sum[3];
                        integrals(&part, false, sum);
                        volume += weight * sum[0] * m->h[axis] / size;
                        moment += weight * sum[0] * (at - 0.5 * (lo[axis] + hi[axis])) / size;
                        if (n == 0)
                            worst[1] = worst_of(worst[1], cut_face(c, cell, axis, 0), sum[0] * m->h[axis] / size);
                        if (n == 2 * SLICES)
                            worst[1] = worst_of(worst[1], cut_face(c, cell, axis, 1), sum[0] * m->h[axis] / size);
                    }
                    worst[0] = worst_of(worst[0], cut_open(c, cell), volume);
                    worst[2] = worst_of(worst[2], cut_moment(c, cell, axis) / m->h[axis], moment);
                }
            }
}

static void solids_are_sliced(void **state)
{
    static const int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    context *ctx = *state;
    uint64_t seed = 5;
    for (int times = 0; times < 6; ++times) {
        const mesh_spec spec = {
            .dim = 3, .lower = {-0.1, 0.0, -0.2}, .upper = {1.1, 1.2, 1.0}, .cell = {0.24, 0.3, 0.2}};
        mesh m;
        cut_surface c;
        double x[4][3], worst[3] = {0.0, 0.0, 0.0};
        static const double rough[4][3] = {{0.1, 0.15, 0.1}, {0.9, 0.2, 0.1}, {0.5, 1.0, 0.1}, {0.5, 0.5, 0.85}};
        check_ok(ctx, mesh_init(&m, ctx, &spec));
        check_ok(ctx, cut_create(&c, ctx, &m));
        check_ok(ctx, cut_reserve(&c, 4, 0));
        check_ok(ctx, cut_reserve_triangles(&c, 4));
        for (int k = 0; k < 4; ++k) {
            for (int a = 0; a < 3; ++a) x[k][a] = rough[k][a] + check_random(&seed, -0.09, 0.09);
            c.vertex[k] = (cut_vertex){{x[k][0], x[k][1], x[k][2]}, k, 0};
        }
        for (int k = 0; k < 4; ++k) c.triangle[k] = (cut_triangle){{face[k][0], face[k][1], face[k][2]}, 0};
        check_ok(ctx, cut_find(&c));
        compare_space(&c, x, worst);
        check_close(worst[1], 0.0, 1e-12);
        check_close(worst[0], 0.0, 3e-4);
        check_close(worst[2], 0.0, 2e-4);
        cut_destroy(&c);
    }
}

/* ---- boxes, with sides on faces of the mesh and between them ---- */

typedef struct box {
    double lo[3], hi[3];
    bool on[3][2]; /* a face of the mesh */
} box;

static box random_box(uint64_t *seed, const mesh *m, bool small)
{
    box b;
    memset(&b, 0, sizeof b);
    for (int a = 0; a < m->dim; ++a) {
        const int from = 1 + (int)check_random(seed, 0.0, 0.5 * m->n[a]),
                  to = small ? from : from + 1 + (int)check_random(seed, 0.0, 0.5 * m->n[a] - 2.0);
        b.on[a][0] = !small && check_random(seed, 0.0, 1.0) < 0.4;
        b.on[a][1] = !small && check_random(seed, 0.0, 1.0) < 0.4;
        b.lo[a] = mesh_node(m, a, from) + (b.on[a][0] ? 0.0 : m->h[a] * check_random(seed, 0.1, 0.4));
        b.hi[a] = mesh_node(m, a, to) + (b.on[a][1] ? 0.0 : m->h[a] * check_random(seed, 0.6, 0.9));
    }
    return b;
}

/* Gas in it, or about it. */
static void lay_box(cut_surface *c, const box *b, bool inside)
{
    static const int face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    static const int around[4] = {0, 1, 3, 2};
    context *ctx = c->ctx;
    const bool space = c->mesh->dim == 3;
    const int n = space ? 8 : 4;
    check_ok(ctx, cut_reserve(c, n, space ? 0 : 1));
    for (int k = 0; k < n; ++k) {
        const int at = space ? k : around[inside ? k : n - 1 - k];
        c->vertex[k] = (cut_vertex){{0.0}, k, 0};
        for (int a = 0; a < c->mesh->dim; ++a) c->vertex[k].x[a] = at >> a & 1 ? b->hi[a] : b->lo[a];
    }
    if (!space) c->chain[0] = (cut_chain){0, n, true, 0};
    if (!space) return;
    check_ok(ctx, cut_reserve_triangles(c, 12));
    for (int f = 0; f < 6; ++f)
        for (int half = 0; half < 2; ++half) {
            const int *k = face[f], second = half ? k[2] : k[1], third = half ? k[3] : k[2];
            c->triangle[2 * f + half] = (cut_triangle){{k[0], inside ? second : third, inside ? third : second}, 0};
        }
}

/* Integral of the weight of areas. */
static double weighed(const mesh *m, int axis, double from, double to)
{
    if (!(to > from)) return 0.0;
    return axis == 0 && m->geometry == MESH_AXISYMMETRIC ? 0.5 * (to * to - from * from) : to - from;
}

/* The share of a cell's, or of its face's, extent along an axis. */
static double share_along(const mesh *m, const box *b, int axis, int cell)
{
    const double lo = mesh_node(m, axis, cell), hi = mesh_node(m, axis, cell + 1);
    return weighed(m, axis, fmax(lo, b->lo[axis]), fmin(hi, b->hi[axis])) / weighed(m, axis, lo, hi);
}

/* Areas of open faces and of pieces add up to nothing, but for the radial ones about an axis, which the hoop closes. */
static double not_closed(const cut_surface *c, const int cell[3], int at)
{
    const mesh *m = c->mesh;
    double worst = 0.0;
    for (int a = m->geometry == MESH_AXISYMMETRIC; a < m->dim; ++a) {
        double sum = 0.0, size = 1.0;
        for (int d = 0; d < m->dim; ++d) size *= d == a ? 1.0 : m->h[d];
        for (int side = 0; side < 2; ++side)
            sum += (side ? 1.0 : -1.0) * cut_face(c, cell, a, side) * mesh_face_area(m, a, cell[0] + (a == 0 && side));
        for (int n = 0; n < c->n_pieces; ++n) sum += c->piece[n].cell == at ? c->piece[n].area[a] : 0.0;
        worst = worst_of(worst, sum / size, 0.0);
    }
    return worst;
}

static void compare_box(const cut_surface *c, const box *b, bool inside, double worst[3])
{
    const mesh *m = c->mesh;
    for (int j = 0; j < m->n[2]; ++j)
        for (int i = 0; i < m->n[1]; ++i)
            for (int l = 0; l < m->n[0]; ++l) {
                const int cell[3] = {l, i, j};
                double along[3] = {1.0, 1.0, 1.0}, all = 1.0;
                for (int a = 0; a < m->dim; ++a) all *= along[a] = share_along(m, b, a, cell[a]);
                worst[0] = worst_of(worst[0], cut_open(c, cell), inside ? all : 1.0 - all);
                for (int f = 0; f < 2 * m->dim; ++f) {
                    const int a = f / 2;
                    const double at = mesh_node(m, a, cell[a] + f % 2);
                    const double share = at > b->lo[a] && at < b->hi[a] ? along[(a + 1) % 3] * along[(a + 2) % 3] : 0.0;
                    const bool on = (at == b->lo[a] && b->on[a][0]) || (at == b->hi[a] && b->on[a][1]);
                    int other[3] = {cell[0], cell[1], cell[2]};
                    other[a] += f % 2 ? 1 : -1;
                    if (!on) worst[1] = worst_of(worst[1], cut_face(c, cell, a, f % 2), inside ? share : 1.0 - share);
                    if (other[a] >= 0 && other[a] < m->n[a])
                        worst[1] = worst_of(worst[1], cut_face(c, cell, a, f % 2), cut_face(c, other, a, 1 - f % 2));
                }
                worst[2] = worst_of(worst[2], not_closed(c, cell, c->at[cut_index(m, cell)]), 0.0);
            }
}

/* The middles of pieces, by which surfaces move and are pushed: with their areas they give the volume along every axis, and no force. */
static void check_pieces(const cut_surface *c, const box *b, bool inside)
{
    double volume = 1.0;
    for (int a = 0; a < c->mesh->dim; ++a) volume *= b->hi[a] - b->lo[a];
    for (int a = 0; a < c->mesh->dim; ++a) {
        double sum = 0.0, force = 0.0, weights = 0.0;
        for (int n = 0; n < c->n_pieces; ++n) {
            const cut_piece *p = &c->piece[n];
            sum += p->area[a] * cut_at_middle(c, p, a);
            if (c->mesh->dim == 3) check_true(c->cell[p->cell].open > 0.0); /* in the cell of the gas, on a face too */
            force += p->area[a];
            weights = fmax(weights, fabs(p->weight[0] + p->weight[1] + p->weight[2] - 1.0));
        }
        check_close(sum, inside ? volume : -volume, 1e-12);
        check_close(force, 0.0, 1e-13);
        check_close(weights, 0.0, 1e-14);
    }
}

static void boxes_are_exact(void **state)
{
    context *ctx = *state;
    uint64_t seed = 7;
    for (int times = 0; times < 240; ++times) {
        const int kind = times % 3;
        const mesh_spec spec = {.dim = kind == 2 ? 3 : 2,
                                .geometry = kind == 1 ? MESH_AXISYMMETRIC : MESH_CARTESIAN,
                                .lower = {0.0, -0.25, 0.5},
                                .upper = {1.0, 1.25, 2.0},
                                .cell = {0.125, 0.1875, 0.25}};
        const bool inside = times / 3 % 2, small = times / 6 % 4 == 0;
        mesh m;
        cut_surface c;
        double worst[3] = {0.0, 0.0, 0.0};
        check_ok(ctx, mesh_init(&m, ctx, &spec));
        check_ok(ctx, cut_create(&c, ctx, &m));
        const box b = random_box(&seed, &m, small);
        lay_box(&c, &b, inside);
        check_ok(ctx, cut_find(&c));
        compare_box(&c, &b, inside, worst);
        for (int k = 0; k < 3; ++k) check_close(worst[k], 0.0, 1e-12);
        if (kind != 1) check_pieces(&c, &b, inside);
        cut_destroy(&c);
    }
}

/* Two surfaces that cross would hold gas on both sides of one: the message says where. */
static void crossings_are_told(void **state)
{
    context *ctx = *state;
    for (int dim = 2; dim <= 3; ++dim) {
        const mesh_spec spec = {.dim = dim, .upper = {1.0, 1.5, 2.0}, .cell = {0.125, 0.25, 0.5}};
        const box b = {{0.3, 0.55, 0.6}, {0.34, 0.7, 0.8}, {{false}}}; /* in the cell 2, 2, 1, each in itself */
        mesh m;
        cut_surface c, one;
        check_ok(ctx, mesh_init(&m, ctx, &spec));
        check_ok(ctx, cut_create(&one, ctx, &m));
        check_ok(ctx, cut_create(&c, ctx, &m));
        lay_box(&one, &b, false);
        check_ok(ctx, cut_reserve(&c, 3 * one.n_vertices, 3 * one.n_chains));
        check_ok(ctx, cut_reserve_triangles(&c, 3 * one.n_triangles));
        /* Three solids that lie in one cell, the larger of them with more than its volume together. */
        for (int k = 0; k < 3; ++k) {
            const int v = one.n_vertices;
            for (int n = 0; n < v; ++n) {
                c.vertex[k * v + n] = one.vertex[n];
                for (int a = 0; a < dim; ++a) {
                    const bool low = one.vertex[n].x[a] < 0.5 * (b.lo[a] + b.hi[a]);
                    c.vertex[k * v + n].x[a] = mesh_node(&m, a, a == 2 ? 1 : 2) + m.h[a] * (low ? 0.05 : 0.95);
                }
            }
            for (int n = 0; n < one.n_chains; ++n) c.chain[k] = (cut_chain){k * v, v, true, 0};
            for (int n = 0; n < one.n_triangles; ++n)
                for (int e = 0; e < 3; ++e) {
                    c.triangle[k * one.n_triangles + n] = one.triangle[n];
                    for (int i = 0; i < 3; ++i) c.triangle[k * one.n_triangles + n].vertex[i] += k * v;
                }
        }
        assert_int_equal(cut_find(&c), FLOE_RETRY);
        assert_non_null(strstr(context_message(ctx), dim == 2 ? "cell (2, 2), at (0.3125, 0.625)"
                                                              : "cell (2, 2, 1), at (0.3125, 0.625, 0.75)"));
        context_clear(ctx);
        cut_destroy(&c);
        cut_destroy(&one);
    }
}

/* A plate in space is thin where both of its sides lie in one cell, however thin it is down to a millionth of the cell, along every axis, and the place
 * that is told lies on it; one of two cells, a gap of the same size between solids, and one whose sides are two bodies' are not. */
static void thin_plates(void **state)
{
    context *ctx = *state;
    static const struct {
        double from, to; /* in cells */
        bool thin;
    } plate[] = {{2.2, 2.8, true},         {2.05, 2.95, true}, {2.2, 2.2 + 2e-6, true},
                 {2.2, 2.2 + 5e-7, false}, {1.8, 2.2, false},  {2.2, 3.8, false}};
    for (int axis = 0; axis < 3; ++axis)
        for (size_t k = 0; k < sizeof plate / sizeof *plate; ++k)
            for (int kind = 0; kind < 3; ++kind) { /* solid; gas; solid of two bodies */
                const mesh_spec spec = {.dim = 3, .upper = {1.0, 1.0, 1.0}, .cell = {0.2, 0.2, 0.2}};
                mesh m;
                cut_surface c;
                bool thin;
                double x[3];
                box b;
                memset(&b, 0, sizeof b);
                check_ok(ctx, mesh_init(&m, ctx, &spec));
                check_ok(ctx, cut_create(&c, ctx, &m));
                for (int a = 0; a < 3; ++a) {
                    b.lo[a] = 0.2 * (a == axis ? plate[k].from : 1.3);
                    b.hi[a] = 0.2 * (a == axis ? plate[k].to : 3.6);
                }
                lay_box(&c, &b, kind == 1);
                for (int v = 0; v < c.n_vertices && kind == 2; ++v) c.vertex[v].body = v >> axis & 1;
                check_ok(ctx, cut_find(&c));
                check_ok(ctx, cut_find_thin(&c, &thin, x));
                assert_int_equal(thin, plate[k].thin && kind == 0);
                for (int a = 0; a < 3 && thin; ++a) check_true(x[a] >= b.lo[a] - 1e-12 && x[a] <= b.hi[a] + 1e-12);
                cut_destroy(&c);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(polygons_are_clipped, check_make_context, check_drop_context),
        cmocka_unit_test_setup_teardown(solids_are_sliced, check_make_context, check_drop_context),
        cmocka_unit_test_setup_teardown(boxes_are_exact, check_make_context, check_drop_context),
        cmocka_unit_test_setup_teardown(thin_plates, check_make_context, check_drop_context),
        cmocka_unit_test_setup_teardown(crossings_are_told, check_make_context, check_drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Cells that triangles cut: shares add up to the polyhedron, every cell's areas close, both cells of a face agree, for bodies at random places and on
 * planes, edges and corners of the mesh. FLOE_PLACEMENTS: of each kind of body (nightly more). */
#include "check.h"

#include "embedded/cut.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 12, MOST = 6000 };

static const double pi = 3.14159265358979323846;
static const double cell_size[3] = {0.1, 0.13, 0.07};

/* ---- bodies, in cells ---- */

typedef struct body {
    double x[MOST][3];
    int triangle[2 * MOST][3];
    int n, triangles;
} body;

static body b; /* large */
static uint64_t state;

static double any(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) / 9007199254740992.0;
}

static int any_of(int n)
{
    return (int)(n * any());
}

static int add_vertex(double x, double y, double z)
{
    const double at[3] = {x, y, z};
    memcpy(b.x[b.n], at, sizeof at);
    return b.n++;
}

static void add_face(int i, int j, int k)
{
    const int at[3] = {i, j, k};
    memcpy(b.triangle[b.triangles++], at, sizeof at);
}

static void add_quad(int i, int j, int k, int l)
{
    add_face(i, j, k);
    add_face(i, k, l);
}

/* The number of a vertex of the surface of a grid of m x m x m boxes, made when it is first met. */
static int grid_vertex(int *number, int m, const int at[3], const double half[3], double radius)
{
    int *known = &number[(at[2] * (m + 1) + at[1]) * (m + 1) + at[0]];
    double x[3], length = 0.0;
    if (*known >= 0) return *known;
    for (int a = 0; a < 3; ++a) {
        x[a] = 2.0 * at[a] / m - 1.0;
        if (radius > 0.0) x[a] = tan(0.25 * pi * x[a]);
        length += x[a] * x[a];
    }
    for (int a = 0; a < 3; ++a) x[a] *= radius > 0.0 ? radius / sqrt(length) : half[a];
    return *known = add_vertex(x[0], x[1], x[2]);
}

/* A box of half lengths, its sides m x m quadrangles; with a radius, mapped on a ball. Outward as the body sees it. */
static void add_box(int m, const double half[3], double radius)
{
    int number[9 * 9 * 9];
    memset(number, -1, sizeof number);
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < m; ++i)
                for (int j = 0; j < m; ++j) {
                    const int e = (axis + 1) % 3, f = (axis + 2) % 3;
                    int at[4][3], v[4];
                    for (int k = 0; k < 4; ++k) {
                        at[k][axis] = side * m;
                        at[k][e] = i + (k == 1 || k == 2);
                        at[k][f] = j + (k >= 2);
                        v[k] = grid_vertex(number, m, at[k], half, radius);
                    }
                    if (side)
                        add_quad(v[0], v[1], v[2], v[3]);
                    else
                        add_quad(v[0], v[3], v[2], v[1]);
                }
}

static void add_torus(int m, int n, double R, double r)
{
    const int first = b.n;
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            const double s = 2.0 * pi * i / m, t = 2.0 * pi * j / n;
            add_vertex((R + r * cos(t)) * cos(s), (R + r * cos(t)) * sin(s), r * sin(t));
        }
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            const int p = (i + 1) % m, q = (j + 1) % n;
            add_quad(first + i * n + j, first + p * n + j, first + p * n + q, first + i * n + q);
        }
}

static void add_octahedron(double r)
{
    const int first = b.n;
    for (int a = 0; a < 3; ++a)
        for (int s = -1; s <= 1; s += 2) add_vertex(a == 0 ? s * r : 0.0, a == 1 ? s * r : 0.0, a == 2 ? s * r : 0.0);
    for (int c = 0; c < 8; ++c) {
        const int i = first + (c & 1), j = first + 2 + (c >> 1 & 1), k = first + 4 + (c >> 2 & 1);
        if ((c ^ c >> 1 ^ c >> 2) & 1)
            add_face(i, j, k);
        else
            add_face(i, k, j);
    }
}

/* Turned at random (1), by 45 degrees about an axis (2) or not (0), and moved. */
static void place(int turn, const double centre[3])
{
    double R[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (turn == 1) {
        double q[4], l;
        do {
            l = 0.0;
            for (int k = 0; k < 4; ++k) {
                q[k] = 2.0 * any() - 1.0;
                l += q[k] * q[k];
            }
        } while (l > 1.0 || l < 1e-4);
        const double w = q[0] / sqrt(l), x = q[1] / sqrt(l), y = q[2] / sqrt(l), z = q[3] / sqrt(l);
        const double T[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                                {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                                {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
        memcpy(R, T, sizeof R);
    } else if (turn == 2) {
        const int i = any_of(3), j = (i + 1) % 3;
        R[i][i] = R[j][j] = R[j][i] = sqrt(0.5);
        R[i][j] = -sqrt(0.5);
    }
    for (int n = 0; n < b.n; ++n) {
        double y[3];
        for (int a = 0; a < 3; ++a) y[a] = R[a][0] * b.x[n][0] + R[a][1] * b.x[n][1] + R[a][2] * b.x[n][2];
        for (int a = 0; a < 3; ++a) b.x[n][a] = y[a] + centre[a];
    }
}

typedef enum body_kind {
    BALL,
    BOX,
    TORUS,
    PLATE,
    OCTAHEDRON,
    BOX_ON_PLANES,
    OCTAHEDRON_ON_PLANES,
    BOX_AT_45,
    PLATE_ON_PLANES,
    BALL_ON_PLANES,
    SHAKEN,
    KINDS
} body_kind;

static double on_half(int most)
{
    return 0.5 * (1 + any_of(most));
}

static void shake(void)
{
    const double most = pow(10.0, -16.0 + 10.0 * any());
    for (int n = 0; n < b.n; ++n)
        for (int a = 0; a < 3; ++a) b.x[n][a] += most * (any() - 0.5);
}

static void make_body(body_kind kind)
{
    const double half[3] = {0.1 + 2.5 * any(), 0.1 + 2.5 * any(), 0.1 + 2.5 * any()};
    const double on[3] = {on_half(9), on_half(9), on_half(9)},
                 diagonal[3] = {sqrt(0.5) * (1 + any_of(4)), sqrt(0.5) * (1 + any_of(4)), 1.0 + any_of(4)};
    const double thick = 0.01 * pow(300.0, any());
    const double thin[3] = {0.1 + 3.0 * any(), 0.1 + 3.0 * any(), 0.5 * thick},
                 flat[3] = {1.0 + any_of(4), 1.0 + any_of(4), 0.5 * thick};
    double centre[3] = {5.5 + any(), 5.5 + any(), 5.5 + any()};
    const bool on_planes = kind >= BOX_ON_PLANES;
    b.n = b.triangles = 0;
    for (int a = 0; a < 3 && on_planes; ++a) centre[a] = 6.0 + 0.5 * any_of(2);
    switch (kind) {
    case BALL: add_box(1 + any_of(8), half, 0.1 + 4.5 * any()); break;
    case BOX: add_box(1 + any_of(4), half, 0.0); break;
    case TORUS: add_torus(8 + any_of(16), 4 + any_of(12), 2.0 + 1.2 * any(), 0.05 + 1.5 * any()); break;
    case PLATE: add_box(1 + any_of(5), thin, 0.0); break;
    case OCTAHEDRON: add_octahedron(0.1 + 4.0 * any()); break;
    case BOX_ON_PLANES: add_box(1 + any_of(4), on, 0.0); break;
    case OCTAHEDRON_ON_PLANES: add_octahedron(0.5 * (1 + any_of(8))); break;
    case BOX_AT_45: add_box(1 + any_of(3), diagonal, 0.0); break;
    case PLATE_ON_PLANES:
        centre[2] = 6.0 + (any() < 0.5 ? 0.5 : -0.5) * thick;
        add_box(1 + any_of(4), flat, 0.0);
        break;
    case BALL_ON_PLANES: add_box(2 * (1 + any_of(3)), half, 0.5 * (1 + any_of(9))); break;
    case SHAKEN:
        if (any() < 0.5)
            add_box(1 + any_of(4), on, 0.0);
        else
            add_octahedron(0.5 * (1 + any_of(8)));
        break;
    case KINDS: break;
    }
    place(!on_planes ? 1 : kind == BOX_AT_45 ? 2 : 0, centre);
    if (kind == SHAKEN) shake();
}

/* ---- what they cut ---- */

static void make_mesh(mesh *m, context *ctx)
{
    mesh_spec spec = {.dim = 3, .lower = {-0.3, 0.1, 0.0}};
    for (int a = 0; a < 3; ++a) {
        spec.cell[a] = cell_size[a];
        spec.upper[a] = spec.lower[a] + CELLS * cell_size[a];
    }
    check_ok(ctx, mesh_init(m, ctx, &spec));
}

/* The body as a boundary: of the gas about it, or in it. */
static void lay(cut_surface *c, context *ctx, bool inside, const unsigned char *rim)
{
    check_ok(ctx, cut_reserve(c, b.n, 0));
    check_ok(ctx, cut_reserve_triangles(c, b.triangles));
    for (int n = 0; n < b.n; ++n) {
        c->vertex[n].point = n;
        for (int a = 0; a < 3; ++a) c->vertex[n].x[a] = c->mesh->lower[a] + b.x[n][a] * c->mesh->h[a];
    }
    for (int n = 0; n < b.triangles; ++n) {
        const int *v = b.triangle[n];
        c->triangle[n] = (cut_triangle){{v[0], inside ? v[1] : v[2], inside ? v[2] : v[1]}, rim ? rim[n] : 0};
    }
}

/* Volume and first moments (in cells) within the triangles, by tetrahedra; over surfaces that rims end, of what lies below axis 2. */
static void polyhedron(double out[4])
{
    static const double origin[3] = {6.0, 6.0, 6.0};
    memset(out, 0, 4 * sizeof *out);
    for (int n = 0; n < b.triangles; ++n) {
        double p[3][3], c[3], volume = 0.0;
        for (int k = 0; k < 3; ++k)
            for (int a = 0; a < 3; ++a) p[k][a] = b.x[b.triangle[n][k]][a] - origin[a];
        for (int a = 0; a < 3; ++a) {
            const int e = (a + 1) % 3, f = (a + 2) % 3;
            c[a] = p[1][e] * p[2][f] - p[1][f] * p[2][e];
            volume += p[0][a] * c[a] / 6.0;
        }
        out[0] += volume;
        for (int a = 0; a < 3; ++a) out[1 + a] += volume * 0.25 * (p[0][a] + p[1][a] + p[2][a]);
    }
    for (int a = 0; a < 3; ++a) out[1 + a] += origin[a] * out[0];
}

/* The same of all cells. */
static void enclosed_moments(const cut_surface *c, double out[4])
{
    memset(out, 0, 4 * sizeof *out);
    for (int k = 0; k < CELLS; ++k)
        for (int j = 0; j < CELLS; ++j)
            for (int i = 0; i < CELLS; ++i) {
                const int cell[3] = {i, j, k};
                const double open = cut_open(c, cell);
                out[0] += open;
                for (int a = 0; a < 3; ++a)
                    out[1 + a] += open * (cell[a] + 0.5) + cut_moment(c, cell, a) / c->mesh->h[a];
            }
}

typedef struct worst {
    double closure, face, volume, moment, place, force;
} worst;

static void lift(double *most, double value)
{
    if (!(value <= *most)) *most = value;
}

/* Areas (in faces) of faces and pieces of each cut cell. */
static void look_at_cells(const cut_surface *c, worst *w)
{
    const mesh *m = c->mesh;
    double(*area)[3] = calloc((size_t)c->n_cells + 1, sizeof *area), sum[3] = {0.0};
    assert_non_null(area);
    for (int k = 0; k < c->n_pieces; ++k) {
        const cut_piece *q = &c->piece[k];
        for (int a = 0; a < 3; ++a) {
            const double from = (cut_at_middle(c, q, a) - m->lower[a]) / m->h[a] - c->cell[q->cell].cell[a];
            lift(&w->place, fmax(-from, from - 1.0));
            area[q->cell][a] += q->area[a] * m->h[a] / mesh_cell_volume(m, 0);
            sum[a] += q->area[a] * m->h[a] / mesh_cell_volume(m, 0);
        }
    }
    for (int k = 0; k < c->n_cells; ++k)
        for (int a = 0; a < 3; ++a)
            lift(&w->closure, fabs(c->cell[k].face[a][SIDE_UPPER] - c->cell[k].face[a][SIDE_LOWER] + area[k][a]));
    for (int a = 0; a < 3; ++a) lift(&w->force, fabs(sum[a]));
    free(area);
}

static void look_at_faces(const cut_surface *c, worst *w)
{
    for (int n = 0; n < CELLS * CELLS * CELLS; ++n) {
        const int cell[3] = {n % CELLS, n / CELLS % CELLS, n / CELLS / CELLS};
        for (int a = 0; a < 3; ++a) {
            int next[3] = {cell[0], cell[1], cell[2]};
            if (++next[a] == CELLS) continue;
            lift(&w->face, fabs(cut_face(c, cell, a, SIDE_UPPER) - cut_face(c, next, a, SIDE_LOWER)));
        }
    }
}

static void look(const cut_surface *c, bool inside, worst *w)
{
    double solid[4], gas[4];
    polyhedron(solid);
    enclosed_moments(c, gas);
    for (int k = 0; k < 4; ++k) {
        const double all = (k == 0 ? 1.0 : 0.5 * CELLS) * CELLS * CELLS * CELLS;
        lift(k == 0 ? &w->volume : &w->moment, fabs(gas[k] - (inside ? solid[k] : all - solid[k])));
    }
    look_at_cells(c, w);
    look_at_faces(c, w);
}

static int placements(void)
{
    const char *asked = getenv("FLOE_PLACEMENTS");
    return asked ? atoi(asked) : 250;
}

static void test_bodies(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    worst w = {.closure = 0.0};
    make_mesh(&m, ctx);
    check_ok(ctx, cut_create(&c, ctx, &m));
    for (int kind = 0; kind < KINDS; ++kind) {
        state = 88172645463325252u + 1000003u * (unsigned)kind;
        for (int k = 0; k < placements(); ++k) {
            make_body(kind);
            lay(&c, ctx, k % 2, NULL);
            check_ok(ctx, cut_find(&c));
            look(&c, k % 2, &w);
            if (w.volume < 1e-7 && w.face < 1e-9 && w.closure < 1e-9) continue;
            print_error("kind %d, place %d: volume %g, face %g, closure %g\n", kind, k, w.volume, w.face, w.closure);
            assert_true(false);
        }
    }
    if (getenv("FLOE_TELL"))
        printf("closure %g face %g volume %g moment %g place %g force %g\n", w.closure, w.face, w.volume, w.moment,
               w.place, w.force);
    assert_true(w.closure < 1e-12 && w.face < 1e-12);
    assert_true(w.volume < 1e-8 && w.moment < 1e-7); /* on planes within 1e-11 of a cell they lie on them */
    assert_true(w.place < 1e-9 && w.force < 1e-11);
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* A surface over the whole mesh, from side to side, its vertices at any height or all on planes: what lies below it is open, or what lies above. Bodies
 * turned about the diagonal, so that it ends on each pair of sides. */
static void make_sheet(int m, int axis, int kind, unsigned char *rim)
{
    b.n = b.triangles = 0;
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= m; ++i) {
            const double z = kind == 0 ? 1.0 + 10.0 * any() : kind == 1 ? 1.0 + any_of(10) : 6.0;
            const double x[3] = {CELLS * (double)i / m, CELLS * (double)j / m, z};
            add_vertex(x[(3 - axis) % 3], x[(4 - axis) % 3], x[(5 - axis) % 3]);
        }
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i) {
            const int at = j * (m + 1) + i;
            rim[b.triangles] = (unsigned char)((j == 0 ? 1 : 0) | (i == m - 1 ? 2 : 0));
            rim[b.triangles + 1] = (unsigned char)((j == m - 1 ? 2 : 0) | (i == 0 ? 4 : 0));
            add_quad(at, at + 1, at + m + 2, at + m + 1);
        }
}

/* Rims of the sheet as it is laid, inside (`below`) or not: sides run backwards where the corners do. */
static void set_rims(cut_surface *c, bool below, const unsigned char *rim)
{
    for (int k = 0; k < b.triangles; ++k)
        c->triangle[k].rim = below ? rim[k] : (unsigned char)((rim[k] & 2) | (rim[k] & 1) << 2 | (rim[k] & 4) >> 2);
}

/* Below it (in cells), by prisms. */
static double below_sheet(int axis)
{
    double sum = 0.0;
    const int up = (axis + 2) % 3, e = (up + 1) % 3, f = (up + 2) % 3;
    for (int n = 0; n < b.triangles; ++n) {
        const double *p = b.x[b.triangle[n][0]], *q = b.x[b.triangle[n][1]], *r = b.x[b.triangle[n][2]];
        sum += 0.5 * ((q[e] - p[e]) * (r[f] - p[f]) - (q[f] - p[f]) * (r[e] - p[e])) * (p[up] + q[up] + r[up]) / 3.0;
    }
    return sum;
}

static void test_sides(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    static unsigned char rim[2 * MOST];
    make_mesh(&m, ctx);
    check_ok(ctx, cut_create(&c, ctx, &m));
    state = 88172645463325252u;
    for (int n = 0; n < placements(); ++n) {
        worst w = {.closure = 0.0};
        double gas[4];
        const int axis = n % 3;
        const bool below = n / 9 % 2;
        make_sheet(1 + any_of(20), axis, n / 3 % 3, rim);
        lay(&c, ctx, below, NULL);
        set_rims(&c, below, rim);
        check_ok(ctx, cut_find(&c));
        enclosed_moments(&c, gas);
        const double under = below_sheet(axis);
        check_close(gas[0], below ? under : CELLS * CELLS * CELLS - under, 1e-8);
        look_at_cells(&c, &w);
        look_at_faces(&c, &w);
        assert_true(w.closure < 1e-12 && w.face < 1e-12 && w.place < 1e-9);
    }
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* A level sheet: shares and moments of its cells; on a plane of the mesh it bounds the cells of the gas, whole, and no others. */
static void test_level(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    static unsigned char rim[2 * MOST];
    make_mesh(&m, ctx);
    check_ok(ctx, cut_create(&c, ctx, &m));
    for (int n = 0; n < 12; ++n) {
        const int axis = n % 3, up = (axis + 2) % 3;
        const bool below = n / 3 % 2, on_plane = n >= 6;
        const double share = on_plane ? 0.0 : 0.3;
        int cell[3] = {4, 7, 5}, beside;
        make_sheet(3, axis, 2, rim);
        for (int v = 0; v < b.n; ++v) b.x[v][up] += share;
        lay(&c, ctx, below, NULL);
        set_rims(&c, below, rim);
        check_ok(ctx, cut_find(&c));
        cell[up] = on_plane && below ? 5 : 6;
        beside = on_plane ? (below ? 6 : 5) : 7;
        check_close(cut_open(&c, cell), on_plane ? 1.0 : below ? share : 1.0 - share, 1e-13);
        check_close(cut_moment(&c, cell, up) / m.h[up], on_plane ? 0.0 : below ? -0.105 : 0.105, 1e-13);
        check_close(cut_face(&c, cell, up, below ? SIDE_UPPER : SIDE_LOWER), 0.0, 1e-13);
        assert_true(c.at[cut_index(&m, cell)] >= 0);
        assert_int_equal(c.n_cells, CELLS * CELLS);
        cell[up] = beside;
        assert_int_equal(c.at[cut_index(&m, cell)], on_plane || below ? CUT_OUTSIDE : CUT_INSIDE);
    }
    cut_destroy(&c);
    context_destroy(&ctx);
}

static void test_refused(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    bool thin;
    double x[3];
    const double half[3] = {2.2, 2.2, 2.2}, flat[3] = {2.2, 2.2, 0.3}, middle[3] = {6.1, 6.2, 6.37};
    make_mesh(&m, ctx);
    check_ok(ctx, cut_create(&c, ctx, &m));
    b.n = b.triangles = 0;
    add_box(2, half, 0.0);
    place(0, middle);
    add_octahedron(2.0); /* about a corner of the mesh, which it leaves */
    for (int n = b.n - 6; n < b.n; ++n)
        for (int a = 0; a < 3; ++a) b.x[n][a] += 8.0;
    lay(&c, ctx, false, NULL); /* they cross */
    check_fails(ctx, cut_find(&c), FLOE_RETRY);
    unsigned char rim[2 * MOST] = {0};
    b.n = b.triangles = 0;
    add_box(2, half, 0.0);
    place(0, middle);
    b.triangles--;
    rim[b.triangles - 1] = 7;
    lay(&c, ctx, false, rim); /* ends inside */
    check_fails(ctx, cut_find(&c), FLOE_BAD_INPUT);
    for (int n = 0; n < 3; ++n) { /* gas on both sides of a plate; a block, its mirror image of gas */
        b.n = b.triangles = 0;
        add_box(3, n == 0 ? flat : half, 0.0);
        place(0, middle);
        lay(&c, ctx, n == 2, NULL);
        check_ok(ctx, cut_find(&c));
        check_ok(ctx, cut_find_thin(&c, &thin, x));
        assert_int_equal(thin, n == 0);
    }
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* A ball within a cell is gas, or all but it is; moved, it is as if it had been laid there. */
static void test_in_a_cell(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c, next;
    const double none[3] = {0.0}, middle[3] = {6.5, 6.4, 6.6};
    double solid[4], gas[4], velocity[3 * 100];
    make_mesh(&m, ctx);
    check_ok(ctx, cut_create(&c, ctx, &m));
    check_ok(ctx, cut_create(&next, ctx, &m));
    for (int inside = 0; inside < 2; ++inside) {
        b.n = b.triangles = 0;
        add_box(2, none, 0.3);
        place(0, middle);
        polyhedron(solid);
        lay(&c, ctx, inside, NULL);
        check_ok(ctx, cut_find(&c));
        enclosed_moments(&c, gas);
        check_close(gas[0], inside ? solid[0] : CELLS * CELLS * CELLS - solid[0], 1e-10);
        for (int k = 0; k < 3 * b.n; ++k) velocity[k] = 1.0 + k % 3;
        check_ok(ctx, cut_ahead(&c, velocity, 0.03, &next));
        enclosed_moments(&next, gas);
        check_close(gas[0], inside ? solid[0] : CELLS * CELLS * CELLS - solid[0], 1e-10);
        for (int a = 0; a < 3; ++a) check_close(next.vertex[7].x[a] - c.vertex[7].x[a], 0.03 * (1.0 + a), 1e-15);
    }
    cut_destroy(&c);
    cut_destroy(&next);
    context_destroy(&ctx);
}

/* A body that only touches a side may leave it: what is there is no end of its surface. */
static void test_leaves_side(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    mesh m;
    cut_surface c, next;
    const double centre[3] = {2.0, 4.3, 4.6};
    double before[4], after[4], velocity[3 * 6] = {0.0};
    make_mesh(&m, ctx);
    check_ok(ctx, cut_create(&c, ctx, &m));
    check_ok(ctx, cut_create(&next, ctx, &m));
    b.n = b.triangles = 0;
    add_octahedron(2.0);
    place(0, centre);
    lay(&c, ctx, false, NULL);
    check_true(c.vertex[0].x[0] == m.lower[0]);
    check_ok(ctx, cut_find(&c));
    enclosed_moments(&c, before);
    for (int k = 0; k < b.n; ++k) velocity[3 * k] = 1.0;
    check_ok(ctx, cut_ahead(&c, velocity, 0.4 * m.h[0], &next));
    enclosed_moments(&next, after);
    check_close(next.vertex[0].x[0], m.lower[0] + 0.4 * m.h[0], 1e-15);
    check_close(after[0], before[0], 1e-10);
    cut_destroy(&c);
    cut_destroy(&next);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bodies),  cmocka_unit_test(test_sides),     cmocka_unit_test(test_level),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_in_a_cell), cmocka_unit_test(test_leaves_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

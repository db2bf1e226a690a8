/* Cells that a line cuts: shares add up to what the line encloses, every cell's areas close, degenerate lines are no exception. */
#include "check.h"

#include "embedded/cut.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static bool is_thin(const cut_surface *c, double x[3])
{
    bool thin;
    check_ok(c->ctx, cut_find_thin(c, &thin, x));
    return thin;
}

/* Cells higher than they are wide where they need not lie on the test's own lattice: what takes the one for the other is seen. */
static void make_mesh(mesh *m, context *ctx, mesh_geometry geometry, double h)
{
    const mesh_spec spec = {.dim = 2, .geometry = geometry, .upper = {1.0, 1.0}, .cell = {h, h == 0.1 ? 0.125 : h}};
    check_ok(ctx, mesh_init(m, ctx, &spec));
}

static void arc(cut_surface *c, context *ctx, int n, double radius, double from, double to, const double centre[2])
{
    const bool closed = fabs(to - from) > 6.28;
    check_ok(ctx, cut_reserve(c, n, 1));
    c->chain[0] = (cut_chain){0, n, closed, 0};
    for (int k = 0; k < n; ++k) {
        const double angle = from + (to - from) * k / (closed ? n : n - 1);
        c->vertex[k] = (cut_vertex){{centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)}, k, 0};
    }
}

/* What a closed polygon encloses, per metre of depth or per radian; an open line is closed along the sides through `corner`. */
static double enclosed(const cut_surface *c, const double corner[2])
{
    const bool radial = c->mesh->geometry == MESH_AXISYMMETRIC;
    double sum = 0.0;
    for (int k = 0; k < c->n_vertices + !c->chain[0].closed; ++k) {
        const double *a = k < c->n_vertices ? c->vertex[k].x : corner;
        const double *b = k + 1 < c->n_vertices                      ? c->vertex[k + 1].x
                          : c->chain[0].closed || k == c->n_vertices ? c->vertex[0].x
                                                                     : corner;
        const double mean = radial ? (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 6.0 : 0.5 * (a[0] + b[0]);
        sum += mean * (b[1] - a[1]);
    }
    return sum;
}

static double enclosed_volume(const cut_surface *c)
{
    double sum = 0.0;
    for (int j = 0; j < c->mesh->n[1]; ++j)
        for (int i = 0; i < c->mesh->n[0]; ++i)
            sum += cut_open(c, (const int[]){i, j, 0}) * mesh_cell_volume(c->mesh, i);
    return sum;
}

/* First moments along the axes of the open parts of cells, and of what a line encloses (as in `enclosed`). */
static double first_moment(const cut_surface *c, int axis)
{
    double sum = 0.0;
    for (int j = 0; j < c->mesh->n[1]; ++j)
        for (int i = 0; i < c->mesh->n[0]; ++i) {
            const int cell[3] = {i, j};
            sum += mesh_cell_volume(c->mesh, i) *
                   (cut_open(c, cell) * mesh_centre(c->mesh, axis, cell[axis]) + cut_moment(c, cell, axis));
        }
    return sum;
}

static double enclosed_moment(const cut_surface *c, const double corner[2], int axis)
{
    const bool radial = c->mesh->geometry == MESH_AXISYMMETRIC;
    double sum = 0.0;
    for (int k = 0; k < c->n_vertices + !c->chain[0].closed; ++k) {
        const double *a = k < c->n_vertices ? c->vertex[k].x : corner;
        const double *b = k + 1 < c->n_vertices                      ? c->vertex[k + 1].x
                          : c->chain[0].closed || k == c->n_vertices ? c->vertex[0].x
                                                                     : corner;
        for (int q = 0; q < 3; ++q) {
            const double x = a[0] + 0.5 * q * (b[0] - a[0]), y = a[1] + 0.5 * q * (b[1] - a[1]);
            sum += (q == 1 ? 4.0 : 1.0) / 6.0 * (b[1] - a[1]) * (axis == 0 || radial ? 0.5 * x * x : x) *
                   (axis == 0 ? 1.0 : y);
        }
    }
    return sum;
}

/* Axial areas of the open faces and of the pieces of each cell add up to nothing; in the plane the others too. */
static void check_closed_to(const cut_surface *c, double tolerance)
{
    const bool radial = c->mesh->geometry == MESH_AXISYMMETRIC;
    for (int k = 0; k < c->n_cells; ++k) {
        const cut_cell *cell = &c->cell[k];
        double sum[2] = {0.0, 0.0};
        for (int f = 0; f < 4; ++f)
            sum[f / 2] += (f % 2 ? 1.0 : -1.0) * cell->face[f / 2][f % 2] *
                          mesh_face_area(c->mesh, f / 2, cell->cell[0] + (f == SIDE_UPPER));
        for (int n = 0; n < c->n_pieces; ++n)
            for (int a = 0; a < 2 && c->piece[n].cell == k; ++a) sum[a] += c->piece[n].area[a];
        if (!radial) check_close(sum[0], 0.0, tolerance);
        check_close(sum[1], 0.0, tolerance);
    }
}

static void check_closed(const cut_surface *c)
{
    check_closed_to(c, 1e-15);
}

static void check_line(cut_surface *c, context *ctx, const double corner[2])
{
    check_ok(ctx, cut_find(c));
    check_close(enclosed_volume(c), enclosed(c, corner), 1e-14);
    for (int a = c->mesh->geometry == MESH_AXISYMMETRIC; a < 2; ++a)
        check_close(first_moment(c, a), enclosed_moment(c, corner, a), 1e-14);
    check_closed(c);
    for (int j = 0; j < c->mesh->n[1]; ++j)
        for (int i = 0; i + 1 < c->mesh->n[0]; ++i) /* both cells see the same face */
            check_close(cut_face(c, (const int[]){i, j, 0}, 0, SIDE_UPPER),
                        cut_face(c, (const int[]){i + 1, j, 0}, 0, SIDE_LOWER), 0.0);
}

/* A mesh, and a surface to lay into it. */
static context *begin_plane(mesh *m, cut_surface *c, double h)
{
    context *ctx = context_create();
    make_mesh(m, ctx, MESH_CARTESIAN, h);
    check_ok(ctx, cut_create(c, ctx, m));
    return ctx;
}

static void end_plane(context *ctx, cut_surface *c)
{
    cut_destroy(c);
    context_destroy(&ctx);
}

/* A quarter circle from side to side, plane and about an axis, coarse and fine: 7 vertices and 400. */
static void test_quarter(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    const mesh_geometry geometry[] = {MESH_CARTESIAN, MESH_AXISYMMETRIC};
    const int vertices[] = {7, 400};
    for (int g = 0; g < 2; ++g)
        for (int n = 0; n < 2; ++n) {
            mesh m;
            cut_surface c;
            make_mesh(&m, ctx, geometry[g], 0.1);
            check_ok(ctx, cut_create(&c, ctx, &m));
            arc(&c, ctx, vertices[n], 0.57, 0.0, 0.5 * pi, (const double[]){0.0, 0.0});
            c.vertex[vertices[n] - 1].x[0] = 0.0;
            check_line(&c, ctx, (const double[]){0.0, 0.0});
            cut_destroy(&c);
        }
    context_destroy(&ctx);
}

/* Closed lines: inside one cell, around many, and the other way round, which holds what is outside. */
static void test_closed(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.1);
    const double centre[] = {0.451, 0.552};
    arc(&c, ctx, 90, 0.33, 0.0, 2.0 * pi, centre);
    check_line(&c, ctx, centre);
    arc(&c, ctx, 20, 0.03, 0.0, 2.0 * pi, centre);
    check_line(&c, ctx, centre);
    arc(&c, ctx, 90, 0.33, 0.0, -2.0 * pi, centre);
    check_ok(ctx, cut_find(&c));
    check_close(enclosed_volume(&c), 1.0 + enclosed(&c, centre), 1e-14);
    check_closed(&c);
    arc(&c, ctx, 20, 0.03, 0.0, -2.0 * pi, centre);
    check_ok(ctx, cut_find(&c));
    check_close(enclosed_volume(&c), 1.0 + enclosed(&c, centre), 1e-14);
    end_plane(ctx, &c);
}

/* A line along a side of cells, on it but for round-off, and one through nodes. */
static void test_on_the_mesh(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.125);
    for (int kind = 0; kind < 3; ++kind) {
        check_ok(ctx, cut_reserve(&c, 9, 1));
        c.chain[0] = (cut_chain){0, 9, false, 0};
        for (int k = 0; k < 9; ++k) {
            const double y = 0.125 * k, wiggle = kind == 1 ? (k % 3 - 1) * 1e-16 : 0.0;
            c.vertex[k] = (cut_vertex){{kind == 2 ? 1.0 - y : 0.5 + wiggle, y}, k, 0};
        }
        check_ok(ctx, cut_find(&c));
        check_close(enclosed_volume(&c), 0.5, 1e-14);
        check_closed(&c);
        check_close(cut_open(&c, (const int[]){0, 0, 0}), 1.0, 0.0);
        check_close(cut_open(&c, (const int[]){7, 7, 0}), 0.0, 0.0);
    }
    end_plane(ctx, &c);
}

/* A square whose sides lie beside those of cells by round-off, within them and beyond, holds whole cells and no parts; further off it does not. */
static void test_off_the_mesh(void **unused)
{
    (void)unused;
    static const double corner[4][2] = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
    static const double beside[] = {1e-15, -1e-15, 1e-10, -1e-10}; /* m: of cells of 1/8 */
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.125);
    for (int n = 0; n < 4; ++n) {
        check_ok(ctx, cut_reserve(&c, 4, 1));
        c.chain[0] = (cut_chain){0, 4, true, 0};
        for (int k = 0; k < 4; ++k)
            for (int a = 0; a < 2; ++a) c.vertex[k].x[a] = 0.5 + (0.25 + beside[n]) * corner[k][a];
        check_ok(ctx, cut_find(&c));
        int parts = 0;
        for (int k = 0; k < c.n_cells; ++k) parts += c.cell[k].open != 0.0 && c.cell[k].open != 1.0;
        check_close(enclosed_volume(&c), 4.0 * (0.25 + beside[n]) * (0.25 + beside[n]), 1e-14);
        if (n < 2)
            assert_int_equal(parts, 0);
        else
            assert_true(parts >= 12); /* those within its sides, or those outside */
    }
    end_plane(ctx, &c);
}

/* Storage grows by half: many times what is needed would fill the memory that a large scene needs. */
static void test_storage(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.125);
    check_ok(ctx, cut_reserve(&c, 10000, 1));
    assert_true(c.capacity[0] > 10000 && c.capacity[0] < 16000);
    end_plane(ctx, &c);
}

/* The gas about a ring and in it: two chains, the surface of the ring on the right of both; even pressure pushes a whole one nowhere. */
static void test_two_chains(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    double push[2] = {0.0, 0.0};
    context *ctx = begin_plane(&m, &c, 0.1);
    check_ok(ctx, cut_reserve(&c, 130, 2));
    c.chain[0] = (cut_chain){0, 90, true, 0};
    c.chain[1] = (cut_chain){90, 40, false, 0};
    for (int k = 0; k < 90; ++k) {
        const double angle = -2.0 * pi * k / 90.0;
        c.vertex[k] = (cut_vertex){{0.7 + 0.21 * cos(angle), 0.7 + 0.21 * sin(angle)}, k, 0};
    }
    for (int k = 0; k < 40; ++k) {
        const double angle = 0.5 * pi * (1.0 - k / 39.0);
        c.vertex[90 + k] = (cut_vertex){{0.3 * cos(angle), 0.3 * sin(angle)}, 90 + k, 0};
    }
    c.vertex[90].x[0] = c.vertex[129].x[1] = 0.0;
    check_ok(ctx, cut_find(&c));
    check_closed(&c);
    check_close(enclosed_volume(&c),
                1.0 - 45.0 * 0.21 * 0.21 * sin(2.0 * pi / 90.0) - 19.5 * 0.3 * 0.3 * sin(0.5 * pi / 39.0), 1e-13);
    for (int n = 0; n < c.n_pieces; ++n) push[c.piece[n].vertex[0] >= 90] += c.piece[n].area[0];
    check_close(push[0], 0.0, 1e-15);
    check_close(push[1], -0.3, 1e-15); /* what it shows of itself along the axis */
    end_plane(ctx, &c);
}

/* A plate of half a cell, gas about it; one as thick as two cells; the gas between the two halves of a thick one. Lying and upright, from either side
 * on. */
static void check_thin(double h)
{
    context *ctx = context_create();
    mesh m;
    cut_surface c;
    double x[3];
    const double size = 10.0 * h; /* of the mesh */
    const mesh_spec spec = {.dim = 2, .upper = {size, size}, .cell = {h, h}};
    check_ok(ctx, mesh_init(&m, ctx, &spec));
    check_ok(ctx, cut_create(&c, ctx, &m));
    static const double low[] = {0.52, 0.52, 0.52}, high[] = {0.57, 0.72, 0.57};
    for (int k = 0; k < 3; ++k)
        for (int turned = 0; turned < 2; ++turned)
            for (int start = 0; start < 12; start += 6) {
                const double corner[4][2] = {{0.213, low[k]}, {0.213, high[k]}, {0.787, high[k]}, {0.787, low[k]}};
                check_ok(ctx, cut_reserve(&c, 12, 1));
                c.chain[0] = (cut_chain){0, 12, true, 0};
                for (int n = 0; n < 12; ++n) /* clockwise, three to a side; the last the other way: the gas is inside */
                    for (int a = 0; a < 2; ++a) {
                        const int at = (start + ((k == 2) != turned ? 11 - n : n)) % 12;
                        c.vertex[n].x[turned ? 1 - a : a] =
                            size *
                            (corner[at / 3][a] + (at % 3) / 3.0 * (corner[(at / 3 + 1) % 4][a] - corner[at / 3][a]));
                    }
                check_ok(ctx, cut_find(&c));
                assert_int_equal(is_thin(&c, x), k == 0);
            }
    cut_destroy(&c);
    context_destroy(&ctx);
}

/* A solid that ends in an edge between two sides, gas about it, the edge inside a cell: what is thinner than the cell there is its own corner, whichever
 * vertex of the line it is. A blade of the same two sides, cut off before they meet, is thin. */
static void test_edge(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    double x[3];
    context *ctx = begin_plane(&m, &c, 0.1);
    static const double edge[5][2] = {{0.55, 0.55}, {0.85, 0.35}, {0.95, 0.35}, {0.95, 0.75}, {0.85, 0.75}};
    static const double blade[8][2] = {{0.55, 0.54}, {0.65, 0.52}, {0.75, 0.45}, {0.95, 0.45},
                                       {0.95, 0.65}, {0.75, 0.65}, {0.65, 0.58}, {0.55, 0.56}};
    for (int first = 0; first < 8; ++first) {
        for (int whole = 0; whole < 2; ++whole) {
            const int count = whole ? 5 : 8;
            check_ok(ctx, cut_reserve(&c, count, 1));
            c.chain[0] = (cut_chain){0, count, true, 0};
            for (int k = 0; k < count; ++k) { /* clockwise: the gas is on the left */
                const double *at = whole ? edge[(first + count - k) % count] : blade[(first + count - k) % count];
                c.vertex[k] = (cut_vertex){{at[0], at[1]}, k, 0};
            }
            check_ok(ctx, cut_find(&c));
            assert_int_equal(is_thin(&c, x), !whole);
        }
    }
    end_plane(ctx, &c);
}

static void test_thin(void **unused)
{
    (void)unused;
    check_thin(0.1);
    check_thin(1e-7); /* what is thin is so in any unit of length */
    check_thin(1e4);
}

/* A square about many cells, and in one cell inside it, or outside, a small one that encloses what is enclosed already, or takes away what is not. */
static void test_enclosed_twice(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.1);
    static const double corner[4][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    for (int outside = 0; outside < 2; ++outside)
        for (int right = 0; right < 2; ++right)
            for (double size = 0.004; size < 0.05; size *= 3.0) {
                const double at = outside ? 0.02 : 0.42;
                check_ok(ctx, cut_reserve(&c, 8, 2));
                c.chain[0] = (cut_chain){0, 4, true, 0};
                c.chain[1] = (cut_chain){4, 4, true, 0};
                for (int k = 0; k < 4; ++k)
                    for (int a = 0; a < 2; ++a) {
                        c.vertex[k].x[a] = 0.213 + 0.574 * corner[k][a];
                        c.vertex[4 + k].x[a] = at + size * corner[outside != right ? 3 - k : k][a];
                    }
                if (right) {
                    check_ok(ctx, cut_find(&c));
                    check_close(enclosed_volume(&c), 0.574 * 0.574 + (outside ? 1.0 : -1.0) * size * size, 1e-14);
                } else {
                    check_fails(ctx, cut_find(&c), FLOE_RETRY);
                }
            }
    end_plane(ctx, &c);
}

static void test_refused(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.1);
    arc(&c, ctx, 9, 0.3, 0.0, 1.0, (const double[]){0.0, 0.0}); /* ends inside */
    check_fails(ctx, cut_find(&c), FLOE_BAD_INPUT);
    arc(&c, ctx, 9, 0.3, 1.0, 0.0, (const double[]){0.0, 0.0}); /* begins there */
    check_fails(ctx, cut_find(&c), FLOE_BAD_INPUT);
    const double eight[4][2] = {{0.25, 0.25}, {0.75, 0.75}, {0.25, 0.75}, {0.75, 0.25}};
    check_ok(ctx, cut_reserve(&c, 4, 1));
    c.chain[0] = (cut_chain){0, 4, true, 0};
    for (int k = 0; k < 4; ++k) c.vertex[k] = (cut_vertex){{eight[k][0], eight[k][1]}, k, 0};
    check_fails(ctx, cut_find(&c), FLOE_RETRY);
    end_plane(ctx, &c);
}

/* Two blocks, counterclockwise as the gas is on their right, the upper one let into the lower by `depth`, or both into the lowest side of the mesh by it. */
static void lay_blocks(cut_surface *c, context *ctx, double depth, bool on_side)
{
    static const double corner[4][2] = {{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}};
    check_ok(ctx, cut_reserve(c, 8, 2));
    for (int n = 0; n < 2; ++n) {
        const double lower[2] = {n == 0 ? 0.2 : 0.33, (n == 0 ? 0.2 : 0.5) - (n == 1 ? depth : 0.0)},
                     size[2] = {n == 0 ? 0.5 : 0.31, 0.3};
        c->chain[n] = (cut_chain){4 * n, 4, true, 0};
        for (int k = 0; k < 4; ++k) {
            c->vertex[4 * n + k] = (cut_vertex){.point = k, .body = n};
            for (int a = 0; a < 2; ++a) c->vertex[4 * n + k].x[a] = lower[a] + size[a] * corner[k][a];
            if (on_side) c->vertex[4 * n + k].x[1] -= 0.2 + depth;
        }
    }
}

/* Sum of the areas of pieces of a block along axis 1 that face up, or down. */
static double facing(const cut_surface *c, int body, double up)
{
    double sum = 0.0;
    for (int n = 0; n < c->n_pieces; ++n)
        if (c->vertex[c->piece[n].vertex[0]].body == body) sum += fmax(up * c->piece[n].area[1], 0.0);
    return sum;
}

/* Blocks that overlap a little in a face between cells, off it, and a side of the mesh: cells close, what is under another block
 * has no area, and all that is open is outside both. Where lines may not overlap, they are refused. */
static void test_overlap(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin_plane(&m, &c, 0.1);
    static const double depth[] = {1e-9, 1e-6, 1e-3, 8e-3};
    for (int side = 0; side < 2; ++side)
        for (int k = 0; k < 4; ++k) {
            c.overlap = 0.0;
            lay_blocks(&c, ctx, depth[k], side);
            if (k > 1 && !side) check_fails(ctx, cut_find(&c), FLOE_RETRY);
            c.overlap = 0.25;
            check_ok(ctx, cut_find(&c));
            check_closed_to(&c, depth[k] <= 1e-6 ? depth[k] : 1e-15); /* less than that is round-off */
            check_close(facing(&c, 0, -1.0) - facing(&c, 1, 1.0), 0.5 - 0.31, 10.0 * depth[k]);
            check_close(facing(&c, 1, -1.0), 0.31, 10.0 * depth[k]);
            if (!side) check_close(facing(&c, 1, 1.0), 0.0, 10.0 * depth[k]);
            if (!side) check_close(facing(&c, 0, 1.0), 0.5, 10.0 * depth[k]);
            for (int n = 0; n < c.n_cells; ++n) check_true(c.cell[n].open >= 0.0 && c.cell[n].open <= 1.0);
            check_close(enclosed_volume(&c), 1.0 - 0.15 - 0.093 + (side ? 0.5 : 0.31) * depth[k], 1.1 * depth[k]);
        }
    lay_blocks(&c, ctx, 0.05, false);
    check_fails(ctx, cut_find(&c), FLOE_RETRY);
    end_plane(ctx, &c);
}

/* Largest difference of the open shares of cells and faces, and of the places of the cells' openings, from those of a line that was moved by whole cells. */
static double largest_difference(const cut_surface *c, const cut_surface *moved, const int by[2])
{
    double most = 0.0;
    for (int k = 0; k < c->mesh->n[0] * c->mesh->n[1]; ++k) {
        const int at[3] = {k % c->mesh->n[0], k / c->mesh->n[0], 0};
        const int to[3] = {(at[0] + by[0]) % c->mesh->n[0], (at[1] + by[1]) % c->mesh->n[1], 0};
        most = fmax(most, fabs(cut_open(c, at) - cut_open(moved, to)));
        for (int a = 0; a < 2; ++a) {
            most = fmax(most, fabs(cut_moment(c, at, a) - cut_moment(moved, to, a)));
            for (int side = 0; side < 2; ++side)
                most = fmax(most, fabs(cut_face(c, at, a, side) - cut_face(moved, to, a, side)));
        }
    }
    return most;
}

/* The same line moved by every number of cells around one or both axes, its vertices brought around or not; one that ends on one periodic side, and does
 * not go on at the other. */
static void test_around(void **unused)
{
    (void)unused;
    const mesh_spec spec = {.dim = 2, .upper = {1.0, 1.0}, .cell = {0.1, 0.125}, .periodic = {true, true}};
    mesh m;
    cut_surface c, moved;
    context *ctx = context_create();
    check_ok(ctx, mesh_init(&m, ctx, &spec));
    check_ok(ctx, cut_create(&c, ctx, &m));
    check_ok(ctx, cut_create(&moved, ctx, &m));
    arc(&c, ctx, 47, 0.31, 0.0, -2.0 * pi, (const double[]){0.451, 0.552});
    check_ok(ctx, cut_find(&c));
    check_closed(&c);
    for (int k = 0; k < 80; ++k) {
        const int by[2] = {k % 10, k / 10};
        arc(&moved, ctx, 47, 0.31, 0.0, -2.0 * pi, (const double[]){0.451 + 0.1 * by[0], 0.552 + 0.125 * by[1]});
        check_ok(ctx, cut_find(&moved));
        check_closed(&moved);
        assert_int_equal(moved.n_cells, c.n_cells);
        check_close(largest_difference(&c, &moved, by), 0.0, 1e-13);
        double sum[2] = {0.0, 0.0};
        for (int n = 0; n < c.n_pieces; ++n) {
            sum[0] += c.piece[n].area[1] * cut_at_middle(&c, &c.piece[n], 1);
            sum[1] += moved.piece[n].area[1] *
                      (cut_at_middle(&moved, &moved.piece[n], 1) -
                       mesh_centre(&m, 1, moved.cell[moved.piece[n].cell].cell[1]) +
                       mesh_centre(&m, 1, (moved.cell[moved.piece[n].cell].cell[1] + 8 - by[1]) % 8));
        }
        check_close(sum[1], sum[0], 1e-13);
    }
    check_ok(ctx, cut_reserve(&c, 2, 1));
    c.chain[0] = (cut_chain){0, 2, false, 0};
    c.vertex[0] = (cut_vertex){{0.0, 0.31}, 0, 0};
    c.vertex[1] = (cut_vertex){{1.0, 0.34}, 1, 0};
    check_fails(ctx, cut_find(&c), FLOE_RETRY);
    cut_destroy(&c);
    cut_destroy(&moved);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quarter),    cmocka_unit_test(test_closed),       cmocka_unit_test(test_on_the_mesh),
        cmocka_unit_test(test_two_chains), cmocka_unit_test(test_thin),         cmocka_unit_test(test_enclosed_twice),
        cmocka_unit_test(test_refused),    cmocka_unit_test(test_off_the_mesh), cmocka_unit_test(test_storage),
        cmocka_unit_test(test_edge),       cmocka_unit_test(test_overlap),      cmocka_unit_test(test_around)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Corners of bodies, on faces of the mesh (src/embedded/cut_corner.c) and within cells (src/embedded/cut_shade.c): which cell has which piece, and what of the
 * faces is open. */
#include "check.h"

#include "embedded/cut.h"

#include <math.h>

/* A mesh of 16 by 16 cells, and a surface to lay into it. */
static context *begin(mesh *m, cut_surface *c)
{
    context *ctx = context_create();
    const mesh_spec spec = {.dim = 2, .upper = {1.0, 1.0}, .cell = {0.0625, 0.0625}};
    check_ok(ctx, mesh_init(m, ctx, &spec));
    check_ok(ctx, cut_create(c, ctx, m));
    c->overlap = 0.25;
    check_ok(ctx, cut_reserve(c, 4, 1));
    c->chain[0] = (cut_chain){0, 4, true, 0};
    return ctx;
}

static void end(context *ctx, cut_surface *c)
{
    cut_destroy(c);
    context_destroy(&ctx);
}

/* Areas of the open faces and of the pieces of each cell add up to nothing. */
static void check_all_closed(const cut_surface *c)
{
    for (int k = 0; k < c->n_cells; ++k)
        for (int a = 0; a < 2; ++a) {
            double sum = 0.0625 * (c->cell[k].face[a][SIDE_UPPER] - c->cell[k].face[a][SIDE_LOWER]);
            for (int n = 0; n < c->n_pieces; ++n)
                if (c->piece[n].cell == k) sum += c->piece[n].area[a];
            check_close(sum, 0.0, 1e-15);
        }
}

static double open_volume(const cut_surface *c)
{
    double sum = 0.0;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) sum += cut_open(c, (const int[]){i, j, 0}) * 0.0625 * 0.0625;
    return sum;
}

/* A block on faces of the mesh: no cell without volume is a passage around its corners, and all cells close. */
static void test_corner(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin(&m, &c);
    static const double corner[4][2] = {{0.25, 0.25}, {0.25, 0.75}, {0.5, 0.75}, {0.5, 0.25}};
    for (int k = 0; k < 4; ++k) c.vertex[k] = (cut_vertex){{corner[k][0], corner[k][1]}, k, 0};
    check_ok(ctx, cut_find(&c));
    check_all_closed(&c);
    check_close(open_volume(&c), 1.0 - 0.125, 1e-14);
    for (int k = 0; k < c.n_cells; ++k) {
        int open = 0;
        for (int f = 0; f < 4; ++f) open += c.cell[k].face[f / 2][f % 2] > 0.0;
        check_true(c.cell[k].open > 0.0 || open < 2);
    }
    for (int j = 0; j < m.n[1]; ++j)
        for (int i = 0; i + 1 < m.n[0]; ++i)
            for (int a = 0; a < 2; ++a) {
                const int next[3] = {i + (a == 0), j + (a == 1)};
                if (next[1] < m.n[1])
                    check_close(cut_face(&c, (const int[]){i, j, 0}, a, SIDE_UPPER), cut_face(&c, next, a, SIDE_LOWER),
                                0.0);
            }
    end(ctx, &c);
}

/* A block with two sides on faces of the mesh, whose end lies in the middle of cells: of the face beside a corner what the block covers is closed, on both sides
 * alike, and the cell at the end has no piece of the block's long sides. */
static void test_end_within(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin(&m, &c);
    static const double corner[4][2] = {{0.25, 0.25}, {0.25, 0.75}, {0.53125, 0.75}, {0.53125, 0.25}};
    for (int turned = 0; turned < 2; ++turned)
        for (int mirrored = 0; mirrored < 2; ++mirrored) {
            for (int k = 0; k < 4; ++k) { /* the gas stays on the right */
                const double *x = corner[turned != mirrored ? 3 - k : k];
                const double along = mirrored ? 1.0 - x[0] : x[0];
                c.vertex[k] = (cut_vertex){{turned ? x[1] : along, turned ? along : x[1]}, k, 0};
            }
            check_ok(ctx, cut_find(&c));
            check_all_closed(&c);
            check_close(open_volume(&c), 1.0 - 0.140625, 1e-14);
            for (int upper = 0; upper < 2; ++upper) {
                int in[3] = {mirrored ? 7 : 8, upper ? 11 : 4}, cell[3] = {0};
                for (int a = 0; a < 2; ++a) cell[turned ? 1 - a : a] = in[a];
                check_close(cut_open(&c, cell), 0.5, 1e-14);
                check_close(cut_face(&c, cell, 1 - turned, upper), 0.5, 1e-14);
                for (int n = 0; n < c.n_pieces; ++n)
                    if (c.cell[c.piece[n].cell].cell[0] == cell[0] && c.cell[c.piece[n].cell].cell[1] == cell[1])
                        check_close(c.piece[n].area[1 - turned], 0.0, 1e-15);
            }
        }
    end(ctx, &c);
}

/* What a piece that lies in one cell has of the area of another, along an axis. */
static double handed(const cut_surface *c, const int cell[3], int axis)
{
    double sum = 0.0;
    for (int n = 0; n < c->n_pieces; ++n) {
        const cut_cell *of = &c->cell[c->piece[n].cell];
        if (c->piece[n].through > 0 && of->cell[0] == cell[0] && of->cell[1] == cell[1]) sum += c->piece[n].area[axis];
    }
    return sum;
}

/* A block whose upper right corner lies within a cell, half way along and 0.92 of its height up, by theory 7.2: of the face beyond its end 0.92 (1 - 0.5) is
 * closed and belongs to the cell behind it, of that above it 0.5 (1 - 0.08). A round body has no corner. */
static void test_corner_within(void **unused)
{
    (void)unused;
    mesh m;
    cut_surface c;
    context *ctx = begin(&m, &c);
    static const double corner[4][2] = {{0.26, 0.26}, {0.26, 0.7450}, {0.53125, 0.7450}, {0.53125, 0.26}};
    static const int in[3] = {8, 11}, beyond[3] = {9, 11}, above[3] = {8, 12};
    for (int k = 0; k < 4; ++k) c.vertex[k] = (cut_vertex){{corner[k][0], corner[k][1]}, k, 0};
    check_ok(ctx, cut_find(&c));
    check_all_closed(&c);
    check_close(open_volume(&c), 1.0 - 0.27125 * 0.485, 1e-14);
    check_close(cut_open(&c, in), 0.54, 1e-13);
    check_close(cut_face(&c, in, 0, SIDE_UPPER), 0.54, 1e-13);
    check_close(cut_face(&c, beyond, 0, SIDE_LOWER), 0.54, 1e-13);
    check_close(cut_face(&c, in, 1, SIDE_UPPER), 0.54, 1e-13);
    check_close(cut_face(&c, above, 1, SIDE_LOWER), 0.54, 1e-13);
    check_close(handed(&c, beyond, 0), -0.46 * 0.0625, 1e-14);
    check_close(handed(&c, above, 1), -0.46 * 0.0625, 1e-14);
    end(ctx, &c);
}

static void test_round(void **unused)
{
    (void)unused;
    enum { N = 96 };
    mesh m;
    cut_surface c;
    context *ctx = begin(&m, &c);
    check_ok(ctx, cut_reserve(&c, N, 1));
    c.chain[0] = (cut_chain){0, N, true, 0};
    for (int k = 0; k < N; ++k) {
        const double angle = -2.0 * 3.14159265358979323846 * k / N;
        c.vertex[k] = (cut_vertex){{0.503 + 0.2 * cos(angle), 0.507 + 0.2 * sin(angle)}, k, 0};
    }
    check_ok(ctx, cut_find(&c));
    check_all_closed(&c);
    for (int n = 0; n < c.n_pieces; ++n) check_true(c.piece[n].through == 0);
    end(ctx, &c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_corner), cmocka_unit_test(test_end_within),
                                       cmocka_unit_test(test_corner_within), cmocka_unit_test(test_round)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

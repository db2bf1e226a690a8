/* Cholesky factors of matrices of nodes: two strips apart, some of whose unknowns are fixed, with more couplings along one axis; the work grows with the length of a strip, not with
 * its square, whichever way it lies. */
#include "check.h"

#include "base/memory.h"
#include "solve/skyline.h"

#include <math.h>
#include <stdlib.h>

enum { COMPONENTS = 2, WIDTH = 1, ARM = 1 };

static const bool no_ends[MESH_MAX_DIM] = {false};

/* Couplings of all components, weaker the farther, in a matrix that its diagonal dominates. */
static void fill(node_matrix *m)
{
    for (int row = 0; row < m->rows; ++row)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int other = m->row[m->column[row * m->slots + slot]];
            if (other == row && slot != m->slots / 2) continue;
            for (int c = 0; c < COMPONENTS; ++c)
                for (int c2 = 0; c2 < COMPONENTS; ++c2)
                    node_matrix_entries(m, row, c, c2)[slot] =
                        other == row ? (c == c2 ? 40.0 : 1.0) : sin(1.0 + row + other + c + c2);
        }
}

/* A matrix of the unknowns that are not within `gap` of the middle row or column. Owner: the caller. */
static node_matrix *strips(context *ctx, const int n[MESH_MAX_DIM], int axis, int gap)
{
    node_matrix *m;
    bool *part;
    const solve_grid g = solve_grid_make(2, n, no_ends);
    check_ok(ctx, node_matrix_create(&m, ctx, &g, COMPONENTS, WIDTH, ARM));
    check_ok(ctx, memory_new(ctx, &part, g.size, sizeof *part));
    for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
            const int at = axis == 0 ? j : i, middle = n[1 - axis] / 2;
            part[solve_index(&g, i, j, 0)] = abs(at - middle) >= gap;
        }
    check_ok(ctx, node_matrix_shape(m, part));
    fill(m);
    memory_free(ctx, &part);
    return m;
}

static void systems_are_solved(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    node_matrix *m = strips(ctx, (const int[]){17, 11, 1}, 0, 3);
    const size_t all = COMPONENTS * m->grid.size;
    skyline *s;
    double *x, *b;
    bool *fixed;
    check_ok(ctx, skyline_create(&s, ctx));
    check_ok(ctx, memory_new(ctx, &x, all, sizeof *x));
    check_ok(ctx, memory_new(ctx, &b, all, sizeof *b));
    check_ok(ctx, memory_new(ctx, &fixed, all, sizeof *fixed));
    for (int row = 0; row < m->rows; ++row)
        for (size_t c = 0; c < COMPONENTS; ++c) {
            const size_t at = c * m->grid.size + (size_t)m->place[row];
            fixed[at] = (row + (int)c) % 7 == 0;
            x[at] = fixed[at] ? 0.0 : cos(3.0 * row + (double)c);
        }
    node_matrix_apply(m, x, b);
    check_ok(ctx, skyline_shape(s, m, fixed));
    check_ok(ctx, skyline_factor(s, m));
    skyline_solve(s, b, b);
    for (size_t k = 0; k < all; ++k) check_close(b[k], x[k], 1e-14);
    memory_free(ctx, &x);
    memory_free(ctx, &b);
    memory_free(ctx, &fixed);
    skyline_destroy(&s);
    node_matrix_destroy(&m);
    context_destroy(&ctx);
}

static double work_of(const int n[MESH_MAX_DIM], int axis)
{
    context *ctx = context_create();
    node_matrix *m = strips(ctx, n, axis, 3);
    skyline *s;
    bool *fixed;
    check_ok(ctx, memory_new(ctx, &fixed, COMPONENTS * m->grid.size, sizeof *fixed));
    check_ok(ctx, skyline_create(&s, ctx));
    check_ok(ctx, skyline_shape(s, m, fixed));
    const double work = skyline_work(s);
    memory_free(ctx, &fixed);
    skyline_destroy(&s);
    node_matrix_destroy(&m);
    context_destroy(&ctx);
    return work;
}

static void work_follows_the_length(void **unused)
{
    (void)unused;
    const double along = work_of((const int[]){40, 11, 1}, 0), longer = work_of((const int[]){80, 11, 1}, 0),
                 across = work_of((const int[]){11, 40, 1}, 1);
    check_close_relative(longer, 2.0 * along, 0.1);
    check_close_relative(across, along, 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(systems_are_solved),
        cmocka_unit_test(work_follows_the_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

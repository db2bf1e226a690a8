/* Directions taken out of a matrix of nodes: against the same with dense vectors. */
#include "check.h"
#include "solve/node_matrix.h"

#include <math.h>
#include <string.h>

enum { SIDE = 5, COMPONENTS = 4, MOST = SIDE * SIDE * COMPONENTS * 4 };

/* A symmetric matrix of smooth entries between neighbours. */
static void fill(node_matrix *m)
{
    for (int row = 0; row < m->rows; ++row)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int place = m->column[(size_t)row * (size_t)m->slots + (size_t)slot];
            if (place == m->place[row] && slot != m->slots / 2) continue;
            for (int c = 0; c < COMPONENTS; ++c)
                for (int c2 = 0; c2 < COMPONENTS; ++c2) {
                    const int i = m->place[row] * COMPONENTS + c, j = place * COMPONENTS + c2;
                    node_matrix_entries(m, row, c, c2)[slot] = cos(0.3 * (i + j)) + (i == j ? 9.0 : 0.0);
                }
        }
}

static void project(const node_matrix *m, int place, int n, const double *q, double *x)
{
    for (int k = 0; k < n; ++k) {
        double part = 0.0;
        for (int c = 0; c < COMPONENTS; ++c)
            part += q[k * COMPONENTS + c] * x[(size_t)c * m->grid.size + (size_t)place];
        for (int c = 0; c < COMPONENTS; ++c)
            x[(size_t)c * m->grid.size + (size_t)place] -= part * q[k * COMPONENTS + c];
    }
}

static void directions_are_taken_out(void **unused)
{
    (void)unused;
    static const double q[2 * COMPONENTS] = {0.6, 0.0, -0.8, 0.0, 0.0, 1.0, 0.0, 0.0};
    const double stiffness = 7.0;
    for (int periodic = 0; periodic < 2; ++periodic) {
        context *ctx = context_create();
        const bool around[MESH_MAX_DIM] = {periodic == 1, false, false};
        const solve_grid g = solve_grid_make(2, (const int[]){SIDE, SIDE, 1}, around);
        node_matrix *whole, *taken;
        bool all[MOST];
        memset(all, 1, sizeof all);
        assert_true((size_t)COMPONENTS * g.size <= MOST);
        check_ok(ctx, node_matrix_create(&whole, ctx, &g, COMPONENTS, 1, 0));
        check_ok(ctx, node_matrix_create(&taken, ctx, &g, COMPONENTS, 1, 0));
        check_ok(ctx, node_matrix_shape(whole, all));
        check_ok(ctx, node_matrix_shape(taken, all));
        fill(whole);
        fill(taken);
        const int row = periodic ? 0 : SIDE + 1, place = taken->place[row];
        node_matrix_project(taken, row, 2, q, stiffness);
        double x[MOST] = {0.0}, wanted[MOST] = {0.0}, found[MOST] = {0.0}, free[MOST] = {0.0};
        for (int r = 0; r < whole->rows; ++r)
            for (int c = 0; c < COMPONENTS; ++c)
                x[(size_t)c * g.size + (size_t)whole->place[r]] = sin(1.0 + r + 5.0 * c);
        memcpy(free, x, sizeof free);
        project(whole, place, 2, q, free);
        node_matrix_apply(whole, free, wanted);
        project(whole, place, 2, q, wanted);
        for (size_t k = 0; k < MOST; ++k) wanted[k] += stiffness * (x[k] - free[k]);
        node_matrix_apply(taken, x, found);
        for (size_t k = 0; k < (size_t)COMPONENTS * g.size; ++k) check_close(found[k], wanted[k], 1e-12);
        node_matrix_destroy(&whole);
        node_matrix_destroy(&taken);
        context_destroy(&ctx);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(directions_are_taken_out)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Conjugate gradients with multigrid: against a dense factorisation, symmetry, threads, and iterations that do not grow with the
 * mesh for uniform and jumping coefficients, stretched cells and any number of cells. */
#include "check.h"

#include "base/memory.h"
#include "solve/cg.h"
#include "solve/multigrid.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifdef _OPENMP
#include <omp.h>
#endif

enum { MOST_ITERATIONS = 200 };

/* A system with its solver. */
typedef struct problem {
    context *ctx;
    solve_grid grid;
    multigrid *m;
    cg *c;
    double *b, *x;
} problem;

static void open_problem(problem *q, context *ctx, int dim, const int *n, const bool *periodic, const double *strength)
{
    *q = (problem){.ctx = ctx, .grid = solve_grid_make(dim, n, periodic)};
    check_ok(ctx, multigrid_of_cells(&q->m, ctx, &q->grid, strength));
    check_ok(ctx, cg_create(&q->c, ctx, &q->grid, 1, MOST_ITERATIONS));
    check_ok(ctx, memory_new(ctx, &q->b, q->grid.size, sizeof(double)));
    check_ok(ctx, memory_new(ctx, &q->x, q->grid.size, sizeof(double)));
}

static void close_problem(problem *q)
{
    multigrid_destroy(&q->m);
    cg_destroy(&q->c);
    memory_free(q->ctx, &q->b);
    memory_free(q->ctx, &q->x);
}

static ptrdiff_t at_row(const solve_grid *g, int row)
{
    return solve_index(g, row % g->n[0], row / g->n[0] % g->n[1], row / (g->n[0] * g->n[1]));
}

/* Whether the link below cell (index along the axis) is a wall. */
typedef enum side { WALL, OPEN } side;

/* Fills links by a density at every cell: 2/(rho + rho') times strength, as the pressure's are; walls below, `upper` above. */
static void fill_system(problem *q, const double *strength, double sink, side upper, double (*density)(const int *cell))
{
    const solve_grid *g = &q->grid;
    const link_system s = multigrid_links(q->m);
    int cell[3];
    for (cell[2] = 0; cell[2] < g->n[2]; ++cell[2])
        for (cell[1] = 0; cell[1] < g->n[1]; ++cell[1])
            for (cell[0] = 0; cell[0] < g->n[0]; ++cell[0]) {
                const ptrdiff_t at = solve_index(g, cell[0], cell[1], cell[2]);
                s.sink[at] = sink;
                for (int a = 0; a < g->dim; ++a) {
                    int other[3] = {cell[0], cell[1], cell[2]};
                    other[a] = cell[a] > 0 ? cell[a] - 1 : g->n[a] - 1;
                    const bool wall = cell[a] == 0 && !g->periodic[a];
                    s.link[a][at] = wall ? 0.0 : strength[a] * 2.0 / (density(cell) + density(other));
                    if (!g->periodic[a] && cell[a] == g->n[a] - 1)
                        s.link[a][at + g->stride[a]] = upper == OPEN ? strength[a] * 2.0 / density(cell) : 0.0;
                }
            }
    check_ok(q->ctx, multigrid_prepare(q->m));
}

static double uniform(const int *cell)
{
    (void)cell;
    return 1.0;
}
/* A block of 1e4 times the density, at an odd place. */
static double block_of_steel(const int *cell)
{
    return cell[0] > 5 && cell[0] < 17 && cell[1] > 3 && cell[1] < 12 ? 1e4 : 1.0;
}
static double scattered(const int *cell)
{
    uint64_t seed = (uint64_t)(cell[0] * 7919 + cell[1] * 104729 + cell[2] * 1299709 + 1);
    return pow(10.0, check_random(&seed, 0.0, 4.0));
}

static void fill_random(const problem *q, double *a, uint64_t seed)
{
    for (int row = 0; row < q->grid.n[0] * q->grid.n[1] * q->grid.n[2]; ++row)
        a[at_row(&q->grid, row)] = check_random(&seed, -1.0, 1.0);
}

static double max_norm(const problem *q, const double *a)
{
    double most = 0.0;
    for (int row = 0; row < q->grid.n[0] * q->grid.n[1] * q->grid.n[2]; ++row)
        most = fmax(most, fabs(a[at_row(&q->grid, row)]));
    return most;
}

/* Largest difference between CG's answer and that of the dense matrix that multigrid_apply makes column by column. */
static double against_dense(problem *q, double *asymmetry)
{
    const int size = q->grid.n[0] * q->grid.n[1] * q->grid.n[2];
    gsl_matrix *dense = gsl_matrix_alloc((size_t)size, (size_t)size);
    gsl_vector *b = gsl_vector_alloc((size_t)size);
    double *unit, *column, worst = 0.0;
    check_ok(q->ctx, memory_new(q->ctx, &unit, q->grid.size, sizeof(double)));
    check_ok(q->ctx, memory_new(q->ctx, &column, q->grid.size, sizeof(double)));
    for (int j = 0; j < size; ++j) {
        memset(unit, 0, q->grid.size * sizeof(double));
        unit[at_row(&q->grid, j)] = 1.0;
        multigrid_apply(q->m, unit, column);
        for (int i = 0; i < size; ++i) gsl_matrix_set(dense, (size_t)i, (size_t)j, column[at_row(&q->grid, i)]);
    }
    *asymmetry = 0.0;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < i; ++j)
            *asymmetry = fmax(*asymmetry, fabs(gsl_matrix_get(dense, (size_t)i, (size_t)j) -
                                               gsl_matrix_get(dense, (size_t)j, (size_t)i)));
    for (int i = 0; i < size; ++i) gsl_vector_set(b, (size_t)i, q->b[at_row(&q->grid, i)]);
    gsl_linalg_cholesky_decomp1(dense);
    gsl_linalg_cholesky_svx(dense, b);
    for (int i = 0; i < size; ++i) worst = fmax(worst, fabs(q->x[at_row(&q->grid, i)] - gsl_vector_get(b, (size_t)i)));
    gsl_matrix_free(dense);
    gsl_vector_free(b);
    memory_free(q->ctx, &unit);
    memory_free(q->ctx, &column);
    return worst;
}

static cg_result solve(problem *q, double tolerance)
{
    double *r;
    check_ok(q->ctx, memory_new(q->ctx, &r, q->grid.size, sizeof(double)));
    memcpy(r, q->b, q->grid.size * sizeof *r);
    const cg_system system = {multigrid_apply, multigrid_cycle, q->m, CG_WEIGHTED, NULL};
    const cg_result result = cg_solve_afresh(q->c, &system, tolerance, r, q->x);
    memory_free(q->ctx, &r);
    return result;
}

static void agrees_with_a_dense_matrix(void **state)
{
    static const struct {
        int dim, n[3];
        bool periodic[3];
        side upper;
        double (*density)(const int *);
    } cases[] = {
        {1, {17, 1, 1}, {false}, WALL, uniform},
        {1, {16, 1, 1}, {true}, WALL, scattered},
        {1, {13, 1, 1}, {true}, WALL, scattered},
        {1, {24, 1, 1}, {false}, OPEN, block_of_steel},
        {2, {20, 14, 1}, {false, false}, WALL, block_of_steel},
        {2, {11, 13, 1}, {true, false}, OPEN, scattered},
        {2, {12, 9, 1}, {true, true}, WALL, scattered},
        {3, {7, 6, 5}, {false, true, false}, WALL, scattered},
        {3, {8, 5, 4}, {false, false, false}, OPEN, uniform},
    };
    context *ctx = *state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        problem q;
        double asymmetry;
        const double strength[3] = {1.0, 0.7, 3.0};
        open_problem(&q, ctx, cases[k].dim, cases[k].n, cases[k].periodic, strength);
        fill_system(&q, strength, 1e-4, cases[k].upper, cases[k].density);
        fill_random(&q, q.b, k + 1);
        const cg_result r = solve(&q, 1e-11);
        const double off = against_dense(&q, &asymmetry);
        check_true(r.converged && r.residual <= 1e-11);
        /* the residual over the least eigenvalue, which is at least the sink */
        check_close(off, 0.0, 1e-11 / 1e-4);
        check_close(asymmetry, 0.0, 0.0);
        close_problem(&q);
    }
}

/* A cell without links and sink keeps 0, and the others do as without it. */
static void cells_may_take_no_part(void **state)
{
    problem q;
    const int n[3] = {9, 8, 1};
    const double strength[3] = {1.0, 1.0, 1.0};
    open_problem(&q, *state, 2, n, (const bool[3]){false}, strength);
    fill_system(&q, strength, 1e-3, WALL, uniform);
    const link_system s = multigrid_links(q.m);
    const ptrdiff_t out = solve_index(&q.grid, 4, 3, 0);
    s.sink[out] = 0.0;
    for (int a = 0; a < 2; ++a) s.link[a][out] = s.link[a][out + q.grid.stride[a]] = 0.0;
    check_ok(q.ctx, multigrid_prepare(q.m));
    fill_random(&q, q.b, 3);
    q.b[out] = 0.0;
    const cg_result r = solve(&q, 1e-10);
    check_true(r.converged && r.iterations < 20);
    check_close(q.x[out], 0.0, 0.0);
    close_problem(&q);
}

static double product(const problem *q, const double *x, const double *y)
{
    double sum = 0.0;
    for (int row = 0; row < q->grid.n[0] * q->grid.n[1] * q->grid.n[2]; ++row)
        sum += x[at_row(&q->grid, row)] * y[at_row(&q->grid, row)];
    return sum;
}

static void the_cycle_is_symmetric_and_positive(void **state)
{
    context *ctx = *state;
    problem q;
    const int n[3] = {37, 22, 1};
    const double strength[3] = {1.0, 9.0, 1.0};
    double *mx, *my;
    open_problem(&q, ctx, 2, n, (const bool[3]){true, false, false}, strength);
    fill_system(&q, strength, 1e-6, WALL, scattered);
    check_ok(ctx, memory_new(ctx, &mx, q.grid.size, sizeof(double)));
    check_ok(ctx, memory_new(ctx, &my, q.grid.size, sizeof(double)));
    for (uint64_t trial = 0; trial < 5; ++trial) {
        fill_random(&q, q.x, 2 * trial + 1);
        fill_random(&q, q.b, 2 * trial + 2);
        multigrid_cycle(q.m, q.x, mx);
        multigrid_cycle(q.m, q.b, my);
        const double scale = sqrt(product(&q, mx, mx) * product(&q, q.b, q.b));
        check_close(product(&q, mx, q.b), product(&q, my, q.x), 1e-12 * scale);
        check_true(product(&q, mx, q.x) > 0.0);
    }
    memory_free(ctx, &mx);
    memory_free(ctx, &my);
    close_problem(&q);
}

/* Iterations from a random residual down by 1e-8, at an acoustic CFL of 1000: the sink is 1e-6 of a link. */
static int iterations(context *ctx, int nx, int ny, const double *strength, double (*density)(const int *))
{
    problem q;
    open_problem(&q, ctx, 2, (const int[3]){nx, ny, 1}, (const bool[3]){false}, strength);
    fill_system(&q, strength, 1e-6, WALL, density);
    fill_random(&q, q.b, 5);
    const cg_result r = solve(&q, 1e-8 * max_norm(&q, q.b) * sqrt((double)nx * ny));
    check_true(r.converged);
    close_problem(&q);
    return r.iterations;
}

static double jump_mesh; /* cells along an axis of the mesh under test, for block_in_the_middle */
static double block_in_the_middle(const int *cell)
{
    const double x = (cell[0] + 0.5) / jump_mesh, y = (cell[1] + 0.5) / jump_mesh;
    return x > 0.3 && x < 0.62 && y > 0.2 && y < 0.71 ? 1e4 : 1.0;
}

static void iterations_do_not_grow_with_the_mesh(void **state)
{
    static const struct {
        const char *name;
        double strength[3];
        double (*density)(const int *);
        int cells, most; /* along an axis of the fine mesh; iterations there */
    } cases[] = {
        {"uniform", {1.0, 1.0, 1.0}, uniform, 512, 10},
        {"jump of 1e4", {1.0, 1.0, 1.0}, block_in_the_middle, 512, 12},
        {"cells 1 : 10", {100.0, 1.0, 1.0}, uniform, 331, 10},
        {"cells 3 : 1, jump of 1e4", {1.0, 9.0, 1.0}, block_in_the_middle, 331, 12},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        jump_mesh = 32.0;
        const int coarse = iterations(*state, 32, 32, cases[k].strength, cases[k].density);
        jump_mesh = cases[k].cells;
        const int fine = iterations(*state, cases[k].cells, cases[k].cells, cases[k].strength, cases[k].density);
        print_message("%s: %d iterations at 32^2, %d at %d^2\n", cases[k].name, coarse, fine, cases[k].cells);
        check_true(fine <= coarse + 2);
        check_true(fine <= cases[k].most);
    }
}

static void threads_do_not_change_a_bit(void **state)
{
#ifdef _OPENMP
    const int before = omp_get_max_threads();
    double *first = NULL;
    for (int threads = 1; threads <= 3; ++threads) {
        problem q;
        const double strength[3] = {1.0, 2.0, 1.0};
        omp_set_num_threads(threads);
        open_problem(&q, *state, 2, (const int[3]){131, 117, 1}, (const bool[3]){true, false, false}, strength);
        fill_system(&q, strength, 1e-5, WALL, scattered);
        fill_random(&q, q.b, 11);
        check_true(solve(&q, 1e-9).converged);
        if (!first) {
            check_ok(q.ctx, memory_new(q.ctx, &first, q.grid.size, sizeof(double)));
            memcpy(first, q.x, q.grid.size * sizeof(double));
        }
        check_true(memcmp(first, q.x, q.grid.size * sizeof(double)) == 0);
        close_problem(&q);
    }
    omp_set_num_threads(before);
    memory_free(*state, &first);
#else
    (void)state;
#endif
}

/* The weight of the norm, and more components than one, by a diagonal system. */
static void times_three(void *user, double *x, double *y)
{
    const solve_grid *g = user;
    for (size_t k = 0; k < 2 * g->size; ++k) y[k] = 3.0 * x[k];
}
static void leave(void *user, double *x, double *y)
{
    const solve_grid *g = user;
    memcpy(y, x, 2 * g->size * sizeof(double));
}

static void solves_for_several_components(void **state)
{
    context *ctx = *state;
    const solve_grid g = solve_grid_make(2, (const int[3]){6, 5, 1}, (const bool[3]){false});
    cg *c;
    double *b, *x;
    check_ok(ctx, cg_create(&c, ctx, &g, 2, 5));
    check_ok(ctx, memory_new(ctx, &b, 2 * g.size, sizeof(double)));
    check_ok(ctx, memory_new(ctx, &x, 2 * g.size, sizeof(double)));
    const ptrdiff_t first = solve_index(&g, 1, 2, 0), second = (ptrdiff_t)g.size + solve_index(&g, 5, 4, 0);
    b[first] = 6.0;
    b[second] = -9.0;
    const cg_system system = {times_three, leave, (void *)&g, CG_WEIGHTED, NULL};
    const cg_result r = cg_solve_afresh(c, &system, 1e-12, b, x);
    check_true(r.converged);
    check_close(x[first], 2.0, 1e-15);
    check_close(x[second], -3.0, 1e-15);
    cg_destroy(&c);
    memory_free(ctx, &b);
    memory_free(ctx, &x);
}

/* On a list of any length, from any x: second differences with ends that are fixed. */
enum { LONGEST_LIST = 300 };
static int list_length(const void *user)
{
    return *(const int *)user;
}
static void times_differences(void *user, double *x, double *y)
{
    const int n = list_length(user);
    for (int k = 0; k < n; ++k) y[k] = (2.0 + k % 7) * x[k] - (k > 0 ? x[k - 1] : 0.0) - (k + 1 < n ? x[k + 1] : 0.0);
}
static void over_diagonal(void *user, double *x, double *y)
{
    for (int k = 0; k < list_length(user); ++k) y[k] = x[k] / (2.0 + k % 7);
}

/* What is left is the residual of x, and its size is measured as it was asked for. */
static void improves_lists(void **state)
{
    context *ctx = *state;
    const int lengths[] = {3, LONGEST_LIST, 64, 65};
    const double tolerance = 1e-9;
    cg *c;
    const solve_grid empty = solve_grid_of_list(0);
    check_ok(ctx, cg_create(&c, ctx, &empty, 1, 500));
    for (int i = 0; i < 8; ++i) {
        const int n = lengths[i / 2];
        double b[LONGEST_LIST], x[LONGEST_LIST], r[LONGEST_LIST], Ax[LONGEST_LIST], left[LONGEST_LIST], square = 0.0;
        const cg_system system = {times_differences, over_diagonal, (void *)&n, i % 2 ? CG_PRECONDITIONED : CG_WEIGHTED,
                                  NULL};
        const solve_grid list = solve_grid_of_list(n);
        uint64_t seed = 3;
        for (int k = 0; k < n; ++k) {
            x[k] = check_random(&seed, -1.0, 1.0);
            b[k] = check_random(&seed, -1.0, 1.0);
        }
        times_differences((void *)&n, x, Ax);
        for (int k = 0; k < n; ++k) r[k] = b[k] - Ax[k];
        check_ok(ctx, cg_resize(c, &list, 1));
        const cg_result result = cg_solve(c, &system, tolerance, r, x);
        check_true(result.converged && result.residual <= tolerance && result.iterations > 1);
        times_differences((void *)&n, x, Ax);
        over_diagonal((void *)&n, r, left);
        for (int k = 0; k < n; ++k) {
            check_close(r[k], b[k] - Ax[k], 1e-14);
            square += r[k] * (i % 2 ? left[k] : r[k]);
        }
        check_close(sqrt(square), result.residual, 1e-20);
    }
    cg_destroy(&c);
}

static void memory_may_run_out(void **state)
{
    context *ctx = *state;
    const solve_grid g = solve_grid_make(1, (const int[3]){9, 1, 1}, (const bool[3]){false});
    const double strength[3] = {1.0, 1.0, 1.0};
    for (uint64_t n = 1; n < 200; ++n) {
        multigrid *m = NULL;
        cg *c = NULL;
        memory_inject_failure(ctx, n);
        const floe_status first = multigrid_of_cells(&m, ctx, &g, strength);
        const floe_status second = first == FLOE_OK ? cg_create(&c, ctx, &g, 1, 3) : first;
        memory_inject_failure(ctx, 0);
        context_clear(ctx);
        multigrid_destroy(&m);
        cg_destroy(&c);
        if (second == FLOE_OK) return;
        check_true(second == FLOE_NO_MEMORY);
    }
    check_true(false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_a_dense_matrix),
        cmocka_unit_test(improves_lists),
        cmocka_unit_test(cells_may_take_no_part),
        cmocka_unit_test(the_cycle_is_symmetric_and_positive),
        cmocka_unit_test(iterations_do_not_grow_with_the_mesh),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(solves_for_several_components),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, check_make_context, check_drop_context);
}

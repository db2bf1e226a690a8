/* Hestenes and Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409, with a preconditioner. */
#include "solve/cg.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { LANES = 8 }; /* partial sums that are kept apart, so that the loop vectorises without reordering any addition */

struct cg {
    context *ctx;
    solve_grid grid;
    int components, most_iterations;
    size_t reserved;                /* entries of the arrays */
    double *z, *p, *Ap, *tile_sums; /* owned */
};

static int tiles_along(const solve_grid *g, int axis)
{
    return (g->n[axis] + g->tile[axis] - 1) / g->tile[axis];
}

static int count_tiles(const solve_grid *g)
{
    return tiles_along(g, 0) * tiles_along(g, 1) * tiles_along(g, 2);
}

floe_status cg_resize(cg *c, const solve_grid *g, int components)
{
    const size_t size = (size_t)components * g->size;
    c->grid = *g;
    c->components = components;
    if (size <= c->reserved && c->z) return FLOE_OK;
    TRY(memory_resize(c->ctx, &c->z, size, sizeof(double)));
    TRY(memory_resize(c->ctx, &c->p, size, sizeof(double)));
    TRY(memory_resize(c->ctx, &c->Ap, size, sizeof(double)));
    TRY(memory_resize(c->ctx, &c->tile_sums, size, sizeof(double)));
    c->reserved = size;
    return FLOE_OK;
}

floe_status cg_create(cg **out, context *ctx, const solve_grid *g, int components, int most_iterations)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    **out = (cg){.ctx = ctx, .most_iterations = most_iterations};
    const floe_status status = cg_resize(*out, g, components);
    if (status != FLOE_OK) cg_destroy(out);
    return status;
}

void cg_destroy(cg **c)
{
    if (!c || !*c) return;
    context *ctx = (*c)->ctx;
    memory_free(ctx, &(*c)->z);
    memory_free(ctx, &(*c)->p);
    memory_free(ctx, &(*c)->Ap);
    memory_free(ctx, &(*c)->tile_sums);
    memory_free(ctx, c);
}

/* Sum of x y over tile t of one component. */
static double tile_dot(const solve_grid *g, const double *x, const double *y, int t)
{
    const int tx = tiles_along(g, 0), ty = tiles_along(g, 1);
    const int lo[MESH_MAX_DIM] = {t % tx * g->tile[0], t / tx % ty * g->tile[1], t / (tx * ty) * g->tile[2]};
    double lane[LANES] = {0.0}, sum = 0.0;
    int hi[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) hi[a] = lo[a] + g->tile[a] < g->n[a] ? lo[a] + g->tile[a] : g->n[a];
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j) {
            ptrdiff_t at = solve_index(g, lo[0], j, k);
            int left = hi[0] - lo[0];
            for (; left >= LANES; left -= LANES, at += LANES)
                for (int l = 0; l < LANES; ++l) lane[l] += x[at + l] * y[at + l];
            for (int l = 0; l < left; ++l) lane[l] += x[at + l] * y[at + l];
        }
    for (int l = 0; l < LANES; ++l) sum += lane[l];
    return sum;
}

static double dot_product(const cg *c, const double *x, const double *y)
{
    const solve_grid *g = &c->grid;
    const int tiles = count_tiles(g);
    double sum = 0.0;
    for (int k = 0; k < c->components; ++k, x += g->size, y += g->size) {
        if (!solve_is_large(g)) { /* even to leave threads alone has a price */
            for (int t = 0; t < tiles; ++t) sum += tile_dot(g, x, y, t);
            continue;
        }
#pragma omp parallel for schedule(static)
        for (int t = 0; t < tiles; ++t) c->tile_sums[t] = tile_dot(g, x, y, t);
        for (int t = 0; t < tiles; ++t) sum += c->tile_sums[t];
    }
    return sum;
}

static int count_rows(const cg *c)
{
    return c->components * solve_rows(&c->grid);
}

/* Linear index of the first unknown of one of the rows of all components. */
static ptrdiff_t row_of(const cg *c, int row)
{
    const int rows = solve_rows(&c->grid);
    return (ptrdiff_t)(row / rows) * (ptrdiff_t)c->grid.size + solve_row(&c->grid, row % rows);
}

static void combine_rows(const cg *c, int row, int end, double a, const double *restrict x, double b,
                         double *restrict y)
{
    for (; row < end; ++row) {
        const ptrdiff_t base = row_of(c, row);
#pragma omp simd
        for (ptrdiff_t at = base; at < base + c->grid.n[0]; ++at) y[at] = a * x[at] + b * y[at];
    }
}

/* y = a x + b y. */
static void combine_vectors(const cg *c, double a, const double *x, double b, double *y)
{
    const int rows = count_rows(c);
    if (!solve_is_large(&c->grid)) {
        combine_rows(c, 0, rows, a, x, b, y);
        return;
    }
#pragma omp parallel for schedule(static)
    for (int row = 0; row < rows; ++row) combine_rows(c, row, row + 1, a, x, b, y);
}

static double weighted_norm(const cg *c, const double *weight, const double *r)
{
    const int rows = count_rows(c);
    if (!weight) return sqrt(dot_product(c, r, r));
#pragma omp parallel for schedule(static) if (solve_is_large(&c->grid))
    for (int row = 0; row < rows; ++row) {
        const ptrdiff_t base = row_of(c, row);
#pragma omp simd
        for (ptrdiff_t at = base; at < base + c->grid.n[0]; ++at) c->z[at] = weight[at] * r[at];
    }
    return sqrt(dot_product(c, c->z, c->z));
}

cg_result cg_solve(cg *c, const cg_system *s, double tolerance, double *r, double *x)
{
    cg_result out = {0};
    double square = 0.0;
    memset(c->p, 0, (size_t)c->components * c->grid.size * sizeof *c->p);
    for (;; ++out.iterations) {
        const double before = square;
        if (s->norm == CG_WEIGHTED) out.residual = weighted_norm(c, s->weight, r);
        if (s->norm == CG_WEIGHTED && out.residual <= tolerance) break;
        s->preconditioner(s->user, r, c->z);
        square = dot_product(c, r, c->z);
        if (s->norm == CG_PRECONDITIONED) out.residual = sqrt(square);
        if (out.residual <= tolerance || out.iterations == c->most_iterations) break;
        combine_vectors(c, 1.0, c->z, out.iterations > 0 ? square / before : 0.0, c->p);
        s->matrix(s->user, c->p, c->Ap);
        const double curvature = dot_product(c, c->Ap, c->p);
        if (!(fabs(curvature) > 0.0)) break;
        combine_vectors(c, square / curvature, c->p, 1.0, x);
        combine_vectors(c, -square / curvature, c->Ap, 1.0, r);
    }
    out.converged = out.residual <= tolerance;
    return out;
}

cg_result cg_solve_afresh(cg *c, const cg_system *s, double tolerance, double *b, double *x)
{
    memset(x, 0, (size_t)c->components * c->grid.size * sizeof *x);
    return cg_solve(c, s, tolerance, b, x);
}

/* The matrix of a level and the steps of its smoother, by rows; instantiated for each dimension. */
#include "solve/cell_level.h"

/* Sum of link times neighbour. */
FLOE_ALWAYS_INLINE double neighbours(const double *const *link, const double *x, const ptrdiff_t *stride, ptrdiff_t at,
                                     const int dim)
{
    double sum = 0.0;
    for (int a = 0; a < dim; ++a) sum += link[a][at] * x[at - stride[a]] + link[a][at + stride[a]] * x[at + stride[a]];
    return sum;
}

/* What a row kernel works on; y and out must not overlap x. */
typedef struct sweep {
    const cell_level *l;
    const double *x, *b;
    double *out;
    double memory, step;
} sweep;

FLOE_ALWAYS_INLINE void apply_row(const sweep *s, ptrdiff_t base, const int dim)
{
    const cell_level *l = s->l;
    const double *link[3] = {l->system.link[0], l->system.link[1], l->system.link[2]};
    const ptrdiff_t stride[3] = {l->grid.stride[0], l->grid.stride[1], l->grid.stride[2]};
    const double *restrict x = s->x, *restrict diagonal = l->diagonal;
    double *restrict out = s->out;
#pragma omp simd
    for (ptrdiff_t at = base; at < base + l->grid.n[0]; ++at)
        out[at] = diagonal[at] * x[at] - neighbours(link, x, stride, at, dim);
}

FLOE_ALWAYS_INLINE void residual_row(const sweep *s, ptrdiff_t base, const int dim)
{
    const cell_level *l = s->l;
    const double *link[3] = {l->system.link[0], l->system.link[1], l->system.link[2]};
    const ptrdiff_t stride[3] = {l->grid.stride[0], l->grid.stride[1], l->grid.stride[2]};
    const double *restrict x = s->x, *restrict diagonal = l->diagonal, *restrict b = s->b;
    double *restrict out = s->out;
#pragma omp simd
    for (ptrdiff_t at = base; at < base + l->grid.n[0]; ++at)
        out[at] = b[at] - diagonal[at] * x[at] + neighbours(link, x, stride, at, dim);
}

FLOE_ALWAYS_INLINE void relax_row(const sweep *s, ptrdiff_t base, const int dim)
{
    const cell_level *l = s->l;
    const double *link[3] = {l->system.link[0], l->system.link[1], l->system.link[2]};
    const ptrdiff_t stride[3] = {l->grid.stride[0], l->grid.stride[1], l->grid.stride[2]};
    const double *restrict x = s->x, *restrict diagonal = l->diagonal, *restrict inverse = l->inverse,
                           *restrict b = s->b;
    double *restrict out = s->out;
    const double memory = s->memory, step = s->step;
#pragma omp simd
    for (ptrdiff_t at = base; at < base + l->grid.n[0]; ++at) {
        const double r = b[at] - diagonal[at] * x[at] + neighbours(link, x, stride, at, dim);
        out[at] = x[at] + memory * (x[at] - out[at]) + step * inverse[at] * r;
    }
}

typedef void row_kernel(const sweep *s, ptrdiff_t base);
#define INSTANCE(name, d)                                      \
    static void name##_row_##d(const sweep *s, ptrdiff_t base) \
    {                                                          \
        name##_row(s, base, d);                                \
    }
#define EACH(name)    \
    INSTANCE(name, 1) \
    INSTANCE(name, 2) \
    INSTANCE(name, 3) \
    static row_kernel *const name##_rows[3] = {name##_row_1, name##_row_2, name##_row_3};
EACH(apply)
EACH(residual)
EACH(relax)

static void for_rows(const sweep *s, row_kernel *const *kernel)
{
    const solve_grid *g = &s->l->grid;
    row_kernel *row_of = kernel[g->dim - 1];
#pragma omp parallel for schedule(static) if (solve_is_large(g))
    for (int row = 0; row < solve_rows(g); ++row) row_of(s, solve_row(g, row));
}

void cell_level_apply(const cell_level *l, double *x, double *y)
{
    solve_fill_periodic(&l->grid, x);
    for_rows(&(sweep){.l = l, .x = x, .out = y}, apply_rows);
}

void cell_level_residual(const cell_level *l, double *x, const double *b, double *r)
{
    solve_fill_periodic(&l->grid, x);
    for_rows(&(sweep){.l = l, .x = x, .b = b, .out = r}, residual_rows);
}

void cell_level_relax(const cell_level *l, double *x, double *out, const double *b, double memory, double step)
{
    solve_fill_periodic(&l->grid, x);
    for_rows(&(sweep){l, x, b, out, memory, step}, relax_rows);
}

void cell_level_start(const cell_level *l, const double *b, double step, double *x, double *out)
{
    const solve_grid *g = &l->grid;
#pragma omp parallel for schedule(static) if (solve_is_large(g))
    for (int row = 0; row < solve_rows(g); ++row) {
        const ptrdiff_t base = solve_row(g, row);
        for (ptrdiff_t at = base; at < base + g->n[0]; ++at) {
            x[at] = step * l->inverse[at] * b[at];
            out[at] = 0.0;
        }
    }
}

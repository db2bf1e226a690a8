#include "coupling/strip.h"

#include "base/compiler.h"

/* 2 at a node on a non-periodic side of the domain, else 1 (local node index along an axis). */
static double side_factor(const mesh *m, const block *b, int axis, int i)
{
    if (m->periodic[axis]) return 1.0;
    return (b->at_side[axis][SIDE_LOWER] && i == 0) || (b->at_side[axis][SIDE_UPPER] && i == b->n[axis]) ? 2.0 : 1.0;
}

/* Weights, in halves, of the two nodes of cell i. */
static void nodes_of_cell(const mesh *m, const block *b, int axis, int i, double share[2])
{
    share[0] = side_factor(m, b, axis, i);
    share[1] = side_factor(m, b, axis, i + 1);
}

/* Of the two cells of node i, those outside the domain without any. */
static void cells_of_node(const mesh *m, const block *b, int axis, int i, double share[2])
{
    const double weight = side_factor(m, b, axis, i);
    share[0] = m->periodic[axis] || !b->at_side[axis][SIDE_LOWER] || i != 0 ? weight : 0.0;
    share[1] = m->periodic[axis] || !b->at_side[axis][SIDE_UPPER] || i != b->n[axis] ? weight : 0.0;
}

int strip_first_node(const mesh *m, const block *b, int axis)
{
    return axis < m->dim && (m->periodic[axis] || !b->at_side[axis][SIDE_LOWER]) ? -1 : 0;
}

int strip_end_node(const mesh *m, const block *b, int axis)
{
    if (axis >= m->dim) return 1;
    return b->n[axis] + (m->periodic[axis] || !b->at_side[axis][SIDE_UPPER] ? 2 : 1);
}

typedef void share_function(const mesh *m, const block *b, int axis, int i, double share[2]);

/* Values [i, end) of row (j, k), whose lower neighbours have the index of the value plus `shift` along each axis. */
static strip strip_of(const mesh *m, const block *b, int i, int end, int j, int k, int shift, share_function *share_of)
{
    strip s = {.n = end - i, .at = mesh_index(b, i, j, k)};
    double y[2] = {2.0, 0.0}, z[2] = {2.0, 0.0};
    if (m->dim > 1) share_of(m, b, 1, j, y);
    if (m->dim > 2) share_of(m, b, 2, k, z);
    share_of(m, b, 0, i, s.first);
    share_of(m, b, 0, end - 1, s.last);
    const ptrdiff_t lowest = s.at + shift * (b->stride[0] + b->stride[1] + b->stride[2]);
    for (int c = 0; c < 2; ++c)
        for (int a = 0; a < 2; ++a) {
            if (!(y[a] * z[c] > 0.0)) continue;
            s.from[s.rows] = lowest + a * b->stride[1] + c * b->stride[2];
            s.weight[s.rows++] = 0.125 * y[a] * z[c];
        }
    return s;
}

strip strip_of_cells(const mesh *m, const block *b, int j, int k)
{
    return strip_of(m, b, 0, b->n[0], j, k, 0, nodes_of_cell);
}

strip strip_of_nodes(const mesh *m, const block *b, int j, int k)
{
    return strip_of(m, b, strip_first_node(m, b, 0), strip_end_node(m, b, 0), j, k, -1, cells_of_node);
}

FLOE_ALWAYS_INLINE void put(double *out, double sum, double where, const strip_use use)
{
    *out = use != STRIP_ADD_WHERE ? sum : where > 0.0 ? *out + sum : *out;
}

/* The first or last value. */
FLOE_ALWAYS_INLINE void end_value(const strip *s, int i, const double share[2], const double *x, const double *y,
                                  double *out, const strip_use use)
{
    double sum = 0.0;
    for (int q = 0; q < s->rows; ++q)
        for (int e = 0; e < 2; ++e) {
            const ptrdiff_t t = s->from[q] + i + e;
            const double w = s->weight[q] * share[e];
            if (w > 0.0) sum += use == STRIP_SUM_PRODUCT ? w * x[t] * y[t] : w * x[t];
        }
    put(&out[s->at + i], sum, use == STRIP_ADD_WHERE ? y[s->at + i] : 0.0, use);
}

/* Those between. */
FLOE_ALWAYS_INLINE void inner_values(const strip *s, const double *x, const double *y, double *out, const int rows,
                                     const strip_use use)
{
    const double *px[4] = {x}, *py[4] = {x}; /* rows of x, of y in products */
    double w[4] = {0.0};
    for (int q = 0; q < rows; ++q) {
        px[q] = x + s->from[q];
        py[q] = use == STRIP_SUM_PRODUCT ? y + s->from[q] : px[q];
        w[q] = s->weight[q];
    }
    const double *where = use == STRIP_ADD_WHERE ? y + s->at : px[0];
    double *to = out + s->at;
    const int last = s->n - 1;
#pragma omp simd
    for (int i = 1; i < last; ++i) {
        double sum = 0.0;
        for (int q = 0; q < rows; ++q)
            for (int e = 0; e < 2; ++e)
                sum += use == STRIP_SUM_PRODUCT ? w[q] * px[q][i + e] * py[q][i + e] : w[q] * px[q][i + e];
        put(&to[i], sum, where[i], use);
    }
}

FLOE_ALWAYS_INLINE void sum_values(const strip *s, const double *x, const double *y, double *out, const strip_use use)
{
    end_value(s, 0, s->first, x, y, out, use);
    if (s->rows == 1)
        inner_values(s, x, y, out, 1, use);
    else if (s->rows == 2)
        inner_values(s, x, y, out, 2, use);
    else
        inner_values(s, x, y, out, 4, use);
    if (s->n > 1) end_value(s, s->n - 1, s->last, x, y, out, use);
}

void strip_sum(const strip *s, const double *x, const double *y, double *out, strip_use use)
{
    switch (use) {
    case STRIP_SUM: sum_values(s, x, y, out, STRIP_SUM); break;
    case STRIP_SUM_PRODUCT: sum_values(s, x, y, out, STRIP_SUM_PRODUCT); break;
    case STRIP_ADD_WHERE: sum_values(s, x, y, out, STRIP_ADD_WHERE); break;
    }
}

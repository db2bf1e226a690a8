#include "solve/skyline.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

struct skyline {
    context *ctx;                /* not owned */
    size_t size;                 /* entries of an array of one component */
    int components, rows, n;     /* of the matrix; unknowns */
    int *order, *level, *number; /* owned; rows in their order; scratch; of each unknown of the rows, -1: fixed */
    size_t *at;                  /* owned; where each unknown is in arrays on the grid */
    int *first;                  /* owned; the first unknown of its row of the factor */
    size_t *start;               /* owned; where that row is in `value`, as if it began with unknown 0 */
    double *value, *x;           /* owned; L; scratch */
    size_t rows_reserved, unknowns_reserved, values_reserved, values;
};

floe_status skyline_create(skyline **out, context *ctx)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    return FLOE_OK;
}

void skyline_destroy(skyline **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    void *owned[] = {&(*s)->order, &(*s)->level, &(*s)->number, &(*s)->at,
                     &(*s)->first, &(*s)->start, &(*s)->value,  &(*s)->x};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; ++k) memory_free(ctx, owned[k]);
    memory_free(ctx, s);
}

/* ---- order of the rows ---- */

static bool couples(const node_matrix *m, int row, int slot)
{
    for (int c = 0; c < m->components; ++c)
        for (int c2 = 0; c2 < m->components; ++c2)
            if (node_matrix_entries(m, row, c, c2)[slot] != 0.0) return true;
    return false;
}

/* Lists the rows that hang together with `start` by their distance from it, from entry `n` of the order on; returns the new end. */
static int list_from(skyline *s, const node_matrix *m, int start, int n)
{
    const int before = n;
    s->order[n++] = start;
    s->level[start] = before;
    for (int k = before; k < n; ++k)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int row = s->order[k];
            const int other = m->row[m->column[(size_t)row * (size_t)m->slots + (size_t)slot]];
            if (s->level[other] >= 0 || !couples(m, row, slot)) continue;
            s->level[other] = before;
            s->order[n++] = other;
        }
    return n;
}

static void clear_levels(skyline *s, int from, int to)
{
    for (int k = from; k < to; ++k) s->level[s->order[k]] = -1;
}

/* From an end of each part: the row that is farthest from the one that is farthest from any. */
static void order_rows(skyline *s, const node_matrix *m)
{
    enum { LOOKS = 2 };
    for (int row = 0; row < m->rows; ++row) s->level[row] = -1;
    for (int row = 0, n = 0; row < m->rows; ++row) {
        if (s->level[row] >= 0) continue;
        int start = row, end = n;
        for (int look = 0; look < LOOKS; ++look) {
            end = list_from(s, m, start, n);
            start = s->order[end - 1];
            clear_levels(s, n, end);
        }
        n = list_from(s, m, start, n);
    }
}

/* ---- envelope ---- */

static void number_unknowns(skyline *s, const node_matrix *m, const bool *fixed)
{
    s->n = 0;
    for (int k = 0; k < m->rows; ++k)
        for (int c = 0; c < m->components; ++c) {
            const int row = s->order[k];
            const size_t at = (size_t)c * s->size + (size_t)m->place[row];
            s->number[row * m->components + c] = fixed[at] ? -1 : s->n;
            if (!fixed[at]) s->at[s->n++] = at;
        }
}

static void find_envelope(skyline *s, const node_matrix *m)
{
    for (int k = 0; k < s->n; ++k) s->first[k] = k;
    for (int row = 0; row < m->rows; ++row)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int other = m->row[m->column[(size_t)row * (size_t)m->slots + (size_t)slot]];
            if (!couples(m, row, slot)) continue;
            for (int c = 0; c < m->components; ++c)
                for (int c2 = 0; c2 < m->components; ++c2) {
                    const int i = s->number[row * m->components + c], j = s->number[other * m->components + c2];
                    if (i >= 0 && j >= 0 && j < s->first[i]) s->first[i] = j;
                }
        }
    s->values = 0;
    for (int k = 0; k < s->n; ++k) {
        s->start[k] = s->values;
        s->values += (size_t)(k - s->first[k]) + 1;
    }
}

floe_status skyline_shape(skyline *s, const node_matrix *m, const bool *fixed)
{
    const size_t rows = (size_t)m->rows, unknowns = rows * (size_t)m->components;
    s->size = m->grid.size;
    s->components = m->components;
    s->rows = m->rows;
    if (rows > s->rows_reserved) {
        s->rows_reserved = 2 * rows;
        TRY(memory_resize(s->ctx, &s->order, s->rows_reserved, sizeof *s->order));
        TRY(memory_resize(s->ctx, &s->level, s->rows_reserved, sizeof *s->level));
    }
    if (unknowns > s->unknowns_reserved) {
        s->unknowns_reserved = 2 * unknowns;
        TRY(memory_resize(s->ctx, &s->number, s->unknowns_reserved, sizeof *s->number));
        TRY(memory_resize(s->ctx, &s->at, s->unknowns_reserved, sizeof *s->at));
        TRY(memory_resize(s->ctx, &s->first, s->unknowns_reserved, sizeof *s->first));
        TRY(memory_resize(s->ctx, &s->start, s->unknowns_reserved, sizeof *s->start));
        TRY(memory_resize(s->ctx, &s->x, s->unknowns_reserved, sizeof *s->x));
    }
    order_rows(s, m);
    number_unknowns(s, m, fixed);
    find_envelope(s, m);
    return FLOE_OK;
}

double skyline_work(const skyline *s)
{
    double work = 0.0;
    for (int k = 0; k < s->n; ++k) {
        const double length = s->n > 0 ? k - s->first[k] + 1 : 0;
        work += 0.5 * length * length;
    }
    return work;
}

/* ---- factors ---- */

/* Entry j of row i of the factor. */
static inline double *entry_of(const skyline *s, int i, int j)
{
    return s->value + s->start[i] + (j - s->first[i]);
}

static void copy_values(skyline *s, const node_matrix *m)
{
    memset(s->value, 0, s->values * sizeof *s->value);
    for (int row = 0; row < m->rows; ++row)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int place = m->column[(size_t)row * (size_t)m->slots + (size_t)slot], other = m->row[place];
            if (other == row && slot != m->slots / 2) continue; /* there is none */
            for (int c = 0; c < m->components; ++c)
                for (int c2 = 0; c2 < m->components; ++c2) {
                    const int i = s->number[row * m->components + c], j = s->number[other * m->components + c2];
                    const double value = node_matrix_entries(m, row, c, c2)[slot];
                    if (i >= 0 && j >= 0 && j <= i && value != 0.0) *entry_of(s, i, j) += value;
                }
        }
}

static double product(const double *restrict a, const double *restrict b, int n)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int k = 0; k < n; ++k) sum += a[k] * b[k];
    return sum;
}

floe_status skyline_factor(skyline *s, const node_matrix *m)
{
    if (s->values > s->values_reserved) {
        s->values_reserved = s->values + s->values / 4;
        TRY(memory_resize(s->ctx, &s->value, s->values_reserved, sizeof *s->value));
    }
    copy_values(s, m);
    for (int i = 0; i < s->n; ++i) {
        for (int j = s->first[i]; j < i; ++j) {
            const int from = s->first[j] > s->first[i] ? s->first[j] : s->first[i];
            double *own = entry_of(s, i, j);
            *own -= product(entry_of(s, i, from), entry_of(s, j, from), j - from);
            *own /= *entry_of(s, j, j);
        }
        double *pivot = entry_of(s, i, i);
        *pivot -= product(entry_of(s, i, s->first[i]), entry_of(s, i, s->first[i]), i - s->first[i]);
        *pivot = *pivot > 0.0 ? sqrt(*pivot) : (double)INFINITY;
    }
    return FLOE_OK;
}

void skyline_solve(skyline *s, const double *b, double *x)
{
    for (int i = 0; i < s->n; ++i) {
        const int from = s->first[i];
        s->x[i] = (b[s->at[i]] - product(entry_of(s, i, from), s->x + from, i - from)) / *entry_of(s, i, i);
    }
    for (int i = s->n - 1; i >= 0; --i) {
        const double *row = entry_of(s, i, s->first[i]);
        s->x[i] /= *entry_of(s, i, i);
        for (int k = s->first[i]; k < i; ++k) s->x[k] -= s->x[i] * row[k - s->first[i]];
    }
    memset(x, 0, (size_t)s->components * s->size * sizeof *x);
    for (int i = 0; i < s->n; ++i) x[s->at[i]] = s->x[i];
}

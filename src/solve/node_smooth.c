#include "solve/node_smooth.h"

#include "base/memory.h"
#include "math/small_solve.h"

#include <math.h>
#include <string.h>

enum { DEGREE = 3 /* of the polynomial */, POWER_STEPS = 12 };
/* The polynomial is small down to this share of the largest eigenvalue; the coarse level does the rest. */
static const double lowest = 1.0 / 8.0;
static const double first_margin = 1.1; /* the power method comes from below */
/* A node with less of the largest diagonal than this is one at the edge. */
static const double light = 0.5;
/* What patches add to their diagonals, scaled to 1: modes that no point sees would be divided by nothing. */
static const double floor_of_patch = 1e-10;

static size_t packed_index(int i, int j)
{
    return (size_t)i * (size_t)(i + 1) / 2 + (size_t)j;
}

void packed_factor(int n, double *a, double more)
{
    for (int i = 0; i < n; ++i) {
        double *row = a + packed_index(i, 0);
        for (int j = 0; j < i; ++j) {
            const double *other = a + packed_index(j, 0);
            double sum = row[j];
            for (int k = 0; k < j; ++k) sum -= row[k] * other[k];
            row[j] = other[j] > 0.0 ? sum / other[j] : 0.0;
        }
        double sum = row[i] > 0.0 ? row[i] + more : 0.0;
        const double least = 1e-14 * sum;
        for (int k = 0; k < i; ++k) sum -= row[k] * row[k];
        row[i] = sum > least ? sqrt(sum) : 0.0;
        if (row[i] == 0.0) memset(row, 0, (size_t)i * sizeof *row);
    }
}

void packed_solve(int n, const double *a, double *b)
{
    for (int i = 0; i < n; ++i) {
        const double *row = a + packed_index(i, 0);
        double sum = b[i];
        for (int k = 0; k < i; ++k) sum -= row[k] * b[k];
        b[i] = row[i] > 0.0 ? sum / row[i] : 0.0;
    }
    for (int i = n - 1; i >= 0; --i) {
        const double *row = a + packed_index(i, 0);
        b[i] = row[i] > 0.0 ? b[i] / row[i] : 0.0;
        for (int k = 0; k < i; ++k) b[k] -= row[k] * b[i];
    }
}

floe_status node_smoother_create(node_smoother *s, const node_matrix *matrix, bool patched)
{
    const size_t size = (size_t)matrix->components * matrix->grid.size;
    *s = (node_smoother){.ctx = matrix->ctx, .matrix = matrix, .patched = patched, .margin = first_margin};
    TRY(memory_new(s->ctx, &s->residual, size, sizeof(double)));
    TRY(memory_new(s->ctx, &s->step, size, sizeof(double)));
    return memory_new(s->ctx, &s->to, size, sizeof(double));
}

void node_smoother_free(node_smoother *s)
{
    if (!s->ctx) return;
    void *owned[] = {&s->block,  &s->covered, &s->patch,    &s->unknown, &s->share,
                     &s->factor, &s->step,    &s->residual, &s->to};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; ++k) memory_free(s->ctx, owned[k]);
}

static int centre_slot(const node_matrix *m)
{
    return m->slots / 2;
}

/* Inverse of a diagonal block; components that are constrained, and have nothing, stay 0. */
static void invert_node_block(const node_matrix *m, int row, double *out)
{
    const int n = m->components, centre = centre_slot(m);
    double a[NODE_MATRIX_COMPONENTS * NODE_MATRIX_COMPONENTS];
    for (int c = 0; c < n; ++c)
        for (int c2 = 0; c2 < n; ++c2) a[c * n + c2] = node_matrix_entries(m, row, c, c2)[centre];
    double packed_block[NODE_MATRIX_COMPONENTS * (NODE_MATRIX_COMPONENTS + 1) / 2];
    for (int c = 0; c < n; ++c)
        for (int c2 = 0; c2 <= c; ++c2) packed_block[packed_index(c, c2)] = a[c * n + c2];
    packed_factor(n, packed_block, 0.0);
    for (int c = 0; c < n; ++c) {
        double x[NODE_MATRIX_COMPONENTS] = {0.0};
        x[c] = 1.0;
        packed_solve(n, packed_block, x);
        for (int c2 = 0; c2 < n; ++c2) out[c2 * n + c] = x[c2];
    }
}

/* Components of one of the vectors that an unknown is made of. */
static int vector_size(const node_matrix *m)
{
    return m->components < m->grid.dim ? m->components : m->grid.dim;
}

/* Diagonal of the components from `first` on that make a vector. */
static double vector_diagonal(const node_matrix *m, int row, int first)
{
    double sum = 0.0;
    for (int c = first; c < first + vector_size(m); ++c) sum += node_matrix_entries(m, row, c, c)[centre_slot(m)];
    return sum;
}

/* Whether one of the vectors of a node weighs little, or none has anything. */
static bool has_small_diagonal(const node_matrix *m, int row, double heaviest)
{
    bool none = true;
    for (int c = 0; c < m->components; c += vector_size(m)) {
        const double weight = vector_diagonal(m, row, c);
        if (weight > 0.0 && weight < light * heaviest) return true;
        none = none && !(weight > 0.0);
    }
    return none;
}

/* Rows of the nodes first ... first + width along each axis, -1 where there is none. Returns how many nodes. */
static int window_rows(const node_matrix *m, int row, int *out)
{
    const int width = m->width, dim = m->grid.dim;
    int n = 0;
    for (int k = 0; k <= (dim > 2 ? width : 0); ++k)
        for (int j = 0; j <= (dim > 1 ? width : 0); ++j)
            for (int i = 0; i <= width; ++i) {
                const int slot = node_matrix_slot(m, (const int[]){i, j, k});
                const int place = m->column[(size_t)row * (size_t)m->slots + (size_t)slot];
                const bool there = slot == centre_slot(m) || place != m->place[row];
                out[n++] = there ? m->row[place] : -1;
            }
    return n;
}

/* Whether points couple the two far corners of a row's window: then they lie in the cell whose nodes these are. */
static bool holds_points(const node_matrix *m, int row)
{
    const int width = m->width;
    const int slot = node_matrix_slot(m, (const int[]){width, width, width});
    for (int c = 0; c < m->components; ++c)
        for (int c2 = 0; c2 < m->components; ++c2)
            if (node_matrix_entries(m, row, c, c2)[slot] != 0.0) return true;
    return false;
}

/* Windows have width + 1 nodes along an axis; the widest are those of cubic splines with edges by the penalty. */
enum { WINDOW_NODES = 5 * 5 * 5, PATCH_UNKNOWNS = WINDOW_NODES * NODE_MATRIX_COMPONENTS };

static floe_status reserve_smoother(node_smoother *s, int unknowns)
{
    const size_t factors = packed_index(unknowns, 0);
    if (s->patches == s->patches_reserved) {
        s->patches_reserved = s->patches_reserved ? 2 * s->patches_reserved : 64;
        TRY(memory_resize(s->ctx, &s->patch, (size_t)s->patches_reserved, sizeof *s->patch));
    }
    if (s->unknowns + (size_t)unknowns > s->unknowns_reserved) {
        s->unknowns_reserved = 2 * s->unknowns_reserved + (size_t)unknowns;
        TRY(memory_resize(s->ctx, &s->unknown, s->unknowns_reserved, sizeof *s->unknown));
        TRY(memory_resize(s->ctx, &s->share, s->unknowns_reserved, sizeof *s->share));
    }
    if (s->factors + factors > s->factors_reserved) {
        s->factors_reserved = 2 * s->factors_reserved + factors;
        TRY(memory_resize(s->ctx, &s->factor, s->factors_reserved, sizeof *s->factor));
    }
    return FLOE_OK;
}

/* Entry (i, j) of the matrix by entries of the arrays; i, j: row and component. */
static double entry_between(const node_matrix *m, int row, int c, int row2, int c2)
{
    const int *column = m->column + (size_t)row * (size_t)m->slots;
    for (int slot = 0; slot < m->slots; ++slot)
        if (column[slot] == m->place[row2] && (row == row2) == (slot == centre_slot(m)))
            return node_matrix_entries(m, row, c, c2)[slot];
    return 0.0;
}

/* The patch of a window: its unknowns scaled so that the diagonal is 1, and factored. */
static floe_status add_patch(node_smoother *s, const int *rows, int nodes)
{
    const node_matrix *m = s->matrix;
    int row[PATCH_UNKNOWNS], component[PATCH_UNKNOWNS], n = 0;
    for (int k = 0; k < nodes; ++k)
        for (int c = 0; rows[k] >= 0 && c < m->components; ++c) {
            if (!(entry_between(m, rows[k], c, rows[k], c) > 0.0)) continue;
            row[n] = rows[k];
            component[n++] = c;
        }
    TRY(reserve_smoother(s, n));
    node_patch *p = &s->patch[s->patches++];
    *p = (node_patch){n, s->unknowns, s->factors};
    double *a = s->factor + p->factor, scale[PATCH_UNKNOWNS];
    for (int i = 0; i < n; ++i) {
        s->covered[row[i]] = true;
        s->unknown[p->first + (size_t)i] = (size_t)component[i] * m->grid.size + (size_t)m->place[row[i]];
        scale[i] = 1.0 / sqrt(entry_between(m, row[i], component[i], row[i], component[i]));
        s->share[p->first + (size_t)i] = scale[i];
        for (int j = 0; j <= i; ++j)
            a[packed_index(i, j)] = scale[i] * scale[j] * entry_between(m, row[i], component[i], row[j], component[j]);
    }
    packed_factor(n, a, floor_of_patch);
    s->unknowns += (size_t)n;
    s->factors += packed_index(n, 0);
    return FLOE_OK;
}

static floe_status find_patches(node_smoother *s)
{
    const node_matrix *m = s->matrix;
    double heaviest = 0.0;
    s->patches = 0;
    s->unknowns = s->factors = 0;
    for (int row = 0; row < m->rows; ++row)
        for (int c = 0; c < m->components; c += vector_size(m)) heaviest = fmax(heaviest, vector_diagonal(m, row, c));
    for (int row = 0; row < m->rows; ++row) {
        int rows[WINDOW_NODES];
        bool edge = false;
        const int nodes = window_rows(m, row, rows);
        for (int k = 0; k < nodes; ++k) edge = edge || (rows[k] >= 0 && has_small_diagonal(m, rows[k], heaviest));
        if (edge && holds_points(m, row)) TRY(add_patch(s, rows, nodes));
    }
    return FLOE_OK;
}

/* Divides the unknowns among the patches that have them; share is scale times the root of the part. */
static void share_unknowns(node_smoother *s)
{
    const size_t size = (size_t)s->matrix->components * s->matrix->grid.size;
    memset(s->to, 0, size * sizeof *s->to);
    for (size_t k = 0; k < s->unknowns; ++k) s->to[s->unknown[k]] += 1.0;
    for (size_t k = 0; k < s->unknowns; ++k) s->share[k] /= sqrt(s->to[s->unknown[k]]);
}

/* to = B from. */
static void apply_inverse(const node_smoother *s, const double *from, double *to)
{
    const node_matrix *m = s->matrix;
    const size_t size = m->grid.size;
    const int n = m->components;
    memset(to, 0, (size_t)n * size * sizeof *to);
#pragma omp parallel for schedule(static) if (m->rows > 2048)
    for (int row = 0; row < m->rows; ++row) {
        if (s->patched && s->covered[row]) continue;
        const double *inverse = s->block + (size_t)row * (size_t)(n * n);
        for (int c = 0; c < n; ++c) {
            double sum = 0.0;
            for (int c2 = 0; c2 < n; ++c2) sum += inverse[c * n + c2] * from[(size_t)c2 * size + (size_t)m->place[row]];
            to[(size_t)c * size + (size_t)m->place[row]] = sum;
        }
    }
    for (int k = 0; k < s->patches; ++k) {
        const node_patch *p = &s->patch[k];
        const size_t *unknown = s->unknown + p->first;
        const double *share = s->share + p->first;
        double x[PATCH_UNKNOWNS];
        for (int i = 0; i < p->unknowns; ++i) x[i] = share[i] * from[unknown[i]];
        packed_solve(p->unknowns, s->factor + p->factor, x);
        for (int i = 0; i < p->unknowns; ++i) to[unknown[i]] += share[i] * x[i];
    }
}

static double matrix_norm(const node_matrix *m, const double *x)
{
    double sum = 0.0;
    for (int c = 0; c < m->components; ++c)
        for (int row = 0; row < m->rows; ++row) {
            const double value = x[(size_t)c * m->grid.size + (size_t)m->place[row]];
            sum += value * value;
        }
    return sqrt(sum);
}

/* The power method from a vector that no symmetry of a body is likely to share. */
static double largest_eigenvalue(const node_smoother *s)
{
    const node_matrix *m = s->matrix;
    double *x = s->step, *y = s->residual, value = 0.0;
    uint32_t state = 1;
    memset(x, 0, (size_t)m->components * m->grid.size * sizeof *x);
    for (int c = 0; c < m->components; ++c)
        for (int row = 0; row < m->rows; ++row) {
            state = state * 1664525U + 1013904223U;
            x[(size_t)c * m->grid.size + (size_t)m->place[row]] = (double)(state >> 8) / 16777216.0 - 0.5;
        }
    for (int k = 0; k < POWER_STEPS; ++k) {
        const double length = matrix_norm(m, x);
        if (!(length > 0.0)) return 1.0;
        for (size_t i = 0; i < (size_t)m->components * m->grid.size; ++i) x[i] /= length;
        node_matrix_apply(m, x, y);
        apply_inverse(s, y, x);
        value = matrix_norm(m, x);
    }
    return value > 0.0 ? value : 1.0;
}

floe_status node_smoother_prepare(node_smoother *s)
{
    const node_matrix *m = s->matrix;
    const size_t n = (size_t)m->components * (size_t)m->components;
    memory_free(s->ctx, &s->block);
    memory_free(s->ctx, &s->covered);
    TRY(memory_new(s->ctx, &s->block, (size_t)m->rows * n, sizeof *s->block));
    TRY(memory_new(s->ctx, &s->covered, (size_t)m->rows, sizeof *s->covered));
    for (int row = 0; row < m->rows; ++row) invert_node_block(m, row, s->block + (size_t)row * n);
    if (s->patched) TRY(find_patches(s));
    share_unknowns(s);
    s->largest = s->margin * largest_eigenvalue(s);
    return FLOE_OK;
}

void node_smoother_relax(node_smoother *s, const double *b, double *x, bool fresh)
{
    const node_matrix *m = s->matrix;
    const size_t size = (size_t)m->components * m->grid.size;
    const double hi = s->largest, lo = lowest * hi, middle = 0.5 * (hi + lo), half = 0.5 * (hi - lo),
                 sigma = middle / half;
    double rho = 1.0 / sigma, *restrict r = s->residual, *restrict d = s->step, *restrict z = s->to;
    if (fresh) {
        memset(x, 0, size * sizeof *x);
        memcpy(r, b, size * sizeof *r);
    } else {
        node_matrix_apply(m, x, z);
        for (size_t k = 0; k < size; ++k) r[k] = b[k] - z[k];
    }
    apply_inverse(s, r, d);
    for (size_t k = 0; k < size; ++k) {
        d[k] /= middle;
        x[k] += d[k];
    }
    for (int degree = 1; degree < DEGREE; ++degree) {
        const double next = 1.0 / (2.0 * sigma - rho), keep = next * rho, take = 2.0 * next / half;
        node_matrix_apply(m, d, z);
        for (size_t k = 0; k < size; ++k) r[k] -= z[k];
        apply_inverse(s, r, z);
        for (size_t k = 0; k < size; ++k) {
            d[k] = keep * d[k] + take * z[k];
            x[k] += d[k];
        }
        rho = next;
    }
}

/* From a level to the next, along one axis: coarse links and sinks, and the transfer of residuals and corrections.
 *
 * Two cells of a pair and the link between them become one cell, whose value lies in the middle of that link. With
 * resistances R = 1/link (R_m of the link inside a pair, none where a cell is left over at the end), two coarse cells
 * are linked by R_m/2 + R + R_m'/2 in series, and a fine cell takes of the coarse value beyond the share (R_m/2) /
 * (R_m/2 + R + R_m'/2): one quarter where links are alike. */
#include "solve/cell_level.h"

/* Keeps 1/0 finite: far above any resistance. */
static const double most_resistance = 1e150;

/* Inside the pair of coarse cell I along the axis; `at` is the index of its first fine cell. */
static double inner_resistance(const cell_level *l, int pair, ptrdiff_t at)
{
    if (2 * pair + 1 >= l->grid.n[l->axis]) return 0.0;
    const double link = l->system.link[l->axis][at + l->grid.stride[l->axis]];
    return link * most_resistance > 1.0 ? 1.0 / link : most_resistance;
}

/* What lies across the lower face of a pair: the link there and the pair before. */
typedef struct crossing {
    double link, inner, beyond; /* link, and R_m of the two pairs */
    ptrdiff_t last;             /* the last fine cell of the pair before; -1: the side of the domain */
} crossing;

static crossing links_across(const cell_level *l, int pair, ptrdiff_t at)
{
    const int n = l->grid.n[l->axis], pairs = (n + 1) / 2;
    const ptrdiff_t s = l->grid.stride[l->axis], start = at - 2 * pair * s;
    crossing c = {.last = -1};
    const bool wrap = pair == 0 || pair == pairs;
    if (pair < pairs) c.inner = inner_resistance(l, pair, at);
    c.link = l->system.link[l->axis][pair == pairs ? start + n * s : at];
    if (wrap && !l->grid.periodic[l->axis]) {
        if (pair == pairs) c.beyond = inner_resistance(l, pair - 1, at - 2 * s);
        return c;
    }
    const int before = pair == 0 ? pairs - 1 : pair - 1;
    c.beyond = inner_resistance(l, before, start + 2 * before * s);
    c.last = start + (pair == 0 ? n - 1 : 2 * pair - 1) * s;
    return c;
}

/* Links across the axis add up, as do sinks. */
static void add_pair(const cell_level *l, cell_level *coarse, ptrdiff_t at, ptrdiff_t to, bool two)
{
    const ptrdiff_t s = l->grid.stride[l->axis];
    coarse->system.sink[to] = l->system.sink[at] + (two ? l->system.sink[at + s] : 0.0);
    for (int a = 0; a < l->grid.dim; ++a)
        if (a != l->axis) coarse->system.link[a][to] = l->system.link[a][at] + (two ? l->system.link[a][at + s] : 0.0);
}

/* The row of fine cells along the axis from `at`, and the coarse one from `to`. */
static void coarsen_line(cell_level *l, cell_level *coarse, ptrdiff_t at, ptrdiff_t to)
{
    const int n = l->grid.n[l->axis], pairs = coarse->grid.n[l->axis];
    const ptrdiff_t s = l->grid.stride[l->axis], t = coarse->grid.stride[l->axis];
    const bool periodic = l->grid.periodic[l->axis];
    for (int pair = 0; pair < pairs + !periodic; ++pair) {
        const ptrdiff_t first = at + 2 * pair * s;
        const crossing c = links_across(l, pair, first);
        const double series = 1.0 + 0.5 * c.link * (c.inner + c.beyond);
        coarse->system.link[l->axis][to + pair * t] = periodic && pairs == 1 ? 0.0 : c.link / series;
        if (pair < pairs) {
            l->share[first] = 0.5 * c.link * c.inner / series;
            add_pair(l, coarse, first, to + pair * t, 2 * pair + 1 < n);
        }
        if (c.last >= 0)
            l->share[c.last] = 0.5 * c.link * c.beyond / series;
        else if (pair == pairs)
            l->share[at + (n - 1) * s] = n % 2 ? 0.0 : 0.5 * c.link * c.beyond / series;
    }
    /* A cell left over lies at its coarse cell's place. */
    if (n % 2) l->share[at + (n - 1) * s] = 0.0;
}

/* Lines along `axis`: how many, and where each starts. */
static int lines_across(const solve_grid *g, int axis)
{
    int lines = 1;
    for (int a = 0; a < g->dim; ++a)
        if (a != axis) lines *= g->n[a];
    return lines;
}
static ptrdiff_t line_start(const solve_grid *g, int axis, int line)
{
    ptrdiff_t at = g->origin;
    for (int a = 0; a < g->dim; ++a) {
        if (a == axis) continue;
        at += line % g->n[a] * g->stride[a];
        line /= g->n[a];
    }
    return at;
}

/* Links of the upper sides across the axis, which lie a cell beyond the lines. */
static void coarsen_upper_sides(const cell_level *l, cell_level *coarse)
{
    const solve_grid *g = &l->grid, *h = &coarse->grid;
    for (int a = 0; a < g->dim; ++a) {
        if (a == l->axis || g->periodic[a]) continue;
        const int third = 3 - a - l->axis, n = g->n[l->axis];
        for (int j = 0; j < g->n[third]; ++j)
            for (int i = 0; i < h->n[l->axis]; ++i) {
                const ptrdiff_t at =
                    g->origin + g->n[a] * g->stride[a] + j * g->stride[third] + 2 * i * g->stride[l->axis];
                const ptrdiff_t to = h->origin + h->n[a] * h->stride[a] + j * h->stride[third] + i * h->stride[l->axis];
                const double *link = l->system.link[a];
                coarse->system.link[a][to] = link[at] + (2 * i + 1 < n ? link[at + g->stride[l->axis]] : 0.0);
            }
    }
}

void cell_level_coarsen(cell_level *l, cell_level *coarse)
{
    const int lines = lines_across(&l->grid, l->axis);
#pragma omp parallel for schedule(static) if (solve_is_large(&l->grid))
    for (int line = 0; line < lines; ++line)
        coarsen_line(l, coarse, line_start(&l->grid, l->axis, line), line_start(&coarse->grid, l->axis, line));
    coarsen_upper_sides(l, coarse);
    solve_fill_periodic(&l->grid, l->share);
}

void cell_level_complete(cell_level *l)
{
    const solve_grid *g = &l->grid;
    for (int a = 0; a < g->dim; ++a)
        if (g->periodic[a]) solve_fill_periodic(g, l->system.link[a]);
#pragma omp parallel for schedule(static) if (solve_is_large(g))
    for (int row = 0; row < solve_rows(g); ++row) {
        const ptrdiff_t base = solve_row(g, row);
        for (ptrdiff_t at = base; at < base + g->n[0]; ++at) {
            double sum = l->system.sink[at];
            for (int a = 0; a < g->dim; ++a) sum += l->system.link[a][at] + l->system.link[a][at + g->stride[a]];
            l->diagonal[at] = sum;
            l->inverse[at] = sum > 0.0 ? 1.0 / sum : 0.0;
        }
    }
}

/* ---- transfer: along axis 0 the cells of a pair lie side by side in a row, along others in two rows ---- */

static void restrict_along(const cell_level *l, const double *restrict r, double *restrict b, ptrdiff_t from, int pairs)
{
    const double *restrict share = l->share;
    const bool left = l->grid.n[0] % 2 != 0;
    for (int i = 0; i < pairs - left; ++i) {
        const ptrdiff_t at = from + 2 * i;
        b[i] = (1.0 - share[at]) * r[at] + share[at - 1] * r[at - 1] + share[at + 2] * r[at + 2] +
               (1.0 - share[at + 1]) * r[at + 1];
    }
    if (!left) return;
    const ptrdiff_t at = from + 2 * (pairs - 1);
    b[pairs - 1] = (1.0 - share[at]) * r[at] + share[at - 1] * r[at - 1] + share[at + 1] * r[at + 1];
}

static void restrict_across(const cell_level *l, const double *restrict r, double *restrict b, ptrdiff_t from, bool two)
{
    const double *restrict share = l->share;
    const ptrdiff_t s = l->grid.stride[l->axis], n = l->grid.n[0], beyond = two ? 2 * s : s;
#pragma omp simd
    for (ptrdiff_t i = 0; i < n; ++i) {
        const ptrdiff_t at = from + i;
        b[i] = (1.0 - share[at]) * r[at] + share[at - s] * r[at - s] + share[at + beyond] * r[at + beyond];
    }
    if (!two) return;
#pragma omp simd
    for (ptrdiff_t i = 0; i < n; ++i) b[i] += (1.0 - share[from + i + s]) * r[from + i + s];
}

void cell_level_restrict(const cell_level *l, double *r, const cell_level *coarse, double *b)
{
    const solve_grid *g = &l->grid, *h = &coarse->grid;
    solve_fill_periodic(g, r);
#pragma omp parallel for schedule(static) if (solve_is_large(h))
    for (int row = 0; row < solve_rows(h); ++row) {
        int cell[MESH_MAX_DIM] = {0, row % h->n[1], row / h->n[1]};
        double *to = b + solve_row(h, row);
        if (l->axis > 0) cell[l->axis] *= 2;
        const ptrdiff_t from = solve_index(g, 0, cell[1], cell[2]);
        if (l->axis == 0)
            restrict_along(l, r, to, from, h->n[0]);
        else
            restrict_across(l, r, to, from, cell[l->axis] + 1 < g->n[l->axis]);
    }
}

/* A fine cell's part of the correction; nothing where it takes no part. */
FLOE_ALWAYS_INLINE double correction(const cell_level *l, ptrdiff_t at, double own, double beyond)
{
    const double value = own + l->share[at] * (beyond - own);
    return l->inverse[at] > 0.0 ? value : 0.0;
}

static void prolong_along(const cell_level *l, double *restrict x, const double *restrict from, ptrdiff_t at,
                          double keep)
{
    const int n = l->grid.n[0];
    for (int i = 0; i < n / 2; ++i) {
        const ptrdiff_t first = at + 2 * i;
        x[first] = keep * x[first] + correction(l, first, from[i], from[i - 1]);
        x[first + 1] = keep * x[first + 1] + correction(l, first + 1, from[i], from[i + 1]);
    }
    if (n % 2) x[at + n - 1] = keep * x[at + n - 1] + correction(l, at + n - 1, from[n / 2], from[n / 2 - 1]);
}

static void prolong_across(const cell_level *l, double *restrict x, const double *restrict from, ptrdiff_t at,
                           ptrdiff_t beyond, double keep)
{
    const ptrdiff_t n = l->grid.n[0];
#pragma omp simd
    for (ptrdiff_t i = 0; i < n; ++i) x[at + i] = keep * x[at + i] + correction(l, at + i, from[i], from[i + beyond]);
}

void cell_level_prolong(const cell_level *l, double *x, const cell_level *coarse, double *from, bool fresh)
{
    const solve_grid *g = &l->grid, *h = &coarse->grid;
    const double keep = fresh ? 0.0 : 1.0;
    solve_fill_periodic(h, from);
#pragma omp parallel for schedule(static) if (solve_is_large(g))
    for (int row = 0; row < solve_rows(g); ++row) {
        int cell[MESH_MAX_DIM] = {0, row % g->n[1], row / g->n[1]};
        const ptrdiff_t at = solve_row(g, row), t = h->stride[l->axis];
        const bool second = cell[l->axis] % 2;
        cell[l->axis] /= 2;
        const double *own = from + solve_index(h, cell[0], cell[1], cell[2]);
        if (l->axis == 0)
            prolong_along(l, x, own, at, keep);
        else
            prolong_across(l, x, own, at, second ? t : -t, keep);
    }
}

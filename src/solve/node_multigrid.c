#include "solve/node_multigrid.h"

#include "base/memory.h"
#include "solve/node_smooth.h"

#include <string.h>

enum { MOST_LEVELS = 31, FEW_UNKNOWNS = 200, FEW_NODES = 4 /* along an axis, which is not coarsened then */ };
/* Added to the diagonal of the coarsest matrix, as a share of it: what moves free must not be divided by nothing. */
static const double floor_of_coarsest = 1e-12;

typedef struct node_level {
    node_matrix *matrix; /* owned */
    node_smoother smoother;
    bool coarsened[MESH_MAX_DIM]; /* the next level has half the nodes along this axis */
    double *x, *b, *r;            /* owned; x and b are NULL on the finest level */
} node_level;

struct node_multigrid {
    context *ctx;
    int n;
    node_level level[MOST_LEVELS];
    int last;        /* the level that is solved exactly */
    size_t *unknown; /* of it: entries of its arrays; owned */
    double *factor;  /* owned */
    double *exact;   /* scratch; owned */
    int unknowns;
};

/* The grid with every second node, the last one beyond the end where need be. False: no axis can be coarsened. */
static bool coarse_grid(const solve_grid *g, bool *coarsened, solve_grid *out)
{
    int n[MESH_MAX_DIM] = {1, 1, 1};
    bool any = false;
    for (int a = 0; a < g->dim; ++a) {
        coarsened[a] = g->n[a] > FEW_NODES && !(g->periodic[a] && g->n[a] % 2);
        n[a] = !coarsened[a] ? g->n[a] : g->periodic[a] ? g->n[a] / 2 : g->n[a] / 2 + 1;
        any = any || coarsened[a];
    }
    *out = solve_grid_make(g->dim, n, g->periodic);
    return any;
}

static floe_status add_level(node_multigrid *m, const solve_grid *g, int components, int width, int arm)
{
    node_level *l = &m->level[m->n++];
    const size_t size = (size_t)components * g->size;
    TRY(node_matrix_create(&l->matrix, m->ctx, g, components, width, arm));
    /* Unknowns that lines bind to those within are light no more: patches about cells would leave out what they are bound to. */
    TRY(node_smoother_create(&l->smoother, l->matrix, m->n == 1 && arm == 0));
    TRY(memory_new(m->ctx, &l->r, size, sizeof(double)));
    if (m->n == 1) return FLOE_OK;
    TRY(memory_new(m->ctx, &l->x, size, sizeof(double)));
    return memory_new(m->ctx, &l->b, size, sizeof(double));
}

/* Half the width, rounded up, and one more node that linear values reach. */
static int coarse_width(int width)
{
    return (width + 2) / 2 > 1 ? (width + 2) / 2 : 1;
}

static floe_status fill_node_multigrid(node_multigrid *m, const solve_grid *g, int components, int width, int arm)
{
    solve_grid grid = *g, coarse;
    TRY(add_level(m, &grid, components, width, arm));
    width += arm; /* coarse unknowns that an arm couples lie beside each other, too */
    while (m->n < MOST_LEVELS && coarse_grid(&grid, m->level[m->n - 1].coarsened, &coarse)) {
        bool all = true;
        for (int a = 0; a < grid.dim; ++a) all = all && m->level[m->n - 1].coarsened[a];
        width = all ? coarse_width(width) : width;
        grid = coarse;
        TRY(add_level(m, &grid, components, width, 0));
    }
    return FLOE_OK;
}

floe_status node_multigrid_create(node_multigrid **out, context *ctx, const solve_grid *g, int components, int width,
                                  int arm)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    const floe_status status = fill_node_multigrid(*out, g, components, width, arm);
    if (status != FLOE_OK) node_multigrid_destroy(out);
    return status;
}

static void drop_exact(node_multigrid *m)
{
    memory_free(m->ctx, &m->unknown);
    memory_free(m->ctx, &m->factor);
    memory_free(m->ctx, &m->exact);
}

void node_multigrid_destroy(node_multigrid **m)
{
    if (!m || !*m) return;
    context *ctx = (*m)->ctx;
    drop_exact(*m);
    for (int k = 0; k < (*m)->n; ++k) {
        node_level *l = &(*m)->level[k];
        node_smoother_free(&l->smoother);
        node_matrix_destroy(&l->matrix);
        memory_free(ctx, &l->x);
        memory_free(ctx, &l->b);
        memory_free(ctx, &l->r);
    }
    memory_free(ctx, m);
}

node_matrix *node_multigrid_matrix(node_multigrid *m)
{
    return m->level[0].matrix;
}

/* Coarse nodes that a fine node's value comes from, and how much of each. */
typedef struct node_parents {
    int n, at[8][MESH_MAX_DIM]; /* coarse indices, not yet brought around periodic ends */
    double share[8];
} node_parents;

static node_parents parents_of(const node_level *l, const int node[MESH_MAX_DIM])
{
    node_parents p = {.n = 1, .share = {1.0}};
    for (int a = 0; a < l->matrix->grid.dim; ++a) {
        if (!l->coarsened[a]) {
            for (int k = 0; k < p.n; ++k) p.at[k][a] = node[a];
            continue;
        }
        const bool odd = node[a] & 1;
        const int lower = (node[a] - (odd ? 1 : 0)) / 2, before = p.n;
        for (int k = 0; k < before; ++k) {
            p.at[k][a] = lower;
            if (!odd) continue;
            p.share[k] *= 0.5;
            memcpy(p.at[p.n], p.at[k], sizeof p.at[k]);
            p.share[p.n] = p.share[k];
            p.at[p.n++][a] = lower + 1;
        }
    }
    return p;
}

static ptrdiff_t node_index(const solve_grid *g, const int at[MESH_MAX_DIM])
{
    int i[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < g->dim; ++a) i[a] = g->periodic[a] ? (at[a] + g->n[a]) % g->n[a] : at[a];
    return solve_index(g, i[0], i[1], i[2]);
}

/* Indices of the node at a place of a grid without the ghosts' offset. */
static void node_of_place(const solve_grid *g, int place, int at[MESH_MAX_DIM])
{
    int rest = place - (int)g->origin;
    for (int a = MESH_MAX_DIM - 1; a >= 0; --a) {
        at[a] = a < g->dim ? rest / (int)g->stride[a] : 0;
        if (a < g->dim) rest -= at[a] * (int)g->stride[a];
    }
}

static floe_status shape_coarse(const node_level *l, node_level *coarse)
{
    const solve_grid *to = &coarse->matrix->grid;
    bool *takes_part;
    TRY(memory_new(coarse->matrix->ctx, &takes_part, to->size, sizeof *takes_part));
    for (int row = 0; row < l->matrix->rows; ++row) {
        int at[MESH_MAX_DIM];
        node_of_place(&l->matrix->grid, l->matrix->place[row], at);
        const node_parents p = parents_of(l, at);
        for (int k = 0; k < p.n; ++k) takes_part[node_index(to, p.at[k])] = true;
    }
    const floe_status status = node_matrix_shape(coarse->matrix, takes_part);
    memory_free(coarse->matrix->ctx, &takes_part);
    return status;
}

/* Steps from one coarse node to another, the shorter way around a periodic axis. */
static int slot_between(const node_matrix *m, const int from[MESH_MAX_DIM], const int to[MESH_MAX_DIM])
{
    int offset[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->grid.dim; ++a) {
        offset[a] = to[a] - from[a];
        if (!m->grid.periodic[a]) continue;
        if (offset[a] > m->width) offset[a] -= m->grid.n[a];
        if (offset[a] < -m->width) offset[a] += m->grid.n[a];
    }
    return node_matrix_slot(m, offset);
}

static void add_blocks(const node_level *l, node_level *coarse, int row, int slot, const node_parents *p,
                       const node_parents *q)
{
    const node_matrix *fine = l->matrix, *to = coarse->matrix;
    for (int i = 0; i < p->n; ++i) {
        const int target = to->row[node_index(&to->grid, p->at[i])];
        for (int j = 0; j < q->n; ++j) {
            const int at = slot_between(to, p->at[i], q->at[j]);
            const double share = p->share[i] * q->share[j];
            for (int c = 0; c < fine->components; ++c)
                for (int c2 = 0; c2 < fine->components; ++c2)
                    node_matrix_entries(to, target, c, c2)[at] += share * node_matrix_entries(fine, row, c, c2)[slot];
        }
    }
}

static void fill_coarse(const node_level *l, node_level *coarse)
{
    const node_matrix *fine = l->matrix;
    for (int row = 0; row < fine->rows; ++row) {
        int at[MESH_MAX_DIM], other[MESH_MAX_DIM];
        node_of_place(&fine->grid, fine->place[row], at);
        const node_parents p = parents_of(l, at);
        for (int slot = 0; slot < fine->slots; ++slot) {
            const int place = fine->column[(size_t)row * (size_t)fine->slots + (size_t)slot];
            if (place == fine->place[row] && slot != fine->slots / 2) continue;
            node_of_place(&fine->grid, place, other);
            const node_parents q = parents_of(l, other);
            add_blocks(l, coarse, row, slot, &p, &q);
        }
    }
}

static int count_unknowns(const node_matrix *m)
{
    return m->rows * m->components;
}

/* The whole matrix of the last level, factored. */
static floe_status factor_last(node_multigrid *m)
{
    const node_matrix *a = m->level[m->last].matrix;
    const int n = count_unknowns(a);
    drop_exact(m);
    TRY(memory_new(m->ctx, &m->unknown, (size_t)n, sizeof *m->unknown));
    TRY(memory_new(m->ctx, &m->exact, (size_t)n, sizeof *m->exact));
    TRY(memory_new(m->ctx, &m->factor, (size_t)n * (size_t)(n + 1) / 2, sizeof *m->factor));
    m->unknowns = n;
    double largest = 0.0;
    for (int i = 0; i < n; ++i) {
        const int row = i / a->components, c = i % a->components;
        double *to = m->factor + (size_t)i * (size_t)(i + 1) / 2;
        m->unknown[i] = (size_t)c * a->grid.size + (size_t)a->place[row];
        for (int slot = 0; slot < a->slots; ++slot) {
            const int place = a->column[(size_t)row * (size_t)a->slots + (size_t)slot];
            if (place == a->place[row] && slot != a->slots / 2) continue;
            for (int c2 = 0; c2 < a->components; ++c2) {
                const int j = a->row[place] * a->components + c2;
                if (j <= i) to[j] += node_matrix_entries(a, row, c, c2)[slot];
            }
        }
        largest = to[i] > largest ? to[i] : largest;
    }
    packed_factor(n, m->factor, floor_of_coarsest * largest);
    return FLOE_OK;
}

floe_status node_multigrid_prepare(node_multigrid *m)
{
    for (m->last = 0; m->last + 1 < m->n && count_unknowns(m->level[m->last].matrix) > FEW_UNKNOWNS; ++m->last) {
        node_level *l = &m->level[m->last];
        TRY(node_smoother_prepare(&l->smoother));
        TRY(shape_coarse(l, l + 1));
        fill_coarse(l, l + 1);
    }
    return factor_last(m);
}

void node_multigrid_apply(void *user, double *x, double *y)
{
    const node_multigrid *m = user;
    node_matrix_apply(m->level[0].matrix, x, y);
}

static void restrict_to(const node_level *l, const double *r, node_level *coarse)
{
    const node_matrix *fine = l->matrix, *to = coarse->matrix;
    memset(coarse->b, 0, (size_t)to->components * to->grid.size * sizeof(double));
    for (int row = 0; row < fine->rows; ++row) {
        int at[MESH_MAX_DIM];
        node_of_place(&fine->grid, fine->place[row], at);
        const node_parents p = parents_of(l, at);
        for (int k = 0; k < p.n; ++k) {
            const size_t place = (size_t)node_index(&to->grid, p.at[k]);
            for (int c = 0; c < fine->components; ++c)
                coarse->b[(size_t)c * to->grid.size + place] +=
                    p.share[k] * r[(size_t)c * fine->grid.size + (size_t)fine->place[row]];
        }
    }
}

static void prolong_correction(const node_level *l, double *x, const node_level *coarse)
{
    const node_matrix *fine = l->matrix, *from = coarse->matrix;
#pragma omp parallel for schedule(static) if (fine->rows > 2048)
    for (int row = 0; row < fine->rows; ++row) {
        int at[MESH_MAX_DIM];
        node_of_place(&fine->grid, fine->place[row], at);
        const node_parents p = parents_of(l, at);
        for (int c = 0; c < fine->components; ++c) {
            double sum = 0.0;
            for (int k = 0; k < p.n; ++k)
                sum += p.share[k] * coarse->x[(size_t)c * from->grid.size + (size_t)node_index(&from->grid, p.at[k])];
            x[(size_t)c * fine->grid.size + (size_t)fine->place[row]] += sum;
        }
    }
}

static void solve_exactly(const node_multigrid *m, const double *b, double *x)
{
    const node_matrix *a = m->level[m->last].matrix;
    memset(x, 0, (size_t)a->components * a->grid.size * sizeof *x);
    for (int i = 0; i < m->unknowns; ++i) m->exact[i] = b[m->unknown[i]];
    packed_solve(m->unknowns, m->factor, m->exact);
    for (int i = 0; i < m->unknowns; ++i) x[m->unknown[i]] = m->exact[i];
}

/* Down to the exact solution, and up again. `x` and `b` of the finest level are the caller's. */
static void run_v_cycle(node_multigrid *m, const double *b, double *x)
{
    for (int k = 0; k < m->last; ++k) {
        node_level *l = &m->level[k];
        const size_t size = (size_t)l->matrix->components * l->matrix->grid.size;
        const double *rhs = k ? l->b : b;
        double *to = k ? l->x : x;
        node_smoother_relax(&l->smoother, rhs, to, true);
        node_matrix_apply(l->matrix, to, l->r);
        for (size_t i = 0; i < size; ++i) l->r[i] = rhs[i] - l->r[i];
        restrict_to(l, l->r, l + 1);
    }
    solve_exactly(m, m->last ? m->level[m->last].b : b, m->last ? m->level[m->last].x : x);
    for (int k = m->last - 1; k >= 0; --k) {
        node_level *l = &m->level[k];
        prolong_correction(l, k ? l->x : x, l + 1);
        node_smoother_relax(&l->smoother, k ? l->b : b, k ? l->x : x, false);
    }
}

void node_multigrid_cycle(void *user, double *x, double *y)
{
    run_v_cycle(user, x, y);
}

/* Multigrid for matrices of nodes. */
#include "base/memory.h"
#include "solve/multigrid_level.h"
#include "solve/node_smooth.h"

#include <string.h>

enum { FEW_UNKNOWNS = 200, FEW_NODES = 4 /* along an axis, which is not coarsened then */ };
/* Added to the diagonal of the coarsest matrix, as a share of it: what moves free must not be divided by nothing. */
static const double floor_of_coarsest = 1e-12;

typedef struct node_level {
    node_matrix *matrix; /* owned */
    node_smoother smoother;
    bool coarsened[MESH_MAX_DIM]; /* the next level has half the nodes along this axis */
    double *residual;             /* owned */
    /* Of a level that is solved exactly: entries of its arrays, the factored matrix, scratch; owned. */
    size_t *unknown;
    double *factor, *exact;
    int unknowns;
} node_level;

static node_level *nodes_of(const multigrid_level *l)
{
    return l->own;
}

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

static floe_status add_level(multigrid *m, const solve_grid *g, int components, int width, int arm, node_level **out)
{
    const size_t size = (size_t)components * g->size;
    TRY(multigrid_add(m, size, sizeof **out, out));
    node_level *l = *out;
    TRY(node_matrix_create(&l->matrix, m->ctx, g, components, width, arm));
    /* Unknowns that lines bind to those within are light no more: patches about cells would leave out what they are bound to. */
    TRY(node_smoother_create(&l->smoother, l->matrix, m->n == 1 && arm == 0));
    return memory_new(m->ctx, &l->residual, size, sizeof(double));
}

/* Half the width, rounded up, and one more node that linear values reach. */
static int coarse_width(int width)
{
    return (width + 2) / 2 > 1 ? (width + 2) / 2 : 1;
}

static floe_status add_nodes(multigrid *m, const solve_grid *g, int components, int width, int arm)
{
    solve_grid grid = *g, coarse;
    node_level *l;
    TRY(add_level(m, &grid, components, width, arm, &l));
    width += arm; /* coarse unknowns that an arm couples lie beside each other, too */
    while (coarse_grid(&grid, l->coarsened, &coarse)) {
        bool all = true;
        for (int a = 0; a < grid.dim; ++a) all = all && l->coarsened[a];
        width = all ? coarse_width(width) : width;
        grid = coarse;
        TRY(add_level(m, &grid, components, width, 0, &l));
    }
    return FLOE_OK;
}

static void drop_exact(context *ctx, node_level *l)
{
    memory_free(ctx, &l->unknown);
    memory_free(ctx, &l->factor);
    memory_free(ctx, &l->exact);
}

static void free_nodes(context *ctx, void *own)
{
    node_level *l = own;
    drop_exact(ctx, l);
    node_smoother_free(&l->smoother);
    node_matrix_destroy(&l->matrix);
    memory_free(ctx, &l->residual);
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

static bool has_few_unknowns(const multigrid_level *l)
{
    return count_unknowns(nodes_of(l)->matrix) <= FEW_UNKNOWNS;
}

/* The whole matrix of the last level, factored. */
static floe_status factor_nodes(const multigrid_level *of)
{
    node_level *l = nodes_of(of);
    const node_matrix *a = l->matrix;
    const int n = count_unknowns(a);
    drop_exact(a->ctx, l);
    TRY(memory_new(a->ctx, &l->unknown, (size_t)n, sizeof *l->unknown));
    TRY(memory_new(a->ctx, &l->exact, (size_t)n, sizeof *l->exact));
    TRY(memory_new(a->ctx, &l->factor, (size_t)n * (size_t)(n + 1) / 2, sizeof *l->factor));
    l->unknowns = n;
    double largest = 0.0;
    for (int i = 0; i < n; ++i) {
        const int row = i / a->components, c = i % a->components;
        double *to = l->factor + (size_t)i * (size_t)(i + 1) / 2;
        l->unknown[i] = (size_t)c * a->grid.size + (size_t)a->place[row];
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
    packed_factor(n, l->factor, floor_of_coarsest * largest);
    return FLOE_OK;
}

static floe_status coarsen_nodes(const multigrid_level *l, const multigrid_level *coarse)
{
    TRY(node_smoother_prepare(&nodes_of(l)->smoother));
    TRY(shape_coarse(nodes_of(l), nodes_of(coarse)));
    fill_coarse(nodes_of(l), nodes_of(coarse));
    return FLOE_OK;
}

static void apply_nodes(const multigrid_level *l, double *x, double *y)
{
    node_matrix_apply(nodes_of(l)->matrix, x, y);
}

static void smooth_nodes(const multigrid_level *l, const double *b, bool fresh)
{
    node_smoother_relax(&nodes_of(l)->smoother, b, l->x, fresh);
}

static void restrict_nodes(const multigrid_level *of, const double *b, const multigrid_level *coarse)
{
    const node_level *l = nodes_of(of);
    const node_matrix *fine = l->matrix, *to = nodes_of(coarse)->matrix;
    double *r = l->residual;
    node_matrix_apply(fine, of->x, r);
    for (size_t i = 0; i < of->size; ++i) r[i] = b[i] - r[i];
    memset(coarse->b, 0, coarse->size * sizeof(double));
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

static void prolong_nodes(const multigrid_level *of, const multigrid_level *coarse)
{
    const node_level *l = nodes_of(of);
    const node_matrix *fine = l->matrix, *from = nodes_of(coarse)->matrix;
#pragma omp parallel for schedule(static) if (fine->rows > 2048)
    for (int row = 0; row < fine->rows; ++row) {
        int at[MESH_MAX_DIM];
        node_of_place(&fine->grid, fine->place[row], at);
        const node_parents p = parents_of(l, at);
        for (int c = 0; c < fine->components; ++c) {
            double sum = 0.0;
            for (int k = 0; k < p.n; ++k)
                sum += p.share[k] * coarse->x[(size_t)c * from->grid.size + (size_t)node_index(&from->grid, p.at[k])];
            of->x[(size_t)c * fine->grid.size + (size_t)fine->place[row]] += sum;
        }
    }
}

static void solve_nodes(const multigrid_level *of, const double *b)
{
    const node_level *l = nodes_of(of);
    memset(of->x, 0, of->size * sizeof *of->x);
    for (int i = 0; i < l->unknowns; ++i) l->exact[i] = b[l->unknown[i]];
    packed_solve(l->unknowns, l->factor, l->exact);
    for (int i = 0; i < l->unknowns; ++i) of->x[l->unknown[i]] = l->exact[i];
}

floe_status multigrid_of_nodes(multigrid **out, context *ctx, const solve_grid *g, int components, int width, int arm)
{
    static const multigrid_kind nodes = {apply_nodes,      smooth_nodes,  restrict_nodes, prolong_nodes, solve_nodes,
                                         has_few_unknowns, coarsen_nodes, factor_nodes,   free_nodes};
    TRY(multigrid_new(out, ctx, &nodes));
    const floe_status status = add_nodes(*out, g, components, width, arm);
    if (status != FLOE_OK) multigrid_destroy(out);
    return status;
}

node_matrix *multigrid_matrix(multigrid *m)
{
    return nodes_of(&m->level[0])->matrix;
}

void multigrid_widen(multigrid *m, double margin)
{
    for (int k = 0; k < m->n; ++k) nodes_of(&m->level[k])->smoother.margin = margin;
}

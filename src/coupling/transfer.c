#include "coupling/transfer.h"

#include "base/compiler.h"

#include <math.h>

/* 2 at a node on a non-periodic side of the domain, else 1 (local node index along an axis). */
static double doubling(const mesh *m, const block *b, int axis, int i)
{
    if (m->periodic[axis]) return 1.0;
    return (b->at_side[axis][SIDE_LOWER] && i == 0) || (b->at_side[axis][SIDE_UPPER] && i == b->n[axis]) ? 2.0 : 1.0;
}

/* Weights of a cell's two nodes along each axis: 1/2, doubled on a side. */
static void cell_weights(const mesh *m, const block *b, const int cell[3], double w[3][2])
{
    for (int a = 0; a < 3; ++a) {
        const bool used = a < m->dim;
        w[a][0] = used ? 0.5 * doubling(m, b, a, cell[a]) : 1.0;
        w[a][1] = used ? 0.5 * doubling(m, b, a, cell[a] + 1) : 0.0;
    }
}

/* sum over a cell's nodes of w times the node array. */
static double cell_sum(const mesh *m, const block *b, const double w[3][2], ptrdiff_t at, const double *node)
{
    double sum = 0.0;
    for (int k = 0; k < (m->dim > 2 ? 2 : 1); ++k)
        for (int j = 0; j < (m->dim > 1 ? 2 : 1); ++j)
            for (int i = 0; i < 2; ++i)
                sum += w[0][i] * w[1][j] * w[2][k] * node[at + i * b->stride[0] + j * b->stride[1] + k * b->stride[2]];
    return sum;
}

/* The same of a product of two node arrays. */
static double cell_sum_product(const mesh *m, const block *b, const double w[3][2], ptrdiff_t at, const double *p,
                               const double *q)
{
    double sum = 0.0;
    for (int k = 0; k < (m->dim > 2 ? 2 : 1); ++k)
        for (int j = 0; j < (m->dim > 1 ? 2 : 1); ++j)
            for (int i = 0; i < 2; ++i) {
                const ptrdiff_t n = at + i * b->stride[0] + j * b->stride[1] + k * b->stride[2];
                sum += w[0][i] * w[1][j] * w[2][k] * p[n] * q[n];
            }
    return sum;
}

/* What is done for one row of cells of one solid. */
typedef void row_function(const transfer *t, int blk, const transfer_pair *pair, int j, int k);

static void for_rows(const transfer *t, row_function *row)
{
    for (int blk = 0; blk < t->mesh->n_blocks; ++blk) {
        const block *b = &t->mesh->block[blk];
        for (int p = 0; p < t->n_pairs; ++p) {
#pragma omp parallel for schedule(static) collapse(2)
            for (int k = 0; k < b->n[2]; ++k)
                for (int j = 0; j < b->n[1]; ++j) row(t, blk, &t->pair[p], j, k);
        }
    }
}

static void cells_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const mesh *m = t->mesh;
    const block *b = &m->block[blk];
    const fields *f = t->domain->fields[blk];
    const double *mass = field_get(f, N_MASS, pair->group, 0);
    /* Both states get them: what is read between steps must not depend on the step before the last. */
    double *rho = field_get(f, C_RHO, pair->material, 0), *rho_next = field_next(f, C_RHO, pair->material, 0);
    double *T = field_get(f, C_TEMP, pair->material, 0);
    for (int i = 0; i < b->n[0]; ++i) {
        double w[3][2];
        const ptrdiff_t at = mesh_index(b, i, j, k);
        cell_weights(m, b, (const int[]){i, j, k}, w);
        const double cell_mass = cell_sum(m, b, (const double(*)[2])w, at, mass);
        rho[at] = rho_next[at] = cell_mass / mesh_cell_volume(m, b->lo[0] + i);
        T[at] = pair->temperature;
        for (int a = 0; a < m->dim; ++a) {
            const double momentum = cell_sum(m, b, (const double(*)[2])w, at, field_get(f, N_MOMENTUM, pair->group, a));
            const double u = cell_mass > 0.0 ? momentum / cell_mass : 0.0;
            field_get(f, C_VEL, pair->material, a)[at] = field_next(f, C_VEL, pair->material, a)[at] = u;
        }
    }
}

floe_status transfer_nodes_to_cells(transfer *t)
{
    for_rows(t, cells_from_nodes);
    return FLOE_OK;
}

static void momentum_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const mesh *m = t->mesh;
    const block *b = &m->block[blk];
    const fields *f = t->domain->fields[blk];
    const double *mass = field_get(f, N_MASS, pair->group, 0);
    for (int i = 0; i < b->n[0]; ++i) {
        double w[3][2];
        const ptrdiff_t at = mesh_index(b, i, j, k);
        cell_weights(m, b, (const int[]){i, j, k}, w);
        for (int a = 0; a < m->dim; ++a)
            field_get(f, C_MOMENTUM_L, pair->material, a)[at] =
                cell_sum_product(m, b, (const double(*)[2])w, at, mass, field_get(f, N_VEL_L, pair->group, a));
    }
}

floe_status transfer_momentum_to_cells(transfer *t)
{
    for_rows(t, momentum_from_nodes);
    return FLOE_OK;
}

/* sum over the cells about a node, of those inside the domain: each cell array value times the product of axis weights. */
static double node_sum(const mesh *m, const block *b, const int node[3], const double *cell)
{
    double w[3][2];
    for (int a = 0; a < 3; ++a) {
        const bool used = a < m->dim;
        const bool below = used && (m->periodic[a] || !(b->at_side[a][SIDE_LOWER] && node[a] == 0));
        const bool above = !used || m->periodic[a] || !(b->at_side[a][SIDE_UPPER] && node[a] == b->n[a]);
        const double weight = used ? 0.5 * doubling(m, b, a, node[a]) : 1.0;
        w[a][0] = below ? weight : 0.0;
        w[a][1] = above ? weight : 0.0;
    }
    double sum = 0.0;
    for (int k = m->dim > 2 ? -1 : 0; k < 1; ++k)
        for (int j = m->dim > 1 ? -1 : 0; j < 1; ++j)
            for (int i = -1; i < 1; ++i) {
                const double weight = w[0][i + 1] * w[1][m->dim > 1 ? j + 1 : 1] * w[2][m->dim > 2 ? k + 1 : 1];
                if (weight > 0.0) sum += weight * cell[mesh_index(b, node[0] + i, node[1] + j, node[2] + k)];
            }
    return sum;
}

/* Nodes of a block and one ghost layer where a neighbour's cells are at hand. */
static int first_node(const transfer *t, const block *b, int a)
{
    return a < t->mesh->dim && (t->mesh->periodic[a] || !b->at_side[a][SIDE_LOWER]) ? -1 : 0;
}

static int end_node(const transfer *t, const block *b, int a)
{
    if (a >= t->mesh->dim) return 1;
    return b->n[a] + (t->mesh->periodic[a] || !b->at_side[a][SIDE_UPPER] ? 2 : 1);
}

typedef void node_function(const transfer *t, int blk, const int node[3], ptrdiff_t at, const transfer_pair *pair);

static void for_nodes(const transfer *t, int blk, const transfer_pair *pair, node_function *visit)
{
    const block *b = &t->mesh->block[blk];
    const int z0 = first_node(t, b, 2), z1 = end_node(t, b, 2), y0 = first_node(t, b, 1), y1 = end_node(t, b, 1);
    const int x0 = first_node(t, b, 0), x1 = end_node(t, b, 0);
#pragma omp parallel for schedule(static) collapse(2)
    for (int k = z0; k < z1; ++k)
        for (int j = y0; j < y1; ++j)
            for (int i = x0; i < x1; ++i) visit(t, blk, (const int[]){i, j, k}, mesh_index(b, i, j, k), pair);
}

static void node_pressure(const transfer *t, int blk, const int node[3], ptrdiff_t at, const transfer_pair *pair)
{
    (void)pair;
    const fields *f = t->domain->fields[blk];
    const double mean = node_sum(t->mesh, &t->mesh->block[blk], node, field_get(f, C_PRESSURE_ADVANCED, 0, 0));
    field_get(f, N_PRESSURE, 0, 0)[at] = mean - t->reference_pressure;
}

floe_status transfer_pressure_to_nodes(transfer *t)
{
    domain_fill(t->domain, C_PRESSURE_ADVANCED, 0, FILL_CURRENT);
    for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_nodes(t, blk, NULL, node_pressure);
    return FLOE_OK;
}

static void node_change(const transfer *t, int blk, const int node[3], ptrdiff_t at, const transfer_pair *pair)
{
    const fields *f = t->domain->fields[blk];
    if (!(field_get(f, N_MASS, pair->group, 0)[at] > 0.0)) return;
    for (int a = 0; a < t->mesh->dim; ++a)
        field_get(f, N_VEL_L, pair->group, a)[at] +=
            node_sum(t->mesh, &t->mesh->block[blk], node, field_get(f, C_VELOCITY_CHANGE, pair->material, a));
}

/* A point whose cells are all to lose the share s loses s: with the weights w of mass, sum_p m_p sum_i S_ip sum_c w_ci s_c is what they are to lose
 * together. */
static void share_of_cells(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const double most_share = 0.5;
    const block *b = &t->mesh->block[blk];
    const fields *f = t->domain->fields[blk];
    if (pair->reaction < 0) return;
    const double *rho = field_get(f, C_RHO, pair->material, 0);
    double *share = field_get(f, C_REACTED, pair->reaction, 0);
    for (int i = 0; i < b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(b, i, j, k);
        share[at] = share[at] > 0.0 ? fmin(share[at] / rho[at], most_share) : 0.0;
    }
}

static void node_share(const transfer *t, int blk, const int node[3], ptrdiff_t at, const transfer_pair *pair)
{
    const fields *f = t->domain->fields[blk];
    field_get(f, N_BURNT_SHARE, pair->group, 0)[at] =
        node_sum(t->mesh, &t->mesh->block[blk], node, field_get(f, C_REACTED, pair->reaction, 0));
}

floe_status transfer_share_to_nodes(transfer *t)
{
    for_rows(t, share_of_cells);
    for (int p = 0; p < t->n_pairs; ++p) {
        if (t->pair[p].reaction < 0) continue;
        domain_fill(t->domain, C_REACTED, t->pair[p].reaction, FILL_CURRENT);
        for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_nodes(t, blk, &t->pair[p], node_share);
    }
    return FLOE_OK;
}

static void burnt_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const mesh *m = t->mesh;
    const block *b = &m->block[blk];
    const fields *f = t->domain->fields[blk];
    const int g = pair->group, q = pair->reaction;
    if (q < 0) return;
    for (int i = 0; i < b->n[0]; ++i) {
        double w[3][2];
        const ptrdiff_t at = mesh_index(b, i, j, k);
        const double inverse = 1.0 / mesh_cell_volume(m, b->lo[0] + i);
        cell_weights(m, b, (const int[]){i, j, k}, w);
        const double(*weight)[2] = (const double(*)[2])w;
        field_get(f, C_REACTED, q, 0)[at] = inverse * cell_sum(m, b, weight, at, field_get(f, N_BURNT, g, 0));
        field_get(f, C_BURNT_ENERGY, q, 0)[at] =
            inverse * cell_sum(m, b, weight, at, field_get(f, N_BURNT_ENERGY, g, 0));
        for (int a = 0; a < m->dim; ++a)
            field_get(f, C_BURNT_MOMENTUM, q, a)[at] =
                inverse * cell_sum(m, b, weight, at, field_get(f, N_BURNT_MOMENTUM, g, a));
    }
}

floe_status transfer_burnt_to_cells(transfer *t)
{
    for_rows(t, burnt_from_nodes);
    return FLOE_OK;
}

floe_status transfer_change_to_nodes(transfer *t)
{
    for (int p = 0; p < t->n_pairs; ++p) {
        domain_fill(t->domain, C_VELOCITY_CHANGE, t->pair[p].material, FILL_CURRENT);
        for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_nodes(t, blk, &t->pair[p], node_change);
    }
    return FLOE_OK;
}

#include "coupling/node_cell_transfer.h"
#include "coupling/coupling_constants.h"

#include "coupling/strip.h"

#include <math.h>

/* What is done for one row of cells of one solid. */
typedef void row_function(const transfer *t, int blk, const transfer_pair *pair, int j, int k);

static void for_each_row(const transfer *t, row_function *row)
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

/* T_c = sum w C_i T_i / (m_c c), `mass` being m_c. */
static void temperatures_from_nodes(const strip *s, const fields *f, const transfer_pair *pair, const double *mass,
                                    double *T)
{
    if (pair->warms) strip_sum(s, field_get(f, N_HEAT, pair->group, 0), NULL, T, STRIP_SUM);
    for (ptrdiff_t at = s->at; at < s->at + s->n; ++at)
        T[at] = pair->warms && mass[at] > 0.0 ? T[at] / (mass[at] * pair->specific_heat) : pair->temperature;
}

static void cells_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const mesh *m = t->mesh;
    const block *b = &m->block[blk];
    const fields *f = t->domain->fields[blk];
    const strip s = strip_of_cells(m, b, j, k);
    /* Both states get them: what is read between steps must not depend on the step before the last. */
    double *rho = field_get(f, C_RHO, pair->material, 0), *rho_next = field_next(f, C_RHO, pair->material, 0);
    double *T = field_get(f, C_TEMP, pair->material, 0);
    strip_sum(&s, field_get(f, N_MASS, pair->group, 0), NULL, rho, STRIP_SUM);
    temperatures_from_nodes(&s, f, pair, rho, T);
    for (int a = 0; a < m->dim; ++a) {
        double *u = field_get(f, C_VEL, pair->material, a), *u_next = field_next(f, C_VEL, pair->material, a);
        strip_sum(&s, field_get(f, N_MOMENTUM, pair->group, a), NULL, u, STRIP_SUM);
        for (ptrdiff_t at = s.at; at < s.at + s.n; ++at) u[at] = u_next[at] = rho[at] > 0.0 ? u[at] / rho[at] : 0.0;
    }
    for (int i = 0; i < s.n; ++i)
        rho[s.at + i] = rho_next[s.at + i] = rho[s.at + i] / mesh_cell_volume(m, b->lo[0] + i);
}

floe_status transfer_nodes_to_cells(transfer *t)
{
    for_each_row(t, cells_from_nodes);
    return FLOE_OK;
}

/* A row's momentum along each axis, to the current or next arrays of a field of the cells. */
static void sum_momentum(const transfer *t, int blk, const transfer_pair *pair, int j, int k, field_id to, bool next)
{
    const fields *f = t->domain->fields[blk];
    const strip s = strip_of_cells(t->mesh, &t->mesh->block[blk], j, k);
    for (int a = 0; a < t->mesh->dim; ++a)
        strip_sum(&s, field_get(f, N_MASS, pair->group, 0), field_get(f, N_VEL_L, pair->group, a),
                  (next ? field_next : field_get)(f, to, pair->material, a), STRIP_SUM_PRODUCT);
}

static void momentum_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    sum_momentum(t, blk, pair, j, k, C_MOMENTUM_L, false);
}

floe_status transfer_momentum_to_cells(transfer *t)
{
    for_each_row(t, momentum_from_nodes);
    return FLOE_OK;
}

/* The same for rows of nodes, and one ghost layer of them where a neighbour's cells are at hand. */
typedef void node_row_function(const transfer *t, int blk, const transfer_pair *pair, const strip *s);

static void for_node_rows(const transfer *t, int blk, const transfer_pair *pair, node_row_function *row)
{
    const mesh *m = t->mesh;
    const block *b = &m->block[blk];
    const int z0 = strip_first_node(m, b, 2), z1 = strip_end_node(m, b, 2);
    const int y0 = strip_first_node(m, b, 1), y1 = strip_end_node(m, b, 1);
#pragma omp parallel for schedule(static) collapse(2)
    for (int k = z0; k < z1; ++k)
        for (int j = y0; j < y1; ++j) {
            const strip s = strip_of_nodes(m, b, j, k);
            row(t, blk, pair, &s);
        }
}

static void node_pressure(const transfer *t, int blk, const transfer_pair *pair, const strip *s)
{
    (void)pair;
    const fields *f = t->domain->fields[blk];
    double *p = field_get(f, N_PRESSURE, 0, 0);
    strip_sum(s, field_get(f, C_PRESSURE_ADVANCED, 0, 0), NULL, p, STRIP_SUM);
    for (ptrdiff_t at = s->at; at < s->at + s->n; ++at) p[at] -= t->reference_pressure;
}

floe_status transfer_pressure_to_nodes(transfer *t)
{
    domain_fill(t->domain, C_PRESSURE_ADVANCED, 0, FILL_CURRENT);
    for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_node_rows(t, blk, NULL, node_pressure);
    return FLOE_OK;
}

static void node_change(const transfer *t, int blk, const transfer_pair *pair, const strip *s)
{
    const fields *f = t->domain->fields[blk];
    for (int a = 0; a < t->mesh->dim; ++a)
        strip_sum(s, field_get(f, C_VELOCITY_CHANGE, pair->material, a), field_get(f, N_MASS, pair->group, 0),
                  field_get(f, N_VEL_L, pair->group, a), STRIP_ADD_WHERE);
}

/* A point whose cells are all to lose the share s loses s: with the weights w of mass, sum_p m_p sum_i S_ip sum_c w_ci
 * s_c is what they are to lose together. */
static void share_of_cells(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const block *b = &t->mesh->block[blk];
    const fields *f = t->domain->fields[blk];
    if (pair->reaction < 0) return;
    const double *rho = field_get(f, C_RHO, pair->material, 0);
    double *share = field_get(f, C_REACTED, pair->reaction, 0);
    for (int i = 0; i < b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(b, i, j, k);
        share[at] = share[at] > 0.0 ? fmin(share[at] / rho[at], TRANSFER_MOST_SHARE) : 0.0;
    }
}

static void node_share(const transfer *t, int blk, const transfer_pair *pair, const strip *s)
{
    const fields *f = t->domain->fields[blk];
    strip_sum(s, field_get(f, C_REACTED, pair->reaction, 0), NULL, field_get(f, N_BURNT_SHARE, pair->group, 0),
              STRIP_SUM);
}

floe_status transfer_share_to_nodes(transfer *t)
{
    for_each_row(t, share_of_cells);
    for (int p = 0; p < t->n_pairs; ++p) {
        if (t->pair[p].reaction < 0) continue;
        domain_fill(t->domain, C_REACTED, t->pair[p].reaction, FILL_CURRENT);
        for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_node_rows(t, blk, &t->pair[p], node_share);
    }
    return FLOE_OK;
}

/* Sums over nodes, per cell volume. */
static void density_from_nodes(const transfer *t, const block *b, const strip *s, const double *node, double *cell)
{
    strip_sum(s, node, NULL, cell, STRIP_SUM);
    for (int i = 0; i < s->n; ++i) cell[s->at + i] *= 1.0 / mesh_cell_volume(t->mesh, b->lo[0] + i);
}

static void burnt_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const block *b = &t->mesh->block[blk];
    const fields *f = t->domain->fields[blk];
    const int g = pair->group, q = pair->reaction;
    if (q < 0) return;
    const strip s = strip_of_cells(t->mesh, b, j, k);
    density_from_nodes(t, b, &s, field_get(f, N_BURNT, g, 0), field_get(f, C_REACTED, q, 0));
    density_from_nodes(t, b, &s, field_get(f, N_BURNT_ENERGY, g, 0), field_get(f, C_BURNT_ENERGY, q, 0));
    for (int a = 0; a < t->mesh->dim; ++a)
        density_from_nodes(t, b, &s, field_get(f, N_BURNT_MOMENTUM, g, a), field_get(f, C_BURNT_MOMENTUM, q, a));
}

floe_status transfer_burnt_to_cells(transfer *t)
{
    for_each_row(t, burnt_from_nodes);
    return FLOE_OK;
}

static void node_temperature_change(const transfer *t, int blk, const transfer_pair *pair, const strip *s)
{
    const fields *f = t->domain->fields[blk];
    strip_sum(s, field_get(f, C_TEMP_CHANGE, pair->material, 0), field_get(f, N_CAPACITY, pair->group, 0),
              field_get(f, N_TEMP_CHANGE, pair->group, 0), STRIP_ADD_WHERE);
}

floe_status transfer_temperature_to_nodes(transfer *t)
{
    for (int p = 0; p < t->n_pairs; ++p) {
        if (!t->pair[p].exchanges) continue;
        domain_fill(t->domain, C_TEMP_CHANGE, t->pair[p].material, FILL_CURRENT);
        for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_node_rows(t, blk, &t->pair[p], node_temperature_change);
    }
    return FLOE_OK;
}

static void momentum_before(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    sum_momentum(t, blk, pair, j, k, C_STRESS_ACCEL, true);
}

floe_status transfer_momentum_before(transfer *t)
{
    for_each_row(t, momentum_before);
    return FLOE_OK;
}

/* C_VELOCITY_CHANGE, which the nodes have, takes the momentum after. */
static void stress_from_nodes(const transfer *t, int blk, const transfer_pair *pair, int j, int k)
{
    const block *b = &t->mesh->block[blk];
    const fields *f = t->domain->fields[blk];
    const double *rho = field_get(f, C_RHO, pair->material, 0);
    sum_momentum(t, blk, pair, j, k, C_VELOCITY_CHANGE, false);
    for (int a = 0; a < t->mesh->dim; ++a) {
        const double *u = field_get(f, C_VEL, pair->material, a),
                     *loaded = field_get(f, C_MOMENTUM_L, pair->material, a);
        const double *after = field_get(f, C_VELOCITY_CHANGE, pair->material, a);
        double *next = field_next(f, C_STRESS_ACCEL, pair->material, a);
        for (int i = 0; i < b->n[0]; ++i) {
            const ptrdiff_t at = mesh_index(b, i, j, k);
            const double mass = rho[at] * mesh_cell_volume(t->mesh, b->lo[0] + i);
            const double impulse = (loaded[at] - mass * u[at]) + (after[at] - next[at]);
            next[at] = mass > 0.0 ? impulse / (mass * t->dt) - t->gravity[a] : 0.0;
        }
    }
}

floe_status transfer_stress_to_cells(transfer *t)
{
    for_each_row(t, stress_from_nodes);
    return FLOE_OK;
}

floe_status transfer_change_to_nodes(transfer *t)
{
    for (int p = 0; p < t->n_pairs; ++p) {
        domain_fill(t->domain, C_VELOCITY_CHANGE, t->pair[p].material, FILL_CURRENT);
        for (int blk = 0; blk < t->mesh->n_blocks; ++blk) for_node_rows(t, blk, &t->pair[p], node_change);
    }
    return FLOE_OK;
}

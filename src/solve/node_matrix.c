#include "solve/node_matrix.h"

#include "base/memory.h"

#include <string.h>

floe_status node_matrix_create(node_matrix **out, context *ctx, const solve_grid *g, int components, int width, int arm)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    node_matrix *m = *out;
    *m = (node_matrix){
        .ctx = ctx, .grid = *g, .components = components, .width = width, .arm = arm, .side = 2 * width + 1};
    m->slots = 1;
    for (int a = 0; a < g->dim; ++a) m->slots *= m->side;
    m->arms = g->dim * arm;
    m->slots += 2 * m->arms;
    const floe_status status = memory_new(ctx, &m->row, g->size, sizeof *m->row);
    if (status != FLOE_OK) node_matrix_destroy(out);
    return status;
}

static void drop_rows(node_matrix *m)
{
    memory_free(m->ctx, &m->place);
    memory_free(m->ctx, &m->column);
    memory_free(m->ctx, &m->value);
    m->rows = 0;
}

void node_matrix_destroy(node_matrix **m)
{
    if (!m || !*m) return;
    context *ctx = (*m)->ctx;
    drop_rows(*m);
    memory_free(ctx, &(*m)->row);
    memory_free(ctx, m);
}

/* Index along an axis brought back around a periodic end; -1: beyond the grid. */
static int wrapped_index(const solve_grid *g, int axis, int i)
{
    if (g->periodic[axis]) return (i % g->n[axis] + g->n[axis]) % g->n[axis];
    return i >= 0 && i < g->n[axis] ? i : -1;
}

/* How far from its row's unknown that of a slot lies. */
static void offset_of_slot(const node_matrix *m, int slot, int offset[MESH_MAX_DIM])
{
    const int after = slot - (m->slots - m->arms), before = m->arms - 1 - slot;
    for (int a = 0; a < MESH_MAX_DIM; ++a) offset[a] = 0;
    if (after >= 0 || before >= 0) {
        const int arm = after >= 0 ? after : before, far = m->width + 1 + arm % m->arm;
        offset[arm / m->arm] = after >= 0 ? far : -far;
        return;
    }
    slot -= m->arms;
    for (int a = 0; a < m->grid.dim; ++a) {
        offset[a] = slot % m->side - m->width;
        slot /= m->side;
    }
}

/* The place that a slot of the unknown at (i, j, k) couples with, or -1. */
static int place_of_slot(const node_matrix *m, const int at[MESH_MAX_DIM], int slot)
{
    int offset[MESH_MAX_DIM], other[MESH_MAX_DIM] = {0, 0, 0};
    offset_of_slot(m, slot, offset);
    for (int a = 0; a < m->grid.dim; ++a) {
        other[a] = wrapped_index(&m->grid, a, at[a] + offset[a]);
        if (other[a] < 0) return -1;
    }
    return (int)solve_index(&m->grid, other[0], other[1], other[2]);
}

static void fill_columns(node_matrix *m, int row, const int at[MESH_MAX_DIM])
{
    for (int slot = 0; slot < m->slots; ++slot) {
        const int place = place_of_slot(m, at, slot);
        m->column[(size_t)row * (size_t)m->slots + (size_t)slot] =
            place >= 0 && m->row[place] >= 0 ? place : m->place[row];
    }
}

floe_status node_matrix_shape(node_matrix *m, const bool *takes_part)
{
    const solve_grid *g = &m->grid;
    drop_rows(m);
    for (size_t k = 0; k < g->size; ++k) m->row[k] = -1;
    for (int r = 0; r < solve_rows(g); ++r)
        for (int i = 0; i < g->n[0]; ++i)
            if (takes_part[solve_row(g, r) + i]) m->row[solve_row(g, r) + i] = m->rows++;
    const size_t slots = (size_t)m->rows * (size_t)m->slots;
    TRY(memory_new(m->ctx, &m->place, (size_t)m->rows, sizeof *m->place));
    TRY(memory_new(m->ctx, &m->column, slots, sizeof *m->column));
    TRY(memory_new(m->ctx, &m->value, slots * (size_t)(m->components * m->components), sizeof *m->value));
    for (size_t k = 0; k < g->size; ++k)
        if (m->row[k] >= 0) m->place[m->row[k]] = (int)k;
    for (int r = 0; r < solve_rows(g); ++r)
        for (int i = 0; i < g->n[0]; ++i) {
            const int row = m->row[solve_row(g, r) + i];
            if (row >= 0) fill_columns(m, row, (const int[]){i, r % g->n[1], r / g->n[1]});
        }
    return FLOE_OK;
}

void node_matrix_constrain(node_matrix *m, const bool *constrained)
{
    const size_t size = m->grid.size;
    for (int row = 0; row < m->rows; ++row) {
        const int *column = m->column + (size_t)row * (size_t)m->slots;
        for (int c = 0; c < m->components; ++c)
            for (int c2 = 0; c2 < m->components; ++c2) {
                double *value = node_matrix_entries(m, row, c, c2);
                const bool whole = constrained[(size_t)c * size + (size_t)m->place[row]];
                for (int slot = 0; slot < m->slots; ++slot)
                    if (whole || constrained[(size_t)c2 * size + (size_t)column[slot]]) value[slot] = 0.0;
            }
    }
}

/* Takes a direction out of a block at a slot of a row: on its left, or on its right. */
static void project_block(node_matrix *m, int row, int slot, const double *q, bool left)
{
    const int n = m->components;
    for (int c = 0; c < n; ++c) {
        double sum = 0.0;
        for (int k = 0; k < n; ++k)
            sum += q[k] * (left ? node_matrix_entries(m, row, k, c) : node_matrix_entries(m, row, c, k))[slot];
        for (int k = 0; k < n; ++k)
            (left ? node_matrix_entries(m, row, k, c) : node_matrix_entries(m, row, c, k))[slot] -= q[k] * sum;
    }
}

void node_matrix_project(node_matrix *m, int row, int n, const double *direction, double stiffness)
{
    const int *column = m->column + (size_t)row * (size_t)m->slots, centre = m->slots / 2;
    for (int k = 0; k < n; ++k) {
        const double *q = direction + (size_t)k * (size_t)m->components;
        for (int slot = 0; slot < m->slots; ++slot) {
            if (column[slot] == m->place[row] && slot != centre) continue;
            project_block(m, row, slot, q, true);
            project_block(m, m->row[column[slot]], m->slots - 1 - slot, q, false);
        }
        for (int c = 0; c < m->components; ++c)
            for (int c2 = 0; c2 < m->components; ++c2)
                node_matrix_entries(m, row, c, c2)[centre] += stiffness * q[c] * q[c2];
    }
}

void node_matrix_apply(const node_matrix *m, const double *x, double *y)
{
    const size_t size = m->grid.size;
    const int slots = m->slots, components = m->components;
    memset(y, 0, (size_t)components * size * sizeof *y);
#pragma omp parallel for schedule(static) if (m->rows > 2048)
    for (int row = 0; row < m->rows; ++row) {
        const int *restrict column = m->column + (size_t)row * (size_t)slots;
        for (int c = 0; c < components; ++c) {
            double sum = 0.0;
            for (int c2 = 0; c2 < components; ++c2) {
                const double *restrict value = node_matrix_entries(m, row, c, c2), *restrict from =
                                                                                       x + (size_t)c2 * size;
#pragma omp simd reduction(+ : sum)
                for (int slot = 0; slot < slots; ++slot) sum += value[slot] * from[column[slot]];
            }
            y[(size_t)c * size + (size_t)m->place[row]] = sum;
        }
    }
}

/* Edges held by the penalty (edge.h) in the balance of forces: what their lines push, and the stiffness of that. */
#include "mpm/balance.h"
#include "mpm/edge.h"

#include <stdlib.h>

static int place_of(const mpm *s, const edge_node *n)
{
    return (int)solve_index(&s->balance->grid, n->at[0], n->at[1], n->at[2]);
}

static const edge_group *lines_of(const mpm *s)
{
    static const edge_group none = {.n_lines = 0};
    return s->work->edges ? &s->work->edges->group[0] : &none;
}

int balance_width(const mpm *s)
{
    const int lines = s->work->edges ? edge_taps(s) - 1 : 0, points = s->basis->support - 1;
    return lines > points ? lines : points;
}

floe_status balance_find_edges(mpm *s)
{
    return s->work->edges ? edges_find(s, 0, true) : FLOE_OK;
}

void balance_pull_edges(mpm *s, const double *u, double *inner)
{
    const edge_group *g = lines_of(s);
    const size_t dim = (size_t)s->mesh->dim;
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const edge_line *l = &g->line[k];
            const size_t base = (size_t)c * s->balance->grid.size;
            const double *weight = edge_weights(l, c);
            double difference = s->work->edges->memory[l->slot + (size_t)c];
            for (int t = 0; t < EDGE_TAPS; ++t)
                difference += weight[t] * u[base + (size_t)place_of(s, &g->node[l->node[t]])];
            g->next[k * dim + (size_t)c] = difference;
            for (int t = 0; t < EDGE_TAPS; ++t)
                inner[base + (size_t)place_of(s, &g->node[l->node[t]])] -= l->stiffness * weight[t] * difference;
        }
}

/* Entry of a pair of taps, which lie within the matrix's width of each other, around a periodic end where need be. */
static void add_pair(const mpm *s, node_matrix *m, const edge_node *from, const edge_node *to, int c, double value)
{
    const int row = m->row[place_of(s, from)];
    int offset[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        offset[a] = to->at[a] - from->at[a];
        if (abs(offset[a]) > m->width) offset[a] += offset[a] < 0 ? s->mesh->n[a] : -s->mesh->n[a];
    }
    if (row >= 0) node_matrix_entries(m, row, c, c)[node_matrix_slot(m, offset)] += value;
}

void balance_assemble_edges(mpm *s, node_matrix *m)
{
    const edge_group *g = lines_of(s);
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const edge_line *l = &g->line[k];
            const double *w = edge_weights(l, c);
            for (int i = 0; i < edge_taps(s); ++i)
                for (int j = 0; j < edge_taps(s); ++j)
                    add_pair(s, m, &g->node[l->node[i]], &g->node[l->node[j]], c, l->stiffness * w[i] * w[j]);
        }
}

void balance_enter_edges(mpm *s)
{
    const edge_group *g = lines_of(s);
    double energy = 0.0;
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double before = s->work->edges->memory[g->line[k].slot + (size_t)c];
            const double now = g->next[k * (size_t)s->mesh->dim + (size_t)c];
            energy += 0.5 * g->line[k].stiffness * (now * now - before * before);
        }
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, -energy);
}

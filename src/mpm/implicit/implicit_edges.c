/* Ghost penalty at edges (edge.h) in the implicit solver: forces of its lines and their stiffness. */
#include "mpm/edge/edge.h"
#include "mpm/edge/edge_lines.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"

#include <stdlib.h>

static int node_index(const mpm *s, const edge_node *n)
{
    return (int)solve_index(&s->implicit->grid, n->at[0], n->at[1], n->at[2]);
}

/* Groups with the penalty: one for each displacement field. */
static int count_groups(const mpm *s)
{
    return s->edges ? s->implicit->layers : 0;
}

int implicit_arm(const mpm *s)
{
    const int lines = s->edges ? edge_taps(s) - 1 : 0, points = implicit_width(s);
    return lines > points ? lines - points : 0;
}

floe_status implicit_find_edges(mpm *s)
{
    for (int g = 0; g < count_groups(s); ++g) TRY(edges_find(s, g, true));
    return FLOE_OK;
}

static void pull_group(mpm *s, int layer, const double *u, double *internal)
{
    edge_group *g = &s->edges->group[layer];
    const size_t dim = (size_t)s->mesh->dim;
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const edge_line *l = &g->line[k];
            const size_t base = implicit_index(s->implicit, layer, c, 0);
            double *difference = &g->next[k * dim + (size_t)c];
            *difference = s->edges->memory[l->slot + (size_t)c];
            for (int t = 0; t < EDGE_TAPS; ++t)
                *difference += edge_weights(l, c)[t] * u[base + (size_t)node_index(s, &g->node[l->node[t]])];
        }
    edges_let_flow(s, g);
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const edge_line *l = &g->line[k];
            const size_t base = implicit_index(s->implicit, layer, c, 0);
            const double tension = l->stiffness * g->next[k * dim + (size_t)c];
            for (int t = 0; t < EDGE_TAPS; ++t)
                internal[base + (size_t)node_index(s, &g->node[l->node[t]])] -= tension * edge_weights(l, c)[t];
        }
}

void implicit_edge_force(mpm *s, const double *u, double *internal)
{
    for (int g = 0; g < count_groups(s); ++g) pull_group(s, g, u, internal);
}

/* Entry of a pair of taps along an axis, of components c and d of the matrix, which lie within the matrix's reach of each other, around a
 * periodic end where need be. Nodes that no point reaches, in supports, have none. */
static void add_pair(const mpm *s, node_matrix *m, const edge_node *from, const edge_node *to, int axis, const int c[2],
                     double value)
{
    const int row = m->row[node_index(s, from)];
    int far = to->at[axis] - from->at[axis];
    if (abs(far) > m->width + m->arm) far += far < 0 ? s->mesh->n[axis] : -s->mesh->n[axis];
    if (row >= 0 && m->row[node_index(s, to)] >= 0)
        node_matrix_entries(m, row, c[0], c[1])[node_matrix_slot_along(m, axis, far)] += value;
}

/* Slope of a line's force of component c over its difference of component d: k, and of one that yields k (most/|D u|) (1 - n n^T), n along D u, with a little
 * along n so that no node is left without. `now` are its differences. */
static double slope_of_line(const edge_line *l, const double *now, int c, int d)
{
    const double same = c == d ? 1.0 : 0.0;
    if (!(l->kept < 1.0)) return same * l->stiffness;
    const double along = now[c] * now[d] / (l->most * l->most);
    return l->stiffness * (l->kept * (same - along) + MPM_FLOWING_LINE * along);
}

static void assemble_line(const mpm *s, const edge_group *g, const edge_line *l, const double *now, int first,
                          node_matrix *m)
{
    for (int c = 0; c < s->mesh->dim; ++c)
        for (int d = 0; d < s->mesh->dim; ++d) {
            const double slope = slope_of_line(l, now, c, d), *w = edge_weights(l, c), *v = edge_weights(l, d);
            const int at[2] = {first + c, first + d};
            if (slope == 0.0) continue;
            for (int i = 0; i < edge_taps(s); ++i)
                for (int j = 0; j < edge_taps(s); ++j)
                    add_pair(s, m, &g->node[l->node[i]], &g->node[l->node[j]], l->axis, at, slope * w[i] * v[j]);
        }
}

static void assemble_group(const mpm *s, int layer, node_matrix *m)
{
    const edge_group *g = &s->edges->group[layer];
    const size_t dim = (size_t)s->mesh->dim;
    for (size_t k = 0; k < g->n_lines; ++k)
        assemble_line(s, g, &g->line[k], g->next + k * dim, layer * s->mesh->dim, m);
}

void implicit_assemble_edges(mpm *s, node_matrix *m)
{
    for (int g = 0; g < count_groups(s); ++g) assemble_group(s, g, m);
}

void implicit_stiffen_edges(mpm *s, node_matrix *m)
{
    for (int g = 0; g < count_groups(s); ++g) {
        edge_group *of = &s->edges->group[g];
        for (size_t k = 0; k < of->n_lines; ++k) of->line[k].kept = 1.0;
        assemble_group(s, g, m);
    }
}

static double gain_of_group(const mpm *s, const edge_group *g)
{
    double energy = 0.0;
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double before = s->edges->memory[g->line[k].slot + (size_t)c];
            const double now = g->next[k * (size_t)s->mesh->dim + (size_t)c];
            energy += 0.5 * g->line[k].stiffness * (now * now - before * before);
        }
    return energy;
}

void implicit_enter_edges(mpm *s)
{
    double energy = 0.0;
    for (int g = 0; g < count_groups(s); ++g) energy += gain_of_group(s, &s->edges->group[g]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, -energy);
}

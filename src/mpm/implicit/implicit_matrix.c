/* The matrix of the nodes from the tangents of the points. */
#include "mpm/implicit/implicit.h"

#include <string.h>

void implicit_for_tiles(mpm *s, implicit_tile *visit, void *user)
{
    const mesh *m = s->mesh;
    const struct mpm_implicit *w = s->implicit;
    int colours = 1, tiles[MESH_MAX_DIM] = {1, 1, 1};
    bool apart = true; /* of one colour: across a periodic end two neighbours have the same where their number is odd */
    for (int a = 0; a < m->dim; ++a) {
        tiles[a] = (m->tiles[a] + 1) / 2;
        colours *= 2;
        apart = apart && !(m->periodic[a] && m->tiles[a] % 2);
    }
    const int n = tiles[0] * tiles[1] * tiles[2];
    for (int colour = 0; colour < colours; ++colour) {
#pragma omp parallel for schedule(dynamic, 1) if (apart)
        for (int t = 0; t < n; ++t) {
            const int at[MESH_MAX_DIM] = {2 * (t % tiles[0]) + (colour & 1),
                                          2 * (t / tiles[0] % tiles[1]) + (colour >> 1 & 1),
                                          2 * (t / (tiles[0] * tiles[1])) + (colour >> 2 & 1)};
            if (at[0] >= m->tiles[0] || at[1] >= m->tiles[1] || at[2] >= m->tiles[2]) continue;
            const int number = at[0] + m->tiles[0] * (at[1] + m->tiles[1] * at[2]);
            visit(s, w->tile_block[number], w->tile_local[number], user);
        }
    }
}

/* tangent times the gradient that a unit of component c of a node makes. */
static void pull_of_node(const mpm *s, const weighted_node *node, const double *tangent, double radius, int c,
                         double out[IMPLICIT_GRADIENTS])
{
    const struct mpm_implicit *w = s->implicit;
    const int n = w->n_gradient;
    for (int r = 0; r < n; ++r) {
        double sum = 0.0;
        for (int g = 0; g < n; ++g) {
            const int i = w->gradient[g] / 3, j = w->gradient[g] % 3;
            if (i == c && j < s->mesh->dim) sum += tangent[r * n + g] * node->slope[c][j];
            if (i == 2 && s->mesh->dim == 2 && c == 0) sum += tangent[r * n + g] * node->S[0] / radius;
        }
        out[r] = sum;
    }
}

/* Adds a column of the point's matrix: forces on every node for a unit of component c of node j; base: the first
 * component of its layer. */
static void add_column(const mpm *s, node_matrix *m, const weighted_node *node, int nodes, int j, int base, int c,
                       const double pull[IMPLICIT_GRADIENTS], double radius)
{
    const struct mpm_implicit *w = s->implicit;
    double T[IMPLICIT_GRADIENTS] = {0.0};
    for (int r = 0; r < w->n_gradient; ++r) T[w->gradient[r]] = pull[r];
    const double hoop = s->mesh->geometry == MESH_AXISYMMETRIC ? T[8] / radius : 0.0;
    for (int i = 0; i < nodes; ++i) {
        const int row = m->row[node[i].at];
        int offset[MESH_MAX_DIM];
        for (int a = 0; a < MESH_MAX_DIM; ++a) offset[a] = node[j].node[a] - node[i].node[a];
        const int slot = node_matrix_slot(m, offset);
        for (int c2 = 0; row >= 0 && c2 < s->mesh->dim; ++c2) {
            double sum = c2 == 0 ? hoop * node[i].S[0] : 0.0;
            for (int a = 0; a < s->mesh->dim; ++a) sum += T[3 * c2 + a] * node[i].slope[c2][a];
            node_matrix_entries(m, row, base + c2, base + c)[slot] += sum;
        }
    }
}

/* Which tangents become which matrix. */
typedef struct assembly {
    node_matrix *matrix;
    const double *tangent; /* as mpm_implicit has it */
} assembly;

static void assemble_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_implicit *w = s->implicit;
    const assembly *of = user;
    const size_t square = (size_t)w->n_gradient * (size_t)w->n_gradient;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid || body >= s->n_deforming) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        for (size_t k = range[0]; k < range[1]; ++k) {
            const size_t number = w->first[blk][body] + k;
            const double radius = w->weights[number].radius;
            weighted_node node[IMPLICIT_NODES];
            const int n = implicit_nodes(s, &w->weights[number], node);
            for (int j = 0; j < n; ++j)
                for (int c = 0; c < s->mesh->dim && w->reached[implicit_index(w, w->layer[body], c, node[j].at)]; ++c) {
                    double pull[IMPLICIT_GRADIENTS];
                    pull_of_node(s, &node[j], of->tangent + number * square, radius, c, pull);
                    add_column(s, of->matrix, node, n, j, w->layer[body] * s->mesh->dim, c, pull, radius);
                }
        }
    }
}

void implicit_assemble(mpm *s, node_matrix *m, const double *tangent)
{
    memset(m->value, 0,
           (size_t)m->rows * (size_t)m->slots * (size_t)(m->components * m->components) * sizeof *m->value);
    implicit_for_tiles(s, assemble_tile, &(assembly){m, tangent});
}

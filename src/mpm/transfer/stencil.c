#include "mpm/transfer/stencil.h"

#include <string.h>

static int stencil_cell_of(const mesh *m, int axis, const double x[3])
{
    const int cell = mesh_cell_of(m, axis, x[axis]);
    return cell < 0 ? 0 : cell >= m->n[axis] ? m->n[axis] - 1 : cell;
}

place_stencil stencil_at(const mpm *s, const double x[3])
{
    int first[3] = {0, 0, 0}, count[3] = {1, 1, 1};
    double w[3][BASIS_MAX_SUPPORT] = {{1.0}, {1.0}, {1.0}}, slope[BASIS_MAX_SUPPORT];
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double inv_h = 1.0 / s->mesh->h[a];
        const int cell = stencil_cell_of(s->mesh, a, x);
        const double xi = (x[a] - mesh_node(s->mesh, a, cell)) * inv_h;
        first[a] = cell + s->basis->weights(xi, 0.25, inv_h, w[a], slope);
        count[a] = s->basis->support;
    }
    place_stencil st; /* most of it stays unused: it is not cleared */
    st.n = 0;
    for (int k = 0; k < count[2]; ++k)
        for (int j = 0; j < count[1]; ++j)
            for (int i = 0; i < count[0]; ++i) {
                memcpy(st.node[st.n], (const int[]){first[0] + i, first[1] + j, first[2] + k}, sizeof st.node[0]);
                st.mass[st.n] = 0.0;
                st.w[st.n++] = w[0][i] * w[1][j] * w[2][k];
            }
    return st;
}

int place_block(const mpm *s, const double x[3])
{
    int cell[3] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) cell[a] = stencil_cell_of(s->mesh, a, x);
    return mesh_block_of(s->mesh, cell);
}

void visit_stencil(const block *b, const place_stencil *st, stencil_node *visit, void *user)
{
    for (int i = 0; i < st->n; ++i) {
        int local[3];
        bool in_block = true;
        for (int a = 0; a < 3; ++a) {
            local[a] = st->node[i][a] - b->lo[a];
            in_block = in_block && (a >= b->dim || (local[a] >= -1 && local[a] <= b->n[a] + 1));
        }
        if (in_block) visit(user, mesh_index(b, local[0], local[1], local[2]), st->w[i], st->mass[i]);
    }
}

typedef struct place_force {
    double *force[3], value[3];
    int dim;
} place_force;

static void add_force_to_nodes(void *user, ptrdiff_t at, double weight, double mass)
{
    const place_force *f = user;
    (void)mass;
    for (int a = 0; a < f->dim; ++a) f->force[a][at] += weight * f->value[a];
}

void push_stencil(const mpm *s, int group, const place_stencil *st, const double force[3])
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        place_force f = {.dim = s->mesh->dim};
        for (int a = 0; a < f.dim; ++a) {
            f.force[a] = field_get(s->domain->fields[b], N_FORCE, group, a);
            f.value[a] = force[a];
        }
        visit_stencil(&s->mesh->block[b], st, add_force_to_nodes, &f);
    }
}

void push_nodes(const mpm *s, int group, const double x[3], const double force[3])
{
    const place_stencil st = stencil_at(s, x);
    push_stencil(s, group, &st, force);
}

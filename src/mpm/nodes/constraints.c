#include "mpm/nodes/constraints.h"

#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"

#include <string.h>

unsigned side_constraints(const mpm *s, int group, const int node[MESH_MAX_DIM])
{
    unsigned constrained = 0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (s->mesh->periodic[a] || (node[a] != 0 && node[a] != s->mesh->n[a])) continue;
        for (int c = 0; c < s->mesh->dim; ++c)
            if (wall_constrains(s, group, a, node[a] == 0 ? SIDE_LOWER : SIDE_UPPER, c)) constrained |= 1u << c;
    }
    return constrained;
}

unsigned node_constraints(const mpm *s, int group, const int node[MESH_MAX_DIM])
{
    const bool leads = supports_lead_group(s, group);
    for (size_t k = 0; k < s->supports->n; ++k)
        if (support_constrains(s, leads, &s->supports->node[k]) &&
            memcmp(s->supports->node[k].node, node, sizeof s->supports->node[k].node) == 0)
            return (1u << s->mesh->dim) - 1u;
    return side_constraints(s, group, node);
}

/* One component on a whole side. */
static void visit_constrained_side(const mesh *m, int axis, int side, int c, double velocity, constraint_visitor *visit,
                                   void *user)
{
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    side_node_range(m, axis, side, lo, hi);
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) visit(user, (const int[]){i, j, k}, c, velocity);
}

void visit_constraints(const mpm *s, int group, constraint_visitor *visit, void *user)
{
    const mesh *m = s->mesh;
    for (int axis = 0; axis < m->dim; ++axis)
        for (int side = 0; side < 2 && !m->periodic[axis]; ++side)
            for (int c = 0; c < m->dim; ++c)
                if (wall_constrains(s, group, axis, side, c))
                    visit_constrained_side(m, axis, side, c, wall_target(s, axis, side, c), visit, user);
    const bool leads = supports_lead_group(s, group);
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *support = &s->supports->node[k];
        if (!support_constrains(s, leads, support)) continue;
        int node[MESH_MAX_DIM] = {0, 0, 0};
        for (int a = 0; a < m->dim; ++a) node[a] = mesh_index_around(m, a, support->node[a]);
        for (int c = 0; c < m->dim; ++c) visit(user, node, c, support_velocity(s, support->support)[c]);
    }
}

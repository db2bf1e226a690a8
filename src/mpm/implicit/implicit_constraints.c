/* Maps between the nodes of the blocks and those of the solver: constraints, supports of the points, and surface
 * loads. */
#include "mpm/implicit/implicit.h"
#include "mpm/motion/motion_ties.h"
#include "mpm/nodes/constraints.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"

#include <string.h>

static void constrain_component(void *user, const int node[MESH_MAX_DIM], int c, double velocity)
{
    const mpm *s = user;
    struct mpm_implicit *w = s->implicit;
    for (int l = 0; l < w->layers; ++l) {
        const size_t at = implicit_index(w, l, c, (int)solve_index(&w->grid, node[0], node[1], node[2]));
        w->constrained[at] = true;
        w->prescribed[at] = s->dt * velocity;
    }
}

void implicit_constrain(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    memset(w->constrained, 0, w->components * sizeof *w->constrained);
    memset(w->prescribed, 0, w->components * sizeof *w->prescribed);
    visit_constraints(s, 0, constrain_component, s);
    motions_visit_ties(s, constrain_component, s);
    if (!w->led) return;
    memset(w->led, 0, w->grid.size * sizeof *w->led);
    for (size_t k = 0; k < s->supports->n && supports_lead_group(s, 0); ++k) {
        const int *node = s->supports->node[k].node;
        if (s->supports->node[k].led) w->led[solve_index(&w->grid, node[0], node[1], node[2])] = 1 + (int)k;
    }
}

static void reach_tile(mpm *s, int blk, int tile, void *user)
{
    bool *reached = user;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid || body >= s->n_deforming) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        for (size_t k = range[0]; k < range[1]; ++k) {
            weighted_node node[IMPLICIT_NODES];
            const int n = implicit_nodes(s, &s->implicit->weights[s->implicit->first[blk][body] + k], node);
            for (int i = 0; i < n; ++i) {
                bool any = false;
                for (int c = 0; c < s->mesh->dim; ++c)
                    for (int a = 0; a < s->mesh->dim; ++a) any = any || node[i].slope[c][a] != 0.0;
                for (int c = 0; any && c < s->mesh->dim; ++c)
                    reached[implicit_index(s->implicit, s->implicit->layer[body], c, node[i].at)] = true;
            }
        }
    }
}

void implicit_find_reached(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    memset(w->reached, 0, w->components * sizeof *w->reached);
    memset(w->row, 0, w->grid.size * sizeof *w->row);
    implicit_for_tiles(s, reach_tile, w->reached);
    for (int l = 0; l < w->layers; ++l)
        for (size_t k = 0; k < w->grid.size; ++k) w->row[k] = w->row[k] || w->reached[implicit_index(w, l, 0, (int)k)];
}

void implicit_drop_unreached(const struct mpm_implicit *w, double *force)
{
    for (size_t k = 0; k < w->components; ++k)
        if (!w->reached[k]) force[k] = 0.0;
}

void implicit_place(const mpm *s, size_t i, double x[MESH_MAX_DIM])
{
    const solve_grid *g = &s->implicit->grid;
    int node[MESH_MAX_DIM] = {0};
    ptrdiff_t rest = (ptrdiff_t)i;
    for (int a = g->dim - 1; a >= 0; --a) {
        node[a] = (int)(rest / g->stride[a]) - 1;
        rest %= g->stride[a];
    }
    place_of_node(s->mesh, node, x);
}

double implicit_displacement(const mpm *s, int group, const int node[MESH_MAX_DIM], int c)
{
    const struct mpm_implicit *w = s->implicit;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int n = s->mesh->n[a];
        if (s->mesh->periodic[a] || (node[a] >= 0 && node[a] <= n)) continue;
        const int side = node[a] < 0 ? SIDE_LOWER : SIDE_UPPER, wall = side == SIDE_LOWER ? 0 : n;
        int on_wall[MESH_MAX_DIM], inside[MESH_MAX_DIM];
        memcpy(on_wall, node, sizeof on_wall);
        memcpy(inside, node, sizeof inside);
        on_wall[a] = wall;
        inside[a] = 2 * wall - node[a];
        const double image = implicit_displacement(s, group, inside, c);
        if (wall_mirrors(s, 0, a, side)) return a == c ? -image : image;
        return 2.0 * implicit_displacement(s, group, on_wall, c) - image;
    }
    int at[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) at[a] = mesh_index_around(s->mesh, a, node[a]);
    const int here = (int)solve_index(&w->grid, at[0], at[1], at[2]), layer = implicit_layer(s, group);
    const double own = w->tried[implicit_index(w, layer, c, here)];
    if (!w->led || w->led[here] == 0) return own;
    const support_node *led = &s->supports->node[w->led[here] - 1];
    const int master = (int)solve_index(&w->grid, led->master[0], led->master[1], led->master[2]);
    return own + led->share * (w->tried[implicit_index(w, layer, c, master)] - own);
}

void implicit_collect(mpm *s, field_id id, int group, double *out)
{
    const struct mpm_implicit *w = s->implicit;
    const mesh *m = s->mesh;
    const int components = field_component_count(field_describe(id)->components, m->dim);
    for (int blk = 0; blk < m->n_blocks; ++blk) {
        const block *b = &m->block[blk];
        int end[MESH_MAX_DIM] = {1, 1, 1};
        for (int a = 0; a < m->dim; ++a) end[a] = b->n[a] + (b->at_side[a][SIDE_UPPER] && !m->periodic[a] ? 1 : 0);
        for (int c = 0; c < components; ++c) {
            const double *value = field_get(s->domain->fields[blk], id, group, c);
            for (int k = 0; k < end[2]; ++k)
                for (int j = 0; j < end[1]; ++j)
                    for (int i = 0; i < end[0]; ++i)
                        out[implicit_index(w, implicit_layer(s, group), c,
                                           (int)solve_index(&w->grid, b->lo[0] + i, b->lo[1] + j, b->lo[2] + k))] +=
                            value[mesh_index(b, i, j, k)];
        }
    }
}

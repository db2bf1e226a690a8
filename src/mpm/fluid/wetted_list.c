/* Lists the nodes at which both fluid and solid points have mass, and the grid lines of such nodes across the wall. */
#include "base/memory.h"
#include "mpm/fluid/wetted.h"
#include "mpm/fluid/wetted_parts.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/constraints.h"
#include "mpm/nodes/node.h"

#include <math.h>
#include <stdlib.h>

int wetted_solid(const mpm *s, int blk, ptrdiff_t local)
{
    return heaviest_group(s, s->domain->fields[blk], local, 0, s->wetted->fluid);
}

floe_status wetted_visit(mpm *s, int blk, const int lo[MESH_MAX_DIM], const int end[MESH_MAX_DIM],
                         shared_visitor *visit)
{
    const mpm_wetted *w = s->wetted;
    const block *b = &s->mesh->block[blk];
    const double *fluid = field_get(s->domain->fields[blk], N_MASS, w->fluid, 0);
    for (int k = lo[2]; k < end[2]; ++k)
        for (int j = lo[1]; j < end[1]; ++j)
            for (int i = lo[0]; i < end[0]; ++i) {
                const ptrdiff_t local = mesh_index(b, i, j, k);
                if (!(fluid[local] > 0.0 && wetted_solid(s, blk, local) >= 0)) continue;
                TRY(visit(s, blk, (const int[]){b->lo[0] + i, b->lo[1] + j, b->lo[2] + k}, local));
            }
    return FLOE_OK;
}

/* Components that sides constrain, and those across a side, have no area. */
static void drop_constrained(const mpm *s, wetted_node *n)
{
    const unsigned components = side_constraints(s, 0, n->at);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const bool at_side = !s->mesh->periodic[a] && (n->at[a] == 0 || n->at[a] == s->mesh->n[a]);
        if (at_side || is_constrained(components, a)) n->area[a] = 0.0;
    }
}

static floe_status list_wetted_node(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local)
{
    mpm_wetted *w = s->wetted;
    const fields *f = s->domain->fields[blk];
    if (w->n == w->reserved) {
        w->reserved = w->reserved ? 2 * w->reserved : 256;
        TRY(memory_resize(s->ctx, &w->node, (size_t)w->reserved, sizeof *w->node));
        TRY(memory_resize(s->ctx, &w->member, (size_t)w->reserved, sizeof *w->member));
        TRY(memory_resize(s->ctx, &w->first, (size_t)w->reserved + 1, sizeof *w->first));
    }
    wetted_node n = {.at = {at[0], at[1], at[2]}, .number = wetted_number(w, at), .solid = wetted_solid(s, blk, local)};
    for (int g = 0; g < 2; ++g) {
        const int group = g == FLUID ? w->fluid : n.solid;
        n.mass[g] = field_get(f, N_MASS, group, 0)[local];
        n.inertia[g] = motion_of_group(s, group) ? (double)INFINITY : n.mass[g];
        for (int c = 0; c < s->mesh->dim; ++c) {
            n.v[g][c] = field_get(f, N_VEL_L, group, c)[local];
            n.before[g][c] = field_get(f, N_MOMENTUM, group, c)[local] / n.mass[g];
            n.gained[g][c] = n.v[g][c] - n.before[g][c];
        }
    }
    for (int c = 0; c < s->mesh->dim; ++c) {
        n.area[c] = field_get(f, N_WETTED_AREA, w->fluid, c)[local];
        n.force[c] = field_get(f, N_FORCE, w->fluid, c)[local];
    }
    drop_constrained(s, &n);
    w->node[w->n++] = n;
    return FLOE_OK;
}

static int compare_numbers(const void *a, const void *b)
{
    const size_t i = ((const wetted_node *)a)->number, j = ((const wetted_node *)b)->number;
    return i < j ? -1 : i > j;
}

static floe_status list_wetted_nodes(mpm *s)
{
    mpm_wetted *w = s->wetted;
    for (int k = 0; k < w->n; ++k) w->index[w->node[k].number] = -1;
    w->n = 0;
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
        const block *b = &s->mesh->block[blk];
        int end[MESH_MAX_DIM];
        for (int a = 0; a < MESH_MAX_DIM; ++a)
            end[a] = a < s->mesh->dim ? b->n[a] + (b->at_side[a][SIDE_UPPER] && !s->mesh->periodic[a] ? 1 : 0) : 1;
        TRY(wetted_visit(s, blk, (const int[]){0, 0, 0}, end, list_wetted_node));
    }
    if (w->n > 0) qsort(w->node, (size_t)w->n, sizeof *w->node, compare_numbers); /* the same for any blocks */
    for (int k = 0; k < w->n; ++k) w->index[w->node[k].number] = k;
    return FLOE_OK;
}

int wetted_find(const mpm *s, const int at[MESH_MAX_DIM])
{
    const mpm_wetted *w = s->wetted;
    int g[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        g[a] = mesh_index_around(s->mesh, a, at[a]);
        if (g[a] < 0 || g[a] > s->mesh->n[a]) return -1;
    }
    return w->index[wetted_number(w, g)];
}

/* Whether j, on the line of k, lies nearer to the wall: ties are decided by position, so that no two nodes point to
 * each other. */
static bool leads(const wetted_node *j, const wetted_node *k)
{
    const double a = wetted_dot(j->area, j->area), b = wetted_dot(k->area, k->area);
    if (a != b) return a > b;
    for (int c = 0; c < MESH_MAX_DIM; ++c)
        if (j->at[c] != k->at[c]) return j->at[c] < k->at[c];
    return false;
}

/* The neighbour, along the axis closest to the normal of the surface, with the larger area in the same direction; itself where it is the root. */
static int next_on_line(const mpm *s, int k)
{
    const mpm_wetted *w = s->wetted;
    const wetted_node *n = &w->node[k];
    int axis = 0, best = k;
    for (int a = 1; a < s->mesh->dim; ++a)
        if (fabs(n->area[a]) > fabs(n->area[axis])) axis = a;
    for (int direction = -1; direction <= 1; direction += 2) {
        int at[MESH_MAX_DIM] = {n->at[0], n->at[1], n->at[2]};
        at[axis] += direction;
        const int j = wetted_find(s, at);
        if (j >= 0 && wetted_dot(w->node[j].area, n->area) > 0.0 && leads(&w->node[j], &w->node[best])) best = j;
    }
    return best;
}

static void find_lines(const mpm *s)
{
    mpm_wetted *w = s->wetted;
    for (int k = 0; k < w->n; ++k) w->node[k].root = next_on_line(s, k);
    for (int hops = 0; hops < 4; ++hops)
        for (int k = 0; k < w->n; ++k) w->node[k].root = w->node[w->node[k].root].root;
    for (int k = 0; k <= w->n; ++k) w->first[k] = 0;
    for (int k = 0; k < w->n; ++k) w->first[w->node[k].root + 1]++;
    for (int k = 0; k < w->n; ++k) w->first[k + 1] += w->first[k];
    for (int k = 0; k < w->n; ++k) w->member[w->first[w->node[k].root]++] = k;
    for (int k = w->n; k > 0; --k) w->first[k] = w->first[k - 1];
    w->first[0] = 0;
}

floe_status wetted_list(mpm *s)
{
    TRY(list_wetted_nodes(s));
    if (s->wetted->n > 0) find_lines(s);
    return FLOE_OK;
}

/* The nodes that move the markers of surfaces (inertia.h). A force on a marker goes to its nodes by weights w, and moves the marker by weights
 * w r, with r below one where a node is light (traction.c). Both weights are taken as w sqrt(r): the response of a marker to its own
 * force is then exact, and the matrix of all responses is symmetric. */
#include "mpm/surface/inertia.h"

#include "base/memory.h"
#include "math/tensor.h"
#include "mpm/implicit/implicit_walls.h"
#include "mpm/nodes/constraints.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/node_place.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"
#include "mpm/surface/surface_place.h"
#include "mpm/surface/surfaces.h"

#include <math.h>
#include <string.h>

void inertia_free(mpm *s)
{
    marker_inertia *t = s->surfaces->inertia;
    if (!t) return;
    memory_free(s->ctx, &t->node);
    memory_free(s->ctx, &t->share);
    memory_free(s->ctx, &t->marker);
    memory_free(s->ctx, &t->of_vertex);
    memory_free(s->ctx, &t->slot);
    memory_free(s->ctx, &t->value);
    memory_free(s->ctx, &t->change);
    memory_free(s->ctx, &t->impulse);
    memory_free(s->ctx, &s->surfaces->inertia);
}

/* ---- nodes ---- */

static size_t hash_node(int group, const int node[3])
{
    uint64_t key = (uint64_t)group;
    for (int a = 0; a < 3; ++a) key = (key ^ (uint64_t)(int64_t)node[a]) * UINT64_C(0x9e3779b97f4a7c15);
    return (size_t)(key >> 20);
}

/* Where a node is in the table, or belongs. */
static int *slot_of(const marker_inertia *t, int group, const int node[3])
{
    size_t at = hash_node(group, node) & (t->slots - 1);
    while (t->slot[at] > 0) {
        const inertia_node *n = &t->node[t->slot[at] - 1];
        if (n->group == group && memcmp(n->node, node, sizeof n->node) == 0) break;
        at = (at + 1) & (t->slots - 1);
    }
    return &t->slot[at];
}

static floe_status double_slots(mpm *s, marker_inertia *t)
{
    const size_t slots = t->slots > 0 ? 2 * t->slots : 1024;
    TRY(memory_resize(s->ctx, &t->slot, slots, sizeof *t->slot));
    t->slots = slots;
    memset(t->slot, 0, slots * sizeof *t->slot);
    for (int n = 0; n < t->n_nodes; ++n) *slot_of(t, t->node[n].group, t->node[n].node) = n + 1;
    return FLOE_OK;
}

/* Velocity (m/s) that sides or supports prescribe. */
static double prescribed_velocity(const mpm *s, int group, const int node[3], int c)
{
    double v = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2 && !s->mesh->periodic[a]; ++side)
            if (node[a] == (side == SIDE_LOWER ? 0 : s->mesh->n[a]) && wall_constrains(s, group, a, side, c))
                v = wall_target(s, a, side, c);
    for (size_t k = 0; k < s->supports->n; ++k)
        if (memcmp(s->supports->node[k].node, node, sizeof s->supports->node[k].node) == 0)
            v = support_velocity(s, s->supports->node[k].support)[c];
    return v;
}

static void describe_node(const mpm *s, inertia_node *n)
{
    const node_place own = owner_of_node(s->mesh, n->node);
    const fields *f = s->domain->fields[own.block];
    const ptrdiff_t at = own.at;
    const double mass = field_get(f, N_MASS, n->group, 0)[at], undamped = damping_left(s);
    const unsigned fixed = node_constraints(s, n->group, n->node);
    const bool stiff = walls_are_stiff(s);
    double change[3], give[3];
    if (stiff) stiff_node(s, n->node, change, give);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const bool bears = mass > small_node(s);
        const double momentum = field_get(f, N_MOMENTUM, n->group, c)[at],
                     force = field_get(f, N_FORCE, n->group, c)[at];
        n->before[c] = mass > 0.0 ? momentum / mass : 0.0;
        n->give[c] = bears ? s->kick / mass : 0.0;
        n->to[c] = undamped * n->before[c] + (stiff ? change[c] : n->give[c] * force);
        n->give[c] = stiff ? give[c] : n->give[c];
        if (!is_constrained(fixed, c)) continue;
        n->give[c] = 0.0;
        n->before[c] = n->to[c] = prescribed_velocity(s, n->group, n->node, c);
    }
}

static floe_status find_node(mpm *s, int group, const int node[3], int *number)
{
    marker_inertia *t = s->surfaces->inertia;
    if (2 * ((size_t)t->n_nodes + 1) > t->slots) TRY(double_slots(s, t));
    int *slot = slot_of(t, group, node);
    if (*slot == 0) {
        if ((size_t)t->n_nodes == t->reserved_nodes) {
            t->reserved_nodes = 2 * t->reserved_nodes + 256;
            TRY(memory_resize(s->ctx, &t->node, t->reserved_nodes, sizeof *t->node));
        }
        inertia_node *n = &t->node[t->n_nodes++];
        *n = (inertia_node){.group = group, .node = {node[0], node[1], node[2]}, .master = -1};
        describe_node(s, n);
        *slot = t->n_nodes;
    }
    *number = *slot - 1;
    return FLOE_OK;
}

/* What leads a node; the place of its entry may change with that of its master. */
static floe_status find_master(mpm *s, int number)
{
    const inertia_node n = s->surfaces->inertia->node[number];
    const support_node *led = supports_lead_group(s, n.group) ? support_of(s, n.node) : NULL;
    int master;
    if (!led || !led->led) return FLOE_OK;
    TRY(find_node(s, n.group, led->master, &master));
    inertia_node *found = &s->surfaces->inertia->node[number];
    found->master = master;
    found->share = led->share;
    for (int c = 0; c < s->mesh->dim; ++c) found->own[c] = (1.0 - led->share) * support_velocity(s, led->support)[c];
    return FLOE_OK;
}

static floe_status number_node(mpm *s, int group, const int node[3], int *number)
{
    const int before = s->surfaces->inertia->n_nodes;
    TRY(find_node(s, group, node, number));
    return *number < before ? FLOE_OK : find_master(s, *number);
}

/* ---- shares ---- */

/* What a node of a stencil is in the mesh along one axis: itself, or for a ghost the nodes whose values it has (wall.c). */
typedef struct node_image {
    int n, at[2];
    double weight[2];
    bool mirrored;
} node_image;

static node_image image_of(const mpm *s, int group, int axis, int node)
{
    const int n = s->mesh->n[axis];
    if (s->mesh->periodic[axis])
        return (node_image){.n = 1, .at = {mesh_index_around(s->mesh, axis, node)}, .weight = {1.0}};
    if (node >= 0 && node <= n) return (node_image){.n = 1, .at = {node}, .weight = {1.0}};
    const int side = node < 0 ? SIDE_LOWER : SIDE_UPPER, wall = node < 0 ? 0 : n, inner = node < 0 ? 1 : n - 1;
    if (wall_mirrors(s, group, axis, side))
        return (node_image){.n = 1, .at = {inner}, .weight = {1.0}, .mirrored = true};
    return (node_image){.n = 2, .at = {wall, inner}, .weight = {2.0, -1.0}};
}

static floe_status add_marker_share(mpm *s, inertia_marker *m, int number, const double factor[3])
{
    marker_inertia *t = s->surfaces->inertia;
    if ((size_t)t->n_shares == t->reserved_shares) {
        t->reserved_shares = 2 * t->reserved_shares + 1024;
        TRY(memory_resize(s->ctx, &t->share, t->reserved_shares, sizeof *t->share));
    }
    t->share[t->n_shares++] = (inertia_share){number, {factor[0], factor[1], factor[2]}};
    m->n++;
    return FLOE_OK;
}

/* How a node of the mesh moves a marker: by the share r of its change, by a weight, and turned by mirrors. */
typedef struct inertia_mover {
    double moved, weight;
    bool mirrored[3];
} inertia_mover;

/* The motion of a led node is its master's, and so is a force on it. */
static floe_status add_mover(mpm *s, int group, inertia_marker *m, const int node[3], const inertia_mover *by)
{
    const marker_inertia *t = s->surfaces->inertia;
    int number;
    double factor[3];
    TRY(number_node(s, group, node, &number));
    const inertia_node led = t->node[number];
    const bool leads = led.master >= 0;
    const double share = leads ? led.share : 1.0;
    for (int c = 0; c < 3; ++c) factor[c] = (by->mirrored[c] ? -1.0 : 1.0) * sqrt(by->moved) * by->weight * share;
    TRY(add_marker_share(s, m, leads ? led.master : number, factor));
    const inertia_node *n = &t->node[leads ? led.master : number];
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double v = share * (n->before[c] + by->moved * (n->to[c] - n->before[c])) + led.own[c];
        m->velocity[c] += (by->mirrored[c] ? -by->weight : by->weight) * v;
    }
    return FLOE_OK;
}

/* Adds a node of a marker's stencil; `moved`: the share r of its change that the marker takes. */
static floe_status add_inertia_node(mpm *s, int group, inertia_marker *m, const int node[3], double weight,
                                    double moved)
{
    node_image image[3] = {{.n = 1, .weight = {1.0}}, {.n = 1, .weight = {1.0}}, {.n = 1, .weight = {1.0}}};
    for (int a = 0; a < s->mesh->dim; ++a) image[a] = image_of(s, group, a, node[a]);
    for (int k = 0; k < image[2].n; ++k)
        for (int j = 0; j < image[1].n; ++j)
            for (int i = 0; i < image[0].n; ++i) {
                const int at[3] = {image[0].at[i], image[1].at[j], image[2].at[k]};
                const double w = weight * image[0].weight[i] * image[1].weight[j] * image[2].weight[k];
                const inertia_mover by = {moved, w, {image[0].mirrored, image[1].mirrored, image[2].mirrored}};
                TRY(add_mover(s, group, m, at, &by));
            }
    return FLOE_OK;
}

/* A marker, and in `velocity` how fast it will be. */
static floe_status add_marker(mpm *s, int vertex)
{
    marker_inertia *t = s->surfaces->inertia;
    const surface_markers *k = &s->surfaces->markers;
    const double *x = k->now[vertex].x;
    const int group = k->group[vertex];
    inertia_marker *m = &t->marker[t->n_markers];
    *m = (inertia_marker){.vertex = vertex, .first = t->n_shares, .motion = motion_of_group(s, group)};
    t->of_vertex[vertex] = t->n_markers++;
    if (m->motion) {
        double next[3], path[3];
        motion_of_place(s, m->motion, x, next, m->velocity, path);
        if (s->forces_at_end) motion_sweep(s, m->motion, x, m->velocity); /* theory 7.8 */
        for (int a = 0; a < 3; ++a) m->arm[a] = x[a] - m->motion->now.c[a];
        return FLOE_OK;
    }
    const int support = support_with_surface(s, group, x);
    if (support >= 0) {
        memcpy(m->velocity, support_velocity(s, support), sizeof m->velocity);
        return FLOE_OK;
    }
    const surface_shares st = surface_shares_at(s, group, x);
    for (int i = 0; i < st.n; ++i) TRY(add_inertia_node(s, group, m, st.node[i], st.w[i], st.moved[i]));
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (!(k->pin[vertex] >> a & 1)) continue;
        m->velocity[a] = 0.0;
        for (int i = m->first; i < t->n_shares; ++i) t->share[i].factor[a] = 0.0;
    }
    return FLOE_OK;
}

static floe_status begin(mpm *s)
{
    if (!s->surfaces->inertia) TRY(memory_new(s->ctx, &s->surfaces->inertia, 1, sizeof *s->surfaces->inertia));
    marker_inertia *t = s->surfaces->inertia;
    const size_t vertices = s->surfaces->markers.n;
    t->n_nodes = t->n_shares = t->n_markers = 0;
    if (t->slots > 0) memset(t->slot, 0, t->slots * sizeof *t->slot);
    if (vertices > t->reserved_vertices) {
        TRY(memory_resize(s->ctx, &t->marker, vertices, sizeof *t->marker));
        TRY(memory_resize(s->ctx, &t->of_vertex, vertices, sizeof *t->of_vertex));
        t->reserved_vertices = vertices;
    }
    for (size_t k = 0; k < vertices; ++k) t->of_vertex[k] = -1;
    if (s->motions && !t->change) {
        TRY(memory_new(s->ctx, &t->change, (size_t)s->motions->n, sizeof *t->change));
        TRY(memory_new(s->ctx, &t->impulse, (size_t)s->motions->n, sizeof *t->impulse));
    }
    return FLOE_OK;
}

floe_status inertia_find(mpm *s, const wall_response *w)
{
    TRY(begin(s));
    motions_solve(s);
    for (int c = 0; c < w->n_cells; ++c)
        for (int k = w->cell[c].first; k >= 0; k = w->push[k].next)
            if (s->surfaces->inertia->of_vertex[w->push[k].vertex] < 0) TRY(add_marker(s, w->push[k].vertex));
    return FLOE_OK;
}

/* ---- responses ---- */

static int motion_number(const mpm *s, const body_motion *m)
{
    return (int)(m - s->motions->body);
}

static double along_pushes(const mpm *s, const wall_response *w, int cell)
{
    const marker_inertia *t = s->surfaces->inertia;
    double flux = 0.0;
    for (int k = w->cell[cell].first; k >= 0; k = w->push[k].next) {
        const wall_push *p = &w->push[k];
        const double *v = t->marker[t->of_vertex[p->vertex]].velocity;
        for (int a = 0; a < s->mesh->dim; ++a) flux += p->area[a] * v[a];
    }
    return flux;
}

void inertia_first_flux(const mpm *s, const wall_response *w, double *flux)
{
    const marker_inertia *t = s->surfaces->inertia;
    for (int n = 0; n < t->n_markers; ++n) {
        inertia_marker *m = &t->marker[n];
        for (int a = 0; a < 3; ++a) m->velocity[a] -= s->surfaces->markers.now[m->vertex].v[a];
    }
    for (int c = 0; c < w->n_cells; ++c) flux[c] = along_pushes(s, w, c);
}

void inertia_force_of(const mpm *s, const wall_response *w, const double *pressure)
{
    const marker_inertia *t = s->surfaces->inertia;
    for (int n = 0; n < t->n_markers; ++n) memset(t->marker[n].force, 0, sizeof t->marker[n].force);
    for (int c = 0; c < w->n_cells; ++c)
        for (int k = w->cell[c].first; k >= 0; k = w->push[k].next)
            for (int a = 0; a < s->mesh->dim; ++a)
                t->marker[t->of_vertex[w->push[k].vertex]].force[a] += w->push[k].area[a] * pressure[c];
}

/* To the nodes and bodies. */
static void spread_force(const mpm *s, const inertia_marker *m)
{
    const marker_inertia *t = s->surfaces->inertia;
    if (m->motion) {
        double *impulse = t->impulse[motion_number(s, m->motion)], turn[3];
        vec_cross(m->arm, m->force, turn);
        for (int a = 0; a < 3; ++a) {
            impulse[a] += s->kick * m->force[a];
            impulse[3 + a] += s->kick * turn[a];
        }
        return;
    }
    for (int i = m->first; i < m->first + m->n; ++i)
        for (int a = 0; a < s->mesh->dim; ++a)
            t->node[t->share[i].node].force[a] += t->share[i].factor[a] * m->force[a];
}

/* `stiff`: by the answer of all nodes. */
static void find_velocity(const mpm *s, bool stiff, inertia_marker *m)
{
    const marker_inertia *t = s->surfaces->inertia;
    memset(m->velocity, 0, sizeof m->velocity);
    if (m->motion) {
        const rigid_field *f = &t->change[motion_number(s, m->motion)];
        vec_cross(f->w, m->arm, m->velocity);
        for (int a = 0; a < 3; ++a) m->velocity[a] += f->v[a];
        return;
    }
    for (int i = m->first; i < m->first + m->n; ++i) {
        const inertia_node *n = &t->node[t->share[i].node];
        for (int a = 0; a < s->mesh->dim; ++a)
            m->velocity[a] +=
                stiff ? t->share[i].factor[a] * n->change[a] : t->share[i].factor[a] * n->give[a] * n->force[a];
    }
}

static void find_changes(const mpm *s)
{
    const marker_inertia *t = s->surfaces->inertia;
    for (int k = 0; s->motions && k < s->motions->n; ++k) {
        motion_change(&s->motions->body[k], t->impulse[k], t->impulse[k] + 3, &t->change[k]);
        memset(t->impulse[k], 0, sizeof t->impulse[k]);
    }
}

/* Nodes that hang together by their stiffness. */
static void find_answers(const mpm *s)
{
    const marker_inertia *t = s->surfaces->inertia;
    stiff_begin(s);
    for (int n = 0; n < t->n_nodes; ++n) stiff_push(s, t->node[n].node, t->node[n].force);
    stiff_solve(s);
    for (int n = 0; n < t->n_nodes; ++n) stiff_answer(s, t->node[n].node, t->node[n].change);
}

void inertia_flux_of(const mpm *s, const wall_response *w, const double *pressure, double *flux)
{
    const marker_inertia *t = s->surfaces->inertia;
    inertia_force_of(s, w, pressure);
    for (int n = 0; n < t->n_nodes; ++n) memset(t->node[n].force, 0, sizeof t->node[n].force);
    for (int n = 0; n < t->n_markers; ++n) spread_force(s, &t->marker[n]);
    find_changes(s);
    if (walls_are_stiff(s)) find_answers(s);
    for (int n = 0; n < t->n_markers; ++n) find_velocity(s, walls_are_stiff(s), &t->marker[n]);
    for (int c = 0; c < w->n_cells; ++c) flux[c] = along_pushes(s, w, c);
}

/* Only the markers on which the cell acts are visited: their nodes' forces are 0 before and after. */
double inertia_own_flux(const mpm *s, const wall_response *w, int cell)
{
    const marker_inertia *t = s->surfaces->inertia;
    for (int k = w->cell[cell].first; k >= 0; k = w->push[k].next) {
        inertia_marker *m = &t->marker[t->of_vertex[w->push[k].vertex]];
        memcpy(m->force, w->push[k].area, sizeof m->force);
        spread_force(s, m);
    }
    find_changes(s);
    for (int k = w->cell[cell].first; k >= 0; k = w->push[k].next)
        find_velocity(s, false, &t->marker[t->of_vertex[w->push[k].vertex]]);
    const double flux = along_pushes(s, w, cell);
    for (int k = w->cell[cell].first; k >= 0; k = w->push[k].next) {
        const inertia_marker *m = &t->marker[t->of_vertex[w->push[k].vertex]];
        for (int i = m->first; i < m->first + m->n; ++i)
            memset(t->node[t->share[i].node].force, 0, sizeof t->node[t->share[i].node].force);
    }
    return flux;
}

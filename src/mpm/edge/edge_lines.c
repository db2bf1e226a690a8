/* Lists of the penalised lines, of their nodes and of the copies of these in blocks (edge.h), from the history of the lines. */
#include "mpm/edge/edge_lines.h"
#include "base/memory.h"
#include "mpm/edge/edge.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/constraints.h"
#include "mpm/nodes/node_place.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"

#include <math.h>
#include <string.h>

/* rho c^2 (Pa) of a body at rest, at most that of a body with a Poisson's ratio of 0.35 and the same shear modulus: with a far larger bulk
 * modulus, a penalty of that size would make the edges as stiff as the volume, which their motion does not change. */
static double penalty_modulus_of(const mpm *s, int body)
{
    const mpm_body *b = &s->body[body];
    const double shear = b->law->shear_modulus(b->law_par), bulk = b->law->bulk_modulus(b->law_par);
    return fmin(bulk, 3.0 * shear) + 4.0 / 3.0 * shear;
}

/* |D u| (m) along an axis at which the force of a line, k |D u|, is what a share of its area bears where the body flows. Loads on a surface
 * that has moved off its cells leave forces of some hundredths of them for the lines, whatever the penalty. */
static double longest_of(const mpm *s, int body, int axis)
{
    const mpm_body *b = &s->body[body];
    if (!b->law->yield_stress) return HUGE_VAL;
    const double stiffness = s->edges->penalty * penalty_modulus_of(s, body);
    return s->mesh->h[axis] * MPM_EDGE_STRENGTH * b->law->yield_stress(b->law_par) / stiffness;
}

int edge_taps(const mpm *s)
{
    return s->basis->fact.edge_taps;
}

/* Weights of the taps of a difference, by their number. */
static const double binomial[EDGE_TAPS + 1][EDGE_TAPS] = {
    [3] = {1, -2, 1}, [4] = {-1, 3, -3, 1}, [5] = {1, -4, 6, -4, 1}};

bool edge_find_taps(const mpm *s, int group, const int first[MESH_MAX_DIM], int tap[EDGE_TAPS][MESH_MAX_DIM],
                    edge_line *l)
{
    const mesh *m = s->mesh;
    const int taps = edge_taps(s), axis = l->axis;
    for (int t = 0; t < taps; ++t) {
        memcpy(tap[t], first, sizeof tap[t]);
        int *x = &tap[t][axis];
        *x += t;
        l->weight[0][t] = l->weight[1][t] = binomial[taps][t];
        if (m->periodic[axis]) {
            *x %= m->n[axis];
        } else if (*x < 0 || *x > m->n[axis]) {
            const int side = *x < 0 ? SIDE_LOWER : SIDE_UPPER;
            if (!wall_mirrors(s, group, axis, side)) return false;
            *x = side == SIDE_LOWER ? -*x : 2 * m->n[axis] - *x;
            l->weight[1][t] = -binomial[taps][t];
            l->images = true;
        }
    }
    return true;
}

floe_status edge_visit_starts(mpm *s, int group, edge_visit *visit, void *user)
{
    const edge_box *box = &s->edges->group[group].box;
    for (int axis = 0; axis < s->mesh->dim; ++axis) {
        const int last = s->mesh->n[axis] + 3 - edge_taps(s);
        int lo[MESH_MAX_DIM], end[MESH_MAX_DIM];
        memcpy(lo, box->lo, sizeof lo);
        memcpy(end, box->end, sizeof end);
        if (!s->mesh->periodic[axis]) {
            if (lo[axis] <= 1) lo[axis] = -1;
            if (end[axis] > last) end[axis] = last;
        }
        for (int k = lo[2]; k < end[2]; ++k)
            for (int j = lo[1]; j < end[1]; ++j)
                for (int i = lo[0]; i < end[0]; ++i) TRY(visit(s, group, axis, (const int[]){i, j, k}, user));
    }
    return FLOE_OK;
}

/* Space for so many items in a list. */
static floe_status reserve_items(context *ctx, void *list, size_t *reserved, size_t items, size_t size)
{
    if (items <= *reserved) return FLOE_OK;
    const size_t wanted = items < 128 ? 256 : 2 * items;
    TRY(memory_resize(ctx, list, wanted, size));
    *reserved = wanted;
    return FLOE_OK;
}

/* Of a node in the only block, which has no images. */
static floe_status list_only_copy(mpm *s, edge_group *g, edge_node *n)
{
    TRY(reserve_items(s->ctx, &g->copy, &g->copies_reserved, g->n_copies + 1, sizeof *g->copy));
    n->copy = g->n_copies++;
    n->copies = 1;
    g->copy[n->copy] = (edge_copy){0, mesh_index(&s->mesh->block[0], n->at[0], n->at[1], n->at[2])};
    return FLOE_OK;
}

/* Lists the copies of a node: that of the block which owns it first, then in each block that sees it, and at periodic
 * images. */
static floe_status list_copies(mpm *s, edge_group *g, edge_node *n)
{
    const mesh *m = s->mesh;
    if (m->n_blocks == 1 && !m->periodic[0] && !m->periodic[1] && !m->periodic[2]) return list_only_copy(s, g, n);
    int images[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) images[a] = m->periodic[a] ? 1 : 0;
    const int own = owner_of_node(m, n->at).block;
    n->copy = g->n_copies;
    for (int round = 0; round < 2; ++round)
        for (int z = -images[2]; z <= images[2]; ++z)
            for (int y = -images[1]; y <= images[1]; ++y)
                for (int x = -images[0]; x <= images[0]; ++x)
                    for (int b = 0; b < m->n_blocks; ++b) {
                        const bool first = b == own && x == 0 && y == 0 && z == 0;
                        ptrdiff_t at;
                        if (first != (round == 0) ||
                            !find_node_in_block(m, &m->block[b], n->at, (const int[]){x, y, z}, &at))
                            continue;
                        TRY(reserve_items(s->ctx, &g->copy, &g->copies_reserved, g->n_copies + 1, sizeof *g->copy));
                        g->copy[g->n_copies++] = (edge_copy){b, at};
                    }
    n->copies = g->n_copies - n->copy;
    return FLOE_OK;
}

/* Place in the group's list of a node. */
static floe_status list_edge_node(mpm *s, int group, int body, const int at[MESH_MAX_DIM], int *place)
{
    mpm_edges *e = s->edges;
    edge_group *g = &e->group[group];
    int *index = &e->index[edge_number(e, at)];
    if (*index < 0) {
        TRY(reserve_items(s->ctx, &g->node, &g->nodes_reserved, (size_t)g->n_nodes + 1, sizeof *g->node));
        *index = g->n_nodes;
        edge_node *n = &g->node[g->n_nodes++];
        memcpy(n->at, at, sizeof n->at);
        n->body = body;
        n->constrained = node_constraints(s, group, at);
        n->slot = e->accelerations + ((size_t)group * edge_all_nodes(e) + edge_number(e, at)) * (size_t)s->mesh->dim;
        TRY(list_copies(s, g, n));
    }
    *place = *index;
    return FLOE_OK;
}

/* V/h^2 of the cells about a line, half of it on a side; a mean radius more about an axis. */
static double line_extent(const mpm *s, int axis, int tap[EDGE_TAPS][MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    double extent = 1.0 / m->h[axis], radius = 0.0;
    for (int a = 0; a < m->dim; ++a) {
        if (a == axis) continue;
        const bool side = !m->periodic[a] && (tap[0][a] == 0 || tap[0][a] == m->n[a]);
        extent *= side ? 0.5 * m->h[a] : m->h[a];
    }
    if (m->geometry != MESH_AXISYMMETRIC) return extent;
    for (int t = 0; t < edge_taps(s); ++t) radius += mesh_node(m, 0, tap[t][0]) / edge_taps(s);
    return extent * fmax(radius, 0.25 * m->h[0]);
}

/* Whether what a line gives to the nodes, or to those that are free, is not nothing as a whole: beside walls and
 * mirrors. */
static bool is_unbalanced(const edge_group *g, const edge_line *l)
{
    bool constrained = false;
    for (int t = 0; t < EDGE_TAPS; ++t) constrained = constrained || g->node[l->node[t]].constrained != 0;
    return constrained || l->images;
}

/* The nearest tap that a support leads, from one on; it leads those behind it alike. NULL: none. */
static const support_node *nearest_led(const support_node *const at[EDGE_TAPS], int taps, int from, int *steps)
{
    for (*steps = 0; *steps < taps; ++*steps)
        for (int way = -1; way < 2; way += 2) {
            const int t = from + way * *steps;
            if (t >= 0 && t < taps && at[t] && at[t]->led) return at[t];
        }
    return NULL;
}

/* Taps that a support leads along the line are their masters, with a share of the weight, and so are constrained ones behind them: the motion of the solid goes on to
 * there. False where it leads them along another axis, in which they are linear as their masters are, or moves. */
static bool fold_led_taps(const mpm *s, int group, int tap[EDGE_TAPS][MESH_MAX_DIM], edge_line *l)
{
    const support_node *at[EDGE_TAPS] = {NULL};
    const bool leads = supports_lead_group(s, group);
    for (int t = 0; leads && t < edge_taps(s); ++t) at[t] = support_of(s, tap[t]);
    for (int t = 0; t < edge_taps(s); ++t) {
        int steps;
        const support_node *led = at[t] ? nearest_led(at, edge_taps(s), t, &steps) : NULL;
        if (at[t] && s->supports->region[at[t]->support].body >= 0)
            l->leader = s->supports->region[at[t]->support].body;
        if (!led) continue;
        if (led->way[l->axis] == 0 || support_moves(s, led->support)) return false;
        memcpy(tap[t], led->master, sizeof tap[t]);
        for (int k = 0; k < 2; ++k) l->weight[k][t] *= led->share - steps * led->per_step;
        l->images = true;
    }
    return true;
}

static floe_status list_line(mpm *s, int group, int axis, const int first[MESH_MAX_DIM], void *user)
{
    (void)user;
    mpm_edges *e = s->edges;
    edge_group *g = &e->group[group];
    const size_t place = edge_place(s, group, axis, first);
    const int body = (int)e->memory[e->lines + place] - 1;
    int tap[EDGE_TAPS][MESH_MAX_DIM];
    edge_line l = {.axis = axis, .leader = -1, .slot = place * (size_t)s->mesh->dim};
    if (body < 0 || !edge_find_taps(s, group, first, tap, &l)) return FLOE_OK;
    l.stiffness = e->penalty * penalty_modulus_of(s, body) * line_extent(s, axis, tap);
    if (!fold_led_taps(s, group, tap, &l)) return FLOE_OK;
    l.most = longest_of(s, body, axis);
    l.inertia = l.stiffness * s->mesh->h[axis] * s->mesh->h[axis] / (g->speed * g->speed);
    for (int t = 0; t < edge_taps(s); ++t) TRY(list_edge_node(s, group, body, tap[t], &l.node[t]));
    for (int t = edge_taps(s); t < EDGE_TAPS; ++t) l.node[t] = l.node[0];
    l.unbalanced = is_unbalanced(g, &l);
    TRY(reserve_items(s->ctx, &g->line, &g->lines_reserved, g->n_lines + 1, sizeof *g->line));
    g->line[g->n_lines++] = l;
    return FLOE_OK;
}

/* The entry of a row's column, which is added where it is not yet. */
static size_t entry_of(edge_matrix *m, int row, int column)
{
    const size_t begin = (size_t)row * (size_t)m->width;
    int k = 0;
    while (k < m->count[row] && m->column[begin + (size_t)k] != column) ++k;
    if (k == m->count[row]) m->column[begin + (size_t)m->count[row]++] = column;
    return begin + (size_t)k;
}

static void add_line(edge_matrix *m, const edge_line *l, int dim, int taps)
{
    for (int i = 0; i < taps; ++i)
        for (int j = 0; j < taps; ++j) {
            const size_t at = entry_of(m, l->node[i], l->node[j]);
            for (int c = 0; c < dim; ++c) {
                const double weight = edge_weights(l, c)[i] * edge_weights(l, c)[j];
                m->inertia[(size_t)c * m->reserved + at] += weight * l->inertia;
            }
        }
}

/* Space for the nodes' rows, all empty but for their diagonals. */
static floe_status clear_matrix(mpm *s, edge_group *g)
{
    edge_matrix *m = &g->matrix;
    const size_t rows = (size_t)g->n_nodes, dim = (size_t)s->mesh->dim;
    m->width = 1 + 2 * (edge_taps(s) - 1) * s->mesh->dim;
    if (rows * (size_t)m->width > m->reserved || !m->inertia) { /* of no rows there is an array, too */
        const size_t some = rows + rows / 4, reserved = some * (size_t)m->width;
        TRY(memory_resize(s->ctx, &m->count, some, sizeof *m->count));
        TRY(memory_resize(s->ctx, &m->column, reserved, sizeof *m->column));
        TRY(memory_resize(s->ctx, &m->inertia, reserved * dim, sizeof *m->inertia));
        TRY(memory_resize(s->ctx, &g->accelerated, some * dim, sizeof *g->accelerated));
        m->reserved = reserved;
    }
    memset(m->inertia, 0, m->reserved * dim * sizeof *m->inertia);
    for (int n = 0; n < g->n_nodes; ++n) {
        m->count[n] = 0;
        (void)entry_of(m, n, n);
    }
    return FLOE_OK;
}

/* Clears the history of nodes without a line. */
static void rollback_nodes(mpm *s, int group)
{
    mpm_edges *e = s->edges;
    const edge_box *box = &e->group[group].box;
    const size_t all = edge_all_nodes(e), dim = (size_t)s->mesh->dim;
    for (int k = box->lo[2]; k < box->end[2]; ++k)
        for (int j = box->lo[1]; j < box->end[1]; ++j)
            for (int i = box->lo[0]; i < box->end[0]; ++i) {
                const size_t node = edge_number(e, (const int[]){i, j, k});
                double *accelerations = e->memory + e->accelerations + ((size_t)group * all + node) * dim;
                if (e->index[node] < 0) memset(accelerations, 0, dim * sizeof *accelerations);
            }
}

static floe_status list_group(mpm *s, int group)
{
    mpm_edges *e = s->edges;
    edge_group *g = &e->group[group];
    g->listed = false;
    g->n_lines = g->n_copies = 0;
    g->n_nodes = 0;
    TRY(edge_visit_starts(s, group, list_line, NULL));
    rollback_nodes(s, group);
    for (int n = 0; n < g->n_nodes; ++n) e->index[edge_number(e, g->node[n].at)] = -1;
    g->listed = g->n_nodes == 0; /* no line yet: no rows, and no space for them either */
    if (g->listed) return FLOE_OK;
    TRY(clear_matrix(s, g));
    for (size_t k = 0; k < g->n_lines; ++k) add_line(&g->matrix, &g->line[k], s->mesh->dim, edge_taps(s));
    TRY(reserve_items(s->ctx, &g->next, &g->next_reserved, g->n_lines * (size_t)s->mesh->dim, sizeof *g->next));
    memset(g->accelerated, 0, (size_t)g->n_nodes * (size_t)s->mesh->dim * sizeof *g->accelerated);
    g->listed = true;
    return FLOE_OK;
}

/* A number below 2^24 that has nothing to do with its neighbours': nodes that a symmetric body loses and gets in pairs
 * must not cancel in a sum. */
static double scrambled_number(unsigned x)
{
    x = ((x + 1u) ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return (double)((x ^ (x >> 16)) >> 8);
}

/* One number for which nodes of a group take forces: whole, and small enough to be exact as a sum. `salt`: other groups have other numbers. */
static double loaded_nodes_number(const mpm *s, int group, size_t salt)
{
    const mesh *m = s->mesh;
    double sum = 0.0;
    for (int b = 0; b < m->n_blocks; ++b) {
        const block *bl = &m->block[b];
        const double *mass = field_get(s->domain->fields[b], N_MASS, group, 0);
        int end[MESH_MAX_DIM];
        edge_own_nodes(m, bl, end);
        for (int k = 0; k < end[2]; ++k)
            for (int j = 0; j < end[1]; ++j)
                for (int i = 0; i < end[0]; ++i) {
                    const int global[MESH_MAX_DIM] = {bl->lo[0] + i, bl->lo[1] + j, bl->lo[2] + k};
                    if (edge_bears(s, mass, mesh_index(bl, i, j, k)))
                        sum += scrambled_number((unsigned)(salt + edge_number(s->edges, global)));
                }
    }
    return sum;
}

/* The same of all nodes that decide where a group's lines may be. */
static double deciding_nodes_number(const mpm *s, int group)
{
    double sum = loaded_nodes_number(s, group, 0);
    for (int g = 0; edges_spare_met_nodes(s) && g < s->n_groups; ++g)
        if (g != group) sum += loaded_nodes_number(s, g, (size_t)(1 + g) * edge_all_nodes(s->edges));
    return sum;
}

floe_status edges_find(mpm *s, int group, bool anew)
{
    mpm_edges *e = s->edges;
    edge_group *g = &e->group[group];
    double *travelled = &e->memory[e->travel + (size_t)group];
    const double *loaded_nodes = &e->memory[e->loaded_nodes + (size_t)group];
    bool changed = false;
    if (!(g->speed > 0.0)) return FLOE_OK;
    if (!g->listed) { /* what is remembered may lie anywhere */
        g->box = (edge_box){.end = {e->nodes[0], e->nodes[1], e->nodes[2]}};
        TRY(list_group(s, group));
    }
    g->loaded_nodes = deciding_nodes_number(s, group);
    g->looked =
        anew || *travelled > MPM_EDGE_TRAVEL || g->loaded_nodes < *loaded_nodes || g->loaded_nodes > *loaded_nodes;
    if (!g->looked) return FLOE_OK;
    TRY(edges_look(s, group, &changed));
    if (changed) TRY(list_group(s, group));
    g->box = g->filled;
    return FLOE_OK;
}

/* Whether no line may have nodes that bodies in contact share. Contact there knows the masses of nodes alone, not the inertia of lines, and what it changes makes
 * their springs swing up whatever the step: in space, where lines of three axes meet at the light nodes of a corner, and in the plane where one
 * body is far stiffer than another that it lies on (theory 4.10). Static balance has both in one system. */
static bool spares_met_nodes(const mpm *s)
{
    double least = HUGE_VAL, most = 0.0;
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!edge_body(s, b)) continue;
        least = fmin(least, penalty_modulus_of(s, b));
        most = fmax(most, penalty_modulus_of(s, b));
    }
    const bool apt = s->mesh->dim == 3 || (s->mesh->dim == 2 && most > MPM_EDGE_CONTRAST * least);
    return s->scene->contact.enabled && apt;
}

floe_status edges_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->edges, 1, sizeof *s->edges));
    mpm_edges *e = s->edges;
    e->penalty = mpm_edge_penalty(s);
    e->spares = spares_met_nodes(s);
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        e->nodes[a] = s->mesh->n[a] + (a < s->mesh->dim && !s->mesh->periodic[a] ? 1 : 0);
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!edge_body(s, b)) continue;
        edge_group *g = &e->group[s->body[b].group];
        g->speed =
            fmax(g->speed, sqrt(penalty_modulus_of(s, b) / s->scene->material[s->body[b].scene_material].density));
        for (int a = 0; a < s->mesh->dim; ++a) g->damping = fmax(g->damping, g->speed / s->mesh->h[a]);
    }
    const size_t nodes = edge_all_nodes(e), dim = (size_t)s->mesh->dim, groups = (size_t)s->n_groups;
    e->accelerations = groups * nodes * dim * dim;
    e->lines = e->accelerations + groups * nodes * dim;
    e->travel = e->lines + groups * nodes * dim;
    e->loaded_nodes = e->travel + groups;
    e->n_memory = e->loaded_nodes + groups;
    TRY(memory_new(s->ctx, &e->memory, e->n_memory, sizeof *e->memory));
    for (size_t g = 0; g < groups; ++g) e->memory[e->travel + g] = 1.0; /* look at first */
    TRY(memory_new(s->ctx, &e->motion, (size_t)s->n_bodies, sizeof *e->motion));
    const solve_grid empty = solve_grid_of_list(0);
    TRY(cg_create(&e->solver, s->ctx, &empty, 1, MPM_EDGE_ITERATIONS));
    TRY(memory_new(s->ctx, &e->fill, nodes, sizeof *e->fill));
    TRY(memory_new(s->ctx, &e->owner, nodes, sizeof *e->owner));
    TRY(memory_new(s->ctx, &e->index, nodes, sizeof *e->index));
    for (size_t k = 0; k < nodes; ++k) e->index[k] = -1;
    return FLOE_OK;
}

void edges_free(mpm *s)
{
    context *ctx = s->ctx;
    mpm_edges *e = s->edges;
    for (int k = 0; e && k < MPM_MAX_GROUPS; ++k) {
        edge_group *g = &e->group[k];
        memory_free(ctx, &g->line);
        memory_free(ctx, &g->node);
        memory_free(ctx, &g->copy);
        memory_free(ctx, &g->next);
        memory_free(ctx, &g->accelerated);
        memory_free(ctx, &g->matrix.count);
        memory_free(ctx, &g->matrix.column);
        memory_free(ctx, &g->matrix.inertia);
    }
    if (e) {
        memory_free(ctx, &e->memory);
        memory_free(ctx, &e->fill);
        memory_free(ctx, &e->owner);
        memory_free(ctx, &e->index);
        cg_destroy(&e->solver);
        memory_free(ctx, &e->solve);
        memory_free(ctx, &e->motion);
    }
    memory_free(ctx, &s->edges);
}

/* Which nodes solids fill in part, and the lines through them. */
#include "base/memory.h"
#include "mpm/edge.h"
#include "mpm/spread.h"

#include <math.h>
#include <string.h>

/* A node of which solids fill less is filled in part; points that do not stand on a lattice leave some of a node inside empty. */
static const double full_node = 0.95;
/* One with less is outside. */
static const double empty_node = 1e-9;

enum { NO_BODY = -1, SHARED = -2 };

static bool has_edges_of(const mpm *s, int body)
{
    return !s->body[body].fluid && !s->body[body].membrane.model;
}

static double modulus_of(const mpm *s, int body)
{
    const mpm_body *b = &s->body[body];
    return b->law->bulk_modulus(b->law_par) + 4.0 / 3.0 * b->law->shear_modulus(b->law_par);
}

int edge_taps(const mpm *s)
{
    return s->basis->kind == BASIS_CUBIC ? 5 : s->basis->kind == BASIS_QUADRATIC ? 4 : 3;
}

/* What the shape function of the first ghost has inside the mesh, in cells: the wall's own fold gives twice as much to the node on the wall and
 * takes it of the next. */
static double ghost_share(basis_kind kind)
{
    return kind == BASIS_CUBIC ? 1.0 / 24.0 : kind == BASIS_QUADRATIC ? 1.0 / 48.0 : 0.0;
}

/* Volume of a node's shape function along an axis in cells. */
static double share_along(const mpm *s, int axis, int node)
{
    if (s->mesh->periodic[axis]) return 1.0;
    const int side = 2 * node > s->mesh->n[axis] ? SIDE_UPPER : SIDE_LOWER;
    const int in = side == SIDE_UPPER ? s->mesh->n[axis] - node : node;
    if (in > 1) return 1.0;
    if (wall_mirrors(s, axis, side)) return in == 0 ? 0.5 : 1.0;
    const double ghost = ghost_share(s->basis->kind);
    return in == 0 ? 0.5 + 2.0 * ghost : 1.0 - 2.0 * ghost;
}

/* Mean of r over the shape function of a node on the axis, in cells, times its share along r (0.5). */
static double axis_moment(basis_kind kind)
{
    return kind == BASIS_CUBIC ? 7.0 / 30.0 : kind == BASIS_QUADRATIC ? 13.0 / 64.0 : 1.0 / 6.0;
}

static double node_volume(const mpm *s, const int at[MESH_MAX_DIM])
{
    double volume = 1.0;
    const double r = mesh_node(s->mesh, 0, at[0]), h = s->mesh->h[0];
    for (int a = 0; a < s->mesh->dim; ++a) volume *= s->mesh->h[a] * share_along(s, a, at[a]);
    if (s->mesh->geometry != MESH_AXISYMMETRIC) return volume;
    return r > 0.5 * h ? volume * r : volume / 0.5 * axis_moment(s->basis->kind) * h;
}

static size_t node_number(const mpm_edges *e, const int at[MESH_MAX_DIM])
{
    return (size_t)at[0] + (size_t)e->nodes[0] * ((size_t)at[1] + (size_t)e->nodes[1] * (size_t)at[2]);
}

static size_t node_total(const mpm_edges *e)
{
    return (size_t)e->nodes[0] * (size_t)e->nodes[1] * (size_t)e->nodes[2];
}

/* Volume of the points of a tile at its nodes. */
static void fill_tile(const mpm *s, int body, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const size_t *range = s->points[blk][body].tile_start + tile;
    double *out = domain_tile(s->domain, box.number);
    s->work->active[box.number] = range[0] < range[1];
    if (range[0] == range[1]) return;
    memset(out, 0, (size_t)s->work->window_nodes * sizeof *out);
    const point_arrays p = points_of(s, blk, body, false, false);
    for (size_t k = range[0]; k < range[1]; ++k) {
        const tile_weights at = weights_at(s, &box, &p, k);
        const double volume = p.volume0[k] * p.J[k];
        spread_numbers(s, &at, &volume, 1, out);
    }
}

/* Adds what a body fills of a node, and makes the node its own, or nobody's if another body is there. */
static void keep_fill(mpm *s, int body, int blk, const int local[MESH_MAX_DIM])
{
    mpm_edges *e = s->work->edges;
    const block *b = &s->mesh->block[blk];
    const double *volume = field_get(s->domain->fields[blk], N_FILL, s->body[body].group, 0);
    const int global[MESH_MAX_DIM] = {b->lo[0] + local[0], b->lo[1] + local[1], b->lo[2] + local[2]};
    const size_t number = node_number(e, global);
    const double fill = volume[mesh_index(b, local[0], local[1], local[2])] / node_volume(s, global);
    if (!(fill > empty_node)) return;
    e->fill[number] += fill;
    e->owner[number] = e->owner[number] == NO_BODY ? body : SHARED;
}

static void fill_nodes(mpm *s, int body)
{
    const mesh *m = s->mesh;
    for (int b = 0; b < m->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < m->block[b].n_tiles; ++t) fill_tile(s, body, b, t);
    }
    gather_numbers(s, s->body[body].group, (const field_id[]){N_FILL}, 1);
    for (int b = 0; b < m->n_blocks; ++b) {
        const block *bl = &m->block[b];
        int end[MESH_MAX_DIM] = {1, 1, 1};
        for (int a = 0; a < m->dim; ++a) end[a] = bl->n[a] + (bl->at_side[a][SIDE_UPPER] && !m->periodic[a] ? 1 : 0);
        for (int k = 0; k < end[2]; ++k)
            for (int j = 0; j < end[1]; ++j)
                for (int i = 0; i < end[0]; ++i) keep_fill(s, body, b, (const int[]){i, j, k});
    }
}

/* What the solids of a group fill of every node, and whose it is. */
static void fill_group(mpm *s, int group)
{
    mpm_edges *e = s->work->edges;
    for (size_t k = 0; k < node_total(e); ++k) {
        e->fill[k] = 0.0;
        e->owner[k] = NO_BODY;
    }
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].group == group && has_edges_of(s, body)) fill_nodes(s, body);
}

/* Components of a node's velocity that walls or supports hold. */
static unsigned held_components(const mpm *s, const int at[MESH_MAX_DIM])
{
    unsigned held = 0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (s->mesh->periodic[a] || (at[a] != 0 && at[a] != s->mesh->n[a])) continue;
        for (int c = 0; c < s->mesh->dim; ++c)
            if (wall_holds(s, a, at[a] == 0 ? SIDE_LOWER : SIDE_UPPER, c)) held |= 1u << c;
    }
    for (size_t k = 0; k < s->work->n_supports; ++k)
        if (memcmp(s->work->support[k].node, at, sizeof s->work->support[k].node) == 0)
            held |= (1u << s->mesh->dim) - 1u;
    return held;
}

/* Place in the group's list of a node. */
static floe_status list_node(mpm *s, edge_group *g, const int at[MESH_MAX_DIM], int *place)
{
    int *index = &s->work->edges->index[node_number(s->work->edges, at)];
    if (*index < 0) {
        if (g->n_nodes == g->node_room) {
            const int room = g->node_room ? 2 * g->node_room : 256;
            TRY(memory_resize(s->ctx, &g->node, (size_t)room, sizeof *g->node));
            g->node_room = room;
        }
        *index = g->n_nodes;
        edge_node *n = &g->node[g->n_nodes++];
        memcpy(n->at, at, sizeof n->at);
        n->held = held_components(s, at);
    }
    *place = *index;
    return FLOE_OK;
}

/* Weights of the taps of a difference, by their number. */
static const double binomial[EDGE_TAPS + 1][EDGE_TAPS] = {
    [3] = {1, -2, 1}, [4] = {-1, 3, -3, 1}, [5] = {1, -4, 6, -4, 1}};

/* Nodes and weights of the taps from one on; false where one is beyond the mesh. */
static bool find_taps(const mpm *s, const int first[MESH_MAX_DIM], int tap[EDGE_TAPS][MESH_MAX_DIM], edge_line *l)
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
            if (!wall_mirrors(s, axis, side)) return false;
            *x = side == SIDE_LOWER ? -*x : 2 * m->n[axis] - *x;
            l->weight[1][t] = -binomial[taps][t];
            l->images = true;
        }
    }
    return true;
}

/* Modulus (Pa) of a line: that of its body; 0 where it is none, for all taps are full, or one is outside or within reach of another body: bodies
 * that share nodes are not to be glued. */
static double line_modulus(const mpm *s, int tap[EDGE_TAPS][MESH_MAX_DIM])
{
    const mpm_edges *e = s->work->edges;
    const int owner = e->owner[node_number(e, tap[0])];
    bool part = false;
    for (int t = 0; t < edge_taps(s); ++t) {
        const size_t n = node_number(e, tap[t]);
        if (owner < 0 || e->owner[n] != owner) return 0.0;
        part = part || e->fill[n] < full_node;
    }
    return part ? modulus_of(s, owner) : 0.0;
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

static floe_status add_line(mpm *s, int group, int axis, const int first[MESH_MAX_DIM])
{
    mpm_edges *e = s->work->edges;
    edge_group *g = &e->group[group];
    int tap[EDGE_TAPS][MESH_MAX_DIM], start[MESH_MAX_DIM];
    edge_line l = {.axis = axis};
    if (!find_taps(s, first, tap, &l)) return FLOE_OK;
    const double modulus = line_modulus(s, tap);
    if (modulus == 0.0) return FLOE_OK;
    memcpy(start, first, sizeof start);
    start[axis] +=
        start[axis] < 0 ? e->nodes[axis] : 0; /* a slot that no other line has: it would begin beyond the upper side */
    const size_t number = (size_t)group * node_total(e) + node_number(e, start);
    l.slot = (number * (size_t)s->mesh->dim + (size_t)axis) * (size_t)s->mesh->dim;
    l.stiffness = s->scene->method.edge_penalty * modulus * line_extent(s, axis, tap);
    l.inertia = l.stiffness * s->mesh->h[axis] * s->mesh->h[axis] / (g->speed * g->speed);
    l.damping = l.stiffness * s->mesh->h[axis] / g->speed;
    for (int t = 0; t < edge_taps(s); ++t) TRY(list_node(s, g, tap[t], &l.node[t]));
    if (g->n_lines == g->line_room) {
        const size_t room = g->line_room ? 2 * g->line_room : 256;
        TRY(memory_resize(s->ctx, &g->line, room, sizeof *g->line));
        g->line_room = room;
    }
    g->line[g->n_lines++] = l;
    return FLOE_OK;
}

/* Lines along an axis from every node, and from the image of the first inner one. */
static floe_status find_along(mpm *s, int group, int axis)
{
    const mpm_edges *e = s->work->edges;
    int lo[MESH_MAX_DIM] = {0, 0, 0};
    if (!s->mesh->periodic[axis]) lo[axis] = -1;
    for (int k = lo[2]; k < e->nodes[2]; ++k)
        for (int j = lo[1]; j < e->nodes[1]; ++j)
            for (int i = lo[0]; i < e->nodes[0]; ++i) {
                const int at[MESH_MAX_DIM] = {i, j, k};
                if (at[axis] >= 0 && !(e->fill[node_number(e, at)] > empty_node)) continue;
                if (at[axis] + edge_taps(s) > s->mesh->n[axis] + 2 && !s->mesh->periodic[axis]) continue;
                TRY(add_line(s, group, axis, at));
            }
    return FLOE_OK;
}

floe_status edges_find(mpm *s, int group)
{
    mpm_edges *e = s->work->edges;
    edge_group *g = &e->group[group];
    g->n_lines = 0;
    for (int n = 0; n < g->n_nodes; ++n) e->index[node_number(e, g->node[n].at)] = -1;
    g->n_nodes = 0;
    if (!(g->speed > 0.0)) return FLOE_OK;
    fill_group(s, group);
    for (int axis = 0; axis < s->mesh->dim; ++axis) TRY(find_along(s, group, axis));
    for (int n = 0; n < g->n_nodes; ++n) e->index[node_number(e, g->node[n].at)] = -1;
    return FLOE_OK;
}

floe_status edges_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->work->edges, 1, sizeof *s->work->edges));
    mpm_edges *e = s->work->edges;
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        e->nodes[a] = s->mesh->n[a] + (a < s->mesh->dim && !s->mesh->periodic[a] ? 1 : 0);
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!has_edges_of(s, b)) continue;
        edge_group *g = &e->group[s->body[b].group];
        g->speed = fmax(g->speed, sqrt(modulus_of(s, b) / s->scene->material[s->body[b].scene_material].density));
    }
    const size_t nodes = node_total(e), dim = (size_t)s->mesh->dim;
    e->slots = (size_t)s->n_groups * nodes * dim * dim;
    TRY(memory_new(s->ctx, &e->difference, e->slots, sizeof *e->difference));
    TRY(memory_new(s->ctx, &e->next, e->slots, sizeof *e->next));
    TRY(memory_new(s->ctx, &e->fill, nodes, sizeof *e->fill));
    TRY(memory_new(s->ctx, &e->owner, nodes, sizeof *e->owner));
    TRY(memory_new(s->ctx, &e->index, nodes, sizeof *e->index));
    for (size_t k = 0; k < nodes; ++k) e->index[k] = -1;
    return FLOE_OK;
}

void edges_free(context *ctx, mpm_edges **e)
{
    for (int g = 0; *e && g < MPM_MAX_GROUPS; ++g) {
        memory_free(ctx, &(*e)->group[g].line);
        memory_free(ctx, &(*e)->group[g].node);
    }
    if (*e) {
        memory_free(ctx, &(*e)->difference);
        memory_free(ctx, &(*e)->next);
        memory_free(ctx, &(*e)->fill);
        memory_free(ctx, &(*e)->owner);
        memory_free(ctx, &(*e)->index);
        memory_free(ctx, &(*e)->solve);
    }
    memory_free(ctx, e);
}

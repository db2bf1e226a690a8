/* Finds nodes whose support is partly filled, and the lines that are penalised there. */
#include "grid/tile_box.h"
#include "mpm/edge/edge.h"
#include "mpm/edge/edge_lines.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/node.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/spread.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

enum { NO_BODY = -1, SHARED = -2 };

/* Volume of the points of a tile at its nodes. */
static void fill_tile_volumes(const mpm *s, int body, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const size_t *range = s->points[blk][body].tile_start + tile;
    double *out = domain_tile(s->domain, box.number);
    s->windows->active[box.number] = range[0] < range[1];
    if (range[0] == range[1]) return;
    memset(out, 0, (size_t)s->windows->window_nodes * sizeof *out);
    const point_arrays p = points_of(s, blk, body, false, false);
    s->windows->kernel->fill(s->mesh, &box, &p, range[0], range[1], out);
}

static void take_into(edge_box *box, const int at[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        if (at[a] < box->lo[a]) box->lo[a] = at[a];
        if (at[a] >= box->end[a]) box->end[a] = at[a] + 1;
    }
}

/* Adds the share of a node that a body fills. The solid becomes the owner of the node, which has none if another body is
 * there. Membranes have no edges, but lines on nodes that they share with a solid would take the energy of a membrane
 * that slides along it. Fluid points may share them: they move with the surface of the solid there. */
static void add_filled_share(mpm *s, int body, int blk, const int local[MESH_MAX_DIM])
{
    mpm_edges *e = s->edges;
    const block *b = &s->mesh->block[blk];
    const double *volume = field_get(s->domain->fields[blk], N_FILL, s->body[body].group, 0);
    const int global[MESH_MAX_DIM] = {b->lo[0] + local[0], b->lo[1] + local[1], b->lo[2] + local[2]};
    const size_t number = edge_number(e, global);
    const int own_group = s->body[body].group;
    const double fill = volume[mesh_index(b, local[0], local[1], local[2])] / node_volume(s, own_group, global);
    const bool bears = e->starting || edge_bears(s, field_get(s->domain->fields[blk], N_MASS, own_group, 0),
                                                 mesh_index(b, local[0], local[1], local[2]));
    if (!(fill > 0.0) || !bears) return;
    if (!edge_body(s, body)) {
        if (e->owner[number] >= 0) e->owner[number] = SHARED;
        return;
    }
    e->fill[number] += fill;
    take_into(&e->group[own_group].filled, global);
    e->owner[number] = e->owner[number] == NO_BODY ? body : SHARED;
}

static void fill_nodes(mpm *s, int body)
{
    const mesh *m = s->mesh;
    for (int b = 0; b < m->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < m->block[b].n_tiles; ++t) fill_tile_volumes(s, body, b, t);
    }
    gather_numbers(s, s->body[body].group, (const field_id[]){N_FILL}, 1);
    for (int b = 0; b < m->n_blocks; ++b) {
        const block *bl = &m->block[b];
        int end[MESH_MAX_DIM];
        edge_own_nodes(m, bl, end);
        for (int k = 0; k < end[2]; ++k)
            for (int j = 0; j < end[1]; ++j)
                for (int i = 0; i < end[0]; ++i) add_filled_share(s, body, b, (const int[]){i, j, k});
    }
}

/* Nodes where contact may join the group's motion to another's have no owner (edge_lines.c). */
static void spare_met_nodes(mpm *s, int group)
{
    mpm_edges *e = s->edges;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const block *bl = &s->mesh->block[b];
        int end[MESH_MAX_DIM];
        edge_own_nodes(s->mesh, bl, end);
        for (int g = 0; g < s->n_groups; ++g) {
            const double *mass = field_get(s->domain->fields[b], N_MASS, g, 0);
            for (int k = 0; g != group && k < end[2]; ++k)
                for (int j = 0; j < end[1]; ++j)
                    for (int i = 0; i < end[0]; ++i) {
                        const int global[MESH_MAX_DIM] = {bl->lo[0] + i, bl->lo[1] + j, bl->lo[2] + k};
                        int *owner = &e->owner[edge_number(e, global)];
                        if (*owner >= 0 && edge_bears(s, mass, mesh_index(bl, i, j, k))) *owner = SHARED;
                    }
        }
    }
}

/* What the solids of a group fill of every node, and whose it is: membranes come after them. */
static void fill_group(mpm *s, int group)
{
    mpm_edges *e = s->edges;
    for (size_t k = 0; k < edge_all_nodes(e); ++k) {
        e->fill[k] = 0.0;
        e->owner[k] = NO_BODY;
    }
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        e->group[group].filled.lo[a] = e->nodes[a];
        e->group[group].filled.end[a] = 0;
    }
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].group == group && edge_body(s, body)) fill_nodes(s, body);
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].group == group && s->body[body].membrane.model) fill_nodes(s, body);
    if (edges_spare_met_nodes(s) && !e->starting) spare_met_nodes(s, group);
}

/* Whether a line leads from one surface of a body to another through what is outside: through a slot, or across a hole of
 * a few cells, whose sides are not to be tied. */
static bool leads_outside(const double *fill, int taps)
{
    for (int t = 1; t < taps - 1; ++t) {
        double before = 0.0, after = 0.0;
        for (int k = 0; k < t; ++k) before = fmax(before, fmin(fill[k], 1.0));
        for (int k = t + 1; k < taps; ++k) after = fmax(after, fmin(fill[k], 1.0));
        if (fill[t] < MPM_HOLLOW_NODE * fmin(before, after)) return true;
    }
    return false;
}

/* The body of a line of nodes plus one; 0 where it is none, for all are full, or one is outside or within reach of
 * another body: bodies that share nodes are not to be glued; or it leads outside. */
static int line_body(const mpm_edges *e, const size_t *number, int taps)
{
    const int owner = e->owner[number[0]];
    double fill[EDGE_TAPS];
    bool part = false;
    for (int t = 0; t < taps; ++t) {
        if (owner < 0 || e->owner[number[t]] != owner) return 0;
        fill[t] = e->fill[number[t]];
        part = part || fill[t] < MPM_FULL_NODE;
    }
    return part && !leads_outside(fill, taps) ? owner + 1 : 0;
}

/* The same of the line along an axis from a node on. */
static int body_from(const mpm *s, int group, int axis, const int first[MESH_MAX_DIM])
{
    const mpm_edges *e = s->edges;
    const int taps = edge_taps(s);
    size_t number[EDGE_TAPS] = {0};
    if (first[axis] >= 0 && !(e->fill[edge_number(e, first)] > 0.0)) return 0;
    if (first[axis] >= 0 && first[axis] + taps <= e->nodes[axis]) { /* most: nothing is folded */
        const size_t stride = axis == 0 ? 1 : (size_t)e->nodes[0] * (axis == 1 ? 1 : (size_t)e->nodes[1]);
        for (int t = 0; t < taps; ++t) number[t] = edge_number(e, first) + (size_t)t * stride;
    } else {
        int tap[EDGE_TAPS][MESH_MAX_DIM];
        edge_line l = {.axis = axis};
        if (!edge_find_taps(s, group, first, tap, &l)) return 0;
        for (int t = 0; t < taps; ++t) number[t] = edge_number(e, tap[t]);
    }
    return line_body(e, number, taps);
}

/* Clears the history of lines that are no longer penalised. */
static floe_status judge_line(mpm *s, int group, int axis, const int first[MESH_MAX_DIM], void *user)
{
    mpm_edges *e = s->edges;
    bool *changed = user;
    const size_t place = edge_place(s, group, axis, first), dim = (size_t)s->mesh->dim;
    const int body = body_from(s, group, axis, first);
    if (body == (int)e->memory[e->lines + place]) return FLOE_OK;
    *changed = true;
    e->memory[e->lines + place] = body;
    if (body == 0) memset(e->memory + place * dim, 0, dim * sizeof *e->memory);
    return FLOE_OK;
}

floe_status edges_look(mpm *s, int group, bool *changed)
{
    edge_group *g = &s->edges->group[group];
    *changed = false;
    fill_group(s, group);
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        if (g->filled.lo[a] < g->box.lo[a]) g->box.lo[a] = g->filled.lo[a];
        if (g->filled.end[a] > g->box.end[a]) g->box.end[a] = g->filled.end[a];
    }
    return edge_visit_starts(s, group, judge_line, changed);
}

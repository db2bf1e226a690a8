/* Unilateral sides. For a group of solids alone, a slip wall is a body of infinite mass: contact springs at the nodes
 * (wall_overlap.h) act on bodies that have reached it, in compression only. A node has mass of a body up to one and a
 * half cells before the body arrives; the points, each with half its width, determine whether it has. The momentum that
 * a body loses there is an impulse on its points, unlike at a mirror, beyond which the image of the body continues.
 * Beyond such a side velocities are extrapolated linearly, as beyond any side without a mirror. Fluid points, and
 * solids that share a velocity field with them, keep the mirror. So do membranes around gas on cells, whose ends are
 * attached to the sides, and implicit steps (implicit.h). */
#include "grid/tile_box.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/wall.h"
#include "mpm/nodes/wall_overlap.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/reach.h"
#include "mpm/transfer/windows.h"

#include <math.h>

/* Groups for which some body makes sides bilateral. */
static bool is_loose(const mpm *s, int group)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        const mpm_body *body = &s->body[b];
        if (body->group == group && (body->fluid || (body->membrane.model && (s->cells == CELLS_CUT || s->enclosure))))
            return false;
    }
    return true;
}

bool wall_lets_go(const mpm *s, int group, int axis, int side)
{
    return s->scene->bc.side[axis][side].kind == BC_SLIP && !s->mesh->periodic[axis] && !mpm_is_solved(s) &&
           is_loose(s, group);
}

bool walls_let_go(const mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                if (wall_lets_go(s, g, axis, side)) return true;
    return false;
}

/* ---- how far points reach ---- */

/* Half widths of a point along the axes (m): of its domain where it keeps one, else of a sub-cell of the volume that it has. */
static void half_widths(const mpm *s, int body, const point_arrays *p, size_t k, double half[MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    const int *per_cell = s->scene->body[s->body[body].scene_body].per_cell;
    double volume = p->volume0[k] * p->J[k], lattice = 1.0;
    if (m->geometry == MESH_AXISYMMETRIC) volume /= p->x[0][k];
    for (int a = 0; a < m->dim; ++a) {
        half[a] = s->body[body].membrane.model ? 0.0 : 0.5 * m->h[a] / (per_cell[a] > 0 ? per_cell[a] : 2);
        lattice *= 2.0 * half[a];
    }
    const double share = volume / lattice;
    const double stretch = m->dim == 1 ? share : m->dim == 2 ? sqrt(share) : cbrt(share);
    for (int a = 0; a < m->dim && lattice > 0.0; ++a) half[a] *= stretch;
}

/* A point's reach beyond a side, and its body's rank, to the nodes of the side's plane that it gives to. */
static void scatter_reach_at_side(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, int axis, int side,
                                  double reach, double rank, double *out)
{
    const int *window = s->windows->window, dim = s->mesh->dim;
    point_span r = span_of_point(s, t, p, k);
    const int plane = s->windows->reach + (side == SIDE_LOWER ? 0 : s->mesh->n[axis]) - t->first[axis];
    if (plane < r.first[axis] || plane >= r.first[axis] + r.n[axis]) return;
    r.first[axis] = plane;
    r.n[axis] = 1;
    for (int z = r.first[2]; z < r.first[2] + r.n[2]; ++z)
        for (int y = r.first[1]; y < r.first[1] + r.n[1]; ++y)
            for (int x = r.first[0]; x < r.first[0] + r.n[0]; ++x) {
                double *node = &out[(x + window[0] * (y + window[1] * z)) * (dim + 1)];
                node[axis] = fmax(node[axis], reach);
                node[dim] = fmax(node[dim], -rank);
            }
}

/* Whether a tile's window holds nodes of a side's plane. */
static bool is_at_side(const mpm *s, const tile_box *t, int axis, int side)
{
    return side == SIDE_LOWER ? t->first[axis] <= s->windows->reach
                              : t->first[axis] + t->cells[axis] + s->windows->reach >= s->mesh->n[axis];
}

static void scatter_side(const mpm *s, int blk, int body, const tile_box *t, const size_t range[2], double *out)
{
    const mesh *m = s->mesh;
    const point_arrays p = points_of(s, blk, body, false, false);
    for (int axis = 0; axis < m->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (!is_at_side(s, t, axis, side) || !wall_lets_go(s, s->body[body].group, axis, side)) continue;
            for (size_t k = range[0]; k < range[1]; ++k) {
                double half[MESH_MAX_DIM] = {0.0};
                const double x = p.x[axis][k];
                const double depth = side == SIDE_LOWER ? m->lower[axis] - x : x - m->upper[axis];
                if (depth < -2.0 * m->h[axis]) continue; /* no basis reaches so far */
                half_widths(s, body, &p, k, half);
                scatter_reach_at_side(s, t, &p, k, axis, side, depth + half[axis], s->overlaps->rank[body], out);
            }
        }
}

static void scatter_reach_at_sides(mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    bool any = false;
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side)
            any = any || (is_at_side(s, &box, axis, side) && wall_lets_go(s, group, axis, side));
    s->windows->active[box.number] = any;
    if (!any) return;
    double *out = start_reach(s, &box, s->mesh->dim + 1);
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start + tile;
        if (s->body[body].group == group && start[0] < start[1]) scatter_side(s, blk, body, &box, start, out);
    }
}

floe_status mpm_side_reach(mpm *s)
{
    reach_to_nodes(s, scatter_reach_at_sides, (const field_id[]){N_SIDE_REACH, N_SIDE_BODY}, 2);
    return FLOE_OK;
}

/* ---- what presses ---- */

/* What a side does to the nodes of its plane, along its axis; arrays of the block in hand. */
typedef struct side_rule {
    const mpm *s;
    int group, axis, side;
    double outward; /* 1, -1: sign of velocities into the side */
    double near;    /* m: points this far from the side have come */
    field_id velocity;
    const double *rank, *mass, *reach;
    double *v;
    double *force;
    double impulse, moment[3], work;
} side_rule;

static side_rule rule_of(const mpm *s, int axis, int side, int group)
{
    double least = s->mesh->h[0];
    for (int a = 1; a < s->mesh->dim; ++a) least = fmin(least, s->mesh->h[a]);
    return (side_rule){.s = s,
                       .group = group,
                       .axis = axis,
                       .side = side,
                       .outward = side == SIDE_LOWER ? -1.0 : 1.0,
                       .near = 1e-6 * least,
                       .velocity = N_VEL_L};
}

static void look_at_block(side_rule *r, int blk)
{
    const fields *f = r->s->domain->fields[blk];
    r->rank = field_get(f, N_SIDE_BODY, r->group, 0);
    r->reach = field_get(f, N_SIDE_REACH, r->group, r->axis);
    r->mass = field_get(f, N_MASS, r->group, 0);
    r->force = field_get(f, N_FORCE, r->group, r->axis);
    r->v = field_get(f, r->velocity, r->group, r->axis);
}

/* Of the slowest body about a node with mass that some point has come near the side. */
static overlap_surface surface_at(const side_rule *r, ptrdiff_t at)
{
    const struct mpm_overlaps *o = r->s->overlaps;
    return o->surface[o->slowest[(int)-r->rank[at]]];
}

/* Whether points that give to a node have come near the side. */
static bool is_reached(const side_rule *r, ptrdiff_t at)
{
    return r->mass[at] > 0.0 && r->rank[at] > -SCENE_MAX_BODIES;
}

/* N/m: of the spring at a node. */
static double stiffness_at(const side_rule *r, ptrdiff_t at)
{
    return overlap_stiffness(r->mass[at], surface_at(r, at).speed, r->s->mesh->h[r->axis]);
}

/* N, out of the side. */
static double push_at(const side_rule *r, const int node[MESH_MAX_DIM], ptrdiff_t at)
{
    const struct mpm_overlaps *o = r->s->overlaps;
    const double overlap = o->now[overlap_of_side(o, r->group, r->axis, r->side, node)], h = r->s->mesh->h[r->axis];
    if (!(overlap > 0.0) || !is_reached(r, at)) return 0.0;
    return stiffness_at(r, at) * overlap_push(overlap, h);
}

/* Calls for the nodes of a side that a block sees. */
typedef void side_visitor(side_rule *r, const int node[MESH_MAX_DIM], ptrdiff_t at);

static void visit_block(side_rule *r, int blk, side_visitor *visit)
{
    const mesh *m = r->s->mesh;
    const block *b = &m->block[blk];
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1}, node[MESH_MAX_DIM];
    if (!b->at_side[r->axis][r->side]) return;
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = b->at_side[a][SIDE_LOWER] && !m->periodic[a] ? 0 : b->lo[a] - 1;
        end[a] = b->lo[a] + b->n[a] + (b->at_side[a][SIDE_UPPER] && !m->periodic[a] ? 1 : 2);
    }
    lo[r->axis] = r->side == SIDE_LOWER ? 0 : m->n[r->axis];
    end[r->axis] = lo[r->axis] + 1;
    look_at_block(r, blk);
    for (node[2] = lo[2]; node[2] < end[2]; ++node[2])
        for (node[1] = lo[1]; node[1] < end[1]; ++node[1])
            for (node[0] = lo[0]; node[0] < end[0]; ++node[0])
                visit(r, node, mesh_index(b, node[0] - b->lo[0], node[1] - b->lo[1], node[2] - b->lo[2]));
}

static void predict_side_velocity(side_rule *r, const int node[MESH_MAX_DIM], ptrdiff_t at)
{
    r->force[at] -= r->outward * push_at(r, node, at);
}

/* An impulse along the side's axis at one of its nodes. */
static void push_side(side_rule *r, const int node[MESH_MAX_DIM], double impulse)
{
    double x[MESH_MAX_DIM];
    place_of_node(r->s->mesh, node, x);
    r->impulse += impulse;
    add_moment(r->moment, x, r->axis, impulse);
}

static void enter_push(mpm *s, const side_rule *r, double share)
{
    ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + r->axis), LEDGER_BOUNDARY, share * r->impulse);
    ledger_turn(s->ledger, LEDGER_BOUNDARY, r->moment, share);
}

static void add_push(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    side_rule *r = user;
    look_at_block(r, blk);
    push_side(r, node, -r->outward * r->s->kick * push_at(r, node, at));
}

void push_off_sides(mpm *s, int group)
{
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (!wall_lets_go(s, group, axis, side)) continue;
            side_rule rule = rule_of(s, axis, side, group);
            wall_visit_once(s->mesh, axis, side, add_push, &rule);
            enter_push(s, &rule, 1.0);
            for (int b = 0; b < s->mesh->n_blocks; ++b) visit_block(&rule, b, predict_side_velocity);
        }
}

/* Whether what presses at a node flows: it then loses its approach. */
static bool flows_at(const side_rule *r, const int node[MESH_MAX_DIM], ptrdiff_t at)
{
    const struct mpm_overlaps *o = r->s->overlaps;
    if (!is_reached(r, at)) return false;
    return o->now[overlap_of_side(o, r->group, r->axis, r->side, node)] >=
           (1.0 - 1e-9) * surface_at(r, at).flows * r->s->mesh->h[r->axis];
}

static void stop_node(side_rule *r, const int node[MESH_MAX_DIM], ptrdiff_t at)
{
    if (!flows_at(r, node, at)) return;
    r->v[at] = r->velocity == N_VEL_L ? r->outward * fmin(0.0, r->outward * r->v[at]) : 0.0;
}

static void add_stop(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    side_rule *r = user;
    look_at_block(r, blk);
    if (!flows_at(r, node, at)) return;
    const double lost = r->velocity == N_VEL_L ? fmax(0.0, r->outward * r->v[at]) : r->outward * r->v[at];
    push_side(r, node, -r->outward * r->mass[at] * lost);
}

void stop_flowing(mpm *s, int axis, int side, int group, field_id velocity, double entered)
{
    side_rule rule = rule_of(s, axis, side, group);
    rule.velocity = velocity;
    if (entered != 0.0) {
        wall_visit_once(s->mesh, axis, side, add_stop, &rule);
        enter_push(s, &rule, entered);
    }
    for (int b = 0; b < s->mesh->n_blocks; ++b) visit_block(&rule, b, stop_node);
}

static void follow_node(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    side_rule *r = user;
    struct mpm_overlaps *o = r->s->overlaps;
    const size_t place = overlap_of_side(o, r->group, r->axis, r->side, node);
    const double h = r->s->mesh->h[r->axis];
    look_at_block(r, blk);
    if (!is_reached(r, at) || !(o->now[place] > 0.0 || r->reach[at] >= -r->near)) return;
    const double next = fmax(0.0, o->now[place] + r->outward * r->s->dt * r->v[at]);
    o->next[place] = fmin(next, surface_at(r, at).flows * h);
    r->work -= stiffness_at(r, at) * (overlap_energy(o->next[place], h) - overlap_energy(o->now[place], h));
}

void follow_sides(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side) {
                if (!wall_lets_go(s, g, axis, side)) continue;
                side_rule rule = rule_of(s, axis, side, g);
                wall_visit_once(s->mesh, axis, side, follow_node, &rule);
                ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, rule.work);
            }
}

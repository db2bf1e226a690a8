/* Sides that let go. To a group of solids alone, a slip wall is a body of infinite mass: it stops what has come and goes on, node by
 * node, by contact's own rule (contact.h), and pulls nothing back. A node sees a body up to one and a half cells before it arrives;
 * whether it has come is told by the points themselves, each with half its width. What a body loses there is an impulse on its points,
 * unlike at a mirror, beyond which the body goes on as its image. Beyond such a side velocities are continued in a straight line, as
 * beyond any side without a mirror. Fluid points, and solids that share a velocity field with them, keep the mirror; so do membranes
 * that hold a gas in, whose ends are tied to the sides, and steps that are solved for (balance.h). */
#include "mpm/wall.h"

#include <math.h>
#include <string.h>

enum { MAX_SIDE_WINDOW = 343 };

/* Groups that some body keeps from being let go. */
static bool is_loose(const mpm *s, int group)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        const mpm_body *body = &s->body[b];
        if (body->group == group && (body->fluid || (body->membrane.model && (s->seals || s->holds)))) return false;
    }
    return true;
}

bool wall_lets_go(const mpm *s, int group, int axis, int side)
{
    return s->scene->bc.side[axis][side].kind == BC_SLIP && !s->mesh->periodic[axis] && !s->balance &&
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

/* The nodes of a tile's window that a point gives to along an axis: the first, and returns how many. */
static int span_of(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, int axis, int *first)
{
    const mesh *m = s->mesh;
    const double inv_h = 1.0 / m->h[axis], at = (p->x[axis][k] - m->lower[axis]) * inv_h - t->first[axis];
    double w[BASIS_MAX_SUPPORT], dw[BASIS_MAX_SUPPORT];
    int cell = (int)at;
    cell = cell < 0 ? 0 : cell >= t->cells[axis] ? t->cells[axis] - 1 : cell;
    *first = s->work->reach + cell +
             s->basis->weights(at - cell, p->half[axis] ? p->half[axis][k] * inv_h : 0.5, inv_h, w, dw);
    return s->basis->support;
}

/* A point's reach beyond a side, to the nodes of the side's plane that it gives to. */
static void scatter_point(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, int axis, int side,
                          double reach, double *out)
{
    const int *window = s->work->window, dim = s->mesh->dim;
    int first[MESH_MAX_DIM] = {0, 0, 0}, n[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < dim; ++a) n[a] = span_of(s, t, p, k, a, &first[a]);
    const int plane = s->work->reach + (side == SIDE_LOWER ? 0 : s->mesh->n[axis]) - t->first[axis];
    if (plane < first[axis] || plane >= first[axis] + n[axis]) return;
    first[axis] = plane;
    n[axis] = 1;
    for (int z = first[2]; z < first[2] + n[2]; ++z)
        for (int y = first[1]; y < first[1] + n[1]; ++y)
            for (int x = first[0]; x < first[0] + n[0]; ++x) {
                double *node = &out[(x + window[0] * (y + window[1] * z)) * dim + axis];
                *node = fmax(*node, reach);
            }
}

/* Whether a tile's window holds nodes of a side's plane. */
static bool is_at_side(const mpm *s, const tile_box *t, int axis, int side)
{
    return side == SIDE_LOWER ? t->first[axis] <= s->work->reach
                              : t->first[axis] + t->cells[axis] + s->work->reach >= s->mesh->n[axis];
}

static void scatter_body(const mpm *s, int blk, int body, const tile_box *t, const size_t range[2], double *out)
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
                scatter_point(s, t, &p, k, axis, side, depth + half[axis], out);
            }
        }
}

static void scatter_tile(const mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double *out = domain_tile(s->domain, box.number);
    bool any = false;
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side)
            any = any || (is_at_side(s, &box, axis, side) && wall_lets_go(s, group, axis, side));
    s->work->active[box.number] = any;
    for (int k = 0; any && k < s->work->window_nodes * s->mesh->dim; ++k) out[k] = -INFINITY;
    for (int body = 0; any && body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start + tile;
        if (s->body[body].group == group && start[0] < start[1]) scatter_body(s, blk, body, &box, start, out);
    }
}

floe_status mpm_side_reach(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g) {
        for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
            for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) scatter_tile(s, g, b, t);
        }
        domain_share_partials(s->domain);
        for (int b = 0; b < s->mesh->n_blocks; ++b) {
            node_target to = {.components = s->mesh->dim, .reach = s->work->reach, .largest = true};
            memcpy(to.window, s->work->window, sizeof to.window);
            for (int a = 0; a < s->mesh->dim; ++a) to.array[a] = field_get(s->domain->fields[b], N_SIDE_REACH, g, a);
            gather_nodes(s, b, &to);
        }
        domain_fold_periodic_largest(s->domain, N_SIDE_REACH, g);
        clear_stops(s, g);
    }
    return FLOE_OK;
}

/* ---- what is stopped ---- */

void clear_stops(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < s->mesh->dim; ++a)
            memset(field_get(s->domain->fields[b], N_STOPPED, group, a), 0, s->mesh->block[b].size * sizeof(double));
}

/* What a side does to the nodes of its plane, along its axis; arrays of the block in hand. */
typedef struct stop_rule {
    const mpm *s;
    int group, axis, side;
    field_id velocity;
    double outward; /* 1, -1: sign of velocities into the side */
    double near;    /* m: points this far from the side have come */
    double kick;    /* s */
    const double *reach, *mass, *momentum, *force;
    double *stopped, *v;
    double impulse;
} stop_rule;

static stop_rule rule_of(const mpm *s, int axis, int side, int group, field_id velocity)
{
    double least = s->mesh->h[0];
    for (int a = 1; a < s->mesh->dim; ++a) least = fmin(least, s->mesh->h[a]);
    return (stop_rule){.s = s,
                       .group = group,
                       .axis = axis,
                       .side = side,
                       .velocity = velocity,
                       .outward = side == SIDE_LOWER ? -1.0 : 1.0,
                       .near = 1e-6 * least,
                       .kick = s->work->kick};
}

static void look_at_block(stop_rule *r, int blk)
{
    const fields *f = r->s->domain->fields[blk];
    r->reach = field_get(f, N_SIDE_REACH, r->group, r->axis);
    r->stopped = field_get(f, N_STOPPED, r->group, r->axis);
    r->mass = field_get(f, N_MASS, r->group, 0);
    r->momentum = field_get(f, N_MOMENTUM, r->group, r->axis);
    if (r->velocity != FIELD_COUNT) r->v = field_get(f, r->velocity, r->group, r->axis);
}

static void mark_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    const stop_rule *r = user;
    if (r->reach[at] >= -r->near && r->outward * r->v[at] > 0.0) r->stopped[at] = 1.0;
}

static void foresee_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    const stop_rule *r = user;
    const double after = r->momentum[at] + (r->force ? r->kick * r->force[at] : 0.0);
    if (r->reach[at] >= -r->near && r->outward * after > 0.0) r->stopped[at] = 1.0;
}

static void stop_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    const stop_rule *r = user;
    if (r->stopped[at] > 0.0) r->v[at] = 0.0;
}

static void add_stop(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)node;
    (void)inward;
    stop_rule *r = user;
    look_at_block(r, blk);
    if (r->stopped[at] > 0.0) r->impulse -= r->mass[at] * r->v[at];
}

static void visit_blocks(mpm *s, stop_rule *r, wall_node_visitor *visit)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        if (!s->mesh->block[b].at_side[r->axis][r->side]) continue;
        look_at_block(r, b);
        if (forces_at_once(s)) r->force = field_get(s->domain->fields[b], N_FORCE, r->group, r->axis);
        wall_visit(&s->mesh->block[b], r->axis, r->side, visit, r);
    }
}

void foresee_stops(mpm *s, int group)
{
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (!wall_lets_go(s, group, axis, side)) continue;
            stop_rule rule = rule_of(s, axis, side, group, FIELD_COUNT);
            visit_blocks(s, &rule, foresee_node);
        }
}

void stop_at_side(mpm *s, int axis, int side, int group, field_id velocity, double entered)
{
    stop_rule rule = rule_of(s, axis, side, group, velocity);
    if (velocity == N_VEL_L) visit_blocks(s, &rule, mark_node);
    if (entered != 0.0) {
        wall_visit_once(s->mesh, axis, side, add_stop, &rule);
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + axis), LEDGER_BOUNDARY, entered * rule.impulse);
    }
    visit_blocks(s, &rule, stop_node);
}

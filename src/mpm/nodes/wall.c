/* Walls at the nodes. Points near a side of the domain reach ghost nodes one layer beyond it; what they gave there is folded
 * into the mesh, and the ghosts are given the velocities that the fold implies. At a symmetry plane the
 * fold is a mirror, and at a slip wall that does not let a group go (wall_side.c): even for mass and tangential momentum, odd for normal momentum. At every other side it is linear
 * extrapolation, u_-1 = 2 u_0 - u_1: the folded basis is nonnegative, sums to one, reproduces linear fields and
 * interpolates at the wall (theory 4.3). */
#include "mpm/nodes/wall.h"

#include "grid/tile_box.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/node_place.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"
#include "mpm/transfer/windows.h"
#include "scene/formula.h"

#include <math.h>
#include <string.h>

bool wall_mirrors(const mpm *s, int group, int axis, int side)
{
    const bc_kind kind = s->scene->bc.side[axis][side].kind;
    const bool on_axis =
        s->mesh->geometry == MESH_AXISYMMETRIC && axis == 0 && side == SIDE_LOWER && s->mesh->lower[0] == 0.0;
    return kind == BC_SYMMETRY || on_axis || (kind == BC_SLIP && !wall_lets_go(s, group, axis, side));
}

/* Whether a side constrains all components of the nodes' velocity. */
static bool side_constrains_all(const mpm *s, int axis, int side)
{
    const bc_kind kind = s->scene->bc.side[axis][side].kind;
    return kind == BC_NO_SLIP || kind == BC_VELOCITY || kind == BC_INLET;
}

typedef void wall_node_visitor(void *user, ptrdiff_t at, ptrdiff_t inward);

/* Visits the nodes of a side's plane, transverse ghosts included. */
static void wall_visit(const block *b, int axis, int side, wall_node_visitor *visit, void *user)
{
    int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < b->dim; ++a) {
        lo[a] = a == axis ? (side == SIDE_LOWER ? 0 : b->n[a]) : -1;
        hi[a] = a == axis ? lo[a] + 1 : b->n[a] + 2;
    }
    const ptrdiff_t inward = side == SIDE_LOWER ? b->stride[axis] : -b->stride[axis];
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) visit(user, mesh_index(b, i, j, k), inward);
}

/* Visits each node of a side's plane once, in global order, in the block that owns it (a node on the seam of two blocks belongs to
 * the upper one, as its cell does): sums over a side have the same bits for any blocks. */
void wall_visit_once(const mesh *m, int axis, int side, wall_side_visitor *visit, void *user)
{
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    side_node_range(m, axis, side, lo, hi);
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) {
                const int node[MESH_MAX_DIM] = {i, j, k};
                const node_place p = owner_of_node(m, node);
                const ptrdiff_t stride = m->block[p.block].stride[axis];
                visit(user, p.block, node, p.at, side == SIDE_LOWER ? stride : -stride);
            }
}

/* The ghost keeps what it received: it is the reaction of a mirror, which enter_mirrors enters. */
typedef struct fold_rule {
    double *a;
    double on_wall, inside; /* what the wall node and the first inner node receive of the ghost */
} fold_rule;

static void fold_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    const fold_rule *r = user;
    const double ghost = r->a[at - inward];
    r->a[at] += r->on_wall * ghost;
    r->a[at + inward] += r->inside * ghost;
}

static void fold_array(const mpm *s, int blk, int group, int axis, int side, bool normal, double *a)
{
    const double mirror = normal ? -1.0 : 1.0;
    fold_rule rule = wall_mirrors(s, group, axis, side) ? (fold_rule){a, 0.0, mirror} : (fold_rule){a, 2.0, -1.0};
    wall_visit(&s->mesh->block[blk], axis, side, fold_node, &rule);
}

static void fold_side(const mpm *s, int blk, int axis, int side, int group, bool momentum, bool force)
{
    const fields *f = s->domain->fields[blk];
    if (momentum) fold_array(s, blk, group, axis, side, false, field_get(f, N_MASS, group, 0));
    for (int c = 0; c < s->mesh->dim; ++c) {
        if (momentum) fold_array(s, blk, group, axis, side, c == axis, field_get(f, N_MOMENTUM, group, c));
        if (force) fold_array(s, blk, group, axis, side, c == axis, field_get(f, N_FORCE, group, c));
    }
}

static void fold_components(const mpm *s, int group, field_id id, bool vector)
{
    const int components = field_component_count(field_describe(id)->components, s->mesh->dim);
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                for (int c = 0; c < components; ++c)
                    if (s->mesh->block[b].at_side[axis][side] && !s->mesh->periodic[axis])
                        fold_array(s, b, group, axis, side, vector && c == axis,
                                   field_get(s->domain->fields[b], id, group, c));
}

void fold_field(mpm *s, int group, field_id id)
{
    fold_components(s, group, id, field_describe(id)->components == FIELD_VECTOR);
}

void fold_numbers(mpm *s, int group, field_id id)
{
    fold_components(s, group, id, false);
}

/* A field of numbers with its gradient along the side's axis. */
typedef struct linear_rule {
    double *a;
    const double *gradient;
    double outward; /* m: from a node of the side to the ghost */
    bool mirror;
} linear_rule;

static void fold_linear_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    const linear_rule *r = user;
    const double ghost = r->a[at - inward], rise = -r->outward * r->gradient[at - inward];
    if (!r->mirror) r->a[at] += 2.0 * (ghost + rise);
    r->a[at + inward] += r->mirror ? ghost : -(ghost + 2.0 * rise);
}

void fold_linear(mpm *s, int group, field_id id, field_id gradient)
{
    if (s->windows->reach == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side) {
                const fields *f = s->domain->fields[b];
                if (!s->mesh->block[b].at_side[axis][side] || s->mesh->periodic[axis]) continue;
                linear_rule rule = {.a = field_get(f, id, group, 0),
                                    .gradient = field_get(f, gradient, group, axis),
                                    .outward = (side == SIDE_LOWER ? -1.0 : 1.0) * s->mesh->h[axis],
                                    .mirror = wall_mirrors(s, group, axis, side)};
                wall_visit(&s->mesh->block[b], axis, side, fold_linear_node, &rule);
                for (int c = 0; c < s->mesh->dim; ++c)
                    fold_array(s, b, group, axis, side, c == axis, field_get(f, gradient, group, c));
            }
}

static void fold_sides(mpm *s, int group, bool momentum, bool force)
{
    if (s->windows->reach == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                if (s->mesh->block[b].at_side[axis][side] && !s->mesh->periodic[axis])
                    fold_side(s, b, axis, side, group, momentum, force);
}

void fold_walls(mpm *s, int group, bool momentum, bool force)
{
    fold_sides(s, group, momentum, force);
    fold_supports(s, group, momentum, force);
}

/* Gives the ghost nodes the values that the fold implies. */
typedef struct extend_rule {
    double *a;
    double on_wall, inside;
} extend_rule;

static void extend_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    const extend_rule *r = user;
    r->a[at - inward] = r->on_wall * r->a[at] + r->inside * r->a[at + inward];
}

void extend_to_ghosts(mpm *s, int group, field_id id)
{
    if (s->windows->reach == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side) {
                if (!s->mesh->block[b].at_side[axis][side] || s->mesh->periodic[axis]) continue;
                const bool vector = field_describe(id)->components == FIELD_VECTOR;
                for (int c = 0; c < (vector ? s->mesh->dim : 1); ++c) {
                    double *a = field_get(s->domain->fields[b], id, group, c);
                    const double odd = vector && c == axis ? -1.0 : 1.0;
                    extend_rule rule =
                        wall_mirrors(s, group, axis, side) ? (extend_rule){a, 0.0, odd} : (extend_rule){a, 2.0, -1.0};
                    wall_visit(&s->mesh->block[b], axis, side, extend_node, &rule);
                }
            }
}

/* What a wall does to the velocity of its nodes. */
typedef struct wall_rule {
    const mpm *s;
    int group, axis;
    field_id field;
    double scale; /* impulse that is entered, of mass times what the field loses */
    double target[MESH_MAX_DIM];
    bool constrains[MESH_MAX_DIM];
    double *v[MESH_MAX_DIM]; /* of the block in hand */
    double impulse[MESH_MAX_DIM], moment[3], work;
} wall_rule;

bool wall_constrains(const mpm *s, int group, int axis, int side, int component)
{
    return side_constrains_all(s, axis, side) || (wall_mirrors(s, group, axis, side) && component == axis);
}

/* A velocity that changes with place is for fluids on cells: points see that in the middle of the side (scene/unsupported.c). */
static double value_at_middle(const mpm *s, const expression *formula, int axis, int side, double t)
{
    const mesh *m = s->mesh;
    double x[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < m->dim; ++a) x[a] = 0.5 * (m->lower[a] + m->upper[a]);
    x[axis] = side == SIDE_LOWER ? m->lower[axis] : m->upper[axis];
    return expression_value(formula, x, t);
}

double wall_target(const mpm *s, int axis, int side, int component)
{
    const bc_side *wall = &s->scene->bc.side[axis][side];
    if (!side_constrains_all(s, axis, side)) return 0.0;
    const double t = s->time + s->dt;
    const expression *formula = scene_formula_of(s->scene, &wall->velocity[component]);
    if (formula)
        return (wall->kind == BC_VELOCITY ? swing_at(&wall->course, t) : 1.0) *
               value_at_middle(s, formula, axis, side, t);
    return wall->kind == BC_VELOCITY ? bc_velocity(wall, component, t) : wall->velocity[component];
}

static wall_rule wall_rule_of(const mpm *s, int axis, int side, int group, field_id field)
{
    wall_rule r = {.s = s, .group = group, .axis = axis, .field = field};
    for (int c = 0; c < s->mesh->dim; ++c) {
        r.constrains[c] = wall_constrains(s, group, axis, side, c);
        r.target[c] = wall_target(s, axis, side, c);
    }
    return r;
}

static void add_impulse(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    wall_rule *r = user;
    double x[MESH_MAX_DIM];
    const fields *f = r->s->domain->fields[blk];
    place_of_node(r->s->mesh, node, x);
    const double mass = field_get(f, N_MASS, r->group, 0)[at];
    for (int c = 0; c < r->s->mesh->dim; ++c) {
        if (!r->constrains[c]) continue;
        const double impulse = mass * (r->target[c] - field_get(f, r->field, r->group, c)[at]);
        r->impulse[c] += impulse;
        add_moment(r->moment, x, c, impulse);
        r->work += impulse * r->target[c];
    }
}

static void enter_wall_impulse(mpm *s, const wall_rule *r, double share)
{
    for (int c = 0; c < s->mesh->dim; ++c)
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + c), LEDGER_BOUNDARY, share * r->impulse[c]);
    ledger_turn(s->ledger, LEDGER_BOUNDARY, r->moment, share);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, share * r->work);
}

static void impose_wall_node(void *user, ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    const wall_rule *r = user;
    for (int c = 0; c < r->s->mesh->dim; ++c)
        if (r->constrains[c]) r->v[c][at] = r->target[c];
}

/* Visits a side's nodes in every block, the rule's arrays being those of its field there. */
static void visit_side_blocks(mpm *s, int axis, int side, wall_rule *r, wall_node_visitor *visit)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        if (!s->mesh->block[b].at_side[axis][side]) continue;
        for (int c = 0; c < s->mesh->dim; ++c) r->v[c] = field_get(s->domain->fields[b], r->field, r->group, c);
        wall_visit(&s->mesh->block[b], axis, side, visit, r);
    }
}

static void impose_side(mpm *s, int axis, int side, int group, field_id velocity, double entered)
{
    if (wall_lets_go(s, group, axis, side)) {
        stop_flowing(s, axis, side, group, velocity, entered);
        return;
    }
    wall_rule rule = wall_rule_of(s, axis, side, group, velocity);
    if (entered != 0.0) {
        wall_visit_once(s->mesh, axis, side, add_impulse, &rule);
        enter_wall_impulse(s, &rule, entered);
    }
    visit_side_blocks(s, axis, side, &rule, impose_wall_node);
}

void impose_walls(mpm *s, int group, field_id velocity, double entered)
{
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2 && !s->mesh->periodic[axis]; ++side)
            impose_side(s, axis, side, group, velocity, entered);
    impose_supports(s, group, velocity, entered);
}

/* A node that a wall constrains does not accelerate. The velocity that its points have is not changed by that, nor is it at a mirror, where
 * the momentum of the image cancels theirs at the node: only PIC's share of their velocity is the node's. */
static void still_sum(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    wall_rule *r = user;
    double x[MESH_MAX_DIM];
    place_of_node(r->s->mesh, node, x);
    const fields *f = r->s->domain->fields[blk];
    const double kept = r->scale * field_get(f, N_MASS, r->group, 0)[at];
    for (int c = 0; c < r->s->mesh->dim; ++c) {
        if (!r->constrains[c]) continue;
        const double impulse = -kept * field_get(f, r->field, r->group, c)[at];
        r->impulse[c] += impulse;
        add_moment(r->moment, x, c, impulse);
        r->work += impulse * r->target[c];
    }
}

static void still_side(mpm *s, int axis, int side, int group, field_id field, double scale)
{
    wall_rule rule = wall_rule_of(s, axis, side, group, field);
    rule.scale = scale;
    wall_visit_once(s->mesh, axis, side, still_sum, &rule);
    enter_wall_impulse(s, &rule, 1.0);
    memset(rule.target, 0, sizeof rule.target); /* of the change */
    visit_side_blocks(s, axis, side, &rule, impose_wall_node);
}

void still_walls(mpm *s, int group)
{
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2 && !s->mesh->periodic[axis]; ++side)
            if (!wall_lets_go(s, group, axis, side)) /* whose force is an impulse on the points */
                still_side(s, axis, side, group, N_ACCEL, s->share * s->kick);
}

void constrain_change(mpm *s, int group, field_id change, double share)
{
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2 && !s->mesh->periodic[axis]; ++side)
            if (wall_lets_go(s, group, axis, side))
                stop_flowing(s, axis, side, group, change, share);
            else
                still_side(s, axis, side, group, change, share);
    constrain_supports(s, group, change, share);
}

/* A mirror gives a body the momentum that its image loses: of what the points gave the ghost (force f, mass m, momentum p), the
 * normal part comes back with the other sign. Per step, with acceleration a and velocity v of the first inner node, the points gain
 * -2 [kick (f + m a) + pic (p + m v)] more than the nodes did, pic the share of their velocity that they take from the nodes.
 * The tangential part is brought from the ghost to the first inner node and back, over d: that turns by
 * d x [kick (f - m a) + pic (p - m v)]. */
typedef struct mirror_sum {
    const mpm *s;
    int group, axis;
    double kick, pic;
    field_id given, change; /* f, FIELD_COUNT: none, and a */
    double sum, moment[3];
} mirror_sum;

/* Adds a component of what a ghost was given, and of what its mass makes of the first inner node's change. */
static void add_image(mirror_sum *r, const int node[MESH_MAX_DIM], int c, double share, double given, double reaction)
{
    const mesh *m = r->s->mesh;
    double x[MESH_MAX_DIM] = {0.0};
    if (c != r->axis) {
        x[r->axis] = (node[r->axis] == 0 ? 2.0 : -2.0) * m->h[r->axis]; /* from the ghost to the first inner node */
        add_moment(r->moment, x, c, share * (given - reaction));
        return;
    }
    const double impulse = -2.0 * share * (given + reaction);
    place_of_node(m, node, x);
    add_moment(r->moment, x, c, impulse);
    r->sum += impulse;
}

static void add_mirrored_change(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    mirror_sum *r = user;
    const fields *f = r->s->domain->fields[blk];
    const double mass = field_get(f, N_MASS, r->group, 0)[at - inward];
    for (int c = 0; c < r->s->mesh->dim; ++c) {
        const double given = r->given == FIELD_COUNT ? 0.0 : field_get(f, r->given, r->group, c)[at - inward];
        add_image(r, node, c, r->kick, given, mass * field_get(f, r->change, r->group, c)[at + inward]);
    }
}

/* Velocity of the first inner node along an axis, as points take it: that of the points, or of a wall across the mirror that constrains it. */
static double inner_velocity(const mirror_sum *r, const int node[MESH_MAX_DIM], int axis, double brought)
{
    const mesh *m = r->s->mesh;
    double v = brought;
    for (int a = 0; a < m->dim; ++a)
        for (int side = 0; side < 2; ++side)
            if (a != r->axis && !m->periodic[a] && node[a] == (side == SIDE_LOWER ? 0 : m->n[a]) &&
                side_constrains_all(r->s, a, side))
                v = wall_target(r->s, a, side, axis);
    return v;
}

static void add_mirrored_momentum(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    mirror_sum *r = user;
    const fields *f = r->s->domain->fields[blk];
    const double *mass = field_get(f, N_MASS, r->group, 0);
    const ptrdiff_t ghost = at - inward, inner = at + inward;
    for (int c = 0; c < r->s->mesh->dim; ++c) {
        const double *momentum = field_get(f, N_MOMENTUM, r->group, c);
        /* A ghost without mass may still have a surface's load. */
        const double v = inner_velocity(r, node, c, mass[inner] > 0.0 ? momentum[inner] / mass[inner] : 0.0);
        add_image(r, node, c, r->pic, momentum[ghost], mass[ghost] * v);
    }
}

/* Enters the share `entered` of each mirror's sum. */
static void enter_images(mpm *s, const mirror_sum *of, double entered)
{
    for (int axis = 0; s->windows->reach > 0 && axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2 && !s->mesh->periodic[axis]; ++side) {
            if (!wall_mirrors(s, of->group, axis, side)) continue;
            mirror_sum r = *of;
            r.axis = axis;
            if (r.kick != 0.0) wall_visit_once(s->mesh, axis, side, add_mirrored_change, &r);
            if (r.pic != 0.0) wall_visit_once(s->mesh, axis, side, add_mirrored_momentum, &r);
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + axis), LEDGER_BOUNDARY, entered * r.sum);
            ledger_turn(s->ledger, LEDGER_BOUNDARY, r.moment, entered);
        }
}

void enter_mirrors(mpm *s, int group)
{
    enter_images(
        s,
        &(mirror_sum){
            .s = s, .group = group, .kick = s->kick, .pic = 1.0 - s->share, .given = N_FORCE, .change = N_ACCEL},
        1.0);
}

void enter_mirrored_momenta(mpm *s, int group, double share)
{
    enter_images(s, &(mirror_sum){.s = s, .group = group, .pic = share}, 1.0);
}

void enter_mirrored_change(mpm *s, int group, field_id change, double share, bool given)
{
    enter_images(
        s,
        &(mirror_sum){.s = s, .group = group, .kick = 1.0, .given = given ? N_MOMENTUM : FIELD_COUNT, .change = change},
        share);
}

void mirror_masses(const mpm *s, int group, const tile_box *t, double *window)
{
    const mesh *m = s->mesh;
    const int *size = s->windows->window;
    for (int axis = 0; axis < m->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            const bool there = side == SIDE_LOWER ? t->first[axis] == 0 : t->first[axis] + t->cells[axis] == m->n[axis];
            if (!there || m->periodic[axis] || !wall_mirrors(s, group, axis, side)) continue;
            int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {1, 1, 1};
            for (int a = 0; a < m->dim; ++a) {
                const int wall = s->windows->reach + (side == SIDE_LOWER ? 0 : t->cells[a]);
                lo[a] = a == axis ? wall : 0;
                hi[a] = a == axis ? wall + 1 : size[a];
            }
            for (int k = lo[2]; k < hi[2]; ++k)
                for (int j = lo[1]; j < hi[1]; ++j)
                    for (int i = lo[0]; i < hi[0]; ++i) window[(k * size[1] + j) * size[0] + i] *= 2.0;
        }
}

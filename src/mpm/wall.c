/* Walls at the nodes. Points near a side of the domain reach ghost nodes one layer beyond it; what they gave there is folded
 * into the mesh, and the ghosts are given the velocities that the fold implies. At a symmetry plane or slip wall the
 * fold is a mirror: even for mass and tangential momentum, odd for normal momentum. At every other side it is linear
 * extrapolation, u_-1 = 2 u_0 - u_1: the folded basis is nonnegative, sums to one, reproduces linear fields and
 * interpolates at the wall (numerics 4.3). */
#include "mpm/work.h"

static bool mirrors(const mpm *s, int axis, int side)
{
    const bc_kind kind = s->scene->bc.side[axis][side].kind;
    const bool on_axis =
        s->mesh->geometry == MESH_AXISYMMETRIC && axis == 0 && side == SIDE_LOWER && s->mesh->lower[0] == 0.0;
    return kind == BC_SYMMETRY || kind == BC_SLIP || on_axis;
}

/* Sides that hold all components of the nodes' velocity. */
static bool holds(const mpm *s, int axis, int side)
{
    const bc_kind kind = s->scene->bc.side[axis][side].kind;
    return kind == BC_NO_SLIP || kind == BC_VELOCITY || kind == BC_INLET;
}

/* `owned`: the node is this block's own (a node on the seam of two blocks belongs to the upper one, as its cell does). */
typedef void node_visitor(void *user, ptrdiff_t at, ptrdiff_t inward, bool owned);

static bool owns(const block *b, int axis, int i)
{
    return axis >= b->dim || (i >= 0 && (i < b->n[axis] || (i == b->n[axis] && b->at_side[axis][SIDE_UPPER])));
}

/* Visits the nodes of a side's plane, transverse ghosts included. */
static void visit_side(const block *b, int axis, int side, node_visitor *visit, void *user)
{
    int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < b->dim; ++a) {
        lo[a] = a == axis ? (side == SIDE_LOWER ? 0 : b->n[a]) : -1;
        hi[a] = a == axis ? lo[a] + 1 : b->n[a] + 2;
    }
    const ptrdiff_t inward = side == SIDE_LOWER ? b->stride[axis] : -b->stride[axis];
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i)
                visit(user, mesh_index(b, i, j, k), inward, owns(b, 0, i) && owns(b, 1, j) && owns(b, 2, k));
}

/* The ghost keeps what it received: it is the reaction of a mirror, which enter_mirrors enters. */
typedef struct fold_rule {
    double *a;
    double on_wall, inside; /* what the wall node and the first inner node receive of the ghost */
} fold_rule;

static void fold_node(void *user, ptrdiff_t at, ptrdiff_t inward, bool owned)
{
    (void)owned;
    const fold_rule *r = user;
    const double ghost = r->a[at - inward];
    r->a[at] += r->on_wall * ghost;
    r->a[at + inward] += r->inside * ghost;
}

static void fold_array(const mpm *s, int blk, int axis, int side, bool normal, double *a)
{
    const double mirror = normal ? -1.0 : 1.0;
    fold_rule rule = mirrors(s, axis, side) ? (fold_rule){a, 0.0, mirror} : (fold_rule){a, 2.0, -1.0};
    visit_side(&s->mesh->block[blk], axis, side, fold_node, &rule);
}

static void fold_side(const mpm *s, int blk, int axis, int side, int group, bool momentum, bool force)
{
    const fields *f = s->domain->fields[blk];
    if (momentum) fold_array(s, blk, axis, side, false, field_get(f, N_MASS, group, 0));
    for (int c = 0; c < s->mesh->dim; ++c) {
        if (momentum) fold_array(s, blk, axis, side, c == axis, field_get(f, N_MOMENTUM, group, c));
        if (force) fold_array(s, blk, axis, side, c == axis, field_get(f, N_FORCE, group, c));
    }
}

void fold_walls(mpm *s, int group, bool momentum, bool force)
{
    if (s->work->reach == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                if (s->mesh->block[b].at_side[axis][side] && !s->mesh->periodic[axis])
                    fold_side(s, b, axis, side, group, momentum, force);
}

/* Gives the ghost nodes the values that the fold implies. */
typedef struct extend_rule {
    double *a;
    double on_wall, inside;
} extend_rule;

static void extend_node(void *user, ptrdiff_t at, ptrdiff_t inward, bool owned)
{
    (void)owned;
    const extend_rule *r = user;
    r->a[at - inward] = r->on_wall * r->a[at] + r->inside * r->a[at + inward];
}

void extend_to_ghosts(mpm *s, int group, field_id id)
{
    if (s->work->reach == 0) return;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side) {
                if (!s->mesh->block[b].at_side[axis][side] || s->mesh->periodic[axis]) continue;
                const bool vector = field_describe(id)->components == FIELD_VECTOR;
                for (int c = 0; c < (vector ? s->mesh->dim : 1); ++c) {
                    double *a = field_get(s->domain->fields[b], id, group, c);
                    const double odd = vector && c == axis ? -1.0 : 1.0;
                    extend_rule rule =
                        mirrors(s, axis, side) ? (extend_rule){a, 0.0, odd} : (extend_rule){a, 2.0, -1.0};
                    visit_side(&s->mesh->block[b], axis, side, extend_node, &rule);
                }
            }
}

/* What a wall does to the velocity of its nodes; the impulse is entered for the nodes that the mesh owns. */
typedef struct wall_rule {
    const mpm *s;
    const block *b;
    double *v[MESH_MAX_DIM];
    const double *mass;
    double target[MESH_MAX_DIM];
    bool hold[MESH_MAX_DIM];
    double impulse[MESH_MAX_DIM], work;
    int axis, side;
} wall_rule;

static void impose_node(void *user, ptrdiff_t at, ptrdiff_t inward, bool owned)
{
    (void)inward;
    wall_rule *r = user;
    for (int c = 0; c < r->b->dim; ++c) {
        if (!r->hold[c]) continue;
        if (owned && r->mass) {
            const double impulse = r->mass[at] * (r->target[c] - r->v[c][at]);
            r->impulse[c] += impulse;
            r->work += impulse * r->target[c];
        }
        r->v[c][at] = r->target[c];
    }
}

static void impose_side(mpm *s, int blk, int axis, int side, int group, field_id velocity)
{
    const fields *f = s->domain->fields[blk];
    wall_rule rule = {.s = s, .b = &s->mesh->block[blk], .axis = axis, .side = side};
    rule.mass = velocity == N_VEL_L ? field_get(f, N_MASS, group, 0) : NULL;
    for (int c = 0; c < s->mesh->dim; ++c) {
        rule.v[c] = field_get(f, velocity, group, c);
        rule.hold[c] = holds(s, axis, side) || (mirrors(s, axis, side) && c == axis);
        rule.target[c] = holds(s, axis, side) ? s->scene->bc.side[axis][side].velocity[c] : 0.0;
    }
    visit_side(rule.b, axis, side, impose_node, &rule);
    for (int c = 0; c < s->mesh->dim; ++c)
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + c), LEDGER_BOUNDARY, rule.impulse[c]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, rule.work);
}

void impose_walls(mpm *s, int group, field_id velocity)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                if (s->mesh->block[b].at_side[axis][side] && !s->mesh->periodic[axis])
                    impose_side(s, b, axis, side, group, velocity);
}

/* A mirror gives a body the momentum that its image loses: of what the points gave the ghost (force f, mass m, momentum p), the
 * normal part comes back with the other sign. Per step, with acceleration a and velocity v of the first inner node, the points gain
 * -2 [kick (f + m a) + (1 - flip)(p + m v)] more than the nodes did (the second term by the PIC blend alone). */
typedef struct mirror_sum {
    const double *mass, *force, *momentum, *acceleration;
    const block *b;
    double kick, pic, sum;
} mirror_sum;

static void add_mirror(void *user, ptrdiff_t at, ptrdiff_t inward, bool owned)
{
    mirror_sum *r = user;
    const ptrdiff_t ghost = at - inward, inner = at + inward;
    if (!owned) return;
    /* A ghost without mass may still have a surface's load. */
    const double v = r->mass[inner] > 0.0 ? r->momentum[inner] / r->mass[inner] : 0.0;
    r->sum -= 2.0 * (r->kick * (r->force[ghost] + r->mass[ghost] * r->acceleration[inner]) +
                     r->pic * (r->momentum[ghost] + r->mass[ghost] * v));
}

static double mirror_impulse(const mpm *s, int blk, int axis, int side, int group)
{
    const fields *f = s->domain->fields[blk];
    mirror_sum r = {.b = &s->mesh->block[blk], .kick = s->work->kick, .pic = 1.0 - s->scene->method.flip};
    r.mass = field_get(f, N_MASS, group, 0);
    r.force = field_get(f, N_FORCE, group, axis);
    r.momentum = field_get(f, N_MOMENTUM, group, axis);
    r.acceleration = field_get(f, N_ACCEL, group, axis);
    visit_side(r.b, axis, side, add_mirror, &r);
    return r.sum;
}

void enter_mirrors(mpm *s, int group)
{
    for (int b = 0; s->work->reach > 0 && b < s->mesh->n_blocks; ++b)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                if (s->mesh->block[b].at_side[axis][side] && !s->mesh->periodic[axis] && mirrors(s, axis, side))
                    ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + axis), LEDGER_BOUNDARY,
                               mirror_impulse(s, b, axis, side, group));
}

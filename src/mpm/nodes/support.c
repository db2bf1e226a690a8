/* Supports at the nodes: constrained ones have their velocity, led ones are linear between the surface and their masters (theory 4.13). What points give a led node
 * acts on its master by the same share, as the principle of virtual work has it. */
#include "mpm/motion/motion_ties.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/node_place.h"
#include "mpm/nodes/supports.h"

#include <math.h>

static double value_at(const mpm *s, node_place p, field_id field, int group, int c)
{
    return field_get(s->domain->fields[p.block], field, group, c)[p.at];
}

/* Replaces a value in all blocks that see the node, at periodic images too, or adds to it. */
static void put_value(mpm *s, const int node[MESH_MAX_DIM], field_id field, int group, int c, double value, bool add)
{
    const mesh *m = s->mesh;
    int images[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) images[a] = m->periodic[a] ? 1 : 0;
    for (int blk = 0; blk < m->n_blocks; ++blk)
        for (int z = -images[2]; z <= images[2]; ++z)
            for (int y = -images[1]; y <= images[1]; ++y)
                for (int x = -images[0]; x <= images[0]; ++x) {
                    ptrdiff_t at;
                    if (!find_node_in_block(m, &m->block[blk], node, (const int[]){x, y, z}, &at)) continue;
                    double *to = &field_get(s->domain->fields[blk], field, group, c)[at];
                    *to = add ? *to + value : value;
                }
}

/* ---- masses, momenta and forces ---- */

/* The share of a led node, less what is the support's own. */
static void fold_component(mpm *s, const support_node *n, field_id field, int group, int c, double own)
{
    const double value = value_at(s, owner_of_node(s->mesh, n->node), field, group, c);
    put_value(s, n->master, field, group, c, n->share * (value - own), true);
}

/* Momentum of a mass at a led node that does not depend on the master. */
static double own_momentum(const mpm *s, const support_node *n, double mass, int c)
{
    return mass * (1.0 - n->share) * support_velocity(s, n->support)[c];
}

void fold_supports(mpm *s, int group, bool momentum, bool force)
{
    if (!supports_lead_group(s, group)) return;
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        if (!n->led) continue;
        const double mass = value_at(s, owner_of_node(s->mesh, n->node), N_MASS, group, 0);
        for (int c = 0; c < s->mesh->dim; ++c) {
            if (momentum) fold_component(s, n, N_MOMENTUM, group, c, own_momentum(s, n, mass, c));
            if (force) fold_component(s, n, N_FORCE, group, c, 0.0);
        }
        if (momentum) put_value(s, n->master, N_MASS, group, 0, n->share * n->share * mass, true);
    }
}

void fold_supported_residuals(mpm *s, int group, bool velocities)
{
    if (!supports_lead_group(s, group)) return;
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        const double mass = velocities ? value_at(s, owner_of_node(s->mesh, n->node), N_MASS, group, 0) : 0.0;
        for (int c = 0; n->led && c < s->mesh->dim; ++c)
            fold_component(s, n, N_MOMENTUM, group, c, own_momentum(s, n, mass, c));
    }
}

/* ---- what supports hold ---- */

bool supported_nodes_push(const mpm *s, int group)
{
    return (s->contact || s->motions || s->scene->n_springs > 0) && s->scene->n_supports > 0 &&
           supports_lead_group(s, group) && s->supports->n > 0;
}

void keep_whole_masses(mpm *s, int group)
{
    for (size_t k = 0; k < s->supports->n; ++k) {
        support_node *n = &s->supports->node[k];
        const node_place own = owner_of_node(s->mesh, n->node);
        if (n->led) continue;
        n->whole[0] = value_at(s, own, N_MASS, group, 0);
        for (int c = 0; c < s->mesh->dim; ++c) n->whole[1 + c] = value_at(s, own, N_MOMENTUM, group, c);
    }
}

void put_whole_masses(mpm *s, int group)
{
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        if (n->led) continue;
        put_value(s, n->node, N_MASS, group, 0, n->whole[0], false);
        for (int c = 0; c < s->mesh->dim; ++c) put_value(s, n->node, N_MOMENTUM, group, c, n->whole[1 + c], false);
    }
}

/* ---- velocities ---- */

static double value_of(const mpm *s, const support_node *n, field_id field, int group, int c, bool change)
{
    const double v = change ? 0.0 : support_velocity(s, n->support)[c];
    return n->led ? v + n->share * (value_at(s, owner_of_node(s->mesh, n->master), field, group, c) - v) : v;
}

void push_support(const mpm *s, int support, const double x[MESH_MAX_DIM], int c, double impulse)
{
    const int body = s->supports->region[support].body;
    if (body >= 0) {
        double given[3] = {0.0};
        given[c] = -impulse;
        motion_pull_fixed(s, body, x, given, (const double[3]){0.0});
        return;
    }
    ledger_push(s->ledger, LEDGER_BOUNDARY, c, impulse, x);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, impulse * support_velocity(s, support)[c]);
}

static void push_at_node(mpm *s, const int node[MESH_MAX_DIM], int support, int c, double impulse)
{
    double x[MESH_MAX_DIM];
    place_of_node(s->mesh, node, x);
    push_support(s, support, x, c, impulse);
}

/* A share of the impulse that a support is about to give: the node's change, less what its master has of it. */
static void enter_impulse(mpm *s, const support_node *n, int group, int c, double change, double share)
{
    const double impulse = share * value_at(s, owner_of_node(s->mesh, n->node), N_MASS, group, 0) * change;
    push_at_node(s, n->node, n->support, c, impulse);
    if (n->led) push_at_node(s, n->master, n->support, c, -n->share * impulse);
}

static void hold_nodes(mpm *s, int group, field_id field, double entered, bool change)
{
    const bool leads = supports_lead_group(s, group);
    for (size_t k = 0; k < s->supports->n; ++k) {
        support_node own = s->supports->node[k];
        const support_node *n = &own;
        if (!support_constrains(s, leads, n)) continue;
        own.led = leads && own.led;
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double value = value_of(s, n, field, group, c, change);
            if (entered != 0.0)
                enter_impulse(s, n, group, c, value - value_at(s, owner_of_node(s->mesh, n->node), field, group, c),
                              entered);
            put_value(s, n->node, field, group, c, value, false);
        }
    }
}

void impose_supports(mpm *s, int group, field_id velocity, double entered)
{
    hold_nodes(s, group, velocity, entered, false);
}

void constrain_supports(mpm *s, int group, field_id change, double share)
{
    hold_nodes(s, group, change, share, true);
}

/* Damping took its share of what was given to the masters, too. */
void enter_support_damping(mpm *s, int group)
{
    const double taken = 1.0 - damping_left(s);
    if (!(taken > 0.0) || !supports_lead_group(s, group)) return;
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        for (int c = 0; n->led && c < s->mesh->dim; ++c)
            push_at_node(s, n->master, n->support, c,
                         n->share * taken * value_at(s, owner_of_node(s->mesh, n->node), N_MOMENTUM, group, c));
    }
}

void still_supports(mpm *s, int group)
{
    if (!supports_lead_group(s, group)) return;
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        for (int c = 0; n->led && c < s->mesh->dim; ++c) {
            const double a = value_of(s, n, N_ACCEL, group, c, true);
            enter_impulse(s, n, group, c, a - value_at(s, owner_of_node(s->mesh, n->node), N_ACCEL, group, c),
                          s->share * s->kick);
            put_value(s, n->node, N_ACCEL, group, c, a, false);
        }
    }
}

void follow_masters(mpm *s, int group)
{
    if (!supports_lead_group(s, group)) return;
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        for (int c = 0; n->led && c < s->mesh->dim; ++c) {
            const double before = value_at(s, owner_of_node(s->mesh, n->node), N_VEL_L, group, c);
            const double change = value_of(s, n, N_VEL_L, group, c, false) - before;
            enter_impulse(s, n, group, c, change, 1.0);
            put_value(s, n->node, N_VEL_L, group, c, change, true);
            put_value(s, n->node, N_ACCEL, group, c, change / s->kick, true);
        }
    }
}

/* How a place on a surface meets the nodes: its shares of a force or of heat, its motion, its temperature (theory 4.13). */
#include "mpm/surface/surface_place.h"

#include "math/linear_weights.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/supports.h"
#include "mpm/transfer/stencil.h"

#include <math.h>
#include <string.h>

/* One with this share moves a surface with all of its acceleration. */
static const double steady_mass = 0.1;

/* Mass at a node; at a ghost that of its image, so that a load by a wall is shared as its mirrored half is. */
static double mass_at(const mpm *s, const block *b, const double *mass, const int node[3])
{
    int at[3];
    for (int a = 0; a < 3; ++a) {
        at[a] = node[a];
        if (a >= s->mesh->dim || s->mesh->periodic[a]) continue;
        if (at[a] < 0) at[a] = -at[a];
        if (at[a] > s->mesh->n[a]) at[a] = 2 * s->mesh->n[a] - at[a];
    }
    return mass[mesh_index(b, at[0] - b->lo[0], at[1] - b->lo[1], at[2] - b->lo[2])];
}

static void relative_masses_of_nodes(const mpm *s, int group, const double x[3], place_stencil *st)
{
    const int blk = place_block(s, x);
    const double *mass = field_get(s->domain->fields[blk], N_MASS, group, 0);
    double heaviest = 0.0;
    for (int i = 0; i < st->n; ++i) {
        st->mass[i] = mass_at(s, &s->mesh->block[blk], mass, st->node[i]);
        heaviest = fmax(heaviest, st->mass[i]);
    }
    for (int i = 0; i < st->n; ++i) st->mass[i] = heaviest > 0.0 ? st->mass[i] / heaviest : 1.0;
}

/* Reduces the weights of nodes with less than the share `enough` of the heaviest mass. False: none has less, and nothing has changed. */
static bool bear_load(place_stencil *st, double enough)
{
    bool changed = false;
    for (int i = 0; i < st->n; ++i) {
        if (st->mass[i] >= enough) continue;
        st->w[i] *= st->mass[i] / enough;
        changed = true;
    }
    return changed;
}

/* Place of a node from the surface point in cells: row of the moments, 1 first. */
static void moment_row(const mpm *s, const double x[3], const int node[3], double row[4])
{
    row[0] = 1.0;
    for (int a = 0; a < s->mesh->dim; ++a) row[1 + a] = (mesh_node(s->mesh, a, node[a]) - x[a]) / s->mesh->h[a];
}

/* Weights times a linear factor, so that they sum to one and keep their centre at the surface point. False where the nodes
 * that are left cannot do it with shares within one: the weights are as they were. */
static bool keep_moments(const mpm *s, const double x[3], place_stencil *st)
{
    linear_weights linear = linear_weights_begin(s->mesh->dim);
    double row[STENCIL_NODES][LINEAR_TERMS], weight[STENCIL_NODES];
    for (int i = 0; i < st->n; ++i) {
        moment_row(s, x, st->node[i], row[i]);
        linear_weights_add(&linear, row[i], st->w[i]);
    }
    if (!linear_weights_solve(&linear)) return false;
    for (int i = 0; i < st->n; ++i) {
        weight[i] = linear_weights_take(&linear, row[i], st->w[i]);
        if (!(fabs(weight[i]) <= 1.0)) return false;
    }
    if (!linear_weights_hold(&linear)) return false;
    memcpy(st->w, weight, (size_t)st->n * sizeof *weight);
    return true;
}

static void keep_sum(place_stencil *st)
{
    double sum = 0.0;
    for (int i = 0; i < st->n; ++i) sum += st->w[i];
    for (int i = 0; i < st->n; ++i) st->w[i] /= sum;
}

/* Shares of a surface point's load. The basis alone would load nodes whose support contains the surface but hardly any
 * point: such a force is balanced only by the huge stress of the one point at the edge of the support (75 times the
 * stress there, measured on an annulus with 3 x 3 points a cell). So a node takes of the load as its mass allows, and
 * the others take the rest so that force and moment stay. Slopes that vanish with the weights, as CPDI's where a corner
 * of one domain reaches a node, need more mass. */
static place_stencil surface_locate(const mpm *s, int group, const double x[3])
{
    place_stencil st = stencil_at(s, x);
    relative_masses_of_nodes(s, group, x, &st);
    if (bear_load(&st, s->basis->fact.load_mass) && !keep_moments(s, x, &st)) keep_sum(&st);
    return st;
}

void add_surface_force(const mpm *s, int group, const double x[3], const double force[3])
{
    body_motion *motion = motion_of_group(s, group);
    if (motion) {
        motion_load(s, motion, x, force);
        return;
    }
    const place_stencil st = surface_locate(s, group, x);
    push_stencil(s, group, &st, force);
}

bool place_is_supported(const mpm *s, int group, const double x[3])
{
    return support_with_surface(s, group, x) >= 0;
}

void push_marker(const mpm *s, int group, const double x[3], const double force[3])
{
    const int support = support_with_surface(s, group, x);
    if (support < 0) {
        add_surface_force(s, group, x, force);
        return;
    }
    for (int a = 0; a < s->mesh->dim; ++a) push_support(s, support, x, a, -s->kick * force[a]);
}

/* Sums over the nodes of a place: of heat that is given, or of a temperature that is asked for. */
typedef struct surface_heat {
    double *change, given;
    const double *T, *capacity;
    double sum, weight;
} surface_heat;

static void give_node_heat(void *user, ptrdiff_t at, double weight, double mass)
{
    (void)mass;
    const surface_heat *f = user;
    f->change[at] += weight * f->given;
}

void add_surface_heat(const mpm *s, int group, const double x[3], double heat)
{
    const place_stencil st = surface_locate(s, group, x);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        surface_heat f = {.change = field_get(s->domain->fields[b], N_TEMP_CHANGE, group, 0), .given = heat};
        visit_stencil(&s->mesh->block[b], &st, give_node_heat, &f);
    }
}

static void ask_node_temperature(void *user, ptrdiff_t at, double weight, double mass)
{
    (void)mass;
    surface_heat *f = user;
    if (!(f->capacity[at] > 0.0)) return;
    f->sum += weight * f->T[at];
    f->weight += weight;
}

double surface_temperature(const mpm *s, int group, const double x[3])
{
    const place_stencil st = stencil_at(s, x);
    const int b = place_block(s, x);
    const fields *from = s->domain->fields[b];
    surface_heat f = {.T = field_get(from, N_TEMP, group, 0), .capacity = field_get(from, N_CAPACITY, group, 0)};
    visit_stencil(&s->mesh->block[b], &st, ask_node_temperature, &f);
    return f.weight > 0.0 ? f.sum / f.weight : (double)NAN;
}

typedef struct motion_sum {
    const double *v[3], *acceleration[3];
    surface_motion out;
    double kick, undamped; /* of damping: share that it leaves */
    bool follows;          /* light nodes, too: their neighbours hold them (implicit/implicit_walls.h) */
    int dim;
} motion_sum;

/* A light node's acceleration is large and moves hardly any point, even at rest (theory 4.4): a surface that followed it would
 * leave its body, so it takes that in proportion to the mass. */
static void add_motion(void *user, ptrdiff_t at, double weight, double mass)
{
    motion_sum *m = user;
    const double without = !m->follows && mass < steady_mass ? (1.0 - mass / steady_mass) * m->kick : 0.0;
    for (int a = 0; a < m->dim; ++a) {
        const double v = m->v[a][at], change = m->acceleration[a][at];
        m->out.velocity[a] += weight * (v - without * change);
        m->out.working[a] += weight * 0.5 * ((1.0 + m->undamped) * v - m->undamped * m->kick * change);
    }
}

surface_shares surface_shares_at(const mpm *s, int group, const double x[3])
{
    const place_stencil st = surface_locate(s, group, x);
    surface_shares out; /* most of it stays unused: it is not cleared */
    out.n = st.n;
    for (int i = 0; i < st.n; ++i) {
        memcpy(out.node[i], st.node[i], sizeof out.node[i]);
        out.w[i] = st.w[i];
        out.moved[i] = walls_are_stiff(s) ? 1.0 : fmin(st.mass[i] / steady_mass, 1.0);
    }
    return out;
}

/* Of a body that does not deform. */
static surface_motion rigid_surface_motion(const mpm *s, const body_motion *motion, const double x[3])
{
    surface_motion out;
    double next[3], path[3];
    motion_of_place(s, motion, x, next, out.after, path);
    for (int a = 0; a < 3; ++a) {
        out.displacement[a] = next[a] - x[a];
        out.velocity[a] = out.displacement[a] / s->dt;
        out.working[a] = path[a] / s->dt;
    }
    return out;
}

static surface_motion moved_with(const mpm *s, const double velocity[3])
{
    surface_motion out;
    for (int a = 0; a < 3; ++a) {
        out.velocity[a] = out.working[a] = out.after[a] = velocity[a];
        out.displacement[a] = s->dt * velocity[a];
    }
    return out;
}

surface_motion surface_motion_at(const mpm *s, int group, const double x[3])
{
    const body_motion *motion = motion_of_group(s, group);
    if (motion) return rigid_surface_motion(s, motion, x);
    const int support = support_with_surface(s, group, x);
    if (support >= 0) return moved_with(s, support_velocity(s, support));
    const int b = place_block(s, x);
    motion_sum m = {.dim = s->mesh->dim, .kick = s->kick, .undamped = damping_left(s), .follows = walls_are_stiff(s)};
    for (int a = 0; a < m.dim; ++a) {
        m.v[a] = field_get(s->domain->fields[b], N_VEL_L, group, a);
        m.acceleration[a] = field_get(s->domain->fields[b], N_ACCEL, group, a);
    }
    const place_stencil st = surface_locate(s, group, x);
    visit_stencil(&s->mesh->block[b], &st, add_motion, &m);
    for (int a = 0; a < 3; ++a) {
        m.out.displacement[a] = s->dt * m.out.velocity[a];
        m.out.after[a] = m.out.velocity[a];
    }
    return m.out;
}

void displace_position(const mpm *s, int group, const double x[3], node_displacement *displacement, double out[3])
{
    const place_stencil st = surface_locate(s, group, x);
    for (int i = 0; i < st.n; ++i)
        for (int a = 0; a < s->mesh->dim; ++a) out[a] += st.w[i] * displacement(s, group, st.node[i], a);
}

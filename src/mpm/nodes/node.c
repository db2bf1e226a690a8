/* Stages at the nodes between the two passes over the points. */
#include "mpm/nodes/node.h"

#include "grid/tile_box.h"
#include "mpm/contact/contact.h"
#include "mpm/edge/edge.h"
#include "mpm/implicit/implicit_walls.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"
#include "mpm/nodes/wall.h"
#include "mpm/transfer/scratch.h"

#include <math.h>

/* Nodes with less mass (kg) take no force: f/m there is noise (theory 4.4). Cubic splines end as x^3/6 and their slopes
 * as x^2/2, so that what a node that light does to its points falls with x; but as far out as 1e-9 of a point's weight
 * the impulse is 2e-6 of a whole one, and blocks that slid along walls were off by 1e-9 for it. What is left there is
 * the round-off of folded masses. */
double small_node(const mpm *s)
{
    return s->basis->fact.least_mass * s->reference_mass;
}

/* Linear index range that covers the nodes of a block and one ghost layer: a whole-array loop is simplest and vectorises. */
static size_t node_count(const mpm *s, int blk)
{
    return s->mesh->block[blk].size;
}

static void divide_block(const mpm *s, int blk, int group, field_id out)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict mass = field_get(f, N_MASS, group, 0);
    const size_t n = node_count(s, blk);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double *restrict momentum = field_get(f, N_MOMENTUM, group, c);
        double *restrict v = field_get(f, out, group, c);
#pragma omp parallel for simd schedule(static)
        for (size_t k = 0; k < n; ++k) v[k] = mass[k] > 0.0 ? momentum[k] / mass[k] : 0.0;
    }
}

void divide_momenta(mpm *s, int group, field_id out)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) divide_block(s, b, group, out);
}

floe_status mpm_node_velocity(mpm *s)
{
    const bool first = s->scene->method.stress == STRESS_USF;
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        divide_momenta(s, g, N_VEL);
        impose_walls(s, g, N_VEL, 0.0);
    }
    motions_impose(s, N_VEL, first);
    if (s->contact) contact_velocities(s, first ? CONTACT_FORESEE : CONTACT_REPEAT);
    motions_impose_tied(s, N_VEL, first);
    for (int g = 0; g < s->n_groups; ++g) extend_to_ghosts(s, g, N_VEL);
    return FLOE_OK;
}

static bool damping_acts(const mpm *s)
{
    const scene_damping *d = &s->scene->damping;
    return d->rate > 0.0 && s->time >= d->start && s->time < d->end;
}

double damping_left(const mpm *s)
{
    return damping_acts(s) ? 1.0 / (1.0 + s->scene->damping.rate * s->kick) : 1.0;
}

/* v^L = v / (1 + rate kick) + kick f/m, from momenta (theory 4.4). Damping acts on the velocity that the points brought, never
 * on what the force adds: beside fluids, f alone is not small at rest (the exchange balances it), and damping it would take a
 * share rate dt of the load away (measured: sigma_theta of the pressurised cylinder off by 3 % at dt = 2.6 us). */
static void advance_block(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict mass = field_get(f, N_MASS, group, 0);
    const double kick = s->kick, floor = small_node(s), undamped = damping_left(s);
    const size_t n = node_count(s, blk);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double *restrict momentum = field_get(f, N_MOMENTUM, group, c);
        const double *restrict force = field_get(f, N_FORCE, group, c);
        double *restrict v = field_get(f, N_VEL_L, group, c);
#pragma omp parallel for simd schedule(static)
        for (size_t k = 0; k < n; ++k) {
            const double impulse = mass[k] > floor ? kick * force[k] : 0.0;
            v[k] = mass[k] > 0.0 ? (undamped * momentum[k] + impulse) / mass[k] : 0.0;
        }
    }
}

enum {
    SUM_DAMPED_MOMENTUM = 0,
    SUM_DAMPED_MOMENT = 3,
    SUM_DAMPED_ENERGY = 6,
    SUM_LOST = 7,
    SUM_LOST_MOMENT = 10,
    SUM_SMALL = 13,
    SUM_COUNT = 14
};

/* Sums of a group at the nodes of a block, for loops that look at all of them. */
typedef struct node_view {
    const double *mass, *momentum[MESH_MAX_DIM], *force[MESH_MAX_DIM];
} node_view;

static node_view view_nodes(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    node_view n = {.mass = field_get(f, N_MASS, group, 0)};
    for (int c = 0; c < s->mesh->dim; ++c) {
        n.momentum[c] = field_get(f, N_MOMENTUM, group, c);
        n.force[c] = field_get(f, N_FORCE, group, c);
    }
    return n;
}

static void add_damped(const mesh *m, const node_view *n, const int node[MESH_MAX_DIM], ptrdiff_t at, double taken,
                       double *sum)
{
    double x[MESH_MAX_DIM];
    place_of_node(m, node, x);
    for (int c = 0; c < m->dim; ++c) {
        const double momentum = n->momentum[c][at], lost = taken * momentum;
        sum[SUM_DAMPED_MOMENTUM + c] -= lost;
        add_moment(sum + SUM_DAMPED_MOMENT, x, c, -lost);
        if (n->mass[at] > 0.0) sum[SUM_DAMPED_ENERGY] -= 0.5 * lost * (2.0 * momentum - lost) / n->mass[at];
    }
}

/* Most nodes that are dropped have no force. */
static void add_lost(const mpm *s, const node_view *n, const int node[MESH_MAX_DIM], ptrdiff_t at, double *sum)
{
    for (int c = 0; c < s->mesh->dim; ++c) {
        double x[MESH_MAX_DIM];
        if (n->force[c][at] == 0.0) continue;
        place_of_node(s->mesh, node, x);
        sum[SUM_LOST + c] += s->kick * n->force[c][at];
        add_moment(sum + SUM_LOST_MOMENT, x, c, s->kick * n->force[c][at]);
    }
}

/* What damping took and what the small-node rule dropped, on the nodes of one tile. */
static void tile_losses(const mpm *s, int blk, int tile, int group)
{
    const block *b = &s->mesh->block[blk];
    const tile_box t = tile_box_of(s->mesh, b, tile);
    const node_view n = view_nodes(s, blk, group);
    const double floor = small_node(s), taken = 1.0 - damping_left(s);
    double *sum = s->scratch->tile_sum + (size_t)t.number * SUM_COUNT;
    int end[MESH_MAX_DIM];
    tile_nodes(s->mesh, &t, end);
    for (int c = 0; c < SUM_COUNT; ++c) sum[c] = 0.0;
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i) {
                const ptrdiff_t at =
                    mesh_index(b, t.first[0] - b->lo[0] + i, t.first[1] - b->lo[1] + j, t.first[2] - b->lo[2] + k);
                const int node[MESH_MAX_DIM] = {t.first[0] + i, t.first[1] + j, t.first[2] + k};
                if (taken > 0.0) add_damped(s->mesh, &n, node, at, taken, sum);
                if (n.mass[at] > floor) continue;
                add_lost(s, &n, node, at, sum);
                if (n.mass[at] > 0.0) sum[SUM_SMALL] += 1.0;
            }
}

static void enter_losses(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 8)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) tile_losses(s, b, t, group);
    }
    double sum[SUM_COUNT];
    domain_sum_tiles(s->mesh, s->scratch->tile_sum, SUM_COUNT, sum);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const ledger_quantity q = (ledger_quantity)(LEDGER_MOMENTUM_X + c);
        ledger_add(s->ledger, q, LEDGER_DAMPING, sum[SUM_DAMPED_MOMENTUM + c]);
        ledger_add(s->ledger, q, LEDGER_DEFECT, -sum[SUM_LOST + c]);
    }
    ledger_turn(s->ledger, LEDGER_DAMPING, sum + SUM_DAMPED_MOMENT, 1.0);
    ledger_turn(s->ledger, LEDGER_DEFECT, sum + SUM_LOST_MOMENT, -1.0);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, sum[SUM_DAMPED_ENERGY]);
    ledger_tally(s->ledger, COUNT_SMALL_NODES, (long long)sum[SUM_SMALL]);
}

floe_status mpm_node_update(mpm *s)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        if (walls_let_go(s)) push_off_sides(s, g);
        for (int b = 0; b < s->mesh->n_blocks; ++b) advance_block(s, b, g);
        enter_losses(s, g);
        enter_support_damping(s, g);
        impose_walls(s, g, N_VEL_L, 1.0);
    }
    motions_predict(s);
    return FLOE_OK;
}

/* a = (v^L - v) / kick: whatever changed the nodes, the exchange included, reaches the points as one acceleration. */
static void accelerate_block(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict mass = field_get(f, N_MASS, group, 0);
    const double inv_kick = 1.0 / s->kick;
    const size_t n = node_count(s, blk);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double *restrict momentum = field_get(f, N_MOMENTUM, group, c);
        const double *restrict v = field_get(f, N_VEL_L, group, c);
        double *restrict a = field_get(f, N_ACCEL, group, c);
#pragma omp parallel for simd schedule(static)
        for (size_t k = 0; k < n; ++k) a[k] = mass[k] > 0.0 ? (v[k] - momentum[k] / mass[k]) * inv_kick : 0.0;
    }
}

floe_status mpm_node_acceleration(mpm *s)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        impose_walls(s, g, N_VEL_L, 1.0); /* again: the exchange with the cells may have moved them */
        for (int b = 0; b < s->mesh->n_blocks; ++b) accelerate_block(s, b, g);
        still_walls(s, g);
        still_supports(s, g);
        if (walls_are_stiff(s)) stiff_lightest(s, g);
        if (s->edges) TRY(edges_accelerate(s, g));
        follow_masters(s, g);
        if (s->edges && s->scene->method.stress == STRESS_USL && !s->transfer->restore)
            TRY(edges_strain(s, g, N_VEL_L));
        enter_mirrors(s, g);
        extend_to_ghosts(s, g, N_VEL_L);
        extend_to_ghosts(s, g, N_ACCEL);
    }
    motions_still(s, N_ACCEL);
    return FLOE_OK;
}

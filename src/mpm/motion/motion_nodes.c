/* Nodes of bodies that do not deform. Others change the velocities of these nodes, as of any body; here the impulses are summed, and the nodes get the rigid
 * velocity field again. */
#include "mpm/motion/motion.h"

#include "grid/tile_box.h"
#include "mpm/fluid/wetted.h"
#include "mpm/motion/motion_parts.h"
#include "mpm/motion/motion_ties.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/support_beyond.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

void motion_visit_nodes(mpm *s, motion_node_visitor *visit, void *user)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
        const block *b = &s->mesh->block[blk];
        int lo[3] = {0, 0, 0}, end[3] = {1, 1, 1};
        for (int a = 0; a < s->mesh->dim; ++a) {
            lo[a] = -MESH_GHOST;
            end[a] = b->n[a] + MESH_GHOST;
        }
        for (int k = lo[2]; k < end[2]; ++k)
            for (int j = lo[1]; j < end[1]; ++j)
                for (int i = lo[0]; i < end[0]; ++i) {
                    const int node[3] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
                    double x[3];
                    place_of_node(s->mesh, node, x);
                    visit(s, blk, mesh_index(b, i, j, k), x, user);
                }
    }
}

void rigid_at(const mpm *s, const body_motion *m, const imposed *what, const double x[3], double v[3])
{
    rigid_velocity(what->now ? &m->now : &m->next, x, v);
    for (int a = 0; a < 3; ++a)
        if (what->zero || (s->mesh->geometry == MESH_AXISYMMETRIC && a == 0)) v[a] = 0.0;
}

static void impose_motion_node(mpm *s, int blk, ptrdiff_t at, const double x[3], void *user)
{
    const imposed *what = user;
    const fields *f = s->domain->fields[blk];
    for (int g = s->n_deforming_groups; g < s->n_groups; ++g) {
        const double mass = field_get(f, N_MASS, g, 0)[at];
        double v[3] = {0.0};
        if (mass > 0.0) rigid_at(s, motion_of_group(s, g), what, x, v);
        for (int a = 0; a < s->mesh->dim; ++a)
            field_get(f, what->field, g, a)[at] = what->field == N_MOMENTUM ? mass * v[a] : v[a];
    }
}

void motions_impose(mpm *s, field_id field, bool now)
{
    if (s->motions) motion_visit_nodes(s, impose_motion_node, &(imposed){field, now, false});
}

/* The node of a place that is one. */
static void node_at(const mpm *s, const double x[3], int node[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        node[a] = a < s->mesh->dim ? (int)lround((x[a] - s->mesh->lower[a]) / s->mesh->h[a]) : 0;
}

/* ---- bodies that stick to it ---- */

/* The group with a motion to which others stick at a node: that of the largest mass there; -1: there is none. */
int leader_at(const mpm *s, const fields *f, ptrdiff_t at)
{
    return heaviest_group(s, f, at, s->n_deforming_groups, -1);
}

/* Contact, cells and walls of fluid points have rules of their own. */
bool sticks_to_motions(const mpm *s, int group)
{
    return !s->contact && s->cells != CELLS_SMEARED && (!s->wetted || group != wetted_fluid(s));
}

/* Without a contact others have the velocity of the body wherever both reach a node; what they lose is a change of the body's nodes. */
static void tie_node(mpm *s, int blk, ptrdiff_t at, const double x[3], void *user)
{
    const imposed *what = user;
    const fields *f = s->domain->fields[blk];
    const int leader = leader_at(s, f, at);
    double v[3];
    if (leader < 0) return;
    rigid_at(s, motion_of_group(s, leader), what, x, v);
    const double mass = field_get(f, N_MASS, leader, 0)[at];
    int node[MESH_MAX_DIM];
    node_at(s, x, node);
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        const double other = field_get(f, N_MASS, g, 0)[at];
        if (!(other > 0.0) || !sticks_to_motions(s, g) || clear_of_bodies(s, g, node)) continue;
        for (int a = 0; a < s->mesh->dim; ++a) {
            double *own = field_get(f, what->field, g, a), *body = field_get(f, what->field, leader, a);
            body[at] += other / mass * (own[at] - v[a]);
            own[at] = v[a];
        }
    }
}

void motions_visit_ties(const mpm *s, tie_visitor *visit, void *user)
{
    const mesh *m = s->mesh;
    for (int blk = 0; s->motions && blk < m->n_blocks; ++blk) {
        const block *b = &m->block[blk];
        int end[MESH_MAX_DIM] = {1, 1, 1};
        for (int a = 0; a < m->dim; ++a) end[a] = b->n[a] + (b->at_side[a][SIDE_UPPER] && !m->periodic[a] ? 1 : 0);
        for (int k = 0; k < end[2]; ++k)
            for (int j = 0; j < end[1]; ++j)
                for (int i = 0; i < end[0]; ++i) {
                    const int node[MESH_MAX_DIM] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
                    const int leader = leader_at(s, s->domain->fields[blk], mesh_index(b, i, j, k));
                    double x[3], v[3];
                    if (leader < 0 || clear_of_bodies(s, 0, node)) continue;
                    place_of_node(m, node, x);
                    rigid_at(s, motion_of_group(s, leader), &(imposed){N_VEL_L, false, false}, x, v);
                    for (int c = 0; c < m->dim; ++c) visit(user, node, c, v[c]);
                }
    }
}

/* ---- sums ---- */

enum { SUM_IMPULSE, SUM_MOMENT = 3, SUM_WORK = 6, SUM_END = 7 };

typedef struct taken {
    int group;
    imposed what;
} taken;

typedef struct owned_visit {
    motion_node_adder *visit;
    const void *user;
} owned_visit;

static void visit_owned_nodes(mpm *s, int blk, int tile, void *user, double *sum)
{
    const owned_visit *v = user;
    const block *b = &s->mesh->block[blk];
    const tile_box t = tile_box_of(s->mesh, b, tile);
    int end[MESH_MAX_DIM];
    tile_nodes(s->mesh, &t, end);
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i) {
                const int node[3] = {t.first[0] + i, t.first[1] + j, t.first[2] + k};
                double x[3];
                place_of_node(s->mesh, node, x);
                v->visit(s, blk, mesh_index(b, node[0] - b->lo[0], node[1] - b->lo[1], node[2] - b->lo[2]), x, v->user,
                         sum);
            }
}

void motion_sum_nodes(mpm *s, motion_node_adder *visit, const void *user, int count, double *sum)
{
    owned_visit v = {visit, user};
    sum_over_tiles(s, count, visit_owned_nodes, &v, sum);
}

static void take_node(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum)
{
    const taken *t = user;
    const fields *f = s->domain->fields[blk];
    const body_motion *m = motion_of_group(s, t->group);
    const double mass = field_get(f, N_MASS, t->group, 0)[at];
    double v[3], u[3], impulse[3] = {0.0};
    if (!(mass > 0.0)) return;
    rigid_at(s, m, &t->what, x, v);
    rigid_velocity(&m->next, x, u);
    for (int a = 0; a < s->mesh->dim; ++a) {
        impulse[a] = mass * (field_get(f, t->what.field, t->group, a)[at] - v[a]);
        sum[SUM_IMPULSE + a] += impulse[a];
        sum[SUM_WORK] += impulse[a] * u[a];
    }
    rigid_add_moment(m, x, impulse, sum + SUM_MOMENT);
}

static void take_impulses(mpm *s, imposed what, double share, motion_giver giver)
{
    for (int g = s->n_deforming_groups; g < s->n_groups; ++g) {
        double sum[SUM_END], impulse[3], moment[3];
        const taken t = {g, what};
        motion_sum_nodes(s, take_node, &t, SUM_END, sum);
        for (int a = 0; a < 3; ++a) {
            impulse[a] = share * sum[SUM_IMPULSE + a];
            moment[a] = share * sum[SUM_MOMENT + a];
        }
        motion_give(s, motion_of_group(s, g), impulse, moment, share * sum[SUM_WORK], giver);
    }
    motion_visit_nodes(s, impose_motion_node, &what);
}

/* What ties give others: impulses times the mean velocities before and after. */
static void gain_node(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const int leader = leader_at(s, f, at);
    double v[3];
    if (leader < 0) return;
    rigid_at(s, motion_of_group(s, leader), user, x, v);
    int node[MESH_MAX_DIM];
    node_at(s, x, node);
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        const double mass = field_get(f, N_MASS, g, 0)[at];
        if (!(mass > 0.0) || !sticks_to_motions(s, g) || clear_of_bodies(s, g, node)) continue;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double before = field_get(f, N_MOMENTUM, g, a)[at] / mass;
            *sum += 0.5 * mass * (v[a] - field_get(f, N_VEL_L, g, a)[at]) * (before + v[a]);
        }
    }
}

static void enter_ties(mpm *s)
{
    const imposed what = {N_VEL_L, false, false};
    double sum;
    motion_sum_nodes(s, gain_node, &what, 1, &sum);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_CONTACT, sum);
}

/* ---- bodies that meet ---- */

/* Of a node's volume: both bodies fill that much where they are half a cell apart. */
static const double meeting_fill = 0.25;

static bool fills(const mpm *s, const fields *f, int group, ptrdiff_t at, const int node[MESH_MAX_DIM])
{
    const int body = motion_of_group(s, group)->body;
    const double density = s->scene->material[s->body[body].scene_material].density;
    return field_get(f, N_MASS, group, 0)[at] > meeting_fill * density * node_volume(s, group, node);
}

/* Pairs of which one is free. */
static void find_meeting(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum)
{
    const fields *f = s->domain->fields[blk];
    int node[MESH_MAX_DIM];
    (void)user;
    node_at(s, x, node);
    for (int g = s->n_deforming_groups; g < s->n_groups; ++g)
        for (int other = s->n_deforming_groups; other < g; ++other) {
            if (motion_prescribes_group(s, g) && motion_prescribes_group(s, other)) continue;
            if (!(field_get(f, N_MASS, g, 0)[at] > 0.0) || !(field_get(f, N_MASS, other, 0)[at] > 0.0)) continue;
            if (!fills(s, f, g, at, node) || !fills(s, f, other, at, node)) continue;
            sum[0] += 1.0;
            sum[1] += (double)(g * MPM_MAX_GROUPS + other);
        }
}

/* Rigid bodies have no stress by which a contact between them would be known. */
static floe_status refuse_meeting(mpm *s)
{
    double sum[2];
    motion_sum_nodes(s, find_meeting, NULL, 2, sum);
    if (sum[0] == 0.0) return FLOE_OK;
    const int pair = (int)(sum[1] / sum[0]), g = pair / MPM_MAX_GROUPS, other = pair % MPM_MAX_GROUPS;
    const scene_body *of = s->scene->body;
    return fail(
        s->ctx, FLOE_DIVERGED,
        "at t = %.6g%s bodies '%s' and '%s' meet, of which neither deforms: no force between them is known; let "
        "one of them deform, or end sooner",
        s->time, scene_time_unit(s->scene), of[s->body[motion_of_group(s, g)->body].scene_body].name,
        of[s->body[motion_of_group(s, other)->body].scene_body].name);
}

/* ---- stages ---- */

floe_status mpm_take_impulses(mpm *s)
{
    take_impulses(s, (imposed){N_VEL_L, false, false}, 1.0, MOTION_BY_FLUID);
    return FLOE_OK;
}

floe_status mpm_join_motions(mpm *s)
{
    imposed what = {N_VEL_L, false, false};
    if (s->motions->n > 1) TRY(refuse_meeting(s));
    if (s->contact) share_contacts(s);
    take_impulses(s, what, 1.0, MOTION_BY_CONTACT);
    join_free_bodies(s);
    motion_visit_nodes(s, impose_motion_node, &what);
    enter_ties(s);
    motion_visit_nodes(s, tie_node, &what);
    take_impulses(s, what, 1.0, MOTION_BY_CONTACT);
    return FLOE_OK;
}

void motions_impose_tied(mpm *s, field_id velocity, bool now)
{
    imposed what = {velocity, now, false};
    if (!s->motions) return;
    motion_visit_nodes(s, impose_motion_node, &what);
    motion_visit_nodes(s, tie_node, &what);
    motion_visit_nodes(s, impose_motion_node, &what);
}

void motions_still(mpm *s, field_id change)
{
    if (s->motions) motion_visit_nodes(s, impose_motion_node, &(imposed){change, false, true});
}

void motions_constrain(mpm *s, field_id change, double share)
{
    imposed what = {change, false, true};
    if (!s->motions) return;
    motion_visit_nodes(s, tie_node, &what);
    take_impulses(s, what, share, MOTION_BY_CONTACT);
}

/* Contact at one node: which pairs of bodies touch, and what impulses they exchange. */

#include "math/tensor.h"
#include "mpm/contact/contact.h"
#include "mpm/mpm_constants.h"

#include <math.h>
#include <string.h>

enum { MAX_SWEEPS = 64 };

/* The constraint of a pair. */
typedef enum bond {
    BOND_ALL,    /* no relative motion */
    BOND_NORMAL, /* none along the normal */
    BOND_PUSH    /* none into each other; along the surface up to the friction limit */
} bond;

typedef struct pair {
    int a, b;
    double n[3]; /* unit normal from a to b */
    double mass; /* kg: m_a m_b / (m_a + m_b) */
    bond bond;
    double normal_impulse;        /* kg m/s: impulse along n from a to b */
    double tangential_impulse[3]; /* kg m/s: tangential impulse; all of it where bond is BOND_ALL */
} pair;

/* Unit vector along x without its constrained components; zero where there is none. */
static void unit_vector(const contact_node *node, const double x[3], double out[3])
{
    for (int c = 0; c < 3; ++c) out[c] = node->constrained[c] ? 0.0 : x[c];
    const double length = vec_norm(out);
    for (int c = 0; c < 3; ++c) out[c] = length > 0.0 ? out[c] / length : 0.0;
}

/* The heaviest body of a node with a motion of its own; NULL: there is none. */
static const contact_body *given_body(const contact_node *node)
{
    const contact_body *found = NULL;
    for (int k = 0; k < node->n; ++k)
        if (node->body[k].given && (!found || node->body[k].mass > found->mass)) found = &node->body[k];
    return found;
}

/* Velocities of the centre of mass, before and after the forces. */
typedef struct common {
    double v0[3], v[3];
} common;

static common mean_velocity(const contact_node *node)
{
    double mass = 0.0;
    common mean = {{0.0}, {0.0}};
    const contact_body *leader = given_body(node);
    if (leader) {
        memcpy(mean.v0, leader->v0, sizeof mean.v0);
        memcpy(mean.v, leader->v, sizeof mean.v);
        return mean;
    }
    for (int k = 0; k < node->n; ++k) {
        mass += node->body[k].mass;
        for (int c = 0; c < 3; ++c) {
            mean.v0[c] += node->body[k].mass * node->body[k].v0[c];
            mean.v[c] += node->body[k].mass * node->body[k].v[c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        mean.v0[c] /= mass;
        mean.v[c] /= mass;
    }
    return mean;
}

/* (v - mean) . n > 0: the body moves into the others (Y97 eq. 9.8). */
static bool moves_in(const contact_body *b, const double mean[3], const double n[3])
{
    const double relative[3] = {b->v[0] - mean[0], b->v[1] - mean[1], b->v[2] - mean[2]};
    return vec_dot(relative, n) > 0.0;
}

static bool bodies_approach(const scene_contact *rule, const contact_node *node, const pair *p, const double mean[3])
{
    const contact_body *a = &node->body[p->a], *b = &node->body[p->b];
    double own_a[3], own_b[3];
    if (vec_dot(p->n, p->n) == 0.0) return true; /* no normal: nothing says that they part */
    switch (rule->criterion) {
    case CONTACT_MEAN: return moves_in(a, mean, p->n);
    case CONTACT_BOTH:
        unit_vector(node, a->normal, own_a);
        unit_vector(node, b->normal, own_b);
        return moves_in(a, mean, own_a) || moves_in(b, mean, own_b);
    default: return moves_in(a, b->v, p->n); /* Y97 eq. 9.7 */
    }
}

/* Unit normal from a to b. */
static void pair_normal(const contact_node *node, int a, int b, double out[3])
{
    const contact_body *A = &node->body[a], *B = &node->body[b];
    const double n[3] = {A->normal[0] - B->normal[0], A->normal[1] - B->normal[1], A->normal[2] - B->normal[2]};
    unit_vector(node, n, out);
}

static pair make_pair(const contact_node *node, int a, int b, bond kind)
{
    const contact_body *A = &node->body[a], *B = &node->body[b];
    pair p = {.a = a, .b = b, .mass = A->mass * B->mass / (A->mass + B->mass), .bond = kind};
    if (A->given != B->given) p.mass = A->given ? B->mass : A->mass;
    pair_normal(node, a, b, p.n);
    return p;
}

/* Whether a pair interacts of which one body is outside the contact. */
static bool sticks_outside(const contact_node *node, int a, int b)
{
    if (node->apart) return false;
    if (!node->fluids || (!node->body[a].named && !node->body[b].named)) return true;
    const int named = node->body[a].named ? a : b;
    for (int k = 0; k < node->n; ++k)
        if (node->body[k].named && node->body[k].rank < node->body[named].rank) return false;
    return true;
}

/* Whether a body with a motion of its own is not felt at a node more than half a cell outside it. It has infinite inertia where it has hardly any mass, and
 * would hold the other body along its surface up to one and a half cells above it, which brakes what rolls there. Without friction nothing is constrained along it. */
static bool is_beyond_hold(const scene_contact *rule, const contact_node *node, int k)
{
    const bool holds_along = rule->kind != CONTACT_FRICTION || rule->friction > 0.0;
    return holds_along && node->body[k].given && node->body[k].reach < -MPM_HELD_NODE * node->h;
}

/* The surfaces of those of the contact are each at its farthest point along the normal. */
int contact_find_meetings(const scene_contact *rule, const contact_node *node, contact_meeting *list)
{
    int n = 0;
    for (int a = 0; a < node->n; ++a)
        for (int b = a + 1; b < node->n; ++b) {
            if (node->body[a].given && node->body[b].given) continue;
            contact_meeting m = {.a = a, .b = b, .named = node->body[a].named && node->body[b].named};
            if (!m.named && !sticks_outside(node, a, b)) continue;
            if (m.named && rule->touch == CONTACT_AT_POINTS) {
                if (is_beyond_hold(rule, node, a) || is_beyond_hold(rule, node, b)) continue;
                m.gap = -(node->body[a].reach + node->body[b].reach);
            }
            pair_normal(node, a, b, m.n);
            list[n++] = m;
        }
    return n;
}

bool contact_has_met(const contact_node *node, const contact_meeting *m)
{
    return m->gap <= MPM_CLOSED_GAP * node->h;
}

/* Bodies that stick go on sticking where a pull opens the gap between their points a little. */
static bool holds(const scene_contact *rule, const contact_node *node, const contact_meeting *m)
{
    return m->named && rule->kind == CONTACT_STICK && m->gap <= MPM_TIED_GAP * node->h;
}

/* Pairs that are in contact now. */
static int find_pairs(const scene_contact *rule, const contact_node *node, pair *list)
{
    contact_meeting meeting[CONTACT_MAX_PAIRS];
    const int meetings = contact_find_meetings(rule, node, meeting);
    int n = 0;
    const common mean = mean_velocity(node);
    for (int k = 0; k < meetings; ++k) {
        const contact_meeting *m = &meeting[k];
        const bool ruled = m->named && rule->kind != CONTACT_STICK;
        if (!contact_has_met(node, m) && !holds(rule, node, m)) continue;
        const pair p = make_pair(node, m->a, m->b, ruled && rule->kind == CONTACT_FRICTION ? BOND_PUSH : BOND_ALL);
        if (!ruled || bodies_approach(rule, node, &p, mean.v)) list[n++] = p;
    }
    return n;
}

/* Bodies that pairs join with one that has a motion of its own take its velocity, as at a support. */
static void follow_given(contact_node *node, const int cluster[MPM_MAX_GROUPS], int first, const double v[3])
{
    contact_body *leader = NULL;
    for (int k = 0; k < node->n; ++k)
        if (cluster[k] == first && node->body[k].given && (!leader || node->body[k].mass > leader->mass))
            leader = &node->body[k];
    for (int k = 0; k < node->n; ++k) {
        contact_body *b = &node->body[k];
        if (cluster[k] != first || b->given || !leader) continue;
        for (int c = 0; c < 3; ++c) {
            leader->taken[c] += b->mass * (b->v[c] - v[c]);
            b->v[c] = v[c];
        }
    }
}

/* Bodies that pairs join, directly or through others, move in the field of their common centre of mass (Y97 eqs 9.1 to
 * 9.3): they take its velocity, before the kick too, so that points receive the acceleration of that field and keep
 * their own difference from it, as points of one body do. */
static void join_bonded(contact_node *node, const pair *list, int n)
{
    int cluster[MPM_MAX_GROUPS];
    for (int k = 0; k < node->n; ++k) cluster[k] = k;
    for (int p = 0; p < n; ++p) {
        const int from = cluster[list[p].b], to = cluster[list[p].a];
        for (int k = 0; k < node->n; ++k)
            if (cluster[k] == from) cluster[k] = to;
    }
    for (int first = 0; first < node->n; ++first) {
        contact_node part = {.n = 0};
        for (int k = 0; k < node->n; ++k)
            if (cluster[k] == first) part.body[part.n++] = node->body[k];
        if (part.n < 2) continue;
        const common mean = mean_velocity(&part);
        if (given_body(&part)) {
            follow_given(node, cluster, first, mean.v);
            continue;
        }
        for (int k = 0; k < node->n; ++k) {
            if (cluster[k] != first) continue;
            memcpy(node->body[k].v0, mean.v0, sizeof mean.v0);
            memcpy(node->body[k].v, mean.v, sizeof mean.v);
        }
    }
}

/* a loses the impulse, b gains it. */
static void exchange_contact_impulse(contact_node *node, const pair *p, const double impulse[3])
{
    contact_body *a = &node->body[p->a], *b = &node->body[p->b];
    for (int c = 0; c < 3; ++c) {
        if (a->given)
            a->taken[c] -= impulse[c];
        else
            a->v[c] -= impulse[c] / a->mass;
        if (b->given)
            b->taken[c] += impulse[c];
        else
            b->v[c] += impulse[c] / b->mass;
    }
}

/* Removes the relative velocity of one pair that its bond does not allow; returns the size of the change. */
static double relax_pair(contact_node *node, pair *p, double friction)
{
    const contact_body *a = &node->body[p->a], *b = &node->body[p->b];
    double wanted[3], impulse[3], tangential_impulse[3];
    for (int c = 0; c < 3; ++c) wanted[c] = p->mass * (a->v[c] - b->v[c]);
    const double along = p->bond == BOND_ALL ? 0.0 : vec_dot(wanted, p->n);
    const double normal_impulse =
        p->bond == BOND_PUSH ? fmax(0.0, p->normal_impulse + along) : p->normal_impulse + along;
    for (int c = 0; c < 3; ++c) tangential_impulse[c] = p->tangential_impulse[c] + wanted[c] - along * p->n[c];
    const double size = vec_norm(tangential_impulse), most = friction * normal_impulse;
    const double kept = p->bond == BOND_ALL ? 1.0 : p->bond == BOND_NORMAL ? 0.0 : size <= most ? 1.0 : most / size;
    for (int c = 0; c < 3; ++c) {
        impulse[c] =
            kept * tangential_impulse[c] - p->tangential_impulse[c] + (normal_impulse - p->normal_impulse) * p->n[c];
        p->tangential_impulse[c] = kept * tangential_impulse[c];
    }
    p->normal_impulse = normal_impulse;
    exchange_contact_impulse(node, p, impulse);
    return vec_norm(impulse);
}

/* Two bodies need one sweep; more bodies need sweeps until the impulses converge. Every sweep conserves momentum. */
static void relax_all(contact_node *node, pair *list, int n, double friction)
{
    for (int sweep = 0; sweep < MAX_SWEEPS; ++sweep) {
        double change = 0.0, total = 0.0;
        for (int k = 0; k < n; ++k) {
            change += relax_pair(node, &list[k], friction);
            total += fabs(list[k].normal_impulse) + vec_norm(list[k].tangential_impulse);
        }
        if (node->n == 2 || change <= 1e-14 * total) return;
    }
}

static contact_state state_of(const pair *p, double friction)
{
    if (p->bond != BOND_PUSH) return CONTACT_STICKS;
    if (p->normal_impulse == 0.0) return CONTACT_FREE;
    return vec_norm(p->tangential_impulse) < (1.0 - 1e-12) * friction * p->normal_impulse ? CONTACT_STICKS
                                                                                          : CONTACT_SLIDES;
}

static contact_tally set_states(const scene_contact *rule, contact_node *node, const pair *list, int n)
{
    contact_tally t = {.release = node->n * (node->n - 1) / 2};
    for (int k = 0; k < n; ++k) {
        const contact_state state = state_of(&list[k], rule->friction);
        node->state[list[k].a][list[k].b] = state;
        if (state == CONTACT_FREE) continue;
        t.release--;
        t.stick += state == CONTACT_STICKS;
        t.slip += state == CONTACT_SLIDES;
    }
    return t;
}

contact_tally contact_resolve(const scene_contact *rule, contact_node *node)
{
    pair list[CONTACT_MAX_PAIRS];
    const int n = find_pairs(rule, node, list);
    memset(node->state, 0, sizeof node->state);
    if (rule->kind == CONTACT_FRICTION)
        relax_all(node, list, n, rule->friction);
    else
        join_bonded(node, list, n);
    return set_states(rule, node, list, n);
}

void contact_impose(contact_node *node)
{
    pair list[CONTACT_MAX_PAIRS];
    int n = 0;
    bool slides = false;
    for (int a = 0; a < node->n; ++a)
        for (int b = a + 1; b < node->n; ++b) {
            if (node->state[a][b] == CONTACT_FREE) continue;
            slides = slides || node->state[a][b] == CONTACT_SLIDES;
            list[n++] = make_pair(node, a, b, node->state[a][b] == CONTACT_SLIDES ? BOND_NORMAL : BOND_ALL);
        }
    if (slides)
        relax_all(node, list, n, 0.0);
    else
        join_bonded(node, list, n);
}

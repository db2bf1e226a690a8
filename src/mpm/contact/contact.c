/* The stages of contact: from the fields to the contact problem at one node, and back. */
#include "mpm/contact/contact.h"

#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/constraints.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

/* Place of a body in the deck's list; that in the scene where all solids are in contact. */
static int rank_of(const scene_contact *contact, int body)
{
    for (int k = 0; k < contact->n_bodies; ++k)
        if (contact->body[k] == body) return k;
    return body;
}

floe_status contact_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->contact, 1, sizeof *s->contact));
    struct mpm_contact *c = s->contact;
    c->normal = normal_find(s->scene->contact.normals);
    if (!c->normal)
        return fail_key(s->ctx, KEY("contact", "normals"), "there are no normals '%s'", s->scene->contact.normals);
    if (s->basis->support > CONTACT_SUPPORT)
        return fail_key(s->ctx, KEY("method", "basis"),
                        "%s, in contact: bodies would meet at nodes two cells off, where they have no normals; use one "
                        "of %d nodes along an axis at most, as quadratic",
                        s->basis->name, CONTACT_SUPPORT);
    c->fluids = true;
    for (int b = 0; b < s->n_bodies; ++b) {
        const int group = s->body[b].group;
        c->named[group] = scene_in_contact(s->scene, s->body[b].scene_body);
        c->rank[group] = rank_of(&s->scene->contact, s->body[b].scene_body);
        c->fluids = c->fluids && (c->named[group] || s->body[b].fluid);
    }
    c->window_nodes = 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        c->window[a] = a < s->mesh->dim ? s->mesh->tile[a] + 1 + 2 * c->normal->reach : 1;
        c->window_nodes *= c->window[a];
    }
    c->h = s->mesh->h[0];
    for (int a = 1; a < s->mesh->dim; ++a) c->h = fmin(c->h, s->mesh->h[a]);
    return memory_new(s->ctx, &c->near, mesh_tiles(s->mesh), sizeof *c->near);
}

void contact_destroy(mpm *s)
{
    if (s->contact) memory_free(s->ctx, &s->contact->near);
    memory_free(s->ctx, &s->contact);
}

size_t contact_partials(const mpm *s)
{
    return (size_t)s->contact->window_nodes * (size_t)(1 + s->mesh->dim);
}

/* Node arrays of all groups in a block. */
typedef struct group_view {
    const double *mass, *reach, *force[MESH_MAX_DIM], *normal[MESH_MAX_DIM];
    double *momentum[MESH_MAX_DIM], *v[MESH_MAX_DIM], *touch;
} group_view;

typedef struct node_pass {
    const mpm *s;
    int blk;
    contact_act act;
    group_view group[MPM_MAX_GROUPS];
} node_pass;

static void view_shapes(const mpm *s, int blk, group_view group[MPM_MAX_GROUPS])
{
    const fields *f = s->domain->fields[blk];
    for (int g = 0; g < s->n_groups; ++g) {
        group[g].mass = field_get(f, N_MASS, g, 0);
        group[g].reach = field_get(f, N_REACH, g, 0);
        for (int c = 0; c < s->mesh->dim; ++c) group[g].normal[c] = field_get(f, N_NORMAL, g, c);
    }
}

static field_id corrected_field(contact_act act)
{
    return act == CONTACT_DECIDE ? N_VEL_L : act == CONTACT_RESTORE ? N_RESIDUAL : N_VEL;
}

static node_pass pass_of(const mpm *s, int blk, contact_act act)
{
    node_pass p = {.s = s, .blk = blk, .act = act};
    const fields *f = s->domain->fields[blk];
    view_shapes(s, blk, p.group);
    for (int g = 0; g < s->n_groups; ++g) {
        for (int c = 0; c < s->mesh->dim; ++c) {
            p.group[g].momentum[c] = field_get(f, N_MOMENTUM, g, c);
            p.group[g].force[c] = field_get(f, N_FORCE, g, c);
            p.group[g].v[c] = field_get(f, corrected_field(act), g, c);
        }
        p.group[g].touch = field_get(f, N_TOUCH, g, 0);
    }
    return p;
}

enum { SUM_WORK, SUM_STICK, SUM_SLIP, SUM_RELEASE, SUM_COUNT };

/* Groups with mass at a node. */
static int find_groups(const mpm *s, const group_view *view, ptrdiff_t at, int *group)
{
    int n = 0;
    for (int g = 0; g < s->n_groups; ++g)
        if (view[g].mass[at] > 0.0) group[n++] = g;
    return n;
}

/* What a group is at a node, without velocities. */
static contact_body shape_of(const mpm *s, const group_view *view, ptrdiff_t at, int group)
{
    const group_view *g = &view[group];
    contact_body b = {.mass = g->mass[at],
                      .reach = g->reach ? g->reach[at] : 0.0,
                      .named = s->contact->named[group],
                      .rank = s->contact->rank[group],
                      .given = group >= s->n_deforming_groups};
    for (int c = 0; c < s->mesh->dim; ++c) b.normal[c] = g->normal[c][at];
    return b;
}

static void load_node(const node_pass *p, ptrdiff_t at, const int *group, contact_node *node)
{
    for (int k = 0; k < node->n; ++k) {
        const group_view *g = &p->group[group[k]];
        node->body[k] = shape_of(p->s, p->group, at, group[k]);
        for (int c = 0; c < node->dim; ++c) {
            node->body[k].v0[c] = g->momentum[c][at] / g->mass[at];
            node->body[k].v[c] = g->v[c][at];
        }
    }
}

/* Velocities after the forces so far, except where a wall constrains them. */
static void predict_node_velocities(const node_pass *p, ptrdiff_t at, const int *group, contact_node *node)
{
    for (int k = 0; k < node->n; ++k)
        for (int c = 0; c < node->dim; ++c)
            if (!node->constrained[c])
                node->body[k].v[c] += p->s->kick * p->group[group[k]].force[c][at] / node->body[k].mass;
}

static void save_states(const node_pass *p, ptrdiff_t at, const int *group, const contact_node *node)
{
    uint32_t bits[MPM_MAX_GROUPS] = {0};
    for (int a = 0; a < node->n; ++a)
        for (int b = a + 1; b < node->n; ++b) {
            if (node->state[a][b] == CONTACT_FREE) continue;
            const int shift = node->state[a][b] == CONTACT_SLIDES ? MPM_MAX_GROUPS : 0;
            bits[a] |= UINT32_C(1) << (group[b] + shift);
            bits[b] |= UINT32_C(1) << (group[a] + shift);
        }
    for (int k = 0; k < node->n; ++k) p->group[group[k]].touch[at] = bits[k];
}

static void recall_states(const node_pass *p, ptrdiff_t at, const int *group, contact_node *node)
{
    for (int a = 0; a < node->n; ++a) {
        const uint32_t bits = (uint32_t)p->group[group[a]].touch[at];
        for (int b = a + 1; b < node->n; ++b) {
            const uint32_t pair = bits >> group[b];
            node->state[a][b] = pair & 1 ? CONTACT_STICKS : pair >> MPM_MAX_GROUPS & 1 ? CONTACT_SLIDES : CONTACT_FREE;
        }
    }
}

/* Share of the kick of a node that its points feel. About an axis nodes near it are light without being almost empty. */
static double felt_share(const mpm *s, int group, double mass)
{
    return s->mesh->geometry == MESH_AXISYMMETRIC ? 1.0 : fmin(1.0, mass / (MPM_FELT_NODE * s->group_mass[group]));
}

/* Writes the velocities; returns what the contact added to the kinetic energy: its impulses times the means of the velocities before and after the kick. Of
 * the kick of a light node points feel its share alone. */
static double store_contact_node(const node_pass *p, ptrdiff_t at, const int *group, const contact_node *node)
{
    double work = 0.0;
    for (int k = 0; k < node->n; ++k) {
        const group_view *g = &p->group[group[k]];
        const contact_body *b = &node->body[k];
        const double felt = felt_share(p->s, group[k], b->mass);
        if (b->given) { /* what has been taken of it shows as a change of its nodes (motion/motion.h) */
            for (int c = 0; c < node->dim; ++c) g->v[c][at] = b->v[c] + b->taken[c] / b->mass;
            continue;
        }
        for (int c = 0; c < node->dim; ++c) {
            const double freely = g->v[c][at] - g->momentum[c][at] / b->mass, kicked = b->v[c] - b->v0[c];
            const double twice = felt < 1.0 ? 2.0 * b->v0[c] + felt * kicked : b->v0[c] + b->v[c];
            work += 0.5 * b->mass * (kicked - freely) * twice;
            g->v[c][at] = b->v[c];
            if (p->act == CONTACT_DECIDE) g->momentum[c][at] = b->mass * b->v0[c];
        }
    }
    return work;
}

/* Components that the sides constrain at a node; slip sides release bodies, but normals have none across them. `global`: its index. */
static void find_constrained(const mpm *s, const int global[MESH_MAX_DIM], bool constrained[MESH_MAX_DIM])
{
    const unsigned components = side_constraints(s, 0, global);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int side = global[a] == 0 ? SIDE_LOWER : SIDE_UPPER;
        const bool at_side = !s->mesh->periodic[a] && (global[a] == 0 || global[a] == s->mesh->n[a]);
        constrained[a] = is_constrained(components, a) || (at_side && s->scene->bc.side[a][side].kind == BC_SLIP);
    }
}

static contact_node empty_node(const mpm *s)
{
    return (contact_node){
        .dim = s->mesh->dim, .h = s->contact->h, .apart = s->cells == CELLS_SMEARED, .fluids = s->contact->fluids};
}

static ptrdiff_t index_of(const mpm *s, int blk, const int global[MESH_MAX_DIM])
{
    const block *b = &s->mesh->block[blk];
    return mesh_index(b, global[0] - b->lo[0], global[1] - b->lo[1], global[2] - b->lo[2]);
}

void contact_look(const mpm *s, int blk, const int global[MESH_MAX_DIM], int group[MPM_MAX_GROUPS], contact_node *node)
{
    const ptrdiff_t at = index_of(s, blk, global);
    group_view view[MPM_MAX_GROUPS] = {0};
    view_shapes(s, blk, view);
    *node = empty_node(s);
    node->n = find_groups(s, view, at, group);
    for (int k = 0; k < node->n; ++k) node->body[k] = shape_of(s, view, at, group[k]);
}

/* One node; sum: where its work and counts go, NULL where another tile owns it. */
static void visit_node(const node_pass *p, const int global[MESH_MAX_DIM], double *sum)
{
    const ptrdiff_t at = index_of(p->s, p->blk, global);
    int group[MPM_MAX_GROUPS];
    const int groups = find_groups(p->s, p->group, at, group);
    if (groups < 2) return;
    contact_node node = empty_node(p->s);
    node.n = groups;
    find_constrained(p->s, global, node.constrained);
    load_node(p, at, group, &node);
    if (p->act == CONTACT_FORESEE) predict_node_velocities(p, at, group, &node);
    contact_tally t = {0};
    if (p->act == CONTACT_REPEAT || p->act == CONTACT_RESTORE)
        recall_states(p, at, group, &node);
    else
        t = contact_resolve(&p->s->scene->contact, &node);
    if (p->act == CONTACT_DECIDE) save_states(p, at, group, &node);
    if (p->act == CONTACT_FORESEE) load_node(p, at, group, &node);
    if (p->act != CONTACT_DECIDE) contact_impose(&node);
    const double work = store_contact_node(p, at, group, &node);
    if (!sum) return;
    sum[SUM_WORK] += work;
    sum[SUM_STICK] += t.stick;
    sum[SUM_SLIP] += t.slip;
    sum[SUM_RELEASE] += t.release;
}

/* Nodes that a tile visits along an axis, [lo, end): its own, [first, own_end), and the ghosts beside them that its
 * block sees. */
typedef struct node_range {
    int lo, end, own_end;
} node_range;

static node_range range_of(const mesh *m, const block *b, const tile_box *t, int a)
{
    const int last = t->first[a] + t->cells[a];
    node_range r = {t->first[a], last, last};
    if (a >= m->dim) return r;
    if (t->first[a] == b->lo[a] && (m->periodic[a] || !b->at_side[a][SIDE_LOWER])) r.lo--;
    if (last == m->n[a] && !m->periodic[a])
        r.end = r.own_end = last + 1; /* the last tile owns the upper wall's nodes */
    else if (last == b->lo[a] + b->n[a])
        r.end = last + 2;
    return r;
}

static void visit_tile(const node_pass *p, int tile)
{
    const mesh *m = p->s->mesh;
    const block *b = &m->block[p->blk];
    const tile_box t = tile_box_of(m, b, tile);
    double *sum = p->s->scratch->tile_sum + (size_t)t.number * SUM_COUNT;
    node_range r[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) r[a] = range_of(m, b, &t, a);
    memset(sum, 0, SUM_COUNT * sizeof *sum);
    for (int k = r[2].lo; k < r[2].end; ++k)
        for (int j = r[1].lo; j < r[1].end; ++j)
            for (int i = r[0].lo; i < r[0].end; ++i) {
                const bool own = i >= t.first[0] && j >= t.first[1] && k >= t.first[2] && i < r[0].own_end &&
                                 j < r[1].own_end && k < r[2].own_end;
                visit_node(p, (const int[]){i, j, k}, own ? sum : NULL);
            }
}

void contact_velocities(mpm *s, contact_act act)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const node_pass p = pass_of(s, b, act);
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) visit_tile(&p, t);
    }
    if (act != CONTACT_DECIDE) return;
    double sum[SUM_COUNT];
    domain_sum_tiles(s->mesh, s->scratch->tile_sum, SUM_COUNT, sum);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_CONTACT, sum[SUM_WORK]);
    ledger_tally(s->ledger, COUNT_CONTACT_STICK, (long long)sum[SUM_STICK]);
    ledger_tally(s->ledger, COUNT_CONTACT_SLIP, (long long)sum[SUM_SLIP]);
    ledger_tally(s->ledger, COUNT_CONTACT_RELEASE, (long long)sum[SUM_RELEASE]);
}

floe_status mpm_contact_velocity(mpm *s)
{
    contact_velocities(s, CONTACT_DECIDE);
    return FLOE_OK;
}

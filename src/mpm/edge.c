/* What the lines of edges do in a step (edge.h). */
#include "mpm/edge.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { MAX_ITERATIONS = 500 };
static const double solver_tolerance = 1e-6; /* of the residual, in the norm of the diagonal's inverse */

/* Where a block sees a node, moved by whole periods: false where it does not. */
static bool sees(const mesh *m, const block *b, const edge_node *n, const int period[MESH_MAX_DIM], ptrdiff_t *at)
{
    int local[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        local[a] = n->at[a] + period[a] * m->n[a] - b->lo[a];
        if (a < m->dim && (local[a] < -1 || local[a] > b->n[a] + 1)) return false;
    }
    *at = mesh_index(b, local[0], local[1], local[2]);
    return true;
}

/* Adds to every copy of a node: in each block that sees it, and at periodic images. */
static void add_to_copies(const mpm *s, int group, const edge_node *n, field_id id, int c, double value)
{
    const mesh *m = s->mesh;
    int images[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) images[a] = m->periodic[a] ? 1 : 0;
    for (int z = -images[2]; z <= images[2]; ++z)
        for (int y = -images[1]; y <= images[1]; ++y)
            for (int x = -images[0]; x <= images[0]; ++x)
                for (int b = 0; b < m->n_blocks; ++b) {
                    ptrdiff_t at;
                    if (sees(m, &m->block[b], n, (const int[]){x, y, z}, &at))
                        field_get(s->domain->fields[b], id, group, c)[at] += value;
                }
}

static double node_value(const mpm *s, int group, const edge_node *n, field_id id, int c)
{
    int cell[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) cell[a] = n->at[a] == s->mesh->n[a] ? n->at[a] - 1 : n->at[a];
    const int blk = mesh_block_of(s->mesh, cell);
    const block *b = &s->mesh->block[blk];
    const ptrdiff_t at = mesh_index(b, n->at[0] - b->lo[0], n->at[1] - b->lo[1], n->at[2] - b->lo[2]);
    return field_get(s->domain->fields[blk], id, group, c)[at];
}

/* D u of a line, from one component at the nodes of the list. */
static double difference_of(const edge_line *l, int c, const double *u)
{
    const double *w = edge_weights(l, c);
    double sum = 0.0;
    for (int t = 0; t < EDGE_TAPS; ++t) sum += w[t] * u[l->node[t]];
    return sum;
}

/* out += factor D^T. */
static void add_transposed(const edge_line *l, int c, double factor, double *out)
{
    const double *w = edge_weights(l, c);
    for (int t = 0; t < EDGE_TAPS; ++t) out[l->node[t]] += factor * w[t];
}

/* What a unit of D^T gives to the nodes, or to those that are free in component c: none, but beside walls and mirrors. */
static double unbalanced(const edge_group *g, const edge_line *l, int c, bool free_only)
{
    double sum = 0.0;
    for (int t = 0; t < EDGE_TAPS; ++t)
        if (!free_only || ((g->node[l->node[t]].held >> c) & 1u) == 0) sum += edge_weights(l, c)[t];
    return sum;
}

static ledger_quantity momentum_along(int c)
{
    return (ledger_quantity)(LEDGER_MOMENTUM_X + c);
}

/* Vectors over the nodes of a group's list. */
enum { V_MASS, V_DIAGONAL, V_RAW, V_BEFORE, V_X, V_R, V_P, V_AP, V_COUNT };

static floe_status make_room(mpm *s, const edge_group *g, double *v[V_COUNT])
{
    mpm_edges *e = s->work->edges;
    const size_t n = (size_t)g->n_nodes;
    if (n > e->solve_room) {
        TRY(memory_resize(s->ctx, &e->solve, 2 * n * V_COUNT, sizeof *e->solve));
        e->solve_room = 2 * n;
    }
    for (int k = 0; k < V_COUNT; ++k) v[k] = e->solve + (size_t)k * n;
    return FLOE_OK;
}

static bool is_usf(const mpm *s)
{
    return s->scene->method.stress == STRESS_USF;
}

/* The differences that forces are taken from. */
static const double *strained(const mpm *s)
{
    return is_usf(s) ? s->work->edges->next : s->work->edges->difference;
}

/* Forces (N) of a group's lines along c. */
static void line_forces(const mpm *s, const edge_group *g, int c, double *force)
{
    memset(force, 0, (size_t)g->n_nodes * sizeof *force);
    for (size_t k = 0; k < g->n_lines; ++k)
        add_transposed(&g->line[k], c, -g->line[k].stiffness * strained(s)[g->line[k].slot + (size_t)c], force);
}

static floe_status push_group(mpm *s, int group)
{
    const edge_group *g = &s->work->edges->group[group];
    double *v[V_COUNT];
    TRY(make_room(s, g, v));
    for (int c = 0; c < s->mesh->dim; ++c) {
        double given = 0.0;
        line_forces(s, g, c, v[V_X]);
        for (size_t k = 0; k < g->n_lines; ++k) {
            const edge_line *l = &g->line[k];
            if (l->images) given -= l->stiffness * strained(s)[l->slot + (size_t)c] * unbalanced(g, l, c, false);
        }
        for (int n = 0; n < g->n_nodes; ++n) add_to_copies(s, group, &g->node[n], N_FORCE, c, v[V_X][n]);
        ledger_add(s->ledger, momentum_along(c), LEDGER_BOUNDARY, given * s->work->kick);
    }
    return FLOE_OK;
}

floe_status mpm_edge_force(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g) {
        TRY(edges_find(s, g));
        if (is_usf(s)) edges_strain(s, g, N_VEL);
        TRY(push_group(s, g));
    }
    return FLOE_OK;
}

/* A p of the system for component c; rows of held nodes are left out. */
static void apply(const edge_group *g, int c, double kick, double *const v[V_COUNT], const double *p, double *out)
{
    for (int n = 0; n < g->n_nodes; ++n) out[n] = v[V_MASS][n] * p[n];
    for (size_t k = 0; k < g->n_lines; ++k) {
        const edge_line *l = &g->line[k];
        add_transposed(l, c, (l->inertia + kick * l->damping) * difference_of(l, c, p), out);
    }
    for (int n = 0; n < g->n_nodes; ++n)
        if (((g->node[n].held >> c) & 1u) != 0) out[n] = 0.0;
}

static double weighted_square(const edge_group *g, double *const v[V_COUNT])
{
    double sum = 0.0;
    for (int n = 0; n < g->n_nodes; ++n) sum += v[V_R][n] * v[V_R][n] / v[V_DIAGONAL][n];
    return sum;
}

/* Conjugate gradients, preconditioned by the diagonal, from the accelerations without the lines. */
static void solve(const edge_group *g, int c, double kick, double *const v[V_COUNT])
{
    double *x = v[V_X], *r = v[V_R], *p = v[V_P], *Ap = v[V_AP], scale = 0.0;
    for (int n = 0; n < g->n_nodes; ++n) r[n] = v[V_MASS][n] * v[V_RAW][n];
    for (size_t k = 0; k < g->n_lines; ++k)
        add_transposed(&g->line[k], c, -g->line[k].damping * difference_of(&g->line[k], c, v[V_BEFORE]), r);
    apply(g, c, kick, v, x, Ap);
    for (int n = 0; n < g->n_nodes; ++n) {
        if (((g->node[n].held >> c) & 1u) != 0) r[n] = 0.0;
        scale += r[n] * r[n] / v[V_DIAGONAL][n];
        r[n] -= Ap[n];
        p[n] = r[n] / v[V_DIAGONAL][n];
    }
    double square = weighted_square(g, v);
    for (int k = 0; k < MAX_ITERATIONS && square > solver_tolerance * solver_tolerance * scale; ++k) {
        double curvature = 0.0;
        apply(g, c, kick, v, p, Ap);
        for (int n = 0; n < g->n_nodes; ++n) curvature += p[n] * Ap[n];
        if (!(curvature > 0.0)) return;
        const double step = square / curvature;
        for (int n = 0; n < g->n_nodes; ++n) {
            x[n] += step * p[n];
            r[n] -= step * Ap[n];
        }
        const double before = square;
        square = weighted_square(g, v);
        for (int n = 0; n < g->n_nodes; ++n) p[n] = r[n] / v[V_DIAGONAL][n] + square / before * p[n];
    }
}

/* What the solver has left of the residual goes to all free nodes alike: they gain what walls and mirrors give (kg m/s2), to round-off. */
static void keep_momentum(const edge_group *g, int c, double given, double *const v[V_COUNT])
{
    double left = given, mass = 0.0;
    for (int n = 0; n < g->n_nodes; ++n) {
        if (((g->node[n].held >> c) & 1u) != 0) continue;
        left += v[V_MASS][n] * (v[V_RAW][n] - v[V_X][n]);
        mass += v[V_MASS][n];
    }
    for (int n = 0; n < g->n_nodes && mass > 0.0; ++n)
        if (((g->node[n].held >> c) & 1u) == 0) v[V_X][n] += left / mass;
}

static void load_system(const mpm *s, int group, int c, double *const v[V_COUNT])
{
    const edge_group *g = &s->work->edges->group[group];
    for (int n = 0; n < g->n_nodes; ++n) {
        const bool held = ((g->node[n].held >> c) & 1u) != 0;
        v[V_MASS][n] = v[V_DIAGONAL][n] = node_value(s, group, &g->node[n], N_MASS, 0);
        v[V_BEFORE][n] = node_value(s, group, &g->node[n], N_MOMENTUM, c) / v[V_MASS][n];
        v[V_X][n] = v[V_RAW][n] = held ? 0.0 : node_value(s, group, &g->node[n], N_ACCEL, c);
    }
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int t = 0; t < EDGE_TAPS; ++t)
            v[V_DIAGONAL][g->line[k].node[t]] += (g->line[k].inertia + s->work->kick * g->line[k].damping) *
                                                 g->line[k].weight[0][t] * g->line[k].weight[0][t];
}

/* What lines take of the points' kinetic energy, and give back: entered as damping, since their own is no part of the points'. */
static void enter_work(mpm *s, const edge_group *g, int c, double *const v[V_COUNT])
{
    const double kick = s->work->kick;
    double work = 0.0;
    line_forces(s, g, c, v[V_R]);
    for (int n = 0; n < g->n_nodes; ++n) {
        if (((g->node[n].held >> c) & 1u) != 0) continue;
        const double force = v[V_R][n] + v[V_MASS][n] * (v[V_X][n] - v[V_RAW][n]);
        work += kick * force * (v[V_BEFORE][n] + 0.5 * kick * v[V_X][n]);
    }
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, work);
}

static void accelerate(mpm *s, int group, int c, double *const v[V_COUNT])
{
    const edge_group *g = &s->work->edges->group[group];
    double given = 0.0;
    load_system(s, group, c, v);
    solve(g, c, s->work->kick, v);
    for (size_t k = 0; k < g->n_lines; ++k) {
        const edge_line *l = &g->line[k];
        given -= unbalanced(g, l, c, true) * ((l->inertia + s->work->kick * l->damping) * difference_of(l, c, v[V_X]) +
                                              l->damping * difference_of(l, c, v[V_BEFORE]));
    }
    keep_momentum(g, c, given, v);
    for (int n = 0; n < g->n_nodes; ++n) {
        if (((g->node[n].held >> c) & 1u) != 0) continue;
        const double change = v[V_X][n] - v[V_RAW][n];
        add_to_copies(s, group, &g->node[n], N_ACCEL, c, change);
        add_to_copies(s, group, &g->node[n], N_VEL_L, c, change * s->work->kick);
    }
    ledger_add(s->ledger, momentum_along(c), LEDGER_BOUNDARY, given * s->work->kick);
    enter_work(s, g, c, v);
}

void edges_strain(mpm *s, int group, field_id velocity)
{
    mpm_edges *e = s->work->edges;
    const edge_group *g = &e->group[group];
    const double dt = strain_step(s);
    if (group == 0) memset(e->next, 0, e->slots * sizeof *e->next); /* lines that are none now have none */
    for (size_t k = 0; k < g->n_lines; ++k)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const edge_line *l = &g->line[k];
            const size_t slot = l->slot + (size_t)c;
            double rate = 0.0;
            for (int t = 0; t < EDGE_TAPS; ++t)
                rate += edge_weights(l, c)[t] * node_value(s, group, &g->node[l->node[t]], velocity, c);
            e->next[slot] = e->difference[slot] + dt * rate;
        }
}

floe_status edges_accelerate(mpm *s, int group)
{
    const edge_group *g = &s->work->edges->group[group];
    double *v[V_COUNT];
    if (g->n_nodes == 0) return FLOE_OK;
    TRY(make_room(s, g, v));
    for (int c = 0; c < s->mesh->dim; ++c) accelerate(s, group, c, v);
    return FLOE_OK;
}

void edges_commit(mpm *s)
{
    mpm_edges *e = s->work->edges;
    if (!e) return;
    double *swap = e->difference;
    e->difference = e->next;
    e->next = swap;
}

double *mpm_edges_state(mpm *s, size_t *n)
{
    *n = s->work->edges ? s->work->edges->slots : 0;
    return s->work->edges ? s->work->edges->difference : NULL;
}

/* Accelerations of nodes with the inertia of the lines through them (edge.h):
 *
 *   (m + (1 + kick d) A) a = m a_raw - d A v,   A = sum a D^T D,   d their damping, 0 where they flow,
 *
 * by conjugate gradients, preconditioned by the diagonal, from the last step's a. */
#include "mpm/edge/edge.h"

#include "base/memory.h"
#include "mpm/edge/edge_lines.h"
#include "mpm/mpm_constants.h"

#include <math.h>
#include <string.h>

/* Vectors over the nodes of a group's list. */
enum { V_MASS, V_INVERSE, V_RAW, V_BEFORE, V_X, V_R, V_P, V_AP, V_COUNT };

/* One component of a group's system. */
typedef struct edge_system {
    const edge_group *group;
    int c;
    double kick, share;     /* s; of A in the matrix */
    const double *inertia;  /* kg: A's entries */
    double *mass, *inverse; /* kg; 1/kg: of the diagonal */
    double *raw, *before;   /* m/s2 without the lines; m/s at the start of the step */
    double *x, *r, *p, *Ap; /* m/s2, N, m/s2, N */
} edge_system;

floe_status edges_scratch(mpm *s, const edge_group *g, size_t vectors, double **out)
{
    mpm_edges *e = s->edges;
    const size_t wanted = (size_t)g->n_nodes * vectors;
    if (wanted > e->scratch_reserved || !e->solve) { /* for no nodes there is an array, too */
        TRY(memory_resize(s->ctx, &e->solve, wanted + wanted / 4, sizeof *e->solve));
        e->scratch_reserved = wanted + wanted / 4;
    }
    *out = e->solve;
    return FLOE_OK;
}

/* Row n of A times p. */
static double times_lines(const edge_system *y, int n, const double *p)
{
    const edge_matrix *m = &y->group->matrix;
    const size_t begin = (size_t)n * (size_t)m->width;
    double sum = 0.0;
    for (int k = 0; k < m->count[n]; ++k) sum += y->inertia[begin + (size_t)k] * p[m->column[begin + (size_t)k]];
    return sum;
}

/* Ap += factor A_f p, A_f of the lines that flow alone, in nodes that are free. */
static void add_flowing(const edge_system *y, double factor, const double *p, double *Ap)
{
    const edge_group *g = y->group;
    for (size_t k = 0; k < g->n_lines && g->n_flowing > 0; ++k) {
        const edge_line *l = &g->line[k];
        if (!l->flows) continue;
        const double *w = edge_weights(l, y->c), force = factor * l->inertia * edge_difference(l, y->c, p);
        for (int t = 0; t < EDGE_TAPS; ++t)
            if (!edge_constrains(&g->node[l->node[t]], y->c)) Ap[l->node[t]] += w[t] * force;
    }
}

/* Ap = M p of the system's matrix M, in which constrained nodes have no rows. A cg_operator; user: the edge_system. */
static void apply_matrix(void *user, double *p, double *Ap)
{
    const edge_system *y = user;
    const edge_group *g = y->group;
    for (int n = 0; n < g->n_nodes; ++n)
        Ap[n] = edge_constrains(&g->node[n], y->c) ? 0.0 : y->mass[n] * p[n] + y->share * times_lines(y, n, p);
    add_flowing(y, 1.0 - y->share, p, Ap);
}

/* z = r over the diagonal. A cg_operator. */
static void apply_inverse(void *user, double *r, double *z)
{
    const edge_system *y = user;
    for (int n = 0; n < y->group->n_nodes; ++n) z[n] = r[n] * y->inverse[n];
}

/* r = b - M x. Gives the size of b. */
static double find_residual(edge_system *y)
{
    const edge_group *g = y->group;
    double square = 0.0;
    apply_matrix(y, y->x, y->Ap);
    for (int n = 0; n < g->n_nodes; ++n) {
        const bool constrained = edge_constrains(&g->node[n], y->c);
        y->r[n] = constrained ? 0.0 : y->mass[n] * y->raw[n] - g->damping * times_lines(y, n, y->before);
    }
    add_flowing(y, g->damping, y->before, y->r);
    for (int n = 0; n < g->n_nodes; ++n) {
        square += y->r[n] * y->r[n] * y->inverse[n];
        y->r[n] -= y->Ap[n];
    }
    return sqrt(square);
}

/* Motion k of a body at a node: uniform, or along a coordinate from the centre of the body's nodes. */
static double motion_at(const edge_motion *b, const edge_node *n, int k)
{
    return k == 0 ? 1.0 : n->at[k - 1] - b->centre[k - 1];
}

static void centre_bodies(const edge_group *g, edge_motion *body, int n_bodies)
{
    memset(body, 0, (size_t)n_bodies * sizeof *body);
    for (int n = 0; n < g->n_nodes; ++n) {
        edge_motion *b = &body[g->node[n].body];
        b->nodes += 1.0;
        for (int a = 0; a < MESH_MAX_DIM; ++a) b->centre[a] += g->node[n].at[a];
    }
    for (int k = 0; k < n_bodies; ++k)
        for (int a = 0; a < MESH_MAX_DIM && body[k].nodes > 0.0; ++a) body[k].centre[a] /= body[k].nodes;
}

/* W^T M W and W^T r of every body. */
static void sum_motions(edge_system *y, edge_motion *body, int motions)
{
    const edge_group *g = y->group;
    for (int k = 0; k < motions; ++k) {
        for (int n = 0; n < g->n_nodes; ++n) {
            const edge_node *node = &g->node[n];
            y->p[n] = edge_constrains(node, y->c) ? 0.0 : motion_at(&body[node->body], node, k);
        }
        apply_matrix(y, y->p, y->Ap);
        for (int n = 0; n < g->n_nodes; ++n) {
            edge_motion *b = &body[g->node[n].body];
            b->share[k] += y->p[n] * y->r[n];
            for (int l = 0; l < motions; ++l) b->inertia[l][k] += motion_at(b, &g->node[n], l) * y->Ap[n];
        }
    }
}

/* Solves W^T M W q = W^T r in place; a motion that is linearly dependent on others at the body's nodes stays 0. */
static void solve_motions(edge_motion *b, int motions)
{
    double diagonal[EDGE_MOTIONS];
    for (int k = 0; k < motions; ++k) diagonal[k] = b->inertia[k][k];
    for (int k = 0; k < motions; ++k) {
        const bool known = b->inertia[k][k] > MPM_EDGE_INDEPENDENT * diagonal[k];
        for (int l = 0; l < motions; ++l) {
            const double factor = known && l != k ? b->inertia[l][k] / b->inertia[k][k] : 0.0;
            for (int j = 0; j < motions; ++j) b->inertia[l][j] -= factor * b->inertia[k][j];
            b->share[l] -= factor * b->share[k];
        }
        if (known) continue;
        b->share[k] = 0.0;
        for (int l = 0; l < motions; ++l) b->inertia[l][k] = b->inertia[k][l] = 0.0;
        b->inertia[k][k] = 1.0;
    }
    for (int k = 0; k < motions; ++k) b->share[k] /= b->inertia[k][k];
}

/* What the solver has left of the residual W^T r in motions W that are linear in space, which lines do not resist, goes
 * to the body's own nodes: with M the matrix, x += W (W^T M W)^-1 W^T r. So lines give a body as much moment of momentum
 * as walls and mirrors ask of them, and none if there are none; the error falls, in the norm of M. */
static void keep_linear_motion(const mpm *s, edge_system *y)
{
    edge_motion *body = s->edges->motion;
    const edge_group *g = y->group;
    const int motions = 1 + s->mesh->dim;
    centre_bodies(g, body, s->n_bodies);
    sum_motions(y, body, motions);
    for (int k = 0; k < s->n_bodies; ++k)
        if (body[k].nodes > 0.0) solve_motions(&body[k], motions);
    for (int n = 0; n < g->n_nodes; ++n) {
        const edge_motion *b = &body[g->node[n].body];
        if (edge_constrains(&g->node[n], y->c)) continue;
        for (int k = 0; k < motions; ++k) y->x[n] += b->share[k] * motion_at(b, &g->node[n], k);
    }
}

/* What lines give to the free nodes (kg m/s2): none, but beside walls and mirrors. */
static edge_giving given_by_lines(const mpm *s, const edge_system *y)
{
    const edge_group *g = y->group;
    edge_giving given = {.walls = 0.0};
    for (size_t k = 0; k < g->n_lines; ++k) {
        const edge_line *l = &g->line[k];
        if (!l->unbalanced) continue;
        const double share = l->flows ? 1.0 : y->share, damping = l->flows ? 0.0 : g->damping;
        const double motion = share * edge_difference(l, y->c, y->x) + damping * edge_difference(l, y->c, y->before);
        edges_give(s, g, l, y->c, true, -l->inertia * motion, &given);
    }
    return given;
}

/* What the solver has left of the residual goes to all free nodes alike: they gain what walls and mirrors give (kg
 * m/s2), to round-off. */
static void keep_momentum(const edge_system *y, double given)
{
    const edge_group *g = y->group;
    double left = given, mass = 0.0;
    for (int n = 0; n < g->n_nodes; ++n) {
        if (edge_constrains(&g->node[n], y->c)) continue;
        left += y->mass[n] * (y->raw[n] - y->x[n]);
        mass += y->mass[n];
    }
    for (int n = 0; n < g->n_nodes && mass > 0.0; ++n)
        if (!edge_constrains(&g->node[n], y->c)) y->x[n] += left / mass;
}

static edge_system load_system(const mpm *s, int group, int c, double *scratch)
{
    const mpm_edges *e = s->edges;
    const edge_group *g = &e->group[group];
    const size_t rows = (size_t)g->n_nodes;
    double *v[V_COUNT];
    for (size_t k = 0; k < V_COUNT; ++k) v[k] = scratch + k * rows;
    edge_system y = {.group = g,
                     .c = c,
                     .kick = s->kick,
                     .share = 1.0 + s->kick * g->damping,
                     .inertia = g->matrix.inertia + (size_t)c * g->matrix.reserved,
                     .mass = v[V_MASS],
                     .inverse = v[V_INVERSE],
                     .raw = v[V_RAW],
                     .before = v[V_BEFORE],
                     .x = v[V_X],
                     .r = v[V_R],
                     .p = v[V_P],
                     .Ap = v[V_AP]};
    edges_values(s, group, N_MASS, 0, y.mass);
    edges_values(s, group, N_MOMENTUM, c, y.before);
    edges_values(s, group, N_ACCEL, c, y.raw);
    for (int n = 0; n < g->n_nodes; ++n) {
        const bool constrained = edge_constrains(&g->node[n], c);
        y.inverse[n] = 1.0 / (y.mass[n] + y.share * y.inertia[(size_t)n * (size_t)g->matrix.width]);
        y.before[n] = y.mass[n] > 0.0 ? y.before[n] / y.mass[n] : 0.0;
        if (constrained) y.raw[n] = 0.0;
        y.x[n] = constrained ? 0.0 : e->memory[g->node[n].slot + (size_t)c];
    }
    return y;
}

/* Kinetic energy that lines exchange with the points: entered as damping, since the energy of lines is not among that of
 * the points. With the velocities at the start of the step: points are accelerated by all of their nodes and get almost
 * nothing of the squared kick of a nearly empty node, where lines balance the stress. Including it doubled the loss of a
 * probe that hits a bag. */
static void enter_work(mpm *s, const edge_system *y)
{
    double work = 0.0;
    edges_push(s, y->group, y->c, y->r);
    for (int n = 0; n < y->group->n_nodes; ++n) {
        if (edge_constrains(&y->group->node[n], y->c)) continue;
        const double force = y->r[n] + y->mass[n] * (y->x[n] - y->raw[n]);
        work += y->kick * force * y->before[n];
    }
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, work);
}

static void accelerate_nodes(mpm *s, int group, int c, double *scratch)
{
    edge_group *g = &s->edges->group[group];
    edge_system y = load_system(s, group, c, scratch);
    const double size = find_residual(&y);
    const cg_system system = {apply_matrix, apply_inverse, &y, CG_PRECONDITIONED, NULL};
    cg_solve(s->edges->solver, &system, MPM_EDGE_TOLERANCE * size, y.r, y.x);
    keep_linear_motion(s, &y);
    const edge_giving given = given_by_lines(s, &y);
    keep_momentum(&y, given.walls + given.bodies);
    for (int n = 0; n < g->n_nodes; ++n) {
        g->accelerated[(size_t)c * (size_t)g->n_nodes + (size_t)n] = y.x[n];
        y.p[n] = edge_constrains(&g->node[n], c) ? 0.0 : y.x[n] - y.raw[n];
        y.Ap[n] = y.kick * y.p[n];
    }
    edges_add_to_copies(s, group, N_ACCEL, c, y.p);
    edges_add_to_copies(s, group, N_VEL_L, c, y.Ap);
    edges_enter(s, c, &given);
    enter_work(s, &y);
}

/* Accelerations with the stiffness of all lines, as they are (implicit/implicit_walls.h); what lines push with does work at the mean velocity. */
static void keep_accelerations(mpm *s, int group, int c, double *scratch)
{
    edge_group *g = &s->edges->group[group];
    edge_system y = load_system(s, group, c, scratch);
    double work = 0.0;
    edges_push(s, g, c, y.r);
    for (int n = 0; n < g->n_nodes; ++n) {
        g->accelerated[(size_t)c * (size_t)g->n_nodes + (size_t)n] = y.raw[n];
        work += y.kick * y.r[n] * (y.before[n] + 0.5 * y.kick * y.raw[n]);
    }
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, work);
}

/* The fastest of a block's own nodes with mass along c (m/s). */
static double fastest_of(const mpm *s, int blk, int group, int c)
{
    const block *b = &s->mesh->block[blk];
    const double *restrict mass = field_get(s->domain->fields[blk], N_MASS, group, 0);
    const double *restrict v = field_get(s->domain->fields[blk], N_VEL_L, group, c);
    const int last[MESH_MAX_DIM] = {b->n[0], s->mesh->dim > 1 ? b->n[1] : 0, s->mesh->dim > 2 ? b->n[2] : 0};
    double fastest = 0.0;
    for (int k = 0; k <= last[2]; ++k)
        for (int j = 0; j <= last[1]; ++j) {
            const ptrdiff_t row = mesh_index(b, 0, j, k);
            for (ptrdiff_t at = row; at <= row + last[0]; ++at) {
                const double speed = mass[at] > 0.0 ? fabs(v[at]) : 0.0;
                fastest = speed > fastest ? speed : fastest;
            }
        }
    return fastest;
}

/* Cells that nodes move in the step at most. */
static double way_of_nodes(const mpm *s, int group)
{
    double displacement = 0.0;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int c = 0; c < s->mesh->dim; ++c)
            displacement = fmax(displacement, fastest_of(s, b, group, c) * s->dt / s->mesh->h[c]);
    return displacement;
}

floe_status edges_accelerate(mpm *s, int group)
{
    mpm_edges *e = s->edges;
    edge_group *g = &e->group[group];
    double *scratch;
    const solve_grid nodes = solve_grid_of_list(g->n_nodes);
    TRY(edges_scratch(s, g, V_COUNT, &scratch));
    TRY(cg_resize(e->solver, &nodes, 1));
    edges_mark_flow(s, g);
    for (int c = 0; c < s->mesh->dim && g->n_nodes > 0; ++c)
        (walls_are_stiff(s) ? keep_accelerations : accelerate_nodes)(s, group, c, scratch);
    g->travelled = (g->looked ? 0.0 : e->memory[e->travel + (size_t)group]) + way_of_nodes(s, group);
    return FLOE_OK;
}

floe_status edges_start(mpm *s)
{
    double *scratch;
    if (s->edges) s->edges->starting = true;
    for (int g = 0; s->edges && g < s->n_deforming_groups; ++g) {
        TRY(edges_find(s, g, true));
        TRY(edges_scratch(s, &s->edges->group[g], V_COUNT, &scratch));
    }
    if (s->edges) s->edges->starting = false;
    return FLOE_OK;
}

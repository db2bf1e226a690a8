/* Forces and history of the penalised lines (edge.h). */
#include "mpm/edge/edge.h"

#include "mpm/edge/edge_lines.h"
#include "mpm/motion/motion_ties.h"
#include "mpm/state/stress.h"

#include <math.h>
#include <string.h>

double mpm_edge_penalty(const mpm *s)
{
    bool solids = false;
    for (int b = 0; b < s->n_bodies; ++b) solids = solids || edge_body(s, b);
    if (!solids) return 0.0;
    if (!isnan(s->scene->method.edge_penalty)) return s->scene->method.edge_penalty;
    return s->carries[P_SHARE] ? 0.0 : s->basis->edge_penalty; /* an edge that burns has no penalty */
}

/* The difference that gives the force of line k of a group. */
static double edge_velocity_jump(const mpm *s, const edge_group *g, size_t k, int c)
{
    return s->scene->method.stress == STRESS_USF ? g->next[k * (size_t)s->mesh->dim + (size_t)c]
                                                 : s->edges->memory[g->line[k].slot + (size_t)c];
}

void edges_mark_flow(const mpm *s, edge_group *g)
{
    static const double nearly = 1.0 - 1e-9;
    g->n_flowing = 0;
    for (size_t k = 0; k < g->n_lines; ++k) {
        double square = 0.0;
        for (int c = 0; c < s->mesh->dim; ++c)
            square += edge_velocity_jump(s, g, k, c) * edge_velocity_jump(s, g, k, c);
        g->line[k].flows = sqrt(square) >= nearly * g->line[k].most;
        g->n_flowing += g->line[k].flows ? 1 : 0;
    }
}

void edges_give(const mpm *s, const edge_group *g, const edge_line *l, int c, bool free_only, double factor,
                edge_giving *sum)
{
    const double given = factor * edge_sum(g, l, c, free_only);
    *(l->leader < 0 ? &sum->walls : &sum->bodies) += given;
    for (int t = 0; t < EDGE_TAPS; ++t) {
        const edge_node *n = &g->node[l->node[t]];
        double x[MESH_MAX_DIM], taken[3] = {0.0};
        if (free_only && edge_constrains(n, c)) continue;
        place_of_node(s->mesh, n->at, x);
        taken[c] = -s->kick * factor * edge_weights(l, c)[t];
        if (l->leader < 0)
            add_moment(sum->moment, x, c, factor * edge_weights(l, c)[t]);
        else
            motion_pull_fixed(s, l->leader, x, taken, (const double[3]){0.0});
    }
}

static double tension_of(const mpm *s, const edge_group *g, size_t line, int c)
{
    return -g->line[line].stiffness * edge_velocity_jump(s, g, line, c);
}

void edges_push(const mpm *s, const edge_group *g, int c, double *force)
{
    if (g->n_nodes > 0) memset(force, 0, (size_t)g->n_nodes * sizeof *force);
    for (size_t k = 0; k < g->n_lines; ++k) edge_add(&g->line[k], c, tension_of(s, g, k, c), force);
}

void edges_add_to_copies(const mpm *s, int group, field_id id, int c, const double *value)
{
    const edge_group *g = &s->edges->group[group];
    double *field[MESH_MAX_BLOCKS];
    for (int b = 0; b < s->mesh->n_blocks; ++b) field[b] = field_get(s->domain->fields[b], id, group, c);
    for (int n = 0; n < g->n_nodes; ++n) {
        const edge_copy *copy = g->copy + g->node[n].copy;
        for (size_t k = 0; k < g->node[n].copies; ++k) field[copy[k].block][copy[k].at] += value[n];
    }
}

void edges_values(const mpm *s, int group, field_id id, int c, double *value)
{
    const edge_group *g = &s->edges->group[group];
    const double *field[MESH_MAX_BLOCKS];
    for (int b = 0; b < s->mesh->n_blocks; ++b) field[b] = field_get(s->domain->fields[b], id, group, c);
    for (int n = 0; n < g->n_nodes; ++n) {
        const edge_copy *own = g->copy + g->node[n].copy;
        value[n] = field[own->block][own->at];
    }
}

static floe_status push_group(mpm *s, int group)
{
    const edge_group *g = &s->edges->group[group];
    double *force;
    TRY(edges_scratch(s, g, 1, &force));
    for (int c = 0; c < s->mesh->dim; ++c) {
        edge_giving given = {.walls = 0.0};
        edges_push(s, g, c, force);
        edges_add_to_copies(s, group, N_FORCE, c, force);
        for (size_t k = 0; k < g->n_lines; ++k)
            if (g->line[k].images) edges_give(s, g, &g->line[k], c, false, tension_of(s, g, k, c), &given);
        edges_enter(s, c, &given);
    }
    return FLOE_OK;
}

floe_status mpm_edge_force(mpm *s)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        TRY(edges_find(s, g, false));
        if (s->scene->method.stress == STRESS_USF) TRY(edges_strain(s, g, N_VEL));
        TRY(push_group(s, g));
    }
    return FLOE_OK;
}

void edges_let_flow(const mpm *s, edge_group *g)
{
    const size_t dim = (size_t)s->mesh->dim;
    for (size_t k = 0; k < g->n_lines; ++k) {
        double *difference = g->next + k * dim, square = 0.0;
        for (size_t c = 0; c < dim; ++c) square += difference[c] * difference[c];
        const double length = sqrt(square), most = g->line[k].most;
        g->line[k].kept = length > most ? most / length : 1.0;
        for (size_t c = 0; c < dim && length > most; ++c) difference[c] *= g->line[k].kept;
    }
}

floe_status edges_strain(mpm *s, int group, field_id velocity)
{
    mpm_edges *e = s->edges;
    edge_group *g = &e->group[group];
    const double dt = strain_step(s);
    const int dim = s->mesh->dim;
    double *v;
    TRY(edges_scratch(s, g, 1, &v));
    for (int c = 0; c < dim; ++c) {
        edges_values(s, group, velocity, c, v);
        for (size_t k = 0; k < g->n_lines; ++k)
            g->next[k * (size_t)dim + (size_t)c] =
                e->memory[g->line[k].slot + (size_t)c] + dt * edge_difference(&g->line[k], c, v);
    }
    edges_let_flow(s, g);
    return FLOE_OK;
}

static void commit_group(mpm *s, int group)
{
    mpm_edges *e = s->edges;
    const edge_group *g = &e->group[group];
    const size_t dim = (size_t)s->mesh->dim;
    for (size_t k = 0; k < g->n_lines; ++k)
        memcpy(e->memory + g->line[k].slot, g->next + k * dim, dim * sizeof *g->next);
    for (int n = 0; n < g->n_nodes; ++n)
        for (size_t c = 0; c < dim; ++c)
            e->memory[g->node[n].slot + c] = g->accelerated[c * (size_t)g->n_nodes + (size_t)n];
    e->memory[e->travel + (size_t)group] = g->travelled;
    e->memory[e->loaded_nodes + (size_t)group] = g->loaded_nodes;
}

void edges_commit(mpm *s)
{
    for (int g = 0; s->edges && g < s->n_deforming_groups; ++g) commit_group(s, g);
}

const double *edges_history(const mpm *s, size_t *n)
{
    *n = s->edges ? s->edges->n_memory : 0;
    return s->edges ? s->edges->memory : NULL;
}

double *mpm_edges_state(mpm *s, size_t *n)
{
    mpm_edges *e = s->edges;
    *n = e ? e->n_memory : 0;
    for (int g = 0; e && g < s->n_deforming_groups; ++g) e->group[g].listed = false; /* who asks may write there */
    return e ? e->memory : NULL;
}

/* Steps of the trapezoidal rule (Newmark's with constant mean acceleration): the balance of implicit.h with inertia.
 * Second order in the step, stable at any, and without damping of its own.
 *
 *     f_ext(t + dt/2) + (f(0) + f(u)) / 2 = m (2/dt) (u/dt - v) + c m u/dt,     v' = 2 u/dt - v,
 *
 * f the forces of the points, v and m of the nodes as the points bring them, c the deck's damping. */
#include "mpm/implicit/implicit.h"
#include "mpm/nodes/supports.h"
#include "mpm/transfer/scratch.h"

#include <string.h>

/* The node fields of the blocks, as the solver's arrays: collected as forces are. Nodes of supports that move have the velocity of these. */
void motion_begin(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    memset(w->velocity, 0, w->components * sizeof *w->velocity);
    memset(w->mass, 0, w->components * sizeof *w->mass);
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        implicit_collect(s, N_MOMENTUM, g, w->velocity);
        implicit_collect(s, N_MASS, g, w->mass);
    }
    for (size_t k = 0; k < w->components; ++k) {
        const double m = w->mass[k % w->grid.size];
        w->velocity[k] = m > 0.0 ? w->velocity[k] / m : 0.0;
    }
    for (size_t n = 0; n < s->supports->n; ++n) {
        const support_node *node = &s->supports->node[n];
        const int at = (int)solve_index(&w->grid, node->node[0], node->node[1], node->node[2]);
        for (int c = 0; c < s->mesh->dim && support_moves(s, node->support); ++c)
            for (int l = 0; l < w->layers; ++l)
                w->velocity[implicit_index(w, l, c, at)] = support_velocity(s, node->support)[c];
    }
}

/* Nodes keep their velocity; constrained components take the prescribed displacement. */
void motion_guess(const mpm *s, double *u)
{
    const struct mpm_implicit *w = s->implicit;
    for (size_t k = 0; k < w->components; ++k)
        u[k] = w->constrained[k] ? w->prescribed[k] : w->reached[k] ? s->dt * w->velocity[k] : 0.0;
}

/* Rate (1/s) of the deck's damping in the step. */
static double motion_damping(const mpm *s)
{
    const scene_damping *d = &s->scene->damping;
    return s->time >= d->start && s->time < d->end ? d->rate : 0.0;
}

double motion_force(const mpm *s, size_t k, double u)
{
    const struct mpm_implicit *w = s->implicit;
    const double v = u / s->dt;
    return w->mass[k % w->grid.size] * (2.0 / s->dt * (v - w->velocity[k]) + motion_damping(s) * v);
}

/* Half the stiffness of the points, and the inertia of the nodes. */
void motion_stiffen(const mpm *s, node_matrix *m)
{
    const struct mpm_implicit *w = s->implicit;
    const double rate = 2.0 / (s->dt * s->dt) + motion_damping(s) / s->dt;
    const size_t entries = (size_t)m->slots * (size_t)m->components * (size_t)m->components;
    for (size_t k = 0; k < (size_t)m->rows * entries; ++k) m->value[k] *= 0.5;
    for (int row = 0; row < m->rows; ++row)
        for (int c = 0; c < m->components; ++c)
            node_matrix_entries(m, row, c, c)[m->slots / 2] += rate * w->mass[m->place[row]];
}

double motion_velocity(const mpm *s, size_t k)
{
    return 2.0 * s->implicit->u[k] / s->dt - s->implicit->velocity[k];
}

static void add_brought(mpm *s, int blk, int tile, void *user, double *sum)
{
    const struct mpm_implicit *w = user;
    const fields *f = s->domain->fields[blk];
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        const double *mass = field_get(f, P_MASS, body, 0);
        for (size_t k = range[0]; k < range[1]; ++k)
            for (int c = 0; c < s->mesh->dim && w->weights[w->first[blk][body] + k].support < 0; ++c)
                sum[c] += mass[k] * field_get(f, P_VEL, body, c)[k];
    }
}

/* Momentum (N s) that led nodes give points beyond what these brought: the share of PIC (theory 4.13). `mass`: by component. */
static void find_led_momentum(mpm *s, const double *mass, double out[MESH_MAX_DIM])
{
    const struct mpm_implicit *w = s->implicit;
    double brought[MESH_MAX_DIM];
    for (int c = 0; c < MESH_MAX_DIM; ++c) out[c] = 0.0;
    if (!w->led) return;
    sum_over_tiles(s, MESH_MAX_DIM, add_brought, s->implicit, brought);
    for (int c = 0; c < s->mesh->dim; ++c) {
        for (size_t i = 0; i < w->grid.size; ++i)
            out[c] += mass[(size_t)c * w->grid.size + i] * w->velocity[(size_t)c * w->grid.size + i];
        out[c] = (1.0 - s->share) * (out[c] - brought[c]);
    }
}

/* Impulses and work of loads, damping and constraints. */
void motion_enter(mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    double *share = w->trial, work = 0.0, damped = 0.0, constraint_work = 0.0;
    const double rate = motion_damping(s);
    double pushes[3] = {0.0}, losses[3] = {0.0}, gains[3] = {0.0}, x[MESH_MAX_DIM], led[MESH_MAX_DIM];
    bool any_walls = false;
    memset(share, 0, w->components * sizeof *share);
    implicit_node_mass(s, share);
    find_led_momentum(s, share, led);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const ledger_quantity q = (ledger_quantity)(LEDGER_MOMENTUM_X + c);
        double gained = led[c], gas_force = 0.0, slowed = 0.0;
        bool walls = false;
        for (size_t i = 0; i < w->grid.size; ++i) {
            const size_t k = (size_t)c * w->grid.size + i;
            const double displacement = w->u[k], loss = rate * w->mass[i] * displacement;
            const double gain = share[k] * (motion_velocity(s, k) - w->velocity[k]), push = s->dt * w->external[k];
            gained += gain;
            gas_force += push;
            if (gain != 0.0 || push != 0.0 || loss != 0.0) {
                implicit_place(s, i, x);
                add_moment(gains, x, c, gain);
                add_moment(pushes, x, c, push);
                add_moment(losses, x, c, loss);
            }
            slowed += loss;
            work += w->external[k] * displacement;
            damped += loss * displacement / s->dt;
            walls = walls || w->constrained[k];
            if (w->constrained[k])
                constraint_work += displacement * (motion_force(s, k, displacement) - w->external[k] -
                                                   0.5 * (w->internal_first[k] + w->internal[k]));
        }
        ledger_add(s->ledger, q, LEDGER_SOURCE, gas_force);
        ledger_add(s->ledger, q, LEDGER_DAMPING, -slowed);
        if (walls) ledger_add(s->ledger, q, LEDGER_BOUNDARY, gained - gas_force + slowed);
        any_walls = any_walls || walls;
    }
    ledger_turn(s->ledger, LEDGER_SOURCE, pushes, 1.0);
    ledger_turn(s->ledger, LEDGER_DAMPING, losses, -1.0);
    if (any_walls)
        for (int a = 0; a < 3; ++a)
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENT_X + a), LEDGER_BOUNDARY,
                       gains[a] - pushes[a] + losses[a]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, work);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, -damped);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, constraint_work);
}

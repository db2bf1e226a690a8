/* Shape functions at the points, including the folds at walls. */
#include "base/memory.h"
#include "mpm/implicit/implicit.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/support_points.h"
#include "mpm/nodes/supports.h"
#include "mpm/transfer/point_arrays.h"

#include <string.h>

static void add_node_weights(axis_weights *p, int node, double even, double odd, double even_slope, double odd_slope)
{
    const int k = node - p->first;
    p->plain[k] += even;
    p->turned[k] += odd;
    p->plain_slope[k] += even_slope;
    p->turned_slope[k] += odd_slope;
}

/* Folds the weight of a ghost node beyond a side into the node on the wall and the first one inside (wall.c). */
static void fold_ghost_weights(const mpm *s, axis_weights *p, int axis, int side, double w, double dw)
{
    const int wall = side == SIDE_LOWER ? 0 : s->mesh->n[axis], inside = wall + (side == SIDE_LOWER ? 1 : -1);
    if (wall_mirrors(s, 0, axis, side)) {
        add_node_weights(p, inside, w, -w, dw, -dw);
        return;
    }
    add_node_weights(p, wall, 2.0 * w, 2.0 * w, 2.0 * dw, 2.0 * dw);
    add_node_weights(p, inside, -w, -w, -dw, -dw);
}

static void locate_axis(const mpm *s, int axis, double x, double half, axis_weights *out)
{
    const mesh *m = s->mesh;
    const double inv_h = 1.0 / m->h[axis];
    const int n = m->n[axis], support = s->basis->support;
    int cell = mesh_cell_of(m, axis, x);
    cell = cell < 0 ? 0 : cell >= n ? n - 1 : cell;
    double w[BASIS_MAX_SUPPORT], dw[BASIS_MAX_SUPPORT];
    const int first = cell + s->basis->weights((x - mesh_node(m, axis, cell)) * inv_h, half * inv_h, inv_h, w, dw);
    *out = (axis_weights){.first = first};
    if (!m->periodic[axis]) {
        if (out->first + support > n + 1) out->first = n + 1 - support;
        if (out->first < 0) out->first = 0;
    }
    for (int k = 0; k < support; ++k) {
        const int node = first + k;
        if (!m->periodic[axis] && node < 0)
            fold_ghost_weights(s, out, axis, SIDE_LOWER, w[k], dw[k]);
        else if (!m->periodic[axis] && node > n)
            fold_ghost_weights(s, out, axis, SIDE_UPPER, w[k], dw[k]);
        else
            add_node_weights(out, node, w[k], w[k], dw[k], dw[k]);
    }
}

static floe_status reserve_weights(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    w->points = 0;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) {
            w->first[b][body] = w->points;
            if (!s->body[body].fluid) w->points += s->points[b][body].n;
        }
    if (w->points <= w->points_reserved) return FLOE_OK;
    w->points_reserved = w->points;
    const size_t n = (size_t)w->n_gradient;
    TRY(memory_resize(s->ctx, &w->weights, w->points_reserved, sizeof *w->weights));
    TRY(memory_resize(s->ctx, &w->point_force, w->points_reserved, n * sizeof(double)));
    return memory_resize(s->ctx, &w->tangent, w->points_reserved, n * n * sizeof(double));
}

point_weights implicit_weights_at(const mpm *s, const double x[3])
{
    point_weights out = {.radius = x[0], .support = -1};
    for (int a = 0; a < s->mesh->dim; ++a) locate_axis(s, a, x[a], 0.25 * s->mesh->h[a], &out.axis[a]);
    return out;
}

static int support_of_point(const mpm *s, const point_arrays *p, long long k)
{
    double x[MESH_MAX_DIM] = {0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = p->x[a][k];
    return support_with(s, x);
}

floe_status implicit_locate(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    TRY(reserve_weights(s));
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) {
            if (s->body[body].fluid) continue;
            const point_arrays p = points_of(s, b, body, false, false);
            point_weights *place = w->weights + w->first[b][body];
            const long long n = (long long)s->points[b][body].n;
            const bool takes = supports_take_points(s, body);
#pragma omp parallel for schedule(static)
            for (long long k = 0; k < n; ++k) {
                for (int a = 0; a < s->mesh->dim; ++a)
                    locate_axis(s, a, p.x[a][k], p.half[a] ? p.half[a][k] : 0.25 * s->mesh->h[a], &place[k].axis[a]);
                place[k].radius = p.x[0][k];
                place[k].support = takes ? support_of_point(s, &p, k) : -1;
            }
        }
    return FLOE_OK;
}

weighted_node scaled_node(const weighted_node *node, double factor)
{
    weighted_node out = *node;
    for (int c = 0; c < MESH_MAX_DIM; ++c) {
        out.S[c] *= factor;
        for (int a = 0; a < MESH_MAX_DIM; ++a) out.slope[c][a] *= factor;
    }
    return out;
}

int implicit_width(const mpm *s)
{
    return s->basis->support - 1 + supports_widen(s);
}

/* Takes the place of a node some nodes on, less a number of steps. */
static void go_from(const mpm *s, weighted_node *node, const int to[MESH_MAX_DIM], const int way[MESH_MAX_DIM],
                    int less)
{
    for (int a = 0; a < s->mesh->dim; ++a) node->node[a] += way[a] - less * ((way[a] > 0) - (way[a] < 0));
    node->at = (int)solve_index(&s->implicit->grid, to[0], to[1], to[2]);
}

/* A led node moves by a share as its master, by the rest as its support: as the node before the master, which is led or constrained, too. */
static int share_led_nodes(const mpm *s, weighted_node node[IMPLICIT_NODES], int n)
{
    int all = n;
    for (int i = 0; i < n && s->implicit->led; ++i) {
        const int place = s->implicit->led[node[i].at];
        if (place == 0) continue;
        const support_node *led = &s->supports->node[place - 1];
        if (support_moves(s, led->support)) {
            node[all] = scaled_node(&node[i], 1.0 - led->share);
            go_from(s, &node[all++], led->anchor, led->way, 1);
        }
        node[i] = scaled_node(&node[i], led->share);
        go_from(s, &node[i], led->master, led->way, 0);
    }
    return all;
}

int implicit_nodes(const mpm *s, const point_weights *p, weighted_node out[IMPLICIT_NODES])
{
    const int dim = s->mesh->dim, support = s->basis->support;
    const solve_grid *g = &s->implicit->grid;
    int count[MESH_MAX_DIM] = {1, 1, 1}, n = 0;
    for (int a = 0; a < dim; ++a) count[a] = p->support < 0 ? support : 0;
    for (int k = 0; k < count[2]; ++k)
        for (int j = 0; j < count[1]; ++j)
            for (int i = 0; i < count[0]; ++i) {
                const int local[MESH_MAX_DIM] = {i, j, k};
                int at[MESH_MAX_DIM] = {0, 0, 0};
                weighted_node *node = &out[n++];
                memset(node->node, 0, sizeof node->node);
                for (int a = 0; a < dim; ++a) {
                    at[a] = node->node[a] = p->axis[a].first + local[a];
                    if (g->periodic[a]) at[a] = (at[a] + g->n[a]) % g->n[a];
                }
                node->at = (int)solve_index(g, at[0], at[1], at[2]);
                for (int c = 0; c < dim; ++c) {
                    node->S[c] = 1.0;
                    for (int a = 0; a < dim; ++a) node->slope[c][a] = 1.0;
                    for (int a = 0; a < dim; ++a) {
                        const axis_weights *x = &p->axis[a];
                        const double w = a == c ? x->turned[local[a]] : x->plain[local[a]];
                        const double dw = a == c ? x->turned_slope[local[a]] : x->plain_slope[local[a]];
                        node->S[c] *= w;
                        for (int d = 0; d < dim; ++d) node->slope[c][d] *= d == a ? dw : w;
                    }
                }
            }
    return share_led_nodes(s, out, n);
}

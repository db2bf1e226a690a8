/* Points between the nodes' displacements and the nodes' forces. */
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_chunks.h"
#include "mpm/implicit/implicit_volume.h"
#include "mpm/state/stress.h"
#include "mpm/transfer/point_arrays.h"

#include <math.h>
#include <string.h>

/* det f - 1 and V (det f) f^-T of points that share it. */
static floe_status growth_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_volume *v = w->volume;
    gradient_rows G;
    (void)b;
    if (!implicit_shares_volume(s, body)) return FLOE_OK;
    gather_chunk(s, blk, body, start, end, u, G);
    for (size_t k = start; k < end; ++k) {
        const size_t number = w->first[blk][body] + k;
        double g[9];
        for (int c = 0; c < 9; ++c) g[c] = G[c][k - start];
        v->shared[number] = growth_of(g);
        chunk_cofactor(s, G, k - start, v->volume[number], v->cofactor + number * (size_t)w->n_gradient);
    }
    return FLOE_OK;
}

static floe_status strain_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    const double *shared = chunk_shared(s, blk, body, start);
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    const size_t bad = chunk_law(s, blk, body, start, end, G, shared, b);
    if (bad) return refuse_chunk(s, blk, body, start + bad - 1);
    for (size_t k = start; k < end; ++k) {
        const size_t number = w->first[blk][body] + k;
        const double mean = shared ? chunk_mean_stress(s, b, k - start) : 0.0;
        if (shared) w->volume->own_stress[number] = w->volume->shared_stress[number] = mean;
        chunk_point_force(s, b, k - start, G, mean, volume0[k], w->point_force + number * (size_t)w->n_gradient);
    }
    store_batch(s, blk, body, start, b);
    return FLOE_OK;
}

/* Adds what the points' shared stress gives. */
static floe_status share_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const size_t n = (size_t)w->n_gradient;
    (void)u;
    (void)b;
    for (size_t k = start; k < end && implicit_shares_volume(s, body); ++k) {
        const size_t number = w->first[blk][body] + k;
        for (size_t c = 0; c < n; ++c)
            w->point_force[number * n + c] += w->volume->shared_stress[number] * w->volume->cofactor[number * n + c];
    }
    return FLOE_OK;
}

floe_status implicit_strain(mpm *s, const double *u)
{
    struct implicit_volume *v = s->implicit->volume;
    if (!v) return visit_chunks(s, u, strain_chunk);
    TRY(visit_chunks(s, u, growth_chunk));
    implicit_project_volumes(s, v->shared);
    TRY(visit_chunks(s, u, strain_chunk));
    implicit_project_volumes(s, v->shared_stress);
    return visit_chunks(s, u, share_chunk);
}

/* Adds what the points of a tile give to the nodes. */
static void internal_force_of_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_implicit *w = s->implicit;
    double *internal = user;
    const int dim = s->mesh->dim;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        for (size_t k = range[0]; k < range[1]; ++k) {
            const size_t number = w->first[blk][body] + k;
            double T[IMPLICIT_GRADIENTS] = {0.0};
            weighted_node node[IMPLICIT_NODES];
            const int n = implicit_nodes(s, &w->weights[number], node);
            for (int c = 0; c < w->n_gradient; ++c)
                T[w->gradient[c]] = w->point_force[number * (size_t)w->n_gradient + (size_t)c];
            const double hoop = s->mesh->geometry == MESH_AXISYMMETRIC ? T[8] / w->weights[number].radius : 0.0;
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < dim; ++c) {
                    double sum = c == 0 ? hoop * node[i].S[0] : 0.0;
                    for (int a = 0; a < dim; ++a) sum += T[3 * c + a] * node[i].slope[c][a];
                    internal[implicit_index(w, w->layer[body], c, node[i].at)] -= sum;
                }
        }
    }
}

void implicit_internal_force(mpm *s, double *internal)
{
    memset(internal, 0, s->implicit->components * sizeof *internal);
    implicit_for_tiles(s, internal_force_of_tile, internal);
}

typedef struct body_force_sum {
    double *out;
    double (*acceleration)[3]; /* m/s2, of each body; NULL: 1 */
    bool drive;                /* with the force of an exact solution on top */
} body_force_sum;

static double body_force_of(const body_force_sum *w, const point_arrays *p, int body, size_t k, int c)
{
    return w->acceleration[body][c] + (w->drive && p->drive[c] ? p->drive[c][k] : 0.0);
}

static void body_force_of_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_implicit *w = s->implicit;
    const body_force_sum *sum = user;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = range[0]; k < range[1]; ++k) {
            weighted_node node[IMPLICIT_NODES];
            const int n = implicit_nodes(s, &w->weights[w->first[blk][body] + k], node);
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < s->mesh->dim; ++c)
                    sum->out[implicit_index(w, w->layer[body], c, node[i].at)] +=
                        p.mass[k] * (sum->acceleration ? body_force_of(sum, &p, body, k, c) : 1.0) * node[i].S[c];
        }
    }
}

void implicit_body_force(mpm *s, double (*acceleration)[3], bool drive, double *external)
{
    implicit_for_tiles(s, body_force_of_tile, &(body_force_sum){external, acceleration, drive});
}

void implicit_node_mass(mpm *s, double *share)
{
    implicit_for_tiles(s, body_force_of_tile, &(body_force_sum){share, NULL, false});
}

static void squeeze_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_implicit *w = s->implicit;
    const fields *f = s->domain->fields[blk];
    double *out = user;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        const double *volume0 = field_get(f, P_VOLUME0, body, 0), *J = field_get(f, P_J, body, 0);
        for (size_t k = range[0]; k < range[1]; ++k) {
            const point_weights *place = &w->weights[w->first[blk][body] + k];
            const double volume = volume0[k] * J[k];
            const double hoop = s->mesh->geometry == MESH_AXISYMMETRIC ? volume / place->radius : 0.0;
            weighted_node node[IMPLICIT_NODES];
            const int n = implicit_nodes(s, place, node);
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < s->mesh->dim; ++c)
                    out[implicit_index(w, w->layer[body], c, node[i].at)] -=
                        volume * node[i].slope[c][c] + (c == 0 ? hoop * node[i].S[0] : 0.0);
        }
    }
}

void implicit_volume_gradient(mpm *s, double *out)
{
    implicit_for_tiles(s, squeeze_tile, out);
}

/* A component of a point's velocity after the step: none at rest. */
static double next_velocity(const mpm *s, const weighted_node *node, int nodes, int c, double before)
{
    const struct mpm_implicit *w = s->implicit;
    double now = 0.0, change = 0.0;
    if (!w->mass) return 0.0;
    for (int i = 0; i < nodes; ++i) {
        const size_t k = (size_t)c * w->grid.size + (size_t)node[i].at;
        const double v = motion_velocity(s, k);
        now += node[i].S[c] * v;
        change += node[i].S[c] * (v - w->velocity[k]);
    }
    return s->share * (before + change) + (1.0 - s->share) * now;
}

/* Cells that a point may move in an increment. With contact, bodies that share no node yet must not pass through each
 * other: their points are more than half a cell apart then. */
static double largest_displacement(const mpm *s)
{
    return s->contact ? 0.25 : 1.0;
}

/* Points of supports move with them. */
static floe_status move_supported_point(mpm *s, int blk, int body, size_t k, int support)
{
    const fields *f = s->domain->fields[blk];
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double v = s->scene->support[support].velocity[c];
        field_next(f, P_POS, body, c)[k] = field_get(f, P_POS, body, c)[k] + s->dt * v;
        field_next(f, P_VEL, body, c)[k] = s->implicit->mass ? v : 0.0;
    }
    return FLOE_OK;
}

static floe_status move_implicit_point(mpm *s, int blk, int body, size_t k)
{
    const struct mpm_implicit *w = s->implicit;
    const fields *f = s->domain->fields[blk];
    const int support = w->weights[w->first[blk][body] + k].support;
    if (support >= 0) return move_supported_point(s, blk, body, k, support);
    weighted_node node[IMPLICIT_NODES];
    const int n = implicit_nodes(s, &w->weights[w->first[blk][body] + k], node);
    for (int c = 0; c < s->mesh->dim; ++c) {
        double displacement = 0.0;
        for (int i = 0; i < n; ++i)
            displacement += node[i].S[c] * w->u[implicit_index(w, w->layer[body], c, node[i].at)];
        if (!(fabs(displacement) <= largest_displacement(s) * s->mesh->h[c]))
            return fail(s->ctx, FLOE_RETRY, "a point of body '%s' would go farther than %s in one load increment",
                        s->scene->body[s->body[body].scene_body].name,
                        s->contact ? "a quarter of a cell, beside bodies in contact," : "a cell");
        field_next(f, P_POS, body, c)[k] = field_get(f, P_POS, body, c)[k] + displacement;
        field_next(f, P_VEL, body, c)[k] = next_velocity(s, node, n, c, field_get(f, P_VEL, body, c)[k]);
    }
    return FLOE_OK;
}

floe_status implicit_move(mpm *s)
{
    const int gradients = s->mesh->dim * s->mesh->dim;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) {
            const fields *f = s->domain->fields[b];
            const size_t n = s->points[b][body].n;
            for (size_t k = 0; k < n && !s->body[body].fluid; ++k) TRY(move_implicit_point(s, b, body, k));
            if (fields_has(f, P_TEMP, body)) /* nothing warms it in a step */
                memcpy(field_next(f, P_TEMP, body, 0), field_get(f, P_TEMP, body, 0), n * sizeof(double));
            for (int c = 0; fields_has(f, P_AFFINE, body) && c < gradients; ++c)
                memset(field_next(f, P_AFFINE, body, c), 0, n * sizeof(double));
        }
    for (size_t t = 0; t < mesh_tiles(s->mesh); ++t) s->moved[t] = UINT32_MAX; /* the order is made anew */
    return FLOE_OK;
}

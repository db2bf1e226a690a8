/* Points between the nodes' displacements and the nodes' forces. */
#include "base/threads.h"
#include "math/tensor.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/state/stress.h"
#include "mpm/thermal/thermal_stress.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

typedef double gradient_rows[IMPLICIT_GRADIENTS][SOLID_CHUNK];

/* grad u of a point, all nine components; those that the scene does not have are 0. */
static void displacement_gradient(const mpm *s, const double *u, int layer, const point_weights *p,
                                  double G[IMPLICIT_GRADIENTS])
{
    const struct mpm_implicit *w = s->implicit;
    const int dim = s->mesh->dim;
    weighted_node node[IMPLICIT_NODES];
    const int n = implicit_nodes(s, p, node);
    memset(G, 0, IMPLICIT_GRADIENTS * sizeof *G);
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < dim; ++c) {
            const double value = u[implicit_index(w, layer, c, node[i].at)];
            for (int a = 0; a < dim; ++a) G[3 * c + a] += value * node[i].slope[c][a];
            if (c == 0 && s->mesh->geometry == MESH_AXISYMMETRIC) G[8] += value * node[i].S[0] / p->radius;
        }
}

/* The inverse of I + G; returns its determinant. */
static double invert_deformation(const double G[9], double inverse[9])
{
    double F[9];
    for (int k = 0; k < 9; ++k) F[k] = G[k] + (k % 4 == 0 ? 1.0 : 0.0);
    return tensor_inverse(F, inverse);
}

/* F and J at the end of the increment, and the rate over it that laws in rate form take: grad u at its middle, so that
 * the rotations of Hughes and Winget (1980) are exact. A time of 1 s. */
static void set_increment(solid_batch *b, size_t k, const double G[9])
{
    double half[9], middle[9], unused[9], F[9], old[9];
    for (int c = 0; c < 9; ++c) half[c] = 0.5 * G[c];
    (void)invert_deformation(half, middle);
    b->J[k] = b->J_old[k] * invert_deformation(G, unused);
    for (int c = 0; c < 9; ++c) old[c] = b->F[c][k];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double rate = 0.0, stretched = old[3 * i + j];
            for (int l = 0; l < 3; ++l) {
                rate += G[3 * i + l] * middle[3 * l + j];
                stretched += G[3 * i + l] * old[3 * l + j];
            }
            b->L[3 * i + j][k] = rate;
            F[3 * i + j] = stretched;
        }
    for (int c = 0; c < 9; ++c) b->F[c][k] = F[c];
}

/* The law at these gradients, from the state at the start of the increment. 0, or 1 + the first point beyond it. */
static size_t run_law(const mpm *s, int blk, int body, size_t start, size_t end, gradient_rows G, solid_batch *b)
{
    const mpm_body *m = &s->body[body];
    load_batch(s, blk, body, start, end, false, b);
    b->dt = 1.0;
    memset(b->q, 0, sizeof b->q);
    for (size_t k = 0; k < b->n; ++k) {
        double g[9];
        for (int c = 0; c < 9; ++c) g[c] = G[c][k];
        set_increment(b, k, g);
        if (!(b->J[k] > 0.0)) return 1 + k;
    }
    thermal_batch thermal;
    if (m->warms) begin_thermal_stress(s, blk, body, start, b, &thermal);
    const size_t bad = solid_stress_state(m->law, m->law_par, s->scene->reference_pressure, s->scene->stress_state, b);
    if (m->warms && !bad) end_thermal_stress(s, blk, body, start, b, &thermal);
    return bad;
}

/* V0 T of point k of a batch, at the components that the scene has. */
static void point_force_of(const mpm *s, const solid_batch *b, size_t k, gradient_rows G, double volume0, double *out)
{
    static const int symmetric[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double g[9], inverse[9];
    for (int c = 0; c < 9; ++c) g[c] = G[c][k];
    (void)invert_deformation(g, inverse);
    const double volume = volume0 * b->J[k];
    for (int n = 0; n < s->implicit->n_gradient; ++n) {
        const int i = s->implicit->gradient[n] / 3, j = s->implicit->gradient[n] % 3;
        double sum = 0.0;
        for (int l = 0; l < 3; ++l) sum += b->stress[symmetric[3 * i + l]][k] * inverse[3 * j + l];
        out[n] = volume * sum;
    }
}

static floe_status refuse_displacement(const mpm *s, int blk, int body, size_t point)
{
    const fields *f = s->domain->fields[blk];
    double x[3] = {0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[point];
    return fail(s->ctx, FLOE_RETRY, "a point of body '%s' at (%g, %g, %g) would be beyond its law %s",
                s->scene->body[s->body[body].scene_body].name, x[0], x[1], x[2], s->body[body].law->name);
}

/* What is done with a chunk of a body's points. */
typedef floe_status chunk_visit(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b);

static floe_status for_chunks(mpm *s, const double *u, chunk_visit *visit)
{
    floe_status worst = FLOE_OK;
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk)
        for (int body = 0; body < s->n_bodies; ++body) {
            if (s->body[body].fluid) continue;
            const size_t n = s->points[blk][body].n;
            const int chunks = (int)((n + SOLID_CHUNK - 1) / SOLID_CHUNK);
#pragma omp parallel for schedule(dynamic, 4)
            for (int c = 0; c < chunks; ++c) {
                const size_t start = (size_t)c * SOLID_CHUNK, end = start + SOLID_CHUNK < n ? start + SOLID_CHUNK : n;
                const floe_status status = visit(s, blk, body, start, end, u, &s->scratch->batch[thread_number()]);
                if (status != FLOE_OK) {
#pragma omp atomic write
                    worst = status;
                }
            }
        }
    return worst;
}

static void gather_chunk(const mpm *s, int blk, int body, size_t start, size_t end, const double *u, gradient_rows G)
{
    const point_weights *place = s->implicit->weights + s->implicit->first[blk][body];
    for (size_t k = start; k < end; ++k) {
        double g[IMPLICIT_GRADIENTS];
        displacement_gradient(s, u, s->implicit->layer[body], &place[k], g);
        for (int c = 0; c < 9; ++c) G[c][k - start] = g[c];
    }
}

static floe_status strain_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    const size_t bad = run_law(s, blk, body, start, end, G, b);
    if (bad) return refuse_displacement(s, blk, body, start + bad - 1);
    for (size_t k = start; k < end; ++k)
        point_force_of(s, b, k - start, G, volume0[k],
                       w->point_force + (w->first[blk][body] + k) * (size_t)w->n_gradient);
    store_batch(s, blk, body, start, b);
    return FLOE_OK;
}

floe_status implicit_strain(mpm *s, const double *u)
{
    return for_chunks(s, u, strain_chunk);
}

static floe_status tangent_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const size_t n = (size_t)w->n_gradient, first = w->first[blk][body];
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    for (size_t c = 0; c < n; ++c) {
        double *row = G[w->gradient[c]];
        for (size_t k = 0; k < end - start; ++k) row[k] += MPM_TANGENT_DIFFERENCE;
        const size_t bad = run_law(s, blk, body, start, end, G, b);
        if (bad) return refuse_displacement(s, blk, body, start + bad - 1);
        for (size_t k = start; k < end; ++k) {
            double force[IMPLICIT_GRADIENTS];
            const double *before = w->point_force + (first + k) * n;
            double *tangent = w->tangent + (first + k) * n * n;
            point_force_of(s, b, k - start, G, volume0[k], force);
            for (size_t r = 0; r < n; ++r) tangent[r * n + c] = (force[r] - before[r]) / MPM_TANGENT_DIFFERENCE;
        }
        for (size_t k = 0; k < end - start; ++k) row[k] -= MPM_TANGENT_DIFFERENCE;
    }
    for (size_t k = start; k < end; ++k) {
        double *tangent = w->tangent + (first + k) * n * n;
        for (size_t r = 0; r < n; ++r)
            for (size_t c = 0; c < r; ++c)
                tangent[r * n + c] = tangent[c * n + r] = 0.5 * (tangent[r * n + c] + tangent[c * n + r]);
    }
    return FLOE_OK;
}

floe_status implicit_tangents(mpm *s, const double *u)
{
    return for_chunks(s, u, tangent_chunk);
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

static floe_status move_point(mpm *s, int blk, int body, size_t k)
{
    const struct mpm_implicit *w = s->implicit;
    const fields *f = s->domain->fields[blk];
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
            for (size_t k = 0; k < n && !s->body[body].fluid; ++k) TRY(move_point(s, b, body, k));
            if (fields_has(f, P_TEMP, body)) /* nothing warms it in a step */
                memcpy(field_next(f, P_TEMP, body, 0), field_get(f, P_TEMP, body, 0), n * sizeof(double));
            for (int c = 0; fields_has(f, P_AFFINE, body) && c < gradients; ++c)
                memset(field_next(f, P_AFFINE, body, c), 0, n * sizeof(double));
        }
    for (size_t t = 0; t < mesh_tiles(s->mesh); ++t) s->moved[t] = UINT32_MAX; /* the order is made anew */
    return FLOE_OK;
}

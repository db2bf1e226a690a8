/* Points between the nodes' displacements and the nodes' forces. */
#include "base/threads.h"
#include "math/tensor.h"
#include "mpm/balance/balance.h"

#include <math.h>
#include <string.h>

typedef double gradient_rows[BALANCE_GRADIENTS][SOLID_CHUNK];

/* grad u of a point, all nine components; those that the scene has not stay 0. */
static void gather(const mpm *s, const double *u, int layer, const point_place *p, double G[BALANCE_GRADIENTS])
{
    const struct mpm_balance *w = s->balance;
    const int dim = s->mesh->dim;
    place_node node[BALANCE_NODES];
    const int n = balance_nodes(s, p, node);
    memset(G, 0, BALANCE_GRADIENTS * sizeof *G);
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < dim; ++c) {
            const double value = u[balance_at(w, layer, c, node[i].at)];
            for (int a = 0; a < dim; ++a) G[3 * c + a] += value * node[i].slope[c][a];
            if (c == 0 && s->mesh->geometry == MESH_AXISYMMETRIC) G[8] += value * node[i].S[0] / p->radius;
        }
}

/* The inverse of I + G; returns its determinant. */
static double invert(const double G[9], double inverse[9])
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
    (void)invert(half, middle);
    b->J[k] = b->J_old[k] * invert(G, unused);
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
    return solid_stress_state(m->law, m->law_par, s->scene->reference_pressure, s->scene->stress_state, b);
}

/* V0 T of point k of a batch, at the components that the scene has. */
static void pull_of(const mpm *s, const solid_batch *b, size_t k, gradient_rows G, double volume0, double *out)
{
    static const int symmetric[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double g[9], inverse[9];
    for (int c = 0; c < 9; ++c) g[c] = G[c][k];
    (void)invert(g, inverse);
    const double volume = volume0 * b->J[k];
    for (int n = 0; n < s->balance->n_gradient; ++n) {
        const int i = s->balance->gradient[n] / 3, j = s->balance->gradient[n] % 3;
        double sum = 0.0;
        for (int l = 0; l < 3; ++l) sum += b->stress[symmetric[3 * i + l]][k] * inverse[3 * j + l];
        out[n] = volume * sum;
    }
}

static floe_status beyond(const mpm *s, int blk, int body, size_t point)
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
                const floe_status status = visit(s, blk, body, start, end, u, &s->work->batch[thread_number()]);
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
    const point_place *place = s->balance->place + s->balance->first[blk][body];
    for (size_t k = start; k < end; ++k) {
        double g[BALANCE_GRADIENTS];
        gather(s, u, s->balance->layer[body], &place[k], g);
        for (int c = 0; c < 9; ++c) G[c][k - start] = g[c];
    }
}

static floe_status strain_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_balance *w = s->balance;
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    const size_t bad = run_law(s, blk, body, start, end, G, b);
    if (bad) return beyond(s, blk, body, start + bad - 1);
    for (size_t k = start; k < end; ++k)
        pull_of(s, b, k - start, G, volume0[k], w->pull + (w->first[blk][body] + k) * (size_t)w->n_gradient);
    store_batch(s, blk, body, start, b);
    return FLOE_OK;
}

floe_status balance_strain(mpm *s, const double *u)
{
    return for_chunks(s, u, strain_chunk);
}

static const double difference = 1e-7; /* of grad u: an error of as much of the tangent, far above round-off */

static floe_status tangent_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_balance *w = s->balance;
    const size_t n = (size_t)w->n_gradient, first = w->first[blk][body];
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    for (size_t c = 0; c < n; ++c) {
        double *row = G[w->gradient[c]];
        for (size_t k = 0; k < end - start; ++k) row[k] += difference;
        const size_t bad = run_law(s, blk, body, start, end, G, b);
        if (bad) return beyond(s, blk, body, start + bad - 1);
        for (size_t k = start; k < end; ++k) {
            double pull[BALANCE_GRADIENTS];
            const double *before = w->pull + (first + k) * n;
            double *tangent = w->tangent + (first + k) * n * n;
            pull_of(s, b, k - start, G, volume0[k], pull);
            for (size_t r = 0; r < n; ++r) tangent[r * n + c] = (pull[r] - before[r]) / difference;
        }
        for (size_t k = 0; k < end - start; ++k) row[k] -= difference;
    }
    for (size_t k = start; k < end; ++k) {
        double *tangent = w->tangent + (first + k) * n * n;
        for (size_t r = 0; r < n; ++r)
            for (size_t c = 0; c < r; ++c)
                tangent[r * n + c] = tangent[c * n + r] = 0.5 * (tangent[r * n + c] + tangent[c * n + r]);
    }
    return FLOE_OK;
}

floe_status balance_tangents(mpm *s, const double *u)
{
    return for_chunks(s, u, tangent_chunk);
}

/* Adds what the points of a tile give to the nodes. */
static void pull_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_balance *w = s->balance;
    double *inner = user;
    const int dim = s->mesh->dim;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        for (size_t k = range[0]; k < range[1]; ++k) {
            const size_t number = w->first[blk][body] + k;
            double T[BALANCE_GRADIENTS] = {0.0};
            place_node node[BALANCE_NODES];
            const int n = balance_nodes(s, &w->place[number], node);
            for (int c = 0; c < w->n_gradient; ++c)
                T[w->gradient[c]] = w->pull[number * (size_t)w->n_gradient + (size_t)c];
            const double hoop = s->mesh->geometry == MESH_AXISYMMETRIC ? T[8] / w->place[number].radius : 0.0;
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < dim; ++c) {
                    double sum = c == 0 ? hoop * node[i].S[0] : 0.0;
                    for (int a = 0; a < dim; ++a) sum += T[3 * c + a] * node[i].slope[c][a];
                    inner[balance_at(w, w->layer[body], c, node[i].at)] -= sum;
                }
        }
    }
}

void balance_pull(mpm *s, double *inner)
{
    memset(inner, 0, s->balance->components * sizeof *inner);
    balance_for_tiles(s, pull_tile, inner);
}

typedef struct weighing {
    double *out;
    double (*fall)[3]; /* m/s2, of each body; NULL: 1 */
    bool drive;        /* with the force of an exact solution on top */
} weighing;

static double fall_of(const weighing *w, const point_arrays *p, int body, size_t k, int c)
{
    return w->fall[body][c] + (w->drive && p->drive[c] ? p->drive[c][k] : 0.0);
}

static void weigh_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_balance *w = s->balance;
    const weighing *weigh = user;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *range = s->points[blk][body].tile_start + tile;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = range[0]; k < range[1]; ++k) {
            place_node node[BALANCE_NODES];
            const int n = balance_nodes(s, &w->place[w->first[blk][body] + k], node);
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < s->mesh->dim; ++c)
                    weigh->out[balance_at(w, w->layer[body], c, node[i].at)] +=
                        p.mass[k] * (weigh->fall ? fall_of(weigh, &p, body, k, c) : 1.0) * node[i].S[c];
        }
    }
}

void balance_weigh(mpm *s, double (*fall)[3], bool drive, double *outer)
{
    balance_for_tiles(s, weigh_tile, &(weighing){outer, fall, drive});
}

void balance_share(mpm *s, double *share)
{
    balance_for_tiles(s, weigh_tile, &(weighing){share, NULL, false});
}

static void squeeze_tile(mpm *s, int blk, int tile, void *user)
{
    const struct mpm_balance *w = s->balance;
    const fields *f = s->domain->fields[blk];
    double *out = user;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        const double *volume0 = field_get(f, P_VOLUME0, body, 0), *J = field_get(f, P_J, body, 0);
        for (size_t k = range[0]; k < range[1]; ++k) {
            const point_place *place = &w->place[w->first[blk][body] + k];
            const double volume = volume0[k] * J[k];
            const double hoop = s->mesh->geometry == MESH_AXISYMMETRIC ? volume / place->radius : 0.0;
            place_node node[BALANCE_NODES];
            const int n = balance_nodes(s, place, node);
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < s->mesh->dim; ++c)
                    out[balance_at(w, w->layer[body], c, node[i].at)] -=
                        volume * node[i].slope[c][c] + (c == 0 ? hoop * node[i].S[0] : 0.0);
        }
    }
}

void balance_squeeze(mpm *s, double *out)
{
    balance_for_tiles(s, squeeze_tile, out);
}

/* A component of a point's velocity after the step: none at rest. */
static double next_velocity(const mpm *s, const place_node *node, int nodes, int c, double before)
{
    const struct mpm_balance *w = s->balance;
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

/* Cells that a point may go in an increment. With a contact two bodies must not come through each other that share no
 * node yet: their points are more than half a cell apart then. */
static double farthest(const mpm *s)
{
    return s->contact ? 0.25 : 1.0;
}

static floe_status move_point(mpm *s, int blk, int body, size_t k)
{
    const struct mpm_balance *w = s->balance;
    const fields *f = s->domain->fields[blk];
    place_node node[BALANCE_NODES];
    const int n = balance_nodes(s, &w->place[w->first[blk][body] + k], node);
    for (int c = 0; c < s->mesh->dim; ++c) {
        double way = 0.0;
        for (int i = 0; i < n; ++i) way += node[i].S[c] * w->u[balance_at(w, w->layer[body], c, node[i].at)];
        if (!(fabs(way) <= farthest(s) * s->mesh->h[c]))
            return fail(s->ctx, FLOE_RETRY, "a point of body '%s' would go farther than %s in one load increment",
                        s->scene->body[s->body[body].scene_body].name,
                        s->contact ? "a quarter of a cell, beside bodies in contact," : "a cell");
        field_next(f, P_POS, body, c)[k] = field_get(f, P_POS, body, c)[k] + way;
        field_next(f, P_VEL, body, c)[k] = next_velocity(s, node, n, c, field_get(f, P_VEL, body, c)[k]);
    }
    return FLOE_OK;
}

floe_status balance_move(mpm *s)
{
    const int gradients = s->mesh->dim * s->mesh->dim;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body) {
            const fields *f = s->domain->fields[b];
            const size_t n = s->points[b][body].n;
            for (size_t k = 0; k < n && !s->body[body].fluid; ++k) TRY(move_point(s, b, body, k));
            for (int c = 0; fields_has(f, P_AFFINE, body) && c < gradients; ++c)
                memset(field_next(f, P_AFFINE, body, c), 0, n * sizeof(double));
        }
    for (size_t t = 0; t < mesh_tiles(s->mesh); ++t) s->work->moved[t] = UINT32_MAX; /* the order is made anew */
    return FLOE_OK;
}

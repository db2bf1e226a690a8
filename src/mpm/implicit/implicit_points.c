/* Points between the nodes' displacements and the nodes' forces. */
#include "base/threads.h"
#include "math/tensor.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_volume.h"
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

/* The axes that strain: two in the plane, three about an axis. */
static int straining_axes(const mpm *s)
{
    return s->mesh->geometry == MESH_AXISYMMETRIC ? 3 : s->mesh->dim;
}

/* Their place among the components of a tensor. */
static int diagonal_of(const mpm *s, int axis)
{
    return axis < s->mesh->dim ? 4 * axis : 8;
}

/* det(I + G) - 1, of which nothing is lost where G is small. */
static double growth_of(const double G[9])
{
    const double minors = G[0] * G[4] - G[1] * G[3] + G[0] * G[8] - G[2] * G[6] + G[4] * G[8] - G[5] * G[7];
    const double det =
        G[0] * (G[4] * G[8] - G[5] * G[7]) - G[1] * (G[3] * G[8] - G[5] * G[6]) + G[2] * (G[3] * G[7] - G[4] * G[6]);
    return G[0] + G[4] + G[8] + minors + det;
}

/* f_bar - I in place of G = f - I: as much deviation and the volume 1 + shared (implicit_volume.h). */
static void share_growth(const mpm *s, double shared, double G[9])
{
    const int axes = straining_axes(s);
    const double scale = expm1((log1p(shared) - log1p(growth_of(G))) / axes);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const bool strains = axes == 3 || (i < 2 && j < 2);
            if (strains) G[3 * i + j] += scale * (G[3 * i + j] + (i == j ? 1.0 : 0.0));
        }
}

/* The rate of volume of a point becomes that of f_bar to round-off: laws in rate form take no more of a change of shape as one of volume. */
static void set_rate_of_volume(const mpm *s, solid_batch *b, size_t k, double shared)
{
    const int axes = straining_axes(s);
    const double more = (log1p(shared) - (b->L[0][k] + b->L[4][k] + b->L[8][k])) / axes;
    for (int a = 0; a < axes; ++a) b->L[diagonal_of(s, a)][k] += more;
}

/* s = tr sigma/m. */
static double mean_stress_of(const mpm *s, const solid_batch *b, size_t k)
{
    double sum = 0.0;
    for (int a = 0; a < straining_axes(s); ++a) sum += b->stress[a < s->mesh->dim ? a : 2][k];
    return sum / straining_axes(s);
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

/* The law at these gradients, from the state at the start of the increment; with changes of volume of their own where `shared` has
 * them. 0, or 1 + the first point beyond it. */
static size_t run_law(const mpm *s, int blk, int body, size_t start, size_t end, gradient_rows G, const double *shared,
                      solid_batch *b)
{
    const mpm_body *m = &s->body[body];
    load_batch(s, blk, body, start, end, false, b);
    b->dt = 1.0;
    memset(b->q, 0, sizeof b->q);
    for (size_t k = 0; k < b->n; ++k) {
        double g[9];
        for (int c = 0; c < 9; ++c) g[c] = G[c][k];
        if (shared && !(shared[k] > -1.0 && growth_of(g) > -1.0)) return 1 + k;
        if (shared) share_growth(s, shared[k], g);
        set_increment(b, k, g);
        if (shared) set_rate_of_volume(s, b, k, shared[k]);
        if (!(b->J[k] > 0.0)) return 1 + k;
    }
    thermal_batch thermal;
    if (m->warms) begin_thermal_stress(s, blk, body, start, b, &thermal);
    const size_t bad = solid_stress_state(m->law, m->law_par, s->scene->reference_pressure, s->scene->stress_state, b);
    if (m->warms && !bad) end_thermal_stress(s, blk, body, start, b, &thermal);
    return bad;
}

/* V0 T of point k of a batch whose stress is `less` (Pa) than the law's along the axes, at the components that the scene has. */
static void point_force_of(const mpm *s, const solid_batch *b, size_t k, gradient_rows G, double less, double volume0,
                           double *out)
{
    static const int symmetric[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double g[9], inverse[9];
    for (int c = 0; c < 9; ++c) g[c] = G[c][k];
    (void)invert_deformation(g, inverse);
    const double volume = volume0 * b->J[k];
    for (int n = 0; n < s->implicit->n_gradient; ++n) {
        const int i = s->implicit->gradient[n] / 3, j = s->implicit->gradient[n] % 3;
        double sum = 0.0;
        for (int l = 0; l < 3; ++l)
            sum += (b->stress[symmetric[3 * i + l]][k] - (i == l ? less : 0.0)) * inverse[3 * j + l];
        out[n] = volume * sum;
    }
}

/* V (det f) f^-T of point k of a batch, V its volume at the start of the increment. */
static void cofactor_of(const mpm *s, gradient_rows G, size_t k, double volume, double *out)
{
    double g[9], inverse[9];
    for (int c = 0; c < 9; ++c) g[c] = G[c][k];
    const double grown = volume * invert_deformation(g, inverse);
    for (int n = 0; n < s->implicit->n_gradient; ++n)
        out[n] = grown * inverse[3 * (s->implicit->gradient[n] % 3) + s->implicit->gradient[n] / 3];
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

/* What is shared of a chunk's changes of volume; NULL: the body shares none. */
static const double *shared_of(const mpm *s, int blk, int body, size_t start)
{
    return implicit_shares_volume(s, body) ? s->implicit->volume->shared + s->implicit->first[blk][body] + start : NULL;
}

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
        cofactor_of(s, G, k - start, v->volume[number], v->cofactor + number * (size_t)w->n_gradient);
    }
    return FLOE_OK;
}

static floe_status strain_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    const double *shared = shared_of(s, blk, body, start);
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    const size_t bad = run_law(s, blk, body, start, end, G, shared, b);
    if (bad) return refuse_displacement(s, blk, body, start + bad - 1);
    for (size_t k = start; k < end; ++k) {
        const size_t number = w->first[blk][body] + k;
        const double mean = shared ? mean_stress_of(s, b, k - start) : 0.0;
        if (shared) w->volume->own_stress[number] = w->volume->shared_stress[number] = mean;
        point_force_of(s, b, k - start, G, mean, volume0[k], w->point_force + number * (size_t)w->n_gradient);
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
    if (!v) return for_chunks(s, u, strain_chunk);
    TRY(for_chunks(s, u, growth_chunk));
    implicit_project_volumes(s, v->shared);
    TRY(for_chunks(s, u, strain_chunk));
    implicit_project_volumes(s, v->shared_stress);
    return for_chunks(s, u, share_chunk);
}

/* Tangents are symmetric: the mean of both halves. */
static void make_symmetric(size_t n, double *tangent)
{
    for (size_t r = 0; r < n; ++r)
        for (size_t c = 0; c < r; ++c)
            tangent[r * n + c] = tangent[c * n + r] = 0.5 * (tangent[r * n + c] + tangent[c * n + r]);
}

/* Column c of the tangents of point k of a chunk, from the law beside u. */
static void add_tangent_column(const mpm *s, const solid_batch *b, gradient_rows G, size_t number, size_t k, size_t c,
                               double volume0, bool shares)
{
    const struct mpm_implicit *w = s->implicit;
    const struct implicit_volume *v = w->volume;
    const size_t n = (size_t)w->n_gradient;
    const double *before = w->point_force + number * n;
    double force[IMPLICIT_GRADIENTS], cofactor[IMPLICIT_GRADIENTS];
    point_force_of(s, b, k, G, shares ? mean_stress_of(s, b, k) : 0.0, volume0, force);
    if (!shares) {
        for (size_t r = 0; r < n; ++r)
            w->tangent[(number * n + r) * n + c] = (force[r] - before[r]) / MPM_TANGENT_DIFFERENCE;
        return;
    }
    const double *first = v->cofactor + number * n, shared = v->shared_stress[number];
    cofactor_of(s, G, k, v->volume[number], cofactor);
    for (size_t r = 0; r < n; ++r) {
        const double own = (force[r] + shared * first[r] - before[r]) / MPM_TANGENT_DIFFERENCE;
        v->tangent[(number * n + r) * n + c] = own;
        w->tangent[(number * n + r) * n + c] = own + shared * (cofactor[r] - first[r]) / MPM_TANGENT_DIFFERENCE;
    }
}

/* The bulk modulus of points that share changes of volume, and what of it the preconditioner gives each of them. */
static size_t bulk_of_chunk(mpm *s, int blk, int body, size_t start, size_t end, gradient_rows G, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_volume *v = w->volume;
    const mpm_body *m = &s->body[body];
    const size_t n = (size_t)w->n_gradient, first = w->first[blk][body];
    const double bulk = m->law->bulk_modulus(m->law_par), own = MPM_VOLUME_BULK * m->law->shear_modulus(m->law_par);
    double shared[SOLID_CHUNK];
    for (size_t k = start; k < end; ++k) shared[k - start] = v->shared[first + k] + MPM_TANGENT_DIFFERENCE;
    const size_t bad = run_law(s, blk, body, start, end, G, shared, b);
    if (bad) return bad;
    for (size_t k = start; k < end; ++k) {
        const size_t number = first + k;
        const double slope = (mean_stress_of(s, b, k - start) - v->own_stress[number]) / MPM_TANGENT_DIFFERENCE;
        const double *cofactor = v->cofactor + number * n, volume = v->volume[number];
        v->bulk[number] = volume * (slope > 0.0 ? slope : bulk);
        for (size_t r = 0; r < n; ++r)
            for (size_t c = 0; c < n; ++c)
                v->tangent[(number * n + r) * n + c] += own * cofactor[r] * cofactor[c] / volume;
    }
    return 0;
}

static floe_status tangent_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const size_t n = (size_t)w->n_gradient, first = w->first[blk][body];
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    const double *shared = shared_of(s, blk, body, start);
    size_t bad = 0;
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    for (size_t c = 0; c < n && !bad; ++c) {
        double *row = G[w->gradient[c]];
        for (size_t k = 0; k < end - start; ++k) row[k] += MPM_TANGENT_DIFFERENCE;
        bad = run_law(s, blk, body, start, end, G, shared, b);
        for (size_t k = start; k < end && !bad; ++k)
            add_tangent_column(s, b, G, first + k, k - start, c, volume0[k], shared != NULL);
        for (size_t k = 0; k < end - start; ++k) row[k] -= MPM_TANGENT_DIFFERENCE;
    }
    if (!bad && shared) bad = bulk_of_chunk(s, blk, body, start, end, G, b);
    if (bad) return refuse_displacement(s, blk, body, start + bad - 1);
    for (size_t k = first + start; k < first + end; ++k) {
        make_symmetric(n, w->tangent + k * n * n);
        if (shared) make_symmetric(n, w->volume->tangent + k * n * n);
        if (w->volume && !shared)
            memcpy(w->volume->tangent + k * n * n, w->tangent + k * n * n, n * n * sizeof(double));
    }
    return FLOE_OK;
}

floe_status implicit_tangents(mpm *s, const double *u)
{
    TRY(for_chunks(s, u, tangent_chunk));
    return implicit_couple_patches(s);
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

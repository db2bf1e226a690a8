/* Chunks of points: grad u, the law and the force at it (implicit_chunks.h). */
#include "mpm/implicit/implicit_chunks.h"

#include "base/threads.h"
#include "math/tensor.h"
#include "mpm/implicit/implicit_volume.h"
#include "mpm/state/mean_strain.h"
#include "mpm/state/stress.h"
#include "mpm/thermal/thermal_stress.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

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

/* det(I + G) - 1, of which nothing is lost where G is small. */
double growth_of(const double G[9])
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

/* s = tr sigma/m. */
double chunk_mean_stress(const mpm *s, const solid_batch *b, size_t k)
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

/* Laws that depend on time take the step's, and their rates over it. Without time nothing has moved. */
static void set_time(double dt, solid_batch *b)
{
    b->dt = dt;
    for (int c = 0; c < 9 && dt > 0.0; ++c)
        for (size_t k = 0; k < b->n; ++k) b->L[c][k] /= dt;
}

/* The law at these gradients, from the state at the start of the increment; with changes of volume of their own where `shared` has
 * them. 0, or 1 + the first point beyond it. */
size_t chunk_law(const mpm *s, int blk, int body, size_t start, size_t end, gradient_rows G, const double *shared,
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
        /* The rate of volume is that of f_bar to round-off: laws in rate form must not take a change of shape for one of volume. */
        if (shared) set_rate_of_volume(s, b, k, log1p(shared[k]));
        if (!(b->J[k] > 0.0)) return 1 + k;
    }
    if (m->law->needs & SOLID_NEEDS_TIME) set_time(s->implicit->law_time, b);
    thermal_batch thermal;
    if (m->warms) begin_thermal_stress(s, blk, body, start, b, &thermal);
    const size_t bad = solid_stress_state(m->law, m->law_par, s->scene->reference_pressure, s->scene->stress_state, b);
    if (m->warms && !bad) end_thermal_stress(s, blk, body, start, b, &thermal);
    return bad;
}

/* V0 T of point k of a batch whose stress is `less` (Pa) than the law's along the axes, at the components that the scene has. */
void chunk_point_force(const mpm *s, const solid_batch *b, size_t k, gradient_rows G, double less, double volume0,
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
void chunk_cofactor(const mpm *s, gradient_rows G, size_t k, double volume, double *out)
{
    double g[9], inverse[9];
    for (int c = 0; c < 9; ++c) g[c] = G[c][k];
    const double grown = volume * invert_deformation(g, inverse);
    for (int n = 0; n < s->implicit->n_gradient; ++n)
        out[n] = grown * inverse[3 * (s->implicit->gradient[n] % 3) + s->implicit->gradient[n] / 3];
}

floe_status refuse_chunk(const mpm *s, int blk, int body, size_t point)
{
    const fields *f = s->domain->fields[blk];
    double x[3] = {0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[point];
    return fail(s->ctx, FLOE_RETRY, "a point of body '%s' at (%g, %g, %g) would be beyond its law %s",
                s->scene->body[s->body[body].scene_body].name, x[0], x[1], x[2], s->body[body].law->name);
}

floe_status visit_chunks(mpm *s, const double *u, chunk_visit *visit)
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

void gather_chunk(const mpm *s, int blk, int body, size_t start, size_t end, const double *u, gradient_rows G)
{
    const point_weights *place = s->implicit->weights + s->implicit->first[blk][body];
    for (size_t k = start; k < end; ++k) {
        double g[IMPLICIT_GRADIENTS];
        displacement_gradient(s, u, s->implicit->layer[body], &place[k], g);
        for (int c = 0; c < 9; ++c) G[c][k - start] = g[c];
    }
}

/* What is shared of a chunk's changes of volume; NULL: the body shares none. */
const double *chunk_shared(const mpm *s, int blk, int body, size_t start)
{
    return implicit_shares_volume(s, body) ? s->implicit->volume->shared + s->implicit->first[blk][body] + start : NULL;
}

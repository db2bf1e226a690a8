/* Tangents of the points: differences of their forces. */
#include "mpm/implicit/implicit_chunks.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_volume.h"

#include <math.h>
#include <string.h>

enum { JACOBI_SWEEPS = 6 };

/* Tangents are symmetric: the mean of both halves. */
static void make_symmetric(size_t n, double *tangent)
{
    for (size_t r = 0; r < n; ++r)
        for (size_t c = 0; c < r; ++c)
            tangent[r * n + c] = tangent[c * n + r] = 0.5 * (tangent[r * n + c] + tangent[c * n + r]);
}

/* One Jacobi rotation of a symmetric matrix in the plane (p, q), and of the eigenvectors, columns of v. */
static void rotate_plane(size_t n, double *a, double *v, size_t p, size_t q)
{
    const double off = a[p * n + q], half = 0.5 * (a[q * n + q] - a[p * n + p]);
    if (off == 0.0) return;
    const double t =
        (half >= 0.0 ? 1.0 : -1.0) * fabs(off) / (fabs(half) + hypot(half, off)) * (off > 0.0 ? 1.0 : -1.0);
    const double c = 1.0 / sqrt(1.0 + t * t), s = t * c;
    for (size_t k = 0; k < n; ++k) {
        const double kp = a[k * n + p], kq = a[k * n + q];
        a[k * n + p] = c * kp - s * kq;
        a[k * n + q] = s * kp + c * kq;
    }
    for (size_t k = 0; k < n; ++k) {
        const double pk = a[p * n + k], qk = a[q * n + k], vp = v[k * n + p], vq = v[k * n + q];
        a[p * n + k] = c * pk - s * qk;
        a[q * n + k] = s * pk + c * qk;
        v[k * n + p] = c * vp - s * vq;
        v[k * n + q] = s * vp + c * vq;
    }
}

/* Leaves out what a symmetric matrix has of negative eigenvalues: stress that is compressed resists turning negatively, and what a
 * preconditioner is made of must not. */
static void make_positive(size_t n, double *tangent)
{
    double a[IMPLICIT_GRADIENTS * IMPLICIT_GRADIENTS], v[IMPLICIT_GRADIENTS * IMPLICIT_GRADIENTS] = {0.0};
    memcpy(a, tangent, n * n * sizeof *a);
    for (size_t k = 0; k < n; ++k) v[k * n + k] = 1.0;
    for (int sweep = 0; sweep < JACOBI_SWEEPS; ++sweep)
        for (size_t p = 0; p < n; ++p)
            for (size_t q = p + 1; q < n; ++q) rotate_plane(n, a, v, p, q);
    for (size_t r = 0; r < n; ++r)
        for (size_t c = 0; c < n; ++c) {
            double sum = 0.0;
            for (size_t k = 0; k < n; ++k) sum += v[r * n + k] * fmax(a[k * n + k], 0.0) * v[c * n + k];
            tangent[r * n + c] = sum;
        }
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
    chunk_point_force(s, b, k, G, shares ? chunk_mean_stress(s, b, k) : 0.0, volume0, force);
    if (!shares) {
        for (size_t r = 0; r < n; ++r)
            w->tangent[(number * n + r) * n + c] = (force[r] - before[r]) / MPM_TANGENT_DIFFERENCE;
        return;
    }
    const double *first = v->cofactor + number * n, shared = v->shared_stress[number];
    chunk_cofactor(s, G, k, v->volume[number], cofactor);
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
    const size_t bad = chunk_law(s, blk, body, start, end, G, shared, b);
    if (bad) return bad;
    for (size_t k = start; k < end; ++k) {
        const size_t number = first + k;
        const double slope = (chunk_mean_stress(s, b, k - start) - v->own_stress[number]) / MPM_TANGENT_DIFFERENCE;
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
    const double *shared = chunk_shared(s, blk, body, start);
    size_t bad = 0;
    gradient_rows G;
    gather_chunk(s, blk, body, start, end, u, G);
    for (size_t c = 0; c < n && !bad; ++c) {
        double *row = G[w->gradient[c]];
        for (size_t k = 0; k < end - start; ++k) row[k] += MPM_TANGENT_DIFFERENCE;
        bad = chunk_law(s, blk, body, start, end, G, shared, b);
        for (size_t k = start; k < end && !bad; ++k)
            add_tangent_column(s, b, G, first + k, k - start, c, volume0[k], shared != NULL);
        for (size_t k = 0; k < end - start; ++k) row[k] -= MPM_TANGENT_DIFFERENCE;
    }
    if (!bad && shared) bad = bulk_of_chunk(s, blk, body, start, end, G, b);
    if (bad) return refuse_chunk(s, blk, body, start + bad - 1);
    for (size_t k = first + start; k < first + end; ++k) {
        make_symmetric(n, w->tangent + k * n * n);
        if (shared) make_symmetric(n, w->volume->tangent + k * n * n);
        if (shared) make_positive(n, w->volume->tangent + k * n * n);
        if (w->volume && !shared)
            memcpy(w->volume->tangent + k * n * n, w->tangent + k * n * n, n * n * sizeof(double));
    }
    return FLOE_OK;
}

floe_status implicit_tangents(mpm *s, const double *u)
{
    TRY(visit_chunks(s, u, tangent_chunk));
    if (s->implicit->volume) implicit_couple_patches(s);
    return FLOE_OK;
}

/* Advection of the fluids: numerics 2.11, compatible van Leer (VanderHeyden & Kashiwa 1998); Guilkey et al. 2003, step 12.
 *
 * What crosses a face in a step fills the slab of thickness |u*| dt upstream of it. Mass density is linear in the donor cell,
 * m(r) = m + g.r; a mass-specific q obeys (m q)(r) = m(r) q + G.r, so that uniform q stays uniform whatever m does. Both are
 * taken at the slab's centroid, half the slab from the face and half the transverse path of the flow aside. Written per face
 * axis, with x the normal and y the transverse offset in cells, a donor offers
 *     mass  M + g_n x,  M = m + g_t.y        m q  N + H x,  N = q M + G_t.y,  H = q g_n + G_n.
 * Two factors make the fluxes second order in time in moving flow: q is the mean of the values before and after the Lagrangian
 * step (after it, where s = 1), and the slab has thinned by half the step's dilatation, 1 - (1 - s) D/2.
 *
 * One fluid has two more. At a contact, where density jumps and pressure does not, the gradient of mass may be twice the central
 * one (within the neighbours' bounds), and energy per volume is flat: the contact stays three to four cells wide, and pressure
 * does not see it. Where a cell falls apart, p far above the pressure on its face, the mean over the cell is not what leaves it:
 * the slab has the density and energy of the isentrope down to P*, and the face's velocity.
 *
 * A block is swept slab by slab: a slab is a layer of cells across the slowest axis (the whole row in 1-D). Two layers of
 * donor data are kept, so that each flux is computed once. */
#include "ice/ice_advect.h"

#include <math.h>

/* q of numerics 2.5's centring in slab `at`: ring of three slabs. */
FLOE_ALWAYS_INLINE void centre_slab(const ice_advect_buffers *w, const ice_view *v, int r, int slab, const int dim,
                                    const bool multi)
{
    const ice_arrays *m = &v->m[r];
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab);
    const double *before[ADVECT_Q] = {m->u[0], m->u[1], m->u[2]}, *after[ADVECT_Q] = {m->ul[0], m->ul[1], m->ul[2]};
    before[dim] = m->e;
    after[dim] = m->el;
    before[dim + 1] = after[dim + 1] = m->vl; /* the next state's array holds v until it is overwritten: v^L alone */
    for (int q = 0; q < ADVECT_COUNT(dim, multi); ++q) {
        const double *restrict x0 = before[q] + start, *restrict x1 = after[q] + start, *restrict s = v->shock + start;
        double *restrict out = w->q[(slab + 3) % 3][q];
        for (int k = ice_slab_first(dim, 2); k < ice_slab_last(v->b, dim, 2); ++k) {
            const ptrdiff_t row = ice_slab_row(v->b, dim, k);
#pragma omp simd
            for (ptrdiff_t t = row - 2; t < row + v->b->n[0] + 2; ++t)
                out[t] = x1[t] - 0.5 * (1.0 - s[t]) * (x1[t] - x0[t]);
        }
    }
}

/* Factor on the gradient that keeps the corners of a cell within its neighbours. */
FLOE_ALWAYS_INLINE double limit(double room, double reach, double lo, double hi)
{
    const double factor = room / (reach + ICE_TINY), bounded = factor < hi ? factor : hi;
    return bounded > lo ? bounded : lo;
}

/* Half the central difference along each axis, the sum of their halves (how far a corner lies from the centre) and the
 * smaller of the rises to the highest and the falls to the lowest neighbour. */
typedef struct slope {
    double g[3], reach, room;
} slope;

FLOE_ALWAYS_INLINE slope slope_of(const double *centre, const double *const *lower, const double *const *upper,
                                  ptrdiff_t t, const int dim)
{
    slope s = {.reach = 0.0};
    double up = 0.0, down = 0.0;
    const double x = centre[t];
    for (int a = 0; a < dim; ++a) {
        const double below = lower[a][t] - x, above = upper[a][t] - x;
        s.g[a] = 0.5 * (above - below);
        s.reach += 0.5 * fabs(s.g[a]);
        up = most(up, most(below, above));
        down = most(down, most(-below, -above));
    }
    s.room = least(up, down);
    return s;
}

/* Donor data of one row of a slab. */
FLOE_ALWAYS_INLINE void donor_row(const ice_advect_buffers *w, const ice_view *v, int r, int slab, ptrdiff_t row,
                                  const int dim, const bool multi)
{
    const ice_arrays *m = &v->m[r];
    const int slow = dim - 1, nq = ADVECT_COUNT(dim, multi), ring = (slab + 2) & 1;
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab);
    const double *rho = m->rho + start, *rho_lo[3], *rho_hi[3], *u[3];
    const double *q[ADVECT_Q], *q_lo[ADVECT_Q][3], *q_hi[ADVECT_Q][3];
    double *donor[3][2 * (ADVECT_Q + 1)], drift[3];
    for (int a = 0; a < dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        rho_lo[a] = rho - st;
        rho_hi[a] = rho + st;
        u[a] = m->u[a] + start;
        drift[a] = -0.5 * v->dt * v->inv_h[a];
        for (int i = 0; i < 2 * (nq + 1); ++i) donor[a][i] = dim > 1 && a == slow ? w->across[ring][i] : w->along[a][i];
    }
    for (int i = 0; i < nq; ++i) {
        q[i] = w->q[(slab + 3) % 3][i];
        for (int a = 0; a < dim; ++a) {
            const bool cross = dim > 1 && a == slow;
            q_lo[i][a] = cross ? w->q[(slab + 2) % 3][i] : q[i] - v->b->stride[a];
            q_hi[i][a] = cross ? w->q[(slab + 4) % 3][i] : q[i] + v->b->stride[a];
        }
    }
    const double *dP = v->dP + start, *shock = v->shock + start, *c = m->c + start;
    const double *kappa = multi ? v->kappa_sum + start : NULL, *common = multi ? v->limiter + start : NULL,
                 *clip = w->clip;
    const double *sharp = v->contact && !multi ? v->contact + start : NULL;
    const double lo = v->limit_lo, hi = v->limit_hi;
    /* The rows of the buffers and of the fields do not overlap. */
#pragma omp simd
    for (ptrdiff_t t = row - 1; t < row + v->b->n[0] + 1; ++t) {
        const double mass = rho[t];
        slope g = slope_of(rho, rho_lo, rho_hi, t, dim);
        const double contact = sharp ? sharp[t] : 0.0;
        const double f = multi ? common[t] : limit(g.room, g.reach, lo, hi * (1.0 + contact));
        const double dilatation = multi ? -dP[t] * kappa[t] : -dP[t] / (mass * c[t] * c[t]);
        const double thin = 1.0 - 0.5 * hi * (1.0 - shock[t]) * dilatation;
        double fill = least(most(thin, 0.5), 1.5);
        if (multi) fill *= clip[t];
        double y[3];
        for (int a = 0; a < dim; ++a) {
            g.g[a] *= f;
            y[a] = drift[a] * u[a][t];
            if (multi) y[a] = least(most(y[a], -0.5), 0.5);
        }
        /* Beside cells without the material q is flat: what they were lent is no state to lean on. */
        double fewest = 1.0;
        for (int a = 0; a < dim && multi; ++a)
            fewest = least(fewest, least(rho_lo[a][t], rho_hi[a][t]) > 1e-6 * mass ? 1.0 : 0.0);
        const double lowest = multi ? lo * fewest : lo, highest = multi ? hi * fewest : hi;
        /* The largest ratio of the cell's mean density to that of a corner. */
        const double rarest = (mass + ICE_TINY) / (most(mass - f * g.reach, 0.0) + ICE_TINY);
        double M[3];
        for (int a = 0; a < dim; ++a) {
            M[a] = mass;
            for (int b = 0; b < dim; ++b)
                if (b != a) M[a] += g.g[b] * y[b];
            donor[a][0][t] = fill * M[a];
            donor[a][1][t] = fill * g.g[a];
        }
        for (int i = 0; i < nq; ++i) {
            const slope G = slope_of(q[i], q_lo[i], q_hi[i], t, dim);
            const double sloped = multi || i != dim ? 1.0 : 1.0 - contact;
            const double scale = sloped * mass * limit(G.room, G.reach * rarest, lowest, highest), value = q[i][t];
            for (int a = 0; a < dim; ++a) {
                double N = value * (mass + sloped * (M[a] - mass));
                for (int b = 0; b < dim; ++b)
                    if (b != a) N += scale * G.g[b] * y[b];
                donor[a][2 + 2 * i][t] = fill * N;
                donor[a][3 + 2 * i][t] = fill * (sloped * value * g.g[a] + scale * G.g[a]);
            }
        }
    }
}

/* What a slab gives up as it falls to the pressure on its face: of its mass and energy per mass, shares; of its normal velocity, the
 * share that is the face's. From a drop (p - P*)/(rho c^2) of 0.3 on, in full at 0.63: fans over less than some five cells. At
 * three quarters of the speed of sound nothing is left of it: the front of a gas that expands into next to nothing falls for good. */
typedef struct fall {
    double mass, energy, velocity;
} fall;

FLOE_ALWAYS_INLINE fall fall_to(double p, double rho, double c, double velocity, double face_pressure)
{
    const double drop = (p - face_pressure) / (rho * c * c),
                 slow = least(most(1.5 - 2.0 * fabs(velocity) / c, 0.0), 1.0),
                 part = slow * least(most(3.0 * (drop - 0.3), 0.0), 1.0);
    return (fall){part * least(drop, 0.8), part * drop * p / rho, part};
}

/* Fluxes through the lower faces, normal to `axis`, of one row: mass, m q of each q, and kinetic energy. */
FLOE_ALWAYS_INLINE void flux_row(const ice_view *v, int r, int axis, ptrdiff_t start, double *const *left,
                                 double *const *right, ptrdiff_t back, double *const *flux, ptrdiff_t from,
                                 ptrdiff_t to, const int dim, const bool multi)
{
    const int nq = ADVECT_COUNT(dim, multi);
    const double *velocity = v->m[r].fu[axis] + start, *rho = v->m[r].rho + start, *c = v->m[r].c + start,
                 *p = v->p + start, *face_pressure = v->fp[axis] + start, courant = v->dt * v->inv_h[axis];
    const ptrdiff_t down = v->b->stride[axis];
#pragma omp simd
    for (ptrdiff_t t = from; t < to; ++t) {
        const double w = velocity[t];
        const bool forward = w > 0.0;
        const double x = (forward ? 0.5 : -0.5) - 0.5 * w * courant;
        const double M = forward ? left[0][t - back] : right[0][t], g = forward ? left[1][t - back] : right[1][t];
        fall f = {0.0, 0.0, 0.0};
        if (!multi) {
            const ptrdiff_t d = t - down;
            f = fall_to(forward ? p[d] : p[t], forward ? rho[d] : rho[t], forward ? c[d] : c[t], w, face_pressure[t]);
        }
        const double kept = 1.0 - f.mass, mass = kept * (M + g * x);
        flux[0][t] = w * mass;
        double square = 0.0;
        for (int i = 0; i < nq; ++i) {
            const double N = forward ? left[2 + 2 * i][t - back] : right[2 + 2 * i][t];
            const double H = forward ? left[3 + 2 * i][t - back] : right[3 + 2 * i][t];
            double content = kept * (N + H * x);
            if (i == axis) content += f.velocity * (w * mass - content);
            if (i == dim) content -= f.energy * mass;
            flux[1 + i][t] = w * content;
            if (i < dim) square += content * content;
        }
        /* A slab that is all but empty holds momentum by round-off alone: of its donor's mass M, not of its own. */
        flux[1 + nq][t] = 0.5 * w * square / (mass + 1e-14 * most(M, 0.0) + ICE_TINY);
    }
}

/* Next state of one row. Returns how many cells need a closer look: guarded, or bad. */
FLOE_ALWAYS_INLINE int update_row(const ice_advect_buffers *w, const ice_view *v, const ice_advect_job *job, int slab,
                                  ptrdiff_t row, const int dim, const bool multi)
{
    const ice_arrays *m = &v->m[job->material];
    const int ring = (slab + 2) & 1, nq = ADVECT_COUNT(dim, multi);
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab) + row;
    const double keep = job->conserve ? 1.0 : 0.0, floor = job->energy_floor;
    double *restrict rho1 = m->rho1, *restrict e1 = m->e1;
    int bad = 0;
#pragma omp simd reduction(+ : bad)
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = start + i, t = row + i;
        const double mass = m->rho[at], next = mass - spread(w, v, 0, ring, t, i, dim),
                     inverse = 1.0 / (next + ICE_TINY);
        double old_kinetic = 0.0, kinetic = 0.0;
        for (int a = 0; a < dim; ++a) {
            const double u = m->ul[a][at], u1 = (mass * u - spread(w, v, 1 + a, ring, t, i, dim)) * inverse;
            old_kinetic += 0.5 * u * u;
            kinetic += 0.5 * u1 * u1;
            m->u1[a][at] = u1;
        }
        const double plain = (mass * m->el[at] - spread(w, v, 1 + dim, ring, t, i, dim)) * inverse;
        const double heat = keep * ((mass * old_kinetic - spread(w, v, 1 + nq, ring, t, i, dim)) * inverse - kinetic);
        const bool guarded = !(plain + heat - floor > ICE_THERMAL_SHARE * kinetic);
        const double e = plain + (guarded ? most(heat, 0.0) : heat);
        if (multi) m->vol1[at] = (mass * m->vl[at] - spread(w, v, 2 + dim, ring, t, i, dim)) * inverse;
        rho1[at] = next;
        e1[at] = e;
        const double out = ice_outflow(v, m, at, i, dim);
        const bool present = !multi || m->theta[at] > 1e-6;
        bad += (guarded && heat < 0.0) || !(next >= 0.0) || (present && (!(out <= 1.0) || !(e > floor)));
    }
    return bad;
}

/* Sweeps slabs [first, last) of a block. */
FLOE_ALWAYS_INLINE ice_advect_result sweep(const ice_advect_job *job, const int dim, const bool multi)
{
    const ice_view *v = job->v;
    const int r = job->material, slow = dim - 1, rows_lo = ice_slab_first(dim, 0),
              rows_hi = ice_slab_last(v->b, dim, 0);
    ice_advect_buffers w;
    ice_advect_divide(&w, job->buffer, v->b, dim, multi);
    ice_advect_result result = {0, 0};
    if (dim > 1) {
        centre_slab(&w, v, r, job->first - 2, dim, multi);
        centre_slab(&w, v, r, job->first - 1, dim, multi);
    }
    for (int slab = dim > 1 ? job->first - 1 : 0; slab <= (dim > 1 ? job->last : 0); ++slab) {
        const ptrdiff_t start = ice_slab_start(v->b, dim, slab);
        const int ring = (slab + 2) & 1;
        centre_slab(&w, v, r, dim > 1 ? slab + 1 : 0, dim, multi);
        if (multi) ice_advect_clip(&w, job, slab);
        for (int k = ice_slab_first(dim, 1); k < ice_slab_last(v->b, dim, 1); ++k)
            donor_row(&w, v, r, slab, ice_slab_row(v->b, dim, k), dim, multi);
        if (dim > 1 && slab >= job->first) { /* through the face between slab - 1 and slab, then slab - 1 is complete */
            for (int k = rows_lo; k < rows_hi; ++k) {
                const ptrdiff_t row = ice_slab_row(v->b, dim, k);
                flux_row(v, r, slow, start, w.across[ring ^ 1], w.across[ring], 0, w.flux_across[ring], row,
                         row + v->b->n[0], dim, multi);
            }
            ice_advect_tally_across(&w, job, slab);
            for (int k = rows_lo; k < rows_hi && slab > job->first; ++k) {
                if (update_row(&w, v, job, slab - 1, ice_slab_row(v->b, dim, k), dim, multi))
                    ice_advect_note(&w, job, slab - 1, k, &result);
            }
        }
        if (dim > 1 && (slab < job->first || slab == job->last)) continue;
        for (int a = 0; a < (dim > 1 ? dim - 1 : 1); ++a)
            for (int k = rows_lo; k < rows_hi + (a == 1); ++k) {
                const ptrdiff_t row = ice_slab_row(v->b, dim, k);
                flux_row(v, r, a, start, w.along[a], w.along[a], v->b->stride[a], w.flux[a], row,
                         row + v->b->n[0] + (a == 0), dim, multi);
            }
        ice_advect_tally_along(&w, job, slab);
        if (dim == 1 && update_row(&w, v, job, 0, ice_slab_row(v->b, dim, 0), dim, multi))
            ice_advect_note(&w, job, 0, 0, &result);
    }
    return result;
}

#define INSTANCE(d, m)                                                   \
    static ice_advect_result advect_##d##_##m(const ice_advect_job *job) \
    {                                                                    \
        return sweep(job, d, m);                                         \
    }
ICE_EACH(INSTANCE)
ice_advect_slabs *const ice_advect_of[3][2] = ICE_TABLE(advect);

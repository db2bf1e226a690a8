/* Advection of the fluids: theory 2.11, compatible van Leer (VanderHeyden & Kashiwa 1998); Guilkey et al. 2003, step
 * 12.
 *
 * The volume that crosses a face in a step is the slab of thickness |u*| dt upstream of it. Mass density is linear in
 * the donor cell, m(r) = m + g.r; a mass-specific q obeys (m q)(r) = m(r) q + G.r, so that uniform q stays uniform
 * whatever m does. Both are taken at the slab's centroid, half the slab from the face and half the transverse path of
 * the flow aside. Written per face axis, with x the normal and y the transverse offset in cells, a donor offers
 *     mass  M + g_n x,  M = m + g_t.y        m q  N + H x,  N = q M + G_t.y,  H = q g_n + G_n.
 * Two factors make the fluxes second order in time in moving flow: q is the mean of the values before and after the
 * Lagrangian step (after it, where s = 1), and the slab has thinned by half the step's dilatation, 1 - (1 - s) D/2.
 *
 * One fluid has two more. At a contact, where density jumps and pressure does not, the gradient of mass may be twice
 * the central one (within the neighbours' bounds), and energy per volume is flat: the contact stays three to four cells
 * wide, and pressure does not see it. Where a cell falls apart, p far above the pressure on its face, the mean over the
 * cell is not what leaves it: the slab has the density and energy of the isentrope down to P*, and the face's velocity.
 *
 * A block is swept slab by slab: a slab is a layer of cells across the slowest axis (the whole row in 1-D). Two layers
 * of donor data are kept, so that each flux is computed once. */
#include "ice/flux/ice_advect.h"

#include "base/choice.h"
#include "ice/flux/ice_expansion.h"
#include "ice/state/ice_traced.h"

#include <math.h>

/* q of theory 2.5's centring in slab `at`: ring of three slabs. */
FLOE_ALWAYS_INLINE void centre_slab(const ice_advect_buffers *w, const ice_view *v, int r, int slab, const int dim,
                                    const bool multi)
{
    const ice_fluid *m = &v->m[r];
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
FLOE_ALWAYS_INLINE double limited_factor(double margin, double reach, double lo, double hi)
{
    const double factor = margin / (reach + ICE_TINY), bounded = factor < hi ? factor : hi;
    return bounded > lo ? bounded : lo;
}

/* Half the central difference along each axis, the sum of their halves (how far a corner lies from the centre), the
 * smaller of the rises to the highest and the falls to the lowest neighbour, and what is between both. */
typedef struct slope {
    double g[3], reach, margin, between;
} slope;

/* An array at a row, and at the rows or cells beside it along each axis. */
typedef struct around {
    const double *at, *lower[3], *upper[3];
} around;

FLOE_ALWAYS_INLINE slope slope_of(const around *x, ptrdiff_t t, const int dim)
{
    slope s = {.reach = 0.0};
    double up = 0.0, down = 0.0;
    const double centre = x->at[t];
    for (int a = 0; a < dim; ++a) {
        const double below = x->lower[a][t] - centre, above = x->upper[a][t] - centre;
        s.g[a] = 0.5 * (above - below);
        s.reach += 0.5 * fabs(s.g[a]);
        up = most(up, most(below, above));
        down = most(down, most(-below, -above));
    }
    s.margin = least(up, down);
    s.between = up + down;
    return s;
}

/* What the donors of a row are made of; what all their quantities share is kept in rows of the buffers. */
typedef struct donors {
    around rho, q[ADVECT_Q];
    const double *u[3], *dP, *shock;
    const double *c, *contact; /* of one fluid */
    const double *kappa, *common,
        *clip; /* of several: compressibility, factor on gradients, on what leaves small volume fractions */
    double *out[3][2 * (ADVECT_Q + 1)]; /* by axis: M, g, then N and H of each q */
    double *const *M, *const *g, *const *y, *fill, *rarest, *leans;
    double drift[3], lo, hi, beyond;
    double
        least_common; /* of several: their common factor is kept up to this; a reaction of fluids has changed the masses that it was made of */
} donors;

FLOE_ALWAYS_INLINE donors advection_donors(const ice_advect_buffers *w, const ice_view *v, int r, int slab,
                                           const int dim, const bool multi)
{
    const ice_fluid *m = &v->m[r];
    const int slow = dim - 1, nq = ADVECT_COUNT(dim, multi), ring = (slab + 2) & 1;
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab);
    donors d = {.dP = v->dP + start,
                .shock = v->shock + start,
                .c = m->c + start,
                .clip = w->clip,
                .contact = w->none,
                .M = w->M,
                .g = w->g,
                .y = w->y,
                .fill = w->fill,
                .rarest = w->rarest,
                .leans = w->leans,
                .lo = v->limit_lo,
                .hi = v->limit_hi,
                .beyond = v->limit_beyond,
                .least_common = m->rhol && !v->burns ? 0.0 : 1.0};
    if (multi) {
        d.kappa = v->kappa_sum + start;
        d.common = v->limiter + start;
    } else if (v->contact) {
        d.contact = v->contact + start;
    }
    d.rho.at = m->rho + start;
    for (int i = 0; i < nq; ++i) d.q[i].at = w->q[(slab + 3) % 3][i];
    for (int a = 0; a < dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        const bool cross = dim > 1 && a == slow;
        d.u[a] = m->u[a] + start;
        d.drift[a] = -0.5 * v->dt * v->inv_h[a];
        d.rho.lower[a] = d.rho.at - st;
        d.rho.upper[a] = d.rho.at + st;
        for (int i = 0; i < nq; ++i) {
            d.q[i].lower[a] = cross ? w->q[(slab + 2) % 3][i] : d.q[i].at - st;
            d.q[i].upper[a] = cross ? w->q[(slab + 4) % 3][i] : d.q[i].at + st;
        }
        for (int i = 0; i < 2 * (nq + 1); ++i) d.out[a][i] = cross ? w->across[ring][i] : w->along[a][i];
    }
    return d;
}

/* M and g of a cell, and what its quantities will need of them. */
FLOE_ALWAYS_INLINE void donate_mass(const donors *d, ptrdiff_t t, const int dim, const bool multi)
{
    const double mass = d->rho.at[t];
    slope s = slope_of(&d->rho, t, dim);
    const double f = multi ? least(d->common[t], most(mass / (s.reach + ICE_TINY), d->least_common))
                           : limited_factor(s.margin, s.reach, d->lo, d->hi * (1.0 + d->contact[t]));
    const double dilatation = multi ? -d->dP[t] * d->kappa[t] : -d->dP[t] / (mass * d->c[t] * d->c[t]);
    const double thin = 1.0 - 0.5 * d->hi * (1.0 - d->shock[t]) * dilatation;
    double fill = least(most(thin, ICE_LEAST_SLAB), ICE_MOST_SLAB);
    if (multi) fill *= d->clip[t];
    double y[3];
    for (int a = 0; a < dim; ++a) {
        s.g[a] *= f;
        y[a] = d->drift[a] * d->u[a][t];
        if (multi) y[a] = least(most(y[a], -0.5), 0.5);
    }
    if (multi) { /* beside cells without the material q is flat: the state extrapolated to them is no basis for a gradient */
        double fewest = 1.0;
        for (int a = 0; a < dim; ++a)
            fewest =
                least(fewest, least(d->rho.lower[a][t], d->rho.upper[a][t]) > ICE_LEAST_NEIGHBOUR * mass ? 1.0 : 0.0);
        d->leans[t] = fewest;
    }
    /* The largest ratio of the cell's mean density to that of a corner. */
    d->rarest[t] = (mass + ICE_TINY) / (most(mass - f * s.reach, 0.0) + ICE_TINY);
    d->fill[t] = fill;
    for (int a = 0; a < dim; ++a) {
        double M = mass;
        for (int b = 0; b < dim; ++b)
            if (b != a) M += s.g[b] * y[b];
        d->M[a][t] = M;
        d->g[a][t] = s.g[a];
        d->y[a][t] = y[a];
        d->out[a][0][t] = fill * M;
        d->out[a][1][t] = fill * s.g[a];
    }
}

/* Share of the range of its neighbours by which velocities may go beyond it: all that the scheme allows in slow flow, none from a Mach number of
 * ICE_SLOW_MACH on. */
FLOE_ALWAYS_INLINE double crest_share(const donors *d, ptrdiff_t t, const int dim)
{
    double square = 0.0;
    for (int a = 0; a < dim; ++a) square += d->u[a][t] * d->u[a][t];
    return d->beyond * most(1.0 - square / (ICE_SLOW_MACH * ICE_SLOW_MACH * d->c[t] * d->c[t] + ICE_TINY), 0.0);
}

/* N and H of a cell's quantity number i. */
FLOE_ALWAYS_INLINE void donate_quantity(const donors *d, int i, ptrdiff_t t, const int dim, const bool multi)
{
    slope G = slope_of(&d->q[i], t, dim);
    if (!multi && i < dim && d->beyond > 0.0) G.margin += crest_share(d, t, dim) * G.between;
    const double mass = d->rho.at[t], fill = d->fill[t], value = d->q[i].at[t];
    const double sloped = multi || i != dim ? 1.0 : 1.0 - d->contact[t], leans = multi ? d->leans[t] : 1.0;
    const double scale = sloped * mass * limited_factor(G.margin, G.reach * d->rarest[t], d->lo * leans, d->hi * leans);
    for (int a = 0; a < dim; ++a) {
        double N = value * (mass + sloped * (d->M[a][t] - mass));
        for (int b = 0; b < dim; ++b)
            if (b != a) N += scale * G.g[b] * d->y[b][t];
        d->out[a][2 + 2 * i][t] = fill * N;
        d->out[a][3 + 2 * i][t] = fill * (sloped * value * d->g[a][t] + scale * G.g[a]);
    }
}

/* Donor data of one row of a slab. The rows of the buffers and of the fields do not overlap. */
FLOE_ALWAYS_INLINE void donor_row(const donors *d, ptrdiff_t from, ptrdiff_t to, const int dim, const bool multi)
{
#pragma omp simd
    for (ptrdiff_t t = from; t < to; ++t) donate_mass(d, t, dim, multi);
    for (int i = 0; i < ADVECT_COUNT(dim, multi); ++i) {
#pragma omp simd
        for (ptrdiff_t t = from; t < to; ++t) donate_quantity(d, i, t, dim, multi);
    }
}

/* Faces normal to an axis with the donors on either side, each at the face's own index; one slab or part of it. */
typedef struct faces {
    int axis;
    double courant; /* of unit velocity */
    const double *velocity, *pressure;
    const double *rho[2], *c[2], *p[2];         /* of the cells below and above */
    const double *donor[2][2 * (ADVECT_Q + 1)]; /* M, g, then N and H of each q */
    double *flux[ADVECT_Q + 2];                 /* mass, m q of each q, and kinetic energy */
} faces;

/* `back`: from a face to its lower cell in the rows of donor data. */
FLOE_ALWAYS_INLINE faces faces_of(const ice_view *v, int r, int axis, ptrdiff_t start, double *const *lower,
                                  double *const *upper, ptrdiff_t back, double *const *flux, const int dim,
                                  const bool multi)
{
    const int nq = ADVECT_COUNT(dim, multi);
    const ice_fluid *m = &v->m[r];
    faces f = {.axis = axis,
               .courant = v->dt * v->inv_h[axis],
               .velocity = m->fu[axis] + start,
               .pressure = v->fp[axis] + start};
    for (int side = 0; side < 2; ++side) {
        const ptrdiff_t at = side == 0 ? start - v->b->stride[axis] : start;
        f.rho[side] = m->rho + at;
        f.c[side] = m->c + at;
        f.p[side] = v->p + at;
    }
    for (int i = 0; i < 2 * (nq + 1); ++i) {
        f.donor[0][i] = lower[i] - back;
        f.donor[1][i] = upper[i];
    }
    for (int i = 0; i < nq + 2; ++i) f.flux[i] = flux[i];
    return f;
}

/* Fluxes through one face. */
FLOE_ALWAYS_INLINE void find_face_fluxes(const faces *f, ptrdiff_t t, const int dim, const bool multi)
{
    const int nq = ADVECT_COUNT(dim, multi);
    const double w = f->velocity[t];
    const choice upwind = choice_of(w > 0.0); /* else from above */
    const double x = chosen(upwind, 0.5, -0.5) - 0.5 * w * f->courant;
    double donor[2 * (ADVECT_Q + 1)];
    for (int i = 0; i < 2 * (nq + 1); ++i) donor[i] = chosen(upwind, f->donor[0][i][t], f->donor[1][i][t]);
    expansion d = {0.0, 0.0, 0.0};
    if (!multi)
        d = expansion_to(chosen(upwind, f->p[0][t], f->p[1][t]), chosen(upwind, f->rho[0][t], f->rho[1][t]),
                         chosen(upwind, f->c[0][t], f->c[1][t]), w, f->pressure[t]);
    const double kept = 1.0 - d.mass, mass = kept * (donor[0] + donor[1] * x);
    f->flux[0][t] = w * mass;
    double square = 0.0;
    for (int i = 0; i < nq; ++i) {
        double content = kept * (donor[2 + 2 * i] + donor[3 + 2 * i] * x);
        if (i == f->axis) content += d.velocity * (w * mass - content);
        if (i == dim) content -= d.energy * mass;
        f->flux[1 + i][t] = w * content;
        if (i < dim) square += content * content;
    }
    /* The momentum of a nearly empty slab is round-off: it is taken with the donor's mass M, not with that of the slab. */
    f->flux[1 + nq][t] = 0.5 * w * square / (mass + ICE_ROUND_OFF * most(donor[0], 0.0) + ICE_TINY);
}

/* Fluxes through the lower faces of a row. */
FLOE_ALWAYS_INLINE void flux_row(const faces *f, ptrdiff_t from, ptrdiff_t to, const int dim, const bool multi)
{
#pragma omp simd
    for (ptrdiff_t t = from; t < to; ++t) find_face_fluxes(f, t, dim, multi);
}

/* The same where the state that crosses is known (theory 2.17). */
typedef struct traced_faces {
    const double *velocity, *rho, *e, *u[3], *fraction;
    double *flux[ADVECT_Q + 2];
} traced_faces;

FLOE_ALWAYS_INLINE traced_faces traced_faces_of(const ice_view *v, int r, int axis, ptrdiff_t start,
                                                double *const *flux, const int dim, const bool multi)
{
    traced_faces f = {
        .velocity = v->m[r].fu[axis] + start, .rho = v->donor_rho[axis] + start, .e = v->donor_e[axis] + start};
    for (int a = 0; a < dim; ++a) f.u[a] = v->donor_u[axis][a] + start;
    if (multi) f.fraction = v->m[r].ft[axis] + start;
    for (int i = 0; i < ADVECT_COUNT(dim, multi) + 2; ++i) f.flux[i] = flux[i];
    return f;
}

FLOE_ALWAYS_INLINE void traced_flux_row(const traced_faces *f, ptrdiff_t from, ptrdiff_t to, const int dim,
                                        const bool multi)
{
#pragma omp simd
    for (ptrdiff_t t = from; t < to; ++t) {
        const double volume = multi ? f->velocity[t] * f->fraction[t] : f->velocity[t], mass = volume * f->rho[t];
        double square = 0.0;
        f->flux[0][t] = mass;
        for (int a = 0; a < dim; ++a) {
            f->flux[1 + a][t] = mass * f->u[a][t];
            square += f->u[a][t] * f->u[a][t];
        }
        f->flux[1 + dim][t] = mass * f->e[t];
        if (multi) f->flux[2 + dim][t] = volume;
        f->flux[1 + ADVECT_COUNT(dim, multi)][t] = 0.5 * mass * square;
    }
}

/* Those traced faces of a row, local cells [0, end), whose donor holds the fluid alone. */
FLOE_ALWAYS_INLINE void alone_flux_row(const traced_faces *f, const ice_advect_job *job, int axis, ptrdiff_t start,
                                       ptrdiff_t row, int end, const int dim, const bool multi)
{
    const ice_view *v = job->v;
    const ptrdiff_t step = v->b->stride[axis];
    for (ice_span run = {0, 0}; ice_next_alone(v, job->material, start + row, step, end, &run);)
        traced_flux_row(f, row + run.first, row + run.end, dim, multi);
    for (ice_span run = {0, 0}; multi && ice_next_traced(v, start + row, step, end, &run);)
        for (ptrdiff_t t = row + run.first; t < row + run.end; ++t) {
            const double *alone = v->alone + start + t;
            const bool upwind = f->velocity[t] > 0.0;
            if (alone[0] != alone[-step] && (upwind ? alone[-step] : alone[0]) == 1 + job->material)
                traced_flux_row(f, t, t + 1, dim, multi);
        }
}

/* Fluxes through the lower faces normal to an axis of a slab's rows [first, last) of `end` cells. traced: of all of them the state that crosses is known. */
FLOE_ALWAYS_INLINE void slab_fluxes(const ice_advect_job *job, double *const *lower, double *const *upper,
                                    double *const *flux, int axis, int slab, ice_span rows, int end, const int dim,
                                    const bool multi, const bool traced)
{
    const ice_view *v = job->v;
    const int r = job->material;
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab), back = dim == 1 || axis < dim - 1 ? v->b->stride[axis] : 0;
    const bool known = traced || v->traced;
    const traced_faces t = known ? traced_faces_of(v, r, axis, start, flux, dim, multi) : (traced_faces){0};
    if (traced) {
        for (int k = rows.first; k < rows.end; ++k)
            traced_flux_row(&t, ice_slab_row(v->b, dim, k), ice_slab_row(v->b, dim, k) + end, dim, multi);
        return;
    }
    const faces f = faces_of(v, r, axis, start, lower, upper, back, flux, dim, multi);
    for (int k = rows.first; k < rows.end; ++k) {
        const ptrdiff_t row = ice_slab_row(v->b, dim, k);
        flux_row(&f, row, row + end, dim, multi);
        if (multi && v->sharp) ice_advect_sharpen(job, axis, slab, k, flux);
        if (known) alone_flux_row(&t, job, axis, start, row, end, dim, multi);
    }
}

/* What the update of a row reads and writes, besides the material's own arrays. */
typedef struct cells {
    ice_row_flux flux;
    ice_fluid m;
    double keep, floor; /* 1 where kinetic energy that is lost becomes heat; J/kg: no less energy than this */
} cells;

/* Next state of one cell. Returns whether it needs a closer look: guarded, or bad. */
FLOE_ALWAYS_INLINE bool update_cell(const cells *c, const ice_view *v, ptrdiff_t at, ptrdiff_t t, ptrdiff_t i,
                                    const int dim, const bool multi)
{
    const ice_fluid *m = &c->m;
    const ice_row_flux *f = &c->flux;
    const int nq = ADVECT_COUNT(dim, multi);
    const double mass = m->rho[at], next = mass - ice_flux_divergence(f, 0, t, i, dim),
                 inverse = 1.0 / (next + ICE_TINY);
    double old_kinetic = 0.0, kinetic = 0.0;
    for (int a = 0; a < dim; ++a) {
        const double u = m->ul[a][at], u1 = (mass * u - ice_flux_divergence(f, 1 + a, t, i, dim)) * inverse;
        old_kinetic += 0.5 * u * u;
        kinetic += 0.5 * u1 * u1;
        m->u1[a][at] = multi ? u1 + 0.0 : u1; /* absent material's is +0, whichever blocks there are */
    }
    const double plain = (mass * m->el[at] - ice_flux_divergence(f, 1 + dim, t, i, dim)) * inverse;
    const double heat =
        c->keep * ((mass * old_kinetic - ice_flux_divergence(f, 1 + nq, t, i, dim)) * inverse - kinetic);
    const bool guarded = !(plain + heat - c->floor > ICE_THERMAL_SHARE * kinetic);
    const double e = plain + (guarded ? most(heat, 0.0) : heat);
    if (multi) m->vol1[at] = (mass * m->vl[at] - ice_flux_divergence(f, 2 + dim, t, i, dim)) * inverse;
    m->rho1[at] = next;
    m->e1[at] = e;
    const double out = ice_outflow(v, m, at, i, dim);
    const bool present = !multi || m->theta[at] > ICE_TRACE_FRACTION;
    return (guarded && heat < 0.0) || !(next >= 0.0) || (present && (!(out <= 1.0) || !(e > c->floor)));
}

/* Next state of one row. Returns how many cells need a closer look. */
FLOE_ALWAYS_INLINE int update_row(const ice_advect_buffers *w, const ice_view *v, const ice_advect_job *job, int slab,
                                  ptrdiff_t row, const int dim, const bool multi)
{
    const cells c = {ice_row_flux_of(w, v, slab), v->m[job->material], job->conserve ? 1.0 : 0.0, job->energy_floor};
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab) + row;
    int bad = 0;
#pragma omp simd reduction(+ : bad)
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) bad += update_cell(&c, v, start + i, row + i, i, dim, multi);
    return bad;
}

/* Updates the rows of a slab whose fluxes are known. */
FLOE_ALWAYS_INLINE void update_slab(const ice_advect_buffers *w, const ice_advect_job *job, int slab, ice_span rows,
                                    ice_advect_result *result, const int dim, const bool multi)
{
    for (int k = rows.first; k < rows.end; ++k)
        if (update_row(w, job->v, job, slab, ice_slab_row(job->v->b, dim, k), dim, multi))
            ice_advect_check(w, job, slab, k, result);
}

/* Donors of a slab and of its rows about it. */
FLOE_ALWAYS_INLINE void find_donors(ice_advect_buffers *w, const ice_advect_job *job, int slab, const int dim,
                                    const bool multi)
{
    const ice_view *v = job->v;
    centre_slab(w, v, job->material, dim > 1 ? slab + 1 : 0, dim, multi);
    if (multi) ice_advect_clip(w, job, slab);
    const donors d = advection_donors(w, v, job->material, slab, dim, multi);
    for (int k = ice_slab_first(dim, 1); k < ice_slab_last(v->b, dim, 1); ++k) {
        const ptrdiff_t row = ice_slab_row(v->b, dim, k);
        donor_row(&d, row - 1, row + v->b->n[0] + 1, dim, multi);
        if (multi && v->sharp) ice_advect_flatten(w, job, slab, k);
    }
}

/* Sweeps slabs [first, last) of a block. traced: all faces are, and no donors are needed. */
FLOE_ALWAYS_INLINE ice_advect_result sweep_slabs(const ice_advect_job *job, const int dim, const bool multi,
                                                 const bool traced)
{
    const ice_view *v = job->v;
    const int slow = dim - 1, n = v->b->n[0], last = dim > 1 ? job->last : 0, before = dim > 1 && !traced;
    const ice_span rows = {ice_slab_first(dim, 0), ice_slab_last(v->b, dim, 0)};
    ice_advect_buffers w;
    ice_advect_divide(&w, job->buffer, v->b, dim, multi);
    ice_advect_result result = {0, 0};
    for (int slab = job->first - 2; before && slab < job->first; ++slab)
        centre_slab(&w, v, job->material, slab, dim, multi);
    for (int slab = dim > 1 ? job->first - before : 0; slab <= last; ++slab) {
        const int ring = (slab + 2) & 1;
        if (!traced) find_donors(&w, job, slab, dim, multi);
        if (dim > 1 && slab >= job->first) { /* through the face between slab - 1 and slab, then slab - 1 is complete */
            slab_fluxes(job, w.across[ring ^ 1], w.across[ring], w.flux_across[ring], slow, slab, rows, n, dim, multi,
                        traced);
            ice_advect_tally_across(&w, job, slab);
            if (slab > job->first) update_slab(&w, job, slab - 1, rows, &result, dim, multi);
        }
        if (dim > 1 && (slab < job->first || slab == last)) continue;
        for (int a = 0; a < (dim > 1 ? dim - 1 : 1); ++a)
            slab_fluxes(job, w.along[a], w.along[a], w.flux[a], a, slab, (ice_span){rows.first, rows.end + (a == 1)},
                        n + (a == 0), dim, multi, traced);
        ice_advect_tally_along(&w, job, slab);
        if (dim == 1) update_slab(&w, job, 0, rows, &result, dim, multi);
    }
    return result;
}

#define TRACED(d)                                                                   \
    FLOE_WIDE static ice_advect_result advect_traced_##d(const ice_advect_job *job) \
    {                                                                               \
        return sweep_slabs(job, d, false, true);                                    \
    }
TRACED(1)
TRACED(2)
TRACED(3)
ice_advect_slabs *const ice_advect_traced[3] = {advect_traced_1, advect_traced_2, advect_traced_3};

#define INSTANCE(d, m)                                                             \
    FLOE_WIDE static ice_advect_result advect_##d##_##m(const ice_advect_job *job) \
    {                                                                              \
        return sweep_slabs(job, d, m, false);                                      \
    }
ICE_EACH(INSTANCE)
ice_advect_slabs *const ice_advect_kernels[3][2] = ICE_TABLE(advect);

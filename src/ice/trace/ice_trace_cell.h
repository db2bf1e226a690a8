/* A cell on its way to the faces (theory 2.17): edges of its waves along an axis, their differences, and the states that the waves carry to both faces
 * in half a step (normal waves by their characteristics, Colella and Woodward 1984; those of other axes by their differences, after Colella 1990). */
#ifndef ICE_TRACE_CELL_H
#define ICE_TRACE_CELL_H

#include "ice/state/ice_lean.h"
#include "ice/trace/ice_parabola.h"
#include "ice/trace/ice_trace_rows.h"

/* What a cell holds: the one fluid that there is; one of several, but for traces of others; or several. */
typedef enum trace_kind { TRACE_ONE, TRACE_ALONE, TRACE_SHARED } trace_kind;

/* What the kernels read of a block, apart from the view, so that the compiler knows that no store changes it. */
typedef struct trace_block {
    const double *restrict rho, *restrict p, *restrict e, *restrict c, *restrict u[3], *restrict flat[3];
    const double *restrict volume, *restrict theta; /* of one of several: v and volume fraction */
    const double *restrict kappa;                   /* of several: sum of theta kappa */
    const double *restrict force[3],
        *restrict heat, *restrict warming; /* of viscosity and conduction: N/m3, W/m3; Pa in half the step */
    const double *lower0, *upper0;
    ptrdiff_t stride[3];
    double courant[3], weight[3]; /* dt/h; m2/s2: of a cell's height */
    double dt, floor;
    double uneven; /* trace_job */
    bool radial;
} trace_block;

/* A cell as its waves see it, with its own speed of sound frozen. */
typedef struct medium {
    double rho, p, c, z, inv_c2, enthalpy; /* z: kg/(m2 s), impedance; enthalpy: rho h over rho c2 */
    double all;                            /* kg/m3: of all that the cell holds */
    double energy;                         /* J/m3: rho e; of several 0, none of which crosses a face as one */
} medium;

FLOE_ALWAYS_INLINE medium medium_of(const trace_block *b, ptrdiff_t at, const trace_kind kind)
{
    const double all = b->rho[at], p = b->p[at], c = kind == TRACE_ONE ? b->c[at] : 1.0 / sqrt(all * b->kappa[at]);
    if (kind == TRACE_SHARED) return (medium){all, p, c, all * c, 1.0 / (c * c), 0.0, all, 0.0};
    const double rho = kind == TRACE_ONE ? all : 1.0 / b->volume[at], e = b->e[at],
                 inv_c2 = 1.0 / (b->c[at] * b->c[at]);
    return (medium){rho, p, c, all * c, inv_c2, (e + p / rho) * inv_c2, all, rho * e};
}

FLOE_ALWAYS_INLINE ice_five five_of(const double *restrict q, ptrdiff_t at, ptrdiff_t step)
{
    return (ice_five){{q[at - 2 * step], q[at - step], q[at], q[at + step], q[at + 2 * step]}};
}

/* Of one of several fluids: cells without it are as the nearest with it. */
FLOE_ALWAYS_INLINE ice_five own_five(const trace_block *b, const double *restrict q, ptrdiff_t at, ptrdiff_t step)
{
    ice_five x = five_of(q, at, step);
    const ice_five theta = five_of(b->theta, at, step);
    x.q[1] = theta.q[1] > ICE_TRACE_FRACTION ? x.q[1] : x.q[2];
    x.q[3] = theta.q[3] > ICE_TRACE_FRACTION ? x.q[3] : x.q[2];
    x.q[0] = least(theta.q[0], theta.q[1]) > ICE_TRACE_FRACTION ? x.q[0] : x.q[1];
    x.q[4] = least(theta.q[4], theta.q[3]) > ICE_TRACE_FRACTION ? x.q[4] : x.q[3];
    return x;
}

/* Densities, of one of several fluids its own; and energies per mass. */
FLOE_ALWAYS_INLINE ice_five densities_of(const trace_block *b, ptrdiff_t at, ptrdiff_t step, const trace_kind kind)
{
    if (kind != TRACE_ALONE) return five_of(b->rho, at, step);
    ice_five x = own_five(b, b->volume, at, step);
    for (int n = 0; n < 5; ++n) x.q[n] = 1.0 / x.q[n];
    return x;
}

FLOE_ALWAYS_INLINE ice_five energies_of(const trace_block *b, ptrdiff_t at, ptrdiff_t step, const trace_kind kind)
{
    if (kind == TRACE_SHARED) return (ice_five){{0.0}};
    return kind == TRACE_ONE ? five_of(b->e, at, step) : own_five(b, b->e, at, step);
}

FLOE_ALWAYS_INLINE ice_five five_plus(ice_five a, double factor, ice_five b)
{
    ice_five x;
    for (int n = 0; n < 5; ++n) x.q[n] = a.q[n] + factor * b.q[n];
    return x;
}

/* Twice what the halves of a cell, and of those beside it, weigh more than even ones. Of one fluid, and along axes without weight: none. */
typedef struct lean_three {
    double below, here, above; /* kg/m3 */
} lean_three;

FLOE_ALWAYS_INLINE lean_three leans_of(const trace_block *b, ptrdiff_t at, ptrdiff_t step, const trace_kind kind)
{
    if (kind == TRACE_ONE) return (lean_three){0.0, 0.0, 0.0};
    const double twice = 2.0 * b->uneven;
    return (lean_three){twice * ice_lean_at(b->rho, at - step, step), twice * ice_lean_at(b->rho, at, step),
                        twice * ice_lean_at(b->rho, at + step, step)};
}

/* Pressure less that of a column at rest in which the middle cell has its own (theory 2.4): p_j = p_j-1 + g h (rho_j-1 + rho_j)/2. */
FLOE_ALWAYS_INLINE ice_five without_weight(ice_five p, ice_five rho, lean_three lean, double weight)
{
    const double half = 0.5 * weight, first = half * (rho.q[1] + rho.q[2] + (lean.here - lean.below)),
                 next = half * (rho.q[2] + rho.q[3] + (lean.above - lean.here));
    p.q[0] += first + half * (rho.q[0] + rho.q[1]);
    p.q[1] += first;
    p.q[3] -= next;
    p.q[4] -= next + half * (rho.q[3] + rho.q[4]);
    return p;
}

/* Rises from 0 where a value is no larger than one bound to 1 at another. */
FLOE_ALWAYS_INLINE double rise_between(double value, double none, double all)
{
    return least(most((value - none) / (all - none + ICE_TINY), 0.0), 1.0);
}

/* Share of the neighbours' lines in the edges of density at a contact (eqs 1.16, 3.2): density has an inflection there, and pressure does
 * not explain its jump. Each of the signs comes in over a range, and none is of round-off's size: what differs by that gives the same. */
FLOE_ALWAYS_INLINE double contact_share(ice_five rho, ice_five p, double stiffness)
{
    const double jump = rho.q[3] - rho.q[1], size = fabs(jump), smallest = least(rho.q[1], rho.q[3]);
    const double below = rho.q[0] - 2.0 * rho.q[1] + rho.q[2], above = rho.q[2] - 2.0 * rho.q[3] + rho.q[4];
    const double turn = jump > 0.0 ? least(below, -above) : least(-below, above);
    const double inflection = rise_between(turn, 0.0, ICE_TRACE_INFLECTION * size);
    const double least_jump = ICE_TRACE_CONTACT * most(rho.q[1], rho.q[3]),
                 large = rise_between(size, least_jump, ICE_TRACE_CONTACT_FULL * least_jump);
    const double explained = fabs(p.q[3] - p.q[1]) * smallest, of_it = ICE_TRACE_COMPRESSION * stiffness * size,
                 unexplained = rise_between(of_it, explained, ICE_TRACE_CONTACT_FULL * explained);
    const double bend = (below - above) * jump / (6.0 * jump * jump + ICE_TINY);
    return inflection * large * unexplained * rise_between(bend, ICE_TRACE_BEND_FOOT, ICE_TRACE_BEND_FULL);
}

/* Share of div u in the gradient of the velocity: 1 in sound and shocks, 0 in vortices. Where fluid is at rest, but for round-off, its first motion will be
 * sound. One dimension has nothing else. */
FLOE_ALWAYS_INLINE double dilatation_share(const trace_block *b, ptrdiff_t at, double c, const int dim)
{
    if (dim == 1) return 1.0;
    double div = 0.0, all = ICE_TINY, rest = 0.0;
    for (int a = 0; a < dim; ++a) {
        const ptrdiff_t st = b->stride[a];
        for (int n = 0; n < dim; ++n) {
            const double d = (b->u[n][at + st] - b->u[n][at - st]) * b->courant[a];
            all += d * d;
            if (n == a) div += d;
        }
        const double least_change = ICE_TRACE_AT_REST * c * b->courant[a];
        rest += least_change * least_change;
    }
    return least((div * div + rest) / (all + rest), 1.0);
}

/* Edges of a pressure that is linear in mass: in slow flow neighbours are accelerated alike, whatever their densities. */
FLOE_ALWAYS_INLINE ice_edges mass_edges(ice_five p, ice_five rho, lean_three lean)
{
    const double below = rho.q[1] - lean.below, lower = rho.q[2] + lean.here, upper = rho.q[2] - lean.here,
                 above = rho.q[3] + lean.above;
    const double slope = (p.q[3] - p.q[1]) / (below + lower + upper + above);
    return (ice_edges){p.q[2] - slope * lower, p.q[2] + slope * upper};
}

/* A cell and two on either side of it along an axis; p: less a column at rest. */
typedef struct stencil {
    ice_five rho, u, e, p;
    ice_edges by_mass; /* of p; of several fluids */
} stencil;

/* Edges of a wave of sound, of impedance z upwards: by a share those of lines. */
FLOE_ALWAYS_INLINE ice_edges limit_sound(const stencil *s, ice_five wave, double z, bool torn, double lines,
                                         const trace_kind kind)
{
    const ice_edges limited = ice_parabola_edges(wave), u = ice_line_edges(s->u);
    if (kind == TRACE_ONE) return ice_blend_edges(limited, lines, ice_line_edges(wave));
    const ice_edges line = {s->by_mass.lower + z * u.lower, s->by_mass.upper + z * u.upper};
    return ice_blend_edges(limited, torn ? 0.0 : lines, line);
}

/* Edges of the waves; where the cell is torn, of pressure, velocity and density themselves: the waves of one cell say little of the next. */
FLOE_ALWAYS_INLINE void limit_waves(const stencil *s, const medium *m, bool torn, double lines, double flat,
                                    ice_edges *q, const trace_kind kind)
{
    const double up_u = torn ? 0.0 : m->z, down_p = torn ? 0.0 : 1.0, down_u = torn ? 1.0 : -m->z,
                 heat_p = torn ? 0.0 : m->inv_c2;
    const ice_five up = five_plus(s->p, up_u, s->u), entropy = five_plus(s->rho, -heat_p, s->p);
    ice_five down, energy;
    for (int n = 0; n < 5; ++n) {
        down.q[n] = down_p * s->p.q[n] + down_u * s->u.q[n];
        energy.q[n] = s->rho.q[n] * s->e.q[n] - m->enthalpy * s->p.q[n];
    }
    q[WAVE_UP] = limit_sound(s, up, m->z, torn, lines, kind);
    q[WAVE_DOWN] = limit_sound(s, down, -m->z, torn, lines, kind);
    q[WAVE_ENTROPY] = ice_steepen_edges(ice_parabola_edges(entropy), contact_share(s->rho, s->p, m->z * m->c), entropy);
    q[WAVE_ENERGY] = ice_parabola_edges(energy);
    const double mean[WAVE_ACROSS] = {up.q[2], down.q[2], entropy.q[2], energy.q[2]};
    for (int n = 0; n < WAVE_ACROSS; ++n) q[n] = ice_blend_edges(q[n], flat, (ice_edges){mean[n], mean[n]});
}

/* From pressure, velocity and density to waves, where the cell is torn. */
FLOE_ALWAYS_INLINE void join_waves(const medium *m, bool torn, ice_edges *q)
{
    const ice_edges p = q[WAVE_UP], u = q[WAVE_DOWN], rho = q[WAVE_ENTROPY];
    q[WAVE_UP] = (ice_edges){torn ? p.lower + m->z * u.lower : p.lower, torn ? p.upper + m->z * u.upper : p.upper};
    q[WAVE_DOWN] = (ice_edges){torn ? p.lower - m->z * u.lower : u.lower, torn ? p.upper - m->z * u.upper : u.upper};
    q[WAVE_ENTROPY] = (ice_edges){torn ? rho.lower - m->inv_c2 * p.lower : rho.lower,
                                  torn ? rho.upper - m->inv_c2 * p.upper : rho.upper};
}

/* Edges, and the differences between them in the flow's own quantities. */
FLOE_ALWAYS_INLINE void put_edges(const trace_row *w, int axis, ptrdiff_t t, const medium *m, const ice_edges *q,
                                  const int dim)
{
    double d[WAVES];
    for (int n = 0; n < WAVE_ACROSS + dim - 1; ++n) {
        w->lower[axis][n][t] = q[n].lower;
        w->upper[axis][n][t] = q[n].upper;
        d[n] = q[n].upper - q[n].lower;
    }
    const double d_p = 0.5 * (d[WAVE_UP] + d[WAVE_DOWN]);
    w->slope[axis][SLOPE_PRESSURE][t] = d_p;
    w->slope[axis][SLOPE_DENSITY][t] = d[WAVE_ENTROPY] + d_p * m->inv_c2;
    w->slope[axis][SLOPE_ENERGY][t] = d[WAVE_ENERGY] + d_p * m->enthalpy;
    w->slope[axis][SLOPE_VELOCITY + axis][t] = 0.5 * (d[WAVE_UP] - d[WAVE_DOWN]) / m->z;
    for (int n = 0; n < dim - 1; ++n) w->slope[axis][SLOPE_VELOCITY + (axis + 1 + n) % dim][t] = d[WAVE_ACROSS + n];
}

/* Share of a cell's own state at the faces of one that fluids share beside others of far higher or lower density: what waves bring of one of them into
 * the next is no wave of the next. */
FLOE_ALWAYS_INLINE double contrast_share(const trace_block *b, ptrdiff_t at, ptrdiff_t step)
{
    const double below = b->rho[at - step], here = b->rho[at], above = b->rho[at + step];
    const double ratio = least(least(below, here), above) / most(most(below, here), above);
    return least(most(ICE_TRACE_CONTRAST_ALL - ICE_TRACE_CONTRAST * ratio, 0.0), 1.0);
}

/* Edges of a cell along an axis, and their differences. */
FLOE_ALWAYS_INLINE void find_edges(const trace_block *b, const trace_row *w, int axis, ptrdiff_t at, ptrdiff_t t,
                                   const int dim, const trace_kind kind)
{
    const ptrdiff_t step = b->stride[axis];
    const medium m = medium_of(b, at, kind);
    stencil s = {.rho = densities_of(b, at, step, kind),
                 .u = five_of(b->u[axis], at, step),
                 .e = energies_of(b, at, step, kind)};
    const ice_five mass = five_of(b->rho, at, step);
    const lean_three lean = leans_of(b, at, step, kind);
    s.p = without_weight(five_of(b->p, at, step), mass, lean, b->weight[axis]);
    s.by_mass = mass_edges(s.p, mass, lean);
    const double *p = s.p.q, *u = s.u.q, *slow_shock = b->flat[axis];
    const bool torn = u[3] - u[1] > ICE_TRACE_TORN * m.c; /* towards a vacuum */
    double flat = most(slow_shock[at], p[3] < p[1] ? slow_shock[at + step] : slow_shock[at - step]);
    if (kind == TRACE_SHARED) flat = most(flat, contrast_share(b, at, step));
    /* In slow flow without dilatation the differences of the axes must cancel as they do in div u: lines. Jumps of pressure are none of it. */
    const double slow = most(1.0 - w->mach[t], 0.0),
                 even = most(1.0 - ICE_TRACE_UNEVEN * fabs(p[3] - p[1]) / (m.z * m.c), 0.0),
                 lines = slow * slow * even * (1.0 - w->dilatation[t]);
    ice_edges q[WAVES];
    limit_waves(&s, &m, torn, lines, flat, q, kind);
    for (int n = 0; n < dim - 1; ++n) {
        const ice_five across = five_of(b->u[(axis + 1 + n) % dim], at, step);
        const ice_edges edges = ice_blend_edges(ice_parabola_edges(across), lines, ice_smooth_edges(across));
        q[WAVE_ACROSS + n] = ice_blend_edges(edges, flat, (ice_edges){across.q[2], across.q[2]});
    }
    join_waves(&m, torn, q);
    put_edges(w, axis, t, &m, q, dim);
}

/* Changes of a cell in half the step. */
typedef struct half_step {
    double rho, p, energy, u[3];
} half_step;

/* What the flow along the other axes, and a radius, do; bounded beside the state there is. */
FLOE_ALWAYS_INLINE half_step changes_across(const trace_block *b, const trace_row *w, const medium *m, int axis,
                                            ptrdiff_t at, ptrdiff_t i, const int dim, const bool diffuses)
{
    half_step d = {0.0, 0.0, 0.0, {0.0, 0.0, 0.0}};
    const ptrdiff_t t = 1 + i;
    const double rho = m->rho, p = m->p, stiffness = m->all * m->c * m->c, energy = m->energy;
    for (int a = 0; a < dim; ++a) {
        if (a == axis) continue;
        const double k = -0.5 * b->courant[a], u = b->u[a][at], du = w->slope[a][SLOPE_VELOCITY + a][t],
                     dp = w->slope[a][SLOPE_PRESSURE][t];
        d.rho += k * (u * w->slope[a][SLOPE_DENSITY][t] + rho * du);
        d.p += k * (u * (dp + b->weight[a] * m->all) + stiffness * du);
        d.energy += k * (u * w->slope[a][SLOPE_ENERGY][t] + (energy + p) * du);
        for (int n = 0; n < dim; ++n) d.u[n] += k * u * w->slope[a][SLOPE_VELOCITY + n][t];
        d.u[a] += k * dp / m->all;
    }
    if (b->radial) {
        const double rate = -0.5 * b->dt * b->u[0][at] * (b->upper0[i] - b->lower0[i]);
        d.rho += rate * rho;
        d.p += rate * stiffness;
        d.energy += rate * (energy + p);
    }
    const double over_rho = ICE_TRACE_MOST_CHANGE * rho, over_p = ICE_TRACE_MOST_CHANGE * (p - b->floor);
    double part = 1.0;
    part = fabs(d.rho) > over_rho ? over_rho / fabs(d.rho) : part;
    part = fabs(d.p) * part > over_p ? over_p / fabs(d.p) : part;
    d.rho *= part;
    d.p *= part;
    d.energy *= part;
    for (int n = 0; n < dim; ++n) d.u[n] *= part;
    if (diffuses) {
        d.p += b->warming[at];
        d.energy += 0.5 * b->dt * b->heat[at];
        for (int n = 0; n < dim; ++n) d.u[n] += 0.5 * b->dt * b->force[n][at] / m->all;
    }
    return d;
}

/* State at one face of a cell: the waves at it, the changes across, and the cell's own values where too little would be left. weight: Pa, from the
 * cell's centre to the face. */
FLOE_ALWAYS_INLINE void put_state(const trace_block *b, const medium *m, int axis, ptrdiff_t at, ptrdiff_t t,
                                  const double *wave, double weight, const half_step *d, double *const *to,
                                  const int dim)
{
    const double sound = 0.5 * (wave[WAVE_UP] + wave[WAVE_DOWN]);
    const double p = sound + weight + d->p, rho = wave[WAVE_ENTROPY] + sound * m->inv_c2 + d->rho,
                 energy = wave[WAVE_ENERGY] + m->enthalpy * sound + d->energy;
    const bool whole = p - b->floor > ICE_TRACE_LEAST_LEFT * (m->p - b->floor) && rho > ICE_TRACE_LEAST_LEFT * m->rho;
    to[STATE_DENSITY][t] = whole ? rho : m->rho;
    to[STATE_PRESSURE][t] = whole ? p : m->p;
    to[STATE_ENERGY][t] = whole ? energy : m->energy;
    const double normal = 0.5 * (wave[WAVE_UP] - wave[WAVE_DOWN]) / m->z + d->u[axis];
    to[STATE_VELOCITY + axis][t] = whole ? normal : b->u[axis][at];
    for (int n = 0; n < dim - 1; ++n) {
        const int a = (axis + 1 + n) % dim;
        to[STATE_VELOCITY + a][t] = whole ? wave[WAVE_ACROSS + n] + d->u[a] : b->u[a][at];
    }
}

/* What the Riemann problem asks of the cell besides. */
FLOE_ALWAYS_INLINE void put_cell(const trace_row *w, const medium *m, double early, ptrdiff_t t, double *const *to,
                                 const trace_kind kind)
{
    if (kind != TRACE_ONE) {
        to[STATE_SOUND][t] = m->c;
        to[STATE_IMPEDANCE][t] = m->z;
        to[STATE_CONTRAST][t] = w->contrast[t];
    }
    to[STATE_EARLY][t] = early;
    to[STATE_MACH][t] = w->mach[t];
    to[STATE_DILATATION][t] = w->dilatation[t];
}

/* Traces a cell's waves to its lower and upper face. */
FLOE_ALWAYS_INLINE void trace_cell(const trace_block *b, const trace_row *w, int axis, ptrdiff_t at, ptrdiff_t i,
                                   double *const *above, const int dim, const bool diffuses, const trace_kind kind)
{
    const ptrdiff_t t = 1 + i;
    const medium m = medium_of(b, at, kind);
    const double u = b->u[axis][at], k = b->courant[axis];
    const double speed[WAVES] = {u + m.c, u - m.c, u, u, u, u},
                 mean[WAVE_ACROSS] = {m.p + m.z * u, m.p - m.z * u, m.rho - m.p * m.inv_c2,
                                      m.energy - m.enthalpy * m.p};
    double *const *edge[2] = {w->lower[axis], w->upper[axis]};
    double lower[WAVES], upper[WAVES], early[2];
    for (int side = 0; side < 2; ++side) early[side] = 0.5 * (edge[side][WAVE_UP][t] - edge[side][WAVE_DOWN][t]) / m.z;
    for (int n = 0; n < WAVE_ACROSS + dim - 1; ++n) {
        const ice_edges e = {edge[0][n][t], edge[1][n][t]};
        const double own = n < WAVE_ACROSS ? mean[n] : b->u[(axis + 1 + n - WAVE_ACROSS) % dim][at];
        lower[n] = ice_mean_above_lower(e, own, most(-speed[n] * k, -1.0));
        upper[n] = ice_mean_below_upper(e, own, most(speed[n] * k, -1.0));
    }
    half_step d = changes_across(b, w, &m, axis, at, i, dim, diffuses);
    /* Of half the cell, and what its lower half has beyond that; and as the column passes by. */
    const double weight = 0.5 * b->weight[axis] * m.all,
                 lean =
                     kind == TRACE_ONE ? 0.0 : b->uneven * b->weight[axis] * ice_lean_at(b->rho, at, b->stride[axis]);
    d.p -= 0.5 * k * u * b->weight[axis] * m.all;
    put_state(b, &m, axis, at, t, lower, -weight - lean, &d, w->below, dim);
    put_state(b, &m, axis, at, t, upper, weight - lean, &d, above, dim);
    put_cell(w, &m, early[0], t, w->below, kind);
    put_cell(w, &m, early[1], t, above, kind);
}

#endif

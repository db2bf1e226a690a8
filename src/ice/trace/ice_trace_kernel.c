/* The sweep of a block: edges of all cells of a row along all axes, their differences, what waves carry to the faces in half a step (normal ones by
 * their characteristics, Colella and Woodward 1984; those of other axes by their differences, after Colella 1990), and the faces. Theory 2.17. */
#include "ice/trace/ice_parabola.h"
#include "ice/trace/ice_star.h"
#include "ice/trace/ice_trace_rows.h"

#include <float.h>
#include <string.h>

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
    bool radial;
} trace_block;

/* Least pressure that a fluid bears; of several, the largest of these. */
static double floor_of(const ice_view *v, int fluid)
{
    double floor = -DBL_MAX;
    for (int r = 0; r < v->n_materials; ++r) {
        const eos *law = &v->material[r].eos;
        if (fluid == r || fluid == v->n_materials) floor = most(floor, law->model->pressure_floor(law->par));
    }
    return floor;
}

/* Cells of a fluid, or, its number being that of all fluids, of several, whose velocity and density is then that of all. */
FLOE_ALWAYS_INLINE trace_block trace_block_of(const ice_view *v, int fluid, bool shares, const int dim)
{
    const ice_fluid *m = &v->m[fluid < v->n_materials ? fluid : 0];
    trace_block b = {.rho = shares ? v->rho_sum : m->rho,
                     .p = v->p,
                     .e = m->e,
                     .c = m->c,
                     .volume = m->v,
                     .theta = m->theta,
                     .kappa = v->kappa_sum,
                     .heat = m->heat,
                     .warming = v->P,
                     .lower0 = v->lower0,
                     .upper0 = v->upper0,
                     .dt = v->dt,
                     .floor = floor_of(v, fluid),
                     .radial = v->radial};
    for (int a = 0; a < dim; ++a) {
        b.force[a] = m->diff[a];
        b.u[a] = shares ? v->mean[a] : m->u[a];
        b.flat[a] = v->flat[a];
        b.stride[a] = v->b->stride[a];
        b.courant[a] = v->dt * v->inv_h[a];
        b.weight[a] = v->gravity[a] * v->h[a];
    }
    return b;
}

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

FLOE_ALWAYS_INLINE ice_five sum_of(ice_five a, double factor, ice_five b)
{
    ice_five x;
    for (int n = 0; n < 5; ++n) x.q[n] = a.q[n] + factor * b.q[n];
    return x;
}

/* Pressure less that of a column at rest in which the middle cell has its own (theory 2.4): p_j = p_j-1 + g h (rho_j-1 + rho_j)/2. */
FLOE_ALWAYS_INLINE ice_five without_weight(ice_five p, ice_five rho, double weight)
{
    const double half = 0.5 * weight, first = half * (rho.q[1] + rho.q[2]), next = half * (rho.q[2] + rho.q[3]);
    p.q[0] += first + half * (rho.q[0] + rho.q[1]);
    p.q[1] += first;
    p.q[3] -= next;
    p.q[4] -= next + half * (rho.q[3] + rho.q[4]);
    return p;
}

/* Share of the neighbours' lines in the edges of density at a contact (eqs 1.16, 3.2): density has an inflection there, and pressure does
 * not explain its jump. */
FLOE_ALWAYS_INLINE double contact_share(ice_five rho, ice_five p, double stiffness)
{
    const double jump = rho.q[3] - rho.q[1], smallest = least(rho.q[1], rho.q[3]);
    const double below = rho.q[0] - 2.0 * rho.q[1] + rho.q[2], above = rho.q[2] - 2.0 * rho.q[3] + rho.q[4];
    const bool contact = below * above < 0.0 && fabs(jump) > ICE_TRACE_CONTACT * most(rho.q[1], rho.q[3]) &&
                         ICE_TRACE_COMPRESSION * stiffness * fabs(jump) >= fabs(p.q[3] - p.q[1]) * smallest;
    const double bend = (below - above) * jump / (6.0 * jump * jump + ICE_TINY);
    const double share = least(most(ICE_TRACE_BEND_RISE * (bend - ICE_TRACE_BEND_FOOT), 0.0), 1.0);
    return contact ? share : 0.0;
}

/* Share of div u in the gradient of the velocity: 1 in sound and shocks, 0 in vortices. One dimension has nothing else. */
FLOE_ALWAYS_INLINE double dilatation_share(const trace_block *b, ptrdiff_t at, const int dim)
{
    if (dim == 1) return 1.0;
    double div = 0.0, all = ICE_TINY;
    for (int a = 0; a < dim; ++a) {
        const ptrdiff_t st = b->stride[a];
        for (int n = 0; n < dim; ++n) {
            const double d = (b->u[n][at + st] - b->u[n][at - st]) * b->courant[a];
            all += d * d;
            if (n == a) div += d;
        }
    }
    return least(div * div / all, 1.0);
}

/* A cell and two on either side of it along an axis; p: less a column at rest. */
typedef struct stencil {
    ice_five rho, u, e, p;
} stencil;

/* Edges of the waves; where the cell is torn, of pressure, velocity and density themselves: the waves of one cell say little of the next. */
FLOE_ALWAYS_INLINE void limit_waves(const stencil *s, const medium *m, bool torn, double lines, double flat,
                                    ice_edges *q)
{
    const double up_u = torn ? 0.0 : m->z, down_p = torn ? 0.0 : 1.0, down_u = torn ? 1.0 : -m->z,
                 heat_p = torn ? 0.0 : m->inv_c2;
    const ice_five up = sum_of(s->p, up_u, s->u), entropy = sum_of(s->rho, -heat_p, s->p);
    ice_five down, energy;
    for (int n = 0; n < 5; ++n) {
        down.q[n] = down_p * s->p.q[n] + down_u * s->u.q[n];
        energy.q[n] = s->rho.q[n] * s->e.q[n] - m->enthalpy * s->p.q[n];
    }
    q[WAVE_UP] = ice_blend_edges(ice_parabola_edges(up), lines, ice_line_edges(up));
    q[WAVE_DOWN] = ice_blend_edges(ice_parabola_edges(down), lines, ice_line_edges(down));
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
    return least(most(1.1 - 33.0 * ratio, 0.0), 1.0);
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
    s.p = without_weight(five_of(b->p, at, step), five_of(b->rho, at, step), b->weight[axis]);
    const double *p = s.p.q, *u = s.u.q, *slow_shock = b->flat[axis];
    const bool torn = u[3] - u[1] > ICE_TRACE_TORN * m.c; /* towards a vacuum */
    double flat = most(slow_shock[at], p[3] < p[1] ? slow_shock[at + step] : slow_shock[at - step]);
    if (kind == TRACE_SHARED) flat = most(flat, contrast_share(b, at, step));
    /* In slow flow without dilatation the differences of the axes must cancel as they do in div u: lines. Jumps of pressure are none of it. */
    const double slow = most(1.0 - w->mach[t], 0.0),
                 even = most(1.0 - ICE_TRACE_UNEVEN * fabs(p[3] - p[1]) / (m.z * m.c), 0.0),
                 lines = slow * slow * even * (1.0 - w->dilatation[t]);
    ice_edges q[WAVES];
    limit_waves(&s, &m, torn, lines, flat, q);
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
                 energy = wave[WAVE_ENERGY] + m->enthalpy * (sound + weight) + d->energy;
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
    if (kind != TRACE_ONE) to[STATE_SOUND][t] = m->c;
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
    const double weight = 0.5 * b->weight[axis] * m.all; /* of half the cell; and as the column passes by */
    d.p -= 0.5 * k * u * b->weight[axis] * m.all;
    put_state(b, &m, axis, at, t, lower, -weight, &d, w->below, dim);
    put_state(b, &m, axis, at, t, upper, weight, &d, above, dim);
    put_cell(w, &m, early[0], t, w->below, kind);
    put_cell(w, &m, early[1], t, above, kind);
}

FLOE_ALWAYS_INLINE ice_side_of_face side_at(double *const *state, ptrdiff_t t, double c, const int dim)
{
    ice_side_of_face s = {.rho = state[STATE_DENSITY][t],
                          .p = state[STATE_PRESSURE][t],
                          .energy = state[STATE_ENERGY][t],
                          .c = c,
                          .early = state[STATE_EARLY][t]};
    for (int a = 0; a < dim; ++a) s.u[a] = state[STATE_VELOCITY + a][t];
    return s;
}

/* Share of the viscous part that a face goes without: flow far below the speed of sound, and with little dilatation. */
FLOE_ALWAYS_INLINE double slow_share(double mach, double dilatation, double jump, double c)
{
    const double fast = most(least(ICE_TRACE_SLOW * mach, 1.0),
                             least(most(ICE_SHOCK_STEEPNESS * (0.5 * fabs(jump) / c - ICE_SHOCK_FOOT), 0.0), 1.0));
    return (1.0 - fast) * (1.0 - dilatation);
}

/* A face between the upper state of the cell below it, number `from` of its row, and the lower state of the cell above it. */
FLOE_ALWAYS_INLINE ice_star star_at(const trace_block *b, int axis, ptrdiff_t at, double *const *lower, ptrdiff_t from,
                                    double *const *upper, ptrdiff_t t, const int dim, const bool several)
{
    const ptrdiff_t L = at - b->stride[axis];
    const double below = several ? lower[STATE_SOUND][from] : b->c[L],
                 above = several ? upper[STATE_SOUND][t] : b->c[at];
    const ice_side_of_face left = side_at(lower, from, below, dim), right = side_at(upper, t, above, dim);
    const double slow = slow_share(most(lower[STATE_MACH][from], upper[STATE_MACH][t]),
                                   most(lower[STATE_DILATATION][from], upper[STATE_DILATATION][t]),
                                   b->u[axis][at] - b->u[axis][L], least(below, above));
    return ice_star_of(&left, &right, axis, slow, dim);
}

/* The faces of some cells [first, end) of a row, normal to an axis. `back`: from a cell to that below it in the rows of states. */
FLOE_ALWAYS_INLINE void find_faces(const trace_block *b, const ice_view *v, int r, int axis, ptrdiff_t base,
                                   ice_span cells, double *const *lower, ptrdiff_t back, double *const *upper,
                                   const int dim, const bool several)
{
#pragma omp simd
    for (ptrdiff_t i = cells.first; i < cells.end; ++i) {
        const ptrdiff_t at = base + i;
        const ice_star s = star_at(b, axis, at, lower, 1 + i - back, upper, 1 + i, dim, several);
        v->m[r].fu[axis][at] = s.u[axis];
        v->fp[axis][at] = s.p;
        v->donor_rho[axis][at] = s.rho;
        v->donor_e[axis][at] = s.e;
        for (int a = 0; a < dim; ++a) v->donor_u[axis][a][at] = s.u[a];
    }
}

/* Edges of some cells of a row. */
FLOE_ALWAYS_INLINE void find_row_edges(const trace_block *b, const trace_row *w, ptrdiff_t base, ice_span cells,
                                       const int dim, const trace_kind kind)
{
#pragma omp simd
    for (ptrdiff_t i = cells.first; i < cells.end; ++i) {
        const ptrdiff_t at = base + i;
        double square = 0.0;
        for (int a = 0; a < dim; ++a) square += b->u[a][at] * b->u[a][at];
        w->mach[1 + i] = sqrt(square) / (kind == TRACE_ONE ? b->c[at] : medium_of(b, at, kind).c);
        w->dilatation[1 + i] = dilatation_share(b, at, dim);
    }
    for (int axis = 0; axis < dim; ++axis) {
#pragma omp simd
        for (ptrdiff_t i = cells.first; i < cells.end; ++i) find_edges(b, w, axis, base + i, 1 + i, dim, kind);
    }
}

FLOE_ALWAYS_INLINE void trace_row_states(const trace_block *b, const trace_row *w, int axis, ptrdiff_t base,
                                         ice_span cells, const int dim, const bool diffuses, const trace_kind kind)
{
#pragma omp simd
    for (ptrdiff_t i = cells.first; i < cells.end; ++i)
        trace_cell(b, w, axis, base + i, i, w->above, dim, diffuses, kind);
}

/* What a row of a region is traced with: a block a fluid, and one where several share cells. */
typedef struct trace_blocks {
    trace_block of[ICE_MAX_MATERIALS + 1];
} trace_blocks;

/* Edges of the cells of a row, where `axis` is none, else their states at the faces along it. Returns whether there are any. */
FLOE_ALWAYS_INLINE bool trace_row_cells(const trace_blocks *blocks, const trace_job *job, const trace_row *w, int axis,
                                        ptrdiff_t base, const int dim, const bool diffuses, const bool several)
{
    const ice_view *v = job->v;
    const int n = v->b->n[0];
    bool some = false;
    for (int r = several ? 0 : job->fluid; r < (several ? v->n_materials : job->fluid + 1); ++r) {
        if (several && v->material[r].points) continue;
        const trace_kind kind = several ? TRACE_ALONE : TRACE_ONE;
        for (ice_span run = {-1, -1}; ice_next_alone(v, r, base, 0, n + 1, &run); some = true)
            if (axis < 0)
                find_row_edges(&blocks->of[r], w, base, run, dim, kind);
            else
                trace_row_states(&blocks->of[r], w, axis, base, run, dim, diffuses, kind);
    }
    if (!several || !job->shares) return some;
    const trace_block *shared = &blocks->of[v->n_materials];
    for (ice_span run = {-1, -1}; ice_next_alone(v, v->n_materials, base, 0, n + 1, &run); some = true)
        if (axis < 0)
            find_row_edges(shared, w, base, run, dim, TRACE_SHARED);
        else
            trace_row_states(shared, w, axis, base, run, dim, diffuses, TRACE_SHARED);
    return some;
}

/* Faces of a row normal to an axis, local cells [0, end). Fluids that share cells have one velocity. */
FLOE_ALWAYS_INLINE void find_row_faces(const trace_blocks *blocks, const trace_job *job, int axis, ptrdiff_t base,
                                       int end, double *const *lower, double *const *upper, const int dim,
                                       const bool several)
{
    const ice_view *v = job->v;
    const ptrdiff_t step = v->b->stride[axis], back = axis == 0 ? 1 : 0;
    for (ice_span run = {0, 0}; several && job->shares && ice_next_traced(v, base, step, end, &run);) {
        find_faces(&blocks->of[0], v, 0, axis, base, run, lower, back, upper, dim, true);
        for (int r = 1; r < v->n_materials; ++r)
            memcpy(v->m[r].fu[axis] + base + run.first, v->m[0].fu[axis] + base + run.first,
                   (size_t)(run.end - run.first) * sizeof(double));
    }
    for (int r = several ? 0 : job->fluid; r < (several ? v->n_materials : job->fluid + 1); ++r) {
        if (several && (job->shares || v->material[r].points)) continue;
        for (ice_span run = {0, 0}; ice_next_alone(v, r, base, step, end, &run);)
            find_faces(&blocks->of[r], v, r, axis, base, run, lower, back, upper, dim, several);
    }
}

/* Faces between a row and the one before it along an axis, whose upper states are kept; and then those of this row. */
FLOE_ALWAYS_INLINE void cross_row(const trace_blocks *blocks, const trace_job *job, const trace_store *s, int axis,
                                  ptrdiff_t base, double *const *kept, bool faces, const int dim, const bool diffuses,
                                  const bool several)
{
    trace_row_cells(blocks, job, &s->row, axis, base, dim, diffuses, several);
    if (faces) find_row_faces(blocks, job, axis, base, job->v->b->n[0], kept, s->row.below, dim, several);
    for (int q = 0; q < STATE_VELOCITY + dim; ++q) memcpy(kept[q], s->row.above[q], s->length * sizeof(double));
    if (several) memcpy(kept[STATE_SOUND], s->row.above[STATE_SOUND], s->length * sizeof(double));
}

/* All faces of one row of a slab: those along it where it is the sweep's own, and those to the rows before it. */
FLOE_ALWAYS_INLINE void sweep_row(const trace_blocks *blocks, const trace_job *job, const trace_store *s, int slab,
                                  int row, const int dim, const bool diffuses, const bool several)
{
    const ice_view *v = job->v;
    const int slow = dim - 1, rows = dim == 3 ? v->b->n[1] : 1, n = v->b->n[0];
    const bool own_row = row >= 0 && row < rows, own_slab = dim == 1 || (slab >= job->first && slab < job->last);
    const ptrdiff_t base = mesh_index(v->b, 0, dim == 3 ? row : slab, dim == 3 ? slab : 0);
    if (!trace_row_cells(blocks, job, &s->row, -1, base, dim, diffuses, several)) return;
    if (own_row && own_slab) {
        trace_row_cells(blocks, job, &s->row, 0, base, dim, diffuses, several);
        find_row_faces(blocks, job, 0, base, n + 1, s->row.above, s->row.below, dim, several);
    }
    if (dim == 3 && own_slab) cross_row(blocks, job, s, 1, base, s->kept[1], row >= 0, dim, diffuses, several);
    if (dim > 1 && own_row) {
        double *kept[STATES];
        for (int q = 0; q < STATES; ++q) kept[q] = s->kept[slow][q] + (size_t)row * s->length;
        cross_row(blocks, job, s, slow, base, kept, slab >= job->first && (slab < job->last || job->end), dim, diffuses,
                  several);
    }
}
FLOE_ALWAYS_INLINE double *take_rows(double *from, double **rows, int n, size_t length)
{
    for (int q = 0; q < n; ++q, from += length) rows[q] = from;
    return from;
}

FLOE_ALWAYS_INLINE trace_store divide_buffer(const trace_job *job, const int dim)
{
    const block *b = job->v->b;
    trace_store s = {.length = trace_row_length(b)};
    double *rest = job->buffer;
    for (int a = 0; a < dim; ++a) {
        rest = take_rows(rest, s.row.lower[a], WAVES, s.length);
        rest = take_rows(rest, s.row.upper[a], WAVES, s.length);
        rest = take_rows(rest, s.row.slope[a], SLOPES, s.length);
    }
    rest = take_rows(rest, s.row.below, STATES, s.length);
    rest = take_rows(rest, s.row.above, STATES, s.length);
    rest = take_rows(rest, &s.row.mach, 1, s.length);
    rest = take_rows(rest, &s.row.dilatation, 1, s.length);
    for (int a = 1; a < dim; ++a) rest = take_rows(rest, s.kept[a], STATES, s.length * (size_t)(a == 2 ? b->n[1] : 1));
    return s;
}

FLOE_ALWAYS_INLINE void sweep_block(const trace_job *job, const int dim, const bool diffuses, const bool several)
{
    const ice_view *v = job->v;
    const trace_store s = divide_buffer(job, dim);
    const int rows = dim == 3 ? v->b->n[1] : 1, ghost = dim == 3 ? 1 : 0;
    const int end = several ? v->n_materials + job->shares : job->fluid + 1;
    int r = several ? 0 : job->fluid;
    trace_blocks blocks;
    do { /* there is one fluid at least */
        blocks.of[r] = trace_block_of(v, r, several && job->shares, dim);
    } while (++r < end);
    for (int slab = dim > 1 ? job->first - 1 : 0; slab <= (dim > 1 ? job->last : 0); ++slab) {
        if (dim > 1 && slab == job->last && !job->end) break;
        for (int row = -ghost; row < rows + ghost; ++row)
            sweep_row(&blocks, job, &s, slab, row, dim, diffuses, several);
    }
}

#define INSTANCE(d, diffuses)                                          \
    FLOE_WIDE static void trace_##d##_##diffuses(const trace_job *job) \
    {                                                                  \
        sweep_block(job, d, diffuses, false);                          \
    }
ICE_EACH(INSTANCE)
trace_slabs *const ice_trace_kernels[3][2] = ICE_TABLE(trace);

#define SEVERAL(d, diffuses)                                             \
    FLOE_WIDE static void several_##d##_##diffuses(const trace_job *job) \
    {                                                                    \
        sweep_block(job, d, diffuses, true);                             \
    }
ICE_EACH(SEVERAL)
trace_slabs *const ice_trace_several_kernels[3][2] = ICE_TABLE(several);

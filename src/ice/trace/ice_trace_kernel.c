/* The sweep of a block: edges of all cells of a row along all axes, their differences, what waves carry to the faces in half a step (normal ones by
 * their characteristics, Colella and Woodward 1984; those of other axes by their differences, after Colella 1990), and the faces. Theory 2.17. */
#include "ice/trace/ice_parabola.h"
#include "ice/trace/ice_star.h"
#include "ice/trace/ice_trace_rows.h"

#include <string.h>

/* What the kernels read of a block, apart from the view, so that the compiler knows that no store changes it. */
typedef struct trace_block {
    const double *restrict rho, *restrict p, *restrict e, *restrict c, *restrict u[3], *restrict flat[3];
    const double *restrict force[3],
        *restrict heat, *restrict warming; /* of viscosity and conduction: N/m3, W/m3; Pa in half the step */
    const double *lower0, *upper0;
    ptrdiff_t stride[3];
    double courant[3], weight[3], gravity[3]; /* dt/h; m2/s2: of a cell's height; m/s2 */
    double dt, floor;
    bool radial;
} trace_block;

FLOE_ALWAYS_INLINE trace_block trace_block_of(const trace_job *job, const int dim)
{
    const ice_view *v = job->v;
    const ice_fluid *m = &v->m[0];
    trace_block b = {.rho = m->rho,
                     .p = v->p,
                     .e = m->e,
                     .c = m->c,
                     .lower0 = v->lower0,
                     .upper0 = v->upper0,
                     .dt = v->dt,
                     .floor = job->pressure_floor,
                     .radial = v->radial};
    b.heat = m->heat;
    b.warming = v->P;
    for (int a = 0; a < dim; ++a) {
        b.force[a] = m->diff[a];
        b.u[a] = m->u[a];
        b.flat[a] = v->flat[a];
        b.stride[a] = v->b->stride[a];
        b.courant[a] = v->dt * v->inv_h[a];
        b.gravity[a] = v->gravity[a];
        b.weight[a] = v->gravity[a] * v->h[a];
    }
    return b;
}

FLOE_ALWAYS_INLINE ice_five five_of(const double *restrict q, ptrdiff_t at, ptrdiff_t step)
{
    return (ice_five){{q[at - 2 * step], q[at - step], q[at], q[at + step], q[at + 2 * step]}};
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

/* Edges of a cell along an axis, and their differences. */
FLOE_ALWAYS_INLINE void find_edges(const trace_block *b, const trace_row *w, int axis, ptrdiff_t at, ptrdiff_t t,
                                   const int dim)
{
    const ptrdiff_t step = b->stride[axis];
    const double c = b->c[at], rho0 = b->rho[at], z = rho0 * c, inv_c2 = 1.0 / (c * c),
                 enthalpy = (b->e[at] + b->p[at] / rho0) * inv_c2;
    const ice_five rho = five_of(b->rho, at, step), u = five_of(b->u[axis], at, step), e = five_of(b->e, at, step),
                   p = without_weight(five_of(b->p, at, step), rho, b->weight[axis]);
    /* Towards a vacuum pressure and velocity are limited themselves: the waves of one cell say little of the next. */
    const bool torn = u.q[3] - u.q[1] > ICE_TRACE_TORN * c;
    const double up_u = torn ? 0.0 : z, down_p = torn ? 0.0 : 1.0, down_u = torn ? 1.0 : -z,
                 heat_p = torn ? 0.0 : inv_c2;
    ice_five up = sum_of(p, up_u, u), down, entropy = sum_of(rho, -heat_p, p), energy;
    for (int n = 0; n < 5; ++n) {
        down.q[n] = down_p * p.q[n] + down_u * u.q[n];
        energy.q[n] = rho.q[n] * e.q[n] - enthalpy * p.q[n];
    }
    /* In slow flow without dilatation the differences of the axes must cancel as they do in div u: lines. Jumps of pressure are none of it. */
    const double slow = most(1.0 - w->mach[t], 0.0),
                 even = most(1.0 - ICE_TRACE_UNEVEN * fabs(p.q[3] - p.q[1]) / (z * c), 0.0),
                 lines = slow * slow * even * (1.0 - w->dilatation[t]);
    ice_edges q[WAVES];
    q[WAVE_UP] = ice_blend_edges(ice_parabola_edges(up), lines, ice_line_edges(up));
    q[WAVE_DOWN] = ice_blend_edges(ice_parabola_edges(down), lines, ice_line_edges(down));
    q[WAVE_ENTROPY] = ice_steepen_edges(ice_parabola_edges(entropy), contact_share(rho, p, z * c), entropy);
    q[WAVE_ENERGY] = ice_parabola_edges(energy);
    double mean[WAVES] = {up.q[2], down.q[2], entropy.q[2], energy.q[2]};
    for (int n = 0; n < dim - 1; ++n) {
        const ice_five across = five_of(b->u[(axis + 1 + n) % dim], at, step);
        q[WAVE_ACROSS + n] = ice_blend_edges(ice_parabola_edges(across), lines, ice_smooth_edges(across));
        mean[WAVE_ACROSS + n] = across.q[2];
    }
    const double *slow_shock = b->flat[axis];
    const double flat = most(slow_shock[at], p.q[3] < p.q[1] ? slow_shock[at + step] : slow_shock[at - step]);
    for (int n = 0; n < WAVE_ACROSS + dim - 1; ++n) q[n] = ice_blend_edges(q[n], flat, (ice_edges){mean[n], mean[n]});
    /* From there on in waves alone. */
    const ice_edges first = q[WAVE_UP], second = q[WAVE_DOWN], third = q[WAVE_ENTROPY];
    q[WAVE_UP] = (ice_edges){torn ? first.lower + z * second.lower : first.lower,
                             torn ? first.upper + z * second.upper : first.upper};
    q[WAVE_DOWN] = (ice_edges){torn ? first.lower - z * second.lower : second.lower,
                               torn ? first.upper - z * second.upper : second.upper};
    q[WAVE_ENTROPY] = (ice_edges){torn ? third.lower - inv_c2 * first.lower : third.lower,
                                  torn ? third.upper - inv_c2 * first.upper : third.upper};
    for (int n = 0; n < WAVE_ACROSS + dim - 1; ++n) {
        w->lower[axis][n][t] = q[n].lower;
        w->upper[axis][n][t] = q[n].upper;
    }
    const double d_up = q[WAVE_UP].upper - q[WAVE_UP].lower, d_down = q[WAVE_DOWN].upper - q[WAVE_DOWN].lower,
                 d_p = 0.5 * (d_up + d_down);
    w->slope[axis][SLOPE_PRESSURE][t] = d_p;
    w->slope[axis][SLOPE_DENSITY][t] = q[WAVE_ENTROPY].upper - q[WAVE_ENTROPY].lower + d_p * inv_c2;
    w->slope[axis][SLOPE_ENERGY][t] = q[WAVE_ENERGY].upper - q[WAVE_ENERGY].lower + d_p * enthalpy;
    w->slope[axis][SLOPE_VELOCITY + axis][t] = 0.5 * (d_up - d_down) / z;
    for (int n = 0; n < dim - 1; ++n)
        w->slope[axis][SLOPE_VELOCITY + (axis + 1 + n) % dim][t] = q[WAVE_ACROSS + n].upper - q[WAVE_ACROSS + n].lower;
}

/* Changes of a cell in half the step. */
typedef struct half_step {
    double rho, p, energy, u[3];
} half_step;

/* What the flow along the other axes, and a radius, do; bounded beside the state there is. */
FLOE_ALWAYS_INLINE half_step changes_across(const trace_block *b, const trace_row *w, int axis, ptrdiff_t at,
                                            ptrdiff_t i, ptrdiff_t t, const int dim, const bool diffuses)
{
    half_step d = {0.0, 0.0, 0.0, {0.0, 0.0, 0.0}};
    const double rho = b->rho[at], c = b->c[at], p = b->p[at], stiffness = rho * c * c, energy = rho * b->e[at];
    for (int a = 0; a < dim; ++a) {
        if (a == axis) continue;
        const double k = -0.5 * b->courant[a], u = b->u[a][at], du = w->slope[a][SLOPE_VELOCITY + a][t],
                     dp = w->slope[a][SLOPE_PRESSURE][t];
        d.rho += k * (u * w->slope[a][SLOPE_DENSITY][t] + rho * du);
        d.p += k * (u * (dp + b->weight[a] * rho) + stiffness * du);
        d.energy += k * (u * w->slope[a][SLOPE_ENERGY][t] + (energy + p) * du);
        for (int n = 0; n < dim; ++n) d.u[n] += k * u * w->slope[a][SLOPE_VELOCITY + n][t];
        d.u[a] += k * dp / rho;
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
        for (int n = 0; n < dim; ++n) d.u[n] += 0.5 * b->dt * b->force[n][at] / rho;
    }
    return d;
}

/* State at one face of a cell: the waves at it, the changes across, and the cell's own values where too little would be left. */
FLOE_ALWAYS_INLINE void put_state(const trace_block *b, const trace_row *w, int axis, ptrdiff_t at, ptrdiff_t t,
                                  const double *wave, double early, double weight, const half_step *d,
                                  double *const *to, const int dim)
{
    const double rho0 = b->rho[at], p0 = b->p[at], c = b->c[at], z = rho0 * c, inv_c2 = 1.0 / (c * c),
                 enthalpy = (b->e[at] + p0 / rho0) * inv_c2, sound = 0.5 * (wave[WAVE_UP] + wave[WAVE_DOWN]);
    const double p = sound + weight + d->p, rho = wave[WAVE_ENTROPY] + sound * inv_c2 + d->rho,
                 energy = wave[WAVE_ENERGY] + enthalpy * (sound + weight) + d->energy;
    const bool whole = p - b->floor > ICE_TRACE_LEAST_LEFT * (p0 - b->floor) && rho > ICE_TRACE_LEAST_LEFT * rho0 &&
                       energy > -HUGE_VAL;
    to[STATE_DENSITY][t] = whole ? rho : rho0;
    to[STATE_PRESSURE][t] = whole ? p : p0;
    to[STATE_ENERGY][t] = whole ? energy : rho0 * b->e[at];
    to[STATE_EARLY][t] = early;
    to[STATE_MACH][t] = w->mach[t];
    to[STATE_DILATATION][t] = w->dilatation[t];
    const double normal = 0.5 * (wave[WAVE_UP] - wave[WAVE_DOWN]) / z + d->u[axis];
    to[STATE_VELOCITY + axis][t] = whole ? normal : b->u[axis][at];
    for (int n = 0; n < dim - 1; ++n) {
        const int a = (axis + 1 + n) % dim;
        to[STATE_VELOCITY + a][t] = whole ? wave[WAVE_ACROSS + n] + d->u[a] : b->u[a][at];
    }
}

/* Traces a cell's waves to its lower and upper face. */
FLOE_ALWAYS_INLINE void trace_cell(const trace_block *b, const trace_row *w, int axis, ptrdiff_t at, ptrdiff_t i,
                                   ptrdiff_t t, double *const *below, double *const *above, const int dim,
                                   const bool diffuses)
{
    const double rho = b->rho[at], c = b->c[at], z = rho * c, u = b->u[axis][at], k = b->courant[axis], p = b->p[at],
                 inv_c2 = 1.0 / (c * c), enthalpy = (b->e[at] + p / rho) * inv_c2;
    const double speed[WAVES] = {u + c, u - c, u, u, u, u},
                 mean[WAVE_ACROSS] = {p + z * u, p - z * u, rho - p * inv_c2, rho * b->e[at] - enthalpy * p};
    double lower[WAVES], upper[WAVES];
    for (int n = 0; n < WAVE_ACROSS + dim - 1; ++n) {
        const ice_edges e = {w->lower[axis][n][t], w->upper[axis][n][t]};
        const double m = n < WAVE_ACROSS ? mean[n] : b->u[(axis + 1 + n - WAVE_ACROSS) % dim][at];
        lower[n] = ice_mean_above_lower(e, m, most(-speed[n] * k, -1.0));
        upper[n] = ice_mean_below_upper(e, m, most(speed[n] * k, -1.0));
    }
    half_step d = changes_across(b, w, axis, at, i, t, dim, diffuses);
    const double weight = 0.5 * b->weight[axis] * rho; /* of half the cell; and as the column passes by */
    d.p -= 0.5 * k * u * b->weight[axis] * rho;
    put_state(b, w, axis, at, t, lower, 0.5 * (w->lower[axis][WAVE_UP][t] - w->lower[axis][WAVE_DOWN][t]) / z, -weight,
              &d, below, dim);
    put_state(b, w, axis, at, t, upper, 0.5 * (w->upper[axis][WAVE_UP][t] - w->upper[axis][WAVE_DOWN][t]) / z, weight,
              &d, above, dim);
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

/* One face, between the upper state of the cell below it, number `from` of its row, and the lower state of the cell above it. */
FLOE_ALWAYS_INLINE void find_face(const trace_block *b, const ice_view *v, int axis, ptrdiff_t at, double *const *lower,
                                  ptrdiff_t from, double *const *upper, ptrdiff_t t, const int dim)
{
    const ice_fluid *m = &v->m[0];
    const ptrdiff_t L = at - b->stride[axis];
    const ice_side_of_face left = side_at(lower, from, b->c[L], dim), right = side_at(upper, t, b->c[at], dim);
    const double slow = slow_share(most(lower[STATE_MACH][from], upper[STATE_MACH][t]),
                                   most(lower[STATE_DILATATION][from], upper[STATE_DILATATION][t]),
                                   b->u[axis][at] - b->u[axis][L], least(b->c[L], b->c[at]));
    const ice_star s = ice_star_of(&left, &right, axis, slow, dim);
    m->fu[axis][at] = s.u[axis];
    v->fp[axis][at] = s.p;
    v->donor_rho[axis][at] = s.rho;
    v->donor_e[axis][at] = s.e;
    for (int a = 0; a < dim; ++a) v->donor_u[axis][a][at] = s.u[a];
}

/* Edges of the cells -1 to n of a row. */
FLOE_ALWAYS_INLINE void find_row_edges(const trace_block *b, const trace_row *w, ptrdiff_t base, ptrdiff_t n,
                                       const int dim)
{
#pragma omp simd
    for (ptrdiff_t i = -1; i <= n; ++i) {
        const ptrdiff_t at = base + i;
        double square = 0.0;
        for (int a = 0; a < dim; ++a) square += b->u[a][at] * b->u[a][at];
        w->mach[1 + i] = sqrt(square) / b->c[at];
        w->dilatation[1 + i] = dilatation_share(b, at, dim);
    }
    for (int axis = 0; axis < dim; ++axis) {
#pragma omp simd
        for (ptrdiff_t i = -1; i <= n; ++i) find_edges(b, w, axis, base + i, 1 + i, dim);
    }
}

FLOE_ALWAYS_INLINE void trace_row_states(const trace_block *b, const trace_row *w, int axis, ptrdiff_t base,
                                         ptrdiff_t n, double *const *above, const int dim, const bool diffuses)
{
#pragma omp simd
    for (ptrdiff_t i = -1; i <= n; ++i) trace_cell(b, w, axis, base + i, i, 1 + i, w->below, above, dim, diffuses);
}

/* Faces between a row and the one before it along an axis, whose upper states are kept; and then those of this row. */
FLOE_ALWAYS_INLINE void cross_row(const trace_block *b, const trace_job *job, const trace_store *s, int axis,
                                  ptrdiff_t base, double *const *kept, bool faces, const int dim, const bool diffuses)
{
    const ptrdiff_t n = job->v->b->n[0];
    trace_row_states(b, &s->row, axis, base, n, s->row.above, dim, diffuses);
    if (faces) {
#pragma omp simd
        for (ptrdiff_t i = 0; i < n; ++i) find_face(b, job->v, axis, base + i, kept, 1 + i, s->row.below, 1 + i, dim);
    }
    for (int q = 0; q < STATE_VELOCITY + dim; ++q) memcpy(kept[q], s->row.above[q], s->length * sizeof(double));
}

/* All faces of one row. inner: its cells are the sweep's own; whole: of the slab in hand, not of the one before or after. */
FLOE_ALWAYS_INLINE void sweep_row(const trace_block *b, const trace_job *job, const trace_store *s, int slab, int row,
                                  const int dim, const bool diffuses)
{
    const ice_view *v = job->v;
    const int slow = dim - 1, rows = dim == 3 ? v->b->n[1] : 1;
    const bool own_row = row >= 0 && row < rows, own_slab = dim == 1 || (slab >= job->first && slab < job->last);
    const ptrdiff_t base = mesh_index(v->b, 0, dim == 3 ? row : slab, dim == 3 ? slab : 0), n = v->b->n[0];
    find_row_edges(b, &s->row, base, n, dim);
    if (own_row && own_slab) {
        trace_row_states(b, &s->row, 0, base, n, s->row.above, dim, diffuses);
#pragma omp simd
        for (ptrdiff_t i = 0; i <= n; ++i) find_face(b, v, 0, base + i, s->row.above, i, s->row.below, 1 + i, dim);
    }
    if (dim == 3 && own_slab) cross_row(b, job, s, 1, base, s->kept[1], row >= 0, dim, diffuses);
    if (dim > 1 && own_row) {
        double *kept[STATES];
        for (int q = 0; q < STATES; ++q) kept[q] = s->kept[slow][q] + (size_t)row * s->length;
        cross_row(b, job, s, slow, base, kept, slab >= job->first && (slab < job->last || job->end), dim, diffuses);
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
    trace_store s = {.length = ((size_t)b->n[0] + 2 + 7) / 8 * 8};
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

FLOE_ALWAYS_INLINE void sweep_block(const trace_job *job, const int dim, const bool diffuses)
{
    const trace_block b = trace_block_of(job, dim);
    const trace_store s = divide_buffer(job, dim);
    const int rows = dim == 3 ? job->v->b->n[1] : 1, ghost = dim == 3 ? 1 : 0;
    for (int slab = dim > 1 ? job->first - 1 : 0; slab <= (dim > 1 ? job->last : 0); ++slab) {
        if (dim > 1 && slab == job->last && !job->end) break;
        for (int row = -ghost; row < rows + ghost; ++row) sweep_row(&b, job, &s, slab, row, dim, diffuses);
    }
}

#define INSTANCE(d, diffuses)                                          \
    FLOE_WIDE static void trace_##d##_##diffuses(const trace_job *job) \
    {                                                                  \
        sweep_block(job, d, diffuses);                                 \
    }
ICE_EACH(INSTANCE)
trace_slabs *const ice_trace_kernels[3][2] = ICE_TABLE(trace);

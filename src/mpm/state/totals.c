/* Sums and limits over the current points: within tiles, then over tiles in order. */
#include "base/threads.h"
#include "grid/tile_box.h"
#include "mpm/loads/spring.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/motion/motion.h"
#include "mpm/mpm_constants.h"
#include "mpm/state/region.h"
#include "mpm/state/stress.h"
#include "mpm/thermal/thermal.h"
#include "mpm/thermal/thermal_stress.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

/* One body's sums in one tile. */
enum {
    SUM_MASS,
    SUM_KINETIC,
    SUM_STRAIN,
    SUM_INTERNAL,
    SUM_VOLUME,
    SUM_MOMENTUM,
    SUM_SCALE = SUM_MOMENTUM + 3,
    SUM_MOMENT = SUM_SCALE + 3,
    SUM_HEAT = SUM_MOMENT + 3,
    SUM_END
};

static void sum_chunk(const mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch, double *sum)
{
    const mpm_body *b = &s->body[body];
    const fields *f = s->domain->fields[blk];
    double psi[SOLID_CHUNK] = {0};
    load_batch(s, blk, body, start, end, false, batch);
    if (b->law->strain_energy && b->expansion != 0.0 && (b->law->needs & SOLID_NEEDS_F))
        thermal_strain_energy(s, blk, body, start, batch, psi);
    else if (b->law->strain_energy)
        b->law->strain_energy(b->law_par, batch, psi);
    if (b->membrane.model) membrane_energies(s, blk, body, start, end, psi);
    const double *mass = field_get(f, P_MASS, body, 0), *volume = field_get(f, P_VOLUME0, body, 0),
                 *T = field_get(f, P_TEMP, body, 0);
    const double *velocity[3], *place[3];
    for (int a = 0; a < s->mesh->dim; ++a) {
        velocity[a] = field_get(f, P_VEL, body, a);
        place[a] = field_get(f, P_POS, body, a);
    }
    for (size_t k = start; k < end; ++k) {
        double square = 0.0;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double v = velocity[a][k];
            square += v * v;
            sum[SUM_MOMENTUM + a] += mass[k] * v;
            sum[SUM_SCALE + a] += mass[k] * fabs(v);
            sum[SUM_MOMENT + a] += mass[k] * place[a][k];
        }
        sum[SUM_MASS] += mass[k];
        sum[SUM_KINETIC] += 0.5 * mass[k] * square;
        sum[SUM_STRAIN] += volume[k] * psi[k - start];
        if (b->law->needs & SOLID_HAS_ENERGY) sum[SUM_INTERNAL] += mass[k] * batch->energy[k - start];
        if (T) sum[SUM_HEAT] += mass[k] * b->specific_heat * T[k];
        sum[SUM_VOLUME] += volume[k] * batch->J[k - start];
    }
}

static void sum_totals_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    const int body = *(const int *)user;
    const size_t *at = s->points[blk][body].tile_start;
    for (size_t k = at[tile]; k < at[tile + 1]; k += SOLID_CHUNK)
        sum_chunk(s, blk, body, k, k + SOLID_CHUNK < at[tile + 1] ? k + SOLID_CHUNK : at[tile + 1],
                  &s->scratch->batch[thread_number()], sum);
}

floe_status mpm_sum(mpm *s, mpm_totals *out)
{
    memset(out, 0, sizeof *out);
    out->springs = spring_energy(s);
    for (int b = 0; b < s->n_bodies; ++b) {
        double sum[SUM_END];
        sum_over_tiles(s, SUM_END, sum_totals_tile, &b, sum);
        out->mass[b] = sum[SUM_MASS];
        out->kinetic[b] = sum[SUM_KINETIC];
        out->strain[b] = sum[SUM_STRAIN];
        out->internal[b] = sum[SUM_INTERNAL] + sum[SUM_HEAT];
        out->heat[b] = sum[SUM_HEAT];
        out->volume[b] = sum[SUM_VOLUME];
        for (int a = 0; a < 3; ++a) {
            out->momentum[b][a] = sum[SUM_MOMENTUM + a];
            out->momentum_scale[a] += sum[SUM_SCALE + a];
            out->moment[b][a] = sum[SUM_MOMENT + a];
        }
    }
    return FLOE_OK;
}

/* Volume and pressure times volume of a fluid's points inside a region, in one tile. */
static void tile_pressure(const mpm *s, int blk, int tile, int body, const shape *region, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const size_t *at = s->points[blk][body].tile_start;
    const double *volume = field_get(f, P_VOLUME0, body, 0), *J = field_get(f, P_J, body, 0);
    const double *stress[3];
    for (int c = 0; c < 3; ++c) stress[c] = field_get(f, P_STRESS, body, c);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        const double part = point_region_share(s, f, body, k, region) * volume[k] * J[k];
        sum[0] += part;
        sum[1] -= part * (stress[0][k] + stress[1][k] + stress[2][k]) / 3.0;
    }
}

typedef struct region_sum {
    int material;
    const shape *region;
} region_sum;

static void sum_tile_pressure(mpm *s, int blk, int tile, void *user, double *sum)
{
    const region_sum *r = user;
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].scene_material == r->material) tile_pressure(s, blk, tile, body, r->region, sum);
}

floe_status mpm_mean_pressure(mpm *s, int material, const shape *region, double *pressure)
{
    double sum[2];
    sum_over_tiles(s, 2, sum_tile_pressure, &(region_sum){material, region}, sum);
    if (!(sum[0] > 0.0)) return fail(s->ctx, FLOE_BAD_INPUT, "no point of its fluid lies in its region");
    *pressure = sum[1] / sum[0] + s->scene->reference_pressure;
    return FLOE_OK;
}

/* Viscosity shortens a fluid's step: nu (4/3 mu + kappa over rho) times 2/h^2 for each axis, beside what sound crosses. */
static void add_viscous_rate(const mpm_body *b, const solid_batch *batch, double inverse_square, double *rate)
{
    const double mu = 4.0 / 3.0 * b->fluid_par.shear_viscosity + b->fluid_par.bulk_viscosity;
    if (!b->fluid || mu == 0.0) return;
    for (size_t k = 0; k < batch->n; ++k) rate[k] += 2.0 * mu * batch->J[k] / batch->rho0[k] * inverse_square;
}

/* Largest rates (1/s) over points: at which information or a point crosses cells, c |1/h| + sum |v| / h; and at which points do. */
typedef struct crossing_rates {
    double all, points;
} crossing_rates;

/* Over a chunk. */
static crossing_rates chunk_rates(const mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch)
{
    const mpm_body *b = &s->body[body];
    double rate[SOLID_CHUNK], motion[SOLID_CHUNK] = {0.0}, inverse_square = 0.0;
    crossing_rates worst = {0.0, 0.0};
    const size_t n = end - start;
    load_speed_batch(s, blk, body, start, end, batch);
    b->law->wave_speed(b->law_par, s->scene->reference_pressure, batch, rate);
    /* Artificial viscosity shortens the step: its linear term is a wave speed, its quadratic one q over c. */
    for (size_t k = 0; has_artificial(b) && k < n; ++k)
        rate[k] = rate[k] * (1.0 + 2.0 * b->artificial[0]) + 2.0 * sqrt(batch->q[k] * batch->J[k] / batch->rho0[k]);
    for (int a = 0; a < s->mesh->dim; ++a) inverse_square += 1.0 / (s->mesh->h[a] * s->mesh->h[a]);
    const double diagonal = sqrt(inverse_square);
    for (size_t k = 0; k < n; ++k) rate[k] *= walls_are_stiff(s) ? 0.0 : diagonal;
    add_viscous_rate(b, batch, inverse_square, rate);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double *restrict v = field_get(s->domain->fields[blk], P_VEL, body, a) + start;
        const double inv_h = 1.0 / s->mesh->h[a];
        for (size_t k = 0; k < n; ++k) motion[k] += fabs(v[k]) * inv_h;
    }
    for (size_t k = 0; k < n; ++k) {
        rate[k] += motion[k];
        if (!(rate[k] <= worst.all)) worst.all = rate[k];
        if (motion[k] > worst.points) worst.points = motion[k];
    }
    return worst;
}

/* Largest stable step over h/c along a line, by basis (theory 4.6): from the eigenvalues of a step of a bar with free ends, 1 to 5 points a cell at
 * any position, with and without the penalty at edges (bodies in contact have none). The light nodes at the ends limit it. */
static double stable_share(const mpm *s)
{
    static const int order[] = {2, 4, 6};
    if (s->transfer->restore) {
        int column = 0;
        while (column < 3 && s->order > order[column]) ++column;
        return s->basis->fact.restored_share[column];
    }
    if (s->transfer->carry != CARRY_NOTHING) return s->basis->fact.carried_share;
    return s->scene->method.stress == STRESS_USL ? s->basis->fact.usl_share : 1.0;
}

/* In the plane and in space the step is less than h/c by the diagonal already, and the worst place is a corner. */
static double stable_share_here(const mpm *s)
{
    const bool joined = s->contact && s->transfer->restore && !s->basis->fact.hats;
    const double most = !joined ? 1.0 : s->mesh->dim == 1 ? MPM_CONTACT_STEP : MPM_CONTACT_STEP_IN_SPACE;
    return fmin(most, s->mesh->dim == 1 ? stable_share(s) : MPM_STEP_IN_SPACE * stable_share(s));
}

static void limit_by_conduction(const mpm *s, step_limit *out)
{
    int body = 0;
    const double step = conduction_step(s, &body);
    if (!(step < out->dt)) return;
    out->dt = step;
    out->reason = s->scene->body[body].name;
}

floe_status mpm_time_step(mpm *s, step_limit *out)
{
    double worst = 0.0, fastest = 0.0;
    int limiting = 0;
    for (int body = 0; body < s->n_bodies; ++body) {
        double rate = body < s->n_deforming ? 0.0 : motion_rate(s, body);
        for (int b = 0; body < s->n_deforming && b < s->mesh->n_blocks; ++b) {
            const size_t n = s->points[b][body].n, chunks = (n + SOLID_CHUNK - 1) / SOLID_CHUNK;
#pragma omp parallel for schedule(static) reduction(max : rate, fastest)
            for (size_t k = 0; k < chunks; ++k) {
                const size_t start = k * SOLID_CHUNK, end = start + SOLID_CHUNK < n ? start + SOLID_CHUNK : n;
                const crossing_rates r = chunk_rates(s, b, body, start, end, &s->scratch->batch[thread_number()]);
                if (r.all > rate || isnan(r.all)) rate = isnan(r.all) ? (double)INFINITY : r.all;
                fastest = fmax(fastest, r.points);
            }
        }
        if (rate > worst) {
            worst = rate;
            limiting = body;
        }
    }
    if (!isfinite(worst))
        return fail(s->ctx, FLOE_DIVERGED, "a wave speed or velocity of body '%s' is not finite at t = %.6g s",
                    s->scene->body[s->body[limiting].scene_body].name, s->time);
    s->fastest = fastest;
    out->reason = s->scene->body[s->body[limiting].scene_body].name;
    const double of_springs = spring_rate(s, &out->reason);
    if (of_springs > worst)
        worst = of_springs;
    else
        out->reason = s->scene->body[s->body[limiting].scene_body].name;
    out->dt = worst > 0.0 ? fmin(s->scene->time.cfl_mpm, stable_share_here(s)) / worst : (double)INFINITY;
    limit_by_conduction(s, out);
    return FLOE_OK;
}

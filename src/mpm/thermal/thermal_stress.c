#include "mpm/thermal/thermal_stress.h"

#include "mpm/thermal/thermal.h"

#include <math.h>
#include <string.h>

static bool goes_by_F(const mpm_body *b)
{
    return (b->law->needs & SOLID_NEEDS_F) != 0;
}

void load_heat(const mpm *s, int blk, int body, size_t start, solid_batch *b)
{
    const fields *f = s->domain->fields[blk];
    const mpm_body *m = &s->body[body];
    const double *T = m->warms ? field_get(f, P_TEMP, body, 0) + start : NULL,
                 *free = m->warms ? field_get(f, P_STRESS_FREE, body, 0) + start : NULL;
    for (size_t k = 0; k < b->n; ++k) {
        b->temperature[k] = T ? T[k] : 0.0;
        b->heat[k] = T ? m->specific_heat * (T[k] - free[k]) : 0.0;
    }
}

/* F and J times powers of `stretch` or of its inverse. */
static void scale_deformation(solid_batch *b, const double *stretch, bool inverse)
{
    for (size_t k = 0; k < b->n; ++k) {
        const double x = inverse ? 1.0 / stretch[k] : stretch[k], cube = x * x * x;
        for (int c = 0; c < 9; ++c) b->F[c][k] *= x;
        b->J[k] *= cube;
        b->J_old[k] *= cube;
    }
}

/* The share of the thermal strain at the end of the step: in static load increments it grows in proportion to the run, like constant loads. */
static double strain_share(const mpm *s)
{
    if (s->solver != SOLVER_STATIC) return 1.0;
    return fmin(1.0, (s->time + s->dt) / s->scene->time.end);
}

/* Elastic rates are those of the motion less the rate of the thermal stretch. In a step without duration nothing strains. */
static void take_out_strain(double expansion, const double *T, const double *free, const double *old, solid_batch *b,
                            thermal_batch *t)
{
    for (size_t k = 0; k < b->n; ++k) {
        t->stretch[k] = b->dt > 0.0 ? 1.0 + expansion * (T[k] - free[k]) : old[k];
        t->growth[k] = log(t->stretch[k] / old[k]);
        t->trace[k] = b->stress[0][k] + b->stress[1][k] + b->stress[2][k];
        const double rate = b->dt > 0.0 ? t->growth[k] / b->dt : 0.0;
        for (int a = 0; a < 3; ++a) b->L[4 * a][k] -= rate;
    }
}

void begin_thermal_stress(const mpm *s, int blk, int body, size_t start, solid_batch *b, thermal_batch *t)
{
    const fields *f = s->domain->fields[blk];
    const mpm_body *m = &s->body[body];
    if (m->law->needs & SOLID_HAS_ENERGY) memcpy(t->energy, b->energy, b->n * sizeof *t->energy);
    for (size_t k = 0; (m->depends_on & SOLID_BY_ENERGY) && k < b->n; ++k)
        t->trace[k] = b->stress[0][k] + b->stress[1][k] + b->stress[2][k];
    if (m->expansion == 0.0) return;
    for (int a = 0; a < 3; ++a) memcpy(t->rate[a], b->L[4 * a], b->n * sizeof *t->rate[a]);
    take_out_strain(strain_share(s) * m->expansion, field_get(f, P_TEMP, body, 0) + start,
                    field_get(f, P_STRESS_FREE, body, 0) + start, field_get(f, P_THERMAL_STRETCH, body, 0) + start, b,
                    t);
    if (goes_by_F(m)) scale_deformation(b, t->stretch, true);
}

/* An equation of state has the work of its pressure in the energy of the law, where it stays. */
static void leave_work_of_pressure(const solid_batch *b, const double *trace, double *before)
{
    for (size_t k = 0; k < b->n; ++k)
        before[k] += (trace[k] + b->stress[0][k] + b->stress[1][k] + b->stress[2][k]) / 6.0 * (b->J[k] - b->J_old[k]) /
                     b->rho0[k];
}

/* Artificial viscosity makes heat alone; of plastic work a share becomes heat, and the rest stays energy of the law. */
static void put_heat_aside(const mpm *s, int blk, int body, size_t start, solid_batch *b, const double *before)
{
    const double share = s->body[body].plastic_heat;
    double *heat = field_get(s->domain->fields[blk], P_DISSIPATED, body, 0) + start;
    for (size_t k = 0; k < b->n; ++k) {
        const double work = b->energy[k] - before[k], viscous = -b->q[k] * (b->J[k] - b->J_old[k]) / b->rho0[k];
        heat[k] = viscous + share * (work - viscous);
        b->energy[k] -= heat[k];
    }
}

/* What the stress does on the thermal strain is neither motion nor strain energy: it is the heat's, so that the energy of the step is closed. */
static void take_thermal_work(const mpm *s, int blk, int body, size_t start, const solid_batch *b,
                              const thermal_batch *t)
{
    const fields *f = s->domain->fields[blk];
    const double *mass = field_get(f, P_MASS, body, 0) + start, *volume = field_get(f, P_VOLUME0, body, 0) + start;
    double *heat = field_get(f, P_DISSIPATED, body, 0);
    if (!heat) return; /* in steps that are solved for temperatures stay */
    for (size_t k = 0; k < b->n; ++k) {
        const double trace = 0.5 * (t->trace[k] + b->stress[0][k] + b->stress[1][k] + b->stress[2][k]);
        const double work = trace * t->growth[k] * b->J[k] * volume[k] / mass[k];
        heat[start + k] = work + (dissipates_heat(s, body) ? heat[start + k] : 0.0);
    }
}

void end_thermal_stress(const mpm *s, int blk, int body, size_t start, solid_batch *b, thermal_batch *t)
{
    const mpm_body *m = &s->body[body];
    if (m->depends_on & SOLID_BY_ENERGY) leave_work_of_pressure(b, t->trace, t->energy);
    if (dissipates_heat(s, body)) put_heat_aside(s, blk, body, start, b, t->energy);
    if (m->expansion == 0.0) return;
    if (goes_by_F(m)) scale_deformation(b, t->stretch, false);
    take_thermal_work(s, blk, body, start, b, t);
    /* along a line and in the plane nothing else sets the rates across */
    for (int a = 0; a < 3; ++a) memcpy(b->L[4 * a], t->rate[a], b->n * sizeof *t->rate[a]);
    memcpy(field_next(s->domain->fields[blk], P_THERMAL_STRETCH, body, 0) + start, t->stretch,
           b->n * sizeof *t->stretch);
}

/* Moduli are those of the solid at rest as large as it has grown: per initial volume the energy is that much larger. */
void thermal_strain_energy(const mpm *s, int blk, int body, size_t start, solid_batch *b, double *psi)
{
    const mpm_body *m = &s->body[body];
    const double *stretch = field_get(s->domain->fields[blk], P_THERMAL_STRETCH, body, 0) + start;
    scale_deformation(b, stretch, true);
    m->law->strain_energy(m->law_par, b, psi);
    scale_deformation(b, stretch, false);
    for (size_t k = 0; k < b->n; ++k) psi[k] *= stretch[k] * stretch[k] * stretch[k];
}

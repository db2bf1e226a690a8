#include "material/metal.h"

#include "material/eos_mie_grueneisen.h"

static bool has_shock_pressure(const metal_par *a)
{
    return a->grueneisen > 0.0;
}

double metal_fail(const metal_par *a, solid_batch *b, size_t i)
{
    const double old[6] = {b->stress[XX][i], b->stress[YY][i], b->stress[ZZ][i],
                           b->stress[XY][i], b->stress[YZ][i], b->stress[ZX][i]};
    const double mean = mean_stress(old), stored = elastic_energy_density(&a->elastic, b->J_old[i], old);
    b->history[FAILED][i] = 1.0;
    /* the work of a Mie-Grueneisen pressure is internal energy already */
    return has_shock_pressure(a) ? stored - b->J_old[i] * 0.5 / a->elastic.bulk_modulus * mean * mean : stored;
}

/* c_0 is that of the bulk modulus at rest; energy is counted from rest, so that heat capacity and temperature of the
 * curve are of no account. */
static mie_grueneisen_state state_at(const metal_par *a, const solid_batch *b, size_t i, double e)
{
    const double rho0 = b->rho0[i];
    const mie_grueneisen_par curve = {.density = rho0,
                                      .sound_speed = sqrt(a->elastic.bulk_modulus / rho0),
                                      .slope = a->shock_slope,
                                      .grueneisen = a->grueneisen};
    return mie_grueneisen_at(&curve, rho0 / b->J[i], e);
}

/* p' = p(J', e'), e' = e - (p + p') (J' - J) / (2 rho0), is linear in p'. */
size_t metal_shock_pressure(const metal_par *a, solid_batch *b, const double *before)
{
    for (size_t i = 0; i < b->n; i++) {
        const double half = 0.5 * (b->J[i] - b->J_old[i]) / b->rho0[i];
        const double e = b->energy[i] + before[i] * half;
        const mie_grueneisen_state at = state_at(a, b, i, e + b->heat[i]);
        double p = at.p / (1.0 + at.dpde * half);
        if (!isfinite(p)) return i + 1;
        if (b->history[FAILED][i] != 0.0) {
            b->history[OPENING][i] = p < 0.0 ? -p / a->elastic.bulk_modulus : 0.0;
            p = fmax(p, 0.0);
        }
        const double mean = mean_stress_at(b, i);
        for (int k = XX; k <= ZZ; k++) b->stress[k][i] = (b->stress[k][i] - mean) - p;
        b->energy[i] = e - p * half;
    }
    return 0;
}

void metal_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const metal_par *a = par;
    elastic_wave_speed(par, p_ref, b, c);
    if (!has_shock_pressure(a)) return;
    for (size_t i = 0; i < b->n; i++) {
        const mie_grueneisen_state at = state_at(a, b, i, b->energy[i] + b->heat[i]);
        c[i] = sqrt(fmax(at.c2, 0.0) + 4.0 / 3.0 * a->elastic.shear_modulus * b->J[i] / b->rho0[i]);
    }
}

/* Of a Mie-Grueneisen pressure only shear is strain energy. */
void metal_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const metal_par *a = par;
    elastic_strain_energy(par, b, psi);
    if (!has_shock_pressure(a)) return;
    for (size_t i = 0; i < b->n; i++) {
        const double mean = mean_stress_at(b, i);
        psi[i] = fmax(psi[i] - b->J[i] * 0.5 / a->elastic.bulk_modulus * mean * mean, 0.0);
    }
}

unsigned metal_depends(const void *par)
{
    return has_shock_pressure(par) ? SOLID_BY_ENERGY : 0;
}

const char *metal_check(const void *par)
{
    const metal_par *a = par;
    if (a->shock_slope == 0.0 && a->grueneisen == 0.0) return NULL;
    if (!(a->shock_slope > 0.0)) return "its grueneisen needs a shock_slope beside it";
    if (!(a->grueneisen > 0.0)) return "its shock_slope needs a grueneisen beside it";
    if (!(a->grueneisen < 2.0 * a->shock_slope))
        return "its grueneisen must be less than twice its shock_slope: compression by 1/shock_slope would have a "
               "limit "
               "of pressure before";
    return NULL;
}

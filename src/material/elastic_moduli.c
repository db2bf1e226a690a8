#include "material/elastic_moduli.h"

#include <math.h>

double elastic_bulk_modulus(const void *par)
{
    return ((const elastic_moduli *)par)->bulk_modulus;
}

double elastic_shear_modulus(const void *par)
{
    return ((const elastic_moduli *)par)->shear_modulus;
}

void elastic_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const elastic_moduli *a = par;
    const double modulus = a->bulk_modulus + 4.0 / 3.0 * a->shear_modulus;
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) c[i] = sqrt(modulus * b->J[i] / b->rho0[i]);
}

double elastic_energy_density(const elastic_moduli *a, double J, const double s[6])
{
    const double mean = (s[0] + s[1] + s[2]) / 3.0;
    const double sx = s[0] - mean, sy = s[1] - mean, sz = s[2] - mean;
    const double s2 = sx * sx + sy * sy + sz * sz + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    return J * (0.5 / a->bulk_modulus * mean * mean + 0.25 / a->shear_modulus * s2);
}

void elastic_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    for (size_t i = 0; i < b->n; i++) {
        double s[6];
        for (int k = 0; k < 6; k++) s[k] = b->stress[k][i];
        psi[i] = elastic_energy_density(par, b->J[i], s);
    }
}

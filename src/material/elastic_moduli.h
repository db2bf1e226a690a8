/* The two moduli of an isotropic elastic solid, and what laws of small elastic strain have in common through them. */
#ifndef MATERIAL_ELASTIC_MODULI_H
#define MATERIAL_ELASTIC_MODULI_H

#include "material/solid.h"

/* The first member of such a law's parameters. */
typedef struct elastic_moduli {
    double bulk_modulus;  /* Pa, K > 0 */
    double shear_modulus; /* Pa, G > 0 */
} elastic_moduli;

/* The rows that such a law has in its table of parameters. */
#define ELASTIC_MODULI                                                                                     \
    PAR_POSITIVE(elastic_moduli, bulk_modulus, "Pa", NAN, "bulk modulus K = E / (3 (1 - 2 nu)), at rest"), \
        PAR_POSITIVE(elastic_moduli, shear_modulus, "Pa", NAN, "shear modulus G = E / (2 (1 + nu)), at rest")

/* Lame's first parameter (Pa), K - 2 G / 3. */
static inline double lame_lambda(const elastic_moduli *a)
{
    return a->bulk_modulus - 2.0 / 3.0 * a->shear_modulus;
}

/* Entries of solid_model (material/solid.h); par begins with an elastic_moduli. */
double elastic_bulk_modulus(const void *par);
double elastic_shear_modulus(const void *par);
/* Longitudinal waves of small strain: c^2 = (K + 4 G / 3) / rho. It bounds plastic waves, and those of failed
 * points. */
void elastic_wave_speed(const void *par, double p_ref, const solid_batch *b, double *c);
/* J [p^2/(2K) + s:s/(4G)] per initial volume: the work of small strains; laws in rate form have no exact potential at
 * large ones. */
void elastic_strain_energy(const void *par, const solid_batch *b, double *psi);
/* The same at one point, of Cauchy stress s (xx, yy, zz, xy, yz, zx; Pa) and volume ratio J; J/m3. */
double elastic_energy_density(const elastic_moduli *a, double J, const double s[6]);

#endif

/* Linear elasticity in rate form, for small strains and any rotation: the Jaumann rate of the Cauchy stress is
 * lambda tr(D) I + 2 G D (hypoelastic.h). */
#include "material/hypoelastic.h"
#include "material/solid_checks.h"

#include <math.h>

typedef struct linear_elastic_par {
    double bulk_modulus;  /* Pa */
    double shear_modulus; /* Pa */
} linear_elastic_par;

static const param_spec linear_elastic_params[] = {
    {.key = "bulk_modulus",
     .unit = "Pa",
     .range = PARAM_POSITIVE,
     .fallback = NAN,
     .offset = offsetof(linear_elastic_par, bulk_modulus),
     .count = 1,
     .doc = "bulk modulus K"},
    {.key = "shear_modulus",
     .unit = "Pa",
     .range = PARAM_POSITIVE,
     .fallback = NAN,
     .offset = offsetof(linear_elastic_par, shear_modulus),
     .count = 1,
     .doc = "shear modulus G"},
};

FLOE_ALWAYS_INLINE void stress_body(const linear_elastic_par *a, solid_batch *restrict b, bool planar)
{
    const double lambda = a->bulk_modulus - 2.0 / 3.0 * a->shear_modulus, G = a->shear_modulus;
    for (size_t i = 0; i < b->n; i++) {
        double s[6];
        hypoelastic_step(lambda, G, b, i, planar, s);
        for (int k = 0; k < 6; k++) b->stress[k][i] = s[k];
    }
}

static size_t linear_elastic_stress(const void *par, double p_ref, solid_batch *b)
{
    (void)p_ref; /* the stress of a solid is gauge already */
    if (spins_about_z_alone(b))
        stress_body(par, b, true);
    else
        stress_body(par, b, false);
    return solid_first_inverted(b);
}

static void linear_elastic_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const linear_elastic_par *a = par;
    (void)p_ref;
    hypoelastic_wave_speeds(a->bulk_modulus, a->shear_modulus, b, c);
}

static void linear_elastic_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const linear_elastic_par *a = par;
    hypoelastic_energies(a->bulk_modulus, a->shear_modulus, b, psi);
}

static double linear_elastic_bulk_modulus(const void *par)
{
    return ((const linear_elastic_par *)par)->bulk_modulus;
}

static double linear_elastic_shear_modulus(const void *par)
{
    return ((const linear_elastic_par *)par)->shear_modulus;
}

const solid_model solid_linear_elastic = {
    .name = "linear_elastic",
    .doc = "linear elasticity with the Jaumann rate: small strains, any rotation",
    .cite = "T. J. R. Hughes, J. Winget, Int. J. Numer. Meth. Engng 15 (1980) 1862",
    .param_size = sizeof(linear_elastic_par),
    .params = linear_elastic_params,
    .n_params = sizeof linear_elastic_params / sizeof *linear_elastic_params,
    .needs = 0,
    .n_history = 0,
    .stress = linear_elastic_stress,
    .wave_speed = linear_elastic_wave_speed,
    .strain_energy = linear_elastic_strain_energy,
    .bulk_modulus = linear_elastic_bulk_modulus,
    .shear_modulus = linear_elastic_shear_modulus,
};

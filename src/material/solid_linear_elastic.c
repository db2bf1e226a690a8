/* Linear elasticity in rate form, for small strains and any rotation: the Jaumann rate of the Cauchy stress is
 * lambda tr(D) I + 2 G D (hypoelastic.h). */
#include "material/elastic_moduli.h"
#include "material/hypoelastic.h"
#include "material/solid_checks.h"

#include <math.h>

static const param_spec linear_elastic_params[] = {ELASTIC_MODULI};

FLOE_ALWAYS_INLINE void stress_body(const elastic_moduli *a, solid_batch *restrict b, bool planar)
{
    const double lambda = a->bulk_modulus - 2.0 / 3.0 * a->shear_modulus, G = a->shear_modulus;
    for (size_t i = 0; i < b->n; i++) {
        double s[6];
        hypoelastic_step(lambda, G, b, i, planar, s);
        for (int k = 0; k < 6; k++) b->stress[k][i] = s[k];
    }
}

FLOE_WIDE static void stress_in_plane(const elastic_moduli *a, solid_batch *b)
{
    stress_body(a, b, true);
}

FLOE_WIDE static void stress_in_space(const elastic_moduli *a, solid_batch *b)
{
    stress_body(a, b, false);
}

static size_t linear_elastic_stress(const void *par, double p_ref, solid_batch *b)
{
    (void)p_ref; /* the stress of a solid is gauge already */
    if (spins_about_z_alone(b))
        stress_in_plane(par, b);
    else
        stress_in_space(par, b);
    return solid_first_inverted(b);
}

const solid_model solid_linear_elastic = {
    .name = "linear_elastic",
    .doc = "linear elasticity with the Jaumann rate: small strains, any rotation",
    .cite = "T. J. R. Hughes, J. Winget, Int. J. Numer. Meth. Engng 15 (1980) 1862",
    .param_size = sizeof(elastic_moduli),
    .params = linear_elastic_params,
    .n_params = sizeof linear_elastic_params / sizeof *linear_elastic_params,
    .needs = 0,
    .n_history = 0,
    .stress = linear_elastic_stress,
    .wave_speed = elastic_wave_speed,
    .strain_energy = elastic_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
};

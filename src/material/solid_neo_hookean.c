/* Compressible neo-Hookean solid, for large strains:
 *   psi = mu/2 (tr B - 3) - mu ln J + lambda/2 (ln J)^2 per initial volume,  B = F F^T,
 *   P = mu (F - F^-T) + lambda ln J F^-T,
 *   sigma = mu/J (B - I) + lambda ln J / J I. */
#include "material/elastic_moduli.h"
#include "material/hyperelastic.h"
#include "material/solid_checks.h"

#include <math.h>

/* The moduli at rest: K = lambda + 2 mu / 3 and mu. */
static const param_spec neo_hookean_params[] = {ELASTIC_MODULI};

/* The logarithm has a loop of its own: it is a call, and would keep the other from being vectorised. */
static void logarithms_of_volume(const solid_batch *b, double *restrict ln_J)
{
    for (size_t i = 0; i < b->n; i++) ln_J[i] = log(b->J[i]);
}

static size_t neo_hookean_stress(const void *par, double p_ref, solid_batch *restrict b)
{
    const elastic_moduli *a = par;
    const double mu = a->shear_modulus, lambda = lame_lambda(a);
    (void)p_ref; /* the stress of a solid is gauge already */
    const size_t inverted = solid_first_inverted(b);
    if (inverted != 0) return inverted;
    double ln_J[SOLID_CHUNK];
    logarithms_of_volume(b, ln_J);
    for (size_t i = 0; i < b->n; i++) {
        const double over_J = 1.0 / b->J[i], shear = mu * over_J, volumetric = lambda * ln_J[i] * over_J;
        b->stress[XX][i] = shear * (left_cauchy_green(b, 0, 0, i) - 1.0) + volumetric;
        b->stress[YY][i] = shear * (left_cauchy_green(b, 1, 1, i) - 1.0) + volumetric;
        b->stress[ZZ][i] = shear * (left_cauchy_green(b, 2, 2, i) - 1.0) + volumetric;
        b->stress[XY][i] = shear * left_cauchy_green(b, 0, 1, i);
        b->stress[YZ][i] = shear * left_cauchy_green(b, 1, 2, i);
        b->stress[ZX][i] = shear * left_cauchy_green(b, 2, 0, i);
    }
    return 0;
}

/* The acoustic tensor of direction n is mu (n.Bn) I + [mu + lambda (1 - ln J)] n n, over rho0: so the fastest wave has
 * rho0 c^2 = mu max(n.Bn) + max(mu + lambda (1 - ln J), 0). */
static void neo_hookean_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const elastic_moduli *a = par;
    const double mu = a->shear_modulus, lambda = lame_lambda(a);
    (void)p_ref;
    double ln_J[SOLID_CHUNK];
    logarithms_of_volume(b, ln_J);
    for (size_t i = 0; i < b->n; i++) {
        const double longitudinal = mu + lambda * (1.0 - ln_J[i]);
        const double stretched = longitudinal > 0.0 ? longitudinal : 0.0;
        c[i] = sqrt((mu * largest_square_stretch(b, i) + stretched) / b->rho0[i]);
    }
}

static void neo_hookean_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const elastic_moduli *a = par;
    const double mu = a->shear_modulus, lambda = lame_lambda(a);
    double ln_J[SOLID_CHUNK];
    logarithms_of_volume(b, ln_J);
    for (size_t i = 0; i < b->n; i++) {
        const double trace = trace_of_left_cauchy_green(b, i);
        psi[i] = 0.5 * mu * (trace - 3.0) - mu * ln_J[i] + 0.5 * lambda * ln_J[i] * ln_J[i];
    }
}

const solid_model solid_neo_hookean = {
    .name = "neo_hookean",
    .doc = "compressible neo-Hookean elasticity: large strains",
    .cite = "J. Bonet, R. D. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. (2008), section "
            "6.4.3",
    .param_size = sizeof(elastic_moduli),
    .params = neo_hookean_params,
    .n_params = sizeof neo_hookean_params / sizeof *neo_hookean_params,
    .needs = SOLID_NEEDS_F,
    .n_history = 0,
    .stress = neo_hookean_stress,
    .wave_speed = neo_hookean_wave_speed,
    .strain_energy = neo_hookean_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
};

/* St. Venant-Kirchhoff solid: Hooke's law between the Green strain and the second Piola-Kirchhoff stress,
 *   E = (F^T F - I)/2,  S = lambda tr(E) I + 2 mu E,  psi = lambda/2 tr(E)^2 + mu E:E per initial volume,
 *   J sigma = F S F^T = [lambda tr(E) - mu] B + mu B B,  B = F F^T, tr(E) = (tr B - 3)/2.
 * For large rotations and moderate strains. Pressed to 0.58 of its length a bar of it softens, and nothing resists as
 * it is pressed to nothing; beyond a stretch of sqrt(1 + 1/nu) there is no state of plane or uniaxial stress. */
#include "material/elastic_moduli.h"
#include "material/hyperelastic.h"
#include "material/solid_checks.h"

/* The moduli at rest: K = lambda + 2 mu / 3 and mu. */
static const param_spec st_venant_kirchhoff_params[] = {ELASTIC_MODULI};

/* B - I and tr(E) = tr(B - I)/2. Small strains keep their digits: the stress is written in B - I. */
FLOE_ALWAYS_INLINE double green_trace(const solid_batch *b, size_t i, double more[6])
{
    left_cauchy_green_at(b, i, more);
    more[XX] -= 1.0;
    more[YY] -= 1.0;
    more[ZZ] -= 1.0;
    return 0.5 * (more[XX] + more[YY] + more[ZZ]);
}

/* With D = B - I: J sigma = lambda tr(E) (I + D) + mu (D + D D). */
static size_t st_venant_kirchhoff_stress(const void *par, double p_ref, solid_batch *restrict b)
{
    const elastic_moduli *a = par;
    const double mu = a->shear_modulus, lambda = lame_lambda(a);
    (void)p_ref; /* the stress of a solid is gauge already */
    const size_t inverted = solid_first_inverted(b);
    if (inverted != 0) return inverted;
    for (size_t i = 0; i < b->n; i++) {
        double D[6], square[6];
        const double volumetric = lambda * green_trace(b, i, D), over_J = 1.0 / b->J[i];
        symmetric_square(D, square);
        for (int k = 0; k < 6; k++)
            b->stress[k][i] = over_J * (volumetric * (D[k] + (k < 3 ? 1.0 : 0.0)) + mu * (D[k] + square[k]));
    }
    return 0;
}

/* The acoustic tensor of direction n is (lambda + mu) Bn Bn + mu (n.Bn) B + (n.J sigma n) I, over rho0. With b the
 * largest eigenvalue of B: rho0 c^2 <= (lambda + 2 mu) b^2 + max(J sigma), J sigma <= b (lambda tr(E) + mu (b - 1)).
 * Exact at rest and for a bar stretched along one axis. */
static void st_venant_kirchhoff_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const elastic_moduli *a = par;
    const double mu = a->shear_modulus, lambda = lame_lambda(a);
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) {
        const double square = largest_square_stretch(b, i), trace = 0.5 * (trace_of_left_cauchy_green(b, i) - 3.0);
        const double tension = square * (lambda * trace + mu * (square - 1.0));
        c[i] = sqrt(((lambda + 2.0 * mu) * square * square + (tension > 0.0 ? tension : 0.0)) / b->rho0[i]);
    }
}

/* E:E = tr((B - I)^2)/4, since F^T F and F F^T have the same eigenvalues. */
static void st_venant_kirchhoff_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const elastic_moduli *a = par;
    const double mu = a->shear_modulus, lambda = lame_lambda(a);
    for (size_t i = 0; i < b->n; i++) {
        double D[6], square[6];
        const double trace = green_trace(b, i, D);
        symmetric_square(D, square);
        psi[i] = 0.5 * lambda * trace * trace + 0.25 * mu * (square[XX] + square[YY] + square[ZZ]);
    }
}

const solid_model solid_st_venant_kirchhoff = {
    .name = "st_venant_kirchhoff",
    .doc = "St. Venant-Kirchhoff elasticity: large rotations, moderate strains",
    .cite =
        "S. Turek, J. Hron, Proposal for numerical benchmarking of fluid-structure interaction (2006), section 1.2; "
        "G. A. Holzapfel, Nonlinear Solid Mechanics (2000), section 6.5",
    .param_size = sizeof(elastic_moduli),
    .params = st_venant_kirchhoff_params,
    .n_params = sizeof st_venant_kirchhoff_params / sizeof *st_venant_kirchhoff_params,
    .needs = SOLID_NEEDS_F,
    .n_history = 0,
    .stress = st_venant_kirchhoff_stress,
    .wave_speed = st_venant_kirchhoff_wave_speed,
    .strain_energy = st_venant_kirchhoff_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
    .largest_stretch = 1.5,
};

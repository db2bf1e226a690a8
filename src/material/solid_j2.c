/* Metal plasticity: von Mises (J2) yield with linear isotropic hardening, and failure.
 *
 *   q = sqrt(3/2 s:s) <= y = yield_stress + hardening_modulus alpha,  alpha the equivalent plastic strain
 *
 * The elastic trial stress (hypoelastic.h) is returned along its deviator: with f = q - y > 0, d alpha = f / (3 G + H),
 * s <- s (1 - 3 G d alpha / q), the mean stress as it was (Wilkins 1964; Simo & Hughes 1998, box 3.1): implicit in the
 * normal, so that any step is stable, and exact where the strain keeps its direction. Plastic work, (y + d y / 2) d
 * alpha, becomes internal energy; the strain energy is elastic alone.
 *
 * A point fails, for good, whose mean stress stood above tension_strength at the start of a step, or whose plastic
 * strain or plastic work per initial volume had come to failure_strain or failure_energy: it bears no shear and no
 * tension. As it expands it opens, and bears pressure again when the opening has closed. The strain energy at failure
 * becomes internal energy. (At the start, so that the iterations of plane stress cannot fail a point by a trial.) */
#include "material/metal.h"
#include "material/solid_checks.h"

typedef struct j2_par {
    metal_par metal;
    double yield_stress, hardening_modulus; /* Pa */
    double tension_strength;                /* Pa; 0: never fails by it */
    double failure_strain;                  /* 1; 0: never fails by it */
    double failure_energy;                  /* J/m3; 0: never fails by it */
} j2_par;

static const param_spec j2_params[] = {
    ELASTIC_MODULI,
    PAR_POSITIVE(j2_par, yield_stress, "Pa", NAN, "yield stress in uniaxial tension, before any plastic strain"),
    PAR_NONNEGATIVE(j2_par, hardening_modulus, "Pa", 0.0,
                    "slope of the yield stress over the equivalent plastic strain"),
    PAR_NONNEGATIVE(j2_par, tension_strength, "Pa", 0.0,
                    "mean stress above which a point fails, and from then on bears pressure alone; 0: never"),
    PAR_NONNEGATIVE(
        j2_par, failure_strain, "1", 0.0,
        "equivalent plastic strain at which a point fails, and from then on bears pressure alone; 0: never"),
    PAR_NONNEGATIVE(j2_par, failure_energy, "J/m^3", 0.0,
                    "plastic work per initial volume at which a point fails, and from then on bears pressure alone; 0: "
                    "never"),
    METAL_PRESSURE,
};

static const solid_history j2_history[METAL_HISTORY] = {METAL_HISTORY_ROWS};

/* Returns the trial stress to the yield surface; the plastic work per current volume (J/m3). */
FLOE_ALWAYS_INLINE double return_to_yield(const j2_par *a, double s[6], double *alpha)
{
    const double G3 = 3.0 * a->metal.elastic.shear_modulus, mean = mean_stress(s), q = equivalent_stress(s, mean);
    const double yield = a->yield_stress + a->hardening_modulus * *alpha;
    if (!(q > yield)) return 0.0;
    const double flow = (q - yield) / (G3 + a->hardening_modulus);
    return_stress(s, mean, 1.0 - G3 * flow / q, mean);
    *alpha += flow;
    return (yield + 0.5 * a->hardening_modulus * flow) * flow;
}

/* True when the point fails in this step. */
FLOE_ALWAYS_INLINE bool fails_now(const j2_par *a, const solid_batch *b, size_t i)
{
    const double alpha = b->history[PLASTIC_STRAIN][i];
    if (b->history[FAILED][i] != 0.0) return false;
    if (a->tension_strength > 0.0 && mean_stress_at(b, i) > a->tension_strength) return true;
    if (a->failure_strain > 0.0 && alpha >= a->failure_strain) return true;
    return a->failure_energy > 0.0 &&
           (a->yield_stress + 0.5 * a->hardening_modulus * alpha) * alpha >= a->failure_energy;
}

FLOE_ALWAYS_INLINE void j2_step(const j2_par *a, solid_batch *restrict b, bool planar)
{
    const double K = a->metal.elastic.bulk_modulus, G = a->metal.elastic.shear_modulus,
                 lambda = lame_lambda(&a->metal.elastic);
    for (size_t i = 0; i < b->n; i++) {
        const double swelling = b->J[i] - b->J_old[i];
        double s[6], lost = 0.0; /* J per initial volume */
        if (FLOE_UNLIKELY(fails_now(a, b, i))) lost = metal_fail(&a->metal, b, i);
        hypoelastic_step(lambda, G, b, i, planar, s);
        if (FLOE_UNLIKELY(b->history[FAILED][i] != 0.0))
            bear_pressure_alone(K, s, &b->history[OPENING][i]);
        else
            lost = 0.5 * (b->J[i] + b->J_old[i]) * return_to_yield(a, s, &b->history[PLASTIC_STRAIN][i]);
        for (int k = 0; k < 6; k++) b->stress[k][i] = s[k];
        b->energy[i] += (lost - b->q[i] * swelling) / b->rho0[i];
    }
}

static size_t j2_stress(const void *par, double p_ref, solid_batch *b)
{
    const j2_par *a = par;
    double before[SOLID_CHUNK];
    (void)p_ref; /* the stress of a solid is gauge already */
    const bool shock = a->metal.grueneisen > 0.0;
    for (size_t i = 0; shock && i < b->n; i++) before[i] = mean_stress_at(b, i);
    if (spins_about_z_alone(b))
        j2_step(a, b, true);
    else
        j2_step(a, b, false);
    const size_t inverted = solid_first_inverted(b);
    return inverted != 0 || !shock ? inverted : metal_shock_pressure(&a->metal, b, before);
}

static double j2_yield_stress(const void *par)
{
    return ((const j2_par *)par)->yield_stress;
}

const solid_model solid_j2 = {
    .name = "j2",
    .doc = "metal plasticity: von Mises yield, linear isotropic hardening, failure",
    .cite = "M. L. Wilkins, Methods in Computational Physics 3 (1964) 211; J. C. Simo, T. J. R. Hughes, Computational "
            "Inelasticity (1998), box 3.1",
    .param_size = sizeof(j2_par),
    .params = j2_params,
    .n_params = sizeof j2_params / sizeof *j2_params,
    .needs = SOLID_HAS_ENERGY,
    .history = j2_history,
    .n_history = METAL_HISTORY,
    .stress = j2_stress,
    .wave_speed = metal_wave_speed,
    .strain_energy = metal_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
    .yield_stress = j2_yield_stress,
    .depends = metal_depends,
    .check = metal_check,
};

/* Metal plasticity: von Mises (J2) yield with linear isotropic hardening, and a tension cut-off.
 *
 *   q = sqrt(3/2 s:s) <= y = yield_stress + hardening_modulus alpha,  alpha the equivalent plastic strain
 *
 * The elastic trial stress (hypoelastic.h) is returned along its deviator: with f = q - y > 0, d alpha = f / (3 G + H),
 * s <- s (1 - 3 G d alpha / q), the mean stress as it was (Wilkins 1964; Simo & Hughes 1998, box 3.1): implicit in the
 * normal, so that any step is stable, and exact where the strain keeps its direction. Plastic work, (y + d y / 2) d
 * alpha, becomes internal energy; the strain energy is elastic alone.
 *
 * A point whose mean stress stood above tension_strength at the start of a step has failed, for good: it bears no shear
 * and no tension. As it expands it opens, and bears pressure again when the opening has closed. The strain energy at
 * failure becomes internal energy. (At the start, so that the iterations of plane stress cannot fail a point by a
 * trial.) */
#include "material/elastic_moduli.h"
#include "material/hypoelastic.h"
#include "material/solid_checks.h"

#include <math.h>

typedef struct j2_par {
    elastic_moduli elastic;
    double yield_stress, hardening_modulus; /* Pa */
    double tension_strength;                /* Pa; 0: never fails */
} j2_par;

static const param_spec j2_params[] = {
    ELASTIC_MODULI,
    PAR_POSITIVE(j2_par, yield_stress, "Pa", NAN, "yield stress in uniaxial tension, before any plastic strain"),
    PAR_NONNEGATIVE(j2_par, hardening_modulus, "Pa", 0.0,
                    "slope of the yield stress over the equivalent plastic strain"),
    PAR_NONNEGATIVE(j2_par, tension_strength, "Pa", 0.0,
                    "mean stress above which a point fails, and from then on bears pressure alone; 0: never"),
};

enum { PLASTIC_STRAIN, FAILED, OPENING, HISTORY_COUNT };

static const solid_history j2_history[HISTORY_COUNT] = {
    [PLASTIC_STRAIN] = {"plastic_strain", "1", "equivalent plastic strain"},
    [FAILED] = {"failed", "1", "1 where the point has failed in tension, else 0"},
    [OPENING] = {"opening", "1", "volume strain of what has opened since failure"},
};

FLOE_ALWAYS_INLINE double mean_stress(const double s[6])
{
    return (s[XX] + s[YY] + s[ZZ]) / 3.0;
}

/* Returns the trial stress to the yield surface; the plastic work per current volume (J/m3). */
FLOE_ALWAYS_INLINE double return_to_yield(const j2_par *a, double s[6], double *alpha)
{
    const double G3 = 3.0 * a->elastic.shear_modulus, mean = mean_stress(s);
    const double sx = s[XX] - mean, sy = s[YY] - mean, sz = s[ZZ] - mean;
    const double shear = s[XY] * s[XY] + s[YZ] * s[YZ] + s[ZX] * s[ZX];
    const double q = sqrt(1.5 * (sx * sx + sy * sy + sz * sz + 2.0 * shear));
    const double yield = a->yield_stress + a->hardening_modulus * *alpha;
    if (!(q > yield)) return 0.0;
    const double flow = (q - yield) / (G3 + a->hardening_modulus), left = 1.0 - G3 * flow / q;
    s[XX] = mean + left * sx;
    s[YY] = mean + left * sy;
    s[ZZ] = mean + left * sz;
    for (int k = XY; k <= ZX; k++) s[k] *= left;
    *alpha += flow;
    return (yield + 0.5 * a->hardening_modulus * flow) * flow;
}

/* A failed point: pressure, once the opening has closed. K opening is the tension that there would be without it. */
FLOE_ALWAYS_INLINE void bear_pressure_alone(double K, double s[6], double *opening)
{
    const double tension = mean_stress(s) + K * *opening;
    *opening = tension > 0.0 ? tension / K : 0.0;
    s[XX] = s[YY] = s[ZZ] = tension > 0.0 ? 0.0 : tension;
    s[XY] = s[YZ] = s[ZX] = 0.0;
}

/* True when the point fails in this step. */
FLOE_ALWAYS_INLINE bool fails_now(const j2_par *a, const solid_batch *b, size_t i)
{
    const double mean = (b->stress[XX][i] + b->stress[YY][i] + b->stress[ZZ][i]) / 3.0;
    return a->tension_strength > 0.0 && b->history[FAILED][i] == 0.0 && mean > a->tension_strength;
}

FLOE_ALWAYS_INLINE void j2_step(const j2_par *a, solid_batch *restrict b, bool planar)
{
    const double K = a->elastic.bulk_modulus, G = a->elastic.shear_modulus, lambda = K - 2.0 / 3.0 * G;
    for (size_t i = 0; i < b->n; i++) {
        const double swelling = b->J[i] - b->J_old[i];
        double s[6], lost = 0.0; /* J per initial volume */
        if (FLOE_UNLIKELY(fails_now(a, b, i))) {
            const double old[6] = {b->stress[XX][i], b->stress[YY][i], b->stress[ZZ][i],
                                   b->stress[XY][i], b->stress[YZ][i], b->stress[ZX][i]};
            lost = elastic_energy_density(&a->elastic, b->J_old[i], old);
            b->history[FAILED][i] = 1.0;
        }
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
    (void)p_ref; /* the stress of a solid is gauge already */
    if (spins_about_z_alone(b))
        j2_step(par, b, true);
    else
        j2_step(par, b, false);
    return solid_first_inverted(b);
}

static double j2_yield_stress(const void *par)
{
    return ((const j2_par *)par)->yield_stress;
}

const solid_model solid_j2 = {
    .name = "j2",
    .doc = "metal plasticity: von Mises yield, linear isotropic hardening, tension cut-off",
    .cite = "M. L. Wilkins, Methods in Computational Physics 3 (1964) 211; J. C. Simo, T. J. R. Hughes, Computational "
            "Inelasticity (1998), box 3.1",
    .param_size = sizeof(j2_par),
    .params = j2_params,
    .n_params = sizeof j2_params / sizeof *j2_params,
    .needs = SOLID_HAS_ENERGY,
    .history = j2_history,
    .n_history = HISTORY_COUNT,
    .stress = j2_stress,
    .wave_speed = elastic_wave_speed,
    .strain_energy = elastic_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
    .yield_stress = j2_yield_stress,
};

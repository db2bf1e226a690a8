/* Soil, sand and rock: Drucker-Prager yield with friction, cohesion and dilation, and a tension cut at its apex.
 *
 *   q + M sigma_m <= k,  q = sqrt(3/2 s:s), sigma_m = tr(sigma)/3,  M = 6 sin(phi)/(3 - sin(phi)), k = 6 c cos(phi)/(3 - sin(phi)),
 *
 * the cone through the edges of Mohr and Coulomb's pyramid in triaxial compression. Plastic strain is deviatoric along
 * s and swells by Mbar = 6 sin(psi)/(3 - sin(psi)) of that (psi = phi: associated). The elastic trial stress
 * (hypoelastic.h) goes back along 3/2 s/q 2 G + K Mbar I; where that leads through the axis of the cone, to its apex
 * sigma_m = k/M (de Souza Neto, Peric & Owen 2008, section 8.3). Both are implicit in the normal.
 *
 * At the apex the point opens: it expands under a constant tension, none without cohesion. As it closes again it bears
 * no pressure until the opening is gone, which otherwise would make pressure from a volume that is empty. Plastic work
 * is that of the stress at the end of the step, never negative. (docs/theory, 1.6) */
#include "material/elastic_moduli.h"
#include "material/hypoelastic.h"
#include "material/solid_checks.h"

#include <math.h>

typedef struct drucker_prager_par {
    elastic_moduli elastic;
    double friction_angle; /* rad */
    double cohesion;       /* Pa */
    double dilation_angle; /* rad */
} drucker_prager_par;

static const param_spec drucker_prager_params[] = {
    ELASTIC_MODULI,
    PAR_BETWEEN(drucker_prager_par, friction_angle, "rad", 0.0, 1.4, NAN,
                "angle of friction in triaxial compression; 0: none, as in undrained clay"),
    PAR_NONNEGATIVE(drucker_prager_par, cohesion, "Pa", NAN, "cohesion c: shear strength without pressure"),
    PAR_BETWEEN(drucker_prager_par, dilation_angle, "rad", 0.0, 1.4, 0.0,
                "angle of dilation, at most that of friction; 0: flows at constant volume"),
};

enum { PLASTIC_STRAIN, DILATION, OPENING, HISTORY_COUNT };

static const solid_history drucker_prager_history[HISTORY_COUNT] = {
    [PLASTIC_STRAIN] = {"plastic_strain", "1", "equivalent plastic strain of shear"},
    [DILATION] = {"dilation", "1", "plastic strain of volume that goes with it"},
    [OPENING] = {"opening", "1", "volume strain that has opened at the apex and not closed again"},
};

/* The cone of a material. */
typedef struct yield_cone {
    double K, G3;     /* Pa: bulk modulus, 3 G */
    double M, flow_M; /* slope of the cone and of its flow */
    double k;         /* Pa: q without pressure */
} yield_cone;

static double slope_of(double angle)
{
    return 6.0 * sin(angle) / (3.0 - sin(angle));
}

static yield_cone cone_of(const drucker_prager_par *a)
{
    return (yield_cone){.K = a->elastic.bulk_modulus,
                        .G3 = 3.0 * a->elastic.shear_modulus,
                        .M = slope_of(a->friction_angle),
                        .flow_M = slope_of(a->dilation_angle),
                        .k = 6.0 * a->cohesion * cos(a->friction_angle) / (3.0 - sin(a->friction_angle))};
}

static const char *drucker_prager_check(const void *par)
{
    const drucker_prager_par *a = par;
    if (a->dilation_angle > a->friction_angle)
        return "dilation_angle is above friction_angle: flow would make energy under pressure (plastic work < 0)";
    if (!(a->friction_angle > 0.0) && !(a->cohesion > 0.0))
        return "without friction_angle and without cohesion it bears no shear: take a fluid";
    return NULL;
}

/* Closes what is open of a point before it bears pressure; the mean stress. */
FLOE_ALWAYS_INLINE double close_opening(double K, double mean, double *opening)
{
    if (!(*opening > 0.0) || !(mean < 0.0)) return mean;
    const double closing = fmin(*opening, -mean / K);
    *opening -= closing;
    return *opening > 0.0 ? 0.0 : mean + K * closing;
}

/* Returns the trial stress to the cone or its apex; the plastic work per current volume (J/m3). */
FLOE_ALWAYS_INLINE double return_to_cone(const yield_cone *c, double s[6], double *strain, double *dilation,
                                         double *opening)
{
    const double trial_mean = mean_stress(s), mean = close_opening(c->K, trial_mean, opening);
    const double q = equivalent_stress(s, trial_mean);
    const double beyond = q + c->M * mean - c->k;
    double left = 1.0, end_mean = mean, work = 0.0;
    if (beyond > 0.0) {
        const double flow = beyond / (c->G3 + c->K * c->M * c->flow_M), end_q = q - c->G3 * flow;
        if (end_q > 0.0) {
            left = end_q / q;
            end_mean = mean - c->K * c->flow_M * flow;
            *strain += flow;
            *dilation += c->flow_M * flow;
            work = (end_q + c->flow_M * end_mean) * flow;
        } else {
            const double apex = c->M > 0.0 ? c->k / c->M : mean, opened = (mean - apex) / c->K;
            left = 0.0;
            end_mean = apex;
            *strain += q / c->G3;
            *opening += opened;
            work = apex * opened;
        }
    }
    return_stress(s, trial_mean, left, end_mean);
    return work;
}

FLOE_ALWAYS_INLINE void drucker_prager_step(const drucker_prager_par *a, solid_batch *restrict b, bool planar)
{
    const yield_cone cone = cone_of(a);
    const double G = a->elastic.shear_modulus, lambda = lame_lambda(&a->elastic);
    for (size_t i = 0; i < b->n; i++) {
        double s[6];
        hypoelastic_step(lambda, G, b, i, planar, s);
        const double work =
            return_to_cone(&cone, s, &b->history[PLASTIC_STRAIN][i], &b->history[DILATION][i], &b->history[OPENING][i]);
        for (int k = 0; k < 6; k++) b->stress[k][i] = s[k];
        const double lost = 0.5 * (b->J[i] + b->J_old[i]) * work; /* J per initial volume */
        b->energy[i] += (lost - b->q[i] * (b->J[i] - b->J_old[i])) / b->rho0[i];
    }
}

static size_t drucker_prager_stress(const void *par, double p_ref, solid_batch *b)
{
    (void)p_ref; /* the stress of a solid is gauge already */
    if (spins_about_z_alone(b))
        drucker_prager_step(par, b, true);
    else
        drucker_prager_step(par, b, false);
    return solid_first_inverted(b);
}

/* In uniaxial tension q = sigma = 3 sigma_m, so that sigma (1 + M/3) = k. None without cohesion. */
static double drucker_prager_yield_stress(const void *par)
{
    const yield_cone cone = cone_of(par);
    return cone.k / (1.0 + cone.M / 3.0);
}

const solid_model solid_drucker_prager = {
    .name = "drucker_prager",
    .doc = "soil, sand and rock: Drucker-Prager yield with friction, cohesion, dilation and a tension cut-off",
    .cite = "D. C. Drucker, W. Prager, Quart. Appl. Math. 10 (1952) 157; E. A. de Souza Neto, D. Peric, D. R. J. Owen, "
            "Computational Methods for Plasticity (2008), section 8.3",
    .param_size = sizeof(drucker_prager_par),
    .params = drucker_prager_params,
    .n_params = sizeof drucker_prager_params / sizeof *drucker_prager_params,
    .needs = SOLID_HAS_ENERGY,
    .history = drucker_prager_history,
    .n_history = HISTORY_COUNT,
    .stress = drucker_prager_stress,
    .wave_speed = elastic_wave_speed,
    .strain_energy = elastic_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
    .yield_stress = drucker_prager_yield_stress,
    .check = drucker_prager_check,
};

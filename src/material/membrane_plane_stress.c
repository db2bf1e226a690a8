/* A linearly elastic sheet: no stress through its thickness (York 1997, section 5.8, with a strain across that may
 * differ from zero, as in axisymmetry). Stretched along alone: sigma = E / (1 - nu^2) epsilon (equation 5.15). */
#include "material/membrane.h"

#include <math.h>

typedef struct sheet_par {
    double modulus, poisson_ratio; /* Pa, 1 */
} sheet_par;

static const param_spec sheet_params[] = {
    PAR_POSITIVE(sheet_par, modulus, "Pa", NAN, "Young's modulus E"),
    PAR_BETWEEN(sheet_par, poisson_ratio, "1", -0.99, 0.5, 0.0, "Poisson's ratio"),
};

static void plane_stress(const void *par, size_t n, const double *along, const double *across, double *stress_along,
                         double *stress_across)
{
    const sheet_par *a = par;
    const double plane = a->modulus / (1.0 - a->poisson_ratio * a->poisson_ratio);
    for (size_t i = 0; i < n; i++) {
        stress_along[i] = plane * (along[i] + a->poisson_ratio * across[i]);
        stress_across[i] = plane * (across[i] + a->poisson_ratio * along[i]);
    }
}

static double sheet_free_across(const void *par, double along)
{
    return -((const sheet_par *)par)->poisson_ratio * along;
}

/* Of two strains the worst are alike, or opposite. */
static double sheet_modulus(const void *par, bool biaxial)
{
    const sheet_par *a = par;
    return a->modulus / (1.0 - (biaxial ? fabs(a->poisson_ratio) : a->poisson_ratio * a->poisson_ratio));
}

const membrane_model membrane_plane_stress = {
    .name = "plane_stress",
    .doc = "linearly elastic sheet, sigma_1 = E / (1 - nu^2) (epsilon_1 + nu epsilon_2), strains logarithmic",
    .cite = "A. R. York, PhD thesis, University of New Mexico (1997), section 5.8",
    .param_size = sizeof(sheet_par),
    .params = sheet_params,
    .n_params = sizeof sheet_params / sizeof *sheet_params,
    .isotropic = true,
    .stress = plane_stress,
    .free_across = sheet_free_across,
    .modulus = sheet_modulus,
};

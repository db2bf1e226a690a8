/* A linearly elastic sheet: no stress through its thickness (York 1997, section 5.8, with a strain across that may differ from
 * zero, as in axisymmetry). Stretched along alone: sigma = E / (1 - nu^2) epsilon (equation 5.15). */
#include "material/membrane.h"

#include <math.h>

typedef struct sheet_par {
    double modulus, ratio; /* Pa, 1 */
} sheet_par;

static const param_spec sheet_params[] = {
    {.key = "modulus",
     .unit = "Pa",
     .range = PARAM_POSITIVE,
     .fallback = NAN,
     .offset = offsetof(sheet_par, modulus),
     .count = 1,
     .doc = "Young's modulus E"},
    {.key = "poisson_ratio",
     .unit = "1",
     .range = PARAM_BETWEEN,
     .lo = -0.99,
     .hi = 0.5,
     .fallback = 0.0,
     .offset = offsetof(sheet_par, ratio),
     .count = 1,
     .doc = "Poisson's ratio"},
};

static void plane_stress(const void *par, size_t n, const double *along, const double *across, double *stress_along,
                         double *stress_across)
{
    const sheet_par *a = par;
    const double plane = a->modulus / (1.0 - a->ratio * a->ratio);
    for (size_t i = 0; i < n; i++) {
        stress_along[i] = plane * (along[i] + a->ratio * across[i]);
        stress_across[i] = plane * (across[i] + a->ratio * along[i]);
    }
}

static double sheet_free_across(const void *par, double along)
{
    return -((const sheet_par *)par)->ratio * along;
}

/* Of two strains the worst are alike, or opposite. */
static double sheet_modulus(const void *par, bool biaxial)
{
    const sheet_par *a = par;
    return a->modulus / (1.0 - (biaxial ? fabs(a->ratio) : a->ratio * a->ratio));
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

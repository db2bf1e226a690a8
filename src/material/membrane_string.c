/* A string: uniaxial stress in proportion to the logarithmic strain along it (York 1997, section 5.1, equation 5.5). */
#include "material/membrane.h"

#include <math.h>

typedef struct string_par {
    double modulus; /* Pa */
} string_par;

static const param_spec string_params[] = {
    PAR_POSITIVE(string_par, modulus, "Pa", NAN, "Young's modulus E"),
};

static void string_stress(const void *par, size_t n, const double *along, const double *across, double *stress_along,
                          double *stress_across)
{
    const string_par *a = par;
    (void)across;
    for (size_t i = 0; i < n; i++) {
        stress_along[i] = a->modulus * along[i];
        stress_across[i] = 0.0;
    }
}

static double string_free_across(const void *par, double along)
{
    (void)par;
    (void)along;
    return 0.0; /* bears nothing across: any strain does */
}

static double string_modulus(const void *par, bool biaxial)
{
    (void)biaxial;
    return ((const string_par *)par)->modulus;
}

const membrane_model membrane_string = {
    .name = "string",
    .doc = "uniaxial stress, sigma = E ln(stretch)",
    .cite = "A. R. York, PhD thesis, University of New Mexico (1997), section 5.1",
    .param_size = sizeof(string_par),
    .params = string_params,
    .n_params = sizeof string_params / sizeof *string_params,
    .stress = string_stress,
    .free_across = string_free_across,
    .modulus = string_modulus,
};

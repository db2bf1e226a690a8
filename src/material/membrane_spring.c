/* A spring: uniaxial stress in proportion to the elongation. With a section of constant thickness its force is linear
 * in its length, k = E A / L, as that of the springs of York 1997, equation 5.10. */
#include "material/membrane.h"

#include <math.h>

typedef struct spring_par {
    double modulus; /* Pa */
} spring_par;

static const param_spec spring_params[] = {
    PAR_POSITIVE(spring_par, modulus, "Pa", NAN, "E of the stiffness E A / L"),
};

static void spring_stress(const void *par, size_t n, const double *along, const double *across, double *stress_along,
                          double *stress_across)
{
    const spring_par *a = par;
    (void)across;
    for (size_t i = 0; i < n; i++) {
        stress_along[i] = a->modulus * expm1(along[i]);
        stress_across[i] = 0.0;
    }
}

static double spring_free_across(const void *par, double along)
{
    (void)par;
    (void)along;
    return 0.0; /* bears nothing across: any strain does */
}

static double spring_modulus(const void *par, bool biaxial)
{
    (void)biaxial;
    return ((const spring_par *)par)->modulus;
}

const membrane_model membrane_spring = {
    .name = "spring",
    .doc = "uniaxial stress, sigma = E (stretch - 1): a force linear in the length",
    .cite = "A. R. York, PhD thesis, University of New Mexico (1997), section 5.5",
    .param_size = sizeof(spring_par),
    .params = spring_params,
    .n_params = sizeof spring_params / sizeof *spring_params,
    .stress = spring_stress,
    .free_across = spring_free_across,
    .modulus = spring_modulus,
};

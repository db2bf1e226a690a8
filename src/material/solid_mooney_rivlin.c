/* Mooney-Rivlin solid, for rubber:
 *   psi = c1 (I1 - 3) + c2 (I2 - 3) + K/4 (J^2 - 1 - 2 ln J) per initial volume,
 * with I1 = J^(-2/3) tr B and I2 = J^(-4/3) [(tr B)^2 - tr(B B)]/2 of B = F F^T, and G = 2 (c1 + c2) at rest:
 *   sigma = K/2 (J - 1/J) I + 2/J dev[(c1 + c2 I1) B1 - c2 B1 B1],  B1 = J^(-2/3) B. */
#include "material/hyperelastic.h"
#include "material/solid_checks.h"

typedef struct mooney_rivlin_par {
    double bulk_modulus; /* Pa */
    double c1, c2;       /* Pa */
} mooney_rivlin_par;

static const param_spec mooney_rivlin_params[] = {
    PAR_POSITIVE(mooney_rivlin_par, bulk_modulus, "Pa", NAN, "bulk modulus K, at rest"),
    PAR_POSITIVE(mooney_rivlin_par, c1, "Pa", NAN,
                 "coefficient of the first invariant; the shear modulus at rest is 2 (c1 + c2)"),
    PAR_NONNEGATIVE(mooney_rivlin_par, c2, "Pa", NAN, "coefficient of the second invariant"),
};

/* J^(-2/3) has a loop of its own: it is a call, and would keep the others from being vectorised. */
static void isochoric_factors(const solid_batch *b, double *restrict factor)
{
    for (size_t i = 0; i < b->n; i++) {
        const double root = cbrt(b->J[i]);
        factor[i] = 1.0 / (root * root);
    }
}

/* B1 = J^(-2/3) B and its square, of point i whose J^(-2/3) is `factor`; their invariants I1 and I2. */
FLOE_ALWAYS_INLINE void isochoric_strain(const solid_batch *b, size_t i, double factor, double B[6], double square[6],
                                         double *first, double *second)
{
    left_cauchy_green_at(b, i, B);
    for (int k = 0; k < 6; k++) B[k] *= factor;
    symmetric_square(B, square);
    *first = B[XX] + B[YY] + B[ZZ];
    *second = 0.5 * (*first * *first - (square[XX] + square[YY] + square[ZZ]));
}

static size_t mooney_rivlin_stress(const void *par, double p_ref, solid_batch *restrict b)
{
    const mooney_rivlin_par *a = par;
    (void)p_ref; /* the stress of a solid is gauge already */
    const size_t inverted = solid_first_inverted(b);
    if (inverted != 0) return inverted;
    double factor[SOLID_CHUNK];
    isochoric_factors(b, factor);
    for (size_t i = 0; i < b->n; i++) {
        double B[6], square[6], s[6], first, second;
        isochoric_strain(b, i, factor[i], B, square, &first, &second);
        const double twice = 2.0 / b->J[i];
        for (int k = 0; k < 6; k++) s[k] = twice * ((a->c1 + a->c2 * first) * B[k] - a->c2 * square[k]);
        const double mean = (s[XX] + s[YY] + s[ZZ]) / 3.0;
        const double pressure = 0.5 * a->bulk_modulus * (b->J[i] - 1.0 / b->J[i]);
        for (int k = 0; k < 6; k++) b->stress[k][i] = k < 3 ? (s[k] - mean) + pressure : s[k];
    }
    return 0;
}

/* Bounds of the acoustic tensor a.Q(n)a of each term, over rho0, with b1 >= b3 the eigenvalues of B1 and g those of its
 * adjugate B1^-1:
 *   c1: 2 c1 [b_nn + 5/9 I1 (a.n)^2 - 4/3 (a.n) b_an] <= 2 c1 [4/3 b1 + (b1 - b3)/3]
 *   c2: 2 c2 [g_aa + 2/3 (a.n) g_an - 1/9 I2 (a.n)^2] <= 2 c2 [5/3 g1 - I2/9]
 *   K:  K/2 (J^2 + 1). Exact at rest. */
static void mooney_rivlin_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const mooney_rivlin_par *a = par;
    (void)p_ref;
    double factor[SOLID_CHUNK];
    isochoric_factors(b, factor);
    for (size_t i = 0; i < b->n; i++) {
        double B[6], square[6], first, second;
        isochoric_strain(b, i, factor[i], B, square, &first, &second);
        const double squares = square[XX] + square[YY] + square[ZZ];
        /* of a tensor with trace t and squares s the eigenvalues are within t/3 +- sqrt(2/3 (s - t^2/3)) */
        const double spread = sqrt(2.0 / 3.0 * fmax(squares - first * first / 3.0, 0.0));
        const double inverse_squares = second * second - 2.0 * first;
        const double inverse_spread = sqrt(2.0 / 3.0 * fmax(inverse_squares - second * second / 3.0, 0.0));
        const double largest = first / 3.0 + spread, least = fmax(first / 3.0 - spread, 0.0);
        const double shear = 2.0 * a->c1 * (4.0 / 3.0 * largest + (largest - least) / 3.0) +
                             2.0 * a->c2 * (5.0 / 3.0 * (second / 3.0 + inverse_spread) - second / 9.0);
        c[i] = sqrt((0.5 * a->bulk_modulus * (b->J[i] * b->J[i] + 1.0) + shear) / b->rho0[i]);
    }
}

static void mooney_rivlin_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const mooney_rivlin_par *a = par;
    double factor[SOLID_CHUNK];
    isochoric_factors(b, factor);
    for (size_t i = 0; i < b->n; i++) {
        double B[6], square[6], first, second;
        isochoric_strain(b, i, factor[i], B, square, &first, &second);
        const double volumetric = 0.25 * a->bulk_modulus * (b->J[i] * b->J[i] - 1.0 - 2.0 * log(b->J[i]));
        psi[i] = a->c1 * (first - 3.0) + a->c2 * (second - 3.0) + volumetric;
    }
}

static double mooney_rivlin_bulk_modulus(const void *par)
{
    return ((const mooney_rivlin_par *)par)->bulk_modulus;
}

static double mooney_rivlin_shear_modulus(const void *par)
{
    const mooney_rivlin_par *a = par;
    return 2.0 * (a->c1 + a->c2);
}

const solid_model solid_mooney_rivlin = {
    .name = "mooney_rivlin",
    .doc = "Mooney-Rivlin elasticity: rubber at large strains",
    .cite = "R. S. Rivlin, D. W. Saunders, Phil. Trans. R. Soc. A 243 (1951) 251; G. A. Holzapfel, Nonlinear Solid "
            "Mechanics (2000), section 6.5",
    .param_size = sizeof(mooney_rivlin_par),
    .params = mooney_rivlin_params,
    .n_params = sizeof mooney_rivlin_params / sizeof *mooney_rivlin_params,
    .needs = SOLID_NEEDS_F,
    .n_history = 0,
    .stress = mooney_rivlin_stress,
    .wave_speed = mooney_rivlin_wave_speed,
    .strain_energy = mooney_rivlin_strain_energy,
    .bulk_modulus = mooney_rivlin_bulk_modulus,
    .shear_modulus = mooney_rivlin_shear_modulus,
};

/* Ogden solid, for rubber at large strains, in the principal stretches of constant volume, l_a = J^(-1/3) lambda_a:
 *   psi = sum_i mu_i/alpha_i (l_1^alpha_i + l_2^alpha_i + l_3^alpha_i - 3) + K/4 (J^2 - 1 - 2 ln J) per initial volume,
 *   J sigma = sum_a (beta_a - mean beta) n_a n_a + K/2 (J^2 - 1) I,  beta_a = sum_i mu_i l_a^alpha_i,
 * with n_a the principal directions of B = F F^T, and G = sum_i mu_i alpha_i / 2 at rest. Of equal stretches any
 * orthogonal directions serve, since their beta are equal. (docs/theory, 1.6) */
#include "material/hyperelastic.h"
#include "material/solid_checks.h"
#include "math/tensor.h"

enum { TERMS = 3 };

typedef struct ogden_par {
    double bulk_modulus;  /* Pa */
    double mu_1, alpha_1; /* Pa, 1 */
    double mu_2, alpha_2;
    double mu_3, alpha_3;
} ogden_par;

static const param_spec ogden_params[] = {
    PAR_POSITIVE(ogden_par, bulk_modulus, "Pa", NAN, "bulk modulus K, at rest"),
    PAR_ANY(ogden_par, mu_1, "Pa", NAN, "coefficient of the first term; mu alpha / 2 is its part of the shear modulus"),
    PAR_ANY(ogden_par, alpha_1, "1", NAN, "exponent of the first term, of the sign of mu_1"),
    PAR_ANY(ogden_par, mu_2, "Pa", 0.0, "coefficient of the second term; 0: there is none"),
    PAR_ANY(ogden_par, alpha_2, "1", 0.0, "exponent of the second term, of the sign of mu_2"),
    PAR_ANY(ogden_par, mu_3, "Pa", 0.0, "coefficient of the third term; 0: there is none"),
    PAR_ANY(ogden_par, alpha_3, "1", 0.0, "exponent of the third term, of the sign of mu_3"),
};

/* The terms that there are. */
typedef struct ogden_terms {
    int n;
    double mu[TERMS], alpha[TERMS];
} ogden_terms;

static ogden_terms terms_of(const ogden_par *a)
{
    const double mu[TERMS] = {a->mu_1, a->mu_2, a->mu_3}, alpha[TERMS] = {a->alpha_1, a->alpha_2, a->alpha_3};
    ogden_terms t = {.n = 0};
    for (int k = 0; k < TERMS; k++) {
        if (mu[k] == 0.0 || alpha[k] == 0.0) continue;
        t.mu[t.n] = mu[k];
        t.alpha[t.n++] = alpha[k];
    }
    return t;
}

/* Drucker: stress does work on the strain that it makes, at any stretch, where each term is convex (Ogden 1972). */
static const char *ogden_check(const void *par)
{
    const ogden_par *a = par;
    const double mu[TERMS] = {a->mu_1, a->mu_2, a->mu_3}, alpha[TERMS] = {a->alpha_1, a->alpha_2, a->alpha_3};
    static const char *const half[TERMS] = {"mu_1 and alpha_1 must not be 0", "of mu_2 and alpha_2 one is 0: give both",
                                            "of mu_3 and alpha_3 one is 0: give both"};
    static const char *const unstable[TERMS] = {
        "mu_1 alpha_1 is not above 0, and the solid not stable (Drucker): mu and alpha of a term have the same sign",
        "mu_2 alpha_2 is not above 0, and the solid not stable (Drucker): mu and alpha of a term have the same sign",
        "mu_3 alpha_3 is not above 0, and the solid not stable (Drucker): mu and alpha of a term have the same sign"};
    for (int k = 0; k < TERMS; k++) {
        const bool absent = k > 0 && mu[k] == 0.0 && alpha[k] == 0.0;
        if (absent) continue;
        if (mu[k] == 0.0 || alpha[k] == 0.0) return half[k];
        if (!(mu[k] * alpha[k] > 0.0)) return unstable[k];
    }
    return NULL;
}

/* Logarithms of the l_a, and the principal directions as columns. B - I keeps the digits of small strains. */
static void isochoric_stretches(const solid_batch *b, size_t i, double ln_l[3], double direction[9])
{
    double D[6], square[3];
    left_cauchy_green_at(b, i, D);
    for (int k = 0; k < 3; k++) D[k] -= 1.0;
    symmetric_eigen(D, square, direction);
    for (int k = 0; k < 3; k++) ln_l[k] = 0.5 * log1p(square[k]);
    const double mean = (ln_l[0] + ln_l[1] + ln_l[2]) / 3.0;
    for (int k = 0; k < 3; k++) ln_l[k] -= mean;
}

/* dev beta of point i. */
static void principal_stresses(const ogden_terms *t, const double ln_l[3], double tau[3])
{
    for (int k = 0; k < 3; k++) {
        tau[k] = 0.0;
        for (int m = 0; m < t->n; m++) tau[k] += t->mu[m] * expm1(t->alpha[m] * ln_l[k]);
    }
    const double mean = (tau[0] + tau[1] + tau[2]) / 3.0;
    for (int k = 0; k < 3; k++) tau[k] -= mean;
}

static size_t ogden_stress(const void *par, double p_ref, solid_batch *restrict b)
{
    const ogden_par *a = par;
    const ogden_terms t = terms_of(a);
    (void)p_ref; /* the stress of a solid is gauge already */
    const size_t inverted = solid_first_inverted(b);
    if (inverted != 0) return inverted;
    for (size_t i = 0; i < b->n; i++) {
        double ln_l[3], direction[9], tau[3], s[6];
        isochoric_stretches(b, i, ln_l, direction);
        principal_stresses(&t, ln_l, tau);
        symmetric_from_eigen(tau, direction, s);
        const double over_J = 1.0 / b->J[i], pressure = 0.5 * a->bulk_modulus * (b->J[i] - over_J);
        for (int k = 0; k < 6; k++) b->stress[k][i] = over_J * s[k] + (k < 3 ? pressure : 0.0);
    }
    return 0;
}

/* The second derivative of the energy of constant volume as the point is strained by e X F, in principal axes, is a form
 * of X that couples its diagonal by `along` and each pair X_ij, X_ji by [across_ij both_ij; both_ij across_ji] (Ogden,
 * Non-linear Elastic Deformations (1984), section 6.1.4). */
typedef struct principal_tangent {
    double along[3][3], across[3][3], both[3][3];
} principal_tangent;

static double sum_of(const double x[3])
{
    return x[0] + x[1] + x[2];
}

/* What one term of the energy gives. */
static void add_term_tangent(double mu, double alpha, const double ln_l[3], principal_tangent *t)
{
    double p[3];
    for (int i = 0; i < 3; i++) p[i] = exp(alpha * ln_l[i]);
    const double mean = sum_of(p) / 3.0;
    for (int i = 0; i < 3; i++) {
        const double tau = mu * (p[i] - mean);
        t->along[i][i] += mu * alpha * (p[i] + mean) / 3.0 - tau;
        for (int j = 0; j < 3; j++) {
            if (i == j) continue;
            const double x = ln_l[i] - ln_l[j], ratio = x == 0.0 ? 0.5 * alpha : expm1(alpha * x) / expm1(2.0 * x);
            const double across = mu * p[j] * exp(2.0 * x) * ratio; /* mu (p_i - p_j) b_i / (b_i - b_j) */
            t->along[i][j] += mu * alpha * (mean - p[i] - p[j]) / 3.0;
            t->across[i][j] += across;
            t->both[i][j] += across - tau;
        }
    }
}

/* The largest eigenvalue of a symmetric matrix is at most its mean + sqrt(2/3) |deviator|. */
static double largest_along(const principal_tangent *t, double G)
{
    double m[3][3], mean = 0.0, squares = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) m[i][j] = t->along[i][j] - G * (i == j ? 4.0 / 3.0 : -2.0 / 3.0);
    for (int i = 0; i < 3; i++) mean += m[i][i] / 3.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double d = m[i][j] - (i == j ? mean : 0.0);
            squares += d * d;
        }
    return mean + sqrt(2.0 / 3.0 * squares);
}

static double largest_across(const principal_tangent *t, double G)
{
    double largest = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++) {
            const double mean = 0.5 * (t->across[i][j] + t->across[j][i]), half = mean - t->across[i][j];
            largest = fmax(largest, mean - G + hypot(half, t->both[i][j] - G));
        }
    return largest;
}

/* A wave of direction n and polarisation a strains by X = a n, |X| = 1, |tr X| <= 1. Of the form above a part is that of
 * a solid at rest with a shear modulus G, with the bulk modulus at most K/2 (J^2 + 1) + 4/3 G; what is left of it is at
 * most its largest eigenvalue. This holds for any G; the mean of the three planes' is near the least. Exact at rest. */
static void ogden_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const ogden_par *a = par;
    const ogden_terms terms = terms_of(a);
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) {
        double ln_l[3], direction[9], G = 0.0;
        principal_tangent t = {.along = {{0.0}}};
        isochoric_stretches(b, i, ln_l, direction);
        for (int m = 0; m < terms.n; m++) add_term_tangent(terms.mu[m], terms.alpha[m], ln_l, &t);
        for (int k = 0; k < 3; k++) G += sum_of(t.across[k]) / 6.0;
        const double more = fmax(fmax(largest_along(&t, G), largest_across(&t, G)), 0.0);
        const double bulk = 0.5 * a->bulk_modulus * (b->J[i] * b->J[i] + 1.0);
        c[i] = sqrt((bulk + 4.0 / 3.0 * G + more) / b->rho0[i]);
    }
}

static void ogden_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const ogden_par *a = par;
    const ogden_terms t = terms_of(a);
    for (size_t i = 0; i < b->n; i++) {
        double ln_l[3], direction[9];
        isochoric_stretches(b, i, ln_l, direction);
        psi[i] = 0.25 * a->bulk_modulus * (b->J[i] * b->J[i] - 1.0 - 2.0 * log(b->J[i]));
        for (int m = 0; m < t.n; m++)
            for (int k = 0; k < 3; k++) psi[i] += t.mu[m] / t.alpha[m] * expm1(t.alpha[m] * ln_l[k]);
    }
}

static double ogden_bulk_modulus(const void *par)
{
    return ((const ogden_par *)par)->bulk_modulus;
}

static double ogden_shear_modulus(const void *par)
{
    const ogden_par *a = par;
    return 0.5 * (a->mu_1 * a->alpha_1 + a->mu_2 * a->alpha_2 + a->mu_3 * a->alpha_3);
}

const solid_model solid_ogden = {
    .name = "ogden",
    .doc = "Ogden elasticity in principal stretches, up to three terms: rubber at large strains",
    .cite = "R. W. Ogden, Proc. R. Soc. Lond. A 326 (1972) 565; G. A. Holzapfel, Nonlinear Solid Mechanics (2000), "
            "section 6.5",
    .param_size = sizeof(ogden_par),
    .params = ogden_params,
    .n_params = sizeof ogden_params / sizeof *ogden_params,
    .needs = SOLID_NEEDS_F,
    .stress = ogden_stress,
    .wave_speed = ogden_wave_speed,
    .strain_energy = ogden_strain_energy,
    .bulk_modulus = ogden_bulk_modulus,
    .shear_modulus = ogden_shear_modulus,
    .check = ogden_check,
};

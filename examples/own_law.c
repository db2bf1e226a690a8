/* A law of the program's own: the neo-Hookean solid in Young's modulus and Poisson's ratio, beside floe's, in bulk and
 * shear modulus. A block is let go with a bend in its velocity, and must move as with floe's law, to round-off.
 *
 *     cc -std=c11 own_law.c -o own_law $(pkg-config --cflags --libs floe) -lm
 *     ./own_law
 */
#include <floe/floe.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct rubber {
    double youngs_modulus, poissons_ratio;
} rubber;

static const floe_parameter parameters[] = {
    {.key = "youngs_modulus",
     .unit = "Pa",
     .range = FLOE_POSITIVE,
     .fallback = NAN,
     .offset = offsetof(rubber, youngs_modulus),
     .count = 1,
     .doc = "E at rest"},
    {.key = "poissons_ratio",
     .unit = "1",
     .range = FLOE_BETWEEN,
     .lo = -0.9,
     .hi = 0.495,
     .fallback = 0.3,
     .offset = offsetof(rubber, poissons_ratio),
     .count = 1,
     .doc = "nu at rest"},
};

static double shear_modulus(const void *par)
{
    const rubber *a = par;
    return a->youngs_modulus / (2.0 * (1.0 + a->poissons_ratio));
}

static double bulk_modulus(const void *par)
{
    const rubber *a = par;
    return a->youngs_modulus / (3.0 * (1.0 - 2.0 * a->poissons_ratio));
}

static double lame_lambda(const void *par)
{
    return bulk_modulus(par) - 2.0 / 3.0 * shear_modulus(par);
}

/* Component (r, s) of F F^T. */
static double left_cauchy_green(const floe_solid_batch *b, int r, int s, size_t i)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += b->F[3 * r + k][i] * b->F[3 * s + k][i];
    return sum;
}

/* sigma = mu / J (F F^T - I) + lambda ln J / J I */
static size_t stress(const void *par, double p_ref, floe_solid_batch *b)
{
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    const double mu = shear_modulus(par), lambda = lame_lambda(par);
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) {
        if (!(b->J[i] > 0.0)) return i + 1;
        for (int c = 0; c < 6; c++)
            b->stress[c][i] = (mu * (left_cauchy_green(b, row[c], column[c], i) - (c < 3 ? 1.0 : 0.0)) +
                               (c < 3 ? lambda * log(b->J[i]) : 0.0)) /
                              b->J[i];
    }
    return 0;
}

/* rho0 c^2 = mu max(n . B n) + max(mu + lambda (1 - ln J), 0), with a bound of the largest eigenvalue of B. */
static void wave_speed(const void *par, double p_ref, const floe_solid_batch *b, double *c)
{
    const double mu = shear_modulus(par), lambda = lame_lambda(par);
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) {
        double trace = 0.0, squares = 0.0;
        for (int r = 0; r < 3; r++) trace += left_cauchy_green(b, r, r, i);
        for (int r = 0; r < 3; r++)
            for (int s = 0; s < 3; s++) {
                const double deviator = left_cauchy_green(b, r, s, i) - (r == s ? trace / 3.0 : 0.0);
                squares += deviator * deviator;
            }
        const double stretch = trace / 3.0 + sqrt(2.0 / 3.0 * squares);
        c[i] = sqrt((mu * stretch + fmax(mu + lambda * (1.0 - log(b->J[i])), 0.0)) / b->rho0[i]);
    }
}

static void strain_energy(const void *par, const floe_solid_batch *b, double *psi)
{
    const double mu = shear_modulus(par), lambda = lame_lambda(par);
    for (size_t i = 0; i < b->n; i++) {
        const double ln_J = log(b->J[i]);
        double trace = 0.0;
        for (int r = 0; r < 3; r++) trace += left_cauchy_green(b, r, r, i);
        psi[i] = 0.5 * mu * (trace - 3.0) - mu * ln_J + 0.5 * lambda * ln_J * ln_J;
    }
}

static const floe_solid_law law = {.size = sizeof law,
                                   .name = "my_rubber",
                                   .doc = "neo-Hookean, by Young's modulus and Poisson's ratio",
                                   .parameter_size = sizeof(rubber),
                                   .parameters = parameters,
                                   .n_parameters = sizeof parameters / sizeof *parameters,
                                   .needs = FLOE_NEEDS_F,
                                   .stress = stress,
                                   .wave_speed = wave_speed,
                                   .strain_energy = strain_energy,
                                   .bulk_modulus = bulk_modulus,
                                   .shear_modulus = shear_modulus};

static const char deck_text[] =
    "floe: 1\n"
    "title: a block that is let go\n"
    "coupling: mpm\n"
    "domain: {dim: 2, lower: [0 m, 0 m], upper: [1 m, 1 m], cell: 0.1 m}\n"
    "boundaries: {x: symmetry, y: symmetry}\n"
    "materials:\n"
    "  block: {density: 1100 kg/m^3, law: {my_rubber: {youngs_modulus: 1.2 MPa, poissons_ratio: 0.2}}}\n"
    "bodies:\n"
    "  left: {material: block, shape: {box: {lower: [0.2 m, 0.3 m], upper: [0.5 m, 0.7 m]}}, velocity: [8 m/s, 3 "
    "m/s]}\n"
    "  right: {material: block, shape: {box: {lower: [0.5 m, 0.3 m], upper: [0.8 m, 0.7 m]}}, velocity: [-4 m/s, 0 "
    "m/s]}\n"
    "time: {end: 20 ms}\n";

/* K = E / (3 (1 - 2 nu)), G = E / (2 (1 + nu)) of the same solid. */
static const char *const floes_own[] = {
    "materials.block.law={neo_hookean: {bulk_modulus: 666666.66666666663 Pa, shear_modulus: 0.5 MPa}}"};

/* The stress of the points at the end, in *out, which the caller frees, and the strain energy. */
static floe_status run(floe_context *floe, const char *const *set, size_t n_set, double **out, size_t *n,
                       floe_totals *sum)
{
    floe_deck *deck = NULL;
    floe_simulation *s = NULL;
    floe_status status = floe_load_text(floe, "block", deck_text, set, n_set, &deck);
    if (status == FLOE_OK) status = floe_simulation_create(deck, NULL, &s);
    if (status == FLOE_OK) status = floe_advance(s, floe_end_time(s));
    if (status == FLOE_OK) status = floe_copy_field(s, "points/left/stress_xx", NULL, 0, n);
    *out = status == FLOE_OK ? malloc(*n * sizeof **out) : NULL;
    if (*out) status = floe_copy_field(s, "points/left/stress_xx", *out, *n, NULL);
    if (status == FLOE_OK) status = floe_sum(s, sum);
    floe_simulation_destroy(&s);
    floe_deck_destroy(&deck);
    return status;
}

int main(void)
{
    floe_context *floe = floe_create();
    double *own = NULL, *floes = NULL, most = 0.0, apart = 0.0;
    size_t n = 0, n_floes = 0;
    floe_totals sum = {0}, sum_floes = {0};
    if (!floe) return 4;
    floe_status status = floe_init();
    if (status == FLOE_OK) status = floe_add_solid_law(floe, &law);
    if (status == FLOE_OK) status = run(floe, NULL, 0, &own, &n, &sum);
    if (status == FLOE_OK) status = run(floe, floes_own, 1, &floes, &n_floes, &sum_floes);
    if (status != FLOE_OK) fprintf(stderr, "%s\n", floe_message(floe));
    for (size_t i = 0; status == FLOE_OK && own && floes && n == n_floes && i < n; i++) {
        most = fmax(most, fabs(floes[i]));
        apart = fmax(apart, fabs(own[i] - floes[i]));
    }
    printf("%zu points, stress up to %.4g Pa, apart by %.2g of it; strain energy %.10g J and %.10g J\n", n, most,
           apart / most, sum.strain_energy, sum_floes.strain_energy);
    free(own);
    free(floes);
    floe_destroy(&floe);
    return status == FLOE_OK && most > 1e3 && apart <= 1e-9 * most ? 0 : 1;
}

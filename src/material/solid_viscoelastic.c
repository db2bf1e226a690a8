/* Rubber that relaxes: a neo-Hookean network, and up to four that break and form again, each in its own time tau_i.
 *
 * With C = F^T F of constant volume, Cbar = J^(-2/3) C, a network i carries A_i, the mean of Cbar^-1 over the times at
 * which its strands were formed:
 *
 *   dA_i/dt = (Cbar^-1 - A_i)/tau_i,  B_i = Fbar A_i Fbar^T,  G_i = g_i G, G_0 = G - sum G_i,
 *   psi = K/4 (J^2 - 1 - 2 ln J) + G_0/2 (tr Bbar - 3) + sum_i G_i/2 (tr B_i - 3) per initial volume,
 *   sigma = K/2 (J - 1/J) I + 1/J dev(G_0 Bbar + sum_i G_i B_i),  heat: sum_i psi_i/tau_i
 *
 * (Green & Tobolsky 1946; Lodge 1956). In small strains, and in simple shear of any size, the shear stress is that of the
 * Prony series G(t) = G_0 + sum_i G_i exp(-t/tau_i). A_i is a mean of tensors of determinant 1, so that det A_i >= 1 and
 * tr B_i >= 3: no network makes energy. A step takes its strands at two times, by Gauss's rule for the exponential:
 * exact for steady rates, with weights that are positive however long it is. (docs/theory, 1.6) */
#include "material/hyperelastic.h"
#include "material/solid_checks.h"
#include "math/tensor.h"

enum { NETWORKS = 4, COMPONENTS = 6, HISTORY_COUNT = NETWORKS * COMPONENTS, NODES = 2 };

typedef struct viscoelastic_par {
    double bulk_modulus, shear_modulus; /* Pa */
    double g_1, tau_1;                  /* 1, s */
    double g_2, tau_2;
    double g_3, tau_3;
    double g_4, tau_4;
} viscoelastic_par;

#define LATER_NETWORK(g, tau)                                                                                          \
    PAR_BETWEEN(viscoelastic_par, g, "1", 0.0, 1.0, 0.0, "as g_1, of a further term of the series; 0: there is none"), \
        PAR_NONNEGATIVE(viscoelastic_par, tau, "s", 0.0, "its relaxation time")

static const param_spec viscoelastic_params[] = {
    PAR_POSITIVE(viscoelastic_par, bulk_modulus, "Pa", NAN, "bulk modulus K, at rest; it does not relax"),
    PAR_POSITIVE(viscoelastic_par, shear_modulus, "Pa", NAN, "shear modulus G of a sudden strain"),
    PAR_BETWEEN(viscoelastic_par, g_1, "1", 0.0, 1.0, NAN, "share of the shear modulus that relaxes in tau_1"),
    PAR_POSITIVE(viscoelastic_par, tau_1, "s", NAN, "relaxation time"),
    LATER_NETWORK(g_2, tau_2),
    LATER_NETWORK(g_3, tau_3),
    LATER_NETWORK(g_4, tau_4),
};

/* A_i - I, so that all is 0 at rest. */
#define NETWORK_HISTORY(name)                                                                              \
    {name "_xx", "1", "A - I of a network that relaxes, in axes at rest"}, {name "_yy", "1", "A - I, yy"}, \
        {name "_zz", "1", "A - I, zz"}, {name "_xy", "1", "A - I, xy"}, {name "_yz", "1", "A - I, yz"},    \
    {                                                                                                      \
        name "_zx", "1", "A - I, zx"                                                                       \
    }

static const solid_history viscoelastic_history[HISTORY_COUNT] = {
    NETWORK_HISTORY("network_1"), NETWORK_HISTORY("network_2"), NETWORK_HISTORY("network_3"),
    NETWORK_HISTORY("network_4")};

typedef struct networks {
    int n;
    double G, lasting;                     /* Pa: of a sudden strain, after all relaxation */
    double share[NETWORKS], tau[NETWORKS]; /* Pa, s */
} networks;

static networks networks_of(const viscoelastic_par *a)
{
    const double g[NETWORKS] = {a->g_1, a->g_2, a->g_3, a->g_4};
    const double tau[NETWORKS] = {a->tau_1, a->tau_2, a->tau_3, a->tau_4};
    networks w = {.n = 0, .G = a->shear_modulus, .lasting = a->shear_modulus};
    for (int k = 0; k < NETWORKS; k++) {
        w.share[k] = g[k] * a->shear_modulus;
        w.tau[k] = tau[k];
        w.lasting -= w.share[k];
        if (g[k] > 0.0) w.n = k + 1;
    }
    return w;
}

static const char *viscoelastic_check(const void *par)
{
    const viscoelastic_par *a = par;
    const networks w = networks_of(a);
    for (int k = 0; k < NETWORKS; k++)
        if (w.share[k] > 0.0 && !(w.tau[k] > 0.0)) return "a term of the series with g above 0 needs a tau above 0";
    if (!(w.lasting > 1e-9 * w.G))
        return "g_1 + g_2 + g_3 + g_4 is not below 1, and no stress would last: what flows is a fluid";
    return NULL;
}

/* Cbar = J^(-2/3) F^T F. */
static void unimodular_strain(const double F[9], double J, double out[6])
{
    static const double one[6] = {1, 1, 1, 0, 0, 0};
    double transposed[9];
    const double root = cbrt(J), factor = 1.0 / (root * root);
    tensor_transpose(F, transposed);
    symmetric_congruence(transposed, one, out);
    for (int k = 0; k < 6; k++) out[k] *= factor;
}

static void gradient_at(const solid_batch *b, size_t i, double F[9])
{
    for (int k = 0; k < 9; k++) F[k] = b->F[k][i];
}

/* How a network relaxes in a step of x = dt/tau: A' = kept A + sum_j weight_j Cbar^-1 at the time back_j dt before the end. */
typedef struct relaxation {
    double kept, mean;                 /* exp(-x), (1 - exp(-x))/x */
    double back[NODES], weight[NODES]; /* 1 */
} relaxation;

/* Moments of x exp(-x u) over u from 0 to 1. */
static void relaxation_moments(double x, double moment[2 * NODES])
{
    const double end = exp(-x);
    for (int k = 0; k < 2 * NODES; k++) {
        if (x >= 1.0) {
            moment[k] = k == 0 ? -expm1(-x) : k / x * moment[k - 1] - end;
            continue;
        }
        double term = x, sum = 0.0; /* by the series: the recurrence loses its digits */
        for (int n = 0; n < 20; n++) {
            sum += term / (n + k + 1);
            term *= -x / (n + 1);
        }
        moment[k] = sum;
    }
}

/* Gauss's rule of two nodes for the weight x exp(-x u): exact where Cbar^-1 is of third degree in time, as in steady
 * shear, for any x; its weights are positive. */
static relaxation relaxation_over(double x)
{
    relaxation r = {.kept = exp(-x), .mean = x > 0.0 ? -expm1(-x) / x : 1.0};
    double m[2 * NODES];
    if (!(x > 0.0)) return r; /* no time, no relaxation: nodes of weight 0 */
    relaxation_moments(x, m);
    const double m1 = m[1] / m[0], m2 = m[2] / m[0],
                 m3 = m[3] / m[0]; /* u^2 - sum u + product is orthogonal to 1 and u */
    const double sum = (m3 - m1 * m2) / (m2 - m1 * m1), product = sum * m1 - m2;
    const double half = 0.5 * sum, root = sqrt(fmax(half * half - product, 0.0));
    r.back[0] = half - root;
    r.back[1] = half + root;
    r.weight[1] = m[0] * (m1 - r.back[0]) / (r.back[1] - r.back[0]);
    r.weight[0] = m[0] - r.weight[1];
    return r;
}

/* A point in its step: the strain u dt before its end has F = exp(-u dt L) F'. */
typedef struct point_step {
    double A[9], inverse[9]; /* dt L, F'^-1 */
    double C[2][6];          /* Cbar at the start, at the end */
} point_step;

static void begin_point(const solid_batch *b, size_t i, point_step *s)
{
    double F[9], back[9], undone[9], start[9];
    gradient_at(b, i, F);
    (void)tensor_inverse(F, s->inverse);
    for (int k = 0; k < 9; k++) back[k] = -(s->A[k] = b->dt * b->L[k][i]);
    tensor_exp(back, undone);
    tensor_multiply(undone, F, start);
    unimodular_strain(start, tensor_det(start), s->C[0]);
    unimodular_strain(F, b->J[i], s->C[1]);
}

/* M += weight (Cbar^-1 - I), u dt before the end of the step. */
static void add_strands(const point_step *s, double u, double weight, double M[6])
{
    static const double one[6] = {1, 1, 1, 0, 0, 0};
    double A[9], forth[9], inverse[9], C[6];
    for (int k = 0; k < 9; k++) A[k] = u * s->A[k];
    tensor_exp(A, forth);
    tensor_multiply(s->inverse, forth, inverse); /* F^-1 */
    symmetric_congruence(inverse, one, C);
    const double root = cbrt(tensor_det(inverse)), factor = 1.0 / (root * root);
    for (int k = 0; k < 6; k++) M[k] += weight * (factor * C[k] - one[k]);
}

/* tr B_i - 3 = A_i : Cbar - 3, of M = A_i - I. */
static double excess_trace(const double C[6], const double M[6])
{
    return symmetric_trace(C) - 3.0 + symmetric_contract(M, C);
}

/* Relaxes a network of modulus G; what it loses (J/m3). With a power that is even over the step psi' = psi exp(-x) + w (1
 * - exp(-x))/x for the work w, and w + psi - psi' is lost. */
static double relax_network(double G, const relaxation *r, const point_step *s, double M[6])
{
    const double before = 0.5 * G * excess_trace(s->C[0], M);
    for (int k = 0; k < 6; k++) M[k] *= r->kept;
    for (int n = 0; n < NODES; n++) add_strands(s, r->back[n], r->weight[n], M);
    const double after = 0.5 * G * excess_trace(s->C[1], M);
    const double of_before = fmax(r->mean - r->kept, 0.0), of_after = fmax(1.0 - r->mean, 0.0);
    return (of_before * fmax(before, 0.0) + of_after * fmax(after, 0.0)) / r->mean;
}

static void load_network(const solid_batch *b, size_t i, int network, double M[6])
{
    for (int k = 0; k < 6; k++) M[k] = b->history[COMPONENTS * network + k][i];
}

/* J times the stress of all networks before its mean is taken out: Fbar (G I + sum G_i M_i) Fbar^T. */
static void network_stress(const networks *w, const solid_batch *b, size_t i, double T[6])
{
    double F[9], sum[6] = {w->G, w->G, w->G, 0.0, 0.0, 0.0};
    for (int n = 0; n < w->n; n++) {
        double M[6];
        load_network(b, i, n, M);
        for (int k = 0; k < 6; k++) sum[k] += w->share[n] * M[k];
    }
    gradient_at(b, i, F);
    symmetric_congruence(F, sum, T);
    const double root = cbrt(b->J[i]), factor = 1.0 / (root * root);
    for (int k = 0; k < 6; k++) T[k] *= factor;
}

/* All networks of point i over the step; what they lose (J per initial volume). */
static double relax_networks(const networks *w, const relaxation r[NETWORKS], solid_batch *b, size_t i)
{
    point_step s;
    double lost = 0.0;
    begin_point(b, i, &s);
    for (int n = 0; n < w->n; n++) {
        double M[6];
        if (!(w->share[n] > 0.0)) continue;
        load_network(b, i, n, M);
        lost += relax_network(w->share[n], &r[n], &s, M);
        for (int k = 0; k < 6; k++) b->history[COMPONENTS * n + k][i] = M[k];
    }
    return lost;
}

static size_t viscoelastic_stress(const void *par, double p_ref, solid_batch *restrict b)
{
    const viscoelastic_par *a = par;
    const networks w = networks_of(a);
    (void)p_ref; /* the stress of a solid is gauge already */
    const size_t inverted = solid_first_inverted(b);
    if (inverted != 0) return inverted;
    relaxation r[NETWORKS];
    for (int n = 0; n < w.n; n++) r[n] = relaxation_over(w.share[n] > 0.0 ? b->dt / w.tau[n] : 0.0);
    for (size_t i = 0; i < b->n; i++) {
        double T[6];
        const double lost = relax_networks(&w, r, b, i);
        network_stress(&w, b, i, T);
        const double mean = symmetric_trace(T) / 3.0, over_J = 1.0 / b->J[i];
        const double pressure = 0.5 * a->bulk_modulus * (b->J[i] - over_J);
        for (int k = 0; k < 6; k++) b->stress[k][i] = k < 3 ? over_J * (T[k] - mean) + pressure : over_J * T[k];
        b->energy[i] += (lost - b->q[i] * (b->J[i] - b->J_old[i])) / b->rho0[i];
    }
    return 0;
}

/* Sudden waves: those of the strands as they are, G_0 Bbar + sum G_i B_i in the place of G Bbar of a neo-Hookean solid,
 * whose bound is 4/3 b_1 + (b_1 - b_3)/3 by its largest and least eigenvalue. Exact at rest. */
static void viscoelastic_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const viscoelastic_par *a = par;
    const networks w = networks_of(a);
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) {
        double T[6], deviator[6];
        network_stress(&w, b, i, T);
        const double mean = symmetric_deviator(T, deviator);
        const double spread = sqrt(2.0 / 3.0 * symmetric_contract(deviator, deviator));
        const double largest = mean + spread, least = fmax(mean - spread, 0.0);
        const double shear = 4.0 / 3.0 * largest + (largest - least) / 3.0;
        c[i] = sqrt((0.5 * a->bulk_modulus * (b->J[i] * b->J[i] + 1.0) + shear) / b->rho0[i]);
    }
}

static void viscoelastic_strain_energy(const void *par, const solid_batch *b, double *restrict psi)
{
    const viscoelastic_par *a = par;
    const networks w = networks_of(a);
    for (size_t i = 0; i < b->n; i++) {
        double F[9], C[6];
        gradient_at(b, i, F);
        unimodular_strain(F, b->J[i], C);
        psi[i] = 0.25 * a->bulk_modulus * (b->J[i] * b->J[i] - 1.0 - 2.0 * log(b->J[i])) +
                 0.5 * w.G * (symmetric_trace(C) - 3.0);
        for (int n = 0; n < w.n; n++) {
            double M[6];
            load_network(b, i, n, M);
            psi[i] += 0.5 * w.share[n] * symmetric_contract(M, C);
        }
    }
}

static double viscoelastic_bulk_modulus(const void *par)
{
    return ((const viscoelastic_par *)par)->bulk_modulus;
}

static double viscoelastic_shear_modulus(const void *par)
{
    return ((const viscoelastic_par *)par)->shear_modulus;
}

const solid_model solid_viscoelastic = {
    .name = "viscoelastic",
    .doc = "rubber that relaxes: neo-Hookean networks, up to four of which break and form again (Prony series)",
    .cite = "M. S. Green, A. V. Tobolsky, J. Chem. Phys. 14 (1946) 80; A. S. Lodge, Trans. Faraday Soc. 52 (1956) 120; "
            "G. A. Holzapfel, Nonlinear Solid Mechanics (2000), section 6.10",
    .param_size = sizeof(viscoelastic_par),
    .params = viscoelastic_params,
    .n_params = sizeof viscoelastic_params / sizeof *viscoelastic_params,
    .needs = SOLID_NEEDS_F | SOLID_HAS_ENERGY | SOLID_NEEDS_TIME,
    .history = viscoelastic_history,
    .n_history = HISTORY_COUNT,
    .stress = viscoelastic_stress,
    .wave_speed = viscoelastic_wave_speed,
    .strain_energy = viscoelastic_strain_energy,
    .bulk_modulus = viscoelastic_bulk_modulus,
    .shear_modulus = viscoelastic_shear_modulus,
    .check = viscoelastic_check,
};

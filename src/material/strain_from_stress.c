/* By the law itself: what is left of the stress is taken up by the strain that the moduli at rest give for it. */
#include "material/strain_from_stress.h"

#include "math/tensor.h"

#include <math.h>
#include <string.h>

enum { MOST_ROUNDS = 200 };

static const int slot[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/* The law's stress at F; false beyond it. */
static bool stress_at(const solid_model *law, const void *par, const double F[9], double stress[6])
{
    solid_batch b;
    memset(&b, 0, sizeof b);
    b.n = 1;
    b.rho0[0] = 1.0;
    for (int c = 0; c < 9; ++c) b.F[c][0] = F[c];
    b.J[0] = b.J_old[0] = tensor_det(F);
    if (!(b.J[0] > 0.0) || law->stress(par, 0.0, &b) != 0) return false;
    for (int c = 0; c < 6; ++c) stress[c] = b.stress[c][0];
    return true;
}

/* F <- (1 + e) F, symmetric, e the strain of `left` by Hooke's law. */
static void strain_by(double K, double G, const double left[6], double F[9])
{
    const double mean = (left[0] + left[1] + left[2]) / 3.0;
    double e[9], product[9];
    for (int c = 0; c < 6; ++c) {
        const int i = slot[c][0], j = slot[c][1];
        const double part = i == j ? (left[c] - mean) / (2.0 * G) + mean / (3.0 * K) : left[c] / (2.0 * G);
        e[3 * i + j] = e[3 * j + i] = part;
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            product[3 * i + j] = F[3 * i + j];
            for (int k = 0; k < 3; ++k) product[3 * i + j] += e[3 * i + k] * F[3 * k + j];
        }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) F[3 * i + j] = 0.5 * (product[3 * i + j] + product[3 * j + i]);
}

bool strain_from_stress(const solid_model *law, const void *par, const double stress[6], double F[9])
{
    const double K = law->bulk_modulus(par), G = law->shear_modulus(par);
    double size = 0.0;
    for (int c = 0; c < 9; ++c) F[c] = c % 4 == 0 ? 1.0 : 0.0;
    for (int c = 0; c < 6; ++c) {
        if (!isfinite(stress[c])) return false;
        size = fmax(size, fabs(stress[c]));
    }
    if (size == 0.0) return true;
    if (!(K > 0.0) || !(G > 0.0)) return false;
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        double now[6], left[6], worst = 0.0;
        if (!stress_at(law, par, F, now)) return false;
        for (int c = 0; c < 6; ++c) {
            left[c] = stress[c] - now[c];
            if (!isfinite(left[c])) return false;
            worst = fmax(worst, fabs(left[c]));
        }
        /* Places of F are known to 1e-16, and the law takes some differences of them. */
        if (worst <= 1e-13 * size + 1e-14 * (K + G)) return true;
        strain_by(K, G, left, F);
    }
    return false;
}

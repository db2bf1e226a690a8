/* Pointwise exchange: momentum to round-off for any coupling, the exact discrete decay, absent and prescribed materials. */
#include "check.h"

#include "coupling/exchange.h"

#include <math.h>
#include <stdlib.h>

/* A number in [0, 1) from a small generator of our own: the same on every machine. */
static double next(unsigned long long *seed)
{
    *seed = *seed * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*seed >> 11) * 0x1p-53;
}

static void momentum_is_kept(void **state)
{
    (void)state;
    const double strengths[] = {1.0, 1e15, 1e20};
    unsigned long long seed = 7;
    double worst = 0.0;
    for (int s = 0; s < 3; ++s)
        for (int n = 2; n <= 5; ++n)
            for (int trial = 0; trial < 500; ++trial) {
                double mass[EXCHANGE_MAX], theta[EXCHANGE_MAX], u[1][EXCHANGE_MAX], before = 0.0, after = 0.0,
                                                                                    scale = 0.0;
                exchange_matrix K, a;
                for (int r = 0; r < n; ++r) {
                    mass[r] = pow(10.0, 12.0 * next(&seed) - 6.0);
                    theta[r] = next(&seed) / n;
                    u[0][r] = 2e3 * next(&seed) - 1e3;
                    before += mass[r] * u[0][r];
                    scale += mass[r] * fabs(u[0][r]);
                    for (int q = 0; q < n; ++q) K[r][q] = strengths[s];
                }
                exchange_couple(n, K, theta, 1e-6, a);
                exchange_relax(n, mass, a, 1, u);
                for (int r = 0; r < n; ++r) after += mass[r] * u[0][r];
                check_true(isfinite(after));
                worst = fmax(worst, fabs(after - before) / scale);
            }
    check_true(worst <= 1e-14);
}

/* tau = 1/[K theta1 theta2 (1/rho1 + 1/rho2)]: one implicit step leaves 1/(1 + dt/tau) of the difference (theory 2.9). */
static void decay_of_a_pair(void **state)
{
    (void)state;
    const double rho[2] = {1.2, 1000.0}, theta[2] = {0.3, 0.7}, dt = 1e-3;
    for (int e = -3; e <= 9; e += 3) {
        exchange_matrix K = {{0.0}}, a;
        K[0][1] = K[1][0] = pow(10.0, e);
        double u[2][EXCHANGE_MAX] = {{10.0, -4.0}, {0.0, 3.0}};
        exchange_couple(2, K, theta, dt, a);
        exchange_relax(2, rho, a, 2, u);
        const double rate = K[0][1] * theta[0] * theta[1] * (1.0 / rho[0] + 1.0 / rho[1]);
        check_close(u[0][0] - u[0][1], 14.0 / (1.0 + dt * rate), 1e-13);
        check_close(u[1][0] - u[1][1], -3.0 / (1.0 + dt * rate), 1e-13);
    }
}

/* Three materials against the dense matrix: (diag(m) + A) u' = m u holds for the answer. */
static void solution_satisfies_the_system(void **state)
{
    (void)state;
    const double mass[3] = {1.0, 20.0, 0.05}, theta[3] = {0.2, 0.5, 0.3};
    exchange_matrix K = {{0.0, 3.0, 5.0}, {3.0, 0.0, 11.0}, {5.0, 11.0, 0.0}}, a;
    double u[1][EXCHANGE_MAX] = {{1.0, -2.0, 30.0}};
    const double old[3] = {1.0, -2.0, 30.0};
    exchange_couple(3, K, theta, 0.7, a);
    exchange_relax(3, mass, a, 1, u);
    for (int r = 0; r < 3; ++r) {
        double pull = 0.0;
        for (int s = 0; s < 3; ++s) pull += a[r][s] * (u[0][s] - u[0][r]);
        check_close(mass[r] * (u[0][r] - old[r]), pull, 1e-13);
    }
}

static void absent_material_gets_the_mean(void **state)
{
    (void)state;
    const double mass[3] = {2.0, 0.0, 6.0}, theta[3] = {0.5, 0.0, 0.5};
    exchange_matrix K = {{0.0, 1e20, 1e20}, {1e20, 0.0, 1e20}, {1e20, 1e20, 0.0}}, a;
    double u[1][EXCHANGE_MAX] = {{4.0, 1e300, 8.0}};
    exchange_couple(3, K, theta, 1e-6, a);
    exchange_relax(3, mass, a, 1, u);
    check_close(u[0][1], 7.0, 1e-14 * 7.0);
    check_close(u[0][0], 7.0, 1e-9);

    const double alone[2] = {0.0, 3.0};
    double w[1][EXCHANGE_MAX] = {{9.0, 5.0}};
    exchange_relax(2, alone, a, 1, w);
    check_close(w[0][0], 5.0, 0.0);
    check_close(w[0][1], 5.0, 0.0);
}

static void prescribed_material_keeps_its_value(void **state)
{
    (void)state;
    const double mass[3] = {1.0, INFINITY, 0.0}, theta[3] = {0.4, 0.6, 0.0};
    exchange_matrix K = {{0.0, 10.0, 0.0}, {10.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, a;
    double u[1][EXCHANGE_MAX] = {{3.0, -1.0, 0.0}};
    exchange_couple(3, K, theta, 0.5, a);
    exchange_relax(3, mass, a, 1, u);
    check_close(u[0][1], -1.0, 0.0);
    check_close(u[0][0], -1.0 + 4.0 / (1.0 + a[0][1]), 1e-15 * 4.0);
    check_close(u[0][2], -1.0, 0.0);
}

/* Locked along a random normal and free across it: each material keeps its tangential velocity to round-off, all have the normal
 * velocity of the centre of mass, and momentum is kept; alike tensors are the plain exchange. */
static void slip_in_a_frame(void **state)
{
    (void)state;
    unsigned long long seed = 11;
    for (int dim = 1; dim <= 3; ++dim)
        for (int trial = 0; trial < 500; ++trial) {
            enum { N = 4 };
            double mass[N], theta[N], n[3] = {0.0}, u[3][EXCHANGE_MAX], w[3][EXCHANGE_MAX], same[3][EXCHANGE_MAX];
            double size = 0.0, total = 0.0, mean = 0.0;
            exchange_matrix K = {{0.0}}, a, none = {{0.0}};
            for (int x = 0; x < dim; ++x) n[x] = 2.0 * next(&seed) - 1.0;
            for (int x = 0; x < dim; ++x) size += n[x] * n[x];
            for (int x = 0; x < dim; ++x) n[x] /= sqrt(size);
            for (int r = 0; r < N; ++r) {
                mass[r] = pow(10.0, 6.0 * next(&seed) - 3.0);
                theta[r] = 0.25;
                for (int x = 0; x < dim; ++x) u[x][r] = w[x][r] = same[x][r] = 2e3 * next(&seed) - 1e3;
                for (int q = 0; q < N; ++q) K[r][q] = 1e25;
                for (int x = 0; x < dim; ++x) mean += mass[r] * u[x][r] * n[x];
                total += mass[r];
            }
            exchange_couple(N, K, theta, 1e-6, a);
            exchange_relax_frame(N, mass, theta, true, a, none, dim, n, w);
            for (int r = 0; r < N; ++r) {
                double before = 0.0, after = 0.0;
                for (int x = 0; x < dim; ++x) {
                    before += u[x][r] * n[x];
                    after += w[x][r] * n[x];
                }
                check_close(after, mean / total, 5e-10); /* couplings are cut at 1e12 of the masses */
                for (int x = 0; x < dim; ++x) check_close(w[x][r] - after * n[x], u[x][r] - before * n[x], 1e-11);
            }
            for (int x = 0; x < dim; ++x) {
                double change = 0.0;
                for (int r = 0; r < N; ++r) change += mass[r] * (w[x][r] - u[x][r]);
                check_true(fabs(change) <= 1e-14 * 1e3 * total);
            }
            exchange_relax_frame(N, mass, theta, true, a, a, dim, n, same);
            exchange_relax(N, mass, a, dim, u);
            for (int x = 0; x < dim; ++x)
                for (int r = 0; r < N; ++r) check_close(same[x][r], u[x][r], 1e-10);
        }
}

/* What is free of the rest keeps its momentum to round-off, however heavy that is: two locked gases beside a solid 1e12 times as heavy. */
static void free_parts_are_kept(void **state)
{
    (void)state;
    const double mass[3] = {2.4e-8, 0.14, 1e11}, theta[3] = {0.2, 0.3, 0.5};
    exchange_matrix K = {{0.0, 1e100, 0.0}, {1e100, 0.0, 0.0}, {0.0, 0.0, 0.0}}, a;
    double u[1][EXCHANGE_MAX] = {{5.0, 3.0, -7.0}};
    exchange_couple(3, K, theta, 1e-7, a);
    exchange_relax(3, mass, a, 1, u);
    const double mean = (5.0 * mass[0] + 3.0 * mass[1]) / (mass[0] + mass[1]);
    check_close(u[0][0], mean, 1e-9);
    check_close(u[0][1], mean, 1e-9);
    check_close(u[0][2], -7.0, 0.0);
}

/* Water slips along a wall. A trace of air that is locked to both moves with them, and in 1e4 steps takes next to nothing from one to the
 * other; a tenth of air locks them in one. */
static void traces_carry_no_force(void **state)
{
    (void)state;
    const double share[2] = {1e-6, 0.1};
    for (int k = 0; k < 2; ++k) {
        const double theta[3] = {share[k], 0.5 - share[k], 0.5},
                     mass[3] = {1.2 * theta[0], 1e3 * theta[1], 8e3 * theta[2]};
        exchange_matrix K = {{0.0, 1e100, 1e100}, {1e100, 0.0, 0.0}, {1e100, 0.0, 0.0}}, a;
        double u[1][EXCHANGE_MAX] = {{30.0, 1.0, 0.0}}, before = 0.0, after = 0.0;
        for (int r = 0; r < 3; ++r) before += mass[r] * u[0][r];
        for (int step = 0; step < 10000; ++step) {
            exchange_couple(3, K, theta, 1e-6, a);
            exchange_relax_parts(3, mass, theta, a, 1, u);
        }
        for (int r = 0; r < 3; ++r) after += mass[r] * u[0][r];
        check_close(after, before, 1e-12 * before);
        if (k == 0) {
            check_close(u[0][1] - u[0][2], 1.0, 6e-8);
            check_true(u[0][0] >= u[0][2] && u[0][0] <= u[0][1]);
        } else {
            check_close(u[0][1], u[0][2], 1e-14);
        }
    }
}

/* A trace of weight w between two heavy ones: with couplings of at most m w/(1 - w) in the system of all; then it goes by what is left of them as
 * between partners that stand, u' = (m u + sum r_s u_s)/(m + sum r_s), and they get back what it takes. By volume or by mass, w is 0 at a share of
 * 1e-4, 1/2 at 1e-3 and 1 at 1e-2. */
static void traces_follow(void **state)
{
    (void)state;
    static const struct {
        double theta, mass, w;
    } trace[] = {{1e-6, 1.2e-6, 0.0}, {1e-4, 1e-5, 0.0},   {1e-3, 1.2e-3, 0.5}, {1e-6, 4.5 / 0.999 * 1e-3, 0.5},
                 {0.01, 1e-3, 1.0},   {1e-5, 0.0455, 1.0}, {0.2, 3.0, 1.0}};
    static const double strength[] = {0.1, 3.0, 1e25};
    for (size_t k = 0; k < sizeof trace / sizeof *trace; ++k)
        for (size_t i = 0; i < sizeof strength / sizeof *strength; ++i) {
            const double m = trace[k].mass, w = trace[k].w, mass[3] = {m, 0.5, 4.0},
                         theta[3] = {trace[k].theta, 0.5, 0.5 - trace[k].theta};
            exchange_matrix a = {{0.0}}, limited = {{0.0}};
            a[0][1] = a[1][0] = m * strength[i];
            a[0][2] = a[2][0] = 2.0 * m * strength[i];
            a[1][2] = a[2][1] = 0.3;
            double u[1][EXCHANGE_MAX] = {{30.0, 1.0, -2.0}}, v[1][EXCHANGE_MAX] = {{30.0, 1.0, -2.0}};
            exchange_relax_parts(3, mass, theta, a, 1, u);
            for (int r = 0; r < 3; ++r)
                for (int s = 0; s < 3; ++s) {
                    const double weakness =
                        r * s == 0 ? (1.0 - w) / (m * w) : 0.0; /* one over the most: infinite for w = 0 */
                    limited[r][s] = a[r][s] > 0.0 ? 1.0 / (1.0 / a[r][s] + weakness) : 0.0;
                }
            exchange_relax(3, mass, limited, 1, v);
            double rest = 0.0, pull = 0.0;
            for (int s = 1; s < 3; ++s) rest += a[0][s] - limited[0][s], pull += (a[0][s] - limited[0][s]) * v[0][s];
            const double before = v[0][0];
            v[0][0] = rest > 0.0 ? (before / rest * m + pull / rest) / (m / rest + 1.0) : before;
            for (int s = 1; s < 3 && rest > 0.0; ++s)
                v[0][s] -= m * (v[0][0] - before) / mass[s] * ((a[0][s] - limited[0][s]) / rest);
            for (int r = 0; r < 3; ++r) check_close(u[0][r], v[0][r], 1e-10);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(decay_of_a_pair),
        cmocka_unit_test(free_parts_are_kept),
        cmocka_unit_test(traces_carry_no_force),
        cmocka_unit_test(traces_follow),
        cmocka_unit_test(solution_satisfies_the_system),
        cmocka_unit_test(absent_material_gets_the_mean),
        cmocka_unit_test(prescribed_material_keeps_its_value),
        cmocka_unit_test(slip_in_a_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

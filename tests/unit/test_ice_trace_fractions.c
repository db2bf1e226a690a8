/* What is done to next to nothing of a fluid in a cell: no more flows out than half of it, and quotients of round-off are not taken for its state;
 * which way a wall faces; and what a gas gives up that expands. */
#include "check.h"

#include "ice/exchange/ice_pairs.h"
#include "ice/flux/ice_advect.h"
#include "ice/flux/ice_expansion.h"

#include <math.h>
#include <string.h>

enum { CELLS = 7, WIDE = CELLS + 2 * MESH_GHOST };

/* A velocity whose square is beyond 1e4 (c^2 + |u|^2), or an energy beyond 1e4 (|e| + c^2 + |u|^2), is none. */
static void test_clip_roundoff(void **unused)
{
    (void)unused;
    static const double c = 2.0, u[3] = {3.0, -4.0, 12.0}, e = -50.0;
    for (int dim = 1; dim <= 3; ++dim) {
        double square = c * c;
        for (int a = 0; a < dim; ++a) square += u[a] * u[a];
        const double fast = 100.0 * sqrt(square), hot = 1e4 * (fabs(e) + square);
        for (int axis = 0; axis < dim; ++axis)
            for (int sign = -1; sign <= 1; sign += 2)
                for (int beyond = 0; beyond < 2; ++beyond) {
                    const double factor = sign * (beyond ? 1.001 : 0.999);
                    double now[3] = {u[0], u[1], u[2]}, next[3] = {1.0, 1.0, 1.0}, sound = c, e0 = e, e1 = factor * hot;
                    next[axis] = factor * fast;
                    const ice_fluid m = {.u = {&now[0], &now[1], &now[2]},
                                         .u1 = {&next[0], &next[1], &next[2]},
                                         .c = &sound,
                                         .e = &e0,
                                         .e1 = &e1};
                    ice_clip_roundoff(&m, 0, dim);
                    for (int a = 0; a < dim; ++a)
                        check_close(next[a], a != axis ? 1.0 : beyond ? u[a] : factor * fast, 0.0);
                    check_close(e1, beyond ? e : factor * hot, 0.0);
                }
    }
}

/* In a row: each cell's outflow is that through its own two faces, over its own volume; only small volume fractions
 * that would lose more than half are cut, to half. */
static void test_clip(void **unused)
{
    (void)unused;
    block b = {.dim = 1, .n = {CELLS, 1, 1}, .stride = {1, WIDE, WIDE}};
    double theta[WIDE], face[WIDE + 1], lower[WIDE + 1], upper[WIDE], clip[WIDE];
    for (int k = 0; k < WIDE; ++k) {
        static const double share[] = {1e-6, 0.3, 1e-9, 0.0, 2e-6};
        theta[k] = share[k % 5];
    }
    for (int k = 0; k <= WIDE; ++k) {
        face[k] = 40.0 * sin(1.7 * k + 0.3);
        lower[k] = 10.0 + 0.5 * k;
    }
    for (int k = 0; k < WIDE; ++k) upper[k] = lower[k] + 0.25;
    ice_view v = {.b = &b, .dim = 1, .dt = 1.5e-3, .lower0 = lower + MESH_GHOST, .upper0 = upper + MESH_GHOST};
    v.m[0].theta = theta;
    v.m[0].fu[0] = face;
    const ice_advect_job job = {.v = &v};
    ice_advect_buffers w = {.dim = 1, .clip = clip};
    ice_advect_clip(&w, &job, 0);
    int cut = 0, whole = 0;
    for (int i = -1; i <= CELLS; ++i) {
        const int k = i + MESH_GHOST;
        const double out = v.dt * (fmax(face[k + 1], 0.0) * upper[k] + fmax(-face[k], 0.0) * lower[k]);
        const bool sliver = theta[k] > 0.0 && theta[k] <= 1e-6;
        check_close(clip[k], sliver && out > 0.5 ? 0.5 / out : 1.0, 1e-15);
        cut += sliver && out > 0.5;
        whole += sliver && out < 0.5;
    }
    check_true(cut > 0 && whole > 0);
}

/* The unit vector along the slope, and 0 without one; it is a wall's from a millionth a cell on. Nothing is written behind the third component. */
static void test_wall_normal(void **unused)
{
    (void)unused;
    static const double slope[3] = {3.0, -4.0, 12.0};
    for (int dim = 1; dim <= 3; ++dim) {
        double size = 0.0, normal[4] = {7.0, 7.0, 7.0, 7.0};
        for (int a = 0; a < dim; ++a) size = hypot(size, slope[a]);
        const ice_view v = {.dim = dim, .length = 0.01};
        for (int strong = 0; strong < 2; ++strong) {
            const double factor = (strong ? 1.001e-4 : 0.999e-4) / size;
            const double gradient[3] = {factor * slope[0], dim > 1 ? factor * slope[1] : 0.0,
                                        dim > 2 ? factor * slope[2] : 0.0};
            assert_int_equal(ice_wall_normal(&v, gradient, normal), strong);
            for (int a = 0; a < 3; ++a) check_close(normal[a], a < dim ? slope[a] / size : 0.0, 1e-15);
            check_close(normal[3], 7.0, 0.0);
        }
        check_true(!ice_wall_normal(&v, (const double[]){0.0, 0.0, 0.0}, normal));
        for (int a = 0; a < 3; ++a) check_close(normal[a], 0.0, 0.0);
    }
}

/* Nothing up to a drop of 0.3, a half at 7/15, all from 19/30 on; a half of that at half the speed of sound, nothing at three quarters. */
static void test_fall(void **unused)
{
    (void)unused;
    static const double drop[] = {-1.0, 0.3, 7.0 / 15.0, 19.0 / 30.0, 0.9, 5.0},
                        part[] = {0.0, 0.0, 0.5, 1.0, 1.0, 1.0};
    static const double mach[] = {0.0, 0.25, 0.5, 0.75, 3.0}, slow[] = {1.0, 1.0, 0.5, 0.0, 0.0};
    const double rho = 1.3, c = 340.0, p = 2e5;
    for (size_t i = 0; i < sizeof drop / sizeof *drop; ++i)
        for (size_t k = 0; k < sizeof mach / sizeof *mach; ++k)
            for (int sign = -1; sign <= 1; sign += 2) {
                const expansion f = expansion_to(p, rho, c, sign * mach[k] * c, p - drop[i] * rho * c * c);
                const double wanted = part[i] * slow[k];
                check_close(f.velocity, wanted, 1e-14);
                check_close(f.mass, wanted * fmin(drop[i], 0.8), 1e-14);
                check_close(f.energy, wanted * drop[i] * p / rho, 1e-9);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_clip_roundoff),
        cmocka_unit_test(test_clip),
        cmocka_unit_test(test_wall_normal),
        cmocka_unit_test(test_fall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

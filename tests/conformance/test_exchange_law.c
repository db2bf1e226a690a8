/* Every law of exchange: finite and not negative for any fractions, densities and slip, the same for the same state whichever way
 * the velocities differ, growing with viscosity if it asks for one; and the limits that define the known ones.
 *
 * Parameters: the default where there is one that is not 0; else 1e-4 for a length, 0.02 for a conductivity, 1e-5 for a viscosity. */
#include "check.h"

#include "coupling/exchange_law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PAR = 8 };

typedef struct sample {
    const exchange_model *model;
    const exchange_law *law;
    exchange_role role;
    double par[MAX_PAR];
} sample;

static double parameter(const param_spec *p)
{
    if (strcmp(p->unit, "m") == 0) return 1e-4;
    if (strcmp(p->unit, "Pa s") == 0) return 1e-5;
    if (strcmp(p->unit, "W m-1 K-1") == 0) return 0.02;
    if (strcmp(p->unit, "kg m-3 s-1") == 0 || strcmp(p->unit, "W m-3 K-1") == 0) return 1e4;
    return p->fallback;
}

static sample make(const exchange_model *m, exchange_role role)
{
    sample a = {.model = m, .law = &m->law[role], .role = role};
    assert_true(a.law->param_size <= sizeof a.par);
    for (size_t k = 0; k < a.law->n_params; k++) {
        const param_spec *p = &a.law->params[k];
        const double x = parameter(p);
        if (!param_in_range(p, x)) print_message("%s.%s has no sample\n", m->name, p->key);
        check_true(param_in_range(p, x));
        *(double *)(void *)((char *)a.par + p->offset) = x;
    }
    return a;
}

static exchange_pair state(double theta, double density, double slip)
{
    return (exchange_pair){
        .theta = {theta, 1.0 - theta}, .density = {2500.0, density}, .viscosity = {0.0, 1.8e-5}, .slip = slip};
}

static double value(const sample *a, double theta, double density, double slip)
{
    const exchange_pair q = state(theta, density, slip);
    return a->law->coefficient(a->par, a->law->uniform ? NULL : &q);
}

static void on_each(void (*check)(const sample *))
{
    check_true(exchange_registry_size > 0);
    for (size_t i = 0; i < exchange_registry_size; i++) {
        const exchange_model *m = exchange_registry[i];
        assert_ptr_equal(exchange_find(m->name), m);
        assert_true(m->doc && (m->law[EXCHANGE_MOMENTUM].coefficient || m->law[EXCHANGE_HEAT].coefficient));
        for (int role = 0; role < EXCHANGE_ROLES; role++) {
            if (!m->law[role].coefficient) continue;
            const sample a = make(m, (exchange_role)role);
            check(&a);
        }
    }
    assert_null(exchange_find("no such law"));
}

static void check_sign(const sample *a)
{
    const double theta[] = {0.0, 1e-12, 1e-3, 0.5, 0.999, 1.0}, density[] = {1e-6, 1.2, 1e3},
                 slip[] = {0.0, 1e-9, 1.0, 1e4};
    for (size_t i = 0; i < sizeof theta / sizeof *theta; i++)
        for (size_t j = 0; j < sizeof density / sizeof *density; j++)
            for (size_t k = 0; k < sizeof slip / sizeof *slip; k++) {
                const double K = value(a, theta[i], density[j], slip[k]);
                check_true(isfinite(K) && K >= 0.0);
                check_true(K <= EXCHANGE_LOCKED);
            }
}

static void signs(void **unused)
{
    (void)unused;
    on_each(check_sign);
}

/* Faster slip never meets less drag: dissipation grows with it. */
static void check_slip(const sample *a)
{
    for (double slip = 1e-6; slip < 1e4; slip *= 3.0)
        check_true(value(a, 0.1, 1.2, 3.0 * slip) >= value(a, 0.1, 1.2, slip) * (1.0 - 1e-12));
}

static void slips(void **unused)
{
    (void)unused;
    on_each(check_slip);
}

static sample named(const char *name, exchange_role role)
{
    const exchange_model *m = exchange_find(name);
    assert_non_null(m);
    return make(m, role);
}

/* theta_d theta_c K u is 6 theta_d/(pi d^3) spheres' drag: 3 pi mu d u slow, C_D pi d^2/8 rho u^2 with C_D = 0.44 fast; both laws agree
 * at rest; C_D at Re = 100 is 1.0917 (24/100 (1 + 0.15 100^0.687)). Heat: pi k d Nu (T_c - T_d) a sphere, Nu = 2 at rest. */
static void spheres(void **unused)
{
    (void)unused;
    const sample stokes = named("stokes", EXCHANGE_MOMENTUM), fit = named("schiller_naumann", EXCHANGE_MOMENTUM);
    const double pi = 3.14159265358979323846, d = 1e-4, mu = 1e-5, theta = 0.2, rho = 1.2;
    const double spheres_per_volume = 6.0 * theta / (pi * d * d * d);
    const double u = 1e-3, drag = spheres_per_volume * 3.0 * pi * mu * d * u;
    check_close(theta * (1.0 - theta) * value(&stokes, theta, rho, u) * u, drag, 1e-12 * drag);
    check_close(value(&fit, theta, rho, 0.0), value(&stokes, theta, rho, 0.0), 1e-9);
    const double fast = 1e5 * mu / (rho * d), newton = spheres_per_volume * 0.44 * pi * d * d / 8.0 * rho * fast * fast;
    check_close(theta * (1.0 - theta) * value(&fit, theta, rho, fast) * fast, newton, 1e-10 * newton);
    const double middle = 100.0 * mu / (rho * d);
    const double cd = 0.24 * (1.0 + 0.15 * pow(100.0, 0.687));
    const double form = spheres_per_volume * cd * pi * d * d / 8.0 * rho * middle * middle;
    check_close(theta * (1.0 - theta) * value(&fit, theta, rho, middle) * middle, form, 1e-10 * form);
    const sample warm = named("schiller_naumann", EXCHANGE_HEAT), still = named("stokes", EXCHANGE_HEAT);
    const double heat = spheres_per_volume * pi * 0.02 * d * 2.0;
    check_close(theta * (1.0 - theta) * value(&warm, theta, rho, 0.0), heat, 1e-12 * heat);
    check_close(theta * (1.0 - theta) * value(&still, theta, rho, 0.0), heat, 1e-12 * heat);
}

/* Ranz and Marshall's figures: Nu = 2 + 0.6 Re^(1/2) Pr^(1/3) is 8 at Re = 100 and Pr = 1, 14 at Pr = 8, and 62 at Re = 10^4; the law of pure
 * conduction does not ask for the speed. */
static void spheres_in_a_stream(void **unused)
{
    (void)unused;
    static const struct {
        double Re, Pr, Nu;
    } told[] = {{0.0, 0.71, 2.0}, {100.0, 1.0, 8.0}, {100.0, 8.0, 14.0}, {1e4, 1.0, 62.0}, {1e4, 0.001, 8.0}};
    sample warm = named("schiller_naumann", EXCHANGE_HEAT);
    const sample still = named("stokes", EXCHANGE_HEAT);
    double *Pr = param_find(warm.law->params, warm.law->n_params, warm.par, "prandtl");
    assert_non_null(Pr);
    check_close(*Pr, 0.71, 0.0);
    for (size_t k = 0; k < sizeof told / sizeof *told; ++k) {
        const double d = 1e-4, mu = 1e-5, theta = 0.3, rho = 1.7, slip = told[k].Re * mu / (rho * d);
        const double a_sphere = 6.0 / (d * d) * 0.02 / (1.0 - theta);
        *Pr = told[k].Pr;
        check_close_relative(value(&warm, theta, rho, slip), a_sphere * told[k].Nu, 1e-12);
        check_close_relative(value(&still, theta, rho, slip), a_sphere * 2.0, 1e-12);
    }
}

/* The carrier's own viscosity stands in where none is given, and its absence is told. */
static void viscosity(void **unused)
{
    (void)unused;
    sample a = named("stokes", EXCHANGE_MOMENTUM);
    const double none[2] = {0.0, 0.0}, some[2] = {0.0, 1.8e-5}, given = value(&a, 0.1, 1.2, 1.0);
    assert_null(a.law->check(a.par, none));
    double *mu = param_find(a.law->params, a.law->n_params, a.par, "viscosity");
    assert_non_null(mu);
    *mu = 0.0;
    assert_non_null(a.law->check(a.par, none));
    assert_null(a.law->check(a.par, some));
    check_close(value(&a, 0.1, 1.2, 1.0), 1.8 * given, 1e-9 * given);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs),     cmocka_unit_test(slips),
        cmocka_unit_test(spheres),   cmocka_unit_test(spheres_in_a_stream),
        cmocka_unit_test(viscosity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

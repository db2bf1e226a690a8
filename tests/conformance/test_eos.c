/* Every equation of state of the registry, by name of none: derivatives against differences, inverses, round trips.
 *
 * Parameters: the default where there is one; else the middle of a bounded range, else a plausible size by unit, each
 * further required pressure 0.4 of the one before (see sample_parameter). A new unit fails until it is added there. */
#include "check.h"

#include "material/eos.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PAR = 64 };

/* Middling states: pressures over the floor by these shares of `scale`, at these temperatures. */
static const double pressures[] = {1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.6, 0.9, 1.5, 3.0};
static const double temperatures[] = {80.0, 300.0, 2000.0};
enum { N_P = sizeof pressures / sizeof *pressures, N_T = sizeof temperatures / sizeof *temperatures, N = N_P * N_T };

static double sample_parameter(const param_spec *spec, int *n_pressures)
{
    if (!isnan(spec->fallback)) return spec->fallback;
    if (spec->range == PARAM_BETWEEN) return 0.5 * (spec->lo + spec->hi);
    if (strcmp(spec->unit, "Pa") == 0) return 1e9 * pow(0.4, (*n_pressures)++);
    if (strcmp(spec->unit, "kg/m^3") == 0) return 2700.0;
    if (strcmp(spec->unit, "J/kg/K") == 0) return 900.0;
    if (strcmp(spec->unit, "1") == 0) return 1.5;
    if (strcmp(spec->unit, "m/s") == 0) return 1500.0;
    if (strcmp(spec->unit, "m^3/kg") == 0) return 2e-4;
    print_error("no sample value for '%s' in %s\n", spec->key, spec->unit);
    return NAN;
}

/* A model, its parameters, and states on its (p, T) grid. */
typedef struct sample {
    const eos_model *model;
    double par[MAX_PAR];
    double p[N], T[N], v[N], dvdp[N], rho[N], e[N], c2[N];
} sample;

static void sample_fill(sample *s, const eos_model *model)
{
    memset(s, 0, sizeof *s);
    s->model = model;
    assert_true(model->param_size <= sizeof s->par);
    int n_pressures = 0;
    for (size_t k = 0; k < model->n_params; k++) {
        const double x = sample_parameter(&model->params[k], &n_pressures);
        check_true(param_in_range(&model->params[k], x));
        for (int j = 0; j < abs(model->params[k].count); j++) s->par[model->params[k].offset / sizeof(double) + j] = x;
    }
    check_true(!model->check || !model->check(s->par));
    const double floor_p = model->pressure_floor(s->par), scale = fmax(fabs(floor_p), 1e9);
    for (int i = 0; i < N; i++) {
        s->p[i] = floor_p + scale * pressures[i % N_P];
        s->T[i] = temperatures[i / N_P];
    }
    model->volume(s->par, N, s->p, s->T, s->v, s->dvdp);
    for (int i = 0; i < N; i++) s->rho[i] = 1.0 / s->v[i];
    model->energy(s->par, N, s->rho, s->T, s->e);
    double p[N];
    model->pressure(s->par, N, s->rho, s->e, p, s->c2);
}

static void on_each(void (*check)(const sample *))
{
    check_true(eos_registry_size > 0);
    for (size_t i = 0; i < eos_registry_size; i++) {
        sample s;
        sample_fill(&s, eos_registry[i]);
        check(&s);
    }
}

static double pressure_at(const sample *s, double rho, double e)
{
    double p, c2;
    s->model->pressure(s->par, 1, &rho, &e, &p, &c2);
    return p;
}

/* p(1/v(p, T), e(1/v, T)) = p. Round-off of rho alone moves p by eps rho dp/drho <= eps rho c2. */
static void check_inverse(const sample *s)
{
    for (int i = 0; i < N; i++)
        check_close(pressure_at(s, s->rho[i], s->e[i]), s->p[i], 1e-14 * (fabs(s->p[i]) + s->rho[i] * s->c2[i]));
}

static void check_signs(const sample *s)
{
    for (int i = 0; i < N; i++) {
        check_true(s->v[i] > 0.0);
        check_true(s->dvdp[i] < 0.0);
        check_true(s->c2[i] > 0.0);
        check_true(s->e[i] > s->model->energy_floor(s->par, s->rho[i]));
        check_true(s->p[i] > s->model->pressure_floor(s->par));
    }
}

static void check_temperature(const sample *s)
{
    double T[N];
    s->model->temperature(s->par, N, s->rho, s->e, T);
    for (int i = 0; i < N; i++) check_close_relative(T[i], s->T[i], 1e-13 * (1.0 + s->e[i] / (900.0 * s->T[i])));
}

/* A law that ends at a density says so in c2, p and the energy floor there and beyond: no step may go on with such a state. */
static void check_density_limit(const sample *s)
{
    if (!s->model->density_limit) return;
    const double limit = s->model->density_limit(s->par), beyond[] = {limit * (1.0 + 1e-12), 1.1 * limit, 10.0 * limit};
    for (int i = 0; i < N; i++) check_true(s->rho[i] < limit);
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond && isfinite(limit); i++) {
        double p, c2;
        s->model->pressure(s->par, 1, &beyond[i], &s->e[0], &p, &c2);
        check_true(isnan(p) && isnan(c2) && isnan(s->model->energy_floor(s->par, beyond[i])));
    }
}

/* Down to T = 0 the squared sound speed stays positive, from a thousandth of the sample's least density to 0.9 of the law's end. */
static void check_cold(const sample *s)
{
    enum { STATES = 200 };
    double least = s->rho[0], most = s->rho[0];
    for (int i = 0; i < N; i++) {
        least = fmin(least, s->rho[i]);
        most = fmax(most, s->rho[i]);
    }
    least *= 1e-3;
    most = s->model->density_limit ? fmin(2.0 * most, 0.9 * s->model->density_limit(s->par)) : 2.0 * most;
    for (int i = 0; i <= STATES; i++) {
        const double rho = least * pow(most / least, (double)i / STATES), T = 0.01;
        double e, p, c2;
        s->model->energy(s->par, 1, &rho, &T, &e);
        s->model->pressure(s->par, 1, &rho, &e, &p, &c2);
        check_true(c2 > 0.0);
        check_true(e >= s->model->energy_floor(s->par, rho));
    }
}

/* Central differences of relative step 1e-5: error 1e-10 of the third derivative's size plus round-off 1e-11 of
 * the largest term, so 1e-6 holds with a wide margin and catches any wrong term. */
static const double STEP = 1e-5, SLOPE_TOL = 1e-6;

static void check_volume_slope(const sample *s)
{
    const double floor_p = s->model->pressure_floor(s->par);
    for (int i = 0; i < N; i++) {
        const double dp = STEP * (s->p[i] - floor_p), p[2] = {s->p[i] - dp, s->p[i] + dp}, T[2] = {s->T[i], s->T[i]};
        double v[2], unused[2];
        s->model->volume(s->par, 2, p, T, v, unused);
        check_close_relative((v[1] - v[0]) / (p[1] - p[0]), s->dvdp[i], SLOPE_TOL);
    }
}

static double dpde_at(const sample *s, int i)
{
    double dpde;
    s->model->dpde(s->par, 1, &s->rho[i], &s->e[i], &dpde);
    return dpde;
}

static void check_energy_slope(const sample *s)
{
    for (int i = 0; i < N; i++) {
        const double de = STEP * s->e[i];
        const double slope =
            (pressure_at(s, s->rho[i], s->e[i] + de) - pressure_at(s, s->rho[i], s->e[i] - de)) / (2.0 * de);
        check_close(slope, dpde_at(s, i), SLOPE_TOL * fmax(s->rho[i] * s->c2[i] / s->e[i], fabs(dpde_at(s, i))));
    }
}

/* c2 = (dp/drho)_e + (dp/de)_rho p / rho^2. */
static void check_sound_speed(const sample *s)
{
    for (int i = 0; i < N; i++) {
        const double d = STEP * s->rho[i];
        const double drho =
            (pressure_at(s, s->rho[i] + d, s->e[i]) - pressure_at(s, s->rho[i] - d, s->e[i])) / (2.0 * d);
        const double c2 = drho + dpde_at(s, i) * s->p[i] / (s->rho[i] * s->rho[i]);
        check_close(c2, s->c2[i], SLOPE_TOL * fmax(s->c2[i], fabs(drho)));
    }
}

/* cv = (de/dT)_v and alpha = (dv/dT)_p / v; and the identity that ties them to the rest:
 * c2 rho^2 (-dv/dp) = 1 + alpha^2 T c_T^2 / c_v with c_T^2 = -v^2 / (dv/dp), the isothermal speed squared. */
static void check_heat(const sample *s)
{
    double cv[N], alpha[N];
    s->model->heat(s->par, N, s->rho, s->e, cv, alpha);
    for (int i = 0; i < N; i++) {
        const double dT = STEP * s->T[i], T[2] = {s->T[i] - dT, s->T[i] + dT}, rho[2] = {s->rho[i], s->rho[i]};
        const double p[2] = {s->p[i], s->p[i]};
        double e[2], v[2], unused[2];
        s->model->energy(s->par, 2, rho, T, e);
        s->model->volume(s->par, 2, p, T, v, unused);
        const double noise = 1e-10 * s->e[i] / s->T[i];
        check_close((e[1] - e[0]) / (2.0 * dT), cv[i], SLOPE_TOL * cv[i] + noise);
        check_close((v[1] - v[0]) / (2.0 * dT * s->v[i]), alpha[i], SLOPE_TOL * fmax(alpha[i], 1e-4 / s->T[i]));
        const double c2_isothermal = -s->v[i] * s->v[i] / s->dvdp[i];
        check_close_relative(s->c2[i], c2_isothermal * (1.0 + alpha[i] * alpha[i] * s->T[i] * c2_isothermal / cv[i]),
                             1e-9);
    }
}

/* A state alone gives the bits that it gives in a batch. */
static void check_batches(const sample *s)
{
    double p[N], c2[N];
    s->model->pressure(s->par, N, s->rho, s->e, p, c2);
    for (int i = 0; i < N; i++) {
        double v, dvdp;
        check_close(pressure_at(s, s->rho[i], s->e[i]), p[i], 0.0);
        s->model->volume(s->par, 1, &s->p[i], &s->T[i], &v, &dvdp);
        check_close(v, s->v[i], 0.0);
        check_close(dvdp, s->dvdp[i], 0.0);
    }
    s->model->pressure(s->par, 0, NULL, NULL, NULL, NULL);
}

static void check_description(const sample *s)
{
    check_true(eos_find(s->model->name) == s->model);
    check_true(s->model->doc[0] != '\0' && s->model->cite[0] != '\0');
    for (size_t k = 0; k < s->model->n_params; k++) check_true(s->model->params[k].doc[0] != '\0');
}

#define ON_EACH(check)                     \
    static void test_##check(void **state) \
    {                                      \
        (void)state;                       \
        on_each(check_##check);            \
    }
ON_EACH(description)
ON_EACH(signs)
ON_EACH(inverse)
ON_EACH(temperature)
ON_EACH(density_limit)
ON_EACH(cold)
ON_EACH(volume_slope)
ON_EACH(energy_slope)
ON_EACH(sound_speed)
ON_EACH(heat)
ON_EACH(batches)

static void test_unknown_name(void **state)
{
    (void)state;
    check_true(eos_find("no such model") == NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_description),  cmocka_unit_test(test_signs),         cmocka_unit_test(test_inverse),
        cmocka_unit_test(test_temperature),  cmocka_unit_test(test_volume_slope),  cmocka_unit_test(test_energy_slope),
        cmocka_unit_test(test_sound_speed),  cmocka_unit_test(test_heat),          cmocka_unit_test(test_batches),
        cmocka_unit_test(test_unknown_name), cmocka_unit_test(test_density_limit), cmocka_unit_test(test_cold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Sedov's blast against published constants and its own shock, Noh's problem against its jump. */
#include "check.h"
#include "exact_values.h"

#include "verify/exact.h"

#include <math.h>
#include <stdlib.h>

/* With parameters by key; ends in NULL. */
static exact solution_of(context *ctx, const char *name, int dim, const char *const *key, const double *value,
                         void **par)
{
    const exact_model *model = exact_find(name);
    assert_non_null(model);
    *par = calloc(1, model->param_size);
    exact_fill_defaults(model, *par);
    for (int i = 0; key[i]; i++) *exact_param(model, *par, key[i]) = value[i];
    exact out;
    check_ok(ctx, exact_create(ctx, model, *par, dim, &out));
    return out;
}

/* The balances of a self-similar flow in l = r/r_shock, u = D V(l), rho = rho_0 R(l), p = rho_0 D^2 P(l), integrated inwards from the
 * shock; y[3] gathers the energy. What the closed form does not know. */
typedef struct similarity {
    double j, gamma;
} similarity;

static void similarity_rate(const similarity *q, double l, const double *y, double *rate)
{
    const double a = y[1] - l, decay = -0.5 * q->j, spread = (q->j - 1.0) * y[1] / l;
    const double dV =
        (a * y[0] * decay * y[1] - q->gamma * y[2] * spread - 2.0 * decay * y[2]) / (q->gamma * y[2] - a * a * y[0]);
    rate[0] = -y[0] * (dV + spread) / a;
    rate[1] = dV;
    rate[2] = -y[0] * (a * dV + decay * y[1]);
    rate[3] = (0.5 * y[0] * y[1] * y[1] + y[2] / (q->gamma - 1.0)) * pow(l, q->j - 1.0);
}

static double alpha_by_integration(double j, double gamma)
{
    enum { STEPS = 40000 };
    static const double surface[3] = {2.0, 2.0 * 3.14159265358979323846, 4.0 * 3.14159265358979323846};
    const similarity q = {j, gamma};
    const double h = -1.0 / STEPS;
    double y[4] = {(gamma + 1.0) / (gamma - 1.0), 2.0 / (gamma + 1.0), 2.0 / (gamma + 1.0), 0.0}, l = 1.0;
    for (int i = 0; i < STEPS - 20; i++, l += h) { /* Runge and Kutta's fourth order */
        double k[4][4], at[4];
        for (int stage = 0; stage < 4; stage++) {
            const double c = stage == 0 ? 0.0 : stage == 3 ? 1.0 : 0.5;
            for (int m = 0; m < 4; m++) at[m] = y[m] + (stage > 0 ? c * h * k[stage - 1][m] : 0.0);
            similarity_rate(&q, l + c * h, at, k[stage]);
        }
        for (int m = 0; m < 4; m++) y[m] += h / 6.0 * (k[0][m] + 2.0 * k[1][m] + 2.0 * k[2][m] + k[3][m]);
    }
    const double integral = y[2] / (gamma - 1.0) * pow(l, j) / j - y[3]; /* the rest has the centre's pressure */
    return surface[(int)j - 1] * 4.0 / ((j + 2.0) * (j + 2.0)) * integral;
}

/* Kamm & Timmes 2007: energies that put the shock at 0.5, 0.75 and 1 at t = 1 for gamma = 1.4; that of the plane is of one side, and off
 * by 4e-4 from what both the closed form and the integration give, that of the line by 3e-5. */
static void sedov_published(void **state)
{
    (void)state;
    static const double energy[3] = {2.0 * 0.0673185, 0.311357, 0.851072}, shock[3] = {0.5, 0.75, 1.0};
    static const double off[3] = {1.3e-4, 1e-5, 2e-7};
    context *ctx = context_create();
    for (int geometry = 0; geometry < 3; geometry++) {
        void *par;
        exact s = solution_of(ctx, "sedov", geometry + 1, (const char *const[]){"energy", "geometry", NULL},
                              (const double[]){energy[geometry], geometry}, &par);
        check_close_relative(exact_scalar_value(&s, "shock", 1.0), shock[geometry], off[geometry]);
        check_close_relative(exact_scalar_value(&s, "alpha", 1.0), alpha_by_integration(geometry + 1.0, 1.4), 1e-7);
        exact_destroy(ctx, &s);
        free(par);
    }
    context_destroy(&ctx);
}

/* Just inside the shock the jump conditions of a shock without pressure ahead hold; the age moves the clock. */
static void sedov_shock(void **state)
{
    (void)state;
    context *ctx = context_create();
    void *par;
    exact s = solution_of(ctx, "sedov", 3, (const char *const[]){"energy", "geometry", "gamma", "start", NULL},
                          (const double[]){2.0, 2.0, 1.3, 0.25}, &par);
    const double D = exact_scalar_value(&s, "shock_speed", 0.5),
                 r = exact_scalar_value(&s, "shock", 0.5) * (1.0 - 1e-12);
    const double x[3] = {r / sqrt(3.0), r / sqrt(3.0), r / sqrt(3.0)};
    check_close_relative(exact_value(&s, EXACT_DENSITY, x, 0.5), 2.3 / 0.3, 1e-9);
    check_close_relative(exact_value(&s, EXACT_PRESSURE, x, 0.5), 2.0 / 2.3 * D * D, 1e-9);
    check_close_relative(sqrt(3.0) * exact_value(&s, EXACT_VELOCITY_Y, x, 0.5), 2.0 / 2.3 * D, 1e-9);
    exact_destroy(ctx, &s);
    free(par);
    context_destroy(&ctx);
}

/* gamma = 5/3: 4, 16 and 64 times the density, behind a shock at t/3. */
static void noh_inside(void **state)
{
    (void)state;
    static const double inner[3] = {4.0, 16.0, 64.0};
    context *ctx = context_create();
    for (int geometry = 0; geometry < 3; geometry++) {
        void *par;
        exact s = solution_of(ctx, "noh", geometry + 1, (const char *const[]){"geometry", NULL},
                              (const double[]){geometry}, &par);
        const double inside[3] = {0.19, 0.0, 0.0}, outside[3] = {0.21, 0.0, 0.0};
        check_close_relative(exact_value(&s, EXACT_DENSITY, inside, 0.6), inner[geometry], 1e-14);
        check_close_relative(exact_value(&s, EXACT_PRESSURE, inside, 0.6), inner[geometry] / 3.0, 1e-14);
        check_close_relative(exact_value(&s, EXACT_DENSITY, outside, 0.6), pow(1.0 + 0.6 / 0.21, geometry), 1e-14);
        check_close(exact_scalar_value(&s, "shock", 0.6), 0.2, 1e-15);
        exact_destroy(ctx, &s);
        free(par);
    }
    context_destroy(&ctx);
}

static void refused(void **state)
{
    (void)state;
    context *ctx = context_create();
    const exact_model *model = exact_find("noh");
    void *par = calloc(1, model->param_size);
    exact_fill_defaults(model, par);
    *exact_param(model, par, "geometry") = 1.0;
    exact out;
    check_true(exact_create(ctx, model, par, 1, &out) == FLOE_BAD_INPUT);
    context_clear(ctx);
    *exact_param(model, par, "axes") = 3.0;
    check_true(exact_create(ctx, model, par, 2, &out) == FLOE_BAD_INPUT);
    free(par);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sedov_published),
        cmocka_unit_test(sedov_shock),
        cmocka_unit_test(noh_inside),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Small plane waves of a viscous, heat-conducting ideal gas at rest: damped sound, or heat that diffuses at constant
 * pressure. */
#include "verify/verify_internal.h"

#include <complex.h>
#include <gsl/gsl_poly.h>
#include <string.h>

typedef struct wave_par {
    double density, pressure, gamma, heat_capacity, viscosity, bulk_viscosity, conductivity;
    double amplitude, wavelength, thermal, axis;
} wave_par;

static const param_spec wave_params[] = {
    PAR_POSITIVE(wave_par, density, "kg/m3", NAN, "density of the gas at rest"),
    PAR_POSITIVE(wave_par, pressure, "Pa", NAN, "pressure of the gas at rest"),
    PAR_BETWEEN(wave_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_POSITIVE(wave_par, heat_capacity, "J/kg/K", NAN, "c_v"),
    PAR_NONNEGATIVE(wave_par, viscosity, "Pa s", 0.0, "dynamic viscosity"),
    PAR_NONNEGATIVE(wave_par, bulk_viscosity, "Pa s", 0.0, "bulk viscosity"),
    PAR_NONNEGATIVE(wave_par, conductivity, "W/m/K", 0.0, "thermal conductivity"),
    PAR_ANY(wave_par, amplitude, "1", NAN,
            "of the velocity over the speed of sound, or of the temperature over its mean"),
    PAR_POSITIVE(wave_par, wavelength, "m", 1.0, "wavelength"),
    PAR_BETWEEN(wave_par, thermal, "1", 0.0, 1.0, 0.0, "0: sound that runs up the axis; 1: the heat that stays"),
    PAR_BETWEEN(wave_par, axis, "1", 0.0, 2.0, 0.0, "the axis along which the wave varies: 0, 1 or 2"),
};

/* CMPLX of C11, which clang does not find in the C library's header. */
static double complex complex_of(double real, double imaginary)
{
    const double part[2] = {real, imaginary};
    double complex z;
    memcpy(&z, part, sizeof z);
    return z;
}

/* Amplitudes of exp(i k x + s t). */
typedef struct wave_constants {
    double k, T0;
    double complex s, density, velocity, temperature;
} wave_constants;

/* The roots of (s rho + nu k2) s (s rho c_v + kappa k2) + k2 [p (s rho c_v + kappa k2) + R rho p s] = 0: one is real
 * (heat), two are sound; the wave up the axis has a negative imaginary part. Solved for s over k (p/rho)^1/2, so that
 * no unit is in it. */
static double complex wave_rate(const wave_par *p, double k2)
{
    const double nu = (4.0 / 3.0 * p->viscosity + p->bulk_viscosity) * k2, kappa = p->conductivity * k2;
    const double R = (p->gamma - 1.0) * p->heat_capacity, rate = sqrt(k2 * p->pressure / p->density);
    const double viscous = nu / (p->density * rate), thermal = kappa / (p->density * p->heat_capacity * rate);
    gsl_complex z[3];
    gsl_poly_complex_solve_cubic(thermal + viscous, viscous * thermal + 1.0 + R / p->heat_capacity, thermal, &z[0],
                                 &z[1], &z[2]);
    int chosen = 0;
    for (int i = 1; i < 3; i++) {
        const bool better = whole_number(p->thermal) == 1 ? fabs(GSL_IMAG(z[i])) < fabs(GSL_IMAG(z[chosen]))
                                                          : GSL_IMAG(z[i]) < GSL_IMAG(z[chosen]);
        if (better) chosen = i;
    }
    return complex_of(rate * GSL_REAL(z[chosen]), rate * GSL_IMAG(z[chosen]));
}

static floe_status damped_wave_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const wave_par *p = par;
    wave_constants *c = prepared;
    TRY(check_axis(ctx, p->axis, dim));
    TRY(check_whole(ctx, "thermal", p->thermal));
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    const bool thermal = whole_number(p->thermal) == 1;
    if (thermal && !(p->conductivity > 0.0))
        return fail_key(ctx, KEY("conductivity"), "%g W/m/K: heat does not diffuse without one", p->conductivity);
    c->k = 2.0 * VERIFY_PI / p->wavelength;
    c->T0 = p->pressure / ((p->gamma - 1.0) * p->heat_capacity * p->density);
    c->s = wave_rate(p, c->k * c->k);
    /* From the velocity 1: s rho' = -rho i k, (s rho c_v + kappa k2) T' = -p i k. */
    c->density = complex_of(0.0, -p->density * c->k) / c->s;
    c->temperature =
        complex_of(0.0, -p->pressure * c->k) / (c->s * p->density * p->heat_capacity + p->conductivity * c->k * c->k);
    const double complex scale =
        thermal ? p->amplitude * c->T0 / c->temperature : p->amplitude * sqrt(p->gamma * p->pressure / p->density);
    c->velocity = scale;
    c->density *= scale;
    c->temperature *= scale;
    return FLOE_OK;
}

static double damped_wave_value(const void *par, const void *prepared, exact_quantity quantity, int dim,
                                const double x[3], double t)
{
    (void)dim;
    const wave_par *p = par;
    const wave_constants *c = prepared;
    const int axis = whole_number(p->axis);
    const double complex phase = cexp(complex_of(0.0, c->k * x[axis]) + c->s * t);
    const double density = creal(c->density * phase), temperature = creal(c->temperature * phase);
    if (is_velocity(quantity)) return component_along(quantity, EXACT_VELOCITY_X, axis, creal(c->velocity * phase));
    switch (quantity) {
    case EXACT_DENSITY: return p->density + density;
    case EXACT_PRESSURE: return p->pressure * (1.0 + density / p->density + temperature / c->T0);
    case EXACT_TEMPERATURE: return c->T0 + temperature;
    case EXACT_INTERNAL_ENERGY: return p->heat_capacity * (c->T0 + temperature);
    default: return NAN;
    }
}

static const exact_scalar wave_scalars[] = {
    {"decay", "1/s", "rate at which the wave decays"},
    {"omega", "rad/s", "angular frequency"},
};

static double damped_wave_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)t;
    const wave_constants *c = prepared;
    return i == 0 ? -creal(c->s) : fabs(cimag(c->s));
}

static const wave_par sample_par = {.density = 1.4,
                                    .pressure = 1.0,
                                    .gamma = 1.4,
                                    .heat_capacity = 2.5,
                                    .viscosity = 0.05,
                                    .bulk_viscosity = 0.01,
                                    .conductivity = 0.2,
                                    .amplitude = 2e-8,
                                    .wavelength = 1.0};

const exact_model exact_damped_wave = {
    .name = "damped_wave",
    .doc = "small plane wave in a viscous, heat-conducting ideal gas: damped sound, or diffusing heat",
    .cite = "Landau & Lifshitz, Fluid Mechanics, 2nd ed. (1987), section 79; Kirchhoff 1868",
    .validity = "linear in the amplitude: error of the order of its square. Periodic along the axis.",
    .equations = EXACT_NAVIER_STOKES,
    .param_size = sizeof(wave_par),
    .params = wave_params,
    .n_params = COUNT_OF(wave_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .scalars = wave_scalars,
    .n_scalars = COUNT_OF(wave_scalars),
    .sample = {.par = &sample_par, .dim = 1, .lo = {0.0}, .hi = {1.0}, .t = 0.5},
    .prepared_size = sizeof(wave_constants),
    .prepare = damped_wave_prepare,
    .value = damped_wave_value,
    .scalar = damped_wave_scalar,
};

/* d'Alembert's solution of linear acoustics on a uniform stream. */
#include "verify/verify_internal.h"

typedef struct pulse_par {
    double density, sound_speed, pressure, velocity;
    double amplitude, left_amplitude;
    double centre, width, period, sine, axis;
} pulse_par;

static const param_spec pulse_params[] = {
    PAR_POSITIVE(pulse_par, density, "kg/m3", NAN, "density of the stream"),
    PAR_POSITIVE(pulse_par, sound_speed, "m/s", NAN, "sound speed of the stream"),
    PAR_ANY(pulse_par, pressure, "Pa", NAN, "pressure of the stream"),
    PAR_ANY(pulse_par, velocity, "m/s", 0.0, "velocity of the stream, along the axis"),
    PAR_ANY(pulse_par, amplitude, "Pa", NAN, "pressure amplitude of the wave that runs up the axis"),
    PAR_ANY(pulse_par, left_amplitude, "Pa", 0.0,
            "pressure amplitude of the wave that runs down the axis; equal amplitudes start with no extra velocity"),
    PAR_ANY(pulse_par, centre, "m", 0.0, "centre of the pulse at t = 0"),
    PAR_POSITIVE(pulse_par, width, "m", NAN, "standard deviation of the Gaussian, or the sine's wavelength"),
    PAR_NONNEGATIVE(pulse_par, period, "m", 0.0, "period of the domain; 0: not periodic"),
    PAR_BETWEEN(pulse_par, sine, "1", 0.0, 1.0, 0.0, "0: a Gaussian; 1: a sine wave"),
    PAR_BETWEEN(pulse_par, axis, "1", 0.0, 2.0, 0.0, "the axis along which the waves run: 0, 1 or 2"),
};

static profile pulse_profile(const pulse_par *p)
{
    return (profile){.sine = whole_number(p->sine) == 1, .centre = p->centre, .width = p->width, .period = p->period};
}

static floe_status pulse_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    const pulse_par *p = par;
    TRY(check_whole(ctx, "sine", p->sine));
    TRY(check_axis(ctx, p->axis, dim));
    const profile shape = pulse_profile(p);
    return profile_check(ctx, &shape);
}

static double pulse_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                          double t)
{
    (void)prepared;
    (void)dim;
    const pulse_par *p = par;
    const profile shape = pulse_profile(p);
    const double at = x[whole_number(p->axis)] - p->velocity * t;
    const double up = p->amplitude * profile_value(&shape, at - p->sound_speed * t);
    const double down =
        p->left_amplitude != 0.0 ? p->left_amplitude * profile_value(&shape, at + p->sound_speed * t) : 0.0;
    if (is_velocity(quantity)) {
        const double velocity = p->velocity + (up - down) / (p->density * p->sound_speed);
        return component_along(quantity, EXACT_VELOCITY_X, whole_number(p->axis), velocity);
    }
    if (quantity == EXACT_PRESSURE) return p->pressure + up + down;
    if (quantity == EXACT_DENSITY) return p->density + (up + down) / (p->sound_speed * p->sound_speed);
    return NAN;
}

static const pulse_par sample_par = {.density = 1.2,
                                     .sound_speed = 340.0,
                                     .pressure = 1e5,
                                     .velocity = 30.0,
                                     .amplitude = 1.0,
                                     .left_amplitude = 0.5,
                                     .centre = 0.5,
                                     .width = 0.1,
                                     .period = 1.0};

const exact_model exact_acoustic_pulse = {
    .name = "acoustic_pulse",
    .doc = "plane sound waves of small amplitude on a uniform stream",
    .cite = "Landau & Lifshitz, Fluid Mechanics, 2nd ed. (1987), sections 64 and 68",
    .validity =
        "linear, inviscid acoustics: for an amplitude a the error against a gas is of the order of a^2 t / (rho "
        "c^2 width), which is a floor for any measured order; exact_simple_wave has none. A Gaussian on a period "
        "sums its images.",
    .equations = EXACT_LINEAR_ACOUSTICS,
    .param_size = sizeof(pulse_par),
    .params = pulse_params,
    .n_params = COUNT_OF(pulse_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_BIT(EXACT_DENSITY) | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE),
    .sample = {.par = &sample_par, .dim = 1, .lo = {0.0}, .hi = {1.0}, .t = 3e-4},
    .prepare = pulse_prepare,
    .value = pulse_value,
};

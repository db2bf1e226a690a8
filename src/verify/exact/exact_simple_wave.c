/* The simple wave of an ideal gas: an exact nonlinear sound wave, up to the time at which it breaks. */
#include "verify/verify_internal.h"

typedef struct wave_par {
    double density, pressure, gamma, velocity, heat_capacity;
    double amplitude, centre, width, period, sine, axis;
} wave_par;

static const param_spec wave_params[] = {
    PAR_POSITIVE(wave_par, density, "kg/m3", NAN, "density of the undisturbed gas"),
    PAR_POSITIVE(wave_par, pressure, "Pa", NAN, "pressure of the undisturbed gas"),
    PAR_BETWEEN(wave_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_ANY(wave_par, velocity, "m/s", 0.0, "velocity of the undisturbed gas, along the axis"),
    PAR_NONNEGATIVE(wave_par, heat_capacity, "J/kg/K", 0.0, "c_v; 0: no temperature is given"),
    PAR_ANY(wave_par, amplitude, "m/s", NAN, "velocity amplitude of the wave, which runs up the axis"),
    PAR_ANY(wave_par, centre, "m", 0.0, "centre of the wave at t = 0"),
    PAR_POSITIVE(wave_par, width, "m", NAN, "standard deviation of the Gaussian, or the sine's wavelength"),
    PAR_NONNEGATIVE(wave_par, period, "m", 0.0, "period of the domain; 0: not periodic"),
    PAR_BETWEEN(wave_par, sine, "1", 0.0, 1.0, 0.0, "0: a Gaussian; 1: a sine wave"),
    PAR_BETWEEN(wave_par, axis, "1", 0.0, 2.0, 0.0, "the axis along which the wave runs: 0, 1 or 2"),
};

typedef struct wave_constants {
    profile shape;
    double sound;      /* m/s: of the undisturbed gas */
    double break_time; /* s: when the steepest characteristics meet */
} wave_constants;

static floe_status simple_wave_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const wave_par *p = par;
    wave_constants *c = prepared;
    TRY(check_whole(ctx, "sine", p->sine));
    TRY(check_axis(ctx, p->axis, dim));
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    c->shape =
        (profile){.sine = whole_number(p->sine) == 1, .centre = p->centre, .width = p->width, .period = p->period};
    c->sound = sqrt(p->gamma * p->pressure / p->density);
    const double steepest = 0.5 * (p->gamma + 1.0) * fabs(p->amplitude) * profile_largest_slope(&c->shape);
    c->break_time = steepest > 0.0 ? 1.0 / steepest : (double)INFINITY;
    TRY(profile_check(ctx, &c->shape));
    return simple_wave_check(ctx, "amplitude", p->amplitude, c->sound, p->gamma);
}

typedef struct characteristic {
    const wave_par *par;
    const wave_constants *constants;
    double at, t;
} characteristic;

/* Where the characteristic from `start` is at t, less where it is wanted; increasing before the break. */
static double characteristic_miss(double start, void *user)
{
    const characteristic *c = user;
    const double disturbance = c->par->amplitude * profile_value(&c->constants->shape, start);
    const double speed = c->par->velocity + c->constants->sound + 0.5 * (c->par->gamma + 1.0) * disturbance;
    return start + speed * c->t - c->at;
}

/* The disturbance of the velocity at x and t. */
static double disturbance_at(const wave_par *p, const wave_constants *c, double x, double t)
{
    if (!(t < c->break_time)) return NAN;
    characteristic problem = {p, c, x, t};
    const double guess = x - (p->velocity + c->sound) * t;
    /* |profile| is at most 1, and a little more where a Gaussian's images add. */
    const double reach = (0.505 * (p->gamma + 1.0) * fabs(p->amplitude)) * fabs(t) + 1e-9 * c->shape.width;
    const double start = find_root(characteristic_miss, &problem, guess - reach, guess + reach);
    return p->amplitude * profile_value(&c->shape, start);
}

static double simple_wave_quantity(const void *par, const void *prepared, exact_quantity quantity, int dim,
                                   const double x[3], double t)
{
    (void)dim;
    const wave_par *p = par;
    const wave_constants *c = prepared;
    const int axis = whole_number(p->axis);
    if (is_velocity(quantity) && (int)quantity - EXACT_VELOCITY_X != axis) return 0.0;
    const double disturbance = disturbance_at(p, c, x[axis], t);
    const double ratio = 1.0 + 0.5 * (p->gamma - 1.0) * disturbance / c->sound; /* of sound speeds */
    if (is_velocity(quantity)) return p->velocity + disturbance;
    return simple_wave_value(quantity, p->density, p->pressure, p->gamma, p->heat_capacity, ratio);
}

static const exact_scalar wave_scalars[] = {
    {"break_time", "s", "time at which the wave breaks; no value is given from then on"},
};

static double simple_wave_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)i;
    (void)t;
    const wave_constants *c = prepared;
    return c->break_time;
}

static const wave_par sample_par = {.density = 1.4,
                                    .pressure = 1.0,
                                    .gamma = 1.4,
                                    .velocity = 0.3,
                                    .heat_capacity = 2.5,
                                    .amplitude = 0.1,
                                    .centre = 0.5,
                                    .width = 1.0,
                                    .period = 1.0,
                                    .sine = 1.0};

const exact_model exact_simple_wave = {
    .name = "simple_wave",
    .doc = "nonlinear plane sound wave of an ideal gas, before it breaks",
    .cite = "Landau & Lifshitz, Fluid Mechanics, 2nd ed. (1987), section 101",
    .validity =
        "inviscid, isentropic ideal gas; t below break_time = 2/((gamma + 1) |amplitude| max |f'|), NaN from then "
        "on. A Gaussian on a period sums its images.",
    .equations = EXACT_EULER,
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
    .prepare = simple_wave_prepare,
    .value = simple_wave_quantity,
    .scalar = simple_wave_scalar,
};

/* The simple wave that a moving piston, or a side that imposes a velocity, sends into an ideal gas at rest. */
#include "math/swing.h"
#include "verify/verify_internal.h"

typedef struct wave_par {
    double density, pressure, gamma, heat_capacity, speed, start, ramp, frequency, origin, moving, axis;
} wave_par;

static const param_spec wave_params[] = {
    PAR_POSITIVE(wave_par, density, "kg/m3", NAN, "density of the gas at rest"),
    PAR_POSITIVE(wave_par, pressure, "Pa", NAN, "pressure of the gas at rest"),
    PAR_BETWEEN(wave_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_NONNEGATIVE(wave_par, heat_capacity, "J/kg/K", 0.0, "c_v; 0: no temperature is given"),
    PAR_ANY(wave_par, speed, "m/s", NAN, "velocity reached, up the axis into the gas; negative: the piston recedes"),
    PAR_NONNEGATIVE(wave_par, start, "s", 0.0, "the motion begins"),
    PAR_POSITIVE(wave_par, ramp, "s", NAN, "time in which the velocity is reached, along half a cosine"),
    PAR_NONNEGATIVE(wave_par, frequency, "Hz", 0.0, "the velocity swings with a sine; 0: it does not"),
    PAR_ANY(wave_par, origin, "m", 0.0, "where the piston starts, or the side"),
    PAR_BETWEEN(wave_par, moving, "1", 0.0, 1.0, 1.0,
                "1: a piston, which moves; 0: a side, where gas enters or leaves"),
    PAR_BETWEEN(wave_par, axis, "1", 0.0, 2.0, 0.0, "the axis: 0, 1 or 2"),
};

typedef struct wave_constants {
    swing law;
    double sound; /* m/s: of the gas at rest */
} wave_constants;

static floe_status piston_wave_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const wave_par *p = par;
    wave_constants *c = prepared;
    TRY(check_axis(ctx, p->axis, dim));
    TRY(check_whole(ctx, "moving", p->moving));
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    if (whole_number(p->moving) == 1 && p->frequency > 0.0)
        return fail_key(ctx, KEY("frequency"), "%g Hz: a piston that moves only goes one way here", p->frequency);
    *c = (wave_constants){.law = {p->start, p->ramp, p->frequency}, .sound = sqrt(p->gamma * p->pressure / p->density)};
    return simple_wave_check(ctx, "speed", p->speed, c->sound, p->gamma);
}

/* Where the piston is: the integral of its velocity. */
static double piston_position(const wave_par *p, double t)
{
    const double past = t - p->start;
    if (whole_number(p->moving) == 0 || past <= 0.0) return p->origin;
    const double rising = fmin(past, p->ramp), k = VERIFY_PI / p->ramp;
    return p->origin + p->speed * (0.5 * rising - 0.5 * sin(k * rising) / k + fmax(past - p->ramp, 0.0));
}

typedef struct characteristic {
    const wave_par *par;
    const wave_constants *constants;
    double at, t;
} characteristic;

/* How far the characteristic that left the piston at `from` is beyond the place wanted. */
static double characteristic_lead(double from, void *user)
{
    const characteristic *c = user;
    const double u = c->par->speed * swing_at(&c->constants->law, from);
    return piston_position(c->par, from) + (c->constants->sound + 0.5 * (c->par->gamma + 1.0) * u) * (c->t - from) -
           c->at;
}

static double piston_wave_velocity(const wave_par *p, const wave_constants *c, double x, double t)
{
    if (!(t > p->start) || x >= p->origin + c->sound * (t - p->start)) return 0.0;
    if (x < piston_position(p, t)) return NAN;
    characteristic problem = {p, c, x, t};
    const double from = find_root(characteristic_lead, &problem, p->start, t);
    return p->speed * swing_at(&c->law, from);
}

static double piston_wave_value(const void *par, const void *prepared, exact_quantity quantity, int dim,
                                const double x[3], double t)
{
    (void)dim;
    const wave_par *p = par;
    const wave_constants *c = prepared;
    const int axis = whole_number(p->axis);
    const double u = piston_wave_velocity(p, c, x[axis], t), ratio = 1.0 + 0.5 * (p->gamma - 1.0) * u / c->sound;
    if (is_velocity(quantity)) return component_along(quantity, EXACT_VELOCITY_X, axis, u);
    return simple_wave_value(quantity, p->density, p->pressure, p->gamma, p->heat_capacity, ratio);
}

static const wave_par sample_par = {
    .density = 1.4, .pressure = 1.0, .gamma = 1.4, .heat_capacity = 2.5, .speed = -0.2, .ramp = 2.0, .moving = 1.0};

const exact_model exact_piston_wave = {
    .name = "piston_wave",
    .doc = "the simple wave of a piston, or of a side with a velocity, in an ideal gas at rest",
    .cite = "Landau & Lifshitz, Fluid Mechanics, 2nd ed. (1987), section 101",
    .validity = "inviscid ideal gas, up to the time at which the wave breaks; a receding piston's never does.",
    .equations = EXACT_EULER,
    .param_size = sizeof(wave_par),
    .params = wave_params,
    .n_params = COUNT_OF(wave_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .sample = {.par = &sample_par, .dim = 1, .lo = {0.1}, .hi = {0.8}, .t = 1.0},
    .prepared_size = sizeof(wave_constants),
    .prepare = piston_wave_prepare,
    .value = piston_wave_value,
};

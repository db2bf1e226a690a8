/* Two interpenetrating fluids that come to one velocity and one temperature by exchange. */
#include "verify/verify_internal.h"

typedef struct relaxation_par {
    double first_density, first_volume_fraction, first_velocity, first_temperature, first_heat_capacity;
    double second_density, second_volume_fraction, second_velocity, second_temperature, second_heat_capacity;
    double momentum_exchange, heat_exchange, first_heat_share, second_heat_share;
    double material, axis;
} relaxation_par;

static const param_spec relaxation_params[] = {
    PAR_POSITIVE(relaxation_par, first_density, "kg/m3", NAN, "mass of the first material per volume of mixture"),
    PAR_BETWEEN(relaxation_par, first_volume_fraction, "1", 0.0, 1.0, 0.5, "volume fraction of the first material"),
    PAR_ANY(relaxation_par, first_velocity, "m/s", 0.0, "velocity of the first material at t = 0"),
    PAR_NONNEGATIVE(relaxation_par, first_temperature, "K", 0.0, "temperature of the first material at t = 0"),
    PAR_POSITIVE(relaxation_par, first_heat_capacity, "J/kg/K", 1.0, "c_v of the first material"),
    PAR_POSITIVE(relaxation_par, second_density, "kg/m3", NAN, "mass of the second material per volume of mixture"),
    PAR_BETWEEN(relaxation_par, second_volume_fraction, "1", 0.0, 1.0, 0.5, "volume fraction of the second material"),
    PAR_ANY(relaxation_par, second_velocity, "m/s", 0.0, "velocity of the second material at t = 0"),
    PAR_NONNEGATIVE(relaxation_par, second_temperature, "K", 0.0, "temperature of the second material at t = 0"),
    PAR_POSITIVE(relaxation_par, second_heat_capacity, "J/kg/K", 1.0, "c_v of the second material"),
    PAR_NONNEGATIVE(relaxation_par, momentum_exchange, "kg/m3/s", NAN, "K of the force theta1 theta2 K (u2 - u1)"),
    PAR_NONNEGATIVE(relaxation_par, heat_exchange, "W/m3/K", 0.0, "R of the heat theta1 theta2 R (T2 - T1)"),
    PAR_BETWEEN(relaxation_par, first_heat_share, "1", 0.0, 1.0, 0.0,
                "share of the lost kinetic energy that heats the first"),
    PAR_BETWEEN(relaxation_par, second_heat_share, "1", 0.0, 1.0, 0.0, "share that heats the second"),
    PAR_BETWEEN(relaxation_par, material, "1", 1.0, 2.0, 1.0, "the material whose values are given: 1 or 2"),
    PAR_BETWEEN(relaxation_par, axis, "1", 0.0, 2.0, 0.0, "the axis of the velocities: 0, 1 or 2"),
};

static floe_status relaxation_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    const relaxation_par *p = par;
    TRY(check_whole(ctx, "material", p->material));
    TRY(check_axis(ctx, p->axis, dim));
    if (p->first_heat_share + p->second_heat_share <= 1.0) return FLOE_OK;
    return fail_key(ctx, KEY("first_heat_share"), "%g with second_heat_share: must be at most 1",
                    p->first_heat_share + p->second_heat_share);
}

/* 1/tau of the difference of velocities, or of temperatures. */
static double relaxation_rate_of(double exchange, const relaxation_par *p, double first_capacity,
                                 double second_capacity)
{
    return exchange * p->first_volume_fraction * p->second_volume_fraction *
           (1.0 / first_capacity + 1.0 / second_capacity);
}

static double velocity_rate(const relaxation_par *p)
{
    return relaxation_rate_of(p->momentum_exchange, p, p->first_density, p->second_density);
}

static double temperature_rate(const relaxation_par *p)
{
    return relaxation_rate_of(p->heat_exchange, p, p->first_density * p->first_heat_capacity,
                              p->second_density * p->second_heat_capacity);
}

static double relaxation_velocity(const relaxation_par *p, double t)
{
    const double mass = p->first_density + p->second_density;
    const double mean = (p->first_density * p->first_velocity + p->second_density * p->second_velocity) / mass;
    const double difference = (p->first_velocity - p->second_velocity) * exp(-t * velocity_rate(p));
    return whole_number(p->material) == 1 ? mean + p->second_density / mass * difference
                                          : mean - p->first_density / mass * difference;
}

/* The integral of exp(-a s) exp(-b (t - s)) over s from 0 to t, also where a = b. */
static double convolve_exponentials(double a, double b, double t)
{
    const double gap = (a - b) * t;
    const double slow = exp(-fmin(a, b) * t);
    return gap == 0.0 ? t * slow : t * slow * -expm1(-fabs(gap)) / fabs(gap);
}

/* C_r dT_r/dt = +-exchange + share_r q, q = the kinetic energy that drag takes, per volume and time. */
static double temperature_at(const relaxation_par *p, double t)
{
    const double first = p->first_density * p->first_heat_capacity;
    const double second = p->second_density * p->second_heat_capacity;
    const double mass = p->first_density + p->second_density;
    const double slip = p->first_velocity - p->second_velocity;
    const double energy = 0.5 * p->first_density * p->second_density / mass * slip * slip;
    const double drag = 2.0 * velocity_rate(p);
    const double cooling = temperature_rate(p);

    const double heat = (p->first_heat_share + p->second_heat_share) * energy * -expm1(-drag * t);
    const double mean = (first * p->first_temperature + second * p->second_temperature + heat) / (first + second);
    const double drag_work = drag * energy * (p->first_heat_share / first - p->second_heat_share / second);
    const double difference = (p->first_temperature - p->second_temperature) * exp(-cooling * t) +
                              (drag_work != 0.0 ? drag_work * convolve_exponentials(drag, cooling, t) : 0.0);
    return whole_number(p->material) == 1 ? mean + second / (first + second) * difference
                                          : mean - first / (first + second) * difference;
}

static double relaxation_value(const void *par, const void *prepared, exact_quantity quantity, int dim,
                               const double x[3], double t)
{
    (void)prepared;
    (void)dim;
    (void)x;
    const relaxation_par *p = par;
    if (is_velocity(quantity))
        return component_along(quantity, EXACT_VELOCITY_X, whole_number(p->axis), relaxation_velocity(p, t));
    if (quantity == EXACT_TEMPERATURE) return temperature_at(p, t);
    if (quantity == EXACT_DENSITY) return whole_number(p->material) == 1 ? p->first_density : p->second_density;
    if (quantity == EXACT_VOLUME_FRACTION) {
        return whole_number(p->material) == 1 ? p->first_volume_fraction : p->second_volume_fraction;
    }
    return NAN;
}

static const exact_scalar relaxation_scalars[] = {
    {"velocity_time", "s", "relaxation time of the difference of velocities"},
    {"temperature_time", "s", "relaxation time of the difference of temperatures"},
};

static double relaxation_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)prepared;
    (void)t;
    return 1.0 / (i == 0 ? velocity_rate(par) : temperature_rate(par));
}

static const relaxation_par sample_par = {.first_density = 0.6,
                                          .first_volume_fraction = 0.5,
                                          .first_velocity = 10.0,
                                          .first_temperature = 300.0,
                                          .first_heat_capacity = 700.0,
                                          .second_density = 2.0,
                                          .second_volume_fraction = 0.5,
                                          .second_velocity = -5.0,
                                          .second_temperature = 400.0,
                                          .second_heat_capacity = 500.0,
                                          .momentum_exchange = 10.0,
                                          .heat_exchange = 1e4,
                                          .first_heat_share = 0.25,
                                          .second_heat_share = 0.75,
                                          .material = 1.0};

const exact_model exact_relaxation = {
    .name = "relaxation",
    .doc = "two interpenetrating fluids that come to one velocity and temperature",
    .cite = "Guilkey et al. (2003), exchange terms of eqs 2 and 3, for uniform fields",
    .validity = "uniform fields, constant K, R, c_v and volume fractions. The shares say where the kinetic energy that "
                "drag takes is put: 0 and 0 for a scheme that does not return it. A backward Euler step multiplies the "
                "difference by 1/(1 + dt/tau), not by exp(-dt/tau).",
    .equations = EXACT_ORDINARY,
    .param_size = sizeof(relaxation_par),
    .params = relaxation_params,
    .n_params = COUNT_OF(relaxation_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides =
        EXACT_BIT(EXACT_DENSITY) | EXACT_VELOCITIES | EXACT_BIT(EXACT_TEMPERATURE) | EXACT_BIT(EXACT_VOLUME_FRACTION),
    .scalars = relaxation_scalars,
    .n_scalars = COUNT_OF(relaxation_scalars),
    .sample = {.par = &sample_par, .dim = 1, .lo = {0.0}, .hi = {1.0}, .t = 0.1},
    .prepare = relaxation_prepare,
    .value = relaxation_value,
    .scalar = relaxation_scalar,
};

/* Flow of an ideal gas between plates of given temperatures, one of them moving, heated by its own shear. */
#include "verify/verify_internal.h"

typedef struct hot_par {
    double height, speed, pressure, gamma, heat_capacity, viscosity, conductivity, lower_temperature, upper_temperature,
        origin, axis;
} hot_par;

static const param_spec hot_params[] = {
    PAR_POSITIVE(hot_par, height, "m", NAN, "distance of the plates"),
    PAR_ANY(hot_par, speed, "m/s", 0.0, "speed of the upper plate; 0: conduction alone"),
    PAR_POSITIVE(hot_par, pressure, "Pa", NAN, "pressure"),
    PAR_BETWEEN(hot_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_POSITIVE(hot_par, heat_capacity, "J/kg/K", NAN, "c_v"),
    PAR_NONNEGATIVE(hot_par, viscosity, "Pa s", 0.0, "dynamic viscosity"),
    PAR_POSITIVE(hot_par, conductivity, "W/m/K", NAN, "thermal conductivity"),
    PAR_POSITIVE(hot_par, lower_temperature, "K", NAN, "temperature of the lower plate"),
    PAR_POSITIVE(hot_par, upper_temperature, "K", NAN, "temperature of the upper plate"),
    PAR_ANY(hot_par, origin, "m", 0.0, "place of the lower plate"),
    PAR_BETWEEN(hot_par, axis, "1", 0.0, 2.0, 1.0, "the axis across the plates; the upper one moves along the next"),
};

static floe_status hot_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    const hot_par *p = par;
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    TRY(check_axis(ctx, p->axis, dim));
    if (dim > 1 || p->speed == 0.0) return FLOE_OK;
    return fail_key(ctx, KEY("speed"), "%g m/s: a plate cannot slide in one dimension", p->speed);
}

/* The axis along which the plate moves: y across, x along; z across, x along; x across, y along. */
static int hot_along(int across)
{
    return across == 0 ? 1 : 0;
}

static double hot_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                        double t)
{
    (void)prepared;
    (void)dim;
    (void)t;
    const hot_par *p = par;
    const int across = whole_number(p->axis);
    const double s = (x[across] - p->origin) / p->height;
    if (is_velocity(quantity)) return component_along(quantity, EXACT_VELOCITY_X, hot_along(across), p->speed * s);
    const hot_walls walls = {p->pressure,          p->gamma,
                             p->heat_capacity,     p->lower_temperature,
                             p->upper_temperature, 0.5 * p->viscosity * p->speed * p->speed / p->conductivity};
    return hot_walls_value(&walls, quantity, s);
}

static const hot_par sample_par = {.height = 0.1,
                                   .speed = 2.0,
                                   .pressure = 10.0,
                                   .gamma = 1.4,
                                   .heat_capacity = 2.5,
                                   .viscosity = 0.1,
                                   .conductivity = 0.3,
                                   .lower_temperature = 1.0,
                                   .upper_temperature = 1.5,
                                   .axis = 1.0};

const exact_model exact_couette_hot = {
    .name = "couette_hot",
    .doc = "ideal gas between plates of given temperatures, one of them moving; without speed, conduction alone",
    .cite = "White, Viscous Fluid Flow, 3rd ed. (2006), section 3-2.1",
    .validity = "steady; ideal gas of any Mach number, constant viscosity and conductivity, no slip. The pressure is "
                "that of the steady flow: a closed box takes the one that its mass gives.",
    .equations = EXACT_NAVIER_STOKES,
    .param_size = sizeof(hot_par),
    .params = hot_params,
    .n_params = COUNT_OF(hot_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.0, 0.0}, .hi = {0.1, 0.1}},
    .prepare = hot_prepare,
    .value = hot_value,
};

/* An ideal gas between two round walls of given temperatures, the inner one sliding along the axis. */
#include "verify/verify_internal.h"

#include <math.h>

typedef struct annulus_par {
    double inner_radius, outer_radius, speed, pressure, gamma, heat_capacity, viscosity, conductivity,
        inner_temperature, outer_temperature;
} annulus_par;

static const param_spec annulus_params[] = {
    PAR_POSITIVE(annulus_par, inner_radius, "m", NAN, "radius of the inner wall"),
    PAR_POSITIVE(annulus_par, outer_radius, "m", NAN, "radius of the outer wall, larger"),
    PAR_ANY(annulus_par, speed, "m/s", 0.0, "speed of the inner wall along the axis; 0: conduction alone"),
    PAR_POSITIVE(annulus_par, pressure, "Pa", NAN, "pressure"),
    PAR_BETWEEN(annulus_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_POSITIVE(annulus_par, heat_capacity, "J/kg/K", NAN, "c_v"),
    PAR_NONNEGATIVE(annulus_par, viscosity, "Pa s", 0.0, "dynamic viscosity"),
    PAR_POSITIVE(annulus_par, conductivity, "W/m/K", NAN, "thermal conductivity"),
    PAR_POSITIVE(annulus_par, inner_temperature, "K", NAN, "temperature of the inner wall"),
    PAR_POSITIVE(annulus_par, outer_temperature, "K", NAN, "temperature of the outer wall"),
};

static floe_status annulus_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    (void)prepared;
    const annulus_par *p = par;
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    if (p->outer_radius > p->inner_radius) return FLOE_OK;
    return fail_key(ctx, KEY("outer_radius"), "%g m: must be over inner_radius = %g m", p->outer_radius,
                    p->inner_radius);
}

/* With s = ln(r/r_i)/ln(r_o/r_i): u = U (1 - s), and what shear makes of heat, mu u'^2 = mu (U/ln(r_o/r_i))^2 / r^2,
 * leaves by the walls: T = T_i + (T_o - T_i) s + mu U^2/(2 k) s (1 - s). */
static double annulus_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                            double t)
{
    (void)prepared;
    (void)t;
    const annulus_par *p = par;
    const double r = dim > 2 ? hypot(x[0], x[1]) : x[0];
    const double s = log(r / p->inner_radius) / log(p->outer_radius / p->inner_radius);
    if (is_velocity(quantity)) return component_along(quantity, EXACT_VELOCITY_X, dim - 1, p->speed * (1.0 - s));
    const hot_walls walls = {p->pressure,          p->gamma,
                             p->heat_capacity,     p->inner_temperature,
                             p->outer_temperature, 0.5 * p->viscosity * p->speed * p->speed / p->conductivity};
    return hot_walls_value(&walls, quantity, s);
}

static const annulus_par sample_par = {.inner_radius = 0.05,
                                       .outer_radius = 0.2,
                                       .speed = 2.0,
                                       .pressure = 10.0,
                                       .gamma = 1.4,
                                       .heat_capacity = 2.5,
                                       .viscosity = 0.1,
                                       .conductivity = 0.3,
                                       .inner_temperature = 1.5,
                                       .outer_temperature = 1.0};

const exact_model exact_annulus_hot = {
    .name = "annulus_hot",
    .doc = "ideal gas between round walls of given temperatures, the inner one sliding along the axis; without speed, "
           "conduction alone",
    .cite = "White, Viscous Fluid Flow, 3rd ed. (2006), section 3-2; Carslaw and Jaeger, Conduction of Heat in Solids "
            "(1959), section 7.2",
    .validity =
        "steady; ideal gas of any Mach number, constant viscosity and conductivity, no slip; about an axis (r, z) "
        "or in space about z. A closed box takes the pressure that its mass gives.",
    .equations = EXACT_NAVIER_STOKES,
    .param_size = sizeof(annulus_par),
    .params = annulus_params,
    .n_params = COUNT_OF(annulus_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.05, 0.03, 0.0}, .hi = {0.1, 0.1, 0.1}},
    .prepare = annulus_prepare,
    .value = annulus_value,
};

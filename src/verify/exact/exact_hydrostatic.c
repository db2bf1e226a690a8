/* A column of ideal gas at rest, at one temperature. */
#include "verify/verify_internal.h"

typedef struct column_par {
    double density, pressure, gamma, heat_capacity, gravity, height, axis;
} column_par;

static const param_spec column_params[] = {
    PAR_POSITIVE(column_par, density, "kg/m3", NAN, "density at the reference height"),
    PAR_POSITIVE(column_par, pressure, "Pa", NAN, "pressure at the reference height"),
    PAR_BETWEEN(column_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_NONNEGATIVE(column_par, heat_capacity, "J/kg/K", 0.0, "c_v; 0: no temperature is given"),
    PAR_ANY(column_par, gravity, "m/s2", 9.80665, "gravity, towards smaller coordinates of the axis"),
    PAR_ANY(column_par, height, "m", 0.0, "reference height"),
    PAR_BETWEEN(column_par, axis, "1", 0.0, 2.0, 1.0, "the vertical axis: 0, 1 or 2"),
};

static floe_status column_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    const column_par *p = par;
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    return check_axis(ctx, p->axis, dim);
}

static double column_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                           double t)
{
    (void)prepared;
    (void)dim;
    (void)t;
    const column_par *p = par;
    const double fall = exp(-p->gravity * p->density / p->pressure * (x[whole_number(p->axis)] - p->height));
    if (is_velocity(quantity)) return 0.0;
    switch (quantity) {
    case EXACT_DENSITY: return p->density * fall;
    case EXACT_PRESSURE: return p->pressure * fall;
    case EXACT_INTERNAL_ENERGY: return gas_energy(p->density, p->pressure, p->gamma, 0.0);
    case EXACT_TEMPERATURE: return gas_temperature(p->density, p->pressure, p->gamma, 0.0, p->heat_capacity);
    default: return NAN;
    }
}

static void column_body_force(const void *par, const void *prepared, int dim, const double x[3], double t,
                              double force[3])
{
    (void)prepared;
    (void)dim;
    (void)x;
    (void)t;
    const column_par *p = par;
    force[whole_number(p->axis)] = -p->gravity;
}

static const column_par sample_par = {
    .density = 1.2, .pressure = 1e5, .gamma = 1.4, .heat_capacity = 717.5, .gravity = 9.80665, .axis = 1.0};

const exact_model exact_hydrostatic = {
    .name = "hydrostatic",
    .doc = "column of ideal gas at rest, isothermal",
    .cite = "Landau & Lifshitz, Fluid Mechanics, 2nd ed. (1987), section 3",
    .validity = "ideal gas of one temperature, uniform gravity. A scheme that keeps its own discrete column exactly at "
                "rest differs from this one by its truncation error.",
    .equations = EXACT_EULER,
    .param_size = sizeof(column_par),
    .params = column_params,
    .n_params = COUNT_OF(column_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.0, 0.0}, .hi = {1000.0, 1000.0}},
    .prepare = column_prepare,
    .value = column_value,
    .body_force = column_body_force,
};

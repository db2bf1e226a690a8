/* A uniform stream: what must stay as it is. */
#include "verify/verify_internal.h"

typedef struct uniform_par {
    double density, pressure, internal_energy, temperature, volume_fraction;
    double velocity[3];
} uniform_par;

static const param_spec uniform_params[] = {
    PAR_POSITIVE(uniform_par, density, "kg/m3", NAN, "density"),
    PAR_ANY(uniform_par, pressure, "Pa", NAN, "pressure"),
    PAR_NONNEGATIVE(uniform_par, internal_energy, "J/kg", 0.0, "internal energy per mass; 0: none is given"),
    PAR_NONNEGATIVE(uniform_par, temperature, "K", 0.0, "temperature; 0: none is given"),
    PAR_BETWEEN(uniform_par, volume_fraction, "1", 0.0, 1.0, 1.0, "volume fraction of the material"),
    PAR_VECTOR(uniform_par, velocity, "m/s", PARAM_ANY, 0.0, "velocity"),
};

static double uniform_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                            double t)
{
    (void)prepared;
    (void)dim;
    (void)x;
    (void)t;
    const uniform_par *p = par;
    if (is_velocity(quantity)) return p->velocity[quantity - EXACT_VELOCITY_X];
    switch (quantity) {
    case EXACT_DENSITY: return p->density;
    case EXACT_PRESSURE: return p->pressure;
    case EXACT_INTERNAL_ENERGY: return p->internal_energy > 0.0 ? p->internal_energy : (double)NAN;
    case EXACT_TEMPERATURE: return p->temperature > 0.0 ? p->temperature : (double)NAN;
    case EXACT_VOLUME_FRACTION: return p->volume_fraction;
    default: return NAN;
    }
}

static const uniform_par sample_par = {.density = 1.2,
                                       .pressure = 1e5,
                                       .internal_energy = 2e5,
                                       .temperature = 293.0,
                                       .volume_fraction = 1.0,
                                       .velocity = {30.0, -20.0, 10.0}};

const exact_model exact_uniform = {
    .name = "uniform",
    .doc = "a uniform stream",
    .cite = "free stream: constants solve every balance law without sources",
    .validity = "no boundary that disturbs the stream, no sources.",
    .equations = EXACT_EULER,
    .of_solids_too = true,
    .param_size = sizeof(uniform_par),
    .params = uniform_params,
    .n_params = COUNT_OF(uniform_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE | EXACT_BIT(EXACT_VOLUME_FRACTION),
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.0, 0.0, 0.0}, .hi = {1.0, 1.0, 1.0}},
    .value = uniform_value,
};

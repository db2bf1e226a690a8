/* The Taylor-Green array of decaying vortices, two dimensions, incompressible. */
#include "verify/verify_internal.h"

typedef struct green_par {
    double density, viscosity, pressure, speed, wavelength;
} green_par;

static const param_spec green_params[] = {
    PAR_POSITIVE(green_par, density, "kg/m3", NAN, "density"),
    PAR_NONNEGATIVE(green_par, viscosity, "Pa s", NAN, "dynamic viscosity"),
    PAR_ANY(green_par, pressure, "Pa", 0.0, "mean pressure"),
    PAR_POSITIVE(green_par, speed, "m/s", 1.0, "greatest speed at t = 0"),
    PAR_POSITIVE(green_par, wavelength, "m", 1.0, "wavelength, along both axes"),
};

static double green_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                          double t)
{
    (void)prepared;
    (void)dim;
    const green_par *p = par;
    const double k = 2.0 * VERIFY_PI / p->wavelength;
    const double decay = exp(-2.0 * p->viscosity / p->density * k * k * t);
    switch (quantity) {
    case EXACT_VELOCITY_X: return p->speed * sin(k * x[0]) * cos(k * x[1]) * decay;
    case EXACT_VELOCITY_Y: return -p->speed * cos(k * x[0]) * sin(k * x[1]) * decay;
    case EXACT_VELOCITY_Z: return 0.0;
    case EXACT_PRESSURE:
        return p->pressure +
               0.25 * p->density * p->speed * p->speed * (cos(2.0 * k * x[0]) + cos(2.0 * k * x[1])) * decay * decay;
    case EXACT_DENSITY: return p->density;
    default: return NAN;
    }
}

static const green_par sample_par = {.density = 1.2, .viscosity = 0.02, .speed = 1.5, .wavelength = 2.0};

const exact_model exact_taylor_green = {
    .name = "taylor_green",
    .doc = "decaying array of vortices on a periodic square",
    .cite = "Taylor & Green, Proc. R. Soc. Lond. A 158 (1937) 499; Chorin, Math. Comput. 22 (1968) 745",
    .validity = "incompressible, constant viscosity, periodic: a compressible run differs by the order of the squared "
                "Mach number.",
    .equations = EXACT_INCOMPRESSIBLE,
    .param_size = sizeof(green_par),
    .params = green_params,
    .n_params = COUNT_OF(green_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_DENSITY),
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.0, 0.0}, .hi = {2.0, 2.0}, .t = 0.7},
    .value = green_value,
};

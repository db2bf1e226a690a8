/* Steady flow along a round pipe under a body force. */
#include "verify/verify_internal.h"

#include <math.h>

typedef struct pipe_par {
    double radius, force, density, viscosity, pressure;
} pipe_par;

static const param_spec pipe_params[] = {
    PAR_POSITIVE(pipe_par, radius, "m", NAN, "inner radius of the pipe"),
    PAR_ANY(pipe_par, force, "m/s2", NAN, "body force per mass along the pipe: the pressure gradient over -density"),
    PAR_POSITIVE(pipe_par, density, "kg/m3", NAN, "density"),
    PAR_POSITIVE(pipe_par, viscosity, "Pa s", NAN, "dynamic viscosity"),
    PAR_ANY(pipe_par, pressure, "Pa", 0.0, "pressure"),
};

/* In two dimensions the places are (r, z), in three (x, y, z). */
static double pipe_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                         double t)
{
    (void)prepared;
    (void)t;
    const pipe_par *p = par;
    const double square = x[0] * x[0] + (dim > 2 ? x[1] * x[1] : 0.0);
    if (is_velocity(quantity))
        return component_along(quantity, EXACT_VELOCITY_X, dim - 1,
                               0.25 * p->force * p->density / p->viscosity * (p->radius * p->radius - square));
    switch (quantity) {
    case EXACT_PRESSURE: return p->pressure;
    case EXACT_DENSITY: return p->density;
    default: return NAN;
    }
}

static void pipe_body_force(const void *par, const void *prepared, int dim, const double x[3], double t,
                            double force[3])
{
    (void)prepared;
    (void)x;
    (void)t;
    const pipe_par *p = par;
    force[dim - 1] = p->force;
}

static const pipe_par sample_par = {.radius = 0.1, .force = 3.0, .density = 1.2, .viscosity = 0.01};

const exact_model exact_pipe_flow = {
    .name = "pipe_flow",
    .doc = "flow along a round pipe under a body force, about an axis or in space",
    .cite = "Batchelor, An Introduction to Fluid Dynamics (1967), section 4.2",
    .validity = "steady, incompressible, constant viscosity, no slip, a uniform body force in place of a pressure "
                "gradient; the pipe is the last axis. A compressible run is heated by shear.",
    .equations = EXACT_INCOMPRESSIBLE,
    .param_size = sizeof(pipe_par),
    .params = pipe_params,
    .n_params = COUNT_OF(pipe_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_DENSITY),
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.0, 0.0, 0.0}, .hi = {0.05, 0.05, 0.1}},
    .value = pipe_value,
    .body_force = pipe_body_force,
};

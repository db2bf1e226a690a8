/* A bar vibrating along its axis in one of its modes. */
#include "verify/verify_internal.h"

typedef struct bar_par {
    double length, modulus, density, amplitude, mode, free_end, phase, origin, axis;
} bar_par;

static const param_spec bar_params[] = {
    PAR_POSITIVE(bar_par, length, "m", NAN, "length of the bar"),
    PAR_POSITIVE(bar_par, modulus, "Pa", NAN,
                 "modulus along the axis: K + 4G/3 in uniaxial strain, Young's modulus in uniaxial stress"),
    PAR_POSITIVE(bar_par, density, "kg/m3", NAN, "density at rest"),
    PAR_ANY(bar_par, amplitude, "m", NAN, "amplitude of the displacement"),
    PAR_BETWEEN(bar_par, mode, "1", 1.0, 1000.0, 1.0, "number of the mode, from 1"),
    PAR_BETWEEN(bar_par, free_end, "1", 0.0, 1.0, 1.0, "0: both ends fixed; 1: the far end free"),
    PAR_ANY(bar_par, phase, "1", 0.0, "phase (radians) at t = 0; 0: undeformed and moving, pi/2: deformed and at rest"),
    PAR_ANY(bar_par, origin, "m", 0.0, "the fixed end"),
    PAR_BETWEEN(bar_par, axis, "1", 0.0, 2.0, 0.0, "the bar's axis: 0, 1 or 2"),
};

typedef struct bar_constants {
    double wave_number; /* rad/m */
    double omega;       /* rad/s */
} bar_constants;

static floe_status bar_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const bar_par *p = par;
    bar_constants *c = prepared;
    TRY(check_whole(ctx, "mode", p->mode));
    TRY(check_whole(ctx, "free_end", p->free_end));
    TRY(check_axis(ctx, p->axis, dim));
    c->wave_number = VERIFY_PI * (p->mode - 0.5 * p->free_end) / p->length;
    c->omega = c->wave_number * sqrt(p->modulus / p->density);
    return FLOE_OK;
}

static double bar_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                        double t)
{
    (void)dim;
    const bar_par *p = par;
    const bar_constants *c = prepared;
    const int axis = whole_number(p->axis);
    const double angle = c->wave_number * (x[axis] - p->origin);
    const double clock = c->omega * t + p->phase;
    if (is_displacement(quantity)) {
        return component_along(quantity, EXACT_DISPLACEMENT_X, axis, p->amplitude * sin(angle) * sin(clock));
    }
    if (is_velocity(quantity)) {
        return component_along(quantity, EXACT_VELOCITY_X, axis, p->amplitude * c->omega * sin(angle) * cos(clock));
    }
    if (quantity >= EXACT_STRESS_XX && quantity <= EXACT_STRESS_ZZ) {
        const double stress = p->modulus * p->amplitude * c->wave_number * cos(angle) * sin(clock);
        return (int)quantity - EXACT_STRESS_XX == axis ? stress : (double)NAN;
    }
    return NAN;
}

static const exact_scalar bar_scalars[] = {
    {"omega", "rad/s", "angular frequency"},
    {"period", "s", "period of vibration"},
};

static double bar_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)t;
    const bar_constants *c = prepared;
    return i == 0 ? c->omega : 2.0 * VERIFY_PI / c->omega;
}

static const bar_par sample_par = {
    .length = 1.0, .modulus = 1e6, .density = 1000.0, .amplitude = 1e-4, .mode = 2.0, .free_end = 1.0, .phase = 0.3};

const exact_model exact_standing_bar = {
    .name = "standing_bar",
    .doc = "standing wave along a bar, fixed at both ends or at one",
    .cite = "Landau & Lifshitz, Theory of Elasticity, 3rd ed. (1986), section 25",
    .validity = "linear elasticity, x the place at rest; the error against a finite-strain law is of the order of the "
                "strain, amplitude mode pi/length, times the solution. Only the stress along the axis is given.",
    .equations = EXACT_SOLID,
    .param_size = sizeof(bar_par),
    .params = bar_params,
    .n_params = COUNT_OF(bar_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_BIT(EXACT_STRESS_XX) | EXACT_BIT(EXACT_STRESS_YY) |
                EXACT_BIT(EXACT_STRESS_ZZ),
    .scalars = bar_scalars,
    .n_scalars = COUNT_OF(bar_scalars),
    .sample = {.par = &sample_par, .dim = 1, .lo = {0.0}, .hi = {1.0}, .t = 0.01},
    .prepared_size = sizeof(bar_constants),
    .prepare = bar_prepare,
    .value = bar_value,
    .scalar = bar_scalar,
};

/* A sprung piston on a column of compressible fluid, vibrating in one of its modes. */
#include "verify/piston.h"
#include "verify/verify_internal.h"

typedef struct piston_par {
    piston system; /* first: PISTON_PARAMS */
    double pressure, amplitude, phase, origin, axis, mode;
} piston_par;

static const param_spec piston_params[] = {
    PISTON_PARAMS,
    PAR_ANY(piston_par, pressure, "Pa", 0.0, "pressure of the fluid at rest"),
    PAR_ANY(piston_par, amplitude, "m", NAN, "amplitude of the piston's displacement, away from the fluid"),
    PAR_ANY(piston_par, phase, "1", 0.0, "phase (radians) at t = 0; 0: at rest place and moving, pi/2: displaced"),
    PAR_ANY(piston_par, origin, "m", 0.0, "the closed end of the column; the piston is at origin + length"),
    PAR_BETWEEN(piston_par, axis, "1", 0.0, 2.0, 0.0, "the axis of the tube: 0, 1 or 2"),
    PAR_BETWEEN(piston_par, mode, "1", 1.0, 1000.0, 1.0, "number of the mode, from 1"),
};

typedef struct piston_constants {
    double sound; /* m/s */
    double omega; /* rad/s */
} piston_constants;

static floe_status piston_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const piston_par *p = par;
    piston_constants *c = prepared;
    TRY(check_axis(ctx, p->axis, dim));
    TRY(check_whole(ctx, "mode", p->mode));
    TRY(piston_check(ctx, &p->system));
    c->sound = sqrt(p->system.bulk_modulus / p->system.density);
    c->omega = piston_frequency(&p->system, whole_number(p->mode));
    if (isfinite(c->omega)) return FLOE_OK;
    return fail_key(ctx, KEY("mode"), "%g: the piston has no such frequency: check mass, stiffness and fluid", p->mode);
}

static double piston_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                           double t)
{
    (void)dim;
    const piston_par *p = par;
    const piston_constants *c = prepared;
    const int axis = whole_number(p->axis);
    const double k = c->omega / c->sound;
    const double from = x[axis] - p->origin;
    const bool fluid = from <= p->system.length;
    const double clock = c->omega * t + p->phase;
    const double scale = p->amplitude / sin(k * p->system.length);
    const double shape = fluid ? scale * sin(k * from) : p->amplitude;
    const double strain = scale * k * cos(k * from) * sin(clock);
    if (is_displacement(quantity)) return component_along(quantity, EXACT_DISPLACEMENT_X, axis, shape * sin(clock));
    if (is_velocity(quantity)) return component_along(quantity, EXACT_VELOCITY_X, axis, shape * c->omega * cos(clock));
    if (quantity == EXACT_PRESSURE && fluid) return p->pressure - p->system.bulk_modulus * strain;
    if (quantity == EXACT_DENSITY && fluid) return p->system.density * (1.0 - strain);
    return NAN;
}

static const exact_scalar piston_scalars[] = {
    {"omega", "rad/s", "angular frequency of the mode"},
    {"period", "s", "period of the mode"},
};

static double piston_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)t;
    const piston_constants *c = prepared;
    return i == 0 ? c->omega : 2.0 * VERIFY_PI / c->omega;
}

static const piston_par york = {.system = PISTON_OF_YORK, .amplitude = 1e-4, .mode = 1.0};

const exact_model exact_piston = {
    .name = "piston",
    .doc = "sprung piston on a closed column of compressible fluid, in one mode",
    .cite = "York (1997), eq. 6.2; York, Sulsky & Schreyer (2000), section 4.2; Olson & Bathe (1983)",
    .validity =
        "linear acoustics, x the place at rest: error of the order of amplitude/length. Beyond the column x moves "
        "with the piston and has no pressure or density, whatever the spring's mass.",
    .equations = EXACT_ORDINARY,
    .param_size = sizeof(piston_par),
    .params = piston_params,
    .n_params = COUNT_OF(piston_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_DENSITY),
    .scalars = piston_scalars,
    .n_scalars = COUNT_OF(piston_scalars),
    .sample = {.par = &york, .dim = 1, .lo = {0.0}, .hi = {20.0}, .t = 0.001},
    .prepared_size = sizeof(piston_constants),
    .prepare = piston_prepare,
    .value = piston_value,
    .scalar = piston_scalar,
};

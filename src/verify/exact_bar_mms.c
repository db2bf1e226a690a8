/* Manufactured solution: a neo-Hookean bar in uniaxial strain, held at its standing wave by a body force. */
#include "verify/internal.h"

typedef struct mms_par {
    double length, bulk_modulus, shear_modulus, density, amplitude, speed, origin, axis;
} mms_par;

static const param_spec mms_params[] = {
    PAR_POSITIVE(mms_par, length, "m", 1.0, "length of the bar, fixed at both ends"),
    PAR_POSITIVE(mms_par, bulk_modulus, "Pa", NAN, "bulk modulus K; lambda = K - 2G/3"),
    PAR_POSITIVE(mms_par, shear_modulus, "Pa", NAN, "shear modulus G = mu"),
    PAR_POSITIVE(mms_par, density, "kg/m3", NAN, "density at rest"),
    PAR_ANY(mms_par, amplitude, "m", NAN, "amplitude of the displacement, below length/pi in size"),
    PAR_NONNEGATIVE(mms_par, speed, "m/s", 0.0, "c of sin(pi c t/length); 0: sqrt((K + 4G/3)/density)"),
    PAR_ANY(mms_par, origin, "m", 0.0, "the end from which X is counted"),
    PAR_BETWEEN(mms_par, axis, "1", 0.0, 2.0, 0.0, "the bar's axis: 0, 1 or 2"),
};

typedef struct mms_constants {
    double lambda; /* Pa */
    double speed;  /* m/s */
    double k;      /* rad/m */
} mms_constants;

static floe_status mms_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const mms_par *p = par;
    mms_constants *c = prepared;
    TRY(check_axis(ctx, p->axis, dim));
    c->lambda = p->bulk_modulus - 2.0 / 3.0 * p->shear_modulus;
    c->speed = p->speed > 0.0 ? p->speed : sqrt((c->lambda + 2.0 * p->shear_modulus) / p->density);
    c->k = VERIFY_PI / p->length;
    if (fabs(p->amplitude) * c->k < 1.0) return FLOE_OK;
    return fail(ctx, FLOE_BAD_INPUT, "amplitude = %g m: must be below length/pi = %g m, or the bar folds", p->amplitude,
                1.0 / c->k);
}

typedef struct mms_motion {
    double displacement, velocity, stretch;
} mms_motion;

static mms_motion motion_at(const mms_par *p, const mms_constants *c, const double x[3], double t)
{
    const double angle = c->k * (x[whole(p->axis)] - p->origin);
    const double clock = c->k * c->speed * t;
    return (mms_motion){.displacement = p->amplitude * sin(angle) * sin(clock),
                        .velocity = p->amplitude * c->k * c->speed * sin(angle) * cos(clock),
                        .stretch = 1.0 + p->amplitude * c->k * cos(angle) * sin(clock)};
}

/* Cauchy stress of lambda ln J/J I + mu/J (B - I): along the axis, or across it. */
static double mms_stress(const mms_par *p, const mms_constants *c, double stretch, bool across)
{
    const double volume = c->lambda * log(stretch) / stretch;
    return across ? volume : volume + p->shear_modulus * (stretch - 1.0 / stretch);
}

static double mms_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                        double t)
{
    (void)dim;
    const mms_par *p = par;
    const mms_constants *c = prepared;
    const int axis = whole(p->axis);
    const mms_motion motion = motion_at(p, c, x, t);
    if (is_displacement(quantity)) return along(quantity, EXACT_DISPLACEMENT_X, axis, motion.displacement);
    if (is_velocity(quantity)) return along(quantity, EXACT_VELOCITY_X, axis, motion.velocity);
    if (quantity >= EXACT_STRESS_XX && quantity <= EXACT_STRESS_ZZ) {
        return mms_stress(p, c, motion.stretch, (int)quantity - EXACT_STRESS_XX != axis);
    }
    if (quantity >= EXACT_STRESS_XY && quantity <= EXACT_STRESS_ZX) return 0.0;
    return quantity == EXACT_DENSITY ? p->density / motion.stretch : (double)NAN;
}

/* b = k^2 U (mu/rho0 - c^2 - (lambda (ln J - 1) - mu)/(rho0 F^2)), from rho0 u_tt = dP/dX + rho0 b. */
static void mms_body_force(const void *par, const void *prepared, int dim, const double x[3], double t, double force[3])
{
    (void)dim;
    const mms_par *p = par;
    const mms_constants *c = prepared;
    const mms_motion motion = motion_at(p, c, x, t);
    const double mu = p->shear_modulus;
    const double stiffness = mu - (c->lambda * (log(motion.stretch) - 1.0) - mu) / (motion.stretch * motion.stretch);
    force[whole(p->axis)] = c->k * c->k * motion.displacement * (stiffness / p->density - c->speed * c->speed);
}

static const exact_scalar mms_scalars[] = {
    {"period", "s", "period of the motion"},
};

static double mms_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)i;
    (void)t;
    const mms_constants *c = prepared;
    return 2.0 * VERIFY_PI / (c->k * c->speed);
}

static const mms_par sample_par = {
    .length = 1.0, .bulk_modulus = 1e6, .shear_modulus = 4e5, .density = 1000.0, .amplitude = 0.1};

const exact_model exact_bar_mms = {
    .name = "bar_mms",
    .doc = "manufactured large vibration of a neo-Hookean bar in uniaxial strain, with its body force",
    .cite = "Wallstedt & Guilkey, J. Comput. Phys. 227 (2008) 9628, with our derivation of the force",
    .validity = "x the place at rest (X); strain energy lambda/2 (ln J)^2 - mu ln J + mu/2 (tr C - 3) with "
                "lambda = K - 2G/3; uniaxial strain; the body force of this solution must act.",
    .equations = EXACT_SOLID,
    .param_size = sizeof(mms_par),
    .params = mms_params,
    .n_params = COUNT_OF(mms_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_STRESSES | EXACT_BIT(EXACT_DENSITY),
    .scalars = mms_scalars,
    .n_scalars = COUNT_OF(mms_scalars),
    .sample = {.par = &sample_par, .dim = 1, .lo = {0.0}, .hi = {1.0}, .t = 0.01},
    .prepared_size = sizeof(mms_constants),
    .prepare = mms_prepare,
    .value = mms_value,
    .body_force = mms_body_force,
    .scalar = mms_scalar,
};

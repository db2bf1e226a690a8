/* Manufactured solution: a neo-Hookean bar in uniaxial strain, or a box that vibrates along all its axes at once, held
 * at its standing wave by a body force. */
#include "verify/verify_internal.h"

typedef struct mms_par {
    double length, bulk_modulus, shear_modulus, density, amplitude, speed, origin, axis;
} mms_par;

static const param_spec mms_params[] = {
    PAR_POSITIVE(mms_par, length, "m", 1.0, "length of the bar, fixed at both ends"),
    PAR_POSITIVE(mms_par, bulk_modulus, "Pa", NAN, "bulk modulus K; lambda = K - 2G/3"),
    PAR_POSITIVE(mms_par, shear_modulus, "Pa", NAN, "shear modulus G = mu"),
    PAR_POSITIVE(mms_par, density, "kg/m3", NAN, "density at rest"),
    PAR_ANY(mms_par, amplitude, "m", NAN, "amplitude of the displacement along an axis, below length/pi in size"),
    PAR_NONNEGATIVE(mms_par, speed, "m/s", 0.0, "c of sin(pi c t/length); 0: sqrt((K + 4G/3)/density)"),
    PAR_ANY(mms_par, origin, "m", 0.0, "the end from which X is counted"),
    PAR_BETWEEN(mms_par, axis, "1", 0.0, 3.0, 0.0, "the bar's axis: 0, 1 or 2; 3: all axes of the scene at once"),
};

typedef struct mms_constants {
    double lambda; /* Pa */
    double speed;  /* m/s */
    double k;      /* rad/m */
} mms_constants;

enum { ALL_AXES = 3 };

static floe_status mms_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const mms_par *p = par;
    mms_constants *c = prepared;
    if (p->axis != ALL_AXES) TRY(check_axis(ctx, p->axis, dim));
    c->lambda = p->bulk_modulus - 2.0 / 3.0 * p->shear_modulus;
    c->speed = p->speed > 0.0 ? p->speed : sqrt((c->lambda + 2.0 * p->shear_modulus) / p->density);
    c->k = VERIFY_PI / p->length;
    if (fabs(p->amplitude) * c->k < 1.0) return FLOE_OK;
    return fail_key(ctx, KEY("amplitude"), "%g m: must be below length/pi = %g m, or the bar folds", p->amplitude,
                    1.0 / c->k);
}

typedef struct mms_motion {
    double displacement[3], velocity[3], stretch[3], volume; /* volume: J */
} mms_motion;

/* Along the bar's axis, or along all of the scene's: each then by its own coordinate alone. */
static mms_motion motion_at(const mms_par *p, const mms_constants *c, int dim, const double x[3], double t)
{
    const double clock = c->k * c->speed * t;
    mms_motion m = {.stretch = {1.0, 1.0, 1.0}, .volume = 1.0};
    for (int a = 0; a < 3; a++) {
        const double angle = c->k * (x[a] - p->origin);
        if (a >= dim || (whole_number(p->axis) != a && whole_number(p->axis) != ALL_AXES)) continue;
        m.displacement[a] = p->amplitude * sin(angle) * sin(clock);
        m.velocity[a] = p->amplitude * c->k * c->speed * sin(angle) * cos(clock);
        m.stretch[a] = 1.0 + p->amplitude * c->k * cos(angle) * sin(clock);
        m.volume *= m.stretch[a];
    }
    return m;
}

/* Cauchy stress of lambda ln J/J I + mu/J (B - I) along an axis. */
static double mms_stress(const mms_par *p, const mms_constants *c, const mms_motion *m, int axis)
{
    const double square = m->stretch[axis] * m->stretch[axis];
    return (c->lambda * log(m->volume) + p->shear_modulus * (square - 1.0)) / m->volume;
}

static double mms_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                        double t)
{
    const mms_par *p = par;
    const mms_constants *c = prepared;
    const mms_motion motion = motion_at(p, c, dim, x, t);
    if (is_displacement(quantity)) return motion.displacement[(int)quantity - EXACT_DISPLACEMENT_X];
    if (is_velocity(quantity)) return motion.velocity[(int)quantity - EXACT_VELOCITY_X];
    if (quantity >= EXACT_STRESS_XX && quantity <= EXACT_STRESS_ZZ)
        return mms_stress(p, c, &motion, (int)quantity - EXACT_STRESS_XX);
    if (quantity >= EXACT_STRESS_XY && quantity <= EXACT_STRESS_ZX) return 0.0;
    return quantity == EXACT_DENSITY ? p->density / motion.volume : (double)NAN;
}

/* b_a = k^2 U_a (mu/rho0 - c^2 - (lambda (ln J - 1) - mu)/(rho0 F_aa^2)), from rho0 u_tt = Div P + rho0 b. */
static void mms_body_force(const void *par, const void *prepared, int dim, const double x[3], double t, double force[3])
{
    const mms_par *p = par;
    const mms_constants *c = prepared;
    const mms_motion m = motion_at(p, c, dim, x, t);
    const double mu = p->shear_modulus, tension = c->lambda * (log(m.volume) - 1.0) - mu;
    for (int a = 0; a < 3; a++) {
        const double stiffness = mu - tension / (m.stretch[a] * m.stretch[a]);
        force[a] = c->k * c->k * m.displacement[a] * (stiffness / p->density - c->speed * c->speed);
    }
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
    .length = 1.0, .bulk_modulus = 1e6, .shear_modulus = 4e5, .density = 1000.0, .amplitude = 0.1, .axis = ALL_AXES};

const exact_model exact_bar_mms = {
    .name = "bar_mms",
    .doc = "manufactured large vibration of a neo-Hookean bar or box along its axes, with its body force",
    .cite = "Wallstedt & Guilkey, J. Comput. Phys. 227 (2008) 9628, with our derivation of the force",
    .validity = "x the place at rest (X); strain energy lambda/2 (ln J)^2 - mu ln J + mu/2 (tr C - 3) with "
                "lambda = K - 2G/3; uniaxial strain, or plane strain of a square, or a cube; needs `verify.sources`.",
    .equations = EXACT_LARGE_SOLID,
    .param_size = sizeof(mms_par),
    .params = mms_params,
    .n_params = COUNT_OF(mms_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_STRESSES | EXACT_BIT(EXACT_DENSITY),
    .scalars = mms_scalars,
    .n_scalars = COUNT_OF(mms_scalars),
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.0}, .hi = {1.0, 1.0, 1.0}, .t = 0.01},
    .prepared_size = sizeof(mms_constants),
    .prepare = mms_prepare,
    .value = mms_value,
    .body_force = mms_body_force,
    .scalar = mms_scalar,
};

/* Flow between two fixed plates under a body force, from the start or steady. */
#include "verify/verify_internal.h"

typedef struct poiseuille_par {
    double height, force, density, viscosity, pressure, starting, origin;
} poiseuille_par;

static const param_spec poiseuille_params[] = {
    PAR_POSITIVE(poiseuille_par, height, "m", NAN, "distance of the plates"),
    PAR_ANY(poiseuille_par, force, "m/s2", NAN, "body force per mass along x: the pressure gradient over -density"),
    PAR_POSITIVE(poiseuille_par, density, "kg/m3", NAN, "density"),
    PAR_POSITIVE(poiseuille_par, viscosity, "Pa s", NAN, "dynamic viscosity"),
    PAR_ANY(poiseuille_par, pressure, "Pa", 0.0, "pressure"),
    PAR_BETWEEN(poiseuille_par, starting, "1", 0.0, 1.0, 0.0, "0: the steady flow; 1: from rest at t = 0"),
    PAR_ANY(poiseuille_par, origin, "m", 0.0, "y of the lower plate"),
};

static floe_status poiseuille_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    (void)prepared;
    const poiseuille_par *p = par;
    return check_whole(ctx, "starting", p->starting);
}

/* First and second integral of erfc from z to infinity. */
static double erfc_integral(double z)
{
    return exp(-z * z) / sqrt(VERIFY_PI) - z * erfc(z);
}

static double erfc_second_integral(double z)
{
    return 0.25 * (erfc(z) - 2.0 * z * erfc_integral(z));
}

/* Soon after the start: all is pushed alike but for what the plates hold back. nu t less the sum over n of 4 nu t
 * (-1)^n (ii((n H + y)/s) + ii(((n+1) H - y)/s)), s = 2 sqrt(nu t), ii the second integral of erfc; or its derivative
 * by y. */
static double poiseuille_early(const poiseuille_par *p, double y, double diffusion, bool derivative)
{
    const double spread = 2.0 * sqrt(diffusion);
    double sum = derivative ? 0.0 : diffusion;
    for (int n = 0; n < VERIFY_IMAGES; n++) {
        const double lower = (n * p->height + y) / spread, upper = ((n + 1) * p->height - y) / spread;
        const double term = derivative ? -spread * (erfc_integral(lower) - erfc_integral(upper))
                                       : 4.0 * diffusion * (erfc_second_integral(lower) + erfc_second_integral(upper));
        sum -= n % 2 == 0 ? term : -term;
    }
    return sum;
}

/* Shape of the steady flow y (H - y)/2, less what is not yet there: sum over odd n of
 * 4 H^2/(n pi)^3 sin(n pi y/H) exp(-nu (n pi/H)^2 t); or its derivative by y. */
static double poiseuille_shape(const poiseuille_par *p, double y, double t, bool derivative)
{
    const double steady = derivative ? 0.5 * p->height - y : 0.5 * y * (p->height - y);
    if (whole_number(p->starting) == 0) return steady;
    const double diffusion = p->viscosity / p->density * t;
    if (!(diffusion > 0.0)) return 0.0;
    if (diffusion < VERIFY_EARLY * p->height * p->height) return poiseuille_early(p, y, diffusion, derivative);
    double lag = 0.0;
    for (int n = 1; n <= VERIFY_MODES; n += 2) {
        const double k = n * VERIFY_PI / p->height;
        lag += 4.0 / (p->height * k * k) * (derivative ? cos(k * y) : sin(k * y) / k) * exp(-k * k * diffusion);
    }
    return steady - lag;
}

static double poiseuille_value(const void *par, const void *prepared, exact_quantity quantity, int dim,
                               const double x[3], double t)
{
    (void)prepared;
    (void)dim;
    const poiseuille_par *p = par;
    const double y = x[1] - p->origin;
    switch (quantity) {
    case EXACT_VELOCITY_X: return p->force * p->density / p->viscosity * poiseuille_shape(p, y, t, false);
    case EXACT_VELOCITY_Y:
    case EXACT_VELOCITY_Z: return 0.0;
    case EXACT_PRESSURE: return p->pressure;
    case EXACT_DENSITY: return p->density;
    case EXACT_STRESS_XY: return p->force * p->density * poiseuille_shape(p, y, t, true);
    default: return NAN;
    }
}

static void poiseuille_body_force(const void *par, const void *prepared, int dim, const double x[3], double t,
                                  double force[3])
{
    (void)prepared;
    (void)dim;
    (void)x;
    (void)t;
    const poiseuille_par *p = par;
    force[0] = p->force;
}

static const poiseuille_par sample_par = {
    .height = 0.1, .force = 3.0, .density = 1.2, .viscosity = 0.01, .starting = 1.0};

const exact_model exact_poiseuille = {
    .name = "poiseuille",
    .doc = "flow between two fixed plates under a body force",
    .cite = "Batchelor, An Introduction to Fluid Dynamics (1967), sections 4.2 and 4.3",
    .validity = "incompressible, constant viscosity, no slip, a uniform body force in place of a pressure gradient; a "
                "compressible run is heated by shear.",
    .equations = EXACT_INCOMPRESSIBLE,
    .param_size = sizeof(poiseuille_par),
    .params = poiseuille_params,
    .n_params = COUNT_OF(poiseuille_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_DENSITY) | EXACT_BIT(EXACT_STRESS_XY),
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.0, 0.0}, .hi = {0.1, 0.1}, .t = 0.05},
    .prepare = poiseuille_prepare,
    .value = poiseuille_value,
    .body_force = poiseuille_body_force,
};

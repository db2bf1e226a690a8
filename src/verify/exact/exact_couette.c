/* Flow between a fixed and a moving plate, from the start or steady. */
#include "verify/verify_internal.h"

typedef struct couette_par {
    double height, speed, density, viscosity, pressure, starting, origin;
} couette_par;

static const param_spec couette_params[] = {
    PAR_POSITIVE(couette_par, height, "m", NAN, "distance of the plates"),
    PAR_ANY(couette_par, speed, "m/s", NAN, "speed of the upper plate, along x"),
    PAR_POSITIVE(couette_par, density, "kg/m3", NAN, "density"),
    PAR_POSITIVE(couette_par, viscosity, "Pa s", NAN, "dynamic viscosity"),
    PAR_ANY(couette_par, pressure, "Pa", 0.0, "pressure"),
    PAR_BETWEEN(couette_par, starting, "1", 0.0, 1.0, 0.0, "0: the steady flow; 1: from rest at t = 0"),
    PAR_ANY(couette_par, origin, "m", 0.0, "y of the lower plate"),
};

static floe_status couette_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    (void)prepared;
    const couette_par *p = par;
    return check_whole(ctx, "starting", p->starting);
}

/* Soon after the start: the plate's speed spreads, and is thrown back by either plate. Sum over n of
 * erfc(((2n+1) H - y)/s) - erfc(((2n+1) H + y)/s), s = 2 sqrt(nu t); or its derivative by y. */
static double couette_early(const couette_par *p, double y, double spread, bool derivative)
{
    double sum = 0.0;
    for (int n = 1; n <= VERIFY_IMAGES; n += 2) {
        const double from = (n * p->height - y) / spread, back = (n * p->height + y) / spread;
        if (derivative)
            sum += 2.0 / (sqrt(VERIFY_PI) * spread) * (exp(-from * from) + exp(-back * back));
        else
            sum += erfc(from) - erfc(back);
    }
    return sum;
}

/* The steady flow y/H less what is not yet there, in units of the speed: sum over n of
 * 2/(n pi) (-1)^n sin(n pi y/H) exp(-nu (n pi/H)^2 t); or its derivative by y. */
static double couette_shape(const couette_par *p, double y, double t, bool derivative)
{
    const double steady = derivative ? 1.0 / p->height : y / p->height;
    if (whole_number(p->starting) == 0) return steady;
    const double k = VERIFY_PI / p->height, diffusion = p->viscosity / p->density * t;
    if (!(diffusion > 0.0)) return derivative || y < p->height ? 0.0 : steady;
    if (diffusion < VERIFY_EARLY * p->height * p->height) return couette_early(p, y, 2.0 * sqrt(diffusion), derivative);
    double sum = steady;
    for (int n = 1; n <= VERIFY_MODES; n++) {
        const double term = derivative ? 2.0 / p->height * cos(n * k * y) : 2.0 / (n * VERIFY_PI) * sin(n * k * y);
        sum += (n % 2 == 0 ? term : -term) * exp(-k * k * diffusion * n * n);
    }
    return sum;
}

static double couette_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                            double t)
{
    (void)prepared;
    (void)dim;
    const couette_par *p = par;
    const double y = x[1] - p->origin;
    switch (quantity) {
    case EXACT_PRESSURE: return p->pressure;
    case EXACT_DENSITY: return p->density;
    case EXACT_VELOCITY_X: return p->speed * couette_shape(p, y, t, false);
    case EXACT_VELOCITY_Y:
    case EXACT_VELOCITY_Z: return 0.0;
    case EXACT_STRESS_XY: return p->viscosity * p->speed * couette_shape(p, y, t, true);
    default: return NAN;
    }
}

static const couette_par sample_par = {.height = 0.1, .speed = 2.0, .density = 1.2, .viscosity = 0.01, .starting = 1.0};

const exact_model exact_couette = {
    .name = "couette",
    .doc = "flow between a fixed and a moving plate",
    .cite = "Batchelor, An Introduction to Fluid Dynamics (1967), section 4.3",
    .validity = "incompressible, constant viscosity, no slip; a compressible run is heated by shear.",
    .equations = EXACT_INCOMPRESSIBLE,
    .param_size = sizeof(couette_par),
    .params = couette_params,
    .n_params = COUNT_OF(couette_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_DENSITY) | EXACT_BIT(EXACT_STRESS_XY),
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.0, 0.0}, .hi = {0.1, 0.1}, .t = 0.05},
    .prepare = couette_prepare,
    .value = couette_value,
};

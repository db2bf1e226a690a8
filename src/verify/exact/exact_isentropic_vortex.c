/* A vortex in equilibrium, carried round a periodic box by a uniform stream. */
#include "verify/verify_internal.h"

typedef struct vortex_par {
    double density, pressure, gamma, heat_capacity;
    double strength, radius;
    double centre[3], velocity[3], period[3];
} vortex_par;

static const param_spec vortex_params[] = {
    PAR_POSITIVE(vortex_par, density, "kg/m3", 1.0, "density far from the vortex"),
    PAR_POSITIVE(vortex_par, pressure, "Pa", 1.0, "pressure far from the vortex"),
    PAR_BETWEEN(vortex_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_NONNEGATIVE(vortex_par, heat_capacity, "J/kg/K", 0.0, "c_v; 0: no temperature is given"),
    PAR_ANY(vortex_par, strength, "1", 5.0, "beta: the swirl is sqrt(pressure/density) beta/(2 pi) at r = radius"),
    PAR_POSITIVE(vortex_par, radius, "m", 1.0, "radius of greatest swirl"),
    PAR_VECTOR(vortex_par, centre, "m", PARAM_ANY, 0.0, "centre at t = 0"),
    PAR_VECTOR(vortex_par, velocity, "m/s", PARAM_ANY, 0.0, "velocity of the stream"),
    PAR_VECTOR(vortex_par, period, "m", PARAM_NONNEGATIVE, 0.0, "periods of the domain; 0: not periodic"),
};

static floe_status vortex_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    (void)prepared;
    const vortex_par *p = par;
    if (!(p->gamma > 1.0)) return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
    const double drop =
        (p->gamma - 1.0) * p->strength * p->strength * exp(1.0) / (8.0 * p->gamma * VERIFY_PI * VERIFY_PI);
    if (drop < 1.0) return FLOE_OK;
    return fail_key(ctx, KEY("strength"), "%g: the temperature at the centre would be negative (%g of that outside)",
                    p->strength, 1.0 - drop);
}

/* The place seen from the centre of the nearest image, in radii. */
static void from_centre(const vortex_par *p, const double x[3], double t, double out[2])
{
    for (int i = 0; i < 2; i++) {
        double distance = x[i] - p->centre[i] - p->velocity[i] * t;
        if (p->period[i] > 0.0) distance -= p->period[i] * round(distance / p->period[i]);
        out[i] = distance / p->radius;
    }
}

static double vortex_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                           double t)
{
    (void)prepared;
    (void)dim;
    const vortex_par *p = par;
    const double g = p->gamma;
    double s[2];
    from_centre(p, x, t, s);
    const double swirl = p->strength / (2.0 * VERIFY_PI) * exp(0.5 * (1.0 - s[0] * s[0] - s[1] * s[1]));
    const double speed = sqrt(p->pressure / p->density) * swirl;
    const double ratio = 1.0 - 0.5 * (g - 1.0) / g * swirl * swirl; /* of temperatures */
    const double density = p->density * pow(ratio, 1.0 / (g - 1.0));
    const double pressure = p->pressure * pow(ratio, g / (g - 1.0));
    switch (quantity) {
    case EXACT_VELOCITY_X: return p->velocity[0] - speed * s[1];
    case EXACT_VELOCITY_Y: return p->velocity[1] + speed * s[0];
    case EXACT_VELOCITY_Z: return p->velocity[2];
    default: return gas_value(quantity, density, pressure, g, p->heat_capacity);
    }
}

static const vortex_par sample_par = {.density = 1.0,
                                      .pressure = 1.0,
                                      .gamma = 1.4,
                                      .heat_capacity = 2.5,
                                      .strength = 5.0,
                                      .radius = 1.0,
                                      .centre = {5.0, 5.0},
                                      .velocity = {1.0, 0.5},
                                      .period = {10.0, 10.0}};

const exact_model exact_isentropic_vortex = {
    .name = "isentropic_vortex",
    .doc = "vortex in equilibrium, carried by a uniform stream",
    .cite = "Shu, NASA/CR-97-206253 (1997), section 5.1; Yee, Sandham & Djomehri, J. Comput. Phys. 150 (1999) 199",
    .validity =
        "inviscid ideal gas. On a periodic domain only the nearest image is taken: where images meet, swirl jumps "
        "by strength/pi s exp((1 - s^2)/2), s = period/(2 radius): 5e-5 for a period of 10 radii, strength 5.",
    .equations = EXACT_EULER,
    .param_size = sizeof(vortex_par),
    .params = vortex_params,
    .n_params = COUNT_OF(vortex_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .sample = {.par = &sample_par, .dim = 2, .lo = {4.0, 4.0}, .hi = {7.0, 7.0}, .t = 0.4},
    .prepare = vortex_prepare,
    .value = vortex_value,
};

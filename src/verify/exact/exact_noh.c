/* Noh's problem: a cold gas that runs into its centre, and a shock that runs out from there. */
#include "verify/radial.h"

typedef struct noh_par {
    double density, speed, gamma, pressure;
    radial_par radial;
} noh_par;

static const param_spec noh_params[] = {
    PAR_POSITIVE(noh_par, density, "kg/m3", 1.0, "density at the start"),
    PAR_POSITIVE(noh_par, speed, "m/s", 1.0, "speed at the start, towards the centre"),
    PAR_BETWEEN(noh_par, gamma, "1", 1.01, 20.0, 5.0 / 3.0, "ratio of specific heats"),
    PAR_NONNEGATIVE(
        noh_par, pressure, "Pa", 0.0,
        "pressure at the start, to begin a run with: far below density speed^2. Ahead it grows as density^gamma"),
    PAR_RADIAL(noh_par, radial),
};

static floe_status noh_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    const noh_par *p = par;
    return radial_check(ctx, &p->radial, dim);
}

static double noh_shock_radius(const noh_par *p, double t)
{
    return 0.5 * (p->gamma - 1.0) * p->speed * fmax(t, 0.0);
}

typedef struct noh_state {
    double density, velocity, pressure;
} noh_state;

static noh_state noh_at(const noh_par *p, double r, double t)
{
    const double g = p->gamma;
    if (r < noh_shock_radius(p, t)) {
        const double density = p->density * pow((g + 1.0) / (g - 1.0), p->radial.geometry + 1.0);
        return (noh_state){density, 0.0, 0.5 * (g - 1.0) * density * p->speed * p->speed};
    }
    const double squeeze = t > 0.0 ? pow(1.0 + p->speed * t / r, p->radial.geometry) : 1.0;
    return (noh_state){p->density * squeeze, -p->speed, p->pressure * pow(squeeze, g)};
}

static double noh_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                        double t)
{
    (void)prepared;
    const noh_par *p = par;
    const noh_state s = noh_at(p, radial_distance(&p->radial, dim, x), t);
    if (is_velocity(quantity)) return radial_component(&p->radial, dim, quantity, x, s.velocity);
    return gas_value(quantity, s.density, s.pressure, p->gamma, 0.0);
}

static void noh_breaks(const void *par, const void *prepared, double t, exact_breaks *out)
{
    (void)prepared;
    const noh_par *p = par;
    radial_breaks(&p->radial, noh_shock_radius(p, t), out);
}

enum { SHOCK, INNER_DENSITY, INNER_PRESSURE };

static const exact_scalar noh_scalars[] = {
    [SHOCK] = {"shock", "m", "distance of the shock from the centre"},
    [INNER_DENSITY] = {"inner_density", "kg/m3", "density behind the shock"},
    [INNER_PRESSURE] = {"inner_pressure", "Pa", "pressure behind the shock"},
};

static double noh_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)prepared;
    const noh_par *p = par;
    const noh_state inner = noh_at(p, -1.0, t);
    switch (i) {
    case SHOCK: return noh_shock_radius(p, t);
    case INNER_DENSITY: return inner.density;
    case INNER_PRESSURE: return inner.pressure;
    default: return NAN;
    }
}

static const noh_par cylinder = {.density = 1.0, .speed = 1.0, .gamma = 5.0 / 3.0, .radial = {.geometry = 1.0}};

const exact_model exact_noh = {
    .name = "noh",
    .doc = "a cold gas that runs into its centre: a shock runs out and leaves it at rest",
    .cite = "W. F. Noh, J. Comput. Phys. 72 (1987) 78, section 4",
    .validity = "an ideal inviscid gas without pressure at the start.",
    .equations = EXACT_EULER,
    .param_size = sizeof(noh_par),
    .params = noh_params,
    .n_params = COUNT_OF(noh_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides =
        EXACT_BIT(EXACT_DENSITY) | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_INTERNAL_ENERGY),
    .scalars = noh_scalars,
    .n_scalars = COUNT_OF(noh_scalars),
    .sample = {.par = &cylinder, .dim = 2, .lo = {0.4, 0.3}, .hi = {0.6, 0.5}, .t = 0.6},
    .prepare = noh_prepare,
    .value = noh_value,
    .breaks = noh_breaks,
    .scalar = noh_scalar,
};

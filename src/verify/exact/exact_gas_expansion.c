/* A body of gas at rest that expands into a vacuum. */
#include "verify/radial_fan.h"
#include "verify/verify_internal.h"

typedef struct expansion_par {
    double radius, density, pressure, gamma, geometry;
    double centre[3];
} expansion_par;

static const param_spec expansion_params[] = {
    PAR_POSITIVE(expansion_par, radius, "m", NAN, "radius of the gas at the start; half the width of a slab"),
    PAR_POSITIVE(expansion_par, density, "kg/m3", NAN, "density at the start"),
    PAR_POSITIVE(expansion_par, pressure, "Pa", NAN, "pressure at the start"),
    PAR_BETWEEN(expansion_par, gamma, "1", 1.1, 5.0, 1.4, "ratio of specific heats"),
    PAR_BETWEEN(expansion_par, geometry, "1", 0.0, 2.0, 1.0,
                "0: a slab across the first axis, 1: a cylinder in the first two, 2: a sphere"),
    PAR_VECTOR(expansion_par, centre, "m", PARAM_ANY, 0.0, "centre; of an axisymmetric scene on the axis"),
};

static floe_status expansion_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const expansion_par *p = par;
    TRY(check_whole(ctx, "geometry", p->geometry));
    if (p->geometry > 0.0 && dim < 2) {
        return fail_key(ctx, KEY("geometry"), "%g: in one dimension there is only a slab, geometry 0", p->geometry);
    }
    const fan_gas gas = {.geometry = whole_number(p->geometry),
                         .radius = p->radius,
                         .sound = sqrt(p->gamma * p->pressure / p->density),
                         .gamma = p->gamma};
    return radial_fan_solve(ctx, &gas, prepared);
}

/* Axes over which the distance from the centre is taken. */
static int axes_of(const expansion_par *p, int dim)
{
    const int axes = whole_number(p->geometry) == 2 ? 3 : whole_number(p->geometry) + 1;
    return axes < dim ? axes : dim;
}

static double expansion_value(const void *par, const void *prepared, exact_quantity quantity, int dim,
                              const double x[3], double t)
{
    const expansion_par *p = par;
    const radial_fan *fan = prepared;
    const int axes = axes_of(p, dim);
    double square = 0.0;
    for (int a = 0; a < axes; a++) square += (x[a] - p->centre[a]) * (x[a] - p->centre[a]);
    const double r = sqrt(square);
    const fan_state s = radial_fan_at(fan, r, t);
    const double ratio = s.sound / fan->gas.sound;
    const double k = 2.0 / (p->gamma - 1.0);
    if (is_velocity(quantity)) {
        const int axis = (int)quantity - EXACT_VELOCITY_X;
        return axis < axes && r > 0.0 ? s.velocity * (x[axis] - p->centre[axis]) / r : 0.0 * s.velocity;
    }
    switch (quantity) {
    case EXACT_DENSITY: return p->density * pow(ratio, k);
    case EXACT_PRESSURE: return p->pressure * pow(ratio, k * p->gamma);
    case EXACT_INTERNAL_ENERGY: return s.sound * s.sound / (p->gamma * (p->gamma - 1.0));
    default: return NAN;
    }
}

static void expansion_breaks(const void *par, const void *prepared, double t, exact_breaks *out)
{
    const expansion_par *p = par;
    const radial_fan *fan = prepared;
    if (whole_number(p->geometry) != 0) return;
    const double inner = p->radius - fan->gas.sound * t;
    const double outer = p->radius + fan_front_speed(&fan->gas) * t;
    *out = (exact_breaks){.axis = 0, .count = 4, .position = {-outer, -inner, inner, outer}};
    for (int i = 0; i < out->count; i++) out->position[i] += p->centre[0];
}

enum { SOUND_SPEED, FRONT_SPEED, FRONT, INNER_EDGE, LIMIT };

static const exact_scalar expansion_scalars[] = {
    [SOUND_SPEED] = {"sound_speed", "m/s", "of the gas at rest"},
    [FRONT_SPEED] = {"front_speed", "m/s", "speed of the outer edge, 2 c/(gamma - 1)"},
    [FRONT] = {"front", "m", "distance of the outer edge from the centre"},
    [INNER_EDGE] = {"inner_edge", "m", "distance from the centre up to which the gas is at rest"},
    [LIMIT] = {"limit", "s", "time up to which the solution holds"},
};

static double expansion_scalar(const void *par, const void *prepared, size_t i, double t)
{
    const expansion_par *p = par;
    const radial_fan *fan = prepared;
    switch (i) {
    case SOUND_SPEED: return fan->gas.sound;
    case FRONT_SPEED: return fan_front_speed(&fan->gas);
    case FRONT: return p->radius + fan_front_speed(&fan->gas) * t;
    case INNER_EDGE: return p->radius - fan->gas.sound * t;
    default: return fan->limit;
    }
}

static const expansion_par york = {.radius = 0.376, .density = 1.0, .pressure = 100.0, .gamma = 1.4, .geometry = 1.0};

/* What mass and energy of the nets are off at the end. */
static double expansion_accuracy(const void *par, const void *prepared)
{
    (void)par;
    (void)prepared;
    return 2e-5;
}

const exact_model exact_gas_expansion = {
    .name = "gas_expansion",
    .doc = "a slab, cylinder or sphere of gas at rest that expands into a vacuum",
    .cite = "York (1997), section 4.2; Courant & Friedrichs, Supersonic Flow and Shock Waves (1948), section 158",
    .validity =
        "an ideal inviscid gas without other gas around it, before the wave that runs inwards comes near the centre "
        "(NAN after 0.6 radius/sound speed). By characteristics on nets of 200, 400 and 800 intervals, extrapolated: "
        "mass and energy are right to 1e-7 at a tenth of radius/sound speed, to 2e-5 at the end.",
    .equations = EXACT_ORDINARY,
    .param_size = sizeof(expansion_par),
    .params = expansion_params,
    .n_params = COUNT_OF(expansion_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides =
        EXACT_BIT(EXACT_DENSITY) | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_INTERNAL_ENERGY),
    .scalars = expansion_scalars,
    .n_scalars = COUNT_OF(expansion_scalars),
    .sample = {.par = &york, .dim = 2, .lo = {0.26, 0.26}, .hi = {0.3, 0.3}, .t = 0.0025},
    .prepared_size = sizeof(radial_fan),
    .prepare = expansion_prepare,
    .value = expansion_value,
    .accuracy = expansion_accuracy,
    .breaks = expansion_breaks,
    .scalar = expansion_scalar,
};

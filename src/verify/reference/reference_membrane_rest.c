/* A closed membrane blown up by the gas inside, once it has come to rest: a circle (plane scenes) or a sphere.
 *
 * The surface has the measure S r^k, k = 1 (circle, S = 2 pi) or 2 (sphere, S = 4 pi), and holds the volume S
 * r^(k+1)/(k+1). Equilibrium: p - p_out = k M eps thickness/r, eps = log(r/r0) or r/r0 - 1. Energy: p V/(gamma - 1) +
 * k/2 M eps^2 S r0^k t0 + p_out (V - V1) = p0 V0/(gamma - 1), V0 the gas's and V1 the membrane's volume at the start.
 * Everything may be a share of the whole (a quarter, say): S is then that share of it. */
#include "verify/reference.h"
#include "verify/verify_internal.h"

typedef struct rest_par {
    double sphere, rest_radius, thickness, modulus, gas_pressure, gas_volume, gamma, outside_pressure, enclosed, share;
    double small_strain, constant_volume;
} rest_par;

static const param_spec rest_params[] = {
    PAR_BETWEEN(rest_par, sphere, "1", 0.0, 1.0, 0.0, "0: a circle, per metre of depth; 1: a sphere"),
    PAR_POSITIVE(rest_par, rest_radius, "m", NAN, "radius without strain; of another shape length/(2 pi share)"),
    PAR_POSITIVE(rest_par, thickness, "m", NAN, "thickness of the membrane at rest"),
    PAR_POSITIVE(rest_par, modulus, "Pa", NAN,
                 "stress over strain: E/(1 - nu^2) in plane strain, E for a string, E/(1 - nu) for a sphere"),
    PAR_POSITIVE(rest_par, gas_pressure, "Pa", NAN, "pressure of the gas at the start"),
    PAR_POSITIVE(rest_par, gas_volume, "1", NAN, "volume (circle: area) of the gas at the start, of the share"),
    PAR_BETWEEN(rest_par, gamma, "1", 1.001, 20.0, 1.4, "ratio of specific heats of the gas"),
    PAR_NONNEGATIVE(rest_par, outside_pressure, "Pa", 0.0, "pressure outside"),
    PAR_NONNEGATIVE(rest_par, enclosed, "1", 0.0,
                    "volume (circle: area) inside the membrane at the start, of the share; 0: the gas's"),
    PAR_BETWEEN(rest_par, share, "1", 1e-6, 1.0, 1.0, "share of the whole that is in the scene (0.25: a quarter)"),
    PAR_BETWEEN(rest_par, small_strain, "1", 0.0, 1.0, 0.0, "0: logarithmic strain; 1: change of radius over radius"),
    PAR_BETWEEN(rest_par, constant_volume, "1", 0.0, 1.0, 0.0,
                "0: the thickness does not change; 1: the membrane's volume does not"),
};

enum { RADIUS, RADIUS_LAST, AREA, PRESSURE, HOOP_STRESS, STRAIN, GAS_ENERGY, STRAIN_ENERGY, QUANTITIES };

static const reference_quantity rest_quantities[QUANTITIES] = {
    [RADIUS] = {"radius", "m", "radius of the membrane", NULL, true},
    [RADIUS_LAST] = {"radius_last", "m", "the same: for its other end, which tells how round it is", NULL, true},
    [AREA] = {"area", "1", "volume (circle: area, m2) inside, of the share", NULL, true},
    [PRESSURE] = {"pressure", "Pa", "pressure of the gas", NULL, true},
    [HOOP_STRESS] = {"hoop_stress", "Pa", "stress in the membrane, tension positive", NULL, true},
    [STRAIN] = {"strain", "1", "strain of the membrane", NULL, true},
    [GAS_ENERGY] = {"gas_energy", "J", "internal energy of the gas", NULL, true},
    [STRAIN_ENERGY] = {"strain_energy", "J", "strain energy of the membrane", NULL, true},
};

typedef struct rest_state {
    double value[QUANTITIES];
} rest_state;

/* Of the measure S r^k of the surface. */
static int surface_exponent(const rest_par *p)
{
    return whole_number(p->sphere) + 1;
}

static double surface_factor(const rest_par *p)
{
    return 2.0 * surface_exponent(p) * VERIFY_PI * p->share;
}

static double volume_at(const rest_par *p, double r)
{
    return surface_factor(p) * pow(r, surface_exponent(p) + 1) / (surface_exponent(p) + 1);
}

static rest_state membrane_state_at(const rest_par *p, double r)
{
    const int k = surface_exponent(p);
    const double stretch = r / p->rest_radius;
    const double strain = whole_number(p->small_strain) ? stretch - 1.0 : log(stretch);
    const double thickness = p->thickness * (whole_number(p->constant_volume) ? pow(stretch, -k) : 1.0);
    const double stress = p->modulus * strain;
    const double pressure = p->outside_pressure + k * stress * thickness / r;
    const double wall = surface_factor(p) * pow(p->rest_radius, k) * p->thickness;
    return (rest_state){{[RADIUS] = r,
                         [RADIUS_LAST] = r,
                         [AREA] = volume_at(p, r),
                         [PRESSURE] = pressure,
                         [HOOP_STRESS] = stress,
                         [STRAIN] = strain,
                         [GAS_ENERGY] = pressure * volume_at(p, r) / (p->gamma - 1.0),
                         [STRAIN_ENERGY] = 0.5 * k * stress * strain * wall}};
}

/* The energy at rest less that at the start. */
static double excess_energy(double r, void *user)
{
    const rest_par *p = user;
    const rest_state s = membrane_state_at(p, r);
    const double enclosed = p->enclosed > 0.0 ? p->enclosed : p->gas_volume;
    return s.value[GAS_ENERGY] + s.value[STRAIN_ENERGY] + p->outside_pressure * (volume_at(p, r) - enclosed) -
           p->gas_pressure * p->gas_volume / (p->gamma - 1.0);
}

static floe_status rest_prepare(context *ctx, const void *par, void *prepared)
{
    rest_par p = *(const rest_par *)par;
    TRY(check_whole(ctx, "sphere", p.sphere));
    TRY(check_whole(ctx, "small_strain", p.small_strain));
    TRY(check_whole(ctx, "constant_volume", p.constant_volume));
    if (!(excess_energy(p.rest_radius, &p) < 0.0)) {
        return fail_key(ctx, KEY("gas_pressure"),
                        "%g and gas_volume = %g do not fill the membrane of rest_radius = %g against "
                        "outside_pressure = %g: it stays slack, without one shape at rest",
                        p.gas_pressure, p.gas_volume, p.rest_radius, p.outside_pressure);
    }
    double hi = p.rest_radius;
    for (int i = 0; i < 200 && excess_energy(hi, &p) < 0.0; i++) hi *= 1.25;
    const double radius = find_root(excess_energy, &p, p.rest_radius, hi);
    if (!isfinite(radius)) {
        return fail_key(ctx, KEY("modulus"), "%g and thickness = %g hold the gas at no radius: there is no rest",
                        p.modulus, p.thickness);
    }
    *(rest_state *)prepared = membrane_state_at(&p, radius);
    return FLOE_OK;
}

static floe_status rest_series(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                               double *value)
{
    (void)ctx;
    (void)par;
    (void)t;
    const rest_state *s = prepared;
    for (size_t q = 0; q < QUANTITIES; q++) {
        for (size_t i = 0; i < n; i++) value[q * n + i] = s->value[q];
    }
    return FLOE_OK;
}

/* The quarter of Y97, box 9, with the length that its volumes give, 2.199. */
static const rest_par dogbone = {.rest_radius = 2.199 / (0.5 * VERIFY_PI),
                                 .thickness = 0.1,
                                 .modulus = 1e6 / 0.91,
                                 .gas_pressure = 100.0,
                                 .gas_volume = 0.4746,
                                 .gamma = 1.4,
                                 .share = 0.25};

const reference_model reference_membrane_rest = {
    .name = "membrane_rest",
    .doc = "a membrane blown up to a circle or a sphere by the gas inside, at rest",
    .cite = "York (1997), section 6.2; York, Sulsky & Schreyer (2000), section 4.3; Sulsky & York (2000), section 8",
    .validity =
        "a gas without losses (what viscosity takes stays in it as heat) in a membrane that has come to rest: late "
        "times only. The strain energy is modulus strain^2/2 times the membrane's volume at rest, as points hold it; "
        "with a thickness that does not change it differs from the work of the stress by the order of strain^3.",
    .param_size = sizeof(rest_par),
    .params = rest_params,
    .n_params = COUNT_OF(rest_params),
    .quantities = rest_quantities,
    .n_quantities = QUANTITIES,
    .sample = &dogbone,
    .sample_end = 1.0,
    .prepared_size = sizeof(rest_state),
    .prepare = rest_prepare,
    .series = rest_series,
};

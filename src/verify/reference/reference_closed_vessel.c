/* Grains that burn in a closed vessel: dm/dt = -rho S r_0 (p/p_0)^n, p = (gamma - 1) U/(V - m/rho), U the energy of the
 * gas, which takes the grains' energy and the heat with every mass; the grains are incompressible and exchange no heat.
 * Their surface is S = sigma m/rho, or that of a body that keeps its form, S = S_0 (m/m_0)^f. */
#include "verify/ode.h"
#include "verify/reference.h"
#include "verify/verify_internal.h"

typedef struct vessel_par {
    double volume, grain_mass, grain_density, grain_energy, heat;
    double gas_mass, gas_energy, gamma;
    double velocity, pressure, exponent, specific_surface, surface, form;
} vessel_par;

static const param_spec vessel_params[] = {
    PAR_POSITIVE(vessel_par, volume, "m3", NAN, "of the vessel"),
    PAR_POSITIVE(vessel_par, grain_mass, "kg", NAN, "mass of the grains at t = 0"),
    PAR_POSITIVE(vessel_par, grain_density, "kg/m3", NAN, "density of the grains"),
    PAR_NONNEGATIVE(vessel_par, grain_energy, "J/kg", NAN, "internal energy of the grains"),
    PAR_NONNEGATIVE(vessel_par, heat, "J/kg", NAN, "that each kg gives off"),
    PAR_POSITIVE(vessel_par, gas_mass, "kg", NAN, "mass of the gas at t = 0"),
    PAR_POSITIVE(vessel_par, gas_energy, "J/kg", NAN, "its internal energy at t = 0"),
    PAR_POSITIVE(vessel_par, gamma, "1", NAN, "ratio of specific heats of the gas"),
    PAR_POSITIVE(vessel_par, velocity, "m/s", NAN, "r_0, at which the surface recedes at the pressure below"),
    PAR_POSITIVE(vessel_par, pressure, "Pa", 1e6, "p_0"),
    PAR_BETWEEN(vessel_par, exponent, "1", 0.0, 3.0, NAN, "n of r = r_0 (p/p_0)^n"),
    PAR_NONNEGATIVE(vessel_par, specific_surface, "1/m", 0.0,
                    "sigma, surface over volume of what is left of the grains"),
    PAR_NONNEGATIVE(vessel_par, surface, "m2", 0.0, "S_0, instead of sigma: of a body, at t = 0"),
    PAR_BETWEEN(vessel_par, form, "1", 0.0, 1.0, 1.0,
                "f: 0 for a slab, 1/2 for a cylinder or a square bar, 2/3 for a ball or a cube"),
};

enum { GRAINS, GAS, PRESSURE, BURN_RATE, QUANTITIES };

static const reference_quantity vessel_quantities[QUANTITIES] = {
    [GRAINS] = {"grains", "kg", "mass of the grains", NULL, false},
    [GAS] = {"gas", "kg", "mass of the gas", NULL, false},
    [PRESSURE] = {"pressure", "Pa", "pressure of the gas", NULL, false},
    [BURN_RATE] = {"rate", "kg/s", "rate of the mass of the grains", "grains", false},
};

typedef struct vessel {
    const vessel_par *p;
    size_t n;
    double *value;
} vessel;

static double pressure_of(const vessel_par *p, double mass)
{
    const double energy = p->gas_mass * p->gas_energy + (p->grain_mass - mass) * (p->grain_energy + p->heat);
    return (p->gamma - 1.0) * energy / (p->volume - mass / p->grain_density);
}

static double surface_of(const vessel_par *p, double mass)
{
    if (!(mass > 0.0)) return 0.0;
    if (p->surface > 0.0) return p->surface * pow(mass / p->grain_mass, p->form);
    return p->specific_surface * mass / p->grain_density;
}

static double vessel_rate_of(const vessel_par *p, double mass)
{
    return -p->grain_density * surface_of(p, mass) * p->velocity * pow(pressure_of(p, mass) / p->pressure, p->exponent);
}

static void vessel_rate(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    dydt[0] = vessel_rate_of(((const vessel *)user)->p, y[0]);
}

static void vessel_take(size_t i, double t, const double *y, void *user)
{
    (void)t;
    const vessel *v = user;
    v->value[GRAINS * v->n + i] = y[0];
    v->value[GAS * v->n + i] = v->p->gas_mass + v->p->grain_mass - y[0];
    v->value[PRESSURE * v->n + i] = pressure_of(v->p, y[0]);
    v->value[BURN_RATE * v->n + i] = vessel_rate_of(v->p, y[0]);
}

static floe_status vessel_prepare(context *ctx, const void *par, void *prepared)
{
    (void)prepared;
    const vessel_par *p = par;
    if (!(p->surface > 0.0) == !(p->specific_surface > 0.0))
        return fail_key(ctx, KEY(p->surface > 0.0 ? "surface" : "specific_surface"),
                        "the vessel's grains have a 'specific_surface' or a 'surface', and one of them");
    if (p->grain_mass < p->volume * p->grain_density) return FLOE_OK;
    return fail_key(ctx, KEY("grain_mass"), "%g kg of grains do not fit into %g m3", p->grain_mass, p->volume);
}

static floe_status vessel_series(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                                 double *value)
{
    (void)prepared;
    const vessel_par *p = par;
    vessel v = {.p = p, .n = n, .value = value};
    const double absolute = 1e-13 * p->grain_mass;
    const ode system = {
        .n = 1, .rate = vessel_rate, .take = vessel_take, .user = &v, .relative = 1e-11, .absolute = &absolute};
    return ode_solve(ctx, &system, &p->grain_mass, n, t);
}

static const reference_scalar vessel_scalars[] = {{"end_pressure", "Pa", "pressure when all is burnt"}};

static double vessel_scalar(const void *par, const void *prepared, size_t i)
{
    (void)prepared;
    (void)i;
    return pressure_of(par, 0.0);
}

static const vessel_par sample_par = {.volume = 1.0,
                                      .grain_mass = 3.2,
                                      .grain_density = 1600.0,
                                      .grain_energy = 3e5,
                                      .heat = 3e6,
                                      .gas_mass = 0.95,
                                      .gas_energy = 4.2e5,
                                      .gamma = 1.25,
                                      .velocity = 0.1,
                                      .pressure = 1e6,
                                      .exponent = 0.8,
                                      .specific_surface = 2000.0};

const reference_model reference_closed_vessel = {
    .name = "closed_vessel",
    .doc = "grains that burn in a closed vessel",
    .cite = "P. Vieille (1893), the law; energy balance of a closed bomb",
    .validity =
        "uniform; incompressible grains, an ideal gas, no heat between them; grains have no energy of compression.",
    .param_size = sizeof(vessel_par),
    .params = vessel_params,
    .n_params = COUNT_OF(vessel_params),
    .quantities = vessel_quantities,
    .n_quantities = QUANTITIES,
    .scalars = vessel_scalars,
    .n_scalars = COUNT_OF(vessel_scalars),
    .sample = &sample_par,
    .sample_end = 0.02,
    .prepare = vessel_prepare,
    .series = vessel_series,
    .scalar = vessel_scalar,
};

/* Manufactured flow of a viscous, heat-conducting ideal gas: smooth, unsteady, compressible, on a periodic box. Density
 * rests, and momentum has no divergence, so that mass needs no source; momentum and energy do. */
#include "verify/verify_internal.h"

typedef struct flow_par {
    double density, pressure, gamma, heat_capacity, viscosity, bulk_viscosity, conductivity;
    double speed, swing, ripple, wavelength, frequency;
} flow_par;

static const param_spec flow_params[] = {
    PAR_POSITIVE(flow_par, density, "kg/m3", 1.0, "mean density"),
    PAR_POSITIVE(flow_par, pressure, "Pa", 1.0, "mean pressure"),
    PAR_BETWEEN(flow_par, gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats, over 1"),
    PAR_POSITIVE(flow_par, heat_capacity, "J/kg/K", 1.0, "c_v"),
    PAR_NONNEGATIVE(flow_par, viscosity, "Pa s", 0.0, "dynamic viscosity"),
    PAR_NONNEGATIVE(flow_par, bulk_viscosity, "Pa s", 0.0, "bulk viscosity"),
    PAR_NONNEGATIVE(flow_par, conductivity, "W/m/K", 0.0, "thermal conductivity"),
    PAR_ANY(flow_par, speed, "m/s", NAN,
            "U of the momentum rho U (1 + swing sin omega t) (sin kx cos ky, -cos kx sin ky, 1)"),
    PAR_BETWEEN(flow_par, swing, "1", 0.0, 10.0, 0.5, "swing of the momentum and of the pressure's ripple"),
    PAR_BETWEEN(flow_par, ripple, "1", 0.0, 0.5, 0.1, "ripple of density and pressure over their means"),
    PAR_POSITIVE(flow_par, wavelength, "m", 1.0, "wavelength, along all axes"),
    PAR_POSITIVE(flow_par, frequency, "Hz", 1.0, "of the swing"),
};

static floe_status flow_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    (void)prepared;
    const flow_par *p = par;
    if (p->gamma > 1.0) return FLOE_OK;
    return fail_key(ctx, KEY("gamma"), "%g: must be over 1", p->gamma);
}

/* A function with its first and second derivatives by x, y, z and t: what arithmetic on such makes of them. */
enum { JET_AXES = 4, JET_TIME = 3 };
typedef struct jet {
    double v, d[JET_AXES], dd[JET_AXES][JET_AXES];
} jet;

static jet jet_of(double constant)
{
    return (jet){.v = constant};
}

static jet jet_sum(double a, jet x, double b, jet y)
{
    jet out = {.v = a * x.v + b * y.v};
    for (int i = 0; i < JET_AXES; i++) {
        out.d[i] = a * x.d[i] + b * y.d[i];
        for (int j = 0; j < JET_AXES; j++) out.dd[i][j] = a * x.dd[i][j] + b * y.dd[i][j];
    }
    return out;
}

static jet jet_product(jet x, jet y)
{
    jet out = {.v = x.v * y.v};
    for (int i = 0; i < JET_AXES; i++) {
        out.d[i] = x.d[i] * y.v + x.v * y.d[i];
        for (int j = 0; j < JET_AXES; j++)
            out.dd[i][j] = x.dd[i][j] * y.v + x.d[i] * y.d[j] + x.d[j] * y.d[i] + x.v * y.dd[i][j];
    }
    return out;
}

/* f(x) of a function with the derivatives f1 and f2 there. */
static jet jet_chain(jet x, double f, double f1, double f2)
{
    jet out = {.v = f};
    for (int i = 0; i < JET_AXES; i++) {
        out.d[i] = f1 * x.d[i];
        for (int j = 0; j < JET_AXES; j++) out.dd[i][j] = f1 * x.dd[i][j] + f2 * x.d[i] * x.d[j];
    }
    return out;
}

static jet jet_inverse(jet x)
{
    return jet_chain(x, 1.0 / x.v, -1.0 / (x.v * x.v), 2.0 / (x.v * x.v * x.v));
}

/* sin(rate x_axis + shift) */
static jet jet_sine(int axis, double rate, double at, double shift)
{
    const double a = rate * at + shift;
    jet out = {.v = sin(a)};
    out.d[axis] = rate * cos(a);
    out.dd[axis][axis] = -rate * rate * sin(a);
    return out;
}

typedef struct flow_state {
    jet density, pressure, velocity[3], temperature;
} flow_state;

static flow_state flow_at(const flow_par *p, int dim, const double x[3], double t)
{
    const double k = 2.0 * VERIFY_PI / p->wavelength, quarter = 0.5 * VERIFY_PI;
    const jet one = jet_of(1.0),
              clock = jet_sum(1.0, one, p->swing, jet_sine(JET_TIME, 2.0 * VERIFY_PI * p->frequency, t, 0.0));
    jet wave = jet_sine(0, k, x[0], 0.3), bump = jet_sine(0, k, x[0], 1.1);
    for (int a = 1; a < dim; a++) {
        wave = jet_product(wave, jet_sine(a, k, x[a], 0.7));
        bump = jet_product(bump, jet_sine(a, k, x[a], -0.4));
    }
    flow_state s;
    s.density = jet_sum(p->density, one, p->density * p->ripple, wave);
    s.pressure = jet_sum(p->pressure, one, p->pressure * p->ripple, jet_product(clock, bump));
    const jet lean = jet_product(jet_sum(p->density * p->speed, clock, 0.0, one), jet_inverse(s.density));
    jet along = one, across = jet_of(0.0);
    if (dim > 1) {
        along = jet_product(jet_sine(0, k, x[0], 0.0), jet_sine(1, k, x[1], quarter));
        across = jet_product(jet_sine(0, k, x[0], quarter), jet_sine(1, k, x[1], 0.0));
    }
    s.velocity[0] = jet_product(lean, along);
    s.velocity[1] = jet_sum(-1.0, jet_product(lean, across), 0.0, one);
    s.velocity[2] = lean;
    const double R = (p->gamma - 1.0) * p->heat_capacity;
    s.temperature = jet_sum(1.0 / R, jet_product(s.pressure, jet_inverse(s.density)), 0.0, one);
    return s;
}

static double flow_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                         double t)
{
    (void)prepared;
    const flow_par *p = par;
    const flow_state s = flow_at(p, dim, x, t);
    if (is_velocity(quantity)) {
        const int a = (int)quantity - EXACT_VELOCITY_X;
        return a < dim ? s.velocity[a].v : 0.0;
    }
    switch (quantity) {
    case EXACT_DENSITY: return s.density.v;
    case EXACT_PRESSURE: return s.pressure.v;
    case EXACT_TEMPERATURE: return s.temperature.v;
    case EXACT_INTERNAL_ENERGY: return p->heat_capacity * s.temperature.v;
    default: return NAN;
    }
}

/* div u and its gradient. */
static double velocity_divergence(const flow_state *s, int dim, double gradient[3])
{
    double div = 0.0;
    for (int a = 0; a < dim; a++) {
        gradient[a] = 0.0;
        div += s->velocity[a].d[a];
    }
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) gradient[a] += s->velocity[b].dd[b][a];
    return div;
}

/* b = Du/Dt + [grad p - mu lap u - (zeta + mu/3) grad div u] / rho */
static void flow_body_force(const void *par, const void *prepared, int dim, const double x[3], double t,
                            double force[3])
{
    (void)prepared;
    const flow_par *p = par;
    const flow_state s = flow_at(p, dim, x, t);
    double gradient[3];
    velocity_divergence(&s, dim, gradient);
    for (int a = 0; a < dim; a++) {
        double stress_term = s.pressure.d[a] - (p->bulk_viscosity + p->viscosity / 3.0) * gradient[a];
        force[a] = s.velocity[a].d[JET_TIME];
        for (int b = 0; b < dim; b++) {
            force[a] += s.velocity[b].v * s.velocity[a].d[b];
            stress_term -= p->viscosity * s.velocity[a].dd[b][b];
        }
        force[a] += stress_term / s.density.v;
    }
}

/* Q = rho c_v DT/Dt + p div u - tau:grad u - k lap T */
static double flow_heat_source(const void *par, const void *prepared, int dim, const double x[3], double t)
{
    (void)prepared;
    const flow_par *p = par;
    const flow_state s = flow_at(p, dim, x, t);
    double gradient[3];
    const double div = velocity_divergence(&s, dim, gradient), mu = p->viscosity;
    double rate = s.temperature.d[JET_TIME],
           heat = s.pressure.v * div - (p->bulk_viscosity - 2.0 / 3.0 * mu) * div * div;
    for (int a = 0; a < dim; a++) {
        rate += s.velocity[a].v * s.temperature.d[a];
        heat -= p->conductivity * s.temperature.dd[a][a];
        for (int b = 0; b < dim; b++) heat -= mu * (s.velocity[a].d[b] + s.velocity[b].d[a]) * s.velocity[a].d[b];
    }
    return s.density.v * p->heat_capacity * rate + heat;
}

static const flow_par sample_par = {.density = 1.3,
                                    .pressure = 2.0,
                                    .gamma = 1.4,
                                    .heat_capacity = 2.5,
                                    .viscosity = 0.05,
                                    .bulk_viscosity = 0.02,
                                    .conductivity = 0.2,
                                    .speed = 0.6,
                                    .swing = 0.5,
                                    .ripple = 0.2,
                                    .wavelength = 1.0,
                                    .frequency = 1.0};

const exact_model exact_flow_mms = {
    .name = "flow_mms",
    .doc = "manufactured unsteady flow of a viscous, heat-conducting ideal gas, held by a force and a heat source",
    .cite = "Roache, J. Fluids Eng. 124 (2002) 4 (the method); the flow is floe's own",
    .validity =
        "ideal gas, periodic; needs `verify.sources`. With neither viscosity nor conductivity, the Euler equations.",
    .equations = EXACT_NAVIER_STOKES,
    .param_size = sizeof(flow_par),
    .params = flow_params,
    .n_params = COUNT_OF(flow_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE,
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.0, 0.0, 0.0}, .hi = {1.0, 1.0, 1.0}, .t = 0.3},
    .prepare = flow_prepare,
    .value = flow_value,
    .body_force = flow_body_force,
    .heat_source = flow_heat_source,
};

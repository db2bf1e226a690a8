/* Sedov's blast: energy set free at a plane, a line or a point of a gas without pressure.
 *
 * J. R. Kamm, F. X. Timmes, LA-UR-07-2849 (2007), for uniform density: with j = geometry + 1 and V the similarity
 * variable, x_1 = a V, x_2 = b (c V - 1), x_3 = d (1 - e V), x_4 = b (1 - c V/gamma),
 *     lambda = r/r_shock = x_1^-A0 x_2^-A2 x_3^-A1,    u/u_2 = x_1 lambda,
 *     rho/rho_2 = x_2^A3 x_3^A4 x_4^A5,                p/p_2 = x_1^(A0 j) x_3^(A4 - 2 A1) x_4^(1 + A5).
 * The parameter here is s = x_2^-A2, from 0 at the centre to 1 at the shock, in which lambda is smooth. */
#include "verify/radial.h"

#include <gsl/gsl_integration.h>

typedef struct sedov_par {
    double energy, density, gamma, pressure, start;
    radial_par radial;
} sedov_par;

static const param_spec sedov_params[] = {
    PAR_POSITIVE(sedov_par, energy, "J", NAN,
                 "energy of the blast: per area of the plane (both sides), per length of the line, of the point"),
    PAR_POSITIVE(sedov_par, density, "kg/m3", 1.0, "density ahead"),
    PAR_BETWEEN(sedov_par, gamma, "1", 1.05, 1.95, 1.4, "ratio of specific heats"),
    PAR_NONNEGATIVE(sedov_par, pressure, "Pa", 0.0, "pressure ahead, to begin a run with: far below that of the blast"),
    PAR_NONNEGATIVE(sedov_par, start, "s", 0.0, "age of the blast at t = 0"),
    PAR_RADIAL(sedov_par, radial),
};

typedef struct sedov {
    double j, gamma;
    double a, b, c, d, e;
    double A0, A1, A2, A3, A4, A5;
    double alpha; /* E t^2 = alpha rho r^(j + 2) at the shock */
} sedov;

/* Relative to what is behind the shock. */
typedef struct blast_state {
    double lambda, slope; /* r/r_shock, and its derivative by s */
    double density, velocity, pressure;
} blast_state;

static sedov exponents_of(double j, double g)
{
    sedov q = {.j = j, .gamma = g};
    const double k = j + 2.0, rest = 2.0 + j * (g - 1.0), thin = 2.0 * (g - 1.0) + j, soft = j * (2.0 - g);
    q.a = 0.25 * k * (g + 1.0);
    q.b = (g + 1.0) / (g - 1.0);
    q.c = 0.5 * k * g;
    q.d = k * (g + 1.0) / (k * (g + 1.0) - 2.0 * rest);
    q.e = 0.5 * rest;
    q.A0 = 2.0 / k;
    q.A2 = -(g - 1.0) / thin;
    q.A1 = k * g / rest * (2.0 * soft / (g * k * k) - q.A2);
    q.A3 = j / thin;
    q.A4 = k * j * q.A1 / soft;
    q.A5 = -2.0 * j / soft;
    return q;
}

static blast_state blast_at(const sedov *q, double s)
{
    const double m = -1.0 / q->A2, x2 = pow(s, m), V = (1.0 + x2 / q->b) / q->c;
    const double x1 = q->a * V, x3 = q->d * (1.0 - q->e * V), x4 = q->b * (1.0 - q->c * V / q->gamma);
    const double rate = s > 0.0 ? m * x2 / (s * q->b * q->c) : 0.0; /* dV/ds */
    const double shape = pow(x1, -q->A0) * pow(x3, -q->A1);
    blast_state out = {.lambda = s * shape};
    out.slope = shape * (1.0 + s * rate * (q->A1 * q->d * q->e / x3 - q->A0 * q->a / x1));
    out.velocity = x1 * out.lambda;
    out.density = pow(x2, q->A3) * pow(x3, q->A4) * pow(x4, q->A5);
    out.pressure = pow(x1, q->A0 * q->j) * pow(x3, q->A4 - 2.0 * q->A1) * pow(x4, 1.0 + q->A5);
    return out;
}

/* Newton from s = lambda, which is not far off. */
static blast_state blast_at_radius(const sedov *q, double lambda)
{
    double s = lambda;
    blast_state out = blast_at(q, s);
    for (int k = 0; k < 50; k++) {
        const double step = (lambda - out.lambda) / out.slope;
        s = fmin(fmax(s + step, 0.5 * s), 1.0);
        out = blast_at(q, s);
        if (fabs(step) <= 1e-15 * s) break;
    }
    return out;
}

static double energy_density(double s, void *user)
{
    const sedov *q = user;
    const blast_state b = blast_at(q, s);
    return (b.density * b.velocity * b.velocity + b.pressure) * pow(b.lambda, q->j - 1.0) * b.slope;
}

static floe_status sedov_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    static const double surface[] = {2.0, 2.0 * VERIFY_PI, 4.0 * VERIFY_PI};
    enum { INTERVALS = 200 };
    const sedov_par *p = par;
    sedov *q = prepared;
    TRY(radial_check(ctx, &p->radial, dim));
    *q = exponents_of(p->radial.geometry + 1.0, p->gamma);
    gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(INTERVALS);
    if (workspace == NULL) return fail(ctx, FLOE_NO_MEMORY, "no memory for a quadrature");
    const gsl_function f = {.function = energy_density, .params = q};
    double integral, error;
    const int status = gsl_integration_qags(&f, 0.0, 1.0, 0.0, 1e-12, INTERVALS, workspace, &integral, &error);
    gsl_integration_workspace_free(workspace);
    if (status != 0 && !(error <= 1e-10 * integral))
        return fail_key(ctx, KEY("gamma"), "%g: the energy of the blast cannot be integrated", p->gamma);
    const double g = p->gamma;
    q->alpha = surface[whole_number(p->radial.geometry)] * q->A0 * q->A0 * 2.0 / (g * g - 1.0) * integral;
    return FLOE_OK;
}

static double sedov_shock_radius(const sedov_par *p, const sedov *q, double t)
{
    const double age = fmax(t + p->start, 0.0);
    return pow(p->energy * age * age / (q->alpha * p->density), 1.0 / (q->j + 2.0));
}

static double shock_speed(const sedov_par *p, const sedov *q, double t)
{
    return q->A0 * sedov_shock_radius(p, q, t) / (t + p->start);
}

static double sedov_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                          double t)
{
    const sedov_par *p = par;
    const sedov *q = prepared;
    const double g = p->gamma, r = radial_distance(&p->radial, dim, x), front = sedov_shock_radius(p, q, t);
    double density = p->density, velocity = 0.0, pressure = p->pressure;
    if (r < front) {
        const double D = shock_speed(p, q, t);
        const blast_state b = blast_at_radius(q, r / front);
        density *= (g + 1.0) / (g - 1.0) * b.density;
        velocity = 2.0 * D / (g + 1.0) * b.velocity;
        pressure = 2.0 * p->density * D * D / (g + 1.0) * b.pressure;
    }
    if (is_velocity(quantity)) return radial_component(&p->radial, dim, quantity, x, velocity);
    return gas_value(quantity, density, pressure, g, 0.0);
}

static void sedov_breaks(const void *par, const void *prepared, double t, exact_breaks *out)
{
    const sedov_par *p = par;
    radial_breaks(&p->radial, sedov_shock_radius(p, prepared, t), out);
}

enum { SHOCK, SPEED, ALPHA };

static const exact_scalar sedov_scalars[] = {
    [SHOCK] = {"shock", "m", "distance of the shock from the centre"},
    [SPEED] = {"shock_speed", "m/s", "its speed"},
    [ALPHA] = {"alpha", "1", "E t^2/(rho r^(j + 2)) at the shock, j = geometry + 1"},
};

static double sedov_scalar(const void *par, const void *prepared, size_t i, double t)
{
    const sedov *q = prepared;
    switch (i) {
    case SHOCK: return sedov_shock_radius(par, q, t);
    case SPEED: return shock_speed(par, q, t);
    case ALPHA: return q->alpha;
    default: return NAN;
    }
}

static const sedov_par sphere = {.energy = 0.851072, .density = 1.0, .gamma = 1.4, .radial = {.geometry = 2.0}};

const exact_model exact_sedov = {
    .name = "sedov",
    .doc = "a blast from a plane, a line or a point into a gas without pressure",
    .cite = "L. I. Sedov, Similarity and Dimensional Methods in Mechanics (1959), chapter 4; J. R. Kamm, F. X. Timmes, "
            "LA-UR-07-2849 (2007)",
    .validity = "an ideal inviscid gas without pressure ahead; the centre itself has no density and an infinite "
                "temperature.",
    .equations = EXACT_EULER,
    .param_size = sizeof(sedov_par),
    .params = sedov_params,
    .n_params = COUNT_OF(sedov_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides =
        EXACT_BIT(EXACT_DENSITY) | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_INTERNAL_ENERGY),
    .scalars = sedov_scalars,
    .n_scalars = COUNT_OF(sedov_scalars),
    .sample = {.par = &sphere, .dim = 3, .lo = {0.4, 0.3, 0.4}, .hi = {0.5, 0.4, 0.5}, .t = 1.0},
    .prepared_size = sizeof(sedov),
    .prepare = sedov_prepare,
    .value = sedov_value,
    .breaks = sedov_breaks,
    .scalar = sedov_scalar,
};

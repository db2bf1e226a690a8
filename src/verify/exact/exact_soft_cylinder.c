/* The pressurised thick cylinder of neo-Hookean material in plane strain, at any strain.
 *
 * With r(R) the place of what was at R, a = r' and b = r/R, the nominal stresses are P_r = mu (a - 1/a) + lambda ln(a
 * b)/a and P_theta, the same with b for a, and balance is dP_r/dR + (P_r - P_theta)/R = 0. As db/dR = (a - b)/R this is
 * an equation for a, integrated from the bore, where the pressure gives a, with the b there by which P_r vanishes
 * outside. Fourth order in 2048 steps; between them r is the cubic through r and r'. */
#include "verify/verify_internal.h"

enum { STEPS = 2048 };

typedef struct soft_par {
    double inner_radius, outer_radius, inner_pressure, bulk_modulus, shear_modulus, dead;
    double centre[3];
} soft_par;

static const param_spec soft_params[] = {
    PAR_POSITIVE(soft_par, inner_radius, "m", NAN, "radius of the bore at rest"),
    PAR_POSITIVE(soft_par, outer_radius, "m", NAN, "outer radius at rest"),
    PAR_NONNEGATIVE(soft_par, inner_pressure, "Pa", NAN, "pressure in the bore, less the reference pressure"),
    PAR_POSITIVE(soft_par, bulk_modulus, "Pa", NAN, "bulk modulus K; lambda = K - 2G/3"),
    PAR_POSITIVE(soft_par, shear_modulus, "Pa", NAN, "shear modulus G = mu"),
    PAR_BETWEEN(soft_par, dead, "1", 0.0, 1.0, 0.0,
                "0: the pressure is per area as it is, as that of a gas or a load; 1: per area at rest, as that of a "
                "load with `dead`"),
    PAR_VECTOR(soft_par, centre, "m", PARAM_ANY, 0.0, "a point of the axis (its z is ignored)"),
};

typedef struct soft_profile {
    double lambda, mu;                 /* Pa */
    double step;                       /* m */
    double a[STEPS + 1], r[STEPS + 1]; /* 1, m: from the bore on */
} soft_profile;

/* P along a principal axis of stretch x, y being the other in the plane. */
static double nominal_stress(const soft_profile *c, double x, double y)
{
    return c->mu * (x - 1.0 / x) + c->lambda * log(x * y) / x;
}

static double rate_of_a(const soft_profile *c, double R, double a, double b)
{
    const double by_a = c->mu * (1.0 + 1.0 / (a * a)) + c->lambda * (1.0 - log(a * b)) / (a * a);
    const double by_b = c->lambda / (a * b);
    return -((nominal_stress(c, a, b) - nominal_stress(c, b, a)) + by_b * (a - b)) / (R * by_a);
}

/* The bore's condition for a, given b. */
typedef struct bore {
    const soft_par *par;
    soft_profile *profile;
    double b;
} bore;

static double bore_balance(double a, void *user)
{
    const bore *w = user;
    return nominal_stress(w->profile, a, w->b) + w->par->inner_pressure * (w->par->dead > 0.5 ? 1.0 : w->b);
}

/* P_r outside for b at the bore; fills the profile. */
static double outside_stress(double b, void *user)
{
    bore *w = user;
    soft_profile *c = w->profile;
    w->b = b;
    double R = w->par->inner_radius, a = find_root(bore_balance, w, 0.02, 1.5);
    c->a[0] = a;
    c->r[0] = b * R;
    for (int k = 0; k < STEPS; k++, R += c->step) {
        const double h = c->step, r = c->r[k];
        const double a1 = rate_of_a(c, R, a, r / R);
        const double a2 = rate_of_a(c, R + 0.5 * h, a + 0.5 * h * a1, (r + 0.5 * h * a) / (R + 0.5 * h));
        const double r3 = r + 0.5 * h * (a + 0.5 * h * a1);
        const double a3 = rate_of_a(c, R + 0.5 * h, a + 0.5 * h * a2, r3 / (R + 0.5 * h));
        const double a4 = rate_of_a(c, R + h, a + h * a3, (r + h * (a + 0.5 * h * a2)) / (R + h));
        c->r[k + 1] = r + h * (a + h / 6.0 * (a1 + a2 + a3));
        a += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        c->a[k + 1] = a;
    }
    return nominal_stress(c, a, c->r[STEPS] / w->par->outer_radius);
}

static floe_status soft_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    const soft_par *p = par;
    soft_profile *c = prepared;
    if (!(p->outer_radius > p->inner_radius))
        return fail_key(ctx, KEY("outer_radius"), "%g m: must be over inner_radius = %g m", p->outer_radius,
                        p->inner_radius);
    c->mu = p->shear_modulus;
    c->lambda = p->bulk_modulus - 2.0 / 3.0 * c->mu;
    c->step = (p->outer_radius - p->inner_radius) / STEPS;
    bore w = {p, c, 1.0};
    const double b = find_root(outside_stress, &w, 1.0, 1.5);
    if (!isnan(b) && !isnan(outside_stress(b, &w))) return FLOE_OK;
    return fail_key(ctx, KEY("inner_pressure"),
                    "%g Pa: opens the bore to more than 1.5 times its radius; it must be less", p->inner_pressure);
}

/* r and r' at R. */
static void place_at(const soft_par *p, const soft_profile *c, double R, double *r, double *a)
{
    const double at = (R - p->inner_radius) / c->step;
    const int k = at < 0.0 ? 0 : at >= STEPS ? STEPS - 1 : (int)at;
    const double s = at - k, h = c->step;
    const double rise = c->r[k + 1] - c->r[k], bend = h * (c->a[k] + c->a[k + 1]) - 2.0 * rise,
                 turn = 3.0 * rise - h * (2.0 * c->a[k] + c->a[k + 1]);
    *r = c->r[k] + s * (h * c->a[k] + s * (turn + s * bend));
    *a = c->a[k] + s * (2.0 * turn + 3.0 * s * bend) / h;
}

static double soft_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                         double t)
{
    (void)t;
    const soft_par *p = par;
    const soft_profile *c = prepared;
    const double from[2] = {x[0] - p->centre[0], dim > 1 ? x[1] - p->centre[1] : 0.0};
    const double R = hypot(from[0], from[1]), cosine = from[0] / R, sine = from[1] / R;
    double r, a;
    place_at(p, c, R, &r, &a);
    const double b = r / R, radial = nominal_stress(c, a, b) / b, hoop = nominal_stress(c, b, a) / a;
    switch (quantity) {
    case EXACT_SIGMA_R: return radial;
    case EXACT_SIGMA_THETA: return hoop;
    case EXACT_STRESS_XX: return radial * cosine * cosine + hoop * sine * sine;
    case EXACT_STRESS_YY: return radial * sine * sine + hoop * cosine * cosine;
    case EXACT_STRESS_XY: return (radial - hoop) * sine * cosine;
    case EXACT_STRESS_ZZ: return c->lambda * log(a * b) / (a * b);
    case EXACT_DISPLACEMENT_X: return (b - 1.0) * from[0];
    case EXACT_DISPLACEMENT_Y: return (b - 1.0) * from[1];
    default:
        return is_velocity(quantity) || is_displacement(quantity) || quantity == EXACT_STRESS_YZ ||
                       quantity == EXACT_STRESS_ZX
                   ? 0.0
                   : (double)NAN;
    }
}

static const exact_scalar soft_scalars[] = {
    {"bore_displacement", "m", "radial displacement of the bore"},
};

static double soft_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)i;
    (void)t;
    return ((const soft_profile *)prepared)->r[0] - ((const soft_par *)par)->inner_radius;
}

static const soft_par sample_par = {.inner_radius = 0.5,
                                    .outer_radius = 1.0,
                                    .inner_pressure = 2e7,
                                    .bulk_modulus = 1e9,
                                    .shear_modulus = 4e8,
                                    .dead = 1.0};

const exact_model exact_soft_cylinder = {
    .name = "soft_cylinder",
    .doc = "pressurised neo-Hookean thick cylinder at rest at large strain, plane strain",
    .cite = "the radial balance of A. E. Green & W. Zerna, Theoretical Elasticity, 2nd ed. (1968), section 3.10, "
            "integrated here",
    .validity = "x the place before the load (R); strain energy lambda/2 (ln J)^2 - mu ln J + mu/2 (tr C - 3) with "
                "lambda = K - 2G/3; at rest; off the wall the profile is continued by its last cubic.",
    .equations = EXACT_LARGE_SOLID,
    .param_size = sizeof(soft_par),
    .params = soft_params,
    .n_params = COUNT_OF(soft_params),
    .min_dim = 2,
    .max_dim = 2,
    .provides = EXACT_STRESSES | EXACT_BIT(EXACT_SIGMA_R) | EXACT_BIT(EXACT_SIGMA_THETA) | EXACT_DISPLACEMENTS |
                EXACT_VELOCITIES,
    .scalars = soft_scalars,
    .n_scalars = COUNT_OF(soft_scalars),
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.4, 0.4}, .hi = {0.68, 0.68}},
    .prepared_size = sizeof(soft_profile),
    .prepare = soft_prepare,
    .value = soft_value,
    .scalar = soft_scalar,
};

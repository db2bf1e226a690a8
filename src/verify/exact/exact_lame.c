/* The pressurised thick cylinder in plane strain. */
#include "verify/annulus.h"

static const param_spec lame_params[] = ANNULUS_PARAMS("bore", "a point of the axis (its z is ignored)");

/* sigma_r = mean - bend/r^2, sigma_theta = mean + bend/r^2. */
typedef struct lame_constants {
    double mean;    /* Pa */
    double bend;    /* Pa m2 */
    double poisson; /* 1 */
} lame_constants;

static floe_status lame_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    const annulus_par *p = par;
    lame_constants *c = prepared;
    TRY(annulus_check(ctx, p));
    const double inner = p->inner_radius * p->inner_radius;
    const double outer = p->outer_radius * p->outer_radius;
    c->mean = (p->inner_pressure * inner - p->outer_pressure * outer) / (outer - inner);
    c->bend = (p->inner_pressure - p->outer_pressure) * inner * outer / (outer - inner);
    c->poisson = 0.5 * (3.0 * p->bulk_modulus - 2.0 * p->shear_modulus) / (3.0 * p->bulk_modulus + p->shear_modulus);
    return FLOE_OK;
}

static double lame_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                         double t)
{
    (void)t;
    const annulus_par *p = par;
    const lame_constants *c = prepared;
    const double from[2] = {x[0] - p->centre[0], dim > 1 ? x[1] - p->centre[1] : 0.0};
    const double square = from[0] * from[0] + from[1] * from[1];
    const double bend = c->bend / square;
    /* cos and sin of twice the angle */
    const double cos2 = (from[0] * from[0] - from[1] * from[1]) / square;
    const double sin2 = 2.0 * from[0] * from[1] / square;
    /* displacement over radius */
    const double stretch = 0.5 / p->shear_modulus * ((1.0 - 2.0 * c->poisson) * c->mean + bend);
    switch (quantity) {
    case EXACT_SIGMA_R: return c->mean - bend;
    case EXACT_SIGMA_THETA: return c->mean + bend;
    case EXACT_STRESS_XX: return c->mean - bend * cos2;
    case EXACT_STRESS_YY: return c->mean + bend * cos2;
    case EXACT_STRESS_XY: return -bend * sin2;
    case EXACT_STRESS_ZZ: return 2.0 * c->poisson * c->mean;
    case EXACT_PRESSURE: return -2.0 / 3.0 * (1.0 + c->poisson) * c->mean;
    case EXACT_DISPLACEMENT_X: return stretch * from[0];
    case EXACT_DISPLACEMENT_Y: return stretch * from[1];
    default:
        return is_velocity(quantity) || is_displacement(quantity) || quantity == EXACT_STRESS_YZ ||
                       quantity == EXACT_STRESS_ZX
                   ? 0.0
                   : (double)NAN;
    }
}

enum { STRESS_SUM, BORE_DISPLACEMENT };

static const exact_scalar lame_scalars[] = {
    [STRESS_SUM] = {"stress_sum", "Pa", "sigma_r + sigma_theta, the same at every radius (the bar of eq13)"},
    [BORE_DISPLACEMENT] = {"bore_displacement", "m", "radial displacement of the bore"},
};

static double lame_scalar(const void *par, const void *prepared, size_t i, double t)
{
    const annulus_par *p = par;
    const lame_constants *c = prepared;
    if (i == STRESS_SUM) return 2.0 * c->mean;
    const double bore[3] = {p->centre[0] + p->inner_radius, p->centre[1], 0.0};
    return lame_value(par, prepared, EXACT_DISPLACEMENT_X, 2, bore, t);
}

/* The bore's strain. */
static double lame_accuracy(const void *par, const void *prepared)
{
    const annulus_par *p = par;
    return fabs(lame_scalar(par, prepared, BORE_DISPLACEMENT, 0.0)) / p->inner_radius;
}

static const annulus_par guilkey = ANNULUS_SAMPLE;

const exact_model exact_lame = {
    .name = "lame",
    .doc = "pressurised thick cylinder at rest, plane strain",
    .cite = "Timoshenko & Goodier, Theory of Elasticity, 3rd ed. (1970), art. 28; Guilkey et al. (2003), eqs 11, 12",
    .validity =
        "linear elasticity, at rest, x the place before the load; the formulas are evaluated wherever r > 0, also "
        "off the wall. Against a finite-strain code it has an error of the order of the bore's strain "
        "(0.03-0.05 % for the case of Guilkey et al.).",
    .equations = EXACT_SOLID,
    .param_size = sizeof(annulus_par),
    .params = lame_params,
    .n_params = COUNT_OF(lame_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_STRESSES | EXACT_BIT(EXACT_SIGMA_R) | EXACT_BIT(EXACT_SIGMA_THETA) | EXACT_DISPLACEMENTS |
                EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE),
    .scalars = lame_scalars,
    .n_scalars = COUNT_OF(lame_scalars),
    .sample = {.par = &guilkey, .dim = 2, .lo = {0.4, 0.4}, .hi = {0.7, 0.7}},
    .prepared_size = sizeof(lame_constants),
    .prepare = lame_prepare,
    .value = lame_value,
    .accuracy = lame_accuracy,
    .scalar = lame_scalar,
};

/* The pressurised thick sphere, in three dimensions or axisymmetric (r, z). */
#include "verify/annulus.h"

static const param_spec sphere_params[] = ANNULUS_PARAMS("hollow", "centre; on the axis (r = 0) when axisymmetric");

/* sigma_r = mean - 2 bend/r^3, sigma_theta = mean + bend/r^3. */
typedef struct sphere_constants {
    double mean; /* Pa */
    double bend; /* Pa m3 */
} sphere_constants;

static floe_status sphere_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    const annulus_par *p = par;
    sphere_constants *c = prepared;
    TRY(annulus_check(ctx, p));
    const double inner = pow(p->inner_radius, 3.0);
    const double outer = pow(p->outer_radius, 3.0);
    c->mean = (p->inner_pressure * inner - p->outer_pressure * outer) / (outer - inner);
    c->bend = 0.5 * (p->inner_pressure - p->outer_pressure) * inner * outer / (outer - inner);
    return FLOE_OK;
}

/* Rows and columns of the six stress components. */
static const int stress_row[6] = {0, 1, 2, 0, 1, 2};
static const int stress_column[6] = {0, 1, 2, 1, 2, 0};

static double sphere_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                           double t)
{
    (void)t;
    const annulus_par *p = par;
    const sphere_constants *c = prepared;
    double from[3] = {0.0, 0.0, 0.0};
    double square = 0.0;
    for (int i = 0; i < dim; i++) {
        from[i] = x[i] - p->centre[i];
        square += from[i] * from[i];
    }
    const double bend = c->bend / (square * sqrt(square));
    if (quantity == EXACT_SIGMA_R) return c->mean - 2.0 * bend;
    if (quantity == EXACT_SIGMA_THETA) return c->mean + bend;
    if (quantity == EXACT_PRESSURE) return -c->mean;
    if (quantity >= EXACT_STRESS_XX && quantity <= EXACT_STRESS_ZX) {
        const int row = stress_row[quantity - EXACT_STRESS_XX];
        const int column = stress_column[quantity - EXACT_STRESS_XX];
        return (row == column ? c->mean + bend : 0.0) - 3.0 * bend * from[row] * from[column] / square;
    }
    if (is_displacement(quantity)) {
        const double stretch = c->mean / (3.0 * p->bulk_modulus) + 0.5 * bend / p->shear_modulus;
        return stretch * from[quantity - EXACT_DISPLACEMENT_X];
    }
    return is_velocity(quantity) ? 0.0 : (double)NAN;
}

/* The bore's strain. */
static double sphere_accuracy(const void *par, const void *prepared)
{
    const annulus_par *p = par;
    const double bore[3] = {p->centre[0] + p->inner_radius, p->centre[1], p->centre[2]};
    return fabs(sphere_value(par, prepared, EXACT_DISPLACEMENT_X, 3, bore, 0.0)) / p->inner_radius;
}

static const annulus_par sample_par = ANNULUS_SAMPLE;

const exact_model exact_lame_sphere = {
    .name = "lame_sphere",
    .doc = "pressurised thick sphere at rest",
    .cite = "Timoshenko & Goodier, Theory of Elasticity, 3rd ed. (1970), art. 136",
    .validity =
        "linear elasticity, at rest, x the place before the load; evaluated wherever r > 0. Three dimensions, or "
        "axisymmetric with x = (r, z), where zz is the hoop stress. Error of the order of the strain.",
    .equations = EXACT_SOLID,
    .param_size = sizeof(annulus_par),
    .params = sphere_params,
    .n_params = COUNT_OF(sphere_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_STRESSES | EXACT_BIT(EXACT_SIGMA_R) | EXACT_BIT(EXACT_SIGMA_THETA) | EXACT_DISPLACEMENTS |
                EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE),
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.3, 0.3, 0.3}, .hi = {0.5, 0.5, 0.5}},
    .prepared_size = sizeof(sphere_constants),
    .prepare = sphere_prepare,
    .value = sphere_value,
    .accuracy = sphere_accuracy,
};

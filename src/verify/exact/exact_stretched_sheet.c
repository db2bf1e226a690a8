/* A flat sheet that is drawn out along one direction and held across it: uniform plane stress. */
#include "verify/verify_internal.h"

typedef struct sheet_par {
    double modulus, poisson_ratio, rate, tautness, across;
    double origin[3];
} sheet_par;

static const param_spec sheet_params[] = {
    PAR_POSITIVE(sheet_par, modulus, "Pa", NAN, "Young's modulus E"),
    PAR_BETWEEN(sheet_par, poisson_ratio, "1", 0.0, 0.5, NAN, "Poisson's ratio"),
    PAR_ANY(sheet_par, rate, "1/s", 0.0, "of the logarithmic strain along it"),
    PAR_ANY(sheet_par, tautness, "1", 0.0, "logarithmic strain that it has in all directions at the start: -slack"),
    PAR_BETWEEN(sheet_par, across, "1", 0.0, 2.0, 2.0,
                "axis across the sheet, 0 to 2; it is drawn out along the next (after 2: 0)"),
    PAR_VECTOR(sheet_par, origin, "m", PARAM_ANY, 0.0, "a place that does not move"),
};

static floe_status sheet_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    return check_axis(ctx, ((const sheet_par *)par)->across, dim);
}

/* Stress along one direction of two, by the logarithmic strains along it and across it. */
static double plane_stress(const sheet_par *p, double strain, double other)
{
    return p->modulus / (1.0 - p->poisson_ratio * p->poisson_ratio) * (strain + p->poisson_ratio * other);
}

static double sheet_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                          double t)
{
    (void)prepared;
    (void)dim;
    const sheet_par *p = par;
    const int across = whole_number(p->across), drawn = (across + 1) % 3, fixed = (across + 2) % 3;
    const double from = x[drawn] - p->origin[drawn], strain = p->tautness + p->rate * t;
    if (is_velocity(quantity))
        return component_along(quantity, EXACT_VELOCITY_X, drawn, p->rate * from * exp(p->rate * t));
    if (is_displacement(quantity))
        return component_along(quantity, EXACT_DISPLACEMENT_X, drawn, from * expm1(p->rate * t));
    if (quantity >= EXACT_NORMAL_X) return component_along(quantity, EXACT_NORMAL_X, across, 1.0);
    return component_along(quantity, EXACT_STRESS_XX, drawn, plane_stress(p, strain, p->tautness)) +
           component_along(quantity, EXACT_STRESS_XX, fixed, plane_stress(p, p->tautness, strain));
}

static const sheet_par sample_par = {
    .modulus = 1e6, .poisson_ratio = 0.3, .rate = 2.0, .tautness = 0.01, .across = 2.0, .origin = {0.1, 0.0, 0.0}};

const exact_model exact_stretched_sheet = {
    .name = "stretched_sheet",
    .doc = "a flat membrane drawn out evenly along one direction and held across it",
    .cite = "plane stress: sigma = E/(1 - nu^2) (e + nu e'), e the logarithmic strain",
    .validity = "a membrane of plane stress, flat and taut, pulled at a place that does not move (a node) at the speed "
                "rate times its distance from the origin; x is the place at rest. Inertia is left out: an error of the "
                "order of density (rate length)^2 / modulus.",
    .equations = EXACT_SOLID,
    .param_size = sizeof(sheet_par),
    .params = sheet_params,
    .n_params = COUNT_OF(sheet_params),
    .min_dim = 3,
    .max_dim = 3,
    .provides = EXACT_STRESSES | EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_NORMALS,
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.0, 0.0, 0.0}, .hi = {1.0, 1.0, 1.0}, .t = 0.05},
    .prepare = sheet_prepare,
    .value = sheet_value,
};

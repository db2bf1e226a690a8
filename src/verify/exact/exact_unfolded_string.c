/* A string that pulls itself straight: its points fly apart from one of them, evenly. */
#include "verify/verify_internal.h"

typedef struct string_par {
    double modulus, rate, slack, axis;
    double origin[3];
} string_par;

static const param_spec string_params[] = {
    PAR_POSITIVE(string_par, modulus, "Pa", NAN, "Young's modulus E"),
    PAR_ANY(string_par, rate, "1/s", NAN, "velocity over distance from the origin, at the start"),
    PAR_ANY(string_par, slack, "1", 0.0, "logarithmic strain that is taken up before there is tension"),
    PAR_BETWEEN(string_par, axis, "1", 0.0, 2.0, 0.0, "axis along which it lies: 0, 1 or 2"),
    PAR_VECTOR(string_par, origin, "m", PARAM_ANY, 0.0, "the place that does not move"),
};

static floe_status string_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    return check_axis(ctx, ((const string_par *)par)->axis, dim);
}

static double string_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                           double t)
{
    (void)prepared;
    (void)dim;
    const string_par *p = par;
    const int axis = whole_number(p->axis);
    const double from = x[axis] - p->origin[axis], strain = log1p(p->rate * t) - p->slack;
    if (is_velocity(quantity)) return component_along(quantity, EXACT_VELOCITY_X, axis, p->rate * from);
    if (is_displacement(quantity)) return component_along(quantity, EXACT_DISPLACEMENT_X, axis, p->rate * t * from);
    return component_along(quantity, EXACT_STRESS_XX, axis, p->modulus * fmax(strain, 0.0));
}

static const string_par sample_par = {
    .modulus = 10.0, .rate = 10.0, .slack = 2.3, .axis = 0.0, .origin = {0.0, 0.0, 0.0}};

const exact_model exact_unfolded_string = {
    .name = "unfolded_string",
    .doc = "a slack string whose points fly apart evenly until it is taut, and beyond",
    .cite = "York (1997), sections 5.1 and 5.3: sigma = E ln(stretch), none while it is slack; an even motion needs no "
            "force",
    .validity =
        "a string that wrinkles (one_way), free at its ends: up to where waves from the ends have not come, which "
        "start when it is taut, with the speed (E/density)^1/2; x is the place at the start",
    .equations = EXACT_SOLID,
    .param_size = sizeof(string_par),
    .params = string_params,
    .n_params = COUNT_OF(string_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_STRESSES | EXACT_DISPLACEMENTS | EXACT_VELOCITIES,
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.0, 0.0, 0.0}, .hi = {1.0, 1.0, 1.0}, .t = 0.05},
    .prepare = string_prepare,
    .value = string_value,
};

/* Normals of what is round about a place or an axis. */
#include "verify/verify_internal.h"

typedef struct round_par {
    double about;
    double centre[3];
} round_par;

static const param_spec round_params[] = {
    PAR_BETWEEN(round_par, about, "1", 0.0, 3.0, 0.0,
                "0: the centre (circles, spheres); 1, 2, 3: the line through it along the first, second, third axis"),
    PAR_VECTOR(round_par, centre, "m", PARAM_ANY, 0.0, "a place in the middle"),
};

static floe_status round_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)prepared;
    const round_par *p = par;
    TRY(check_whole(ctx, "about", p->about));
    if (dim == 3 || whole_number(p->about) == 0) return FLOE_OK;
    return fail_key(ctx, KEY("about"), "%g is an axis of space; in a plane all is round about a centre, 0", p->about);
}

static double round_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                          double t)
{
    (void)prepared;
    (void)t;
    const round_par *p = par;
    double from[3] = {0.0}, square = 0.0;
    for (int a = 0; a < dim; a++) {
        if (a != whole_number(p->about) - 1) from[a] = x[a] - p->centre[a];
        square += from[a] * from[a];
    }
    return from[quantity - EXACT_NORMAL_X] / sqrt(square);
}

static const round_par sample_par = {.about = 2.0, .centre = {0.1, 0.2, 0.3}};

const exact_model exact_round = {
    .name = "round",
    .doc = "a circle, a sphere or a cylinder of any radius: its normals",
    .cite = "geometry: normals of a surface of revolution about its middle lead away from it",
    .validity = "a membrane that is round about the centre, or the axis, at any time.",
    .equations = EXACT_OUTLINE,
    .param_size = sizeof(round_par),
    .params = round_params,
    .n_params = COUNT_OF(round_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_NORMALS,
    .sample = {.par = &sample_par, .dim = 3, .lo = {0.6, 0.0, 0.7}, .hi = {0.9, 1.0, 1.1}},
    .prepare = round_prepare,
    .value = round_value,
};

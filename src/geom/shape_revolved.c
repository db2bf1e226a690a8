/* A plane shape turned once about z. `moved` has it about other directions. */
#include "geom/shape.h"

#include <math.h>

typedef struct revolved_par {
    shape of;
    double centre[3]; /* m */
    double extent;    /* m, of the section */
} revolved_par;

static const param_spec revolved_params[] = {
    PAR_MODEL(revolved_par, of, 2,
              "its section: a shape of the plane of r and z, the first number of its parameters being r; what lies at "
              "r < 0 is left out"),
    PAR_VECTOR(revolved_par, centre, "m", PARAM_ANY, 0.0, "where the axis passes, at z = 0 of the section"),
};

/* Shares of the extent: as in boolean.c. */
static const double one_surface = 1e-9, apart = 1e-8, small_step = 1e-6;

/* In the plane through the axis, where the nearest place of the surface is; a side that lies on the axis is none. */
static double revolved_level(const void *par, int dim, const double x[3])
{
    const revolved_par *v = par;
    (void)dim;
    const double dx = x[0] - v->centre[0], dy = x[1] - v->centre[1], r = sqrt(dx * dx + dy * dy);
    const double at[3] = {r, x[2] - v->centre[2]}, near = one_surface * v->extent;
    const double level = shape_level(&v->of, 2, at);
    if (r > near || fabs(level) > near) return level;
    const double beside = shape_level(&v->of, 2, (const double[3]){r + small_step * v->extent, at[1]});
    return beside < -0.5 * small_step * v->extent ? -apart * v->extent : level;
}

static bool revolved_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const revolved_par *v = par;
    double from[3], to[3];
    (void)dim;
    if (!v->of.model->bounds(v->of.par, 2, from, to)) return false;
    for (int a = 0; a < 2; a++) {
        lo[a] = v->centre[a] - to[0];
        hi[a] = v->centre[a] + to[0];
    }
    lo[2] = v->centre[2] + from[1];
    hi[2] = v->centre[2] + to[1];
    return true;
}

static const char *revolved_check(const void *par, int dim)
{
    const revolved_par *v = par;
    double from[3], to[3];
    (void)dim;
    const bool bounded = v->of.model->bounds(v->of.par, 2, from, to);
    return bounded && !(to[0] > 0.0) ? "all of its section lies at r < 0" : NULL;
}

static floe_status revolved_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    revolved_par *v = par;
    (void)dim;
    (void)memory;
    (void)why;
    v->extent = shape_extent(&v->of, 2);
    return FLOE_OK;
}

const shape_model shape_revolved = {
    .name = "revolved",
    .doc = "a plane shape turned about z (3-D)",
    .param_size = sizeof(revolved_par),
    .params = revolved_params,
    .n_params = sizeof revolved_params / sizeof *revolved_params,
    .min_dim = 3,
    .max_dim = 3,
    .instead_below =
        "it is of scenes in space; about an axis (domain.geometry: axisymmetric) take its section, `of`, alone",
    .level = revolved_level,
    .bounds = revolved_bounds,
    .check = revolved_check,
    .prepare = revolved_prepare,
};

/* A shape without others. */
#include "geom/boolean.h"

typedef struct difference_par {
    shape of;
    param_list without;
    double extent; /* m */
} difference_par;

static const param_spec difference_params[] = {
    PAR_MODEL(difference_par, of, 0, "the shape that is left, but for the others"),
    PAR_MODELS(difference_par, without, 1, "what is cut out of it"),
};

static boolean_operands operands_of(const difference_par *d)
{
    return (boolean_operands){
        .first = &d->of, .part = d->without.item, .n = d->without.n, .outside = true, .extent = d->extent};
}

static double difference_level(const void *par, int dim, const double x[3])
{
    const boolean_operands o = operands_of(par);
    return boolean_level(&o, dim, x);
}

static bool difference_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const difference_par *d = par;
    return d->of.model->bounds(d->of.par, dim, lo, hi);
}

static const char *difference_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

static floe_status difference_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    difference_par *d = par;
    const boolean_operands o = operands_of(d);
    (void)memory;
    (void)why;
    d->extent = boolean_extent(&o, dim);
    return FLOE_OK;
}

const shape_model shape_difference = {
    .name = "difference",
    .doc = "a shape without others",
    .param_size = sizeof(difference_par),
    .params = difference_params,
    .n_params = sizeof difference_params / sizeof *difference_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = difference_level,
    .bounds = difference_bounds,
    .check = difference_check,
    .prepare = difference_prepare,
};

/* What lies inside all of several shapes. */
#include "geom/boolean.h"

typedef struct intersection_par {
    param_list shapes;
    double extent; /* m */
} intersection_par;

static const param_spec intersection_params[] = {
    PAR_MODELS_ALONE(intersection_par, shapes, 1, "what it lies inside of, all at once"),
};

static boolean_operands operands_of(const intersection_par *i)
{
    return (boolean_operands){.part = i->shapes.item, .n = i->shapes.n, .extent = i->extent};
}

static double intersection_level(const void *par, int dim, const double x[3])
{
    const boolean_operands o = operands_of(par);
    return boolean_level(&o, dim, x);
}

static bool intersection_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const boolean_operands o = operands_of(par);
    return boolean_bounds(&o, dim, lo, hi);
}

/* Of boxes it is a box. */
static bool intersection_fills(const void *par, int dim)
{
    const intersection_par *i = par;
    for (size_t k = 0; k < i->shapes.n; k++)
        if (!shape_fills_bounds((const shape *)i->shapes.item + k, dim)) return false;
    return true;
}

static const char *intersection_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

static floe_status intersection_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    intersection_par *i = par;
    const boolean_operands o = operands_of(i);
    (void)memory;
    i->extent = boolean_extent(&o, dim);
    boolean_check(&o, dim, why);
    return FLOE_OK;
}

const shape_model shape_intersection = {
    .name = "intersection",
    .doc = "what several shapes have in common",
    .param_size = sizeof(intersection_par),
    .params = intersection_params,
    .n_params = sizeof intersection_params / sizeof *intersection_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = intersection_level,
    .bounds = intersection_bounds,
    .fills = intersection_fills,
    .check = intersection_check,
    .prepare = intersection_prepare,
};

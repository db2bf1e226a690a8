/* What lies inside one shape of several, or on a side that two of them share. */
#include "geom/boolean.h"

#include "base/memory.h"

#include <math.h>

typedef struct union_par {
    param_list shapes;
    double extent; /* m */
} union_par;

static const param_spec union_params[] = {
    PAR_MODELS_ALONE(union_par, shapes, 1, "what it is made of: they may touch and overlap"),
};

/* Outside a union is what lies outside all of its parts. */
static boolean_operands operands_of(const union_par *u)
{
    return (boolean_operands){.part = u->shapes.item, .n = u->shapes.n, .outside = true, .extent = u->extent};
}

static double union_level(const void *par, int dim, const double x[3])
{
    const boolean_operands o = operands_of(par);
    return -boolean_level(&o, dim, x);
}

static bool union_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const boolean_operands o = operands_of(par);
    return boolean_bounds_of_all(&o, dim, lo, hi);
}

static const char *union_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

static floe_status union_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    union_par *u = par;
    const boolean_operands o = operands_of(u);
    (void)memory;
    (void)why;
    u->extent = boolean_extent(&o, dim);
    return FLOE_OK;
}

const shape_model shape_union = {
    .name = "union",
    .doc = "several shapes as one",
    .param_size = sizeof(union_par),
    .params = union_params,
    .n_params = sizeof union_params / sizeof *union_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = union_level,
    .bounds = union_bounds,
    .check = union_check,
    .prepare = union_prepare,
};

floe_status shape_unite(context *ctx, shape *part, size_t n, int dim, shape *out)
{
    union_par *u = NULL;
    char why[SHAPE_WHY] = "";
    TRY(memory_new(ctx, &u, 1, sizeof *u));
    *u = (union_par){.shapes = {part, n}};
    *out = (shape){&shape_union, u};
    return union_prepare(u, dim, NULL, why);
}

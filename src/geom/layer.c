#include "geom/layer.h"

#include "base/memory.h"

#include <math.h>

floe_status layer_check_number(context *ctx, double n)
{
    if (n <= LAYER_POINTS_MOST) return FLOE_OK;
    return fail(
        ctx, FLOE_BAD_INPUT,
        "it asks for more points than the %.0e that one membrane can have: make it smaller, the cells wider, or "
        "the points fewer",
        (double)LAYER_POINTS_MOST);
}

floe_status layer_reserve(seed_list *list, context *ctx, size_t n, int dim)
{
    list->n = n;
    TRY(memory_new(ctx, &list->volume, n, sizeof(double)));
    for (int k = 0; k < dim; k++) {
        TRY(memory_new(ctx, &list->x[k], n, sizeof(double)));
        TRY(memory_new(ctx, &list->half[k], n, sizeof(double)));
        TRY(memory_new(ctx, &list->cell[k], n, sizeof(int)));
    }
    return FLOE_OK;
}

floe_status layer_put_point(seed_list *list, context *ctx, const seed_spec *grid, size_t i, const double x[3])
{
    for (int k = 0; k < grid->dim; k++) {
        const double cell = floor((x[k] - grid->lower[k]) / grid->h[k]);
        if (!(x[k] >= grid->lower[k] && x[k] <= grid->lower[k] + grid->n[k] * grid->h[k]))
            return fail(ctx, FLOE_BAD_INPUT, "point %zu at (%g, %g, %g) lies outside the domain", i + 1, x[0],
                        grid->dim > 1 ? x[1] : 0.0, grid->dim > 2 ? x[2] : 0.0);
        list->x[k][i] = x[k];
        list->half[k][i] = 0.25 * grid->h[k];
        list->cell[k][i] = (int)fmin(fmax(cell, 0.0), grid->n[k] - 1.0);
    }
    return FLOE_OK;
}

double layer_cell(const seed_spec *grid)
{
    double h = grid->h[0];
    for (int a = 1; a < grid->dim; a++) h = fmin(h, grid->h[a]);
    return h;
}

void layer_snap(const seed_spec *grid, double *x)
{
    static const double found_with = 1e-8;
    for (int a = 0; a < grid->dim; ++a) {
        const double plane = rint((x[a] - grid->lower[a]) / grid->h[a]), at = grid->lower[a] + plane * grid->h[a];
        if (fabs(x[a] - at) < found_with * grid->h[a]) x[a] = at;
    }
}

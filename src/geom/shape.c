#include "geom/shape.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const shape_model *shape_find(const char *name)
{
    for (size_t i = 0; i < shape_registry_size; i++) {
        if (strcmp(shape_registry[i]->name, name) == 0) return shape_registry[i];
    }
    return NULL;
}

bool shape_inside(const shape *s, int dim, const double x[3])
{
    return shape_level(s, dim, x) < 0.0;
}

double shape_level(const shape *s, int dim, const double x[3])
{
    return s->model->level(s->par, dim, x);
}

void shape_differences(const shape *s, int dim, const double x[3], double step, double out[3])
{
    for (int a = 0; a < 3; a++) {
        double low[3] = {x[0], x[1], x[2]}, high[3] = {x[0], x[1], x[2]};
        low[a] -= step;
        high[a] += step;
        out[a] = a < dim ? shape_level(s, dim, high) - shape_level(s, dim, low) : 0.0;
    }
}

double shape_crossing(const shape *s, int dim, double tolerance, const double inside[3], const double outside[3],
                      int passes, double x[3])
{
    double lo = 0.0, hi = 1.0;
    for (int pass = 0; pass < passes; pass++) {
        const double middle = 0.5 * (lo + hi);
        for (int a = 0; a < 3; a++) x[a] = inside[a] + middle * (outside[a] - inside[a]);
        *(shape_level(s, dim, x) <= tolerance ? &lo : &hi) = middle;
    }
    return lo;
}

floe_status shape_prepare(const shape *s, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    const char *wrong = s->model->check ? s->model->check(s->par, dim) : NULL;
    (void)snprintf(why, SHAPE_WHY, "%s", wrong ? wrong : "");
    return wrong || !s->model->prepare ? FLOE_OK : s->model->prepare(s->par, dim, memory, why);
}

bool shape_fills_bounds(const shape *s, int dim)
{
    return s->model->fills_bounds || (s->model->fills && s->model->fills(s->par, dim));
}

double shape_extent(const shape *s, int dim)
{
    double lo[3], hi[3], square = 0.0;
    if (!s->model->bounds(s->par, dim, lo, hi)) return 0.0;
    for (int k = 0; k < dim; k++) square += (hi[k] - lo[k]) * (hi[k] - lo[k]);
    return sqrt(square);
}

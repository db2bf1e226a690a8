#include "geom/compound.h"

#include <math.h>

/* Halvings of a box that a surface cuts, by dimension. */
static const int cut_depth[4] = {0, 40, 5, 2};

/* The least of two levels is that of the union, and the greatest that of the common part; both stay below the distance
 * in size. */
static double compound_level(const void *par, int dim, const double x[3])
{
    const compound *c = par;
    double level = c->whole.model ? c->whole.model->level(c->whole.par, dim, x) : -HUGE_VAL;
    for (int k = 0; k < c->n; ++k) level = fmax(level, -c->less[k].model->level(c->less[k].par, dim, x));
    return level;
}

static bool compound_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const compound *c = par;
    return c->whole.model && c->whole.model->bounds(c->whole.par, dim, lo, hi);
}

static const shape_model compound_model = {
    .name = "compound",
    .doc = "what other shapes leave of a shape",
    .param_size = sizeof(compound),
    .min_dim = 1,
    .max_dim = 3,
    .level = compound_level,
    .bounds = compound_bounds,
};

shape compound_shape(compound *of)
{
    return (shape){&compound_model, of};
}

typedef struct common_part {
    const shape *a, *b;
} common_part;

static double common_level(const void *par, int dim, const double x[3])
{
    const common_part *c = par;
    return fmax(c->a->model->level(c->a->par, dim, x), c->b->model->level(c->b->par, dim, x));
}

static bool common_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const common_part *c = par;
    const shape *part[2] = {c->a, c->b};
    bool bounded = false;
    for (int k = 0; k < 2; ++k) {
        double from[3], to[3];
        if (!part[k]->model->bounds(part[k]->par, dim, from, to)) continue;
        for (int a = 0; a < dim; ++a) {
            lo[a] = bounded ? fmax(lo[a], from[a]) : from[a];
            hi[a] = bounded ? fmin(hi[a], to[a]) : to[a];
        }
        bounded = true;
    }
    return bounded;
}

/* Of two boxes the common part is the box of the bounds. */
static const shape_model common_model = {.name = "common", .level = common_level, .bounds = common_bounds};
static const shape_model common_box = {
    .name = "common", .level = common_level, .bounds = common_bounds, .fills_bounds = true};

/* The boxes from lo on that the shape's bounds meet: first and last (not included) along each axis; false: none. */
static bool boxes_met(const shape *s, int dim, const double lo[3], const double hi[3], const double h[3], int first[3],
                      int last[3])
{
    double from[3], to[3];
    const bool bounded = s->model->bounds(s->par, dim, from, to);
    for (int a = 0; a < 3; ++a) {
        first[a] = 0;
        last[a] = a < dim ? (int)lround((hi[a] - lo[a]) / h[a]) : 1;
        if (a >= dim || !bounded) continue;
        if (!(from[a] < to[a])) return false;
        const double n = last[a];
        first[a] = (int)fmin(fmax(floor((from[a] - lo[a]) / h[a]), 0.0), n);
        last[a] = (int)fmin(fmax(ceil((to[a] - lo[a]) / h[a]), first[a]), n);
    }
    return true;
}

double compound_volume(const shape *s, int dim, const double lo[3], const double hi[3], const double h[3],
                       bool weight_by_radius)
{
    int first[3], last[3];
    double volume = 0.0;
    if (!boxes_met(s, dim, lo, hi, h, first, last)) return 0.0;
    for (int k = first[2]; k < last[2]; ++k)
        for (int j = first[1]; j < last[1]; ++j)
            for (int i = first[0]; i < last[0]; ++i) {
                const int at[3] = {i, j, k};
                double from[3] = {0.0}, to[3] = {0.0}, middle[3] = {0.0}, size = 1.0, diagonal2 = 0.0;
                for (int a = 0; a < dim; ++a) {
                    from[a] = lo[a] + at[a] * h[a];
                    to[a] = from[a] + h[a];
                    middle[a] = 0.5 * (from[a] + to[a]);
                    size *= h[a];
                    diagonal2 += h[a] * h[a];
                }
                const double level = s->model->level(s->par, dim, middle);
                if (level > 0.0 && 4.0 * level * level >= diagonal2) continue;
                if (weight_by_radius) size *= middle[0];
                volume += size * shape_fraction(s, dim, from, to, weight_by_radius, cut_depth[dim], middle);
            }
    return volume;
}

double compound_common_volume(const shape *a, const shape *b, int dim, const double lo[3], const double hi[3],
                              const double h[3], bool weight_by_radius)
{
    common_part part = {a, b};
    const bool boxes = shape_fills_bounds(a, dim) && shape_fills_bounds(b, dim);
    const shape common = {boxes ? &common_box : &common_model, &part};
    return compound_volume(&common, dim, lo, hi, h, weight_by_radius);
}

double region_share(const shape *region, int dim, const double lo[3], const double hi[3], bool weight_by_radius)
{
    enum { DEPTH = 4 };
    double middle[3] = {0.0}, diagonal2 = 0.0;
    if (!region || !region->model) return 1.0;
    for (int a = 0; a < dim; ++a) {
        middle[a] = 0.5 * (lo[a] + hi[a]);
        diagonal2 += (hi[a] - lo[a]) * (hi[a] - lo[a]);
    }
    const double level = region->model->level(region->par, dim, middle);
    if (4.0 * level * level >= diagonal2) return level < 0.0 ? 1.0 : 0.0;
    return fmin(shape_fraction(region, dim, lo, hi, weight_by_radius, DEPTH, middle), 1.0);
}

#include "geom/images.h"

#include "geom/bounds.h"

#include <math.h>

/* ---- one image ---- */

static double image_level(const void *par, int dim, const double x[3])
{
    const shape_image *i = par;
    double y[3] = {0.0};
    for (int a = 0; a < dim; ++a) y[a] = x[a] - i->shift[a];
    return shape_level(i->of, dim, y);
}

static bool image_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const shape_image *i = par;
    if (!shape_bounds(i->of, dim, lo, hi)) return false;
    for (int a = 0; a < dim; ++a) {
        lo[a] += i->shift[a];
        hi[a] += i->shift[a];
    }
    return true;
}

static bool image_moments(const void *par, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                          shape_moments *out)
{
    const shape_image *i = par;
    double from[3] = {0.0}, to[3] = {0.0};
    for (int a = 0; a < dim; ++a) {
        from[a] = lo[a] - i->shift[a];
        to[a] = hi[a] - i->shift[a];
    }
    if (!shape_exact_moments(i->of, dim, from, to, weight_by_radius, out)) return false;
    for (int a = 0; a < dim; ++a) out->first[a] += i->shift[a] * out->volume;
    return true;
}

static const shape_model image_model = {
    .name = "image",
    .doc = "a shape seen across periodic sides",
    .param_size = sizeof(shape_image),
    .min_dim = 1,
    .max_dim = 3,
    .level = image_level,
    .bounds = image_bounds,
    .moments = image_moments,
};

/* ---- all of them ---- */

static double images_level(const void *par, int dim, const double x[3])
{
    return -boolean_level(&((const images *)par)->all, dim, x);
}

static bool images_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const images *i = par;
    if (!boolean_bounds_of_all(&i->all, dim, lo, hi)) return false;
    for (int a = 0; a < dim; ++a) {
        lo[a] = fmax(lo[a], i->lower[a]);
        hi[a] = fmin(hi[a], i->upper[a]);
    }
    return true;
}

static bool bounds_overlap(const shape *s, const shape *t, int dim)
{
    double lo[2][3], hi[2][3];
    bool overlap = shape_bounds(s, dim, lo[0], hi[0]) && shape_bounds(t, dim, lo[1], hi[1]);
    for (int a = 0; a < dim; ++a) overlap = overlap && lo[0][a] < hi[1][a] && lo[1][a] < hi[0][a];
    return overlap;
}

/* The sum of their moments, where no two may have anything in common. */
static bool images_moments(const void *par, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                           shape_moments *out)
{
    const images *i = par;
    *out = (shape_moments){.volume = 0.0};
    for (size_t k = 0; k < i->all.n; ++k) {
        shape_moments of;
        for (size_t j = 0; j < k; ++j)
            if (bounds_overlap(&i->part[j], &i->part[k], dim)) return false;
        if (!shape_exact_moments(&i->part[k], dim, lo, hi, weight_by_radius, &of)) return false;
        out->volume += of.volume;
        for (int a = 0; a < dim; ++a) out->first[a] += of.first[a];
    }
    return true;
}

static const shape_model images_model = {
    .name = "images",
    .doc = "a shape and its images around periodic axes",
    .param_size = sizeof(images),
    .min_dim = 1,
    .max_dim = 3,
    .level = images_level,
    .bounds = images_bounds,
    .moments = images_moments,
};

/* Whether a part comes into the box, or nearer to it than the margin. */
static bool comes_near(const shape *s, int dim, const double lower[3], const double upper[3], double margin)
{
    double lo[3], hi[3];
    bool near = shape_bounds(s, dim, lo, hi);
    for (int a = 0; a < dim; ++a) near = near && hi[a] > lower[a] - margin && lo[a] < upper[a] + margin;
    return near;
}

static void add_image(images *out, int dim, const double lower[3], const double upper[3], const int turns[3],
                      double margin)
{
    const size_t n = out->all.n;
    out->image[n].of = &out->whole;
    for (int a = 0; a < 3; ++a) out->image[n].shift[a] = turns[a] * (upper[a] - lower[a]);
    out->part[n] = (shape){&image_model, &out->image[n]};
    if (comes_near(&out->part[n], dim, lower, upper, margin)) out->all.n++;
}

shape images_make(images *out, const shape *s, int dim, const double lower[3], const double upper[3],
                  const bool periodic[3], double margin)
{
    double lo[3], hi[3];
    int most[3];
    if (!shape_bounds(s, dim, lo, hi)) return *s;
    *out = (images){.whole = *s, .part = {*s}, .all = {.part = out->part, .n = 1, .outside = true}};
    for (int a = 0; a < 3; ++a) {
        most[a] = a < dim && periodic[a] ? 1 : 0;
        out->lower[a] = most[a] ? lower[a] : -HUGE_VAL;
        out->upper[a] = most[a] ? upper[a] : HUGE_VAL;
    }
    for (int k = -most[2]; k <= most[2]; ++k)
        for (int j = -most[1]; j <= most[1]; ++j)
            for (int i = -most[0]; i <= most[0]; ++i)
                if (i != 0 || j != 0 || k != 0) add_image(out, dim, lower, upper, (const int[]){i, j, k}, margin);
    out->all.extent = boolean_extent(&out->all, dim);
    return out->all.n > 1 ? (shape){&images_model, out} : *s;
}

const shape *images_whole(const shape *s)
{
    return s->model == &images_model ? &((const images *)s->par)->whole : s;
}

/* Who follows whom along a line whose points are in no order. */
#include "math/tensor.h"
#include "surface/neighbours.h"

#include <math.h>

enum { LINK_NEAR = 8 };

static const double least_cosine = 0.5;
static const surface_link none = {.of = -1, .axis = -1};

/* An image is told by a digit to the base 3 for each axis (set.c): 0 where it stands, 1 and 2 beyond the lower and the
 * upper side. False for one behind two mirrors, which no single reflection gives. */
static bool link_to(const surface_set *s, const surface_neighbour *near, surface_link *out)
{
    uint32_t code = near->image;
    *out = (surface_link){.of = (ptrdiff_t)near->number, .axis = -1};
    for (int a = 0; a < s->mesh->dim; ++a, code /= 3) {
        if (code % 3 == 0 || s->mesh->periodic[a]) continue;
        if (out->axis >= 0) return false;
        out->axis = a;
        out->side = code % 3 == 1 ? SIDE_LOWER : SIDE_UPPER;
    }
    return true;
}

/* The nearest along a direction; neighbours come nearest first. */
static surface_link nearest_along(const surface_set *s, const surface_neighbour *near, int n, const double along[3])
{
    for (int k = 0; k < n; ++k) {
        surface_link link;
        if (vec_dot(near[k].d, along) > least_cosine * sqrt(near[k].square) && link_to(s, &near[k], &link)) return link;
    }
    return none;
}

static void link_entry(const surface_set *s, const surface_entry *e, const double normal[3], surface_link out[2])
{
    surface_neighbour near[LINK_NEAR];
    const int n = surface_nearest(s, e, LINK_NEAR, near);
    const double after[3] = {-normal[1], normal[0], 0.0}, before[3] = {normal[1], -normal[0], 0.0};
    out[0] = nearest_along(s, near, n, before);
    out[1] = nearest_along(s, near, n, after);
}

void surface_links(const surface_set *s, const surface_estimate *normals, surface_link *out)
{
    for (size_t k = 0; k < 2 * s->n_points; ++k) out[k] = none;
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < s->points.n; ++k) {
        const surface_entry *e = &s->points.entry[k];
        if (e->image == 0 && normals[e->number].basis != SURFACE_NONE)
            link_entry(s, e, normals[e->number].normal, out + 2 * (ptrdiff_t)e->number);
    }
}

/* Points are a midpoint quadrature: n of them across a beam or a plate have 1 - 1/n^2 of its moment of inertia. */
#include "scene/slender.h"

#include "geom/bounds.h"
#include "geom/compound.h"

#include <math.h>

enum { PIECES = 24 /* that a body is cut into along an axis, to be measured */ };

static const double slender = 5.0; /* length over thickness */

static bool lies_on_side(const scene *s, int axis, double lo, double hi)
{
    return lo <= s->mesh.lower[axis] || hi >= s->mesh.upper[axis];
}

/* Area over the diagonal of the box about it: the thickness of a strip that leans. */
static double leaning_thickness(const scene *s, const scene_body *b, const double lo[3], const double hi[3],
                                double diagonal)
{
    double h[3] = {1, 1, 1};
    if (s->mesh.dim != 2 || s->mesh.geometry == MESH_AXISYMMETRIC) return INFINITY;
    for (int a = 0; a < 2; ++a) h[a] = (hi[a] - lo[a]) / PIECES;
    return compound_volume(&b->shape, 2, lo, hi, h, false) / diagonal;
}

static double find_thickness(const scene *s, const scene_body *b, int *axis)
{
    const int dim = s->mesh.dim;
    double lo[3] = {0}, hi[3] = {0}, shortest = INFINITY, longest = 0.0, square = 0.0;
    *axis = -1;
    if (!shape_bounds(&b->shape, dim, lo, hi)) return INFINITY;
    for (int a = 0; a < dim; ++a) {
        const double extent = hi[a] - lo[a];
        square += extent * extent;
        if (extent < shortest) *axis = a;
        shortest = fmin(shortest, extent);
        longest = fmax(longest, extent);
        if (lo[a] <= s->mesh.lower[a] && hi[a] >= s->mesh.upper[a]) return INFINITY;
    }
    if (*axis < 0) return INFINITY;
    const double diagonal = sqrt(square), leaning = leaning_thickness(s, b, lo, hi, diagonal);
    if (leaning < 0.9 * shortest) {
        *axis = -1;
        return slender * leaning < diagonal ? leaning : (double)INFINITY;
    }
    const bool tube = s->mesh.geometry == MESH_AXISYMMETRIC && *axis == 0;
    if (tube || lies_on_side(s, *axis, lo[*axis], hi[*axis])) return INFINITY;
    return slender * shortest < longest ? shortest : (double)INFINITY;
}

double slender_across(const scene *s, const scene_body *b, const int per_cell[3], int *axis)
{
    double spacing = 0.0;
    *axis = -1;
    if (s->mesh.dim == 1 || b->material < 0 || s->material[b->material].kind != MATERIAL_SOLID || !b->shape.model)
        return INFINITY;
    const double thickness = find_thickness(s, b, axis);
    for (int a = 0; a < s->mesh.dim; ++a)
        if (*axis < 0 || *axis == a) spacing = fmax(spacing, s->mesh.cell[a] / per_cell[a]);
    return thickness / spacing;
}

void slender_seed(const scene *s, scene_body *b)
{
    int axis;
    if (!(slender_across(s, b, b->per_cell, &axis) < SLENDER_ENOUGH - 0.5)) return;
    for (int a = 0; a < s->mesh.dim; ++a)
        if (axis < 0 || axis == a) b->per_cell[a] = SLENDER_POINTS;
}

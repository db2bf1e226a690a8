/* A method over all cells, and what is done where it finds no direction, or a wild one. */
#include "math/tensor.h"
#include "surface/plane.h"

#include <math.h>
#include <string.h>

enum { PLAIN_NEAR_2D = 4, PLAIN_NEAR_3D = 8 };

/* Cosine of the angle from the plain normal beyond which an estimate is none: 45 degrees. */
static const double wild = 0.70710678118654752;

/* Normal of the line or plane through the nearest points. */
static bool plane_normal(const surface_set *s, const surface_entry *e, double n[3])
{
    surface_neighbour near[PLAIN_NEAR_3D];
    surface_frame f;
    const int count = surface_nearest(s, e, s->mesh->dim == 3 ? PLAIN_NEAR_3D : PLAIN_NEAR_2D, near);
    /* The farthest keeps some of its weight. */
    if (count == 0 || !surface_plane(s->mesh->dim, count, near, 1.25 * sqrt(near[count - 1].square), &f)) return false;
    memcpy(n, f.n, sizeof f.n);
    return true;
}

static void look_after(const surface_set *s, const surface_method *method, const surface_entry *e,
                       surface_estimate *out)
{
    double plain[3];
    if (s->mesh->dim == 1 || (out->basis != SURFACE_NONE && !method->checked) || !plane_normal(s, e, plain)) return;
    if (out->basis != SURFACE_NONE && fabs(vec_dot(plain, out->normal)) >= wild) return;
    memcpy(out->normal, plain, sizeof plain);
    out->condition = out->curvature = out->area = NAN;
    out->basis = SURFACE_PLAIN;
}

void surface_normals(const surface_set *s, const surface_method *method, const void *par, surface_estimate *out)
{
    const surface_bins *l = &s->points;
    for (size_t k = 0; k < s->n_points; ++k)
        out[k] = (surface_estimate){.condition = NAN, .curvature = NAN, .area = NAN, .basis = SURFACE_NONE};
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < l->n_cells; ++c) {
        const surface_cell *own = &l->cell[c];
        if (!own->own) continue;
        method->cell(s, par, own, out);
        for (size_t k = 0; k < own->n; ++k) {
            const surface_entry *e = &l->entry[own->first + k];
            if (e->image == 0) look_after(s, method, e, &out[e->number]);
        }
    }
}

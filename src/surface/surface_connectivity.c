#include "surface/surface.h"

#include "math/tensor.h"

extern const surface_method surface_connectivity;

static void estimate_by_connectivity(const surface_set *s, const void *par, const surface_cell *c,
                                     surface_estimate *out)
{
    (void)par;
    for (size_t k = 0; s->mesh->dim == 2 && k < c->n; ++k) {
        const surface_entry *e = &s->points.entry[c->first + k];
        const size_t n = s->n_points, p = e->number;
        if (e->image != 0) continue;
        const size_t before = p > 0 ? p - 1 : s->closed ? n - 1 : p, after = p + 1 < n ? p + 1 : s->closed ? 0 : p;
        double chord[3], normal[3];
        for (int a = 0; a < 3; ++a) chord[a] = s->place[3 * after + a] - s->place[3 * before + a];
        normal[0] = chord[1];
        normal[1] = -chord[0];
        normal[2] = 0.0;
        if (!(vec_normalize(normal) > 0.0)) continue;
        for (int a = 0; a < 3; ++a) out[p].normal[a] = normal[a];
        out[p].basis = SURFACE_METHOD;
    }
}

const surface_method surface_connectivity = {
    .name = "connectivity",
    .doc = "across the way from the point before to the point after, in the order of seeding",
    .cite = "York 1997, equation 7.1; York, Sulsky, Schreyer 2000, section 3.2",
    .min_dim = 2,
    .connected = true,
    .exact = true,
    .cell = estimate_by_connectivity,
};

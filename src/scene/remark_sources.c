/* Remarks on sources of mass and vents: regions that the mesh does not resolve, and gases that change their law. */
#include "scene/remark_internal.h"

#include "geom/bounds.h"
#include "geom/compound.h"

#include <math.h>
#include <string.h>

/* Volume of a region in cells, as far as its bounds tell; INFINITY: it has none. */
static double cells_of(const scene *s, const shape *region)
{
    double lo[3] = {0}, hi[3] = {0}, h[3] = {1, 1, 1}, cell = 1.0;
    if (!shape_bounds(region, s->mesh.dim, lo, hi)) return INFINITY;
    for (int a = 0; a < s->mesh.dim; ++a) {
        lo[a] = fmax(lo[a], s->mesh.lower[a]);
        hi[a] = fmin(hi[a], s->mesh.upper[a]);
        if (!(lo[a] < hi[a])) return INFINITY; /* refused */
        if (hi[a] - lo[a] > 4.0 * s->mesh.cell[a]) return INFINITY;
        h[a] = (hi[a] - lo[a]) / 8.0;
        cell *= s->mesh.cell[a];
    }
    return compound_volume(region, s->mesh.dim, lo, hi, h, false) / cell;
}

static void remark_small(const scene *s, const char *map, const char *name, const char *rest, const shape *region,
                         remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    const double cells = cells_of(s, region);
    if (!(cells < 1.0)) return;
    remark_set_key(&w, map, name, rest);
    remark_key(&w,
               "the region is %.2g of a cell: what comes in or leaves there does so in a whole cell or more. Refine "
               "domain.cell, or make it larger",
               cells);
}

static void remark_laws(const scene *s, const scene_vent *vent, remark_sink *say, void *user)
{
    const eos *from = &s->material[vent->side[0].material].eos, *to = &s->material[vent->side[1].material].eos;
    remark_speaker w = {.s = s, .say = say, .user = user};
    if (from->model == to->model && memcmp(from->par, to->par, from->model->param_size) == 0) return;
    remark_set_key(&w, "vents", vent->name, "to");
    remark_key(&w,
               "what passes from '%s' becomes '%s', with its mass and energy, and the two have different laws: its "
               "temperature is then another",
               s->material[vent->side[0].material].name, s->material[vent->side[1].material].name);
}

void remark_sources(const scene *s, remark_sink *say, void *user)
{
    for (int k = 0; k < s->n_mass_sources; ++k)
        remark_small(s, "sources", s->mass_source[k].name, "region", &s->mass_source[k].region, say, user);
    for (int k = 0; k < s->n_vents; ++k) {
        const scene_vent *vent = &s->vent[k];
        remark_small(s, "vents", vent->name, "from.region", &vent->side[0].region, say, user);
        if (vent->to_outside) continue;
        remark_small(s, "vents", vent->name, "to.region", &vent->side[1].region, say, user);
        remark_laws(s, vent, say, user);
    }
}

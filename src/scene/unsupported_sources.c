/* Sources of mass and vents that a coupling cannot have, or that no fluid can come to. */
#include "scene/unsupported.h"

#include "geom/bounds.h"
#include "geom/compound.h"

#include <math.h>

enum { SAMPLES = 3 /* of a cell along an axis */ };

static bool has_fluid(const scene *s, int material)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material) return true;
    return s->has_ambient && s->ambient_material == material;
}

static bool in_solid(const scene *s, const double x[3])
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].shape.model && s->material[s->body[b].material].kind == MATERIAL_SOLID &&
            shape_inside(&s->body[b].shape, s->mesh.dim, x))
            return true;
    return false;
}

/* Whether some place of a cell's part of the region is in no solid. A part too thin for the samples counts as free where the
 * middle of the cell is. */
static bool cell_is_free(const scene *s, const shape *region, const double lo[3], const double hi[3])
{
    int n = 1;
    bool met = false;
    const double middle[3] = {0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), 0.5 * (lo[2] + hi[2])};
    for (int a = 0; a < s->mesh.dim; ++a) n *= SAMPLES;
    for (int k = 0; k < n; ++k) {
        double x[3] = {0.0, 0.0, 0.0};
        for (int a = 0, rest = k; a < s->mesh.dim; ++a, rest /= SAMPLES)
            x[a] = lo[a] + (rest % SAMPLES + 0.5) / SAMPLES * (hi[a] - lo[a]);
        if (!shape_inside(region, s->mesh.dim, x)) continue;
        met = true;
        if (!in_solid(s, x)) return true;
    }
    return !met && region_share(region, s->mesh.dim, lo, hi, false) > 0.0 && !in_solid(s, middle);
}

/* The cells that a region can reach. */
static void find_range(const scene *s, const shape *region, int first[3], int last[3])
{
    const mesh_spec *m = &s->mesh;
    double lo[3] = {0}, hi[3] = {0};
    const bool bounded = shape_bounds(region, m->dim, lo, hi);
    for (int a = 0; a < 3; ++a) {
        first[a] = 0;
        last[a] = a < m->dim ? (int)rint((m->upper[a] - m->lower[a]) / m->cell[a]) : 1;
        if (!bounded || a >= m->dim) continue;
        first[a] = (int)fmax(first[a], floor((lo[a] - m->lower[a]) / m->cell[a]));
        last[a] = (int)fmin(last[a], ceil((hi[a] - m->lower[a]) / m->cell[a]));
    }
}

static bool region_is_free(const scene *s, const shape *region)
{
    int first[3], last[3];
    if (!region->model) return true;
    find_range(s, region, first, last);
    for (int k = first[2]; k < last[2]; ++k)
        for (int j = first[1]; j < last[1]; ++j)
            for (int i = first[0]; i < last[0]; ++i) {
                const int at[3] = {i, j, k};
                double lo[3] = {0}, hi[3] = {0};
                for (int a = 0; a < s->mesh.dim; ++a) {
                    lo[a] = s->mesh.lower[a] + at[a] * s->mesh.cell[a];
                    hi[a] = lo[a] + s->mesh.cell[a];
                }
                if (cell_is_free(s, region, lo, hi)) return true;
            }
    return false;
}

static floe_status refuse_source(const scene *s, scene_coupling coupling, const scene_mass_source *source)
{
    const char *fluid = s->material[source->material].name;
    if (coupling == COUPLING_MPM)
        return fail_key(s->ctx, KEY("sources", source->name),
                        "mpm: sources let fluid into cells, and no material points come into being: take ice or "
                        "ice-mpm");
    if (coupling == COUPLING_ICE && source->inside >= 0)
        return fail_key(s->ctx, KEY("sources", source->name, "inside"),
                        "ice: there are no membranes to be inside of; name a region, or take ice-mpm");
    if (coupling == COUPLING_ICE_MPM && scene_enclosing_body(s) >= 0 && !has_fluid(s, source->material))
        return fail_key(s->ctx, KEY("sources", source->name, "material"),
                        "beside membranes around gas there is one gas on each side, and '%s' is none of them: name the "
                        "gas that is where the source is",
                        fluid);
    if (region_is_free(s, &source->region)) return FLOE_OK;
    return fail_key(s->ctx, KEY("sources", source->name, "region"),
                    "the region of source '%s' lies inside solids, where no fluid can come in: move it", source->name);
}

static floe_status refuse_vent(const scene *s, scene_coupling coupling, const scene_vent *vent)
{
    static const char *const name[] = {"from", "to"};
    if (coupling == COUPLING_MPM)
        return fail_key(s->ctx, KEY("vents", vent->name),
                        "mpm: vents are between fluids of the cells, and no material points come into being: take ice "
                        "or ice-mpm");
    for (int side = 0; side < (vent->to_outside ? 1 : 2); ++side) {
        const scene_vent_side *given = &vent->side[side];
        if (!has_fluid(s, given->material))
            return fail_key(s->ctx, KEY("vents", vent->name, name[side], "material"),
                            "there is no '%s' in the scene: give a body of it, or leave the vent out",
                            s->material[given->material].name);
        if (!region_is_free(s, &given->region))
            return fail_key(s->ctx, KEY("vents", vent->name, name[side], "region"),
                            "this side of vent '%s' lies inside solids, where no gas is: move it", vent->name);
    }
    return FLOE_OK;
}

floe_status scene_refuse_sources(const scene *s, scene_coupling coupling)
{
    for (int k = 0; k < s->n_mass_sources; ++k) TRY(refuse_source(s, coupling, &s->mass_source[k]));
    for (int k = 0; k < s->n_vents; ++k) TRY(refuse_vent(s, coupling, &s->vent[k]));
    return FLOE_OK;
}

/* Questions about the materials of the cells. */

#include "ice/state/ice_materials.h"
#include "ice/state/ice_fluid_state.h"
#include "ice/state/ice_traced.h"
#include "scene/side_parts.h"

#include <math.h>

void ice_find_used(const scene *s, bool with_points, bool *used)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        const int r = s->body[b].material;
        used[r] = s->material[r].kind == MATERIAL_FLUID || with_points;
    }
    if (s->has_ambient) used[s->ambient_material] = true;
    for (int k = 0; k < s->n_reactions; ++k) used[s->reaction[k].product] = true;
    for (int k = 0; k < s->n_mass_sources; ++k) used[s->mass_source[k].material] = true;
    scene_condition at;
    for (int i = 0; scene_next_condition(s, &i, &at);) {
        const bc_side *wall = at.side;
        const bool fluid = wall->material >= 0 && wall->material < s->n_materials &&
                           s->material[wall->material].kind == MATERIAL_FLUID;
        if ((wall->kind == BC_INLET || wall->kind == BC_RESERVOIR) && fluid && !s->mesh.periodic[at.axis])
            used[wall->material] = true;
    }
}

int ice_material_of(const ice *s, int wanted)
{
    for (int r = 0; r < s->n_materials; ++r)
        if (s->material[r].scene_material == wanted) return r;
    return -1;
}

const ice_region *ice_region_of(const ice *s, int material)
{
    int number = s->n_regions - 1;
    while (number > 0 && material < s->region[number].first) --number;
    return &s->region[number];
}

bool ice_is_viscous(const ice *s)
{
    for (int r = 0; r < s->n_materials; ++r)
        if (s->material[r].shear_viscosity > 0.0 || s->material[r].bulk_viscosity > 0.0) return true;
    return false;
}

bool ice_has_interfaces(const ice *s, const ice_region *g)
{
    return g->n > 1 && !s->with_points;
}

bool ice_follows_isentropes(const ice *s, const ice_region *g)
{
    if (ice_has_interfaces(s, g)) return true;
    for (int r = g->first; r < g->first + g->n; ++r)
        if (isnan(s->material[r].energy_floor) && !s->material[r].points) return true;
    return false;
}

bool ice_sharpens_contacts(const ice *s)
{
    return !ice_is_mixture(s) && !s->cut &&
           (s->scene->method.limiter == ICE_LIMITER_DEFAULT || s->scene->method.limiter == ICE_LIMITER_VAN_LEER) &&
           !ice_may_trace(s);
}

ice_reservoir ice_state_at(const eos *law, double p, double T)
{
    ice_reservoir out = {.T = T};
    double dvdp;
    law->model->volume(law->par, 1, &p, &T, &out.v, &dvdp);
    out.rho = 1.0 / out.v;
    law->model->energy(law->par, 1, &out.rho, &T, &out.e);
    return out;
}

#include "scene/solid_heat.h"

#include <math.h>

/* Metals store about a tenth of the plastic work in their dislocations (Taylor and Quinney 1934). */
static const double USUAL_PLASTIC_HEAT = 0.9;

bool scene_solid_exchanges_heat(const scene *s, int material)
{
    if (s->method.heat_exchange > 0.0) return true;
    for (int k = 0; k < s->n_exchanges; ++k) {
        const scene_exchange *e = &s->exchange[k];
        if (e->heat.model && (e->material[0] == material || e->material[1] == material)) return true;
    }
    return false;
}

bool scene_material_burns(const scene *s, int material)
{
    for (int k = 0; k < s->n_reactions; ++k)
        if (s->reaction[k].reactant == material) return true;
    return false;
}

bool scene_solid_has_temperature(const scene *s, int material, bool smeared)
{
    const scene_material *m = &s->material[material];
    if (m->kind != MATERIAL_SOLID || !m->law || !(m->specific_heat > 0.0) || scene_material_burns(s, material))
        return false;
    return m->conductivity > 0.0 || m->expansion != 0.0 || m->plastic_heat > 0.0 ||
           (solid_depends_on(m->law, m->law_par) & SOLID_BY_TEMPERATURE) ||
           (smeared && scene_solid_exchanges_heat(s, material));
}

bool scene_some_solid_conducts(const scene *s)
{
    for (int m = 0; m < s->n_materials; ++m)
        if (s->material[m].kind == MATERIAL_SOLID && s->material[m].conductivity > 0.0) return true;
    return false;
}

bool scene_heat_passes_walls(const scene *s)
{
    bool fluid = false, solid = false;
    if (s->coupling != COUPLING_ICE_MPM || !scene_is_cut(s) || scene_enclosing_body(s) >= 0) return false;
    for (int m = 0; m < s->n_materials; ++m) {
        const bool conducts = s->material[m].conductivity > 0.0;
        fluid = fluid || (conducts && s->material[m].kind == MATERIAL_FLUID);
        solid = solid || (conducts && scene_solid_has_temperature(s, m, false));
    }
    return fluid && solid;
}

double scene_plastic_heat(const scene_material *m)
{
    return isnan(m->plastic_heat) ? USUAL_PLASTIC_HEAT : m->plastic_heat;
}

/* Sources of mass and vents against the rest of the scene. */
#include "deck/check/check.h"

#include "scene/scene_reach.h"

#include <string.h>

static floe_status check_source(reader *r, const scene_mass_source *source)
{
    const scene *s = r->scene;
    const scene_material *m = &s->material[source->material];
    if (m->kind == MATERIAL_SOLID)
        return bad_at(r, KEY("sources", source->name, "material"), "the name of a fluid", NULL, "'%s' is a solid",
                      m->name);
    if (!(source->end > source->start))
        return bad_at(r, KEY("sources", source->name, "end"), "a time after 'start'", NULL,
                      "source '%s' ends (%g) before it begins (%g)", source->name, source->end, source->start);
    if (is_clean(r->root, KEY("domain")) && !scene_meets_domain(s, &source->region))
        return bad_at(r, KEY("sources", source->name, "region"), "a shape that meets the domain", NULL,
                      "source '%s' lies outside the domain", source->name);
    return FLOE_OK;
}

static floe_status check_vent_side(reader *r, const scene_vent *vent, int side)
{
    static const char *const name[] = {"from", "to"};
    const scene *s = r->scene;
    const scene_vent_side *given = &vent->side[side];
    const scene_material *m = &s->material[given->material];
    if (m->kind == MATERIAL_SOLID)
        return bad_at(r, KEY("vents", vent->name, name[side], "material"), "the name of a fluid", NULL,
                      "'%s' is a solid", m->name);
    if (m->eos.model && strcmp(m->eos.model->name, "ideal") != 0)
        return bad_at(r, KEY("vents", vent->name, name[side], "material"), "a fluid with eos: {ideal: ...}", NULL,
                      "the flow through vent '%s' is that of an ideal gas, and '%s' is '%s'", vent->name, m->name,
                      m->eos.model->name);
    if (is_clean(r->root, KEY("domain")) && !scene_meets_domain(s, &given->region))
        return bad_at(r, KEY("vents", vent->name, name[side], "region"), "a shape that meets the domain", NULL,
                      "vent '%s' leads to where the domain is not", vent->name);
    return FLOE_OK;
}

static floe_status check_vent(reader *r, const scene_vent *vent)
{
    TRY(check_vent_side(r, vent, 0));
    if (!(vent->end > vent->start))
        return bad_at(r, KEY("vents", vent->name, "end"), "a time after 'start'", NULL,
                      "vent '%s' closes (%g) before it opens (%g)", vent->name, vent->end, vent->start);
    if (vent->to_outside) return FLOE_OK;
    TRY(check_vent_side(r, vent, 1));
    const bool whole = !vent->side[0].region.model || !vent->side[1].region.model;
    if (!whole || vent->side[0].material != vent->side[1].material) return FLOE_OK;
    return bad_at(r, KEY("vents", vent->name, "to"), "two fluids, or 'region' on both sides", NULL,
                  "both sides of vent '%s' are the same '%s'", vent->name,
                  r->scene->material[vent->side[0].material].name);
}

floe_status check_sources(reader *r)
{
    for (int k = 0; k < r->scene->n_mass_sources; k++) {
        const scene_mass_source *source = &r->scene->mass_source[k];
        if (is_clean(r->root, KEY("sources", source->name))) TRY(check_source(r, source));
    }
    for (int k = 0; k < r->scene->n_vents; k++) {
        const scene_vent *vent = &r->scene->vent[k];
        if (is_clean(r->root, KEY("vents", vent->name))) TRY(check_vent(r, vent));
    }
    return FLOE_OK;
}

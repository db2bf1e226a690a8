/* The contact of bodies against the rest of the scene. */
#include "deck/check.h"

/* Cells hold all materials of a cell at one velocity (exchange), so that nothing is left there for a contact to do. */
static floe_status check_coupling(reader *r)
{
    const scene_coupling cells[] = {COUPLING_ICE, COUPLING_ICE_MPM};
    for (int i = 0; i < 2; i++) {
        if (!scene_runs_as(r->scene, cells[i])) continue;
        return bad_at(
            r, PATH("contact"), "coupling: mpm", NULL,
            "contact is between material points, and this deck runs as '%s', where the exchange of momentum in "
            "the cells decides how solids move that share one",
            coupling_name(cells[i]));
    }
    return FLOE_OK;
}

floe_status check_contact(reader *r)
{
    const scene *s = r->scene;
    if (!s->contact.enabled || !is_clean(r->root, PATH("contact"))) return FLOE_OK;
    TRY(check_coupling(r));
    int members = 0;
    for (int b = 0; b < s->n_bodies; b++) {
        if (s->body[b].material < 0) return FLOE_OK; /* another error */
        if (!scene_in_contact(s, b)) continue;
        members++;
        if (s->material[s->body[b].material].kind == MATERIAL_SOLID) continue;
        return bad_at(r, PATH("contact", "between"), "names of solid bodies", NULL,
                      "body '%s' is a fluid: fluids stick to what they touch", s->body[b].name);
    }
    if (members < 2) return bad_at(r, PATH("contact"), "two solid bodies or more", NULL, "there is nothing to touch");
    if (members > SCENE_MAX_CONTACT)
        return bad_at(r, PATH("contact", "between"), "fewer bodies", NULL, "%d bodies in contact are more than %d",
                      members, SCENE_MAX_CONTACT);
    return FLOE_OK;
}

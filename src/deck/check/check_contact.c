/* The contact of bodies against the rest of the scene. */
#include "deck/check/check.h"

#include <math.h>
#include <string.h>

/* Beside cells, all points of a material have one velocity: a body of the contact needs a material of its own. */
static floe_status check_materials(reader *r)
{
    const scene *s = r->scene;
    for (int a = 0; a < s->n_bodies; a++)
        for (int b = 0; b < s->n_bodies; b++) {
            if (a == b || !scene_in_contact(s, a) || s->body[a].material != s->body[b].material) continue;
            return bad_at(
                r, KEY("bodies", s->body[a].name, "material"), NULL,
                "give one of them a material of the same law under another name",
                "bodies '%s' and '%s' are of one material, which has one velocity in 'ice-mpm': contact needs two",
                s->body[a].name, s->body[b].name);
        }
    return FLOE_OK;
}

static floe_status check_contact_coupling(reader *r)
{
    if (scene_runs_as(r->scene, COUPLING_ICE))
        return bad_at(r, KEY("contact"), "coupling: mpm or ice-mpm", NULL,
                      "contact is between bodies of material points, and 'ice' has none");
    if (!scene_runs_as(r->scene, COUPLING_ICE_MPM)) return FLOE_OK;
    if (r->scene->method.stress == STRESS_USF)
        return bad_at(r, KEY("method", "stress"), "usl or musl", NULL,
                      "in 'ice-mpm' the forces that decide a contact are not known when usf takes strains");
    return check_materials(r);
}

/* Heavy points reach so far over the nodes of a light body, with splines, that they hold it when it should part: by a
 * few per cent of its velocity at 100 to 1, by all of it at 1e4 (inputs/extreme/impact.yaml). */
static const double most_density_ratio = 300.0;

static floe_status check_densities(reader *r)
{
    const scene *s = r->scene;
    double least = INFINITY, most = 0.0;
    if (strcmp(s->method.basis, "quadratic") != 0) return FLOE_OK;
    for (int b = 0; b < s->n_bodies; b++) {
        if (!scene_in_contact(s, b)) continue;
        least = fmin(least, s->material[s->body[b].material].density);
        most = fmax(most, s->material[s->body[b].material].density);
    }
    if (!(most > most_density_ratio * least)) return FLOE_OK;
    return bad_at(r, KEY("method", "basis"), "basis: linear, or gimp", NULL,
                  "bodies in contact have densities of %g and %g kg/m3: over %g to one, splines do not let them part",
                  least, most, most_density_ratio);
}

floe_status check_contact(reader *r)
{
    const scene *s = r->scene;
    if (!s->contact.enabled || !is_clean(r->root, KEY("contact"))) return FLOE_OK;
    int members = 0;
    for (int b = 0; b < s->n_bodies; b++) {
        if (s->body[b].material < 0) return FLOE_OK; /* another error */
        if (!scene_in_contact(s, b)) continue;
        members++;
        if (s->material[s->body[b].material].kind == MATERIAL_SOLID) continue;
        return bad_at(r, KEY("contact", "between"), "names of solid bodies", NULL,
                      "body '%s' is a fluid: fluids stick to what they touch", s->body[b].name);
    }
    if (members < 2) return bad_at(r, KEY("contact"), "two solid bodies or more", NULL, "there is nothing to touch");
    if (members > SCENE_MAX_CONTACT)
        return bad_at(r, KEY("contact", "between"), "fewer bodies", NULL, "%d bodies in contact are more than %d",
                      members, SCENE_MAX_CONTACT);
    TRY(check_densities(r));
    return check_contact_coupling(r);
}

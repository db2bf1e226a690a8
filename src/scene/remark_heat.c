/* Heat of solids that does not go where a deck may expect it to (theory 12.1). */
#include "scene/remark_internal.h"
#include "scene/solid_heat.h"

/* Beside fluids on cells heat passes the surface of a solid by conduction where both conduct and the interface is sharp, and by heat exchange where it is smeared. */
static void remark_insulated(remark_speaker *w, int material)
{
    const scene *s = w->s;
    const scene_material *m = &s->material[material];
    const bool sharp = s->method.interface == INTERFACE_SHARP;
    if (s->coupling != COUPLING_ICE_MPM || scene_enclosing_body(s) >= 0) return;
    if (!scene_solid_has_temperature(s, material, false) || (!sharp && scene_solid_exchanges_heat(s, material))) return;
    if (scene_heat_passes_walls(s) && m->conductivity > 0.0) return;
    remark_set_key(w, "materials", m->name, "");
    remark_key(
        w,
        "solid '%s' has a temperature, and exchanges no heat with the fluids about it: its surface is insulated. "
        "Heat passes a sharp interface if solid and fluid have a `conductivity`, and the cells of a smeared one by "
        "method.heat_exchange, or a pair of `exchange` with `heat`",
        m->name);
}

/* What burns keeps the temperature of the deck, whatever its fluids give it. */
static void remark_burning(remark_speaker *w, int material)
{
    const scene *s = w->s;
    const scene_material *m = &s->material[material];
    if (s->coupling != COUPLING_ICE_MPM || !scene_material_burns(s, material) ||
        !scene_solid_exchanges_heat(s, material))
        return;
    remark_set_key(w, "materials", m->name, "");
    remark_key(w, "solid '%s' burns and keeps its temperature: the heat that fluids exchange with it is lost", m->name);
}

static void remark_no_plastic_work(remark_speaker *w, const scene_material *m)
{
    if (!(m->plastic_heat > 0.0) || !m->law || (m->law->needs & SOLID_HAS_ENERGY)) return;
    remark_set_key(w, "materials", m->name, "plastic_heat");
    remark_key(w, "law '%s' has no plastic work: it makes no heat", m->law->name);
}

static void remark_no_expansion(remark_speaker *w, const scene_material *m)
{
    const bool expands = m->expansion != 0.0 || (solid_depends_on(m->law, m->law_par) & SOLID_BY_ENERGY);
    if (!(m->stress_free_temperature > 0.0) || expands) return;
    remark_set_key(w, "materials", m->name, "stress_free_temperature");
    remark_key(w, "solid '%s' has no `expansion`: its temperature strains nothing", m->name);
}

static bool conducts_in_contact(const scene *s, int body)
{
    const scene_material *m = &s->material[s->body[body].material];
    return remark_is_solid(m) && m->conductivity > 0.0 && scene_in_contact(s, body);
}

/* Bodies in contact have velocity fields of their own, and heat passes within one (theory 12.3). */
static void remark_parted(remark_speaker *w)
{
    const scene *s = w->s;
    const scene_body *first = NULL;
    for (int b = 0; b < s->n_bodies && s->coupling != COUPLING_ICE; ++b) {
        if (!conducts_in_contact(s, b)) continue;
        if (first) {
            remark_set_key(w, "contact", "between", "");
            remark_key(w,
                       "bodies '%s' and '%s' conduct heat, but none passes from one to the other where they are in "
                       "contact, and their friction heats neither. Leave `contact` out where they stay joined",
                       first->name, s->body[b].name);
            return;
        }
        first = &s->body[b];
    }
}

void remark_heat(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    for (int m = 0; m < s->n_materials; ++m) {
        bool used = false;
        for (int b = 0; b < s->n_bodies; ++b) used = used || s->body[b].material == m;
        if (!used || !remark_is_solid(&s->material[m]) || s->coupling == COUPLING_ICE) continue;
        remark_insulated(&w, m);
        remark_burning(&w, m);
        remark_no_plastic_work(&w, &s->material[m]);
        remark_no_expansion(&w, &s->material[m]);
    }
    remark_parted(&w);
}

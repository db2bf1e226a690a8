/* Defaults that depend on more than one key. */
#include "deck/deck_internal.h"
#include "scene/deck_location.h"
#include "scene/formula.h"
#include "scene/side_parts.h"
#include "scene/slender.h"

#include <math.h>
#include <stdio.h>

enum { ROOM_TEMPERATURE = 300 }; /* K */

static void finish_mesh(scene *s)
{
    for (int axis = 0; axis < s->mesh.dim; axis++) {
        const bc_side *side = s->bc.side[axis];
        s->mesh.periodic[axis] = side[SIDE_LOWER].kind == BC_PERIODIC && side[SIDE_UPPER].kind == BC_PERIODIC;
    }
}

static void finish_materials(scene *s)
{
    for (int i = 0; i < s->n_materials; i++) {
        scene_material *m = &s->material[i];
        if (m->kind != MATERIAL_SOLID) continue;
        if (isnan(m->tension_switch) && s->has_ambient) m->tension_switch = s->ambient_pressure;
    }
}

/* `sound`: the deck has no fault so far. */
static void finish_bodies(scene *s, bool sound)
{
    for (int i = 0; i < s->n_bodies; i++) {
        scene_body *b = &s->body[i];
        for (int axis = s->mesh.dim; axis < MESH_MAX_DIM; axis++) b->per_cell[axis] = 1;
        char key[SCENE_NAME + 16];
        (void)snprintf(key, sizeof key, "bodies.%s.points", b->name);
        if (sound && !scene_has_key(s, key)) slender_seed(s, b);
        const bool solid = b->material >= 0 && s->material[b->material].kind == MATERIAL_SOLID;
        if (!solid || !isnan(b->temperature)) continue;
        b->temperature = s->has_ambient ? s->ambient_temperature : ROOM_TEMPERATURE;
    }
}

/* The only fluid of the scene, -1 when there is none or a choice. */
static int only_fluid(const scene *s)
{
    int found = -1;
    for (int i = 0; i < s->n_materials; i++) {
        if (s->material[i].kind != MATERIAL_FLUID) continue;
        if (found >= 0) return -1;
        found = i;
    }
    return found;
}

/* Whether the only fluids are gases, or is the ambient: else a liquid may come back where the ambient is none. */
static bool ambient_is_all_outside(const scene *s)
{
    for (int i = 0; i < s->n_materials; i++) {
        if (s->material[i].kind != MATERIAL_FLUID || i == s->ambient_material) continue;
        if (!s->material[i].eos.model || eos_is_liquid(&s->material[i].eos)) return false;
    }
    return true;
}

/* What comes back through an outlet is the ambient at rest, and through a non-reflecting side the ambient, unless the deck says
 * otherwise. Of an ambient that differs from place to place, or moves, it is not known. */
static void finish_outside(const scene *s, bc_side *side)
{
    bool known = s->has_ambient && s->ambient_material >= 0 && !scene_formula_of(s, &s->ambient_temperature);
    for (int a = 0; a < s->mesh.dim && side->kind == BC_OUTLET; ++a)
        known = known && s->ambient_velocity[a] == 0.0 && !scene_formula_of(s, &s->ambient_velocity[a]);
    if (!known || side->temperature > 0.0 || scene_formula_of(s, &side->temperature)) return;
    if ((side->material >= 0 && side->material != s->ambient_material) || !ambient_is_all_outside(s)) return;
    side->material = s->ambient_material;
    side->temperature = s->ambient_temperature;
}

/* What lies behind the sides that a fluid crosses. */
static void finish_inlets(scene *s)
{
    const int fluid = only_fluid(s);
    scene_condition at;
    for (int i = 0; scene_next_condition(s, &i, &at);) {
        bc_side *side = at.part ? &s->part[i - 1 - 2 * s->mesh.dim].condition : &s->bc.side[at.axis][at.end];
        const bool flows = side->kind == BC_INLET || bc_gives_pressure(side->kind);
        if (side->kind == BC_OUTLET || side->kind == BC_NON_REFLECTING) finish_outside(s, side);
        if (flows && side->material < 0) side->material = fluid;
    }
}

floe_status finish_scene(reader *r)
{
    finish_mesh(r->scene);
    finish_materials(r->scene);
    finish_bodies(r->scene, r->errors->count == 0);
    finish_inlets(r->scene);
    return FLOE_OK;
}

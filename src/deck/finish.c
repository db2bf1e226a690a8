/* Defaults that depend on more than one key. */
#include "deck/deck_internal.h"
#include "geom/bounds.h"
#include "geom/images.h"
#include "scene/deck_location.h"
#include "scene/formula.h"
#include "scene/side_parts.h"
#include "scene/slender.h"
#include "scene/state.h"

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
        if (!scene_has_key(s, key)) membrane_seed(b);
        if (sound && !scene_has_key(s, key)) slender_seed(s, b);
        const bool solid = b->material >= 0 && s->material[b->material].kind == MATERIAL_SOLID;
        if (!solid || !isnan(b->temperature)) continue;
        b->temperature = s->has_ambient ? s->ambient_temperature : ROOM_TEMPERATURE;
    }
}

/* Whether a shape goes beyond a periodic side. Boxes across the domain have nothing to add. */
static bool passes_side(const scene *s, const shape *of, int axis)
{
    static const double round_off = 1e-9;
    double lo[3], hi[3];
    if (!s->mesh.periodic[axis] || !shape_bounds(of, s->mesh.dim, lo, hi)) return false;
    const double beyond = round_off * s->mesh.cell[axis];
    const bool below = s->mesh.lower[axis] - lo[axis] > beyond;
    const bool above = hi[axis] - s->mesh.upper[axis] > beyond;
    return (below || above) && !(below && above && shape_fills_bounds(of, s->mesh.dim));
}

/* What of a body lies beyond a periodic side comes in on the other. */
static floe_status finish_shapes(scene *s)
{
    for (int i = 0; i < s->n_bodies; i++) {
        shape *of = &s->body[i].shape;
        bool around[3] = {false};
        images *all;
        if (!of->model) continue;
        for (int a = 0; a < s->mesh.dim; ++a) around[a] = passes_side(s, of, a);
        if (!(around[0] || around[1] || around[2])) continue;
        TRY(scene_allocate(s, &all, sizeof *all));
        *of = images_make(all, of, s->mesh.dim, s->mesh.lower, s->mesh.upper, around, 0.0);
    }
    return FLOE_OK;
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

/* Whether the ambient may come in through an outlet by its own motion: where it differs from place to place, that is not known. */
static bool ambient_moves_in(const scene *s, const scene_condition *at)
{
    const double out = at->end ? s->ambient_velocity[at->axis] : -s->ambient_velocity[at->axis];
    for (int a = 0; a < s->mesh.dim; ++a)
        if (scene_formula_of(s, &s->ambient_velocity[a])) return true;
    return !(out >= 0.0);
}

/* What comes back through an outlet comes from the ambient, which is at rest across the side or moves away from it, and through a
 * non-reflecting side the ambient, unless the deck says otherwise. Of an ambient that differs from place to place it is not known, nor
 * of one that moves in. */
static void finish_outside(const scene *s, const scene_condition *at, bc_side *side)
{
    const bool outlet = side->kind == BC_OUTLET;
    if (!s->has_ambient || s->ambient_material < 0 || scene_formula_of(s, &s->ambient_temperature)) return;
    if (outlet && ambient_moves_in(s, at)) return;
    if ((side->material >= 0 && side->material != s->ambient_material) || !ambient_is_all_outside(s)) return;
    if (!(side->temperature > 0.0) && !scene_formula_of(s, &side->temperature)) {
        side->material = s->ambient_material;
        side->temperature = s->ambient_temperature;
    }
    if (side->temperature != s->ambient_temperature) return;
    for (int a = 0; a < s->mesh.dim && outlet; ++a) side->velocity[a] = a == at->axis ? 0.0 : s->ambient_velocity[a];
}

/* What lies behind the sides that a fluid crosses. */
static void finish_inlets(scene *s)
{
    const int fluid = only_fluid(s);
    scene_condition at;
    for (int i = 0; scene_next_condition(s, &i, &at);) {
        bc_side *side = at.part ? &s->part[i - 1 - 2 * s->mesh.dim].condition : &s->bc.side[at.axis][at.end];
        const bool flows = side->kind == BC_INLET || bc_gives_pressure(side->kind);
        if (side->kind == BC_OUTLET || side->kind == BC_NON_REFLECTING) finish_outside(s, &at, side);
        if (flows && side->material < 0) side->material = fluid;
    }
}

floe_status finish_scene(reader *r)
{
    finish_mesh(r->scene);
    if (r->errors->count == 0) TRY(finish_shapes(r->scene));
    finish_materials(r->scene);
    finish_bodies(r->scene, r->errors->count == 0);
    finish_inlets(r->scene);
    return FLOE_OK;
}

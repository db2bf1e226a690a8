/* Bodies and loads against the rest of the scene. */
#include "deck/check/check.h"
#include "scene/formula.h"
#include "scene/scene_reach.h"
#include "scene/solid_heat.h"

#include <math.h>

static floe_status check_fluid_body(reader *r, const scene_body *b, const scene_material *m)
{
    if (b->fraction < 1.0 && scene_runs_as(r->scene, COUPLING_MPM))
        return bad_at(r, KEY("bodies", b->name, "fraction"), "coupling: ice or ice-mpm, and no mpm in runs_as", NULL,
                      "body '%s' shares its volume with others, which material points cannot", b->name);
    if (isnan(b->pressure) || !m->eos.model || b->pressure > m->eos.model->pressure_floor(m->eos.par)) return FLOE_OK;
    return bad_at(r, KEY("bodies", b->name, "pressure"), NULL, NULL,
                  "'%s' does not exist at %g Pa: its pressure is above %g Pa. Give the absolute one", m->name,
                  b->pressure, m->eos.model->pressure_floor(m->eos.par));
}

/* A surface that encloses gas points: they fill its volume by their own volumes. */
static floe_status check_hold(reader *r, const scene_body *b)
{
    const scene *s = r->scene;
    bool filled = false;
    for (int i = 0; i < s->n_bodies; i++) filled = filled || s->body[i].material == b->membrane.encloses;
    if (!filled)
        return bad_at(r, KEY("bodies", b->name, "membrane", "encloses"), NULL, "add a body of it",
                      "membrane '%s' encloses '%s', of which there is no body", b->name,
                      s->material[b->membrane.encloses].name);
    if (s->method.density != DENSITY_CONTINUITY)
        return bad_at(r, KEY("method", "point_density"), "continuity", NULL,
                      "gas that surface '%s' encloses has its density by its own volume", b->name);
    for (int a = 0; a < s->mesh.dim; a++)
        if (s->mesh.periodic[a])
            return bad_at(r, KEY("boundaries"), "no periodic sides", NULL,
                          "surface '%s' encloses gas, whose volume across periodic sides is not known", b->name);
    return FLOE_OK;
}

/* Beside cells each membrane holds a gas of its own; alone one surface in space holds gas points. */
static floe_status check_holder(reader *r, const scene_body *b)
{
    const scene *s = r->scene;
    int before = 0;
    for (const scene_body *other = s->body; other < b; ++other) {
        if (!other->membrane.present || other->membrane.encloses < 0) continue;
        before++;
        const bool surface = b->membrane.surface.kind != SHEET_NONE || other->membrane.surface.kind != SHEET_NONE;
        if (surface && scene_runs_as(s, COUPLING_MPM))
            return bad_at(r, KEY("bodies", b->name, "membrane", "encloses"),
                          "one surface around gas points; more beside cells (ice-mpm)", NULL,
                          "membrane '%s' encloses a gas already", other->name);
        if (other->membrane.encloses == b->membrane.encloses)
            return bad_at(r, KEY("bodies", b->name, "membrane", "encloses"),
                          "a fluid of its own, which may have the same eos", NULL,
                          "membrane '%s' encloses '%s' already", other->name, s->material[b->membrane.encloses].name);
    }
    if (before < SCENE_MAX_ENCLOSING) return FLOE_OK;
    return bad_at(r, KEY("bodies", b->name, "membrane", "encloses"), "fewer membranes around gas", NULL,
                  "%d membranes enclose gas already", before);
}

/* Beside cells membranes hold gases; others are strings that gas passes. */
static floe_status check_membrane(reader *r, const scene_body *b)
{
    const scene *s = r->scene;
    if (is_clean(r->root, KEY("domain"))) TRY(check_membrane_points(r, (int)(b - r->scene->body)));
    if (b->membrane.encloses >= 0 && s->material[b->membrane.encloses].kind == MATERIAL_SOLID)
        return bad_at(r, KEY("bodies", b->name, "membrane", "encloses"), "the name of a fluid", NULL, "'%s' is a solid",
                      s->material[b->membrane.encloses].name);
    if (b->membrane.encloses >= 0) TRY(check_holder(r, b));
    if (b->membrane.encloses >= 0 && b->membrane.surface.kind != SHEET_NONE && scene_runs_as(s, COUPLING_MPM))
        TRY(check_hold(r, b));
    if (!scene_runs_as(s, COUPLING_ICE_MPM) || scene_enclosing_body(s) >= 0) return FLOE_OK;
    return bad_at(r, KEY("bodies", b->name, "membrane"), "encloses: the gas on its left; or coupling: mpm", NULL,
                  "cells do not see membrane '%s' unless it encloses a gas", b->name);
}

/* A solid that conducts, expands or is heated by plastic work has a temperature; one without has no use for a formula. */
static floe_status check_temperature(reader *r, const scene_body *b, const scene_material *m)
{
    const scene *s = r->scene;
    const char *asks = m->conductivity > 0.0   ? "conductivity"
                       : m->expansion != 0.0   ? "expansion"
                       : m->plastic_heat > 0.0 ? "plastic_heat"
                                               : NULL;
    if (!is_clean(r->root, KEY("materials", m->name))) return FLOE_OK;
    if (asks && isnan(m->specific_heat))
        return bad_at(r, KEY("materials", m->name, "specific_heat"), "specific_heat: a number > 0 in J/kg/K", NULL,
                      "solid '%s' has '%s', and no specific heat", m->name, asks);
    if (scene_formula_of(s, &b->temperature) && !scene_solid_has_temperature(s, b->material, true))
        return bad_at(
            r, KEY("bodies", b->name, "temperature"), "a number", NULL,
            "solid '%s' has one temperature: formulas are for those with conductivity, plastic_heat, expansion "
            "or heat exchange",
            b->name);
    return FLOE_OK;
}

/* Shear out of the plane of the scene turns nothing in it. */
static floe_status check_stress(reader *r, const scene_body *b)
{
    const int dim = r->scene->mesh.dim;
    for (int c = dim == 1 ? 3 : 4; dim < 3 && c < 6; c++)
        if (b->stress[c] != 0.0 || scene_formula_of(r->scene, &b->stress[c]))
            return bad_at(r, KEY("bodies", b->name, "stress"),
                          dim == 1 ? "xx, yy, zz, 0, 0, 0" : "xx, yy, zz, xy, 0, 0", NULL,
                          "body '%s' has no shear out of a scene of %d dimension%s", b->name, dim, dim == 1 ? "" : "s");
    return FLOE_OK;
}

/* What the cells of a coupled run need to know of a solid; beside a membrane around gas they see none. */
static floe_status check_solid_body(reader *r, const scene_body *b, const scene_material *m)
{
    TRY(check_temperature(r, b, m));
    if (is_clean(r->root, KEY("domain"))) TRY(check_stress(r, b));
    if (!scene_runs_as(r->scene, COUPLING_ICE_MPM) || !is_clean(r->root, KEY("materials", m->name))) return FLOE_OK;
    if (scene_enclosing_body(r->scene) >= 0) return FLOE_OK;
    if (isnan(m->specific_heat)) {
        return bad_at(r, KEY("materials", m->name, "specific_heat"), "specific_heat: a number > 0 in J/kg/K", NULL,
                      "'ice-mpm' needs the specific heat of solid '%s'", m->name);
    }
    if (isnan(m->tension_switch) || m->tension_switch > 0.0 || !is_clean(r->root, KEY("ambient"))) return FLOE_OK;
    return bad_at(r, KEY("materials", m->name, "tension_switch"), "tension_switch: a number > 0 in Pa", NULL,
                  "solid '%s' needs a tension_switch, for the ambient pressure is not above zero", m->name);
}

/* Points that fill their shape go by the mesh. */
static floe_status check_seeding(reader *r, const scene_body *b)
{
    bool moved = false;
    for (int axis = 0; axis < r->scene->mesh.dim; axis++) moved = moved || r->scene->lattice_offset[axis] != 0.0;
    if (!moved || b->seeding == SEED_LATTICE) return FLOE_OK;
    return bad_at(r, KEY("bodies", b->name), "seeding: lattice", NULL,
                  "'domain.lattice_offset' moves lattices, and the points of body '%s' fill its shape", b->name);
}

static floe_status check_body(reader *r, const scene_body *b)
{
    const scene *s = r->scene;
    if (!is_clean(r->root, KEY("bodies", b->name)) || b->material < 0) return FLOE_OK;
    const scene_material *m = &s->material[b->material];
    if (is_clean(r->root, KEY("domain")) && !scene_meets_domain(s, &b->shape)) {
        TRY(bad_at(r, KEY("bodies", b->name, "shape"), "a shape that meets the domain", NULL,
                   "body '%s' lies outside the domain", b->name));
    }
    TRY(check_seeding(r, b));
    if (b->initial_from_exact && !node_path(r->root, KEY("verify", "exact"))) {
        TRY(bad_at(r, KEY("bodies", b->name, "state"), "verify: {exact: {...}}", NULL,
                   "body '%s' starts from the exact solution, and 'verify' names none", b->name));
    }
    if (m->membrane) return check_membrane(r, b);
    return m->kind == MATERIAL_FLUID ? check_fluid_body(r, b, m) : check_solid_body(r, b, m);
}

/* Springs and supports act on points; `smeared`: also where these share cells with fluids. */
static floe_status check_points_only(reader *r, const char *key, int n, bool smeared)
{
    const scene_coupling cells[] = {COUPLING_ICE, COUPLING_ICE_MPM};
    const bool is_cut =
        scene_is_cut(r->scene) || r->scene->method.interface == INTERFACE_AUTO; /* not settled: another error */
    for (int b = 0; b < r->scene->n_bodies; b++)
        if (r->scene->body[b].material < 0) return FLOE_OK; /* another error */
    for (int i = 0; n > 0 && i < 2; i++) {
        if (!scene_runs_as(r->scene, cells[i]) || (i == 1 && (is_cut || smeared))) continue;
        return bad_at(r, KEY(key), smeared ? "coupling: mpm or ice-mpm" : "coupling: mpm", NULL,
                      "%s act on material points alone, and this deck runs as '%s'", key, coupling_name(cells[i]));
    }
    return FLOE_OK;
}

floe_status check_bodies(reader *r)
{
    TRY(check_points_only(r, "springs", r->scene->n_springs, true));
    TRY(check_points_only(r, "supports", r->scene->n_supports, false));
    for (int i = 0; i < r->scene->n_bodies; i++) TRY(check_body(r, &r->scene->body[i]));
    return FLOE_OK;
}

static const char *const load_names[] = {"pressurise", "heat", "traction", "body_force"};

/* Neither a pressure nor a vector, by number or by formula. */
static bool is_without_load(const scene *s, const scene_load *load)
{
    bool any = load->target != 0.0 || scene_formula_of(s, &load->target);
    for (int a = 0; a < 3; ++a) any = any || load->vector[a] != 0.0 || scene_formula_of(s, &load->vector[a]);
    return !any;
}

static floe_status check_load(reader *r, const scene_load *load)
{
    const scene *s = r->scene;
    const char *kind = load_names[load->kind];
    if (!is_clean(r->root, KEY("loads", load->name))) return FLOE_OK;
    if (load->material >= 0 && s->material[load->material].kind == MATERIAL_SOLID) {
        TRY(bad_at(r, KEY("loads", load->name, kind, "material"), "the name of a fluid", NULL, "'%s' is a solid",
                   s->material[load->material].name));
    }
    const int body_material = load->body >= 0 ? s->body[load->body].material : -1;
    if (load->kind == LOAD_TRACTION && body_material >= 0 && s->material[body_material].kind == MATERIAL_FLUID) {
        TRY(bad_at(r, KEY("loads", load->name, kind, "body"), "the name of a solid body", NULL,
                   "'%s' is a fluid: a traction acts on solids", s->body[load->body].name));
    }
    if (load->kind == LOAD_TRACTION && body_material >= 0 && s->material[body_material].membrane) {
        TRY(bad_at(r, KEY("loads", load->name, kind, "body"), "the name of a solid body",
                   "membranes: gas on one side (membrane.encloses), or a body_force",
                   "'%s' is a membrane, which has no shape: a traction acts on the surface of a shape",
                   s->body[load->body].name));
    }
    if (load->kind == LOAD_TRACTION && is_without_load(s, load)) {
        TRY(bad_at(r, KEY("loads", load->name, kind), "pressure, vector, or both", NULL,
                   "load '%s' says neither a pressure nor a vector", load->name));
    }
    if (load->ramp > 0.0 && load->ramp_steps > 0) {
        TRY(bad_at(r, KEY("loads", load->name, kind, "ramp_steps"), "one of ramp and ramp_steps", NULL,
                   "the ramp is given as a time and as a number of steps"));
    }
    if (is_clean(r->root, KEY("domain")) && !scene_meets_domain(s, &load->region)) {
        const char *region = load->kind == LOAD_TRACTION ? "surface" : "region";
        TRY(bad_at(r, KEY("loads", load->name, kind, region), "a shape that meets the domain", NULL,
                   "load '%s' acts outside the domain", load->name));
    }
    return FLOE_OK;
}

floe_status check_loads(reader *r)
{
    for (int i = 0; i < r->scene->n_loads; i++) TRY(check_load(r, &r->scene->load[i]));
    return FLOE_OK;
}

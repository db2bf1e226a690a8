/* The sides of the domain against each other and against the materials. */
#include "deck/check/check.h"

#include "deck/deck_internal.h"
#include "scene/side_parts.h"
#include "scene/solid_heat.h"

#include <math.h>
#include <stddef.h>

/* Some fluid of the scene has a coefficient above zero. */
static bool some_fluid(const scene *s, size_t coefficient)
{
    for (int i = 0; i < s->n_materials; i++) {
        const double value = *(const double *)(const void *)((const char *)&s->material[i] + coefficient);
        if (s->material[i].kind == MATERIAL_FLUID && value > 0.0) return true;
    }
    return false;
}

/* Heat of a wall needs a fluid or a solid that conducts, and is given in one way. */
static floe_status check_wall(reader *r, const bc_side *side, const char *const *path)
{
    const bool temperature = side->temperature > 0.0, flux = side->heat_flux != 0.0;
    if (temperature && flux) {
        return bad_at(r, path, "temperature or heat_flux", NULL,
                      "a wall has a temperature (%g K) or a heat flux (%g W/m2), not both", side->temperature,
                      side->heat_flux);
    }
    if ((temperature || flux) && !some_fluid(r->scene, offsetof(scene_material, conductivity)) &&
        !scene_some_solid_conducts(r->scene)) {
        return bad_at(r, path, NULL, "give a fluid a 'conductivity', or a solid, or leave the wall's heat out",
                      "no fluid or solid conducts heat: the wall's %s would have no effect",
                      temperature ? "temperature" : "heat flux");
    }
    return FLOE_OK;
}

/* A wall moves along itself, and drags what is viscous or made of points. */
static floe_status check_drag(reader *r, const bc_side *side, int axis, const char *const *path)
{
    const scene *s = r->scene;
    double along = 0.0;
    for (int a = 0; a < s->mesh.dim; a++) along += a == axis ? 0.0 : fabs(side->velocity[a]);
    if (side->velocity[axis] != 0.0) {
        return bad_at(r, path, "a velocity along the wall",
                      "a side that moves across itself is 'velocity: {velocity: ...}'",
                      "a no_slip wall cannot move across itself (%g m/s)", side->velocity[axis]);
    }
    const bool cells = scene_runs_as(s, COUPLING_ICE) && !scene_runs_as(s, COUPLING_MPM);
    if (along == 0.0 || !cells || some_fluid(s, offsetof(scene_material, shear_viscosity))) return FLOE_OK;
    return bad_at(r, path, NULL, "give a fluid a 'viscosity', or take 'slip'",
                  "no fluid is viscous: the wall's velocity would have no effect");
}

static floe_status check_exists(reader *r, const scene_material *m, double pressure, const char *const *path)
{
    if (!m->eos.model || pressure > m->eos.model->pressure_floor(m->eos.par)) return FLOE_OK;
    return bad_at(r, path, NULL, NULL,
                  "'%s' does not exist at %g Pa: its pressure is above %g Pa. Give the absolute one", m->name, pressure,
                  m->eos.model->pressure_floor(m->eos.par));
}

/* The fluid that exists at the lowest pressure, of which something may leave: a side's own, else of all; -1: none. */
static int hardiest_fluid(const scene *s, const bc_side *side)
{
    int found = -1;
    if (side->material >= 0) return s->material[side->material].kind == MATERIAL_FLUID ? side->material : -1;
    for (int m = 0; m < s->n_materials; m++) {
        const eos *law = &s->material[m].eos, *best = found < 0 ? NULL : &s->material[found].eos;
        if (s->material[m].kind != MATERIAL_FLUID || !law->model) continue;
        if (!best || law->model->pressure_floor(law->par) < best->model->pressure_floor(best->par)) found = m;
    }
    return found;
}

/* Cells take the pressure behind a side that nothing enters by, too. Points see none but the reference's, which may be 0. */
static floe_status check_outside_pressure(reader *r, const bc_side *side, const char *const *path)
{
    const scene *s = r->scene;
    const int fluid = hardiest_fluid(s, side);
    if (fluid < 0 || (!scene_runs_as(s, COUPLING_ICE) && !scene_runs_as(s, COUPLING_ICE_MPM))) return FLOE_OK;
    return check_exists(r, &s->material[fluid], side->pressure, path);
}

/* What lies behind an open side is a fluid that exists at the side's pressure. */
static floe_status check_open(reader *r, const bc_side *side, const char *const *path)
{
    const scene *s = r->scene;
    const bool characteristic = side->kind == BC_RESERVOIR || side->kind == BC_NON_REFLECTING;
    const bool needs = side->kind == BC_INLET || side->kind == BC_RESERVOIR, holds = needs || side->temperature > 0.0;
    if (side->kind != BC_OUTLET && !needs && !characteristic) return FLOE_OK;
    if (characteristic && s->method.pressure != PRESSURE_EXPLICIT && scene_runs_as(s, COUPLING_ICE)) {
        return bad_at(r, path, "inlet or outlet, or method: {pressure: explicit}", NULL,
                      "'%s' follows waves, which an implicit pressure does not resolve", bc_name(side->kind));
    }
    if (!holds) return check_outside_pressure(r, side, path);
    if (side->material < 0) {
        return bad_at(r, path, "material: the name of a fluid", NULL,
                      "the scene has no fluid, or several: which enters?");
    }
    const scene_material *m = &s->material[side->material];
    if (m->kind != MATERIAL_FLUID) {
        return bad_at(r, path, "material: the name of a fluid", NULL, "'%s' is a solid and cannot flow in", m->name);
    }
    return check_exists(r, m, side->pressure, path);
}

static floe_status check_periodic(reader *r, const scene_condition *at, const char *const *path)
{
    const scene *s = r->scene;
    const char *name = axis_name(&s->mesh, at->axis);
    if (at->part && (at->side->kind == BC_PERIODIC || s->mesh.periodic[at->axis]))
        return bad_at(r, path, "another condition", NULL, "a periodic side has no parts");
    if (at->side->kind != BC_PERIODIC) return FLOE_OK;
    if (!s->mesh.periodic[at->axis])
        return bad_at(r, path, "periodic on both sides, or on none", NULL,
                      "one side of %s is periodic, the other is not", name);
    if (s->mesh.geometry == MESH_AXISYMMETRIC && at->axis == 0)
        return bad_at(r, path, NULL, NULL, "a radius cannot be periodic");
    return FLOE_OK;
}

/* A part has faces: the middle of some face of its side is in it. */
static floe_status check_part(reader *r, const scene_condition *at)
{
    const scene *s = r->scene;
    int n[3] = {1, 1, 1};
    for (int a = 0; a < s->mesh.dim; a++)
        n[a] = a == at->axis ? 1 : (int)fmin(1e4, rint((s->mesh.upper[a] - s->mesh.lower[a]) / s->mesh.cell[a]));
    for (int k = 0; k < n[0] * n[1] * n[2]; k++) {
        const int face[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        double x[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < s->mesh.dim; a++) x[a] = s->mesh.lower[a] + (face[a] + 0.5) * s->mesh.cell[a];
        x[at->axis] = at->end == SIDE_LOWER ? s->mesh.lower[at->axis] : s->mesh.upper[at->axis];
        if (scene_condition_at(s, at->axis, at->end, x) == at->side) return FLOE_OK;
    }
    return bad_at(
        r, KEY("boundary_parts", at->part, "where"), "a shape that contains the middle of a face of the side", NULL,
        "no face of the side is part '%s': its faces are %g m wide, and a shape that ends on the side has none of it",
        at->part, s->mesh.cell[at->axis == 0 && s->mesh.dim > 1 ? 1 : 0]);
}

static floe_status check_condition(reader *r, const scene_condition *at)
{
    const bc_side *side = at->side;
    const char *name = axis_name(&r->scene->mesh, at->axis), *end = at->end == SIDE_LOWER ? "lower" : "upper";
    const char *const *path = at->part ? KEY("boundary_parts", at->part) : KEY("boundaries", name, end);
    if (at->part && !is_clean(r->root, path)) return FLOE_OK;
    TRY(check_periodic(r, at, path));
    if (at->part) TRY(check_part(r, at));
    if (side->kind == BC_SLIP || side->kind == BC_NO_SLIP) TRY(check_wall(r, side, path));
    if (side->kind == BC_NO_SLIP) TRY(check_drag(r, side, at->axis, path));
    return check_open(r, side, path);
}

floe_status check_boundaries(reader *r)
{
    scene_condition at;
    if (!is_clean(r->root, KEY("boundaries")) || !is_clean(r->root, KEY("domain"))) return FLOE_OK;
    for (int i = 0; scene_next_condition(r->scene, &i, &at);) TRY(check_condition(r, &at));
    return FLOE_OK;
}

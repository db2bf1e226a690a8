/* The sides of the domain against each other and against the materials. */
#include "deck/check/check.h"

#include "deck/deck_internal.h"

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

/* Heat of a wall needs a fluid that conducts, and is given in one way. */
static floe_status check_wall(reader *r, const bc_side *side, const char *const *path)
{
    const bool temperature = side->temperature > 0.0, flux = side->heat_flux != 0.0;
    if (temperature && flux) {
        return bad_at(r, path, "temperature or heat_flux", NULL,
                      "a wall has a temperature (%g K) or a heat flux (%g W/m2), not both", side->temperature,
                      side->heat_flux);
    }
    if ((temperature || flux) && !some_fluid(r->scene, offsetof(scene_material, conductivity))) {
        return bad_at(r, path, NULL, "give a fluid a 'conductivity', or leave the wall's heat out",
                      "no fluid conducts heat: the wall's %s would have no effect",
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

static floe_status check_side(reader *r, int axis, int i)
{
    scene *s = r->scene;
    const bc_side *side = &s->bc.side[axis][i];
    const char *name = axis_name(&s->mesh, axis), *end = i == SIDE_LOWER ? "lower" : "upper";
    const char *const *path = KEY("boundaries", name, end);
    if (side->kind == BC_PERIODIC && !s->mesh.periodic[axis]) {
        return bad_at(r, path, "periodic on both sides, or on none", NULL,
                      "one side of %s is periodic, the other is not", name);
    }
    if (side->kind == BC_PERIODIC && s->mesh.geometry == MESH_AXISYMMETRIC && axis == 0) {
        return bad_at(r, path, NULL, NULL, "a radius cannot be periodic");
    }
    if (side->kind == BC_SLIP || side->kind == BC_NO_SLIP) TRY(check_wall(r, side, path));
    if (side->kind == BC_NO_SLIP) TRY(check_drag(r, side, axis, path));
    return check_open(r, side, path);
}

floe_status check_boundaries(reader *r)
{
    if (!is_clean(r->root, KEY("boundaries")) || !is_clean(r->root, KEY("domain"))) return FLOE_OK;
    for (int axis = 0; axis < r->scene->mesh.dim; axis++) {
        for (int side = 0; side < 2; side++) TRY(check_side(r, axis, side));
    }
    return FLOE_OK;
}

#include "scene/fluid_columns.h"

#include "scene/formula.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

bool scene_adds_weight(const scene *s)
{
    if (s->has_ambient && scene_formula_of(s, &s->ambient_pressure)) return false;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_body *body = &s->body[b];
        if (s->material[body->material].kind != MATERIAL_FLUID) continue;
        if (body->initial_from_exact || scene_formula_of(s, &body->pressure)) return false;
    }
    return true;
}

bool scene_bears_weight(const scene *s, int axis)
{
    const bc_side *side = s->bc.side[axis];
    if (side[0].kind == BC_PERIODIC || side[1].kind == BC_PERIODIC) return false;
    return !bc_gives_pressure(side[0].kind) || !bc_gives_pressure(side[1].kind) || side[0].pressure != side[1].pressure;
}

bool scene_is_given_by_density(const scene *s, int material)
{
    if (s->has_ambient && s->ambient_material == material) return false;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material && isnan(s->body[b].density)) return false;
    return true;
}

void scene_find_pulls(const scene *s, double pull[SCENE_MAX_BODIES][3])
{
    memset(pull, 0, SCENE_MAX_BODIES * sizeof *pull);
    for (int l = 0; l < s->n_loads; ++l) {
        const scene_load *load = &s->load[l];
        double acceleration[3];
        if (load->kind != LOAD_BODY_FORCE || !load_is_uniform(s, load) || load->start > 0.0 || load->ramp > 0.0 ||
            load->ramp_steps > 0)
            continue;
        load_acceleration(s, load, 0.0, acceleration);
        for (int b = 0; b < s->n_bodies; ++b)
            for (int a = 0; a < s->mesh.dim; ++a)
                if (load->body < 0 || load->body == b) pull[b][a] += acceleration[a];
    }
}

int scene_point_columns(const scene *s, double pull[SCENE_MAX_BODIES])
{
    double all[SCENE_MAX_BODIES][3];
    int axis = -1;
    double way = 0.0;
    memset(pull, 0, SCENE_MAX_BODIES * sizeof *pull);
    if (s->coupling != COUPLING_MPM || s->time.solver != SOLVER_DYNAMIC || !scene_adds_weight(s)) return -1;
    scene_find_pulls(s, all);
    for (int b = 0; b < s->n_bodies; ++b)
        for (int a = 0; a < s->mesh.dim; ++a) {
            if (all[b][a] == 0.0 || s->material[s->body[b].material].kind != MATERIAL_FLUID) continue;
            if ((axis >= 0 && axis != a) || way * all[b][a] < 0.0) return -1;
            axis = a;
            way = all[b][a];
            pull[b] = all[b][a];
        }
    return axis >= 0 && scene_bears_weight(s, axis) ? axis : -1;
}

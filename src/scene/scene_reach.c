#include "scene/scene_reach.h"

#include "geom/bounds.h"

bool scene_meets_domain(const scene *s, const shape *part)
{
    double lo[3] = {0}, hi[3] = {0};
    if (!shape_bounds(part, s->mesh.dim, lo, hi)) return true;
    for (int axis = 0; axis < s->mesh.dim; axis++)
        if (!(hi[axis] > s->mesh.lower[axis] && lo[axis] < s->mesh.upper[axis])) return false;
    return true;
}

bool body_reaches_side(const scene *s, const scene_body *b, int axis, int side)
{
    double lo[3] = {0.0}, hi[3] = {0.0};
    const mesh_spec *m = &s->mesh;
    if (!b->shape.model) return false;
    if (!shape_bounds(&b->shape, m->dim, lo, hi)) return true;
    return side == 0 ? lo[axis] < m->lower[axis] + m->cell[axis] : hi[axis] > m->upper[axis] - m->cell[axis];
}

static bool is_liquid(const scene *s, int material)
{
    return s->material[material].kind == MATERIAL_FLUID && eos_is_liquid(&s->material[material].eos);
}

bool scene_has_liquid(const scene *s)
{
    bool found = s->has_ambient && is_liquid(s, s->ambient_material);
    for (int k = 0; k < s->n_bodies; ++k) found = found || is_liquid(s, s->body[k].material);
    return found;
}

bool liquid_reaches_side(const scene *s, int axis, int side)
{
    if (s->has_ambient && is_liquid(s, s->ambient_material)) return true;
    for (int k = 0; k < s->n_bodies; ++k)
        if (is_liquid(s, s->body[k].material) && body_reaches_side(s, &s->body[k], axis, side)) return true;
    return false;
}

char axis_letter(const scene *s, int axis)
{
    return (s->mesh.geometry == MESH_AXISYMMETRIC ? "rz" : "xyz")[axis];
}

static bool bounds_of(const scene *s, const scene_body *b, double lo[3], double hi[3])
{
    return b->shape.model && shape_bounds(&b->shape, s->mesh.dim, lo, hi);
}

bool body_stands_on_side(const scene *s, const scene_body *b, int axis, int side)
{
    double lo[3] = {0.0}, hi[3] = {0.0};
    const double near = BODIES_TOUCH * s->mesh.cell[axis];
    if (!bounds_of(s, b, lo, hi)) return false;
    return side == 0 ? lo[axis] <= s->mesh.lower[axis] + near : hi[axis] >= s->mesh.upper[axis] - near;
}

static bool is_solid(const scene *s, const scene_body *b)
{
    return b->shape.model && s->material[b->material].kind == MATERIAL_SOLID && !s->material[b->material].membrane;
}

bool bodies_meet(const scene *s, const scene_body *a, const scene_body *b, double share)
{
    double lo[2][3], hi[2][3];
    if (!bounds_of(s, a, lo[0], hi[0]) || !bounds_of(s, b, lo[1], hi[1])) return true;
    for (int d = 0; d < s->mesh.dim; ++d) {
        const double near = share * s->mesh.cell[d];
        if (lo[0][d] > hi[1][d] + near || lo[1][d] > hi[0][d] + near) return false;
    }
    return true;
}

int scene_mark_group(const scene *s, int first, body_relation *joined, bool of[SCENE_MAX_BODIES])
{
    int n = 1;
    bool grows = true;
    of[first] = true;
    while (grows) {
        grows = false;
        for (int a = 0; a < s->n_bodies; ++a)
            for (int b = 0; b < s->n_bodies && !of[a]; ++b)
                if (of[b] && joined(s, &s->body[a], &s->body[b])) {
                    of[a] = grows = true;
                    ++n;
                }
    }
    return n;
}

static bool hang_together(const scene *s, const scene_body *a, const scene_body *b)
{
    return is_solid(s, a) && bodies_meet(s, a, b, BODIES_TOUCH);
}

static bool group_reaches_side(const scene *s, const bool *of, int axis, int side)
{
    for (int a = 0; a < s->n_bodies; ++a)
        if (of[a] && body_reaches_side(s, &s->body[a], axis, side)) return true;
    return false;
}

/* Whether gas can come from the side of a group to what opens beneath it. */
static bool leaves_a_way(const scene *s, const bool *of, int axis)
{
    for (int a = 0; a < s->mesh.dim; ++a)
        if (a != axis && !(group_reaches_side(s, of, a, 0) && group_reaches_side(s, of, a, 1))) return true;
    return false;
}

static bool stands_in_corner(const scene *s, const scene_body *b)
{
    int along = 0;
    for (int a = 0; a < s->mesh.dim; ++a)
        along += (s->bc.side[a][0].kind == BC_SLIP && body_stands_on_side(s, b, a, 0)) ||
                 (s->bc.side[a][1].kind == BC_SLIP && body_stands_on_side(s, b, a, 1));
    return along > 1;
}

bool scene_can_leave_side(const scene *s, const scene_body *b, int axis, int side)
{
    if (s->mesh.dim == 1 || s->method.pressure != PRESSURE_EXPLICIT || s->bc.side[axis][side].kind != BC_SLIP)
        return false;
    if (!is_solid(s, b) || b->motion.kind == MOTION_FIXED) return false;
    if (!body_stands_on_side(s, b, axis, side) || stands_in_corner(s, b)) return false;
    if (scene_has_liquid(s)) return false;
    bool of[SCENE_MAX_BODIES] = {false};
    scene_mark_group(s, (int)(b - s->body), hang_together, of);
    return !group_reaches_side(s, of, axis, !side) && leaves_a_way(s, of, axis);
}

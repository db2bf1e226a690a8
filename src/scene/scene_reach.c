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

#include "scene/side_parts.h"

#include "scene/formula.h"

const bc_side *scene_condition_at(const scene *s, int axis, int side, const double x[3])
{
    for (int k = 0; k < s->n_parts; ++k) {
        const scene_side_part *part = &s->part[k];
        if (part->axis == axis && part->end == side && shape_inside(&part->where, s->mesh.dim, x))
            return &part->condition;
    }
    return &s->bc.side[axis][side];
}

bool scene_side_varies(const scene *s, int axis, int side)
{
    for (int k = 0; k < s->n_parts; ++k)
        if (s->part[k].axis == axis && s->part[k].end == side) return true;
    return scene_varies(s, &s->bc.side[axis][side], sizeof s->bc.side[axis][side]);
}

bool scene_next_condition(const scene *s, int *i, scene_condition *out)
{
    const int sides = 2 * s->mesh.dim, k = (*i)++;
    if (k < sides) {
        *out = (scene_condition){&s->bc.side[k / 2][k % 2], k / 2, k % 2, NULL};
        return true;
    }
    if (k >= sides + s->n_parts) return false;
    const scene_side_part *part = &s->part[k - sides];
    *out = (scene_condition){&part->condition, part->axis, part->end, part->name};
    return true;
}

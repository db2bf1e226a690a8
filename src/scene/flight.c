#include "scene/flight.h"

#include "geom/bounds.h"

#include <math.h>
#include <stdio.h>

static bool lets_points_out(bc_kind kind)
{
    return kind == BC_FREE || bc_gives_pressure(kind);
}

/* When the body's box comes to the side; INFINITY: it does not go there. */
static double time_to_side(const scene *s, const scene_body *b, int axis, int side)
{
    const mesh_spec *m = &s->mesh;
    double lo[3] = {0.0}, hi[3] = {0.0};
    const double toward = side == 0 ? -b->velocity[axis] : b->velocity[axis];
    if (!(toward > 0.0) || !shape_bounds(&b->shape, m->dim, lo, hi)) return INFINITY;
    const double distance = side == 0 ? lo[axis] - m->lower[axis] : m->upper[axis] - hi[axis];
    return fmax(distance, 0.0) / toward;
}

scene_flight scene_flight_out(const scene *s)
{
    for (int b = 0; b < s->n_bodies && s->time.solver == SOLVER_DYNAMIC; b++)
        for (int axis = 0; axis < s->mesh.dim && s->material[s->body[b].material].kind == MATERIAL_SOLID; axis++)
            for (int side = 0; side < 2; side++) {
                const double time = time_to_side(s, &s->body[b], axis, side);
                if (lets_points_out(s->bc.side[axis][side].kind) && time < s->time.end)
                    return (scene_flight){b, axis, side, time};
            }
    return (scene_flight){.body = -1};
}

void scene_side_name(const scene *s, int axis, int side, char text[16])
{
    const char letter = (s->mesh.geometry == MESH_AXISYMMETRIC ? "rz" : "xyz")[axis];
    (void)snprintf(text, 16, "%c.%s", letter, side ? "upper" : "lower");
}

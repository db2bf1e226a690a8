/* Seeding of membranes: points along a curve or on a surface, with slack, and with masses of their own. */
#include "mpm/membrane/membrane_points.h"
#include "scene/state.h"

#include <stdio.h>

static bool is_surface(const scene_body *b)
{
    return b->membrane.surface.kind != SHEET_NONE;
}

floe_status seed_membrane(const mpm *s, const scene_body *b, const seed_spec *grid, seed_list *list)
{
    return fail_under(s->ctx, body_points(b, s->ctx, grid, list), KEY("bodies", b->name, "membrane"));
}

double slack_of(const mpm *s, int body, size_t number)
{
    return membrane_slack(&s->scene->body[s->body[body].scene_body].membrane, number);
}

floe_status set_membrane(mpm *s, int blk, int body, size_t k, size_t n)
{
    const scene_body *b = &s->scene->body[s->body[body].scene_body];
    const scene_membrane *m = &b->membrane;
    const fields *f = s->domain->fields[blk];
    const long number = (long)n + 1;
    if (!is_surface(b)) field_get(f, P_STRAIN, body, 0)[k] = -slack_of(s, body, n);
    if (!is_surface(b) && s->carries[P_STRAIN_HOOP])
        field_get(f, P_STRAIN_HOOP, body, 0)[k] = 0.0 - slack_of(s, body, n);
    double *mass = &field_get(f, P_MASS, body, 0)[k];
    if (number == m->heavy_point) *mass = m->heavy_mass / scene_extent(s->scene);
    if (*mass > 0.0) return FLOE_OK;
    return fail_key(s->ctx, KEY("bodies", b->name, "membrane"),
                    "point %ld has no mass: give the curve a length, or the point a heavy_mass", number);
}

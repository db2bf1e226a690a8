/* The points of a body that lies along a curve or on a surface. */
#include "scene/state.h"

#include <math.h>

/* With normals of their own, a length that they share and no gas that they hold, nothing asks in what order points are listed. */
static bool any_order(const scene_membrane *m)
{
    return m->normals && !m->normals->connected && !isnan(m->length) && m->holds < 0;
}

floe_status membrane_points(const scene_body *b, context *ctx, const seed_spec *grid, seed_list *out)
{
    const scene_membrane *m = &b->membrane;
    const sheet_seeding spread = {m->number, b->per_cell[0], m->thickness};
    if (m->surface.kind != SHEET_NONE) return seed_sheet(out, ctx, &m->surface, &spread, grid);
    const curve_seeding along = {.number = curve_count(&m->curve, m->number, b->per_cell[0], grid),
                                 .thickness = m->thickness,
                                 .length = m->length,
                                 .any_order = any_order(m)};
    return seed_curve(out, ctx, &m->curve, &along, grid);
}

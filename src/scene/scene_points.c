/* The points that a body begins with. */
#include "scene/state.h"

#include <math.h>

/* With normals of their own, a length that they share and no gas that they hold, nothing asks in what order points are
 * listed. */
static bool any_order(const scene_membrane *m)
{
    return m->normals && !m->normals->connected && !isnan(m->length) && m->encloses < 0;
}

static sheet_seeding sheet_seeding_of(const scene_body *b)
{
    return (sheet_seeding){b->membrane.number, b->per_cell[0], b->membrane.thickness};
}

floe_status body_rows(const scene_body *b, context *ctx, const seed_spec *grid, sheet_rows *out)
{
    const sheet_seeding spread = sheet_seeding_of(b);
    return sheet_rows_make(out, ctx, &b->membrane.surface, &spread, grid);
}

floe_status body_points(const scene_body *b, context *ctx, const seed_spec *grid, seed_list *out)
{
    if (!b->membrane.present) return seed_shape(out, ctx, &b->shape, grid);
    const scene_membrane *m = &b->membrane;
    const sheet_seeding spread = sheet_seeding_of(b);
    if (m->surface.kind != SHEET_NONE) return seed_sheet(out, ctx, &m->surface, &spread, grid);
    const curve_seeding along = {.number = curve_count(&m->curve, m->number, b->per_cell[0], grid),
                                 .thickness = m->thickness,
                                 .length = m->length,
                                 .any_order = any_order(m)};
    return seed_curve(out, ctx, &m->curve, &along, grid);
}

seed_spec body_seed_spec(const scene *s, const mesh *m, const scene_body *b)
{
    seed_spec spec = {
        .dim = m->dim, .axisymmetric = m->geometry == MESH_AXISYMMETRIC, .method = b->seeding, .merge = b->merge};
    for (int a = 0; a < 3; ++a) {
        spec.lower[a] = m->lower[a];
        spec.h[a] = m->h[a];
        spec.n[a] = m->n[a];
        spec.per_cell[a] = b->per_cell[a];
        spec.offset[a] = s->lattice_offset[a];
    }
    return spec;
}

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

void membrane_seed(scene_body *b)
{
    const bool surface = b->membrane.surface.kind != SHEET_NONE;
    if (b->membrane.present) b->per_cell[0] = surface ? MEMBRANE_SURFACE_POINTS : MEMBRANE_CURVE_POINTS;
}

double membrane_slack(const scene_membrane *m, size_t number)
{
    const long counted = (long)number + 1;
    return counted >= m->slack_from && (m->slack_to == 0 || counted <= m->slack_to) ? m->slack : 0.0;
}

static floe_status membrane_points(const scene_body *b, context *ctx, const seed_spec *grid, seed_list *out)
{
    const scene_membrane *m = &b->membrane;
    const sheet_seeding spread = sheet_seeding_of(b);
    if (m->surface.kind != SHEET_NONE) return seed_sheet(out, ctx, &m->surface, &spread, grid);
    const curve_seeding along = {.number = curve_count(&m->curve, m->number, b->per_cell[0], grid),
                                 .thickness = m->thickness,
                                 .length = m->length,
                                 .any_order = any_order(m)};
    return seed_curve(out, ctx, &m->curve, &along, grid);
}

/* Volumes at rest. Of a membrane that keeps its thickness they are in proportion to what length or area is without strain. */
floe_status body_points(const scene_body *b, context *ctx, const seed_spec *grid, seed_list *out)
{
    if (!b->membrane.present) return seed_shape(out, ctx, &b->shape, grid);
    TRY(membrane_points(b, ctx, grid, out));
    const scene_membrane *m = &b->membrane;
    const double directions = m->surface.kind != SHEET_NONE || grid->axisymmetric ? 2.0 : 1.0;
    if (m->slack == 0.0 || m->section != SECTION_THICKNESS) return FLOE_OK;
    for (size_t n = 0; n < out->n; n++) out->volume[n] *= exp(directions * membrane_slack(m, n));
    return FLOE_OK;
}

seed_spec body_seed_spec(const scene *s, const mesh *m, const scene_body *b)
{
    seed_spec spec = {
        .dim = m->dim, .axisymmetric = m->geometry == MESH_AXISYMMETRIC, .method = b->seeding, .merge = b->merge};
    for (int a = 0; a < 3; ++a) {
        spec.lower[a] = m->lower[a];
        spec.h[a] = m->h[a];
        spec.n[a] = m->n[a];
        spec.periodic[a] = m->periodic[a];
        spec.per_cell[a] = b->per_cell[a];
        spec.offset[a] = s->lattice_offset[a];
    }
    return spec;
}

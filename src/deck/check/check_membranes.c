/* Membranes as they will be seeded: points inside the domain, neighbours no farther apart than a cell, each with a
 * mass, a step that suits a surface; and the springs that hold on to their points. */
#include "deck/check/check.h"
#include "scene/state.h"

#include <math.h>
#include <stdio.h>

static seed_spec grid_of(const scene *s)
{
    const mesh_spec *m = &s->mesh;
    seed_spec grid = {.dim = m->dim, .axisymmetric = m->geometry == MESH_AXISYMMETRIC};
    for (int a = 0; a < m->dim; a++) {
        const double length = m->upper[a] - m->lower[a];
        grid.lower[a] = m->lower[a];
        grid.n[a] = (int)fmax(1.0, round(length / m->cell[a]));
        grid.h[a] = length / grid.n[a];
    }
    return grid;
}

static floe_status check_masses(reader *r, const scene_body *b, const seed_list *list)
{
    for (size_t i = 0; i < list->n; i++) {
        if (list->volume[i] > 0.0 || (long)i + 1 == b->membrane.heavy_point) continue;
        return bad_at(r, KEY("bodies", b->name, "membrane"), NULL, "give the curve a length, or the point a heavy_mass",
                      "point %zu of membrane '%s' has no mass", i + 1, b->name);
    }
    return FLOE_OK;
}

/* USF strains before the points have gone where their normals are known. */
static floe_status check_scheme(reader *r, const scene_body *b)
{
    if (r->scene->method.stress != STRESS_USF) return FLOE_OK;
    return bad_at(r, KEY("method", "stress"), "usl or musl", NULL,
                  "membrane '%s' is a surface, which is strained at the end of a step", b->name);
}

static floe_status check_membrane_ends(reader *r, int body, size_t n)
{
    static const char *const side[] = {"from", "to"};
    for (int i = 0; i < r->scene->n_springs; i++) {
        const scene_spring *spring = &r->scene->spring[i];
        for (int e = 0; e < 2; e++) {
            if (spring->end[e].body != body || (size_t)spring->end[e].point <= n) continue;
            TRY(bad_at(r, KEY("springs", spring->name, side[e], "point"), NULL, NULL,
                       "spring '%s' holds on to point %d of membrane '%s', which has %zu", spring->name,
                       spring->end[e].point, r->scene->body[body].name, n));
        }
    }
    return FLOE_OK;
}

/* Whether the points can be placed is asked of the seeding itself. */
floe_status check_membrane_points(reader *r, int body)
{
    const scene_body *b = &r->scene->body[body];
    const seed_spec grid = grid_of(r->scene);
    const bool surface = b->membrane.surface.kind != SHEET_NONE;
    seed_list list;
    floe_status status = body_points(b, r->ctx, &grid, &list);
    if (status == FLOE_BAD_INPUT)
        return take_refusal(r, fail_under(r->ctx, status, KEY("bodies", b->name, "membrane")));
    TRY(status);
    status = surface ? check_scheme(r, b) : FLOE_OK;
    if (status == FLOE_OK) status = check_masses(r, b, &list);
    if (status == FLOE_OK) status = check_membrane_ends(r, body, list.n);
    seed_list_free(r->ctx, &list);
    return status;
}

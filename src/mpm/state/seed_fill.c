/* Fluids fill small gaps beside other bodies (linear basis).
 *
 * Fitted seeding merges small volumes into a point of the next cell. Fluids that take gradients at the centres of cells
 * (locate.h) load the nodes of a cell in proportion to their volume there. Where a small volume of steel has moved to
 * another cell, no pressure acts in the part that it filled; where a small volume of gas has, the pressure of the cell is
 * too large. A pressurised gas then flows from full cells into that part, ever faster, until its points lie on a face and
 * oscillate across it, and gain volume each time. (Measured on the pressurised cylinder at h = 0.1: 3.4 % of one cell
 * was empty, and volumes were 1.16 and 0.83 of their exact values before the first point crossed.) Small volumes that
 * stay in their cell are no remedy: in the linear basis they are stiff springs between nodes whose mass is mostly that
 * of gas, for which no step is stable.
 *
 * In each cell with fluid points only, their volumes are therefore scaled to the volume that all bodies together had
 * there before small volume fractions were merged. Density does not change, so that the mass is wrong by the share of
 * the small volume fractions; solids are not changed. */
#include "mpm/state/seed_fill.h"
#include "base/memory.h"
#include "mpm/mpm.h"
#include "scene/state.h"

/* Volumes (m3) in every cell, of all bodies, as their shapes have it and as their points have it. */
typedef struct cell_contents {
    double *shape, *points;
    bool *solid; /* some point of a solid is there */
} cell_contents;

size_t seed_cell_of(const mesh *m, const seed_list *list, size_t n)
{
    size_t cell = 0;
    for (int a = m->dim - 1; a >= 0; --a) cell = cell * (size_t)m->n[a] + (size_t)list->cell[a][n];
    return cell;
}

static bool is_membrane(const mpm *s, int body)
{
    return s->body[body].membrane.model != NULL;
}

/* Whether fluids are to fill the cells that they share with nothing. */
static bool fluids_fill_cells(const mpm *s)
{
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].fluid && s->basis->smoothness == 0) return s->n_bodies > 1;
    return false;
}

/* Volume of a body's shape in each cell, as it is seeded without merging. */
static floe_status add_shape(const mpm *s, int body, double *sum)
{
    const scene_body *b = &s->scene->body[s->body[body].scene_body];
    seed_spec spec = body_seed_spec(s->scene, s->mesh, b);
    spec.merge = 0.0;
    seed_list list;
    TRY(seed_shape(&list, s->ctx, &b->shape, &spec));
    for (size_t n = 0; n < list.n; ++n) sum[seed_cell_of(s->mesh, &list, n)] += list.volume[n];
    seed_list_free(s->ctx, &list);
    return FLOE_OK;
}

static floe_status add_contents(const mpm *s, const seed_list *list, cell_contents *c)
{
    for (int body = 0; body < s->n_bodies; ++body) {
        if (!is_membrane(s, body)) TRY(add_shape(s, body, c->shape));
        for (size_t n = 0; n < list[body].n; ++n) {
            const size_t cell = seed_cell_of(s->mesh, &list[body], n);
            if (!is_membrane(s, body)) c->points[cell] += list[body].volume[n];
            if (!s->body[body].fluid) c->solid[cell] = true;
        }
    }
    return FLOE_OK;
}

static void fill_fluid_cells(const mpm *s, const cell_contents *c, seed_list *list)
{
    for (int body = 0; body < s->n_bodies; ++body)
        for (size_t n = 0; s->body[body].fluid && n < list[body].n; ++n) {
            const size_t cell = seed_cell_of(s->mesh, &list[body], n);
            if (!c->solid[cell]) list[body].volume[n] *= c->shape[cell] / c->points[cell];
        }
}

floe_status fill_cells(const mpm *s, seed_list *list)
{
    if (!fluids_fill_cells(s)) return FLOE_OK;
    cell_contents c = {0};
    const size_t cells = mesh_cells(s->mesh);
    floe_status status = memory_new(s->ctx, &c.shape, cells, sizeof *c.shape);
    if (status == FLOE_OK) status = memory_new(s->ctx, &c.points, cells, sizeof *c.points);
    if (status == FLOE_OK) status = memory_new(s->ctx, &c.solid, cells, sizeof *c.solid);
    if (status == FLOE_OK) status = add_contents(s, list, &c);
    if (status == FLOE_OK) fill_fluid_cells(s, &c, list);
    memory_free(s->ctx, &c.solid);
    memory_free(s->ctx, &c.points);
    memory_free(s->ctx, &c.shape);
    return status;
}

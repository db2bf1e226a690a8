/* Area vectors of the surface of the fluid, at nodes beside solids. */
#include "grid/tile_box.h"
#include "mpm/fluid/wetted.h"
#include "mpm/fluid/wetted_parts.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

#include <string.h>

static bool meets_in_window(const mpm *s, int blk, const tile_box *t)
{
    const mpm_wetted *w = s->wetted;
    const block *b = &s->mesh->block[blk];
    const double *fluid = field_get(s->domain->fields[blk], N_MASS, w->fluid, 0);
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < s->mesh->dim; ++a) {
        lo[a] = t->first[a] - b->lo[a] - 1;
        end[a] = lo[a] + t->cells[a] + 3;
    }
    for (int k = lo[2]; k < end[2]; ++k)
        for (int j = lo[1]; j < end[1]; ++j)
            for (int i = lo[0]; i < end[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                if (fluid[at] > 0.0 && wetted_solid(s, blk, at) >= 0) return true;
            }
    return false;
}

/* Advances the arrays by n points. */
static void advance_arrays(point_arrays *p, int dim, size_t n)
{
    for (int a = 0; a < dim; ++a) {
        p->x[a] += n;
        p->v[a] += n;
        if (p->half[a]) p->half[a] += n;
    }
    for (int c = 0; c < 9; ++c)
        if (p->deform[c]) p->deform[c] += n;
    p->mass += n;
    p->volume0 += n;
    p->J += n;
}

/* The nodal forces of a stress of -1 Pa, for any basis and geometry. */
static void scatter_unit_pressure(const mpm *s, const tile_box *t, point_arrays p, size_t start, size_t end,
                                  double *out)
{
    double even[2][SOLID_CHUNK];
    for (int k = 0; k < SOLID_CHUNK; ++k) {
        even[0][k] = -1.0;
        even[1][k] = 0.0;
    }
    p.q = p.grid_pressure = NULL;
    p.enclosed_pressure = 0.0;
    memset(p.acceleration, 0, sizeof p.acceleration);
    for (int a = 0; a < MESH_MAX_DIM; ++a) p.drive[a] = NULL;
    for (int c = 0; c < 6; ++c) p.stress[c] = even[c < 3 ? 0 : 1];
    advance_arrays(&p, s->mesh->dim, start);
    for (size_t n; start < end; start += n) {
        n = end - start < SOLID_CHUNK ? end - start : SOLID_CHUNK;
        s->windows->kernel->scatter[SCATTER_FORCE](s->mesh, t, &p, 0, n, out);
        advance_arrays(&p, s->mesh->dim, n);
    }
}

static void scatter_areas_of_tile(mpm *s, int group, int blk, int tile)
{
    (void)group;
    tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const bool meets = meets_in_window(s, blk, &box);
    bool any = false;
    if (meets) box.shared = shared_cells(s, blk, tile, &box);
    double *out = domain_tile(s->domain, box.number);
    for (int body = 0; meets && body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (!s->body[body].fluid || start[tile] == start[tile + 1]) continue;
        if (!any) memset(out, 0, (size_t)(s->windows->window_nodes * lanes_of(s->mesh->dim)) * sizeof *out);
        any = true;
        scatter_unit_pressure(s, &box, points_of(s, blk, body, false, false), start[tile], start[tile + 1], out);
    }
    s->windows->active[box.number] = any;
}

floe_status mpm_wetted_area(mpm *s)
{
    const int fluid = s->wetted->fluid;
    visit_tiles(s, fluid, scatter_areas_of_tile);
    domain_share_partials(s->domain);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        node_target to = {.components = lanes_of(s->mesh->dim), .reach = s->windows->reach};
        memcpy(to.window, s->windows->window, sizeof to.window);
        for (int a = 0; a < s->mesh->dim; ++a) to.array[a] = field_get(s->domain->fields[b], N_WETTED_AREA, fluid, a);
        gather_nodes(s, b, &to);
    }
    domain_fold_periodic(s->domain, N_WETTED_AREA, fluid);
    fold_field(s, fluid, N_WETTED_AREA);
    return FLOE_OK;
}

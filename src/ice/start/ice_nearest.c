/* The fluid beside a solid: for each cell, the nearest one whose centre no solid covers.
 *
 * Cells at a smeared solid have volume left that lies inside the solid. It belongs to the fluid on the near side, not to the ambient: otherwise a wall
 * between water and air would start with air on the side of the water. */
#include "ice/start/ice_start.h"
#include "ice/state/ice_cell_numbers.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static bool is_inside_solid(const ice *s, const int cell[MESH_MAX_DIM])
{
    double x[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, cell[a]);
    for (int b = 0; b < s->scene->n_bodies; ++b) {
        const scene_body *body = &s->scene->body[b];
        const int r = ice_material_of(s, body->material);
        if (r >= 0 && s->material[r].points && shape_inside(&body->shape, s->mesh->dim, x)) return true;
    }
    return false;
}

/* Square of the distance (m2) of two cells' centres, the shorter one around periodic axes. */
static double square_distance(const mesh *m, int first, int second)
{
    int a[MESH_MAX_DIM], b[MESH_MAX_DIM];
    double sum = 0.0;
    ice_numbered_cell(m, first, a);
    ice_numbered_cell(m, second, b);
    for (int axis = 0; axis < m->dim; ++axis) {
        int steps = abs(a[axis] - b[axis]);
        if (m->periodic[axis] && 2 * steps > m->n[axis]) steps = m->n[axis] - steps;
        sum += steps * steps * m->h[axis] * m->h[axis];
    }
    return sum;
}

/* Number of the cell beside another, or -1 beyond a side. */
static int neighbour_of(const mesh *m, int number, const int offset[MESH_MAX_DIM])
{
    int cell[MESH_MAX_DIM];
    ice_numbered_cell(m, number, cell);
    for (int a = 0; a < m->dim; ++a) {
        cell[a] = mesh_index_around(m, a, cell[a] + offset[a]);
        if (cell[a] < 0 || cell[a] >= m->n[a]) return -1;
    }
    return ice_cell_number(m, cell);
}

/* Takes over what a neighbour has found where that is nearer; of two as near, the first in the order of the cells. */
static bool ask_neighbours(const mesh *m, int number, int *nearest)
{
    const int reach[MESH_MAX_DIM] = {1, m->dim > 1, m->dim > 2};
    bool changed = false;
    for (int k = -reach[2]; k <= reach[2]; ++k)
        for (int j = -reach[1]; j <= reach[1]; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int beside = neighbour_of(m, number, (const int[MESH_MAX_DIM]){i, j, k});
                const int found = beside < 0 ? -1 : nearest[beside], now = nearest[number];
                if (found < 0 || found == now) continue;
                const double there = square_distance(m, number, found);
                const double here = now < 0 ? (double)INFINITY : square_distance(m, number, now), off = here - there;
                const double equal = 1e-9 * there;
                if (!(off > equal) && !(off >= -equal && found < now)) continue;
                nearest[number] = found;
                changed = true;
            }
    return changed;
}

floe_status ice_nearest_find(const ice *s, int **out)
{
    const mesh *m = s->mesh;
    const int cells = (int)mesh_cells(m);
    int *nearest, *inside, n = 0;
    TRY(memory_new(s->ctx, out, (size_t)cells, sizeof **out));
    nearest = *out;
    const floe_status status = memory_new(s->ctx, &inside, (size_t)cells, sizeof *inside);
    if (status != FLOE_OK) {
        memory_free(s->ctx, out);
        return status;
    }
    for (int number = 0; number < cells; ++number) {
        int cell[MESH_MAX_DIM];
        ice_numbered_cell(m, number, cell);
        const bool covered = is_inside_solid(s, cell);
        nearest[number] = covered ? -1 : number;
        if (covered) inside[n++] = number;
    }
    /* Sweeps there and back: each carries what is found through a whole body. */
    for (bool changed = n > 0, back = false; changed; back = !back) {
        changed = false;
        for (int k = 0; k < n; ++k) changed = ask_neighbours(m, inside[back ? n - 1 - k : k], nearest) || changed;
    }
    memory_free(s->ctx, &inside);
    return FLOE_OK;
}

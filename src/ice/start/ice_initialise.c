/* The first state of whole cells: fluids of bodies and of the ambient, cut by exact fractions; columns at rest under gravity (theory 2.4). */
#include "ice/start/ice_first_contents.h"
#include "ice/start/ice_start.h"

#include "base/memory.h"
#include "ice/ice_constants.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_walk.h"

#include <string.h>

/* Volume fraction that solids leave free in a cell. A cell that they almost fill gets no fluid, which would only absorb
 * their volume errors. */
static double fraction_beside(double taken)
{
    const double free = 1.0 - taken;
    return free < ICE_LEAST_FIRST_FRACTION ? 0.0 : free > 1.0 - 1e-12 ? 1.0 : free;
}

static floe_status initialise_block(const ice *s, const ice_view *v, const double *taken, const int *nearest)
{
    for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
        const double lo[3] = {mesh_node(s->mesh, 0, c.cell[0]), mesh_node(s->mesh, 1, c.cell[1]),
                              mesh_node(s->mesh, 2, c.cell[2])};
        content contents[ICE_MAX_MATERIALS];
        memset(contents, 0, sizeof contents);
        const double free = taken ? fraction_beside(taken[c.at]) : 1.0;
        TRY(nearest && free < 1.0 ? ice_fill_beside(s, lo, free, nearest[ice_cell_number(s->mesh, c.cell)], contents)
                                  : ice_fill_cell(s, lo, free, contents));
        double filled = free > 0.0 ? 0.0 : 1.0;
        for (int r = 0; r < s->n_materials; ++r) filled += contents[r].fraction;
        if (!(filled > 0.0)) {
            char place[160];
            ice_place(s, v->b, c.at, -1, place, sizeof place);
            return fail_key(
                s->ctx, KEY("ambient"),
                "%s at (%g, %g, %g) is empty: no body covers it; give an `ambient`, or a body of fluid there", place,
                lo[0], lo[1], lo[2]);
        }
        ice_store_contents(s, v, c.at, contents);
    }
    return FLOE_OK;
}

/* Specific volumes of solids at the first pressure, everywhere: the state that 2.10 carries on. */
static void start_solid_volumes(const ice *s, const ice_view *v, const double *p)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    for (int r = 0; r < s->n_materials; ++r) {
        if (!s->material[r].points) continue;
        const eos *law = &s->material[r].eos;
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v->b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(v->b, i, ice_row_j(q, row), ice_row_k(q, row));
                const double T = ICE_ANY_TEMPERATURE;
                double dvdp;
                law->model->volume(law->par, 1, &p[at], &T, &v->m[r].vol[at], &dvdp);
            }
    }
}

static floe_status initialise_blocks(ice *s, double *const *taken, const int *nearest)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        TRY(initialise_block(s, &v, taken ? taken[v.b->id] : NULL, nearest));
        double *p = field_get(s->domain->fields[v.b->id], C_PRESSURE, 0, 0);
        ice_guess_pressure(s, &v, p);
        if (v.multi) start_solid_volumes(s, &v, p);
    }
    return FLOE_OK;
}

floe_status ice_initialise(ice *s, double *const *taken)
{
    int *nearest = NULL;
    if (taken) TRY(ice_nearest_find(s, &nearest));
    const floe_status status = initialise_blocks(s, taken, nearest);
    memory_free(s->ctx, &nearest);
    return status == FLOE_OK ? ice_hydrostatic(s) : status;
}

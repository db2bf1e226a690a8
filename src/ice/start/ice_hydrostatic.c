/* Columns at rest (theory 2.4): where gravity acts, cell states are set so that p_j - p_j+1 = |g| h (rho_j +
 * rho_j+1)/2 from each cell to the one below it, for which face velocities and face pressures balance to round-off. The
 * highest cell keeps the pressure that it was given, and where the given pressure jumps from cell to cell, as at a charge, so does that
 * at rest. */
#include "ice/start/ice_start.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_given.h"

#include "base/memory.h"
#include "scene/fluid_columns.h"

#include <math.h>

/* One cell on the way down: what it was given, and its pressure and density at rest. */
typedef struct level {
    ice_given given;
    double p, rho;
} level;

static ice_given given_in_cell(const ice *s, ice_owned_cell c)
{
    ice_given out = {0};
    for (int r = 0; r < s->n_materials; ++r) {
        const double rho = field_get(c.f, C_RHO, r, 0)[c.at];
        if (s->material[r].points || !(rho > 0.0)) continue;
        const double pure = ice_is_mixture(s) ? 1.0 / field_get(c.f, C_VOL, r, 0)[c.at] : rho;
        ice_given_add(&out, r, &s->material[r].eos, scene_is_given_by_density(s->scene, s->material[r].scene_material),
                      rho / pure, pure, field_get(c.f, C_ENERGY, r, 0)[c.at]);
    }
    return out;
}

static floe_status set_cell(const ice *s, ice_owned_cell c, level *here)
{
    here->rho = 0.0;
    for (int r = 0; r < here->given.n; ++r) {
        ice_reservoir state;
        if (!here->given.law[r]) continue;
        TRY(ice_given_state(s, &here->given, r, here->p, &state));
        here->rho += here->given.theta[r] * state.rho;
        field_get(c.f, C_RHO, r, 0)[c.at] = here->given.theta[r] * state.rho;
        field_get(c.f, C_ENERGY, r, 0)[c.at] = state.e;
        if (ice_is_mixture(s)) field_get(c.f, C_VOL, r, 0)[c.at] = state.v;
    }
    field_get(c.f, C_PRESSURE, 0, 0)[c.at] = here->p;
    return FLOE_OK;
}

/* The pressure below another cell, with half the weight of each between them. A cell of solids alone passes on what was given above. */
static void go_down(const level *above, double weight, level *here)
{
    if (here->given.n == 0) {
        here->given.p = above->given.p;
        here->given.stiffness = above->given.stiffness;
    }
    const double base = above->p + ice_given_rise(&above->given, &here->given);
    here->p = ice_given_settle(&here->given, base, weight, 1.0, above->rho);
}

static double density_in(const ice *s, ice_owned_cell c)
{
    double sum = 0.0;
    for (int r = 0; r < s->n_materials; ++r)
        if (!s->material[r].points) sum += field_get(c.f, C_RHO, r, 0)[c.at];
    return sum;
}

/* From the highest cell of a column down, or, where an earlier column has set that one, from the next. */
static floe_status rest_column(const ice *s, const double *given, int cell[MESH_MAX_DIM], int axis, bool top_is_set)
{
    const double along = ice_weight_along(s, axis), weight = 0.5 * fabs(along) * s->mesh->h[axis];
    level above = {0};
    for (int step = 0; step < s->mesh->n[axis]; ++step) {
        cell[axis] = along < 0.0 ? s->mesh->n[axis] - 1 - step : step;
        const ice_owned_cell c = ice_find_cell(s, cell);
        level here = {.given = given_in_cell(s, c)};
        here.given.p = given[ice_cell_number(s->mesh, cell)];
        here.p = here.given.p;
        if (step > 0) go_down(&above, weight, &here);
        if (step == 0 && top_is_set) {
            here.p = field_get(c.f, C_PRESSURE, 0, 0)[c.at];
            here.rho = density_in(s, c);
        } else {
            TRY(set_cell(s, c, &here));
        }
        above = here;
    }
    return FLOE_OK;
}

/* The columns along an axis: those that begin in the highest layer of the axes still to come. */
static floe_status rest_columns(const ice *s, const double *given, int axis, bool tops_are_set)
{
    int first[3] = {0, 0, 0}, end[3] = {s->mesh->n[0], s->mesh->n[1], s->mesh->n[2]};
    end[axis] = 1;
    for (int a = axis + 1; a < s->mesh->dim; ++a) {
        const double along = ice_weight_along(s, a);
        if (along == 0.0) continue;
        first[a] = along < 0.0 ? s->mesh->n[a] - 1 : 0;
        end[a] = first[a] + 1;
    }
    for (int k = first[2]; k < end[2]; ++k)
        for (int j = first[1]; j < end[1]; ++j)
            for (int i = first[0]; i < end[0]; ++i) {
                int cell[MESH_MAX_DIM] = {i, j, k};
                TRY(rest_column(s, given, cell, axis, tops_are_set));
            }
    return FLOE_OK;
}

/* What each cell was given, before any of them changes. */
static void note_given(const ice *s, double *given)
{
    for (int k = 0; k < s->mesh->n[2]; ++k)
        for (int j = 0; j < s->mesh->n[1]; ++j)
            for (int i = 0; i < s->mesh->n[0]; ++i) {
                const int cell[MESH_MAX_DIM] = {i, j, k};
                const ice_owned_cell c = ice_find_cell(s, cell);
                given[ice_cell_number(s->mesh, cell)] = field_get(c.f, C_PRESSURE, 0, 0)[c.at];
            }
}

floe_status ice_hydrostatic(ice *s)
{
    double *given = NULL;
    floe_status status = FLOE_OK;
    for (int axis = 0; axis < s->mesh->dim && scene_adds_weight(s->scene) && status == FLOE_OK; ++axis) {
        if (ice_weight_along(s, axis) == 0.0) continue;
        const bool first = !given;
        if (first) status = memory_new(s->ctx, &given, mesh_cells(s->mesh), sizeof *given);
        if (status == FLOE_OK && first) note_given(s, given);
        if (status == FLOE_OK) status = rest_columns(s, given, axis, !first);
    }
    memory_free(s->ctx, &given);
    return status;
}

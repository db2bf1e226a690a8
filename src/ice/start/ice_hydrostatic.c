/* Columns at rest (theory 2.4): where gravity acts, cell states are set so that p_j - p_j+1 = |g| h (rho_j +
 * rho_j+1)/2 from each cell to the one below it, for which face velocities and face pressures balance to round-off. The
 * highest cell keeps the pressure that it was given, and where the given pressure jumps from cell to cell, as at a charge, so does that
 * at rest. */
#include "ice/start/ice_start.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_given.h"
#include "ice/state/ice_lean.h"
#include "ice/state/ice_traced.h"

#include "base/memory.h"
#include "scene/fluid_columns.h"

#include <math.h>

/* Of a column: the leans of a liquid's cells change with its compression alone. */
static const int most_passes = 60;

/* One cell on the way down: what it was given, and its pressure and density at rest. */
typedef struct level {
    ice_given given;
    ice_owned_cell cell;
    double p, rho, lean;
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

static floe_status set_cell(const ice *s, level *here)
{
    const ice_owned_cell c = here->cell;
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
    here->p = ice_given_settle(&here->given, base, weight, 1.0, above->rho + 2.0 * (here->lean - above->lean));
}

static double density_in(const ice *s, ice_owned_cell c)
{
    double sum = 0.0;
    for (int r = 0; r < s->n_materials; ++r)
        if (!s->material[r].points) sum += field_get(c.f, C_RHO, r, 0)[c.at];
    return sum;
}

/* The cells of a column as they were given, from the highest down. */
static void read_column(const ice *s, const double *given, int cell[MESH_MAX_DIM], int axis, level *column)
{
    const int n = s->mesh->n[axis];
    for (int step = 0; step < n; ++step) {
        cell[axis] = ice_weight_along(s, axis) < 0.0 ? n - 1 - step : step;
        const ice_owned_cell c = ice_find_cell(s, cell);
        column[step] = (level){.given = given_in_cell(s, c), .cell = c, .rho = density_in(s, c)};
        column[step].given.p = given[ice_cell_number(s->mesh, cell)];
        column[step].p = field_get(c.f, C_PRESSURE, 0, 0)[c.at];
    }
}

/* Where the mass of each cell lies, by the densities found last; whether that has changed. Beside the ends it is even. */
static bool find_leans(level *column, int n)
{
    bool changed = false;
    for (int step = 1; step < n - 1; ++step) {
        const double lean = ice_lean(column[step - 1].rho, column[step].rho, column[step + 1].rho);
        changed = changed || lean != column[step].lean;
        column[step].lean = lean;
    }
    return changed;
}

/* From the highest cell of a column down, or, where an earlier column has set that one, from the next. */
static floe_status descend(const ice *s, level *column, int n, double weight, bool top_is_set)
{
    if (!top_is_set) {
        column[0].p = column[0].given.p;
        TRY(set_cell(s, &column[0]));
    }
    for (int step = 1; step < n; ++step) {
        go_down(&column[step - 1], weight, &column[step]);
        TRY(set_cell(s, &column[step]));
    }
    return FLOE_OK;
}

/* Where faces bear weight as it lies in cells (theory 2.17), densities and where they lie are found in turn. */
static floe_status rest_column(const ice *s, const double *given, int cell[MESH_MAX_DIM], int axis, bool top_is_set,
                               level *column)
{
    const int n = s->mesh->n[axis];
    const double weight = 0.5 * fabs(ice_weight_along(s, axis)) * s->mesh->h[axis];
    const bool leans = ice_bears_unevenly(s, &s->region[0]);
    read_column(s, given, cell, axis, column);
    if (leans) find_leans(column, n);
    TRY(descend(s, column, n, weight, top_is_set));
    for (int pass = 0; pass < most_passes && leans && find_leans(column, n); ++pass)
        TRY(descend(s, column, n, weight, top_is_set));
    return FLOE_OK;
}

/* The columns along an axis: those that begin in the highest layer of the axes still to come. */
static floe_status rest_columns(const ice *s, const double *given, int axis, bool tops_are_set, level *column)
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
                TRY(rest_column(s, given, cell, axis, tops_are_set, column));
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
    level *column = NULL;
    floe_status status = FLOE_OK;
    for (int axis = 0; axis < s->mesh->dim && scene_adds_weight(s->scene) && status == FLOE_OK; ++axis) {
        if (ice_weight_along(s, axis) == 0.0) continue;
        const bool first = !given;
        if (first) status = memory_new(s->ctx, &given, mesh_cells(s->mesh), sizeof *given);
        if (status == FLOE_OK && first) note_given(s, given);
        if (status == FLOE_OK) status = memory_new(s->ctx, &column, s->mesh->n[axis], sizeof *column);
        if (status == FLOE_OK) status = rest_columns(s, given, axis, !first, column);
        memory_free(s->ctx, &column);
    }
    memory_free(s->ctx, &given);
    return status;
}

/* Columns at rest (theory 2.4): where gravity acts, cell states are set so that p_j - p_j+1 = |g| h (rho_j +
 * rho_j+1)/2 from each cell to the one below it, for which face velocities and face pressures balance to round-off. One
 * gravity axis, and the highest cells keep the pressure that they were given. */
#include "ice/start/ice_start.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_fluid_state.h"
#include "ice/state/ice_materials.h"
#include "scene/formula.h"

#include <math.h>

bool ice_asks_for_rest(const ice *s)
{
    const scene *given = s->scene;
    for (int b = 0; b < given->n_bodies; ++b) {
        const scene_body *body = &given->body[b];
        if (given->material[body->material].kind != MATERIAL_FLUID) continue;
        if (body->initial_from_exact || !isnan(body->density) || scene_formula_of(given, &body->pressure)) return false;
        for (int a = 0; a < s->mesh->dim; ++a)
            if (body->velocity[a] != 0.0 || scene_formula_of(given, &body->velocity[a])) return false;
    }
    return true;
}

/* The axis of gravity; -1 without, or where it lies along no axis. */
static int gravity_axis(const ice *s)
{
    int axis = -1;
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (s->gravity[a] == 0.0) continue;
        if (axis >= 0) return -1;
        axis = a;
    }
    return axis;
}

/* Densities of a cell at pressure p with its fractions and temperatures; returns their sum. Sets state when asked
 * to. */
static double density_at(const ice *s, ice_owned_cell c, double p, const double *theta, const double *T, bool set)
{
    double sum = 0.0;
    for (int r = 0; r < s->n_materials; ++r) {
        if (!(theta[r] > 0.0)) continue;
        const ice_reservoir state = ice_state_at(&s->material[r].eos, p, T[r]);
        sum += theta[r] * state.rho;
        if (!set || s->material[r].points) continue;
        field_get(c.f, C_RHO, r, 0)[c.at] = theta[r] * state.rho;
        field_get(c.f, C_ENERGY, r, 0)[c.at] = state.e;
        if (ice_is_mixture(s)) field_get(c.f, C_VOL, r, 0)[c.at] = state.v;
    }
    if (set) field_get(c.f, C_PRESSURE, 0, 0)[c.at] = p;
    return sum;
}

/* Fractions and temperatures of a cell as it was initialised. */
static void initial_composition(const ice *s, ice_owned_cell c, double *theta, double *T)
{
    for (int r = 0; r < s->n_materials; ++r) {
        const double rho = field_get(c.f, C_RHO, r, 0)[c.at];
        theta[r] = 0.0;
        if (s->material[r].points || !(rho > 0.0)) continue;
        const double pure = ice_is_mixture(s) ? 1.0 / field_get(c.f, C_VOL, r, 0)[c.at] : rho;
        theta[r] = rho / pure;
        s->material[r].eos.model->temperature(s->material[r].eos.par, 1, &pure, &field_get(c.f, C_ENERGY, r, 0)[c.at],
                                              &T[r]);
    }
}

static void rest_column(const ice *s, int cell[MESH_MAX_DIM], int axis)
{
    const int n = s->mesh->n[axis], down = s->gravity[axis] < 0.0 ? -1 : 1;
    const double weight = 0.5 * fabs(s->gravity[axis]) * s->mesh->h[axis];
    double above_p = 0.0, above_rho = 0.0, theta[ICE_MAX_MATERIALS], T[ICE_MAX_MATERIALS];
    for (int step = 0; step < n; ++step) {
        cell[axis] = down < 0 ? n - 1 - step : step;
        const ice_owned_cell c = ice_find_cell(s, cell);
        initial_composition(s, c, theta, T);
        double p = step == 0 ? field_get(c.f, C_PRESSURE, 0, 0)[c.at] : above_p;
        for (int iteration = 0; iteration < 60 && step > 0; ++iteration) {
            const double next = above_p + weight * (above_rho + density_at(s, c, p, theta, T, false));
            const bool done = next == p;
            p = next;
            if (done) break;
        }
        above_rho = density_at(s, c, p, theta, T, true);
        above_p = p;
    }
}

floe_status ice_hydrostatic(ice *s)
{
    const int axis = gravity_axis(s);
    if (axis < 0 || s->mesh->periodic[axis] || !ice_asks_for_rest(s)) return FLOE_OK;
    int end[MESH_MAX_DIM] = {s->mesh->n[0], s->mesh->n[1], s->mesh->n[2]};
    end[axis] = 1;
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i) {
                int cell[MESH_MAX_DIM] = {i, j, k};
                rest_column(s, cell, axis);
            }
    return FLOE_OK;
}

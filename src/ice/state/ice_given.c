#include "ice/state/ice_given.h"

#include "scene/formula.h"
#include "scene/state.h"

#include <math.h>

/* Differences of given pressures, in rho c^2, that are round-off of a law's pressure. */
static const double round_off = 1e-11;

bool ice_asks_for_rest(const ice *s)
{
    const scene *given = s->scene;
    if (given->has_ambient && scene_formula_of(given, &given->ambient_pressure)) return false;
    for (int b = 0; b < given->n_bodies; ++b) {
        const scene_body *body = &given->body[b];
        if (given->material[body->material].kind != MATERIAL_FLUID) continue;
        if (body->initial_from_exact || scene_formula_of(given, &body->pressure)) return false;
    }
    return true;
}

double ice_weight_along(const ice *s, int axis)
{
    const bc_side *side = s->scene->bc.side[axis];
    const bool open =
        bc_gives_pressure(side[0].kind) && bc_gives_pressure(side[1].kind) && side[0].pressure == side[1].pressure;
    return open || s->mesh->periodic[axis] ? 0.0 : s->gravity[axis];
}

bool ice_is_given_by_density(const scene *s, int material)
{
    if (s->has_ambient && s->ambient_material == material) return false;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material && isnan(s->body[b].density)) return false;
    return true;
}

void ice_given_add(ice_given *g, int r, const eos *law, bool by_density, double theta, double pure, double e)
{
    double c2, slope;
    law->model->pressure(law->par, 1, &pure, &e, &g->own[r], &c2);
    law->model->temperature(law->par, 1, &pure, &e, &g->T[r]);
    law->model->dpde(law->par, 1, &pure, &e, &slope);
    if (!(g->stiffness > 0.0)) g->p = g->own[r];
    g->stiffness = fmax(g->stiffness, pure * c2);
    g->law[r] = law;
    g->theta[r] = theta;
    g->density[r] = pure;
    g->keeps_density[r] = by_density && slope > 0.0;
    if (g->n <= r) g->n = r + 1;
}

static double clip_round_off(double difference, double stiffness)
{
    return fabs(difference) <= round_off * stiffness ? 0.0 : difference;
}

double ice_given_rise(const ice_given *from, const ice_given *to)
{
    return clip_round_off(to->p - from->p, fmax(from->stiffness, to->stiffness));
}

/* Fluids of one cell that were given different pressures keep their difference. */
static double pressure_of(const ice_given *g, int r, double p)
{
    return p + clip_round_off(g->own[r] - g->p, g->stiffness);
}

double ice_given_density(const ice_given *g, double p)
{
    double sum = 0.0;
    for (int r = 0; r < g->n; ++r) {
        if (!g->law[r]) continue;
        const double rho =
            g->keeps_density[r] ? g->density[r] : ice_state_at(g->law[r], pressure_of(g, r, p), g->T[r]).rho;
        sum += g->theta[r] * rho;
    }
    return sum;
}

double ice_given_settle(const ice_given *g, double base, double weight, double share, double other)
{
    double p = base;
    for (int pass = 0; pass < 60; ++pass) {
        const double next = base + weight * (share * ice_given_density(g, p) + other);
        if (next == p) break;
        p = next;
    }
    return p;
}

floe_status ice_given_state(const ice *s, const ice_given *g, int r, double p, ice_reservoir *out)
{
    fluid_state state;
    *out = ice_state_at(g->law[r], pressure_of(g, r, p), g->T[r]);
    if (!g->keeps_density[r]) return FLOE_OK;
    TRY(fluid_state_of(s->ctx, g->law[r], pressure_of(g, r, p), (double)NAN, g->density[r], &state));
    *out = (ice_reservoir){.rho = state.density, .e = state.energy, .T = state.temperature, .v = 1.0 / state.density};
    return FLOE_OK;
}

#include "ice/state/ice_given.h"

#include "scene/fluid_columns.h"
#include "scene/state.h"

#include <math.h>

/* Differences of given pressures, in rho c^2, that are round-off of a law's pressure. */
static const double round_off = 1e-11;

double ice_weight_along(const ice *s, int axis)
{
    return scene_bears_weight(s->scene, axis) ? s->gravity[axis] : 0.0;
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

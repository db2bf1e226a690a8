#include "coupling/orifice.h"

#include <math.h>
#include <string.h>

/* Below this difference of pressures, as a share of the higher, the flow is in proportion to it: its slope has no bound
 * otherwise, and no step of a finite size would follow it to rest. It is 1e-3 of the choked flow there. */
static const double linear_share = 1e-6;

orifice_side orifice_surroundings(double gamma, double pressure, double work)
{
    const double mass = pressure > 0.0 ? pressure / work : 0.0;
    return (orifice_side){
        .gamma = gamma, .mass = mass, .energy = pressure / (gamma - 1.0), .volume = 1.0, .endless = true};
}

double orifice_pressure(const orifice_side *side)
{
    return (side->gamma - 1.0) * side->energy / side->volume;
}

double orifice_mass_flux(double gamma, double pressure, double work, double behind)
{
    const double critical = pow(2.0 / (gamma + 1.0), gamma / (gamma - 1.0)), least = 1.0 - linear_share,
                 given = behind / pressure;
    const double ratio = fmin(fmax(given, critical), least),
                 linear = given > least ? (1.0 - given) / linear_share : 1.0;
    const double velocity2 = 2.0 * gamma / (gamma - 1.0) * work * (1.0 - pow(ratio, (gamma - 1.0) / gamma));
    return linear * pressure / work * pow(ratio, 1.0 / gamma) * sqrt(velocity2);
}

/* Mass and energy of both sides, and what has passed either way: mass and enthalpy. */
enum { STATE_MASS, STATE_ENERGY, STATE_PASSED = 4, STATE_SIZE = 8 };

typedef struct orifice_system {
    const orifice_side *side;
    double area;
    bool one_way;
    int from; /* the side of the higher pressure at the start of the step: gas that has come to one pressure does not flow back */
} orifice_system;

static orifice_side side_of(const orifice_system *q, const double *state, int k)
{
    orifice_side out = q->side[k];
    out.mass = state[2 * k + STATE_MASS];
    out.energy = state[2 * k + STATE_ENERGY];
    return out;
}

/* Of side 0 over that of side 1. */
static double excess_pressure(const orifice_system *q, const double *state)
{
    const orifice_side a = side_of(q, state, 0), b = side_of(q, state, 1);
    return orifice_pressure(&a) - orifice_pressure(&b);
}

static void find_rates(const orifice_system *q, const double *state, double *rate)
{
    const int from = q->from;
    const double excess = excess_pressure(q, state);
    const orifice_side up = side_of(q, state, from), down = side_of(q, state, 1 - from);
    memset(rate, 0, STATE_SIZE * sizeof *rate);
    if (!(up.mass > 0.0) || (from == 1 && q->one_way) || !(from == 0 ? excess > 0.0 : excess < 0.0)) return;
    const double pressure = orifice_pressure(&up), work = (up.gamma - 1.0) * up.energy / up.mass;
    if (!(pressure > 0.0)) return;
    const double mass = q->area * orifice_mass_flux(up.gamma, pressure, work, orifice_pressure(&down)),
                 enthalpy = mass * up.gamma * up.energy / up.mass;
    const double amount[2] = {mass, enthalpy};
    for (int n = 0; n < 2; ++n) {
        if (!up.endless) rate[2 * from + n] = -amount[n];
        if (!down.endless) rate[2 * (1 - from) + n] = amount[n];
        rate[STATE_PASSED + 2 * from + n] = amount[n];
    }
}

static void add_rates(const double *state, double dt, const double *rate, double *out)
{
    for (int n = 0; n < STATE_SIZE; ++n) out[n] = state[n] + dt * rate[n];
}

/* Runge and Kutta's step of order 4. */
static void advance_by(const orifice_system *q, double dt, const double *state, double *out)
{
    double rate[4][STATE_SIZE], at[STATE_SIZE], mean[STATE_SIZE];
    find_rates(q, state, rate[0]);
    for (int n = 1; n < 4; ++n) {
        add_rates(state, n < 3 ? 0.5 * dt : dt, rate[n - 1], at);
        find_rates(q, at, rate[n]);
    }
    for (int n = 0; n < STATE_SIZE; ++n) mean[n] = (rate[0][n] + 2.0 * (rate[1][n] + rate[2][n]) + rate[3][n]) / 6.0;
    add_rates(state, dt, mean, out);
}

/* The share of what would pass at the present rate in `dt` that brings both sides to one pressure is not exceeded by much:
 * so many steps that each passes a tenth of it. */
static int substeps_of(const orifice_system *q, const double *state, double dt)
{
    const int most = 200;
    const double share = 0.1;
    double rate[STATE_SIZE], later[STATE_SIZE];
    find_rates(q, state, rate);
    add_rates(state, dt, rate, later);
    const double now = fabs(excess_pressure(q, state)),
                 change = fabs(excess_pressure(q, later) - excess_pressure(q, state));
    if (!(change > 0.0) || !(now > 0.0)) return 1;
    return (int)fmin(most, ceil(change / (share * now)));
}

void orifice_pass(const orifice_side side[2], double area, bool one_way, double dt, orifice_flow out[2])
{
    orifice_system q = {.side = side, .area = area, .one_way = one_way};
    double state[STATE_SIZE] = {side[0].mass, side[0].energy, side[1].mass, side[1].energy};
    q.from = excess_pressure(&q, state) >= 0.0 ? 0 : 1;
    const int steps = substeps_of(&q, state, dt);
    for (int k = 0; k < steps; ++k) {
        double next[STATE_SIZE];
        advance_by(&q, dt / steps, state, next);
        const double before = excess_pressure(&q, state), after = excess_pressure(&q, next);
        const double share =
            before * after < 0.0 ? before / (before - after) : 1.0; /* no further than to one pressure */
        for (int n = 0; n < STATE_SIZE; ++n) state[n] += share * (next[n] - state[n]);
        if (share < 1.0) break;
    }
    for (int k = 0; k < 2; ++k) out[k] = (orifice_flow){state[STATE_PASSED + 2 * k], state[STATE_PASSED + 2 * k + 1]};
}

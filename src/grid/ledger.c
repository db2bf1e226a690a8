#include "grid/ledger.h"

#include <math.h>
#include <string.h>

/* Neumaier's compensated addition: the order of entries over 1e6 steps must not show in a drift of 1e-12. */
static void add_compensated(ledger_sum *sum, double amount)
{
    const double total = sum->value + amount;
    sum->carry += fabs(sum->value) >= fabs(amount) ? (sum->value - total) + amount : (amount - total) + sum->value;
    sum->value = total;
}

void ledger_add(ledger *l, ledger_quantity q, ledger_kind kind, double amount)
{
    l->pending[q][kind] += amount;
}

void ledger_turn(ledger *l, ledger_kind kind, const double moment[3], double share)
{
    for (int a = 0; a < 3; ++a) l->pending[LEDGER_MOMENT_X + a][kind] += share * moment[a];
}

void ledger_push(ledger *l, ledger_kind kind, int axis, double impulse, const double x[MESH_MAX_DIM])
{
    double moment[3] = {0.0};
    add_moment(moment, x, axis, impulse);
    ledger_add(l, (ledger_quantity)(LEDGER_MOMENTUM_X + axis), kind, impulse);
    ledger_turn(l, kind, moment, 1.0);
}

void ledger_tally(ledger *l, ledger_count what, long long n)
{
    l->pending_count[what] += n;
}

void ledger_commit(ledger *l)
{
    for (int q = 0; q < LEDGER_QUANTITIES; ++q)
        for (int k = 0; k < LEDGER_KINDS; ++k) add_compensated(&l->entry[q][k], l->pending[q][k]);
    for (int c = 0; c < LEDGER_COUNTS; ++c) l->count[c] += l->pending_count[c];
    ledger_discard(l);
}

void ledger_discard(ledger *l)
{
    memset(l->pending, 0, sizeof l->pending);
    memset(l->pending_count, 0, sizeof l->pending_count);
}

static bool is_momentum(int q)
{
    return q >= LEDGER_MOMENTUM_X && q <= LEDGER_MOMENTUM_Z;
}

static bool is_moment(int q)
{
    return q >= LEDGER_MOMENT_X && q <= LEDGER_MOMENT_Z;
}

/* Momentum is one vector: what an axis that is all but at rest drifts by is a share of the whole, not of its own
 * round-off. */
static double scale_of(const ledger *l, ledger_quantity q)
{
    if (q == LEDGER_MASS || q == LEDGER_ENERGY) return l->scale[q];
    const double *along = l->scale + (is_moment(q) ? LEDGER_MOMENT_X : LEDGER_MOMENTUM_X);
    return fmax(along[0], fmax(along[1], along[2]));
}

double ledger_excess(const ledger *l, ledger_quantity q)
{
    double expected = l->initial[q];
    for (int k = 0; k < LEDGER_KINDS; ++k) expected += l->entry[q][k].value + l->entry[q][k].carry;
    return l->total[q] - expected;
}

double ledger_drift(const ledger *l, ledger_quantity q)
{
    if (l->not_conserved[q]) return 0.0;
    const double drift = fabs(ledger_excess(l, q));
    return drift == 0.0 ? 0.0 : drift / scale_of(l, q);
}

double ledger_largest_drift(const ledger *l, ledger_quantity q)
{
    return l->worst[q] == 0.0 ? 0.0 : l->worst[q] / scale_of(l, q);
}

double ledger_largest_share(const ledger *l, ledger_quantity q)
{
    double most = scale_of(l, q);
    if (l->worst[q] == 0.0) return 0.0;
    for (int a = LEDGER_MOMENT_X; is_moment(q) && a <= LEDGER_MOMENT_Z; ++a)
        most = fmax(most, l->let_in[a][LEDGER_BOUNDARY] + l->let_in[a][LEDGER_SOURCE]);
    return l->worst[q] / most;
}

/* What was there at the start and what has come in. */
static double first_and_let_in(const ledger *l, ledger_quantity q)
{
    double sum = l->extent[q];
    for (int k = 0; k < LEDGER_INPUTS; ++k) sum += l->let_in[q][k];
    return sum;
}

/* Of momentum the sum of |p|, but never more than the energy that there can be would give the mass that there can be:
 * |p| <= (2 m E)^1/2. A run that makes energy from nothing so has no scale that grows with it. Velocities and strains
 * below `round_off`, in units of the speed of sound, are round-off of a body at rest. Moments are those of such momenta
 * at the farthest. */
static void set_scales(ledger *l)
{
    static const double round_off = 1e-10;
    const double mass = first_and_let_in(l, LEDGER_MASS), energy = first_and_let_in(l, LEDGER_ENERGY);
    l->scale[LEDGER_MASS] = mass;
    l->scale[LEDGER_ENERGY] = fmax(energy, round_off * round_off * l->elasticity);
    const double most = sqrt(2.0 * mass * l->scale[LEDGER_ENERGY]);
    const double least = round_off * sqrt(2.0 * mass * (energy + l->elasticity));
    for (int q = LEDGER_MOMENTUM_X; q <= LEDGER_MOMENTUM_Z; ++q) l->scale[q] = fmax(fmin(l->extent[q], most), least);
    for (int q = LEDGER_MOMENT_X; q <= LEDGER_MOMENT_Z; ++q)
        l->scale[q] = fmax(fmin(l->extent[q], most * l->arm), least * l->arm);
}

/* What motion and strain can have had: a decrease of internal energy that left through a boundary was not theirs. */
static void note_motion(ledger *l, const ledger_state *now)
{
    double came = l->motion.internal - now->internal;
    for (int k = 0; k < LEDGER_INPUTS; ++k) came += l->entry[LEDGER_ENERGY][k].value;
    l->motion.available = fmax(l->motion.available, l->motion.start + fmax(came, 0.0));
    l->motion.most = fmax(l->motion.most, now->motion);
}

double ledger_possible_motion(const ledger *l)
{
    return l->motion.stored + l->motion.start + l->let_in[LEDGER_ENERGY][LEDGER_SOURCE];
}

bool ledger_is_fed(const ledger *l)
{
    static const double margin = 1.5, least_share = 0.01;
    return l->motion.stored >= 0.0 && l->motion.most > margin * ledger_possible_motion(l) &&
           l->motion.most > least_share * l->scale[LEDGER_ENERGY];
}

/* Below a share of all energy the gas's part hides what a solid gains, and a loss of accuracy is no divergence. */
static void count_growth(ledger *l, double time)
{
    static const double least_share = 0.1;
    const double excess = ledger_excess(l, LEDGER_ENERGY);
    const bool beyond = excess > l->motion.available && excess > least_share * l->scale[LEDGER_ENERGY];
    if (!beyond)
        l->motion.beyond = 0.0;
    else if (time > l->motion.last_look)
        l->motion.beyond += 1.0;
    l->motion.last_look = time;
}

static void note_worst(ledger *l, ledger_quantity q, double time)
{
    const double excess = ledger_excess(l, q);
    /* A NaN is taken, and stays. */
    if (l->not_conserved[q] || isnan(l->worst[q]) || fabs(excess) <= fabs(l->worst[q])) return;
    l->worst[q] = excess;
    l->worst_time[q] = time;
}

void ledger_choose(ledger *l, const mesh *m)
{
    const bool radial = m->geometry == MESH_AXISYMMETRIC;
    double square = 0.0;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        l->not_conserved[LEDGER_MOMENTUM_X + a] = a >= m->dim || (radial && a == 0);
        l->not_conserved[LEDGER_MOMENT_X + a] =
            radial || b >= m->dim || c >= m->dim || m->periodic[b] || m->periodic[c];
        if (a < m->dim) square += 0.25 * (m->upper[a] - m->lower[a]) * (m->upper[a] - m->lower[a]);
    }
    l->arm = sqrt(square);
}

void ledger_leave_moments(ledger *l)
{
    for (int a = 0; a < 3; ++a) l->not_conserved[LEDGER_MOMENT_X + a] = true;
}

void ledger_open(ledger *l, const ledger_state *now, double elasticity)
{
    memcpy(l->initial, now->total, sizeof l->initial);
    memcpy(l->total, now->total, sizeof l->total);
    memcpy(l->extent, now->extent, sizeof l->extent);
    l->elasticity = elasticity;
    l->motion =
        (ledger_motion){.start = now->motion, .internal = now->internal, .available = now->motion, .stored = -1.0};
    set_scales(l);
    ledger_discard(l);
}

void ledger_look(ledger *l, const ledger_state *now, double time)
{
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
        if (is_moment(q) && !now->turns) continue;
        l->total[q] = now->total[q];
        if (is_momentum(q) || is_moment(q)) l->extent[q] = fmax(l->extent[q], now->extent[q]);
        for (int k = 0; k < LEDGER_INPUTS; ++k) l->let_in[q][k] = fmax(l->let_in[q][k], l->entry[q][k].value);
    }
    set_scales(l);
    note_motion(l, now);
    count_growth(l, time);
    for (int q = 0; q < LEDGER_QUANTITIES; ++q)
        if (now->turns || !is_moment(q)) note_worst(l, (ledger_quantity)q, time);
}

const char *ledger_quantity_name(ledger_quantity q)
{
    static const char *const name[LEDGER_QUANTITIES] = {
        "mass",   "momentum_x",         "momentum_y",         "momentum_z",
        "energy", "angular_momentum_x", "angular_momentum_y", "angular_momentum_z"};
    return name[q];
}

const char *ledger_count_name(ledger_count c)
{
    static const char *const name[LEDGER_COUNTS] = {
        "newton_cells",  "newton_iterations",  "newton_fallbacks",      "floors",
        "energy_guards", "points_lost",        "points_burnt",          "small_nodes",
        "reorders",      "contact_stick",      "contact_slip",          "contact_release",
        "normals_plain", "normals_kept",       "pressure_solves",       "outer_iterations",
        "cg_iterations", "balance_iterations", "balance_cg_iterations", "cells_merged"};
    return name[c];
}

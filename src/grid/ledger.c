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

/* Momentum is one vector: what an axis that is all but at rest drifts by is a share of the whole, not of its own
 * round-off. */
static double scale_of(const ledger *l, ledger_quantity q)
{
    if (q < LEDGER_MOMENTUM_X || q > LEDGER_MOMENTUM_Z) return l->scale[q];
    return fmax(l->scale[LEDGER_MOMENTUM_X], fmax(l->scale[LEDGER_MOMENTUM_Y], l->scale[LEDGER_MOMENTUM_Z]));
}

double ledger_drift(const ledger *l, ledger_quantity q)
{
    if (l->no_account[q]) return 0.0;
    double expected = l->initial[q];
    for (int k = 0; k < LEDGER_KINDS; ++k) expected += l->entry[q][k].value + l->entry[q][k].carry;
    const double drift = fabs(l->total[q] - expected);
    return drift == 0.0 ? 0.0 : drift / scale_of(l, q);
}

const char *ledger_quantity_name(ledger_quantity q)
{
    static const char *const name[LEDGER_QUANTITIES] = {"mass", "momentum_x", "momentum_y", "momentum_z", "energy"};
    return name[q];
}

const char *ledger_count_name(ledger_count c)
{
    static const char *const name[LEDGER_COUNTS] = {
        "newton_cells",  "newton_iterations",  "newton_fallbacks",     "floors",
        "energy_guards", "points_lost",        "points_burnt",         "small_nodes",
        "reorders",      "contact_stick",      "contact_slip",         "contact_release",
        "normals_plain", "normals_kept",       "pressure_solves",      "outer_iterations",
        "cg_iterations", "balance_iterations", "balance_cg_iterations"};
    return name[c];
}

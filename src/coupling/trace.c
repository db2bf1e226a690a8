/* Exchange between pairs with different coefficients, where a third material is present in traces.
 *
 * Example: water slips along a wall, and a trace of air is locked to both. Since exchange is implicit, a coupling without limit transmits a force without
 * limit through any mass, and the trace would lock water and wall to each other. Therefore a trace takes part twice, by its weight w: in the system of all
 * materials, with couplings of at most m w/(1 - w); and, with the rest of its couplings, by following the mean of its heavier partners, which lose exactly
 * what it gains. The momentum that it transmits from one partner to the other then vanishes with its mass.
 *
 * w is 0 below a share of 1e-4 of the cell and 1 from 1e-2 on, by mass or by volume, whichever is larger. */
#include "coupling/exchange.h"

#include <math.h>
#include <stdbool.h>

static double weight_of_fraction(double share)
{
    const double x = (log(share) - log(TRACE_NONE)) / (log(TRACE_ALL) - log(TRACE_NONE));
    return x <= 0.0 ? 0.0 : x >= 1.0 ? 1.0 : x * x * (3.0 - 2.0 * x);
}

/* Weights of all present; whether any is a trace among three or more. */
static bool find_traces(int n, const double *mass, const double *theta, double *weight)
{
    double total = 0.0;
    int present = 0;
    bool found = false;
    for (int r = 0; r < n; ++r) {
        total += mass[r];
        present += mass[r] > 0.0;
    }
    if (present < 3 || isinf(total)) return false;
    for (int r = 0; r < n; ++r) {
        weight[r] = mass[r] > 0.0 ? weight_of_fraction(fmax(mass[r] / total, theta[r])) : 1.0;
        found = found || weight[r] < 1.0;
    }
    return found;
}

/* Couplings of traces, limited so that they vanish with the weight of the lighter of the two. */
static void limit_couplings(int n, const double *mass, const double *weight, exchange_matrix a, exchange_matrix limited)
{
    for (int r = 0; r < n; ++r)
        for (int s = 0; s < n; ++s) {
            const double w = fmin(weight[r], weight[s]);
            limited[r][s] = r == s ? 0.0 : a[r][s];
            if (w == 1.0 || !(limited[r][s] > 0.0)) continue;
            const double most = fmin(mass[r], mass[s]) * w / (1.0 - w);
            limited[r][s] = a[r][s] < EXCHANGE_RIGID * most ? a[r][s] * most / (a[r][s] + most) : most;
        }
}

/* Moves trace t towards the mean of its heavier partners by what the limit has left of its couplings to them. */
static void follow_partners(int n, const double *mass, exchange_matrix a, exchange_matrix limited, int t, double *u)
{
    double coupling = 0.0, mean = 0.0;
    for (int s = 0; s < n; ++s) {
        if (!(mass[s] > mass[t])) continue;
        coupling += a[t][s] - limited[t][s];
        mean += (a[t][s] - limited[t][s]) * u[s];
    }
    if (!(coupling > 0.0)) return;
    const double change = (mean / coupling - u[t]) * (coupling / (coupling + mass[t]));
    u[t] += change;
    for (int s = 0; s < n; ++s)
        if (mass[s] > mass[t]) u[s] -= change * (mass[t] / mass[s]) * ((a[t][s] - limited[t][s]) / coupling);
}

void exchange_relax_parts(int n, const double *mass, const double *theta, exchange_matrix a, int columns,
                          double value[][EXCHANGE_MAX])
{
    double weight[EXCHANGE_MAX];
    exchange_matrix limited;
    if (!find_traces(n, mass, theta, weight)) {
        exchange_relax(n, mass, a, columns, value);
        return;
    }
    limit_couplings(n, mass, weight, a, limited);
    exchange_relax(n, mass, limited, columns, value);
    for (int t = 0; t < n; ++t)
        for (int c = 0; c < columns && weight[t] < 1.0; ++c) follow_partners(n, mass, a, limited, t, value[c]);
}

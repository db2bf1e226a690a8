/* Heat that a shock gives the fluids of a cell at their interface (theory 2.15). Upwinding mixes gas that the shock has passed into a cell that it is
 * passing, where it is heated again, while the fluid that leaves the cell is compressed along its isentrope alone. One gas shares that in the mean of the
 * cell. Here fluids that are hotter than a shock makes them give what is too much to those that are cooler. What a shock makes of them is known from the
 * cells about: the pressure between the waves of the Riemann problem of the fluids on both sides, and the Hugoniot curves up to it. */
#include "ice/exchange/ice_exchange.h"

#include "coupling/hugoniot.h"
#include "coupling/isentrope.h"
#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/ice_constants.h"

#include <math.h>

enum { ASIDE = 2, AROUND = 2 * ASIDE * MESH_MAX_DIM, SOLVES = 20 };

/* A cell that one fluid fills. */
typedef struct side {
    ptrdiff_t at;
    int fluid, axis, cells; /* along the axis, with a sign */
} side;

/* The fluid that fills a cell; -1: it is shared. */
static int fluid_that_fills(const ice_view *v, ptrdiff_t at)
{
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].theta[at] > ICE_SHARED_FILLED) return r;
    return -1;
}

/* The cells about a shared one, no more than two away along the axes, that have a fluid each, the nearest first: of equal ones these count, here as
 * in the mirror image. Returns how many. */
static int find_sides(const ice_view *v, ptrdiff_t at, side *found)
{
    int n = 0;
    for (int k = 1; k <= ASIDE; ++k)
        for (int f = 0; f < 2 * v->dim; ++f) {
            const int cells = f % 2 == SIDE_UPPER ? k : -k;
            const ptrdiff_t beside = at + cells * v->b->stride[f / 2];
            const int r = fluid_that_fills(v, beside);
            if (r >= 0) found[n++] = (side){beside, r, f / 2, cells};
        }
    return n;
}

/* Mass flux (kg/m2/s) of the wave that brings what fills a cell to the pressure p, and its volume behind it; of a fan that of sound. False: there is none. */
static bool wave_into(const ice_view *v, const side *into, double p, double *flux, double *volume)
{
    const ice_fluid *m = &v->m[into->fluid];
    const double before = m->v[into->at], p0 = v->p[into->at];
    double energy;
    *volume = before;
    *flux = m->c[into->at] / before;
    if (!(p > p0)) return true;
    if (!hugoniot_state(&v->material[into->fluid].eos, before, m->e[into->at], p0, p, volume, &energy)) return false;
    *flux = sqrt((p - p0) / (before - *volume));
    return true;
}

/* Velocity with which two cells about one approach each other, along the line between them. */
static double approach_of(const ice_view *v, const side *from, const side *to)
{
    const double along = v->mean[from->axis][from->at] - v->mean[from->axis][to->at],
                 other = v->mean[to->axis][from->at] - v->mean[to->axis][to->at];
    if (from->axis == to->axis) return to->cells > from->cells ? along : -along;
    return (to->cells * other - from->cells * along) / hypot(from->cells, to->cells);
}

/* The pressure between the waves that run from a cell of one fluid and into one of another, by the two shocks' approximation, and how much alike their
 * densities are behind these. False where there is none. */
static bool pressure_between(const ice_view *v, const side *high, const side *low, double *p, double *alike)
{
    const double pH = v->p[high->at], pL = v->p[low->at], meet = approach_of(v, high, low);
    *p = pH;
    for (int n = 0; n < SOLVES; ++n) {
        double zH, zL, vH, vL;
        if (!wave_into(v, high, *p, &zH, &vH) || !wave_into(v, low, *p, &zL, &vL)) return false;
        const double ratio = least(vH / vL, vL / vH), last = *p;
        *alike = least(most((ratio - ICE_SHARED_UNLIKE) / (ICE_SHARED_ALIKE - ICE_SHARED_UNLIKE), 0.0), 1.0);
        *p = (zL * pH + zH * pL + zL * zH * meet) / (zL + zH);
        if (!(*p > pL)) return false;
        if (fabs(*p - last) < ICE_SHARED_PRESSURE * *p) break;
    }
    return true;
}

/* Pressure of the shock that passes the interface, from the cell with the highest pressure to that with the lowest of another fluid; false: none does. */
static bool shock_pressure(const ice_view *v, const side *found, int n, double *p, double *alike)
{
    const side *high = NULL, *low = NULL;
    for (int i = 0; i < n; ++i)
        if (!high || v->p[found[i].at] > v->p[high->at]) high = &found[i];
    for (int i = 0; i < n; ++i)
        if (found[i].fluid != high->fluid && (!low || v->p[found[i].at] < v->p[low->at])) low = &found[i];
    if (!low) return false;
    return pressure_between(v, high, low, p, alike);
}

/* Energy that a fluid has at a volume, on the isentrope of what fills a cell about, or of that behind a shock to p in it. */
static bool energy_after(const ice_view *v, const side *from, double p, double volume, double *energy)
{
    const ice_fluid *m = &v->m[from->fluid];
    const eos *law = &v->material[from->fluid].eos;
    double before = m->v[from->at], e = m->e[from->at];
    isentrope path;
    if (p > v->p[from->at] && !hugoniot_state(law, before, e, v->p[from->at], p, &before, &e)) return false;
    if (!isentrope_through(law, before, e, &path)) return false;
    *energy = isentrope_energy(&path, volume);
    return true;
}

/* What fluid r has (J/m3) beyond the energy that the shock gives it; 0 where that is not known. */
static double excess_of(const ice_view *v, int r, ptrdiff_t at, const side *found, int n, double p)
{
    const ice_fluid *m = &v->m[r];
    const double volume = ice_specific_volume_after(m, at, v->dP[at], false);
    double bound = 0.0;
    bool known = false;
    for (int i = 0; i < n && m->rho[at] > 0.0; ++i) {
        double energy;
        if (found[i].fluid != r || !energy_after(v, &found[i], p, volume, &energy)) continue;
        bound = known ? most(bound, energy) : energy;
        known = true;
    }
    return known ? m->rho[at] * (m->el[at] - bound) : 0.0;
}

void ice_share_shock(const ice_view *v, ptrdiff_t at)
{
    side found[AROUND];
    double p, alike = 0.0, excess[ICE_MAX_MATERIALS], over = 0.0, under = 0.0;
    if (!v->interface || !(v->shock[at] * v->interface[at] > 0.0) || ice_holds_points(v, at)) return;
    if (fluid_that_fills(v, at) >= 0) return;
    const int n = find_sides(v, at, found);
    if (n == 0 || !shock_pressure(v, found, n, &p, &alike)) return;
    for (int r = 0; r < v->n_materials; ++r) {
        excess[r] = excess_of(v, r, at, found, n, p);
        over += most(excess[r], 0.0);
        under += most(-excess[r], 0.0);
    }
    if (!(over > 0.0 && under > 0.0)) return;
    const double moved = alike * v->shock[at] * least(over, under);
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].rho[at] > 0.0)
            v->m[r].el[at] -= moved * (excess[r] > 0.0 ? excess[r] / over : excess[r] / under) / v->m[r].rho[at];
}

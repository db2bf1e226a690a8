/* The pressure of a cell in its present state; the pressure field contains the equilibrium at the start of the last step. */
#include "ice/equilibrium/ice_closure.h"
#include "ice/state/ice_materials.h"

static double value_of(const fields *f, field_id id, int r, ptrdiff_t at)
{
    return field_get(f, id, r, 0)[at];
}

/* How many materials a cell holds; *points: one of them is carried by points. */
static int count_in(const ice *s, const ice_region *g, const fields *f, ptrdiff_t at, bool *points)
{
    int count = 0;
    for (int r = g->first; r < g->first + g->n; ++r) {
        if (!(value_of(f, C_RHO, r, at) > 0.0)) continue;
        count++;
        *points = *points || s->material[r].points;
    }
    return count;
}

/* Of several fluids (theory 2.1), closed as ice_mixture.c closes them; `last` where no pressure fills the cell. */
static double of_mixture(const ice *s, const ice_region *g, const fields *f, ptrdiff_t at, double last)
{
    isentrope path[ICE_MAX_MATERIALS];
    equilibrium_batch b;
    bool near = true;
    const bool reconcile = ice_follows_isentropes(s, g);
    b.n = 0;
    b.p[0] = last;
    for (int r = g->first; r < g->first + g->n; ++r) {
        const eos *law = &s->material[r].eos;
        const int k = b.n;
        b.a[k][0] = value_of(f, C_RHO, r, at);
        if (!(b.a[k][0] > 0.0)) continue;
        const double v = value_of(f, C_VOL, r, at), e = value_of(f, C_ENERGY, r, at), density = 1.0 / v;
        b.eos[k] = law;
        law->model->temperature(law->par, 1, &density, &e, &b.T[k][0]);
        b.path[k] = reconcile && isentrope_through(law, v, e, &path[k]) ? &path[k] : NULL;
        near = near && b.path[k] && ice_near_pressure(&path[k], last) && !isnan(s->material[r].energy_floor);
        b.n++;
    }
    for (int k = 0; k < b.n && near; ++k) b.path[k] = NULL;
    return equilibrium_solve(&b, 1) == FLOE_OK ? b.p[0] : last;
}

double ice_pressure_now(const ice *s, int block_id, int material, ptrdiff_t at)
{
    const fields *f = s->domain->fields[block_id];
    const ice_region *g = ice_region_of(s, material);
    if (g->n > 1) {
        const double last = value_of(f, C_PRESSURE, g->number, at);
        bool points = false;
        const int count = count_in(s, g, f, at, &points);
        if (points) return last;
        if (count > 1) return of_mixture(s, g, f, at, last);
    }
    const eos *law = &s->material[material].eos;
    const double rho = value_of(f, C_RHO, material, at), e = value_of(f, C_ENERGY, material, at);
    double pressure, c2;
    law->model->pressure(law->par, 1, &rho, &e, &pressure, &c2);
    return pressure;
}

/* The pressure of a cell as its state is now: the field of it holds the equilibrium at the start of the last step. */
#include "ice/ice_internal.h"

/* How many materials a cell holds; *points: one of them is carried by points. */
static int count_in(const ice *s, const ice_view *v, ptrdiff_t at, bool *points)
{
    int count = 0;
    for (int r = 0; r < s->n_materials; ++r) {
        if (!(v->m[r].rho[at] > 0.0)) continue;
        count++;
        *points = *points || s->material[r].points;
    }
    return count;
}

/* Of several fluids (numerics 2.1), closed as ice_mixture.c closes them; `last` where no pressure fills the cell. */
static double of_mixture(const ice *s, const ice_view *v, ptrdiff_t at, double last)
{
    isentrope path[ICE_MAX_MATERIALS];
    equilibrium_cell cell = {.n = s->n_materials, .p = last};
    for (int r = 0; r < s->n_materials; ++r) {
        const ice_arrays *m = &v->m[r];
        cell.eos[r] = &s->material[r].eos;
        cell.a[r] = m->rho[at];
        if (!(m->rho[at] > 0.0)) continue;
        const double density = 1.0 / m->vol[at];
        cell.eos[r]->model->temperature(cell.eos[r]->par, 1, &density, &m->e[at], &cell.T[r]);
        if (s->work->reconcile && isentrope_through(cell.eos[r], m->vol[at], m->e[at], &path[r]))
            cell.path[r] = &path[r];
    }
    return equilibrium_solve(s->work->solver[0], &cell) == FLOE_OK ? cell.p : last;
}

double ice_pressure_in(const ice *s, const ice_view *v, int material, ptrdiff_t at)
{
    if (s->multi) {
        const double last = field_get(s->domain->fields[v->b->id], C_PRESSURE, 0, 0)[at];
        bool points = false;
        const int count = count_in(s, v, at, &points);
        if (points) return last;
        if (count > 1) return of_mixture(s, v, at, last);
    }
    const ice_arrays *m = &v->m[material];
    const eos *law = &s->material[material].eos;
    double pressure, c2;
    law->model->pressure(law->par, 1, &m->rho[at], &m->e[at], &pressure, &c2);
    return pressure;
}

double ice_pressure_now(const ice *s, int block_id, int material, ptrdiff_t at)
{
    ice_view v;
    ice_view_make(s, block_id, &v);
    return ice_pressure_in(s, &v, material, at);
}

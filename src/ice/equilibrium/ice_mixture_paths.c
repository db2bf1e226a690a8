/* The isentropes along which the materials of a mixed cell come to one pressure, and the energy that they end with (theory 2.1). */
#include "ice/equilibrium/ice_mixture_row.h"

#include <math.h>

/* A frozen T will not do. In laws whose energy depends on volume at a given temperature v(p, T) belongs to another energy than the cell's, and an
 * error of v comes back larger by (gamma - 1) p_inf/(p + p_inf) in each step, 3.4 times in water of gamma 4.4. And what upwinding carries ahead of a
 * shock would expand to v = R T/p without doing work, to be compressed anew in the next step: its energy grows by up to p_2/p_1 in each cell that
 * the shock passes. So scenes of several fluids close the cell along isentropes. */
const isentrope *ice_choose_path(const mixture_row *q, const mixture_run *run, int k)
{
    const int r = run->material[k];
    const ice_fluid *m = &q->v->m[r];
    isentrope *path = q->mixed->path[k];
    if (!q->v->reconcile || q->v->material[r].points) return NULL;
    isentropes_through(&q->v->material[r].eos, run->n, m->vol + run->from, m->e + run->from, path);
    return path;
}

/* If the materials nearly have one pressure already, nothing expands, and exchanged heat must not do work: T is frozen in such cells, provided
 * that the energy of all laws depends on temperature alone. */
void ice_freeze_near(const mixture_row *q, const mixture_run *run)
{
    const equilibrium_batch *b = &q->mixed->batch;
    bool *frozen = q->mixed->frozen, bears = q->v->reconcile;
    for (int k = 0; k < run->count && bears; ++k)
        bears = b->path[k] && !isnan(q->v->material[run->material[k]].energy_floor);
    for (int i = 0; i < run->n; ++i) frozen[i] = bears;
    for (int k = 0; k < run->count && bears; ++k)
        for (int i = 0; i < run->n; ++i) frozen[i] = frozen[i] && ice_near_pressure(&b->path[k][i], b->p[i]);
    for (int k = 0; k < run->count && bears; ++k)
        for (int i = 0; i < run->n; ++i)
            if (frozen[i]) q->mixed->path[k][i].exponent = 0.0;
}

/* Energy at the end of material k's paths in a run, and c_v and T there. */
static void end_paths(const mixture_row *q, const mixture_run *run, int k)
{
    const equilibrium_batch *b = &q->mixed->batch;
    const eos *law = b->eos[k];
    double *e = q->mixed->e[k], *cv = q->mixed->cv[k], *T = q->mixed->T[k];
    for (int i = 0; i < run->n; ++i) q->a[i] = 1.0 / b->v[k][i];
    law->model->energy(law->par, (size_t)run->n, q->a, b->T[k], e);
    for (int i = 0; i < run->n; ++i)
        if (b->path[k][i].exponent > 0.0) e[i] = isentrope_energy(&b->path[k][i], b->v[k][i]);
    law->model->heat(law->par, (size_t)run->n, q->a, e, cv, q->d);
    law->model->temperature(law->par, (size_t)run->n, q->a, e, T);
}

/* Materials at unlike pressures do not do opposite work as they come to one; the difference goes to all alike, so that the cell keeps its energy:
 * as one change of temperature, or, where energy is missing, by one factor on the temperatures, below zero none. */
static void share_rest(const mixture_row *q, const mixture_run *run, int i)
{
    const equilibrium_batch *b = &q->mixed->batch;
    const ice_closing_cells *c = q->mixed;
    const ptrdiff_t at = run->from + i;
    double over = 0.0, capacity = 0.0, content = 0.0;
    int paths = 0;
    for (int k = 0; k < run->count; ++k) {
        const ice_fluid *m = &q->v->m[run->material[k]];
        if (!b->path[k]) continue;
        over += m->rho[at] * (m->e[at] - c->e[k][i]);
        capacity += m->rho[at] * c->cv[k][i];
        content += m->rho[at] * c->cv[k][i] * most(c->T[k][i], 0.0);
        paths++;
    }
    const bool factor = paths > 1 && over < 0.0 && content > 0.0;
    for (int k = 0; k < run->count; ++k) {
        const ice_fluid *m = &q->v->m[run->material[k]];
        if (!b->path[k]) continue;
        const double warming = factor ? most(c->T[k][i], 0.0) * (over / content) : over / capacity;
        m->e[at] = c->e[k][i] + c->cv[k][i] * warming;
        m->vol[at] = b->v[k][i];
    }
}

/* What the paths of a run end in; frozen cells keep their energies. Materials without a path take e(v, T). */
void ice_follow_paths(const mixture_row *q, const mixture_run *run)
{
    const equilibrium_batch *b = &q->mixed->batch;
    const bool *frozen = q->mixed->frozen;
    int moved = 0;
    for (int i = 0; i < run->n; ++i) moved += !frozen[i];
    if (moved == 0) return;
    for (int k = 0; k < run->count; ++k)
        if (b->path[k]) end_paths(q, run, k);
    for (int i = 0; i < run->n; ++i)
        if (!frozen[i]) share_rest(q, run, i);
    for (int k = 0; k < run->count; ++k) {
        const ice_fluid *m = &q->v->m[run->material[k]];
        const eos *law = b->eos[k];
        for (int i = 0; i < run->n && b->path[k]; ++i) {
            const ptrdiff_t at = run->from + i;
            const double density = 1.0 / m->vol[at];
            if (!frozen[i]) law->model->temperature(law->par, 1, &density, &m->e[at], &m->T[at]);
        }
    }
}

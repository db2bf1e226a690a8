/* What fluid that comes into a cell, or leaves it, does to its next state (theory 2.18). */
#include "ice/inject/ice_injection.h"
#include "ice/state/ice_fluid_state.h"

#include <math.h>

/* The pressure of the next state: of one fluid by its law, of several that of the last closure. */
static double pressure_now(const ice_view *v, int r, ptrdiff_t at)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &v->material[r].eos;
    double p, c2;
    if (v->multi) return v->p[at];
    law->model->pressure(law->par, 1, &m->rho1[at], &m->e1[at], &p, &c2);
    return p;
}

/* Work (J/m3) of a volume that comes in or leaves, on all fluids of the cell: each changes by its compressibility. */
static void compress_fluids(const ice_view *v, ptrdiff_t at, double work, double p)
{
    double stiffness = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (!v->material[r].points && v->m[r].rho1[at] > 0.0)
            stiffness += v->m[r].rho1[at] * v->m[r].vol1[at] * v->m[r].kappa[at];
    for (int r = 0; r < v->n_materials && stiffness > 0.0; ++r) {
        const ice_fluid *m = &v->m[r];
        if (v->material[r].points || !(m->rho1[at] > 0.0)) continue;
        const double change = m->kappa[at] * work / (p * stiffness); /* kappa dP */
        m->e1[at] += p * m->vol1[at] * change;
        m->vol1[at] *= change > 0.0 ? 1.0 / (1.0 + change) : 1.0 - change;
    }
}

/* Mixes it with what the cell has of the fluid. The kinetic energy that is lost becomes heat. */
static void mix_in(const ice_view *v, const ice_fluid *m, ptrdiff_t at, const cell_intake *in, double energy)
{
    const double before = m->rho1[at], after = before + in->density, part = in->density / after;
    double square = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const double slip = in->velocity[a] - m->u1[a][at];
        square += slip * slip;
        m->u1[a][at] += part * slip;
    }
    if (!(before > 0.0)) square = 0.0;
    m->e1[at] = (1.0 - part) * m->e1[at] + part * (energy + 0.5 * (1.0 - part) * square);
    m->rho1[at] = after;
}

double ice_take_in(const ice_view *v, int r, ptrdiff_t at, const cell_intake *in)
{
    const ice_fluid *m = &v->m[r];
    const double p = pressure_now(v, r, at), part = in->density / (m->rho1[at] + in->density);
    const ice_reservoir q = ice_state_at(&v->material[r].eos, p, in->temperature);
    double square = 0.0;
    for (int a = 0; a < v->dim; ++a) square += in->velocity[a] * in->velocity[a];
    if (v->multi) {
        m->vol1[at] = m->rho1[at] > 0.0 ? m->vol1[at] + part * (q.v - m->vol1[at]) : q.v;
        mix_in(v, m, at, in, q.e);
        compress_fluids(v, at, in->density * p * q.v, p);
    } else
        mix_in(v, m, at, in, q.e + p * q.v);
    return in->density * (q.e + p * q.v + 0.5 * square);
}

void ice_give_out(const ice_view *v, int r, ptrdiff_t at, double density, double enthalpy)
{
    const ice_fluid *m = &v->m[r];
    const double before = m->rho1[at], after = before - density;
    if (!v->multi) {
        m->e1[at] = (before * m->e1[at] - enthalpy) / after;
        m->rho1[at] = after;
        return;
    }
    const double p = v->p[at], work = density * p * m->vol1[at];
    m->e1[at] = (before * m->e1[at] - (enthalpy - work)) / after;
    m->rho1[at] = after;
    compress_fluids(v, at, -work, p);
}

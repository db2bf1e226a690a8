/* Exchange of momentum and heat in mixed cells (theory 2.9; Guilkey et al. 2003, step 10), the heat of friction (2.8 ii), and the effect of exchange and
 * pressure on materials carried by points (5.1). */
#include "ice/exchange/ice_pairs.h"

#include "ice/ice_constants.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_lists.h"
#include "ice/state/ice_tiles.h"

#include <math.h>
#include <string.h>

/* One mixed cell: everything per cell volume. */
typedef struct mixed_cell {
    int n, dim;
    double mass[EXCHANGE_MAX], inertia[EXCHANGE_MAX], theta[EXCHANGE_MAX], u[3][EXCHANGE_MAX];
    double entered[3][EXCHANGE_MAX]; /* u before the exchange */
    double volume_ratio;             /* TMV / V */
} mixed_cell;

static void gather_mixture(const ice_view *v, ptrdiff_t at, double volume, mixed_cell *c)
{
    c->n = v->n_materials;
    c->dim = v->dim;
    c->volume_ratio = v->tmv ? v->tmv[at] : 1.0;
    for (int r = 0; r < c->n; ++r) {
        const ice_fluid *m = &v->m[r];
        c->mass[r] = m->rho[at];
        c->inertia[r] = ice_inertia(v, r, m->rho[at]);
        c->theta[r] = m->theta[at];
        for (int a = 0; a < v->dim; ++a) {
            if (!v->material[r].points)
                c->u[a][r] = m->ul[a][at];
            else if (v->material[r].prescribed && m->rho[at] > 0.0) /* nothing accelerates it */
                c->u[a][r] = m->mom[a][at] / (m->rho[at] * volume);
            else if (m->rho[at] > 0.0)
                c->u[a][r] = (m->mom[a][at] + m->source[a][at]) / (m->rho[at] * volume);
            else
                c->u[a][r] = 0.0;
            c->entered[a][r] = c->u[a][r];
        }
    }
}

static double kinetic_energy(const mixed_cell *c)
{
    double sum = 0.0;
    for (int r = 0; r < c->n; ++r)
        for (int a = 0; a < c->dim; ++a) sum += 0.5 * c->mass[r] * c->u[a][r] * c->u[a][r];
    return sum;
}

/* Energy of relative motion per volume that the pressure has made in the step, driving light and heavy fluids apart: exchange only takes it back. */
static double driven_apart(const ice_view *v, ptrdiff_t at)
{
    double sum = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        double mass = 0.0, change = 0.0, square = 0.0;
        for (int r = 0; r < v->n_materials; ++r) {
            const ice_fluid *m = &v->m[r];
            const double rho = m->rho[at];
            if (!(rho > 0.0)) continue;
            const double du = m->ul[a][at] - m->u[a][at];
            mass += rho;
            change += rho * du;
            square += rho * du * du;
        }
        sum += 0.5 * most(square - change * change / mass, 0.0);
    }
    return sum;
}

/* Share of each material in what closes the energy of a cell of fluids: by rho T, so that none is cooled more than another; heat of a shock
 * goes to dispersed fluids by theta kappa, as their own compression has it. */
static void shares_of(const ice_view *v, ptrdiff_t at, double heat, double *share)
{
    double total = 0.0, squeezed = 0.0;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        if (!(m->rho[at] > 0.0)) continue;
        total += m->rho[at] * m->T[at];
        squeezed += m->theta[at] * m->kappa[at];
    }
    const double shocked = squeezed > 0.0 ? ice_shocked(v, at, heat) : 0.0;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        share[r] = m->rho[at] > 0.0 ? (1.0 - shocked) * (m->rho[at] * m->T[at] / total) : 0.0;
        if (shocked > 0.0 && m->rho[at] > 0.0) share[r] += shocked * (m->theta[at] * m->kappa[at] / squeezed);
    }
}

/* What closes the energy of a cell of fluids; where one had less than nothing left, or next to nothing beside its motion, it stays owed. */
static void close_energy(const ice_view *v, ptrdiff_t at, double heat)
{
    double share[ICE_MAX_MATERIALS];
    bool usable = true;
    shares_of(v, at, heat, share);
    for (int r = 0; r < v->n_materials && heat < 0.0; ++r) {
        const ice_fluid *m = &v->m[r];
        double kinetic_energy = 0.0;
        if (!(m->rho[at] > 0.0)) continue;
        for (int a = 0; a < v->dim; ++a) kinetic_energy += 0.5 * m->ul[a][at] * m->ul[a][at];
        const double left = m->el[at] + heat * share[r] / m->rho[at] - ice_least_energy(v, r);
        usable = usable && left > ICE_THERMAL_SHARE * kinetic_energy;
    }
    v->owed[at] = usable ? 0.0 : heat;
    for (int r = 0; r < v->n_materials && usable; ++r)
        if (v->m[r].rho[at] > 0.0) v->m[r].el[at] += heat * share[r] / v->m[r].rho[at];
}

/* Kinetic energy dissipated by friction becomes heat of the fluids, in proportion to volume fraction; beside solids it
 * is theirs and not entered, except where burnt gas leaves them. Velocity differences due to the pressure close their
 * own energy balance. */
static void deposit_friction(const ice *s, const ice_view *v, ptrdiff_t at, const double *theta, double lost,
                             double apart)
{
    const bool beside = ice_holds_points(v, at);
    if (!s->scene->method.conserve_energy || (beside && !v->burns)) return;
    const double back = least(most(lost, 0.0), apart), friction = most(lost, 0.0) - back;
    double total = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (!v->material[r].points) total += theta[r];
    for (int r = 0; r < v->n_materials && friction > 0.0; ++r)
        if (v->m[r].rho[at] > 0.0 && !v->material[r].points)
            v->m[r].el[at] += friction * theta[r] / total / v->m[r].rho[at];
    if (!beside) close_energy(v, at, v->owed[at] + back);
}

static void relax_by_laws(const ice *s, const ice_view *v, ptrdiff_t at, mixed_cell *c)
{
    double gradient[3];
    ice_spot spot;
    for (int r = 0; r < c->n; ++r) {
        spot.theta[r] = c->theta[r];
        spot.density[r] = 1.0 / v->m[r].v[at];
        spot.sound[r] = v->m[r].c[at];
        for (int a = 0; a < c->dim; ++a) spot.u[a][r] = c->u[a][r];
    }
    if (s->pairs->slips) {
        ice_wall_gradient(v, at, gradient);
        ice_pressure_slope(v, at, spot.slope);
    }
    ice_relax_spot(s, v, c->inertia, &spot, s->dt * c->volume_ratio, s->pairs->slips ? gradient : NULL, c->u);
}

/* Momentum per volume that the fluids of a cell have lost to bodies with a prescribed motion, divided in proportion to their volumes. */
static void give_prescribed(const ice_view *v, ptrdiff_t at, double volume, const mixed_cell *c)
{
    double filled = 0.0;
    for (int r = 0; r < c->n; ++r)
        if (v->material[r].prescribed && c->mass[r] > 0.0) filled += c->theta[r];
    for (int x = 0; x < c->dim && filled > 0.0; ++x) {
        double lost = 0.0;
        for (int r = 0; r < c->n; ++r)
            if (!v->material[r].prescribed) lost -= c->mass[r] * (c->u[x][r] - c->entered[x][r]);
        for (int r = 0; r < c->n; ++r) {
            const ice_fluid *m = &v->m[r];
            if (!v->material[r].prescribed || !(c->mass[r] > 0.0)) continue;
            m->dv[x][at] = (m->source[x][at] / volume + lost * (c->theta[r] / filled)) / c->mass[r];
        }
    }
}

static void exchange_momentum(ice *s, const ice_view *v, ptrdiff_t at, double volume)
{
    mixed_cell c;
    gather_mixture(v, at, volume, &c);
    const double before = kinetic_energy(&c), apart = ice_holds_points(v, at) ? 0.0 : driven_apart(v, at);
    if (s->pairs->plain) {
        exchange_matrix a;
        exchange_couple(c.n, ice_constants_of(s, v, ICE_NORMAL), c.theta, s->dt * c.volume_ratio, a);
        if (s->pairs->unlike)
            exchange_relax_parts(c.n, c.mass, c.theta, a, c.dim, c.u);
        else
            exchange_relax(c.n, c.mass, a, c.dim, c.u);
    } else {
        relax_by_laws(s, v, at, &c);
    }
    const double lost = before - kinetic_energy(&c);
    for (int r = 0; r < c.n; ++r)
        for (int x = 0; x < c.dim; ++x) {
            const ice_fluid *m = &v->m[r];
            if (!v->material[r].points)
                m->ul[x][at] = c.u[x][r];
            else if (m->rho[at] > 0.0)
                m->dv[x][at] = c.u[x][r] - m->mom[x][at] / (m->rho[at] * volume);
        }
    if (s->pairs->prescribed) give_prescribed(v, at, volume, &c);
    deposit_friction(s, v, at, c.theta, lost, apart);
}

/* (diag(m c_v) + B) T; temperatures after the sources are T + (e^L - e)/c_v. */
static void exchange_heat(ice *s, const ice_view *v, ptrdiff_t at)
{
    double mass[EXCHANGE_MAX], T[1][EXCHANGE_MAX], cv[EXCHANGE_MAX], before[EXCHANGE_MAX];
    ice_spot spot;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        const eos *law = &v->material[r].eos;
        const double density = 1.0 / m->v[at];
        double alpha;
        law->model->heat(law->par, 1, &density, &m->e[at], &cv[r], &alpha);
        mass[r] = m->rho[at] * cv[r];
        spot.theta[r] = m->theta[at];
        spot.density[r] = density;
        for (int a = 0; a < v->dim; ++a) spot.u[a][r] = m->u[a][at];
        before[r] = T[0][r] = m->T[at] + (v->material[r].points ? 0.0 : (m->el[at] - m->e[at]) / cv[r]);
    }
    exchange_matrix own, a;
    exchange_couple(v->n_materials, ice_coefficients(s, v, ICE_HEAT, &spot, own), spot.theta,
                    s->dt * (v->tmv ? v->tmv[at] : 1.0), a);
    exchange_relax(v->n_materials, mass, a, 1, T);
    for (int r = 0; r < v->n_materials; ++r) {
        if (!(v->m[r].rho[at] > 0.0)) continue;
        if (!v->material[r].points)
            v->m[r].el[at] += cv[r] * (T[0][r] - before[r]);
        else if (v->m[r].dT && v->material[r].warms)
            v->m[r].dT[at] = T[0][r] - before[r];
    }
}

/* No exchange where a solid is alone. */
static void clear_temperature_change(const ice_view *v)
{
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].dT) memset(v->m[r].dT, 0, v->b->size * sizeof(double));
}

/* Where a solid is alone, the pressure gradient is all that reaches its nodes. */
static void move_lone_points(const ice_view *v, int r)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    const ice_fluid *m = &v->m[r];
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t from = ice_row_start(v->b, q, row);
        for (int a = 0; a < v->dim; ++a) {
            const double *restrict rho = m->rho + from, *restrict source = m->source[a] + from;
            double *restrict change = m->dv[a] + from;
            for (int i = 0; i < v->b->n[0]; ++i) change[i] = rho[i] > 0.0 ? source[i] / (rho[i] * v->volume[i]) : 0.0;
        }
    }
}

/* What is still owed of a block's mixed cells has been made or lost, and goes into the tiles. */
static void enter_owed(const ice *s, const ice_view *v, const ice_cell_list *list)
{
    for (size_t n = 0; n < list->n; ++n) {
        const ptrdiff_t at = list->at[n];
        if (v->owed[at] == 0.0) continue;
        int cell[MESH_MAX_DIM];
        ice_cell_of(v->b, at, cell);
        double *tile = ice_tile(s, v->b, cell[0], cell[1], cell[2]);
        tile[TILE_DEFECT] -= v->owed[at] * v->volume[cell[0]] * (v->m[0].open ? v->m[0].open[at] : 1.0);
        tile[TILE_GUARDS] += 1.0;
    }
}

static int exchange_cell(ice *s, const ice_view *v, ptrdiff_t at, bool pair)
{
    const ptrdiff_t i = v->dim > 1 ? at % v->b->stride[1] - MESH_GHOST : at - MESH_GHOST;
    if (!pair) exchange_momentum(s, v, at, v->volume[i]);
    if (s->scene->method.conserve_energy) ice_share_shock(v, at);
    if (s->pairs->heat) exchange_heat(s, v, at);
    return v->owed[at] != 0.0;
}

/* Exchange in a block's mixed cells, some at a time. Returns how many of them still owe energy. */
static int exchange_cells(ice *s, const ice_view *v, const ice_cell_list *list)
{
    enum { SOME = 256 };
    const bool pair = v->n_materials == 2 && s->pairs->plain && ice_reaction_count(s) == 0;
    int owing = 0;
#pragma omp parallel for schedule(static) reduction(+ : owing)
    for (size_t from = 0; from < list->n; from += SOME) {
        const size_t to = from + SOME < list->n ? from + SOME : list->n;
        if (pair) ice_exchange_pair(s, v, list, from, to);
        for (size_t n = from; n < to; ++n) owing += exchange_cell(s, v, list->at[n], pair);
    }
    return owing;
}

floe_status ice_exchange_of(ice *s, const ice_region *g)
{
    int owing = 0;
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        ice_view_lagrangian(&v);
        const ice_cell_list *mixed = ice_mixed_cells(s, &v);
        for (int r = 0; r < v.n_materials; ++r)
            if (v.material[r].points) move_lone_points(&v, r);
        clear_temperature_change(&v);
        if (exchange_cells(s, &v, mixed) == 0) continue;
        if (owing++ == 0) ice_clear_tiles(s);
        enter_owed(s, &v, mixed);
    }
    if (owing > 0) ice_enter_tiles(s);
    return FLOE_OK;
}

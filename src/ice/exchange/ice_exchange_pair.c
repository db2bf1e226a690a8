/* Exchange of momentum where the scene has two materials with a constant coefficient and no reaction (theory 2.9): in closed form, by runs of
 * mixed cells that lie side by side. Kinetic energy goes by the reduced mass mu = m_0 m_1/(m_0 + m_1) and the difference d of the velocities,
 *     1/2 m_0 u_0^2 + 1/2 m_1 u_1^2 = 1/2 (m_0 + m_1) U^2 + 1/2 mu d^2,    U that of the centre of mass, which exchange leaves. */
#include "ice/exchange/ice_pairs.h"

#include "ice/ice_constants.h"
#include "ice/state/ice_lists.h"

#include <math.h>
#include <string.h>

enum { MOST_CELLS = 64 };

/* A run of mixed cells. */
typedef struct pair_run {
    const ice *s;
    const ice_view *v;
    ptrdiff_t from;
    int n;
    double share0[MOST_CELLS], share1[MOST_CELLS], kept[MOST_CELLS]; /* as in exchange_two */
    double half[MOST_CELLS];                                         /* mu/2 per cell volume, kg/m3 */
    double u[2][MOST_CELLS];                                         /* m/s, along one axis */
    double square[2][MOST_CELLS];                                    /* of the velocities after the exchange, m2/s2 */
    double lost[MOST_CELLS];                                         /* J/m3: relative motion that exchange takes */
    double apart[MOST_CELLS]; /* J/m3: that the pressure has made in the step, driving light and heavy apart */
} pair_run;

static void compute_weights(pair_run *q)
{
    const ice_fluid *m = q->v->m;
    const double *tmv = q->v->tmv, strength = q->s->dt * ice_constants_of(q->s, q->v, ICE_NORMAL)[0][1];
    for (int i = 0; i < q->n; ++i) {
        const ptrdiff_t at = q->from + i;
        const double m0 = m[0].rho[at], m1 = m[1].rho[at], volume_ratio = tmv ? tmv[at] : 1.0;
        const exchange_two two = exchange_of_two(m0, m1, strength * volume_ratio * m[0].theta[at] * m[1].theta[at]);
        q->share0[i] = two.share0;
        q->share1[i] = two.share1;
        q->kept[i] = two.kept;
        q->half[i] = 0.5 * m0 * two.share1;
        q->lost[i] = q->apart[i] = q->square[0][i] = q->square[1][i] = 0.0;
    }
}

/* Volumes (m3) of the cells. */
static const double *cell_volumes(const pair_run *q)
{
    const ptrdiff_t in_row = q->v->dim > 1 ? q->from % q->v->b->stride[1] : q->from;
    return q->v->volume + in_row - MESH_GHOST;
}

/* Velocities before the exchange; of materials on points from the momentum that their nodes have brought, and the pressure's part. */
static void take_velocity(pair_run *q, int r, int axis)
{
    const ice_fluid *m = &q->v->m[r];
    const double *rho = m->rho + q->from, *volume = cell_volumes(q);
    if (q->v->material[r].points) {
        const double *momentum = m->mom[axis] + q->from, *source = m->source[axis] + q->from;
        for (int i = 0; i < q->n; ++i) q->u[r][i] = (momentum[i] + source[i]) / (rho[i] * volume[i]);
    } else {
        memcpy(q->u[r], m->ul[axis] + q->from, (size_t)q->n * sizeof *q->u[r]);
    }
}

/* Velocities after it; of materials on points what they change by. */
static void give_velocity(pair_run *q, int r, int axis)
{
    const ice_fluid *m = &q->v->m[r];
    const double *rho = m->rho + q->from, *volume = cell_volumes(q);
    if (q->v->material[r].points) {
        const double *momentum = m->mom[axis] + q->from;
        double *change = m->dv[axis] + q->from;
        for (int i = 0; i < q->n; ++i) change[i] = q->u[r][i] - momentum[i] / (rho[i] * volume[i]);
    } else {
        memcpy(m->ul[axis] + q->from, q->u[r], (size_t)q->n * sizeof *q->u[r]);
    }
}

static void relax_velocities(pair_run *q)
{
    for (int i = 0; i < q->n; ++i) {
        const exchange_two two = {q->share0[i], q->share1[i], q->kept[i]};
        const double before = q->u[0][i] - q->u[1][i], after = q->kept[i] * before;
        exchange_relax_two(two, &q->u[0][i], &q->u[1][i]);
        q->lost[i] += q->half[i] * (before * before - after * after);
        q->square[0][i] += q->u[0][i] * q->u[0][i];
        q->square[1][i] += q->u[1][i] * q->u[1][i];
    }
}

/* Exchange only takes back what the pressure has driven apart. */
static void add_driven_apart(pair_run *q, int axis)
{
    const double *u0 = q->v->m[0].u[axis] + q->from, *u1 = q->v->m[1].u[axis] + q->from;
    for (int i = 0; i < q->n; ++i) {
        const double change = (q->u[0][i] - u0[i]) - (q->u[1][i] - u1[i]);
        q->apart[i] += q->half[i] * change * change;
    }
}

/* Heat of friction is divided by volume fraction. The heat that closes the energy of a cell is divided by rho T, so that none is cooled more
 * than another, the heat of a shock in dispersed fluids by theta kappa, as their own compression; if a fluid would be left with negative energy,
 * or with next to none beside its kinetic energy, the heat stays owed. */
static void deposit_friction_rows(const pair_run *q)
{
    const ice_fluid *m0 = &q->v->m[0], *m1 = &q->v->m[1];
    const double *T0 = m0->T + q->from, *T1 = m1->T + q->from;
    const double floor0 = ice_least_energy(q->v, 0), floor1 = ice_least_energy(q->v, 1);
    const double *rho0 = m0->rho + q->from, *rho1 = m1->rho + q->from;
    const double *theta0 = m0->theta + q->from, *theta1 = m1->theta + q->from;
    const double *kappa0 = m0->kappa + q->from, *kappa1 = m1->kappa + q->from;
    const double *sensor = q->v->shock + q->from, none[MOST_CELLS] = {0.0};
    const double *at_interface = q->v->interface ? q->v->interface + q->from : none;
    const double shocks = q->v->interface ? 1.0 : 0.0;
    double *restrict e0 = m0->el + q->from, *restrict e1 = m1->el + q->from, *restrict owed = q->v->owed + q->from;
#pragma omp simd
    for (int i = 0; i < q->n; ++i) {
        const double back = least(q->lost[i], q->apart[i]), heat = owed[i] + back;
        const double friction = (q->lost[i] - back) / (theta0[i] + theta1[i]);
        const double warming = heat / (rho0[i] * T0[i] + rho1[i] * T1[i]);
        const double shock = shocks * sensor[i] * (1.0 - at_interface[i]), shocked = heat > 0.0 ? shock : 0.0;
        const double squeezed0 = theta0[i] * kappa0[i], squeezed1 = theta1[i] * kappa1[i];
        const double plain = (1.0 - shocked) * warming, squeeze = shocked * heat / (squeezed0 + squeezed1);
        const double warm0 = e0[i] + friction * theta0[i] / rho0[i];
        const double warm1 = e1[i] + friction * theta1[i] / rho1[i];
        const double next0 = warm0 + plain * T0[i] + squeeze * squeezed0 / rho0[i];
        const double next1 = warm1 + plain * T1[i] + squeeze * squeezed1 / rho1[i];
        const bool enough0 = next0 - floor0 > ICE_THERMAL_SHARE * 0.5 * q->square[0][i];
        const bool enough1 = next1 - floor1 > ICE_THERMAL_SHARE * 0.5 * q->square[1][i];
        const bool usable = heat < 0.0 ? enough0 & enough1 : true;
        owed[i] = usable ? 0.0 : heat;
        e0[i] = usable ? next0 : warm0;
        e1[i] = usable ? next1 : warm1;
    }
}

static void exchange_run(pair_run *q)
{
    const bool heats = q->s->scene->method.conserve_energy && !q->s->with_points;
    compute_weights(q);
    for (int a = 0; a < q->v->dim; ++a) {
        take_velocity(q, 0, a);
        take_velocity(q, 1, a);
        if (heats) add_driven_apart(q, a);
        relax_velocities(q);
        give_velocity(q, 0, a);
        give_velocity(q, 1, a);
    }
    if (heats) deposit_friction_rows(q);
}

void ice_exchange_pair(const ice *s, const ice_view *v, const ice_cell_list *list, size_t from, size_t to)
{
    pair_run q = {.s = s, .v = v};
    for (size_t n = from; n < to; n += (size_t)q.n) {
        q.from = list->at[n];
        q.n = 1;
        while (q.n < MOST_CELLS && n + (size_t)q.n < to && list->at[n + (size_t)q.n] == q.from + q.n) ++q.n;
        exchange_run(&q);
    }
}

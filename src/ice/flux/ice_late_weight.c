/* Gravity of second order in time (theory 2.6): the Lagrangian step has pushed each cell with the weight of the mass that it held at the start; half of what the
 * advection has changed of that mass is entered here.
 *
 *     d(m u) = dt/2 (m' - m) g,     W = dt/2 g . (m' u' - m u^L)      (faces from waves, 2.17)
 *
 * so that impulse and work of gravity are those of the mean mass and the mean momentum of the step. Slabs of 2.11 carry u^L, with the impulses of the whole
 * step: what is missing there is of the pressure, as far as that bears the weight, and nothing of a fluid that falls freely.
 *
 * All fluids of a cell change their velocity alike. Nothing changes in a column at rest, where m' = m. */
#include "ice/flux/ice_late_weight.h"

#include "ice/ice_constants.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_tiles.h"

#include <math.h>

/* The smaller of two of one sign, else 0. */
static double common_part(double a, double b)
{
    return a * b > 0.0 ? copysign(fmin(fabs(a), fabs(b)), a) : 0.0;
}

/* Of all fluids of a cell per volume: mass before and after; momentum after the Lagrangian step less that before it, and with it. */
typedef struct moved_cell {
    double before, after, gained[3], pushed[3];
} moved_cell;

static moved_cell moved_of(const ice_view *v, ptrdiff_t at)
{
    moved_cell q = {.before = 0.0};
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        if (v->material[r].points) continue;
        q.before += m->rho[at];
        q.after += m->rho1[at];
        for (int a = 0; a < v->dim; ++a) {
            q.gained[a] += m->rho[at] * (m->ul[a][at] - m->u[a][at]);
            q.pushed[a] += m->rho[at] * m->ul[a][at];
        }
    }
    return q;
}

/* Changes the velocity of a fluid; returns the gain of momentum times the mean velocity, its work. */
static double push_fluid(const ice_fluid *m, ptrdiff_t at, int dim, const double *change)
{
    double work = 0.0;
    for (int a = 0; a < dim && m->rho1[at] > 0.0; ++a) {
        work += m->rho1[at] * change[a] * (m->u1[a][at] + 0.5 * change[a]);
        m->u1[a][at] += change[a];
    }
    return work;
}

static void late_weight_cell(const ice *s, const ice_view *v, const int in[MESH_MAX_DIM], ptrdiff_t at)
{
    const moved_cell q = moved_of(v, at);
    if (!(q.before > 0.0 && q.after > 0.0)) return;
    const bool traced = v->traced && (!v->alone || v->alone[at] > 0.0);
    const double share = most((q.after - q.before) / q.after, -ICE_MOST_WEIGHT_CHANGE);
    double *tile = ice_tile(s, v->b, in[0], in[1], in[2]), x[MESH_MAX_DIM], change[3] = {0.0}, work = 0.0;
    ice_place_of(s, v->b, in, x);
    for (int a = 0; a < v->dim; ++a) {
        const double fall = v->dt * v->gravity[a];
        change[a] = 0.5 * share * (traced ? fall : common_part(fall, fall - q.gained[a] / q.before));
        ice_add_impulse(tile + TILE_SOURCE_MOMENTUM, x, a, q.after * change[a] * v->volume[in[0]]);
    }
    for (int r = 0; r < v->n_materials; ++r)
        if (!v->material[r].points) work += push_fluid(&v->m[r], at, v->dim, change);
    tile[TILE_SOURCE_ENERGY] += work * v->volume[in[0]];
}

/* Cells without points that no surface cuts. */
static void late_weight_row(const ice *s, const ice_view *v, int j, int k)
{
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, i, j, k);
        if (v->multi && ice_holds_points(v, at)) continue;
        if (v->m[0].open && v->m[0].open[at] < 1.0) continue;
        if (s->cut && s->cut->is_merged(s, v->region, v->b, i, j, k)) continue;
        late_weight_cell(s, v, (const int[]){i, j, k}, at);
    }
}

void ice_late_weight(const ice *s, const ice_view *v)
{
    if (s->gravity[0] == 0.0 && s->gravity[1] == 0.0 && s->gravity[2] == 0.0) return;
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    const int chunk = ice_rows_chunk(s, q);
#pragma omp parallel for schedule(static, chunk)
    for (int row = 0; row < q.n; ++row) late_weight_row(s, v, ice_row_j(q, row), ice_row_k(q, row));
}

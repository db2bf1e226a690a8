/* Advection out of cells at interfaces (ice_interface.c): each fluid leaves with its own state in the cell, in the volume that the sharp profile gives it.
 * Donors have no gradients there, and the state that leaves is that after the Lagrangian step, not halfway to it, so that the remainder has the same state
 * even if next to nothing remains. Mass, momentum, energy and volume through a face are those of a uniform cell times F_THETA/theta. */
#include "ice/flux/ice_advect.h"

/* The row's marked cells, and its (j, k). */
static ice_span marked_of(const ice_view *v, int slab, int k, int back)
{
    const int j = v->dim == 2 ? slab : v->dim == 3 ? k : 0, l = v->dim == 3 ? slab : 0;
    return v->sharp[ice_row_number(v->b, j - (back == 1), l - (back == 2))];
}

void ice_advect_flatten(const ice_advect_buffers *w, const ice_advect_job *job, int slab, int k)
{
    const ice_view *v = job->v;
    const int dim = v->dim, nq = ADVECT_COUNT(dim, true), ring = (slab + 2) & 1;
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab), row = ice_slab_row(v->b, dim, k);
    const ice_fluid *m = &v->m[job->material];
    const double *rho = m->rho + start, *q[ADVECT_Q] = {m->ul[0], m->ul[1], m->ul[2]};
    const ice_span marked = marked_of(v, slab, k, 0);
    q[dim] = m->el;
    q[dim + 1] = m->vl;
    for (ptrdiff_t t = row + marked.first; t < row + marked.end; ++t) {
        if (v->interface[start + t] == 0.0 || !(rho[t] > 0.0)) continue;
        /* No more than the slab's own volume, of which the fractions are a part. */
        const double mass = rho[t] * least(w->fill[t] / w->clip[t], 1.0);
        for (int a = 0; a < dim; ++a) {
            double *const *out = dim > 1 && a == dim - 1 ? w->across[ring] : w->along[a];
            out[0][t] = mass;
            out[1][t] = 0.0;
            for (int i = 0; i < nq; ++i) {
                out[2 + 2 * i][t] = mass * q[i][start + t];
                out[3 + 2 * i][t] = 0.0;
            }
        }
    }
}

void ice_advect_sharpen(const ice_advect_job *job, int axis, int slab, int k, double *const *flux)
{
    const ice_view *v = job->v;
    const ice_fluid *m = &v->m[job->material];
    const int dim = v->dim, nq = ADVECT_COUNT(dim, true), faces = v->b->n[0] + (axis == 0);
    const ptrdiff_t start = ice_slab_start(v->b, dim, slab), row = ice_slab_row(v->b, dim, k);
    const ice_span at = marked_of(v, slab, k, 0), below = marked_of(v, slab, k, axis);
    const int lo = at.first < below.first ? at.first : below.first,
              hi = (at.end > below.end ? at.end : below.end) + (axis == 0);
    if (at.end <= at.first && below.end <= below.first) return;
    for (ptrdiff_t t = row + (lo > 0 ? lo : 0); t < row + (hi < faces ? hi : faces); ++t) {
        const ptrdiff_t R = start + t, donor = m->fu[axis][R] > 0.0 ? R - v->b->stride[axis] : R;
        const double theta = m->theta[donor];
        if (v->interface[donor] == 0.0 || !(theta > 0.0)) continue;
        const double ratio = m->ft[axis][R] / theta;
        for (int f = 0; f < nq + 2; ++f) flux[f][t] *= ratio;
    }
}

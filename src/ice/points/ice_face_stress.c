/* Effect of stress on the face velocities of materials on points.
 *
 * The momentum of such a material has two parts, div[theta (sigma + p I)] and -theta grad p (theory 5.3). In a wall at
 * rest they balance. The face velocities of theory 2.2 contain the second alone: a wall in balance between two
 * pressures would pass fluid at phi dt |grad p|/rho, locked or not, and lose what it is to keep apart. The stress is
 * known only after the pressure is, so the faces take that of the last step (C_STRESS_ACCEL, with the reactions of
 * supports and of contact):
 *     u* += phi dt a_f,   a_f = (rho_L a_L + rho_R a_R)/(rho_L + rho_R). */
#include "ice/points/ice_points.h"

#include "ice/ice_constants.h"

double ice_stress_kick(const ice *s, const ice_view *v, int r, int axis, int component, ptrdiff_t R)
{
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t L = R - v->b->stride[axis];
    const double *rho = m->rho, *a = m->stress[component], now = 0.5 + 0.25 * (v->shock[L] + v->shock[R]);
    const double phi = s->implicit ? ice_implicit_phi(v, now) : now;
    return phi * v->dt * (rho[L] * a[L] + rho[R] * a[R]) / (rho[L] + rho[R] + ICE_TINY);
}

void ice_stress_face_velocity(const ice *s, const ice_view *v, int r, int axis)
{
    const ice_rows q = ice_rows_of(v->b, axis, 0);
    double *face = v->m[r].fu[axis];
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const int j = ice_row_j(q, row), k = ice_row_k(q, row);
        const ptrdiff_t base = mesh_index(v->b, 0, j, k);
        const ice_span near = ice_near(v, &v->m[r], j, k, axis == 0, 0, v->b->n[0] + (axis == 0));
        for (ptrdiff_t R = base + near.first; R < base + near.end; ++R)
            face[R] += ice_stress_kick(s, v, r, axis, axis, R);
    }
}

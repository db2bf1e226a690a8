/* Viscous momentum and heat (numerics 2.6): tau = theta mu [grad u + grad u^T] + theta (zeta - 2/3 mu) (div u) 1 on faces, with
 * the harmonic mean of theta mu, two-point normal derivatives and four-cell transverse ones; hoop terms about an axis. What the
 * stresses work less what they give in kinetic energy is heat: total energy closes. */
#include "ice/ice_internal.h"

#include <math.h>

/* Stress on the lower face of `axis` at cell R: its components along the axes. */
typedef struct face_stress {
    double t[3], velocity[3];
} face_stress;

static double harmonic(double a, double b)
{
    return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

/* Velocity gradient on a face: g[i][j] = du_i/dx_j. */
static void face_gradient(const ice_view *v, const ice_arrays *m, int axis, ptrdiff_t R, double g[3][3])
{
    const ptrdiff_t L = R - v->b->stride[axis];
    for (int i = 0; i < v->dim; ++i) {
        const double *u = m->u[i];
        for (int j = 0; j < v->dim; ++j) {
            const ptrdiff_t st = v->b->stride[j];
            g[i][j] = j == axis ? (u[R] - u[L]) * v->inv_h[j]
                                : 0.25 * v->inv_h[j] * (u[R + st] - u[R - st] + u[L + st] - u[L - st]);
        }
    }
}

/* u_r / r at a face between local cells; r from the metrics: zero in the plane. */
static double hoop_rate(const ice *s, const ice_view *v, const ice_arrays *m, int axis, ptrdiff_t R, int i)
{
    if (s->mesh->geometry != MESH_AXISYMMETRIC) return 0.0;
    const ptrdiff_t L = R - v->b->stride[axis];
    const double r = axis == 0 ? mesh_node(s->mesh, 0, v->b->lo[0] + i) : mesh_centre(s->mesh, 0, v->b->lo[0] + i);
    return r > 0.0 ? 0.5 * (m->u[0][L] + m->u[0][R]) / r : (m->u[0][R] - m->u[0][L]) * v->inv_h[0];
}

static face_stress stress_on(const ice *s, const ice_view *v, int r, int axis, ptrdiff_t R, int i)
{
    const ice_arrays *m = &v->m[r];
    const ice_material *material = &s->material[r];
    const ptrdiff_t L = R - v->b->stride[axis];
    const double share = s->multi ? harmonic(m->theta[L], m->theta[R]) : 1.0;
    const double mu = share * material->shear_viscosity, zeta = share * material->bulk_viscosity;
    double g[3][3];
    face_gradient(v, m, axis, R, g);
    double div = hoop_rate(s, v, m, axis, R, i);
    for (int a = 0; a < v->dim; ++a) div += g[a][a];
    face_stress out = {{0.0}, {0.0}};
    for (int a = 0; a < v->dim; ++a) {
        out.t[a] = mu * (g[a][axis] + g[axis][a]);
        out.velocity[a] = 0.5 * (m->u[a][L] + m->u[a][R]);
    }
    out.t[axis] += (zeta - 2.0 / 3.0 * mu) * div;
    return out;
}

/* sigma_theta,theta of the cell, which pulls it towards the axis: -tau_tt / r. */
static double hoop_force(const ice *s, const ice_view *v, int r, ptrdiff_t at, int i)
{
    if (s->mesh->geometry != MESH_AXISYMMETRIC) return 0.0;
    const ice_arrays *m = &v->m[r];
    const double radius = mesh_centre(s->mesh, 0, v->b->lo[0] + i), rate = m->u[0][at] / radius;
    const double share = s->multi ? m->theta[at] : 1.0;
    const double mu = share * s->material[r].shear_viscosity, zeta = share * s->material[r].bulk_viscosity;
    double div = rate;
    for (int a = 0; a < v->dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        div += 0.5 * (m->u[a][at + st] - m->u[a][at - st]) * v->inv_h[a];
    }
    return -(2.0 * mu * rate + (zeta - 2.0 / 3.0 * mu) * div) / radius;
}

static void add_cell(const ice *s, const ice_view *v, int r, ptrdiff_t at, int i)
{
    const ice_arrays *m = &v->m[r];
    const double rho = m->rho[at];
    if (!(rho > 0.0)) return;
    double force[3] = {hoop_force(s, v, r, at, i), 0.0, 0.0}, work = 0.0;
    for (int axis = 0; axis < v->dim; ++axis) {
        const ptrdiff_t up = at + v->b->stride[axis];
        const face_stress lower = stress_on(s, v, r, axis, at, i),
                          upper = stress_on(s, v, r, axis, up, axis == 0 ? i + 1 : i);
        const double below = axis == 0 ? v->lower0[i] : v->inv_h[axis],
                     above = axis == 0 ? v->upper0[i] : v->inv_h[axis];
        for (int a = 0; a < v->dim; ++a) {
            force[a] += above * upper.t[a] - below * lower.t[a];
            work += above * upper.t[a] * upper.velocity[a] - below * lower.t[a] * lower.velocity[a];
        }
    }
    double gain = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const double du = v->dt * force[a] / rho, old = m->ul[a][at];
        m->ul[a][at] = old + du;
        gain += du * (old + 0.5 * du);
    }
    m->el[at] += v->dt * work / rho - gain;
}

/* Viscous traction of a side on the fluid: momentum and work through the domain's faces, into the tiles. */
static void note_side(const ice *s, const ice_view *v, int r, int axis, int side, int i, int j, int k)
{
    const block *b = v->b;
    const ptrdiff_t cell = mesh_index(b, i, j, k), face = side == SIDE_LOWER ? cell : cell + b->stride[axis];
    const int face_i = axis == 0 && side == SIDE_UPPER ? i + 1 : i;
    const face_stress f = stress_on(s, v, r, axis, face, face_i);
    const double area = axis == 0 ? v->area0[face_i] : v->volume[i] * v->inv_h[axis];
    const double scale = (side == SIDE_LOWER ? -1.0 : 1.0) * area * v->dt;
    double *tile = ice_tile(s, b, i, j, k);
    for (int a = 0; a < v->dim; ++a) {
        if (!(a == 0 && s->mesh->geometry == MESH_AXISYMMETRIC)) tile[TILE_MOMENTUM + a] += scale * f.t[a];
        tile[TILE_ENERGY] += scale * f.t[a] * f.velocity[a];
    }
}

static void note_sides(const ice *s, const ice_view *v, int r)
{
    const block *b = v->b;
    for (int axis = 0; axis < b->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (!b->at_side[axis][side] || s->mesh->periodic[axis]) continue;
            int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {b->n[0], b->n[1], b->n[2]};
            lo[axis] = side == SIDE_LOWER ? 0 : b->n[axis] - 1;
            hi[axis] = lo[axis] + 1;
            for (int k = lo[2]; k < hi[2]; ++k)
                for (int j = lo[1]; j < hi[1]; ++j)
                    for (int i = lo[0]; i < hi[0]; ++i) note_side(s, v, r, axis, side, i, j, k);
        }
}

void ice_viscous(ice *s, const ice_view *v)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    for (int r = 0; r < s->n_materials; ++r) {
        const ice_material *m = &s->material[r];
        if (m->points || !(m->shear_viscosity > 0.0 || m->bulk_viscosity > 0.0)) continue;
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v->b->n[0]; ++i)
                add_cell(s, v, r, mesh_index(v->b, i, ice_row_j(q, row), ice_row_k(q, row)), i);
        note_sides(s, v, r);
    }
}

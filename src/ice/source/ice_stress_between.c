/* Shear and heat between unlike fluids across a face (theory 2.6). Like fluids meet over the harmonic mean of their volume fractions on the face. The rest of
 * the face is an interface, over which each fluid of one cell meets the other fluids of the next cell in proportion to the product of both fractions, with
 * the harmonic mean of their viscosities and conductivities, since each fills half of the distance between the centres. This applies only to fluids that are
 * locked to each other, with the mean velocity of the cells; fluids that slip, or exchange momentum by a law, have that law alone. */
#include "ice/source/ice_lagrangian.h"
#include "ice/source/ice_stress.h"

#include "coupling/exchange_law.h"
#include "ice/state/ice_cells.h"

static double harmonic(double a, double b)
{
    return a > 0.0 && b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

/* Whether stress or heat passes between two different fluids of a view. */
static bool is_tied(const ice *s, const ice_view *v, int r, int q)
{
    const ice_material *a = &v->material[r], *b = &v->material[q];
    const int x = v->first + r, y = v->first + q;
    if (r == q || a->points || b->points) return false;
    return s->exchange.K[x][y] == EXCHANGE_LOCKED && s->exchange.Kt[x][y] == EXCHANGE_LOCKED &&
           (a->shear_viscosity * b->shear_viscosity > 0.0 || a->bulk_viscosity * b->bulk_viscosity > 0.0 ||
            a->conductivity * b->conductivity > 0.0);
}

static bool ties_some(const ice *s, const ice_view *v, int r)
{
    for (int q = 0; q < v->n_materials; ++q)
        if (is_tied(s, v, r, q)) return true;
    return false;
}

/* Share of a face over which unlike fluids meet, per product of their fractions; 0 where none do. */
static double unlike_share(const ice_view *v, ptrdiff_t L, ptrdiff_t R)
{
    double unlike = 1.0, products = 0.0;
    for (int r = 0; r < v->n_materials; ++r) {
        const double a = v->m[r].theta[L];
        unlike -= harmonic(a, v->m[r].theta[R]);
        for (int q = 0; q < v->n_materials; ++q)
            if (q != r) products += a * v->m[q].theta[R];
    }
    return unlike > 0.0 && products > 0.0 ? unlike / products : 0.0;
}

static bool is_on_side(const ice *s, const ice_view *v, int axis, ptrdiff_t R)
{
    int cell[MESH_MAX_DIM];
    ice_cell_of(v->b, R, cell);
    const int face = v->b->lo[axis] + cell[axis];
    return !s->mesh->periodic[axis] && (face == 0 || face == s->mesh->n[axis]);
}

ice_face_diffusion ice_stress_between(const ice *s, const ice_view *v, int r, int axis, ptrdiff_t R, ptrdiff_t i,
                                      mesh_side side)
{
    const ptrdiff_t L = R - v->b->stride[axis], own = side == SIDE_LOWER ? R : L, other = side == SIDE_LOWER ? L : R;
    const double share = v->n_materials > 1 ? unlike_share(v, L, R) * v->m[r].theta[own] : 0.0;
    const double out = side == SIDE_LOWER ? -1.0 : 1.0;
    double mu = 0.0, zeta = 0.0, heat = 0.0;
    if (!(share > 0.0) || is_on_side(s, v, axis, R)) return (ice_face_diffusion){.power = 0.0};
    const ice_material *m = &v->material[r];
    for (int q = 0; q < v->n_materials; ++q) {
        const double part = share * v->m[q].theta[other];
        const ice_material *to = &v->material[q];
        if (!(part > 0.0) || !is_tied(s, v, r, q)) continue;
        const double k = harmonic(m->conductivity, to->conductivity);
        mu += part * harmonic(m->shear_viscosity, to->shear_viscosity);
        zeta += part * harmonic(m->bulk_viscosity, to->bulk_viscosity);
        if (k > 0.0) heat += part * k * out * (v->m[q].diffT[other] - v->m[r].diffT[own]) * v->inv_h[axis];
    }
    diffusing d = {.T = v->mean[0], .mu = mu, .dilatation = zeta - 2.0 / 3.0 * mu, .radius = v->radius0};
    for (int a = 0; a < v->dim; ++a) {
        d.u[a] = v->mean[a];
        d.stride[a] = v->b->stride[a];
        d.inv_h[a] = v->inv_h[a];
    }
    ice_face_diffusion f = diffusion_on(&d, axis, R, i, v->dim, v->radial);
    f.power += heat;
    return f;
}

/* Of all faces of a cell. */
static cell_diffusion between_into(const ice *s, const ice_view *v, int r, ptrdiff_t at, ptrdiff_t i)
{
    cell_diffusion c = {{0.0, 0.0, 0.0}, 0.0};
    for (int axis = 0; axis < v->dim; ++axis) {
        const ice_face_diffusion lower = ice_stress_between(s, v, r, axis, at, i, SIDE_LOWER),
                                 upper = ice_stress_between(s, v, r, axis, at + v->b->stride[axis],
                                                            axis == 0 ? i + 1 : i, SIDE_UPPER);
        const double below = axis == 0 ? v->lower0[i] : v->inv_h[axis],
                     above = axis == 0 ? v->upper0[i] : v->inv_h[axis];
        for (int a = 0; a < v->dim; ++a) c.force[a] += above * upper.t[a] - below * lower.t[a];
        c.power += above * upper.power - below * lower.power;
    }
    return c;
}

static void apply_between(const ice *s, const ice_view *v, int r)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    if (!ties_some(s, v, r)) return;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (int i = 0; i < v->b->n[0]; ++i) {
            if (!(v->m[r].rho[base + i] > 0.0)) continue;
            const cell_diffusion c = between_into(s, v, r, base + i, i);
            take_diffusion(&v->m[r], base + i, v->dt / v->m[r].rho[base + i], v->dim, &c);
        }
    }
}

void ice_diffuse_between(const ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; g->n > 1 && ice_next_view(s, g, &id, &v);)
        for (int r = 0; r < g->n; ++r) apply_between(s, &v, r);
}

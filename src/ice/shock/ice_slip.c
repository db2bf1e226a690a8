/* The bulk viscosity of theory 2.8 (iv) in cells of a solid along which fluids slip.
 *
 * Where solid and fluid have one velocity, the inertia is the mass of the whole cell; where the fluid slips, it is that of the fluid, whose motion along the
 * wall meets no other resistance. With the whole mass, and a solid some thousand times as heavy, an explicit step would reverse and amplify that velocity
 * from round-off on. So q is limited to that of the fluids alone. Normal to the wall both have one velocity, but so heavy a wall hardly moves, and a wave
 * that meets it has its own q in the cells before. */
#include "ice/shock/ice_shock.h"

#include <math.h>

/* Jump of velocity over a cell that is squeezed, m/s. */
static double squeeze_of(const ice_view *v, ptrdiff_t at, int i)
{
    double div = v->upper0[i] * v->flux[0][at + 1] - v->lower0[i] * v->flux[0][at], jump = v->share[0] * div;
    for (int a = 1; a < v->dim; ++a) {
        const double rate = (v->flux[a][at + v->b->stride[a]] - v->flux[a][at]) * v->inv_h[a];
        div += rate;
        jump += v->share[a] * rate;
    }
    return v->length * ice_compression(div, jump);
}

/* As the increment takes it of a density and a compressibility: explicit in ice_increment.c, else in ice_implicit_rows.c. */
static double bulk_pressure(const ice *s, double density, double kappa, double squeeze, double shock)
{
    if (s->implicit) return density * squeeze * squeeze;
    return ice_bulk_pressure(density, sqrt(1.0 / (density * kappa)), squeeze, shock);
}

static void relieve_cell(const ice *s, const ice_view *v, ptrdiff_t at, int i)
{
    double theta = 0.0, mass = 0.0, kappa = 0.0;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        if (v->material[r].points || !(m->rho[at] > 0.0)) continue;
        theta += m->theta[at];
        mass += m->rho[at];
        kappa += m->theta[at] * m->kappa[at];
    }
    const double squeeze = squeeze_of(v, at, i);
    if (!(squeeze > 0.0 && theta > 0.0 && kappa > 0.0)) return;
    const double whole = bulk_pressure(s, v->rho_sum[at], v->kappa_sum[at], squeeze, v->shock[at]),
                 own = bulk_pressure(s, mass / theta, kappa / theta, squeeze, v->shock[at]);
    v->P[at] += least(own - whole, 0.0);
}

void ice_relieve_slip(const ice *s, const ice_view *v)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (int i = 0; i < v->b->n[0]; ++i)
            if (ice_holds_points(v, base + i)) relieve_cell(s, v, base + i, i);
    }
}

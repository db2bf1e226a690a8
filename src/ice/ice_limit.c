/* The time step (theory 2.14): dt <= C / max over cells and materials of [sum |u_i|/h_i + b c (sum h_i^-2)^1/2], b = sqrt 2 where phi = 1, else 1; with the
 * implicit pressure C / max sum |u_i|/h_i, and sound may cross acoustic_cfl cells; diffusion dt <= 0.9 / (2 D sum h_i^-2) (beside embedded boundaries half of that for viscosity, and
 * a fifth for heat that passes them), D the larger of (4/3 mu + zeta)/rho and k/(rho c_v); gravity dt <= (h/|g|)^1/2, with the
 * implicit pressure where fluids meet a quarter of that. Traces (theta < 1e-6) are left out.
 *
 * A fluid that is coupled to the others of its cell faster than sound crosses the cell transmits sound at Wood's speed of the mixture, not at its own: a hot
 * trace of gas beside a solid does not limit the step. The limit depends on the state of the fluids alone (the volume that they leave in a cell is the
 * solids'), so that a resumed run takes the same steps. */
#include "base/threads.h"
#include "ice/ice_constants.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_state.h"
#include "ice/state/ice_walk.h"

#include <math.h>

/* Largest 1/dt of flow, of sound, of both as they bound the explicit step, and of diffusion. */
typedef struct rates {
    double flow, sound, signal, diffusion;
} rates;

static void raise_to(rates *to, rates x)
{
    to->flow = most(to->flow, x.flow);
    to->sound = most(to->sound, x.sound);
    to->signal = most(to->signal, x.signal);
    to->diffusion = most(to->diffusion, x.diffusion);
}

/* What is the same in all cells of a material: b, (sum h_i^-2)^1/2, 4/3 mu + zeta, beside embedded boundaries as if by that much larger, and k. */
typedef struct rate_factors {
    double centring, root, viscosity, conductivity;
} rate_factors;

static rate_factors factors_of(const ice *s, const ice_view *v, int r)
{
    const ice_material *m = &s->material[r];
    const bool full = s->scene->method.centring == ICE_CENTRING_FULL || s->with_points || s->cut;
    double inverse_square = 0.0;
    for (int a = 0; a < v->dim; ++a) inverse_square += v->inv_h[a] * v->inv_h[a];
    return (rate_factors){full ? sqrt(2.0) : 1.0, sqrt(inverse_square),
                          (4.0 / 3.0 * m->shear_viscosity + m->bulk_viscosity) / (s->cut ? ICE_WALL_DIFFUSION : 1.0),
                          m->conductivity / (s->heats_walls ? ICE_WALL_CONDUCTION : 1.0)};
}

static rates cell_rates(const ice_view *v, int r, const rate_factors *f, ptrdiff_t at, double rho, double c, double cv)
{
    double speed = 0.0, inverse_square = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        speed += fabs(v->m[r].u[a][at]) * v->inv_h[a];
        inverse_square += v->inv_h[a] * v->inv_h[a];
    }
    rates x = {speed, c * f->root, speed + f->centring * c * f->root, 0.0};
    if (f->viscosity > 0.0 || f->conductivity > 0.0) {
        const double diffusion = f->conductivity > 0.0 ? most(f->viscosity, f->conductivity / cv) : f->viscosity;
        x.diffusion = 2.0 / ICE_DIFFUSION_SHARE * diffusion / rho * inverse_square;
    }
    return x;
}

/* All materials of a cell together. */
typedef struct mixture {
    double density, compressibility, tie;
} mixture;

static void add_material_share(mixture *m, double theta, double rho, double kappa)
{
    m->density += theta * rho;
    m->compressibility += theta * kappa;
}

/* Materials that slip, or whose law sees the state (its constant is 0), are not tied in every direction and state. */
static double tie_of(const ice *s, int r, int q)
{
    return fmin(s->exchange.K[r][q], s->exchange.Kt[r][q]);
}

/* Seen from fluid r, of pure density rho and sound speed c. */
static mixture mixture_about(const ice *s, const ice_view *v, int r, ptrdiff_t at, double rho, double c)
{
    double free = 1.0;
    mixture m = {0.0, 0.0, 0.0};
    for (int q = 0; q < s->n_materials; ++q) {
        const ice_fluid *a = &v->m[q];
        if (s->material[q].points || !(a->rho[at] > 0.0)) continue;
        const double theta = a->rho[at] * a->vol[at], density = 1.0 / a->vol[at];
        double p, c2 = c * c;
        if (q != r) s->material[q].eos.model->pressure(s->material[q].eos.par, 1, &density, &a->e[at], &p, &c2);
        free -= theta;
        add_material_share(&m, theta, density, 1.0 / (density * c2));
        if (q != r) m.tie += tie_of(s, r, q) * theta / rho;
    }
    for (int q = 0; q < s->n_materials && free > 0.0; ++q) {
        if (!s->material[q].points) continue;
        add_material_share(&m, free, s->bulk[q].density, 1.0 / s->bulk[q].bulk_modulus);
        m.tie += tie_of(s, r, q) * free / rho;
        break;
    }
    return m;
}

static double signal_speed(const ice *s, const ice_view *v, int r, ptrdiff_t at, double rho, double c)
{
    if (!v->multi || v->m[r].rho[at] * v->m[r].vol[at] > 1.0 - 1e-12) return c;
    const mixture m = mixture_about(s, v, r, at, rho, c);
    const double crossing = c / v->finest;
    return m.tie > ICE_TIED * crossing ? fmin(c, 1.0 / sqrt(m.density * m.compressibility)) : c;
}

/* One row of one material: density of the pure material and sound speed from its current state. */
static bool row_rates(const ice *s, const ice_view *v, int r, int j, int k, double *work, rates *largest)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &s->material[r].eos;
    const rate_factors factors = factors_of(s, v, r);
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0];
    double *rho = work, *e = work + n, *p = work + 2 * n, *c2 = work + 3 * n, *cv = work + 4 * n, *alpha = work + 5 * n;
    for (ptrdiff_t i = 0; i < n; ++i) {
        const bool here =
            v->multi ? m->rho[base + i] * m->vol[base + i] > ICE_TRACE_FRACTION : !m->open || m->open[base + i] > 0.0;
        rho[i] = v->multi ? 1.0 / m->vol[base + i] : m->rho[base + i];
        e[i] = m->e[base + i];
        if (!here) rho[i] = NAN;
    }
    law->model->pressure(law->par, (size_t)n, rho, e, p, c2);
    if (factors.conductivity > 0.0) law->model->heat(law->par, (size_t)n, rho, e, cv, alpha);
    for (ptrdiff_t i = 0; i < n; ++i) {
        if (isnan(rho[i])) continue;
        if (!(c2[i] > 0.0)) return false;
        const double c = signal_speed(s, v, r, base + i, rho[i], sqrt(c2[i]));
        const rates x = cell_rates(v, r, &factors, base + i, rho[i], c, factors.conductivity > 0.0 ? cv[i] : 0.0);
        if (!isfinite(x.signal)) return false;
        raise_to(largest, x);
    }
    return true;
}

static bool block_rates(const ice *s, const ice_view *v, int r, rates *largest)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    double flow = 0.0, sound = 0.0, signal = 0.0, diffusion = 0.0;
    int bad = 0;
#pragma omp parallel for schedule(static) reduction(max : flow, sound, signal, diffusion) reduction(+ : bad)
    for (int row = 0; row < q.n; ++row) {
        rates x = {0.0, 0.0, 0.0, 0.0};
        bad += !row_rates(s, v, r, ice_row_j(q, row), ice_row_k(q, row), ice_buffer(s, thread_number()), &x);
        flow = most(flow, x.flow);
        sound = most(sound, x.sound);
        signal = most(signal, x.signal);
        diffusion = most(diffusion, x.diffusion);
    }
    raise_to(largest, (rates){flow, sound, signal, diffusion});
    return bad == 0;
}

/* Of either kind of step from the same rates. */
static step_limit limit_of(const ice *s, const rates *largest, double gravity, bool implicit)
{
    const double cfl = s->scene->time.cfl_ice;
    step_limit out = {cfl / largest->signal, "sound and flow on the cells"};
    if (implicit) {
        out = (step_limit){s->scene->time.acoustic_cfl / largest->sound, "the acoustic CFL"};
        if (cfl < largest->flow * out.dt) out = (step_limit){cfl / largest->flow, "flow on the cells"};
    }
    if (!(largest->diffusion * out.dt <= 1.0) && largest->diffusion > 0.0)
        out = (step_limit){1.0 / largest->diffusion, "viscosity or conduction on the cells"};
    const double share = implicit && ice_is_mixture(s) && !s->with_points ? ICE_RIPPLE_STEP : 1.0;
    if (gravity > 0.0 && share * sqrt(1.0 / gravity) < out.dt)
        out = (step_limit){share * sqrt(1.0 / gravity), "gravity on the cells"};
    return out;
}

/* The first cell of a block without a state, as a message. */
static floe_status explain_rates(const ice *s, const ice_view *v, int r)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &s->material[r].eos;
    char place[160] = "a cell";
    double density = 0.0, energy = 0.0, p, c2;
    for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
        const bool here = v->multi ? m->rho[c.at] * m->vol[c.at] > ICE_TRACE_FRACTION : !m->open || m->open[c.at] > 0.0;
        if (!here) continue;
        density = v->multi ? 1.0 / m->vol[c.at] : m->rho[c.at];
        energy = m->e[c.at];
        law->model->pressure(law->par, 1, &density, &energy, &p, &c2);
        if (c2 > 0.0 && isfinite(c2)) continue;
        ice_place(s, v->b, c.at, r, place, sizeof place);
        break;
    }
    return fail(s->ctx, FLOE_DIVERGED, "time step, %s: no sound speed at t = %.6g s (density %g kg/m3, energy %g J/kg)",
                place, s->time, density, energy);
}

floe_status ice_time_steps(ice *s, step_limit *direct, step_limit *implicit, double *acoustic)
{
    rates largest = {0.0, 0.0, 0.0, 0.0};
    double gravity = 0.0;
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        for (int a = 0; a < v.dim; ++a) gravity = fmax(gravity, fabs(s->gravity[a]) / v.h[a]);
        for (int r = 0; r < s->n_materials; ++r)
            if (!s->material[r].points && !block_rates(s, &v, r, &largest)) return explain_rates(s, &v, r);
    }
    *direct = limit_of(s, &largest, gravity, false);
    *implicit = limit_of(s, &largest, gravity, true);
    *acoustic = largest.sound;
    return FLOE_OK;
}

floe_status ice_time_step(ice *s, step_limit *out)
{
    step_limit direct, implicit;
    double acoustic;
    TRY(ice_time_steps(s, &direct, &implicit, &acoustic));
    *out = s->implicit ? implicit : direct;
    return FLOE_OK;
}

static void add_densities(const ice_view *v, int r, double range[2])
{
    const ice_fluid *m = &v->m[r];
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    double lowest = range[0], highest = range[1];
#pragma omp parallel for schedule(static) reduction(min : lowest) reduction(max : highest)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (ptrdiff_t i = base; i < base + v->b->n[0]; ++i) {
            if (!(m->rho[i] > 0.0) || (m->open && !(m->open[i] > 0.0))) continue;
            const double rho = v->multi ? 1.0 / m->vol[i] : m->rho[i];
            lowest = least(lowest, rho);
            highest = most(highest, rho);
        }
    }
    range[0] = lowest;
    range[1] = highest;
}

void ice_densities(ice *s, double range[2])
{
    range[0] = INFINITY;
    range[1] = 0.0;
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        for (int r = 0; r < s->n_materials; ++r)
            if (!s->material[r].points) add_densities(&v, r, range);
    }
}

/* Density of a fluid in a cell of which it fills more than a share; else 0. */
static double density_of_more(bool multi, const ice_fluid *m, ptrdiff_t at, double share)
{
    const double fills = multi ? m->rho[at] * m->vol[at] : m->open ? m->open[at] : 1.0;
    if (!(m->rho[at] > 0.0) || !(fills > share)) return 0.0;
    return multi ? 1.0 / m->vol[at] : m->rho[at];
}

static double densest_in(const ice *s, int id, const unsigned char *among, double share)
{
    ice_view v;
    double found = 0.0;
    ice_view_make(s, NULL, id, &v);
    const ice_rows q = ice_rows_of(v.b, -1, 0);
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v.b, q, row);
        for (ptrdiff_t i = base; i < base + v.b->n[0]; ++i)
            for (int r = 0; among[i] && r < s->n_materials; ++r)
                if (!s->material[r].points) found = most(found, density_of_more(v.multi, &v.m[r], i, share));
    }
    return found;
}

double ice_densest(const ice *s, const unsigned char *const *among, double share)
{
    double found = 0.0;
    for (int id = 0; id < s->mesh->n_blocks; ++id) found = most(found, densest_in(s, id, among[id], share));
    return found;
}

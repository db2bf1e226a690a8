/* Open sides by characteristics (theory 2.13). On a face, with u along the outward normal and z = rho c of the
 * mixture,
 *     R = p + z u leaves, carried from the cell to the face at half the step,     Q = p - z u enters,
 * and the side says what enters: at a non-reflecting side (locally one-dimensional, Hedstrom 1979) the Q of the state
 * far outside; at a reservoir, flow and pressure lie on the isentrope from its state at rest, u^2/2 = integral of
 * dp/rho.
 *
 * (Measured on a pulse of sound: Q of the cell instead, drawn to the outside as in Poinsot & Lele 1992, sends back 1 to
 * 3 per cent, and falls with less than the first power of the cell's size, since Q then feeds on its own errors.) */
#include "ice/sides/ice_open_side.h"
#include "ice/state/ice_materials.h"

#include "base/memory.h"

#include <math.h>

/* ---- reservoirs ---- */

/* Sides behind which a state of a fluid lies. */
static bool has_reservoir(bc_kind kind)
{
    return kind == BC_INLET || kind == BC_OUTLET || kind == BC_NON_REFLECTING || kind == BC_RESERVOIR;
}

/* States that enter at inlets, in reservoirs, and behind outlets that name one. */
floe_status ice_reservoirs_create(ice *s)
{
    TRY(memory_new(s->ctx, &s->reservoirs, 1, sizeof *s->reservoirs));
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2; ++side) {
            const bc_side *wall = &s->scene->bc.side[a][side];
            if (!has_reservoir(wall->kind)) continue;
            const int r = ice_material_of(s, wall->material);
            if (r < 0 || s->material[r].points || !(wall->temperature > 0.0)) continue;
            s->reservoirs->state[a][side] = ice_state_at(&s->material[r].eos, wall->pressure, wall->temperature);
        }
    return FLOE_OK;
}

void ice_reservoirs_destroy(context *ctx, ice_reservoirs **w)
{
    memory_free(ctx, w);
}

/* Decrease of pressure, density and energy with the speed along an isentrope. */
typedef struct gas_state {
    double p, rho, e;
} gas_state;

static gas_state expansion_rate(const eos *law, const gas_state *at, double u)
{
    double p, c2;
    law->model->pressure(law->par, 1, &at->rho, &at->e, &p, &c2);
    const double drho = -at->rho * u / c2;
    return (gas_state){-at->rho * u, drho, p / (at->rho * at->rho) * drho};
}

static gas_state moved_state(gas_state from, gas_state by, double step)
{
    return (gas_state){from.p + step * by.p, from.rho + step * by.rho, from.e + step * by.e};
}

/* Speed u, up to that of sound, along the isentrope from a state at rest at p0. */
static ice_reservoir expand_isentropically(const eos *law, double p0, const ice_reservoir *rest, double u)
{
    enum { STEPS = 8 };
    const double step = u / STEPS;
    gas_state y = {p0, rest->rho, rest->e};
    for (int n = 0; n < STEPS; ++n) { /* Runge and Kutta's of order 4, with the speed as the clock */
        const double at = n * step;
        const gas_state a = expansion_rate(law, &y, at), ya = moved_state(y, a, 0.5 * step);
        const gas_state b = expansion_rate(law, &ya, at + 0.5 * step), yb = moved_state(y, b, 0.5 * step);
        const gas_state c = expansion_rate(law, &yb, at + 0.5 * step), yc = moved_state(y, c, step);
        const gas_state d = expansion_rate(law, &yc, at + step);
        y = moved_state(moved_state(moved_state(moved_state(y, a, step / 6.0), b, step / 3.0), c, step / 3.0), d,
                        step / 6.0);
    }
    ice_reservoir out = {.rho = y.rho, .e = y.e, .v = 1.0 / y.rho};
    law->model->temperature(law->par, 1, &out.rho, &out.e, &out.T);
    return out;
}

/* The speed beyond which a reservoir's gas is not led: the one of sound at rest. */
static double sound_speed_at_rest(const ice *s, int axis, mesh_side side, int r)
{
    const ice_reservoir *rest = &s->reservoirs->state[axis][side];
    const eos *law = &s->material[r].eos;
    double p, c2;
    law->model->pressure(law->par, 1, &rest->rho, &rest->e, &p, &c2);
    return sqrt(c2);
}

/* Inflow w >= 0 with p(w) - z w = R on the isentrope; negative where the fluid leaves against the reservoir's
 * pressure. */
static ice_side_state from_reservoir(const ice *s, int axis, mesh_side side, double R, double z)
{
    const bc_side *wall = &s->scene->bc.side[axis][side];
    const ice_reservoir *rest = &s->reservoirs->state[axis][side];
    const int r = ice_material_of(s, wall->material);
    double w = (wall->pressure - R) / z, p = wall->pressure;
    if (!(w > 0.0)) return (ice_side_state){wall->pressure, -w};
    const double most_speed = sound_speed_at_rest(s, axis, side, r);
    w = fmin(w, most_speed);
    for (int k = 0; k < 8; ++k) {
        const ice_reservoir now = expand_isentropically(&s->material[r].eos, wall->pressure, rest, w);
        double c2;
        s->material[r].eos.model->pressure(s->material[r].eos.par, 1, &now.rho, &now.e, &p, &c2);
        const double step = (p - z * w - R) / (now.rho * w + z);
        w = fmin(fmax(w + step, 0.0), most_speed);
        if (fabs(step) <= 1e-13 * most_speed) break;
    }
    return (ice_side_state){p, -w};
}

/* Beyond a side with a reservoir, the state that flows in at the speed of the cell beside it; where that leaves,
 * nothing is changed. */
void ice_reservoir_ghosts(const ice *s, const block *b, const fields *f, int axis, mesh_side side, int r,
                          ice_ghost kind, int component, double *a)
{
    const bc_side *wall = &s->scene->bc.side[axis][side];
    if (s->material[r].scene_material != wall->material) return;
    const ice_reservoir *rest = &s->reservoirs->state[axis][side];
    const double *u = field_get(f, C_VEL, r, axis), inward = side == SIDE_LOWER ? 1.0 : -1.0,
                 most_speed = sound_speed_at_rest(s, axis, side, r);
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    bc_layers(b, axis, side, 0, 0, lo, hi);
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k),
                                out = side == SIDE_LOWER ? -b->stride[axis] : b->stride[axis];
                const double speed = fmin(inward * u[at], most_speed);
                if (!(speed > 0.0)) continue;
                double value = component == axis ? inward * speed : 0.0;
                if (kind != GHOST_VELOCITY) {
                    const ice_reservoir now = expand_isentropically(&s->material[r].eos, wall->pressure, rest, speed);
                    value = kind == GHOST_DENSITY  ? now.rho
                            : kind == GHOST_ENERGY ? now.e
                            : kind == GHOST_VOLUME ? now.v
                                                   : now.T;
                }
                for (int n = 1; n <= MESH_GHOST; ++n) a[at + n * out] = value;
            }
}

/* ---- faces ---- */

/* Mean of z between a cell and the pressure outside, along the isentrope: what a wave of finite strength meets. */
static double mean_impedance(const ice_view *v, ptrdiff_t c, double z, double outside)
{
    const ice_fluid *m = &v->m[0];
    const eos *law = &v->material[0].eos;
    if (v->multi) return z;
    const double more = (outside - v->p[c]) / (m->c[c] * m->c[c]), rho = m->rho[c] + more;
    const double e = m->e[c] + v->p[c] / (m->rho[c] * m->rho[c]) * more;
    double p, c2;
    law->model->pressure(law->par, 1, &rho, &e, &p, &c2);
    return rho > 0.0 && c2 > 0.0 ? 0.5 * (z + rho * sqrt(c2)) : z;
}

ice_side_state ice_characteristic(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at)
{
    const bc_side *wall = &s->scene->bc.side[axis][side];
    const ptrdiff_t c = at.cell, in = c - (side == SIDE_LOWER ? -1 : 1) * v->b->stride[axis];
    const double rho = v->rho_sum[c], sound = v->multi ? 1.0 / sqrt(rho * v->kappa_sum[c]) : v->m[0].c[c],
                 z = rho * sound;
    const double u = at.outward * v->mean[axis][c], h = v->h[axis];
    const double weight = rho * at.outward * v->gravity[axis] * h; /* hydrostatic difference of a cell */
    const double smooth = v->limit_hi * (1.0 - v->shock[c]), courant = fmin(fmax((u + sound) * v->dt / h, 0.0), 1.0);
    const double rise = v->p[c] - v->p[in] - weight + z * (u - at.outward * v->mean[axis][in]);
    const double R = v->p[c] + z * u + 0.5 * weight + 0.5 * smooth * (1.0 - courant) * rise;
    if (wall->kind == BC_RESERVOIR) return from_reservoir(s, axis, side, R, z);
    if (!(u < sound)) return (ice_side_state){v->p[c] + 0.5 * weight, u};
    const double zq = mean_impedance(v, c, z, wall->pressure), far = at.outward * wall->velocity[axis],
                 velocity = (R - wall->pressure + zq * far) / (z + zq);
    return (ice_side_state){R - z * velocity, velocity};
}

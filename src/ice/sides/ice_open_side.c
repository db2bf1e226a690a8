/* Open sides by characteristics (theory 2.13). On a face, with u along the outward normal and z = rho c of the
 * mixture,
 *     R = p + z u leaves, carried from the cell to the face at half the step,     Q = p - z u enters,
 * and the side says what enters: at a non-reflecting side (locally one-dimensional, Hedstrom 1979) the Q of the state
 * far outside; at a reservoir, flow and pressure lie on the isentrope from its state at rest, u^2/2 = integral of
 * dp/rho. So does what comes back through an outlet: at the outlet's own pressure it would bring its motion as
 * a gift, more of it the faster it came.
 *
 * (Measured on a pulse of sound: Q of the cell instead, drawn to the outside as in Poinsot & Lele 1992, sends back 1 to
 * 3 per cent, and falls with less than the first power of the cell's size, since Q then feeds on its own errors.) */
#include "ice/sides/ice_open_side.h"
#include "ice/state/ice_materials.h"

#include <math.h>

/* Share of the outside's speed of sound at which fluid enters an outlet as from a reservoir: steady inflow is the same by both. */
static const double rush = 0.2;

/* Share of its sound at which fluid may move at an outlet's pressure outside, if nothing is known of it: slow flow through ducts is driven
 * by the pressures on their ends. */
static const double stroll = 0.1;

/* ---- reservoirs ---- */

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

/* Speed of sound of the fluid behind a face. */
static double sound_speed_behind(const eos *law, const ice_reservoir *rest)
{
    double p, c2;
    law->model->pressure(law->par, 1, &rest->rho, &rest->e, &p, &c2);
    return sqrt(c2);
}

/* Speed u, up to that of sound, along the isentrope from a state at rest at p0. */
static ice_reservoir expand_isentropically(const eos *law, double p0, const ice_reservoir *rest, double u)
{
    const double mach = u / sound_speed_behind(law, rest);
    const int steps = (int)fmin(fmax(1.0, ceil(32.0 * mach)), 8.0); /* slow flow needs one */
    const double step = u / steps;
    gas_state y = {p0, rest->rho, rest->e};
    for (int n = 0; n < steps; ++n) { /* Runge and Kutta's of order 4, with the speed as the clock */
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

/* The most speed to which fluid is led from rest at p0: its sound at rest. The isentrope of a stiff liquid ends, at no density, before that
 * speed (at 0.77 of it for gamma = 4.4); by the law of coupling/isentrope.h. */
static double most_speed_behind(const eos *law, double p0, const ice_reservoir *rest)
{
    static const double share = 0.9;
    const double sound = sound_speed_behind(law, rest), stiff = p0 - law->model->pressure_floor(law->par);
    const double exponent = rest->rho * sound * sound / stiff;
    return exponent > 1.0 ? fmin(sound, share * sound * sqrt(2.0 / (exponent - 1.0))) : sound;
}

/* Inflow w >= 0 with p(w) - z w = R on the isentrope; negative where the fluid leaves against the reservoir's
 * pressure. */
static ice_side_state from_reservoir(const ice *s, const ice_side_face *here, double R, double z)
{
    const bc_side *wall = here->condition;
    const eos *law = &s->material[ice_material_of(s, wall->material)].eos;
    double w = (wall->pressure - R) / z, p = wall->pressure;
    if (!(w > 0.0)) return (ice_side_state){wall->pressure, -w};
    const double most_speed = most_speed_behind(law, wall->pressure, &here->behind);
    w = fmin(w, most_speed);
    for (int k = 0; k < 8; ++k) {
        const ice_reservoir now = expand_isentropically(law, wall->pressure, &here->behind, w);
        double c2;
        law->model->pressure(law->par, 1, &now.rho, &now.e, &p, &c2);
        const double step = (p - z * w - R) / (now.rho * w + z);
        w = fmin(fmax(w + step, 0.0), most_speed);
        if (fabs(step) <= 1e-13 * most_speed) break;
    }
    return (ice_side_state){p, -w};
}

bool ice_shares_cells(const ice *s, int r, int side_material)
{
    const int brought = ice_material_of(s, side_material);
    return brought < 0 ? !s->cut : ice_region_of(s, r) == ice_region_of(s, brought);
}

bool ice_known_outside(const ice_side_face *here)
{
    return here->behind.rho > 0.0 && bc_gives_pressure(here->condition->kind);
}

bool ice_rests_behind(const ice_side_face *here)
{
    return ice_known_outside(here) && here->condition->kind != BC_NON_REFLECTING;
}

/* Speed of the flow into the domain: of all fluids of the cell, so that one answer holds for all of them. */
static double speed_of_cell(const ice *s, const fields *f, ptrdiff_t at, int axis, mesh_side side, const ice_region *g)
{
    double mass = 0.0, momentum = 0.0;
    for (int q = g->first; q < g->first + g->n; ++q) {
        if (s->material[q].points) continue;
        const double rho = field_get(f, C_RHO, q, 0)[at];
        mass += rho;
        momentum += rho * field_get(f, C_VEL, q, axis)[at];
    }
    return mass > 0.0 ? (side == SIDE_LOWER ? momentum : -momentum) / mass : 0.0;
}

static double sound_of_cell(const ice_view *v, ptrdiff_t c)
{
    return v->multi ? 1.0 / sqrt(v->rho_sum[c] * v->kappa_sum[c]) : v->m[0].c[c];
}

/* Whether fluid at rest outside enters as from a reservoir, given pressure, impedance and inward speed of the cell: at an outlet, where it
 * would enter at more than a share of its sound. The given pressure would do work on next to no mass there. */
static bool rushes_in(const ice *s, const ice_side_face *here, double p, double z, double inward)
{
    const bc_side *wall = here->condition;
    if (wall->kind == BC_RESERVOIR) return true;
    if (wall->kind != BC_OUTLET || s->implicit || !ice_rests_behind(here)) return false;
    const double sound = sound_speed_behind(&s->material[ice_material_of(s, wall->material)].eos, &here->behind);
    return inward + (wall->pressure - p) / z > rush * sound;
}

bool ice_is_reservoir(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at)
{
    const double z = v->rho_sum[at.cell] * sound_of_cell(v, at.cell);
    return rushes_in(s, ice_side_at(s, v->b, axis, side, at.i, at.j, at.k), v->p[at.cell], z,
                     -at.outward * v->mean[axis][at.cell]);
}

/* Pressure of a cell, that of the fluid that fills most of it, and impedance rho c of all its fluids. */
static void find_wave(const ice *s, const fields *f, ptrdiff_t at, const ice_region *g, double *p, double *z)
{
    double mass = 0.0, compliance = 0.0, most = 0.0;
    *p = (double)NAN;
    for (int q = g->first; q < g->first + g->n; ++q) {
        const double rho = field_get(f, C_RHO, q, 0)[at];
        if (s->material[q].points || !(rho > 0.0)) continue;
        const eos *law = &s->material[q].eos;
        const double pure = g->n > 1 ? 1.0 / field_get(f, C_VOL, q, 0)[at] : rho;
        double own, c2;
        law->model->pressure(law->par, 1, &pure, &field_get(f, C_ENERGY, q, 0)[at], &own, &c2);
        if (rho / pure > most) {
            most = rho / pure;
            *p = own;
        }
        mass += rho;
        compliance += rho / (pure * pure * c2);
    }
    *z = sqrt(mass / compliance);
}

/* Speed at which a fluid enters. From a reservoir it is that of its face: into a cell at rest at a lower pressure it enters at once, as
 * dense as the reservoir's fluid is at that speed. */
static double speed_inward(const ice *s, const fields *f, const ice_side_face *here, ptrdiff_t at, int axis,
                           mesh_side side, int r)
{
    const ice_region *g = ice_region_of(s, r);
    const double own = speed_of_cell(s, f, at, axis, side, g);
    double p, z;
    if (!ice_rests_behind(here)) return own;
    find_wave(s, f, at, g, &p, &z);
    return z > 0.0 && rushes_in(s, here, p, z, own) ? -from_reservoir(s, here, p - z * own, z).velocity : own;
}

/* Where flow leaves, nothing is changed. */
void ice_inflow_ghosts(const ice *s, const block *b, const fields *f, const ice_side_face *here, ghost_column at,
                       int axis, mesh_side side, int r, ice_ghost kind, int component, double *a)
{
    const bc_side *wall = here->condition;
    const bool enters = s->material[r].scene_material == wall->material, rests = ice_rests_behind(here);
    if (enters ? kind == GHOST_VELOCITY && !rests : kind != GHOST_DENSITY || !ice_shares_cells(s, r, wall->material))
        return;
    const eos *law = &s->material[ice_material_of(s, wall->material)].eos;
    const double inward = side == SIDE_LOWER ? 1.0 : -1.0,
                 most =
                     ice_rests_behind(here) ? most_speed_behind(law, wall->pressure, &here->behind) : (double)INFINITY,
                 speed = fmin(speed_inward(s, f, here, at.cell, axis, side, r), most);
    const ptrdiff_t out = side == SIDE_LOWER ? -b->stride[axis] : b->stride[axis];
    if (!(speed > 0.0)) return;
    /* Along an outlet it moves as the ambient does; a reservoir has no such velocity. */
    double value = kind != GHOST_VELOCITY ? 0.0 : component == axis ? inward * speed : wall->velocity[component];
    if (enters && kind != GHOST_VELOCITY) {
        const ice_reservoir now =
            rests ? expand_isentropically(law, wall->pressure, &here->behind, speed) : here->behind;
        value = kind == GHOST_DENSITY ? now.rho : kind == GHOST_ENERGY ? now.e : kind == GHOST_VOLUME ? now.v : now.T;
    }
    for (int n = 1; n <= MESH_GHOST; ++n) a[at.last + n * out] = value;
}

/* ---- faces ---- */

bool ice_enters_supersonic(const ice *s, const ice_side_face *here, int axis, mesh_side side)
{
    const bc_side *wall = here->condition;
    const double speed = side == SIDE_LOWER ? wall->velocity[axis] : -wall->velocity[axis];
    if (wall->kind != BC_INLET || !(here->behind.rho > 0.0) || !(speed > 0.0)) return false;
    return speed >= sound_speed_behind(&s->material[ice_material_of(s, wall->material)].eos, &here->behind);
}

/* Pressure of fluid of which the state outside is not known, at its speed: that of the cell's fluid, which moves at `stroll` of its sound
 * at most where it has the given pressure. By the isentrope's first two terms; at the speed of sound 1 per cent off for a diatomic gas. */
static double pressure_of_return(const ice_view *v, ptrdiff_t c, double given, double inward)
{
    const double sound = sound_of_cell(v, c), speed = fmin(inward, sound),
                 square = fmax(speed * speed - stroll * stroll * sound * sound, 0.0);
    return given - 0.5 * v->rho_sum[c] * square / (1.0 + 0.5 * square / (sound * sound));
}

double ice_outlet_pressure(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at, double inside)
{
    const ice_side_face *here = ice_side_at(s, v->b, axis, side, at.i, at.j, at.k);
    const double out = at.outward * v->mean[axis][at.cell], given = here->condition->pressure;
    if (out > 0.0) return out < sound_of_cell(v, at.cell) ? given : inside;
    if (!(out < 0.0)) return given;
    if (!ice_rests_behind(here)) return s->implicit ? given : pressure_of_return(v, at.cell, given, -out);
    const eos *law = &s->material[ice_material_of(s, here->condition->material)].eos;
    const ice_reservoir now =
        expand_isentropically(law, given, &here->behind, fmin(-out, most_speed_behind(law, given, &here->behind)));
    double p, c2;
    law->model->pressure(law->par, 1, &now.rho, &now.e, &p, &c2);
    return p;
}

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
    const ice_side_face *here = ice_side_at(s, v->b, axis, side, at.i, at.j, at.k);
    const bc_side *wall = here->condition;
    const ptrdiff_t c = at.cell, in = c - (side == SIDE_LOWER ? -1 : 1) * v->b->stride[axis];
    const double rho = v->rho_sum[c], sound = sound_of_cell(v, c), z = rho * sound;
    const double u = at.outward * v->mean[axis][c], h = v->h[axis];
    const double weight = rho * at.outward * v->gravity[axis] * h; /* hydrostatic difference of a cell */
    const double smooth = v->limit_hi * (1.0 - v->shock[c]), courant = fmin(fmax((u + sound) * v->dt / h, 0.0), 1.0);
    const double rise = v->p[c] - v->p[in] - weight + z * (u - at.outward * v->mean[axis][in]);
    const double R = v->p[c] + z * u + 0.5 * weight + 0.5 * smooth * (1.0 - courant) * rise;
    if (wall->kind != BC_NON_REFLECTING) return from_reservoir(s, here, R, z);
    if (!(u < sound)) return (ice_side_state){v->p[c] + 0.5 * weight, u};
    const double zq = mean_impedance(v, c, z, wall->pressure), far = at.outward * wall->velocity[axis],
                 velocity = (R - wall->pressure + zq * far) / (z + zq);
    return (ice_side_state){R - z * velocity, velocity};
}

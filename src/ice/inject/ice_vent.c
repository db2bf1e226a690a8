/* Vents (theory 2.19): gas passes an orifice between two places of the cells, or to surroundings that do not change. */
#include "ice/inject/ice_injection.h"
#include "ice/state/ice_tiles.h"

#include "coupling/orifice.h"

#include <math.h>

/* Of an ideal gas, from its law. */
typedef struct ideal_gas {
    double gamma, specific_heat;
} ideal_gas;

static ideal_gas vented_gas(const ice *s, int material)
{
    const eos *law = &s->material[material].eos;
    const double rho = 1.0, T = 1.0;
    ideal_gas out;
    double p, c2;
    law->model->energy(law->par, 1, &rho, &T, &out.specific_heat);
    law->model->pressure(law->par, 1, &rho, &out.specific_heat, &p, &c2);
    out.gamma = 1.0 + p / out.specific_heat;
    return out;
}

/* What a place has of its gas. Leaves its weights. */
static orifice_side gas_at(ice *s, const inject_place *p, double *all)
{
    double sum[3];
    *all = ice_set_weights(s, p);
    for (ice_weighed c = ice_weighed_of(s, p); ice_next_weighed(&c);) {
        const ice_fluid *m = &c.v.m[c.r];
        double *t = ice_tile(s, c.v.b, c.local[0], c.local[1], c.local[2]) + TILE_SCRATCH;
        const double mass = c.weight * m->rho1[c.at];
        t[0] += mass;
        t[1] += mass * m->e1[c.at];
        t[2] += c.v.multi ? mass * m->vol1[c.at] : c.weight;
    }
    ice_sum_scratch(s, sum);
    return (orifice_side){
        .gamma = vented_gas(s, p->material).gamma, .mass = sum[0], .energy = sum[1], .volume = sum[2]};
}

/* What has left a place. */
typedef struct outflow {
    double mass, enthalpy, kinetic; /* kg, J */
    double momentum[3];             /* kg m/s */
} outflow;

static void add_vented(ice *s, const ice_weighed *c, double mass, bool entered, outflow *out)
{
    double x[MESH_MAX_DIM], *tile = ice_weighed_tile(c, x);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double u = c->v.m[c->r].u1[a][c->at];
        out->momentum[a] += mass * u;
        out->kinetic += 0.5 * mass * u * u;
        ice_add_impulse(tile + TILE_SOURCE_MOMENTUM, x, a, -mass * u);
        if (!entered)
            tile[TILE_SOURCE_MOMENTUM + a] += mass * u;
        else
            tile[TILE_SOURCE_ENERGY] -= 0.5 * mass * u * u;
    }
}

/* Every cell gives in proportion to the mass and to the energy that it has there. */
static floe_status let_out(ice *s, const inject_place *p, const orifice_side *has, orifice_flow flow, bool entered,
                           outflow *out)
{
    const double most = 0.5;
    *out = (outflow){.mass = flow.mass, .enthalpy = flow.enthalpy};
    if (!(flow.mass < most * has->mass) || !(flow.enthalpy < most * has->energy))
        return fail(s->ctx, FLOE_RETRY, "more than half of the gas at a vent would pass it in a step");
    (void)ice_set_weights(s, p);
    for (ice_weighed c = ice_weighed_of(s, p); ice_next_weighed(&c);) {
        const ice_fluid *m = &c.v.m[c.r];
        const double there = c.weight * m->rho1[c.at], mass = flow.mass * there / has->mass,
                     enthalpy = flow.enthalpy * there * m->e1[c.at] / has->energy;
        if (!(there > 0.0)) continue;
        add_vented(s, &c, mass, entered, out);
        ice_give_out(&c.v, c.r, c.at, mass / c.volume, enthalpy / c.volume);
        if (entered) ice_tile(s, c.v.b, c.local[0], c.local[1], c.local[2])[TILE_SOURCE_ENERGY] -= enthalpy;
    }
    if (entered) ledger_add(s->ledger, LEDGER_MASS, LEDGER_SOURCE, -flow.mass);
    return FLOE_OK;
}

/* It brings the momentum and the energy that it has left with; its jet is not resolved, and mixes out where it enters. */
static void let_over(ice *s, const inject_place *p, const outflow *given)
{
    const ideal_gas gas = vented_gas(s, p->material);
    mass_intake in = {.mass = given->mass};
    double heat = given->enthalpy + given->kinetic;
    for (int a = 0; a < s->mesh->dim; ++a) {
        in.velocity[a] = given->momentum[a] / given->mass;
        heat -= 0.5 * given->mass * in.velocity[a] * in.velocity[a];
    }
    in.temperature = heat / (given->mass * gas.gamma * gas.specific_heat);
    ice_let_in(s, p, ice_set_weights(s, p), &in, false);
}

static floe_status pass_between(ice *s, const inject_place place[2], const orifice_side has[2],
                                const orifice_flow flow[2])
{
    for (int from = 0; from < 2; ++from) {
        outflow out;
        if (!(flow[from].mass > 0.0)) continue;
        TRY(let_out(s, &place[from], &has[from], flow[from], false, &out));
        let_over(s, &place[1 - from], &out);
    }
    return FLOE_OK;
}

static floe_status pass_outside(ice *s, const scene_vent *given, const inject_place *place, const orifice_side *has,
                                const orifice_flow flow[2])
{
    outflow out;
    if (flow[0].mass > 0.0) TRY(let_out(s, place, has, flow[0], true, &out));
    const mass_intake back = {.mass = flow[1].mass, .temperature = given->outside_temperature};
    if (back.mass > 0.0) ice_let_in(s, place, ice_set_weights(s, place), &back, true);
    return FLOE_OK;
}

/* Where one side holds no gas nothing passes. */
static floe_status pass_vent(ice *s, int k)
{
    const scene_vent *given = &s->scene->vent[k];
    const inject_place *place = s->injection->vent[k];
    orifice_side has[2];
    orifice_flow flow[2];
    double area, seconds, all;
    TRY(vent_opening(s->scene, given, s->time, s->time + s->dt, &area, &seconds));
    if (!(area > 0.0)) return FLOE_OK;
    has[0] = gas_at(s, &place[0], &all);
    if (!(has[0].mass > 0.0)) return FLOE_OK;
    const ideal_gas gas = vented_gas(s, place[0].material);
    if (given->to_outside)
        has[1] = orifice_surroundings(gas.gamma, given->outside_pressure,
                                      (gas.gamma - 1.0) * gas.specific_heat * given->outside_temperature);
    else
        has[1] = gas_at(s, &place[1], &all);
    if (!given->to_outside && !(all > 0.0 && has[1].volume > 0.0)) return FLOE_OK;
    orifice_pass(has, area, given->one_way, seconds, flow);
    return given->to_outside ? pass_outside(s, given, place, has, flow) : pass_between(s, place, has, flow);
}

floe_status ice_pass_vents(ice *s)
{
    for (int k = 0; k < s->scene->n_vents; ++k) TRY(pass_vent(s, k));
    return FLOE_OK;
}

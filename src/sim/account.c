/* Sums over both solvers, the ledger's totals, rest, and the figures of a plan. */
#include "sim/sim.h"

#include "base/memory.h"
#include "sim/coupled.h"

#include <math.h>
#include <string.h>

static bool is_fluid_body(const sim *s, int body)
{
    return s->mpm->body[body].fluid;
}

static void add_points(const sim *s, sim_totals *t)
{
    t->strain += t->mpm.springs;
    for (int b = 0; b < s->mpm->n_bodies; ++b) {
        t->mass += t->mpm.mass[b];
        t->kinetic += t->mpm.kinetic[b];
        t->strain += t->mpm.strain[b];
        t->internal += t->mpm.internal[b];
        if (!is_fluid_body(s, b)) t->kinetic_solid += t->mpm.kinetic[b];
        for (int a = 0; a < 3; ++a) t->momentum[a] += t->mpm.momentum[b][a];
    }
}

static void add_cells(const sim *s, sim_totals *t)
{
    for (int r = 0; r < s->ice->n_materials; ++r) {
        if (s->ice->material[r].points) continue;
        t->mass += t->ice.mass[r];
        t->kinetic += t->ice.kinetic[r];
        t->internal += t->ice.internal[r];
        for (int a = 0; a < 3; ++a) t->momentum[a] += t->ice.momentum[r][a];
    }
}

floe_status sim_sum(sim *s, sim_totals *out)
{
    memset(out, 0, sizeof *out);
    out->time = s->time;
    if (s->mpm) {
        TRY(mpm_sum(s->mpm, &out->mpm));
        add_points(s, out);
    }
    if (s->ice) {
        TRY(ice_sum(s->ice, &out->ice));
        add_cells(s, out);
    }
    return FLOE_OK;
}

void sim_account_for(sim *s, const sim_totals *t)
{
    ledger *l = &s->ledger;
    const double energy = t->kinetic + t->strain + t->internal;
    l->total[LEDGER_MASS] = t->mass;
    l->total[LEDGER_ENERGY] = energy;
    l->scale[LEDGER_MASS] = fmax(l->scale[LEDGER_MASS], t->mass);
    l->scale[LEDGER_ENERGY] = fmax(l->scale[LEDGER_ENERGY], energy);
    for (int a = 0; a < 3; ++a) {
        const ledger_quantity q = (ledger_quantity)(LEDGER_MOMENTUM_X + a);
        l->total[q] = t->momentum[a];
        l->scale[q] = fmax(l->scale[q], t->mpm.momentum_scale[a] + t->ice.momentum_scale[a]);
    }
}

floe_status sim_account(sim *s)
{
    sim_totals t;
    TRY(sim_sum(s, &t));
    sim_account_for(s, &t);
    return FLOE_OK;
}

floe_status sim_refresh(sim *s)
{
    if (s->transfer) TRY(coupled_refresh(s));
    return s->ice ? ice_refresh(s->ice) : FLOE_OK;
}

floe_status sim_check_rest(sim *s, const sim_totals *t)
{
    const scene_rest *r = &s->scene->rest;
    if (!r->enabled || s->time < r->after || sim_is_static(s)) return FLOE_OK;
    if (!(t->kinetic_solid <= r->ratio * t->strain))
        s->rest_since = INFINITY;
    else if (isinf(s->rest_since))
        s->rest_since = s->time;
    s->at_rest = s->time - s->rest_since >= r->window;
    return FLOE_OK;
}

/* Fields by who uses them: points and nodes are mpm's, cells and faces ice's, the pressures at nodes and points the coupling's. */
floe_status sim_plan(sim *s, sim_plan_info *out)
{
    memset(out, 0, sizeof *out);
    for (int b = 0; b < s->mesh.n_blocks; ++b)
        for (int id = 0; id < FIELD_COUNT; ++id) {
            const uint64_t bytes = fields_bytes(s->domain->fields[b], (field_id)id, (field_id)id);
            const field_centring c = field_describe((field_id)id)->centring;
            if (id == P_GRID_PRESSURE || id == N_PRESSURE || id == C_VELOCITY_CHANGE)
                out->coupling_bytes += bytes;
            else if (c == FIELD_POINT || c == FIELD_NODE)
                out->mpm_bytes += bytes;
            else
                out->ice_bytes += bytes;
        }
    const size_t tiles = mesh_tiles(&s->mesh);
    out->mpm_bytes += tiles * s->domain->partial_size * sizeof(double);
    out->scratch_bytes = memory_read_account(s->ctx).live_bytes - s->held_before -
                         (out->mpm_bytes + out->ice_bytes + out->coupling_bytes);
    out->cells = s->ice ? mesh_cells(&s->mesh) : 0;
    out->points = s->mpm ? mpm_count(s->mpm) : 0;
    return sim_predict(s, &out->predicted_dt, &out->predicted_steps, &out->dt_reason);
}

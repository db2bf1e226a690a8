/* Sums over both solvers, the ledger's totals, and the figures of a plan. */
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

void sim_sum_moments(sim *s, sim_totals *t)
{
    t->turns = true;
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; ++b) {
        double size[3];
        mpm_angular_momentum(s->mpm, b, t->spin[b], size);
        for (int a = 0; a < 3; ++a) {
            t->moment[a] += t->spin[b][a];
            t->moment_scale[a] += size[a];
        }
    }
    for (int r = 0; s->ice && r < s->ice->n_materials; ++r)
        for (int a = 0; a < 3; ++a) t->moment[a] += t->ice.moment[r][a];
    for (int a = 0; a < 3; ++a) t->moment_scale[a] += t->ice.moment_scale[a];
}

/* Sum of the sizes of all energies: zero points of internal energies are a matter of the law. */
static double energy_extent(const sim *s, const sim_totals *t)
{
    double sum = t->kinetic + fabs(t->strain);
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; ++b) sum += fabs(t->mpm.internal[b]);
    for (int r = 0; s->ice && r < s->ice->n_materials; ++r)
        if (!s->ice->material[r].points) sum += fabs(t->ice.internal[r]);
    return sum;
}

static ledger_state state_of(const sim *s, const sim_totals *t)
{
    ledger_state now = {.motion = t->kinetic + t->strain, .internal = t->internal, .turns = t->turns};
    now.total[LEDGER_MASS] = now.extent[LEDGER_MASS] = t->mass;
    now.total[LEDGER_ENERGY] = t->kinetic + t->strain + t->internal;
    now.extent[LEDGER_ENERGY] = energy_extent(s, t);
    for (int a = 0; a < 3; ++a) {
        now.total[LEDGER_MOMENTUM_X + a] = t->momentum[a];
        now.extent[LEDGER_MOMENTUM_X + a] = t->mpm.momentum_scale[a] + t->ice.momentum_scale[a];
        now.total[LEDGER_MOMENT_X + a] = t->moment[a];
        now.extent[LEDGER_MOMENT_X + a] = t->moment_scale[a];
    }
    return now;
}

/* Sum of m c^2 of the solids, with c^2 = K/rho. */
static double elasticity_of(const sim *s, const sim_totals *t)
{
    double sum = 0.0;
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; ++b) {
        const scene_material *m = &s->scene->material[s->mpm->body[b].scene_material];
        if (m->kind == MATERIAL_SOLID && m->law) sum += t->mpm.mass[b] / m->density * m->law->bulk_modulus(m->law_par);
    }
    return sum;
}

floe_status sim_open_ledger(sim *s)
{
    sim_totals t;
    TRY(sim_sum(s, &t));
    sim_sum_moments(s, &t);
    const ledger_state now = state_of(s, &t);
    ledger_open(&s->ledger, &now, elasticity_of(s, &t));
    return sim_find_stored_work(s, &s->ledger.motion.stored);
}

void sim_update_ledger_from(sim *s, const sim_totals *t)
{
    const ledger_state now = state_of(s, t);
    ledger_look(&s->ledger, &now, s->time);
}

floe_status sim_update_ledger(sim *s)
{
    sim_totals t;
    TRY(sim_sum(s, &t));
    sim_update_ledger_from(s, &t);
    return FLOE_OK;
}

floe_status sim_refresh(sim *s)
{
    if (s->transfer) TRY(coupled_refresh(s));
    /* Gas at rest beside a static balance has its pressure already, and no fields of a step. */
    return s->ice && !s->quasi_static_gas ? ice_refresh(s->ice) : FLOE_OK;
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
    out->scratch_bytes = memory_read_account(s->ctx).live_bytes - s->bytes_before -
                         (out->mpm_bytes + out->ice_bytes + out->coupling_bytes);
    out->cells = s->ice ? mesh_cells(&s->mesh) : 0;
    out->points = s->mpm ? mpm_count(s->mpm) : 0;
    return sim_predict(s, &out->predicted_dt, &out->predicted_steps, &out->dt_reason);
}

#include "io/summary.h"

#include "sim/interface.h"

#include <math.h>

/* Fields of the coupling: they exist only where points and cells meet. */
static bool is_of_coupling(field_id id)
{
    return id == N_PRESSURE || id == C_VELOCITY_CHANGE || id == P_GRID_PRESSURE;
}

static void add_bytes(run_summary *r, field_id id, long long bytes)
{
    if (is_of_coupling(id)) {
        r->field_bytes_coupling += bytes;
    } else if (id < C_RHO) {
        r->field_bytes_mpm += bytes;
    } else {
        r->field_bytes_ice += bytes;
    }
}

static void set_bytes(run_summary *r, const sim *s)
{
    r->field_bytes_mpm = r->field_bytes_ice = r->field_bytes_coupling = 0;
    for (int b = 0; b < s->mesh.n_blocks; b++) {
        for (int id = 0; id < FIELD_COUNT; id++) {
            add_bytes(r, (field_id)id, (long long)fields_bytes(s->domain->fields[b], (field_id)id, (field_id)id));
        }
    }
}

static void set_stages(run_summary *r, const sim *s)
{
    r->n_stages = s->stages.n;
    for (int i = 0; i < s->stages.n; i++) {
        (void)snprintf(r->seconds_by_stage[i].name, SUMMARY_NAME, "%s", s->stages.record[i].name);
        r->seconds_by_stage[i].value = s->stages.record[i].seconds;
    }
}

static void set_points(run_summary *r, const sim *s)
{
    const int bodies = s->mpm ? s->mpm->n_bodies : 0;
    r->points = 0;
    for (int b = 0; b < s->mesh.n_blocks; b++) {
        for (int body = 0; body < bodies; body++) r->points += (long long)s->mpm->points[b][body].n;
    }
}

/* The larger; a NaN is taken, and stays. */
static double larger(double a, double b)
{
    return isnan(a) || b <= a ? a : b;
}

static void set_drifts(run_summary *r, const sim *s)
{
    const ledger *l = &s->ledger;
    r->drift_mass = fabs(ledger_largest_drift(l, LEDGER_MASS));
    r->drift_energy = fabs(ledger_largest_drift(l, LEDGER_ENERGY));
    r->end_drift_mass = ledger_drift(l, LEDGER_MASS);
    r->end_drift_energy = ledger_drift(l, LEDGER_ENERGY);
    r->drift_momentum = r->end_drift_momentum = 0.0;
    for (int q = LEDGER_MOMENTUM_X; q < LEDGER_MOMENTUM_X + s->mesh.dim; q++) {
        r->drift_momentum = larger(r->drift_momentum, fabs(ledger_largest_drift(l, (ledger_quantity)q)));
        r->end_drift_momentum = larger(r->end_drift_momentum, ledger_drift(l, (ledger_quantity)q));
    }
    bool turns = false;
    r->drift_moment = r->end_drift_moment = 0.0;
    for (int q = LEDGER_MOMENT_X; q <= LEDGER_MOMENT_Z; q++) {
        turns = turns || !l->not_conserved[q];
        r->drift_moment = larger(r->drift_moment, fabs(ledger_largest_drift(l, (ledger_quantity)q)));
        r->end_drift_moment = larger(r->end_drift_moment, ledger_drift(l, (ledger_quantity)q));
    }
    if (!turns) r->drift_moment = r->end_drift_moment = NAN;
}

floe_status summary_set_sim(run_summary *r, const sim *s)
{
    (void)snprintf(r->coupling, sizeof r->coupling, "%s", coupling_name(s->coupling));
    (void)snprintf(r->solver, sizeof r->solver, "%s", s->solver_reason);
    const char *pressure = !s->ice ? "" : s->ice->implicit ? "implicit" : "explicit";
    (void)snprintf(r->pressure, sizeof r->pressure, "%s", s->pressure_reason[0] ? s->pressure_reason : pressure);
    (void)snprintf(r->substeps, sizeof r->substeps, "%s", s->substeps_reason);
    (void)snprintf(r->interface, sizeof r->interface, "%s", interface_in_words(s));
    r->dimensionless = s->scene->dimensionless;
    r->time = s->time;
    r->steps = s->steps;
    r->rejected_steps = s->rejected;
    r->cells = s->ice ? (long long)mesh_cells(&s->mesh) : 0;
    r->cell_updates = s->cell_updates;
    r->point_updates = s->point_updates;
    set_stages(r, s);
    set_points(r, s);
    set_bytes(r, s);
    set_drifts(r, s);
    for (int c = 0; c < LEDGER_COUNTS; c++) {
        TRY(summary_add_counter(r, s->ctx, ledger_count_name((ledger_count)c), s->ledger.count[c]));
    }
    return FLOE_OK;
}

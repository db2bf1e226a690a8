/* Gas at rest, enclosed by solids or on cells: one pressure, which acts on the surface of its shape (on cells:
 * implicit_gas.c) and decreases as its volume grows. The law of gas as points (material/point_fluid.c) is that of the
 * enclosed gas, taken as one point. */
#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/loads/point_loads.h"
#include "mpm/state/region.h"
#include "mpm/transfer/scratch.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

floe_status enclosed_gases_find(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    int n = 0;
    for (int b = 0; b < s->n_bodies; ++b) n += s->body[b].fluid ? 1 : 0;
    TRY(memory_new(s->ctx, &w->gas_set, (size_t)n, sizeof *w->gas_set));
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!s->body[b].fluid) continue;
        enclosed_gas *r = &w->gas_set[w->n_gases++];
        r->body = b;
        r->par = (solid_fluid_par){.eos = s->body[b].fluid_par.eos};
        TRY(memory_new(s->ctx, &r->unit_force, w->components, sizeof *r->unit_force));
    }
    return FLOE_OK;
}

void enclosed_gases_free(mpm *s)
{
    for (int r = 0; r < s->implicit->n_gases; ++r) {
        memory_free(s->ctx, &s->implicit->gas_set[r].unit_force);
        memory_free(s->ctx, &s->implicit->gas_set[r].marker_force);
    }
    memory_free(s->ctx, &s->implicit->gas_set);
}

enum { SUM_MASS, SUM_VOLUME0, SUM_VOLUME, SUM_ENERGY, SUMS };

static void sum_volume_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    const int body = *(const int *)user;
    const fields *f = s->domain->fields[blk];
    const size_t *range = s->points[blk][body].tile_start + tile;
    const double *mass = field_get(f, P_MASS, body, 0), *volume0 = field_get(f, P_VOLUME0, body, 0),
                 *J = field_get(f, P_J, body, 0), *energy = field_get(f, P_ENERGY, body, 0);
    for (size_t k = range[0]; k < range[1]; ++k) {
        sum[SUM_MASS] += mass[k];
        sum[SUM_VOLUME0] += volume0[k];
        sum[SUM_VOLUME] += volume0[k] * J[k];
        sum[SUM_ENERGY] += mass[k] * energy[k];
    }
}

static const char *name_of_gas(const mpm *s, const enclosed_gas *r)
{
    return r->body < 0 ? "of the cells" : s->scene->body[s->body[r->body].scene_body].name;
}

/* Isentropic change of a gas from its first state to a volume, in *b. */
static floe_status expand_gas(const mpm *s, const enclosed_gas *r, double volume, solid_batch *b)
{
    memset(b, 0, sizeof *b);
    b->n = 1;
    b->dt = 1.0;
    b->rho0[0] = r->mass / r->volume0;
    b->J_old[0] = r->volume_first / r->volume0;
    b->J[0] = volume / r->volume0;
    b->energy[0] = r->energy_first;
    if (volume > 0.0 && point_fluid.stress(&r->par, s->scene->reference_pressure, b) == 0) return FLOE_OK;
    return fail(s->ctx, FLOE_RETRY, "the gas '%s' would be beyond its law: its volume would go from %g to %g m3",
                name_of_gas(s, r), r->volume_first, volume);
}

/* Pressure of a gas and dp/de; returns the square of its speed of sound. */
static double enclosed_gas_state(const enclosed_gas *r, double *pressure, double *slope)
{
    const eos *law = &r->par.eos;
    const double rho = r->mass / r->volume;
    double c2;
    law->model->pressure(law->par, 1, &rho, &r->energy, pressure, &c2);
    law->model->dpde(law->par, 1, &rho, &r->energy, slope);
    return c2;
}

/* Share of the gas that lies in the region of a load. */
static double share_in_region(const mpm *s, const enclosed_gas *r, const shape *region)
{
    double inside = 0.0, all = 0.0;
    if (!region->model) return 1.0;
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const fields *f = s->domain->fields[id];
        const double *volume0 = field_get(f, P_VOLUME0, r->body, 0), *J = field_get(f, P_J, r->body, 0);
        for (size_t k = 0; k < s->points[id][r->body].n; ++k) {
            all += volume0[k] * J[k];
            inside += point_region_share(s, f, r->body, k, region) * volume0[k] * J[k];
        }
    }
    return inside / all;
}

/* Effect of the loads on a gas in the increment. Gas at rest has one pressure, so that a pressure prescribed in a
 * region is that of all of it. */
static void read_loads(const mpm *s, enclosed_gas *r)
{
    const load_step step = {s->time, s->time + s->dt, s->step};
    const double nowhere[3] = {0.0, 0.0,
                               0.0}; /* a power that changes with place is refused here (scene/unsupported.c) */
    r->scheduled = (double)NAN;
    r->heat = 0.0;
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load load = load_as_solved(s, &s->scene->load[l]);
        if (load.material != s->body[r->body].scene_material) continue;
        const bool heats = load.kind == LOAD_HEAT, pressurises = load.kind == LOAD_PRESSURISE;
        const double share = heats || pressurises ? share_in_region(s, r, &load.region) : 0.0;
        bool active = false;
        if (!(share > MPM_ENCLOSED_SHARE)) continue;
        if (heats)
            r->heat += load_target(s->scene, &s->scene->load[l], nowhere, s->time + 0.5 * s->dt) *
                       load_heating_time(&load, &step) * share * r->volume_first;
        if (!pressurises) continue;
        const double scheduled = load_scheduled_pressure(s->scene, &load, &step, &active);
        if (active) r->scheduled = scheduled;
    }
}

static floe_status begin_points(mpm *s, enclosed_gas *r)
{
    double sum[SUMS], slope;
    sum_over_tiles(s, SUMS, sum_volume_tile, &r->body, sum);
    if (!(sum[SUM_VOLUME] > 0.0))
        return fail_key(s->ctx, KEY("bodies", s->scene->body[s->body[r->body].scene_body].name),
                        "the gas has no points: make its shape larger, or the cells smaller");
    r->mass = r->mass_first = sum[SUM_MASS];
    r->volume0 = sum[SUM_VOLUME0];
    r->volume = r->volume_first = sum[SUM_VOLUME];
    r->energy = r->energy_first = sum[SUM_ENERGY] / sum[SUM_MASS];
    (void)enclosed_gas_state(r, &r->pressure_first, &slope);
    read_loads(s, r);
    return FLOE_OK;
}

enum { MOST_EXPANSIONS = 50 };

/* Gas that reaches open sides gets their pressure along its isentrope, exchanging the mass needed. */
static floe_status begin_open_gas(mpm *s, enclosed_gas *r)
{
    solid_batch *b = &s->scratch->batch[0];
    double volume = r->volume_first, slope;
    for (int k = 0; k < MOST_EXPANSIONS; ++k) {
        TRY(expand_gas(s, r, volume, b));
        r->volume = volume;
        r->energy = b->energy[0];
        const double c2 = enclosed_gas_state(r, &r->pressure, &slope), off = r->pressure - r->scheduled;
        if (fabs(off) <= 1e-12 * fabs(r->scheduled)) break;
        volume += off * volume * volume / (r->mass * c2);
    }
    r->density_rest = r->mass / r->volume;
    r->volume = r->volume_first;
    return FLOE_OK;
}

static floe_status begin_gas(mpm *s, enclosed_gas *r, const mpm_gas *gas)
{
    double slope;
    r->par = (solid_fluid_par){.eos = *gas->law};
    r->mass = r->mass_first = gas->mass;
    r->volume0 = r->volume = r->volume_first = gas->volume;
    r->energy = r->energy_first = gas->energy;
    r->scheduled = gas->prescribed_pressure;
    r->heat = gas->heat;
    r->open = gas->open;
    (void)enclosed_gas_state(r, &r->pressure_first, &slope);
    return r->open ? begin_open_gas(s, r) : FLOE_OK;
}

floe_status enclosed_gases_begin(mpm *s)
{
    for (int k = 0; k < s->implicit->n_gases; ++k) {
        enclosed_gas *r = &s->implicit->gas_set[k];
        TRY(r->body < 0 ? begin_gas(s, r, &s->gas[k]) : begin_points(s, r));
    }
    return FLOE_OK;
}

static double dot_product(const struct mpm_implicit *w, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->components; ++k) sum += x[k] * y[k];
    return sum;
}

/* Pressure, energy and stiffness of a gas after a change of its volume. */
floe_status enclosed_gas_set(mpm *s, enclosed_gas *r, double gain)
{
    solid_batch *b = &s->scratch->batch[0];
    double slope;
    TRY(expand_gas(s, r, r->volume_first + gain, b));
    r->volume = r->volume_first + gain;
    if (r->open) {
        r->mass = r->density_rest * r->volume;
        r->pressure = r->scheduled;
        r->stiffness = 0.0;
        return FLOE_OK;
    }
    r->energy = b->energy[0] + r->heat / r->mass;
    const double c2 = enclosed_gas_state(r, &r->pressure, &slope);
    r->stiffness = r->mass * c2 / (r->volume * r->volume);
    if (isnan(r->scheduled)) return FLOE_OK;
    r->energy += (r->scheduled - r->pressure) / slope;
    r->pressure = r->scheduled;
    r->stiffness = 0.0;
    return FLOE_OK;
}

floe_status enclosed_gases_force(mpm *s, const double *u, double *gas_force)
{
    struct mpm_implicit *w = s->implicit;
    memset(gas_force, 0, w->components * sizeof *gas_force);
    for (int k = 0; k < w->n_gases; ++k) {
        enclosed_gas *r = &w->gas_set[k];
        TRY(enclosed_gas_set(s, r, gas_walls_follow(r) ? r->swept : dot_product(w, r->unit_force, u)));
        const double pressure = r->pressure - s->scene->reference_pressure;
        for (size_t i = 0; i < w->components; ++i) gas_force[i] += pressure * r->unit_force[i];
    }
    return FLOE_OK;
}

void enclosed_gases_first_force(mpm *s, double *gas_force)
{
    struct mpm_implicit *w = s->implicit;
    memset(gas_force, 0, w->components * sizeof *gas_force);
    for (int k = 0; k < w->n_gases; ++k) {
        const double pressure = w->gas_set[k].pressure_first - s->scene->reference_pressure;
        for (size_t i = 0; i < w->components; ++i) gas_force[i] += pressure * w->gas_set[k].unit_force[i];
    }
}

void enclosed_gases_stiffness(const struct mpm_implicit *w, const double *x, double *y)
{
    for (int k = 0; k < w->n_gases; ++k) {
        const enclosed_gas *r = &w->gas_set[k];
        if (r->stiffness == 0.0) continue;
        const double pressure = r->stiffness * dot_product(w, r->unit_force, x);
        for (size_t i = 0; i < w->components; ++i)
            if (!w->constrained[i]) y[i] += pressure * r->unit_force[i];
    }
}

/* Points of an enclosed gas keep their positions: gas at rest is uniform. */
void enclosed_gas_store(mpm *s, const enclosed_gas *r, int blk)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    const size_t n = s->points[blk][r->body].n;
    const double growth = r->volume / r->volume_first, stress = s->scene->reference_pressure - r->pressure;
    for (size_t k = 0; k < n; ++k) {
        field_next(f, P_J, r->body, 0)[k] = growth * field_get(f, P_J, r->body, 0)[k];
        field_next(f, P_ENERGY, r->body, 0)[k] = r->energy;
        for (int c = 0; c < field_component_count(FIELD_STRESS, dim); ++c)
            field_next(f, P_STRESS, r->body, c)[k] = c < 3 ? stress : 0.0;
        for (int a = 0; a < dim; ++a) {
            field_next(f, P_POS, r->body, a)[k] = field_get(f, P_POS, r->body, a)[k];
            field_next(f, P_VEL, r->body, a)[k] = 0.0;
            if (s->carries[P_BOX]) field_next(f, P_BOX, r->body, a)[k] = field_get(f, P_BOX, r->body, a)[k];
        }
    }
    if (fields_has(f, P_VISCOUS_PRESSURE, r->body))
        memset(field_next(f, P_VISCOUS_PRESSURE, r->body, 0), 0, n * sizeof(double));
}

void enclosed_gas_to_cells(const enclosed_gas *r, mpm_gas *gas)
{
    gas->mass_end = r->mass;
    gas->volume_end = r->volume;
    gas->energy_end = r->energy;
    gas->pressure = r->pressure;
}

void enclosed_gases_store(mpm *s)
{
    for (int k = 0; k < s->implicit->n_gases; ++k) {
        const enclosed_gas *r = &s->implicit->gas_set[k];
        if (r->body < 0) enclosed_gas_to_cells(r, &s->gas[k]);
        for (int b = 0; b < s->mesh->n_blocks && r->body >= 0; ++b) enclosed_gas_store(s, r, b);
    }
}

double enclosed_gases_enter(mpm *s)
{
    double done = 0.0;
    for (int k = 0; k < s->implicit->n_gases; ++k) {
        const enclosed_gas *r = &s->implicit->gas_set[k];
        const double gain = r->volume - r->volume_first, mean = 0.5 * (r->pressure_first + r->pressure);
        const double heat = r->mass * r->energy - r->mass_first * r->energy_first + mean * gain;
        ledger_add(s->ledger, LEDGER_ENERGY, r->open ? LEDGER_BOUNDARY : LEDGER_SOURCE, heat);
        ledger_add(s->ledger, LEDGER_MASS, LEDGER_BOUNDARY, r->mass - r->mass_first);
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, -s->scene->reference_pressure * gain);
        done += (mean - s->scene->reference_pressure) * gain;
    }
    return done;
}

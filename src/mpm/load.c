/* Loads on points that act on their volume: body forces, energy. Those on surfaces: traction.c. */
#include "mpm/work.h"
#include "scene/state.h"

#include <string.h>

double load_now(const mpm *s, const scene_load *load)
{
    return load_fraction(load, &(load_step){s->time, s->time, s->step - 1});
}

void set_body_forces(mpm *s)
{
    memset(s->work->acceleration, 0, sizeof s->work->acceleration);
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (load->kind != LOAD_BODY_FORCE) continue;
        for (int b = 0; b < s->n_bodies; ++b)
            if (load->body < 0 || load->body == s->body[b].scene_body)
                for (int a = 0; a < 3; ++a) s->work->acceleration[b][a] += load_now(s, load) * load->vector[a];
    }
}

/* Momentum and work of the body forces on the points of a tile: m a kick, and m a.dx. */
static void tile_body_force(const mpm *s, int blk, int body, int tile, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const size_t *at = s->points[blk][body].tile_start;
    const double *mass = field_get(f, P_MASS, body, 0);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double *x = field_get(f, P_POS, body, a), *next = field_next(f, P_POS, body, a);
        const double acceleration = s->work->acceleration[body][a];
        for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
            sum[a] += mass[k] * acceleration * s->work->kick;
            sum[3] += mass[k] * acceleration * (next[k] - x[k]);
        }
    }
}

void enter_body_forces(mpm *s)
{
    enum { SUMS = 4 }; /* momentum, energy */
    bool acts = false;
    for (int body = 0; body < s->n_bodies; ++body)
        for (int a = 0; a < s->mesh->dim; ++a) acts = acts || s->work->acceleration[body][a] != 0.0;
    if (!acts) return;
    memset(s->work->tile_sum, 0, mesh_tiles(s->mesh) * SUMS * sizeof(double));
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 8)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t)
            for (int body = 0; body < s->n_bodies; ++body)
                tile_body_force(s, b, body, t,
                                s->work->tile_sum + (size_t)tile_box_of(s->mesh, &s->mesh->block[b], t).number * SUMS);
    }
    double sum[SUMS];
    domain_sum_tiles(s->mesh, s->work->tile_sum, SUMS, sum);
    for (int a = 0; a < s->mesh->dim; ++a)
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE, sum[a]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, sum[3]);
}

floe_status set_heating(mpm *s)
{
    const load_step step = {s->time, s->time + s->dt, s->step};
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        s->work->heat[l] = 0.0;
        if (s->coupled) continue;
        if (load->kind == LOAD_HEAT && load_heats(load, &step)) s->work->heat[l] = load->target * s->dt;
        if (load->kind != LOAD_PRESSURISE) continue;
        bool active;
        const double scheduled = load_scheduled_pressure(s->scene, load, &step, &active);
        if (!active) continue;
        double now;
        TRY(mpm_mean_pressure(s, load->material, &load->region, &now));
        s->work->heat[l] = scheduled - now;
    }
    return FLOE_OK;
}

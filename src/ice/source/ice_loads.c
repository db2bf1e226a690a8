/* Heating of a fluid in a region: at a given power, or such that its mean pressure follows a ramp (pressurise). */
#include "ice/source/ice_lagrangian.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_lists.h"
#include "ice/state/ice_tiles.h"
#include "ice/state/ice_walk.h"

#include "base/memory.h"
#include "scene/state.h"

#include <math.h>

/* Cells of the regions of loads; of none that has not acted yet. */
typedef struct ice_heated {
    ice_region_cells of[SCENE_MAX_LOADS];
    bool found[SCENE_MAX_LOADS];
} ice_heated;

static bool adds_heat(const scene_load *load)
{
    return load->kind == LOAD_HEAT || load->kind == LOAD_PRESSURISE;
}

floe_status ice_heated_create(ice *s)
{
    return ice_some_load_heats(s) ? memory_new(s->ctx, &s->heated, 1, sizeof *s->heated) : FLOE_OK;
}

void ice_heated_destroy(context *ctx, ice_heated **w)
{
    for (int l = 0; *w && l < SCENE_MAX_LOADS; ++l) ice_region_cells_destroy(ctx, &(*w)->of[l]);
    memory_free(ctx, w);
}

bool ice_some_load_heats(const ice *s)
{
    for (int l = 0; l < s->scene->n_loads; ++l)
        if (adds_heat(&s->scene->load[l])) return true;
    return false;
}

static floe_status find_load_cells(ice *s, int l)
{
    if (s->heated->found[l]) return FLOE_OK;
    TRY(ice_region_cells_create(s, &s->scene->load[l].region, &s->heated->of[l]));
    s->heated->found[l] = true;
    return FLOE_OK;
}

/* A cell's indices in its block, and in the mesh, by which it has its place. */
static void find_indices(const block *b, ptrdiff_t at, int in_block[MESH_MAX_DIM], int cell[MESH_MAX_DIM])
{
    ice_cell_of(b, at, in_block);
    for (int a = 0; a < MESH_MAX_DIM; ++a) cell[a] = b->lo[a] + in_block[a];
}

/* Share of a cell that lines which cut it leave to its one gas. */
static double open_share(const ice_fluid *m, ptrdiff_t at)
{
    return m->open ? m->open[at] : 1.0;
}

/* Energy per volume that the fluid of one cell receives. */
typedef double heat_function(const ice_view *v, int r, ptrdiff_t at, double amount);

/* `amount`: J/m3 of the fluid. */
static double heat_by_power(const ice_view *v, int r, ptrdiff_t at, double amount)
{
    return amount * (v->multi ? v->m[r].theta[at] : 1.0);
}

/* The same energy per mass everywhere: a region heats evenly, and small volume fractions of thin gas are not singled
 * out. */
static double heat_by_mass(const ice_view *v, int r, ptrdiff_t at, double amount)
{
    return v->m[r].rho[at] * amount;
}

/* What a load gives a cell in the step: `amount` as it is, or as the time (s) of its power. */
static double amount_at(const ice *s, int l, const int cell[MESH_MAX_DIM], double amount)
{
    const scene_load *load = &s->scene->load[l];
    double x[3] = {0.0, 0.0, 0.0};
    if (load->kind != LOAD_HEAT) return amount;
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, cell[a]);
    return load_target(s->scene, load, x, s->time + 0.5 * s->dt) * amount;
}

static void add_heat(ice *s, const ice_region *g, int l, int r, heat_function *heat, double amount)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_cell_list *list = &s->heated->of[l].cells[v.b->id];
        const double *share = s->heated->of[l].share[v.b->id];
        for (size_t n = 0; n < list->n; ++n) {
            const ptrdiff_t at = list->at[n];
            if (!(v.m[r].rho[at] > 0.0)) continue;
            int in[MESH_MAX_DIM], cell[MESH_MAX_DIM];
            find_indices(v.b, at, in, cell);
            const double added = share[n] * heat(&v, r, at, amount_at(s, l, cell, amount));
            v.m[r].el[at] += added / v.m[r].rho[at];
            ice_tile(s, v.b, in[0], in[1], in[2])[TILE_SOURCE_ENERGY] +=
                added * v.volume[in[0]] * open_share(&v.m[r], at);
        }
    }
}

/* Mean pressure of the region at the start of the step, and the mean of dp/de at constant density, by the fluid's
 * volume. */
typedef struct region_means {
    double pressure, slope;
} region_means;

static double pressure_slope(const ice_view *v, int r, ptrdiff_t at)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &v->material[r].eos;
    const double rho = v->multi ? 1.0 / m->v[at] : m->rho[at];
    double slope;
    law->model->dpde(law->par, 1, &rho, &m->e[at], &slope);
    return slope;
}

static void add_means(ice *s, const ice_view *v, int r, ptrdiff_t at, double share)
{
    int in[MESH_MAX_DIM];
    ice_cell_of(v->b, at, in);
    const double fluid = v->volume[in[0]] * (v->multi ? v->m[r].theta[at] : open_share(&v->m[r], at)),
                 weight = fluid > 0.0 ? fluid * share : 0.0;
    double *t = ice_tile(s, v->b, in[0], in[1], in[2]) + TILE_SCRATCH;
    if (!(weight > 0.0)) return;
    t[0] += weight;
    t[1] += weight * v->p[at];
    t[2] += weight * pressure_slope(v, r, at);
}

static region_means means_of(ice *s, const ice_region *g, int l, int r)
{
    double sum[3];
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_cell_list *list = &s->heated->of[l].cells[v.b->id];
        const double *share = s->heated->of[l].share[v.b->id];
        for (size_t n = 0; n < list->n; ++n) add_means(s, &v, r, list->at[n], share[n]);
    }
    ice_sum_scratch(s, sum);
    return (region_means){sum[1] / sum[0], sum[2] / sum[0]};
}

static void set_gas_pressure(ice *s, const ice_region *g, int l, int r)
{
    bool active;
    const load_step step = {s->time, s->time + s->dt, s->step};
    const double scheduled = load_scheduled_pressure(s->scene, &s->scene->load[l], &step, &active);
    if (!active) return;
    const region_means mean = means_of(s, g, l, r);
    add_heat(s, g, l, r, heat_by_mass, (scheduled - mean.pressure) / mean.slope);
}

/* The time (s) in which the full power of a load gives what it gives in the step. */
static double heating_time(const ice *s, const scene_load *load)
{
    return load_heating_time(load, &(load_step){s->time, s->time + s->dt, s->step});
}

/* The fluid of a region that a load heats in this step, -1: none. */
static int heated_by(const ice *s, const ice_region *g, const scene_load *load)
{
    const int material = adds_heat(load) ? ice_material_of(s, load->material) : -1, r = material - g->first;
    if (r < 0 || r >= g->n || s->material[material].points || !(s->time + s->dt > load->start)) return -1;
    return load->kind == LOAD_PRESSURISE || heating_time(s, load) != 0.0 ? r : -1;
}

floe_status ice_apply_loads(ice *s, const ice_region *g)
{
    for (int l = 0; l < s->scene->n_loads && s->heated; ++l) {
        const scene_load *load = &s->scene->load[l];
        const int r = heated_by(s, g, load);
        if (r < 0) continue;
        TRY(find_load_cells(s, l));
        if (load->kind == LOAD_PRESSURISE)
            set_gas_pressure(s, g, l, r);
        else
            add_heat(s, g, l, r, heat_by_power, heating_time(s, load));
    }
    return FLOE_OK;
}

static void add_pressure(ice *s, const ice_region *g, int l, int r, double seconds)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_cell_list *list = &s->heated->of[l].cells[v.b->id];
        const double *share = s->heated->of[l].share[v.b->id];
        for (size_t n = 0; n < list->n; ++n) {
            const ptrdiff_t at = list->at[n];
            const ice_fluid *m = &v.m[r];
            int in[MESH_MAX_DIM], cell[MESH_MAX_DIM];
            if (!(m->rho[at] > 0.0)) continue;
            find_indices(v.b, at, in, cell);
            const double volume = v.multi ? m->v[at] : 1.0 / m->rho[at],
                         part = share[n] * (v.multi ? m->kappa[at] / v.kappa_sum[at] : 1.0);
            v.dP[at] += ice_implicit_phi(&v, 0.5 * (1.0 + v.shock[at])) * part * volume * pressure_slope(&v, r, at) *
                        heat_by_power(&v, r, at, amount_at(s, l, cell, seconds));
        }
    }
}

floe_status ice_load_pressure(ice *s, const ice_region *g)
{
    for (int l = 0; l < s->scene->n_loads && s->heated; ++l) {
        const scene_load *load = &s->scene->load[l];
        const int r = load->kind == LOAD_HEAT ? heated_by(s, g, load) : -1;
        if (r < 0) continue;
        TRY(find_load_cells(s, l));
        add_pressure(s, g, l, r, heating_time(s, load));
    }
    return FLOE_OK;
}

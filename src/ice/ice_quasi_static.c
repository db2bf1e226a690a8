/* Quasi-static gas on cells (ice_quasi_static.h): finds the regions of connected cells, sums their mass, energy and volume, and sets their cells to a state
 * of rest. */
#include "ice/ice_quasi_static.h"

#include "base/memory.h"
#include "ice/cut/ice_cut.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "scene/side_parts.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

/* The only fluid on the cells; -1: there are several. */
static int only_fluid(const ice *s)
{
    int found = -1;
    for (int r = 0; r < s->n_materials; ++r) {
        if (s->material[r].points) continue;
        if (found >= 0) return -1;
        found = r;
    }
    return found;
}

static const char *obstacle_at_sides(const ice *s)
{
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2; ++side)
            if (scene_side_varies(s->scene, a, side)) return "a side of the domain changes along itself, or in time";
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2 && !s->mesh->periodic[a]; ++side) {
            const bc_kind kind = s->scene->bc.side[a][side].kind;
            if (!ice_is_wall(kind) && kind != BC_OUTLET) return "a side of the domain drives the gas, or moves";
        }
    return NULL;
}

const char *ice_quasi_static_obstacle(const ice *s)
{
    if (only_fluid(s) < 0) return "gases of several kinds on cells mix";
    if (ice_reaction_count(s) > 0) return "gases react";
    if (s->injection) return "gas comes in from a source, or passes a vent";
    for (int a = 0; a < s->mesh->dim; ++a)
        if (s->gravity[a] != 0.0) return "gas on cells under gravity has no single pressure";
    return scene_enclosing_body(s->scene) < 0 ? obstacle_at_sides(s) : NULL; /* else it does not get there */
}

floe_status ice_quasi_static_create(ice_quasi_static **out, ice *s)
{
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    ice_quasi_static *r = *out;
    r->ctx = s->ctx;
    r->material = only_fluid(s);
    TRY(memory_new(s->ctx, &r->of, mesh_cells(s->mesh), sizeof *r->of));
    TRY(memory_new(s->ctx, &r->seen, mesh_cells(s->mesh), sizeof *r->seen));
    return memory_new(s->ctx, &r->list, mesh_cells(s->mesh), sizeof *r->list);
}

void ice_quasi_static_destroy(ice_quasi_static **r)
{
    if (!r || !*r) return;
    context *ctx = (*r)->ctx;
    memory_free(ctx, &(*r)->region);
    memory_free(ctx, &(*r)->of);
    memory_free(ctx, &(*r)->seen);
    memory_free(ctx, &(*r)->list);
    memory_free(ctx, r);
}

/* Volume fraction of the gas in a cell. */
static double gas_share_of_cell(const ice *s, int r, const int cell[MESH_MAX_DIM])
{
    const ice_owned_cell c = ice_find_cell(s, cell);
    if (s->cut) return ice_open_cell(s, ice_region_of(s, r)->number, CUT_NOW, cell);
    const double rho = field_get(c.f, C_RHO, r, 0)[c.at];
    return ice_is_mixture(s) ? rho * field_get(c.f, C_VOL, r, 0)[c.at] : rho > 0.0 ? 1.0 : 0.0;
}

/* The cell beside another, around a periodic end where need be. False beyond a side. */
static bool find_cell_beside(const mesh *m, const int from[MESH_MAX_DIM], int axis, int side, int out[MESH_MAX_DIM])
{
    memcpy(out, from, MESH_MAX_DIM * sizeof *out);
    return mesh_step(m, out, axis, side == SIDE_UPPER ? 1 : -1);
}

static bool gas_passes_face(const ice *s, const ice_quasi_static *r, const int cell[MESH_MAX_DIM], int axis, int side)
{
    return !s->cut || ice_open_face(s, ice_region_of(s, r->material)->number, CUT_NOW, cell, axis, side) > 0.0;
}

static floe_status open_region(const ice *s, ice_gas_region *g, const bc_side *side)
{
    const double pressure = side->pressure;
    if (side->kind != BC_OUTLET)
        return fail_key(s->ctx, KEY("time", "solver"),
                        "static: gas reaches a side of kind %s, where it does not come to rest; use dynamic",
                        bc_name(side->kind));
    if (g->open && g->prescribed_pressure != pressure)
        return fail_key(s->ctx, KEY("time", "solver"),
                        "static: gas would flow between sides at %g and at %g Pa; use dynamic", g->prescribed_pressure,
                        pressure);
    g->open = true;
    g->prescribed_pressure = pressure;
    return FLOE_OK;
}

/* Adds all cells connected with the first `last` of the list whose gas fraction is at least `least`. */
static floe_status collect_connected_cells(const ice *s, ice_quasi_static *r, int last, double least)
{
    const mesh *m = s->mesh;
    for (int first = 0; first < last; ++first) {
        const int number = r->of[r->list[first]];
        int cell[MESH_MAX_DIM], next[MESH_MAX_DIM];
        ice_numbered_cell(m, r->list[first], cell);
        for (int f = 0; f < 2 * m->dim; ++f) {
            if (!gas_passes_face(s, r, cell, f / 2, f % 2)) continue;
            if (!find_cell_beside(m, cell, f / 2, f % 2, next)) {
                const bc_side *side = &s->scene->bc.side[f / 2][f % 2];
                if (!ice_is_wall(side->kind)) TRY(open_region(s, &r->region[number], side));
                continue;
            }
            const int to = ice_cell_number(m, next);
            if (r->of[to] >= 0 || !(gas_share_of_cell(s, r->material, next) > least)) continue;
            r->of[to] = number;
            r->list[last++] = to;
        }
    }
    return FLOE_OK;
}

/* Regions from cells that are in none yet and have more than `least` of gas. */
static floe_status start_regions(ice *s, ice_quasi_static *r, double least)
{
    const int cells = (int)mesh_cells(s->mesh);
    for (int k = 0; k < cells; ++k) {
        int cell[MESH_MAX_DIM];
        ice_numbered_cell(s->mesh, k, cell);
        if (r->of[k] >= 0 || !(gas_share_of_cell(s, r->material, cell) > least)) continue;
        TRY(memory_resize(s->ctx, &r->region, (size_t)r->n + 1, sizeof *r->region));
        r->region[r->n] = (ice_gas_region){.prescribed_pressure = NAN};
        r->of[k] = r->n++;
        r->list[0] = k;
        TRY(collect_connected_cells(s, r, 1, least));
    }
    return FLOE_OK;
}

static floe_status find_gas_regions(ice *s, ice_quasi_static *r)
{
    const int cells = (int)mesh_cells(s->mesh);
    int last = 0;
    r->n = 0;
    for (int k = 0; k < cells; ++k) r->of[k] = -1;
    if (s->cut) return start_regions(s, r, 0.0);
    TRY(start_regions(s, r, ICE_PASSING_FRACTION));
    for (int k = 0; k < cells; ++k)
        if (r->of[k] >= 0) r->list[last++] = k;
    TRY(collect_connected_cells(s, r, last, 0.0));
    return start_regions(s, r, 0.0);
}

/* What is in each region, in the order of the cells, whatever the blocks. */
static void measure_regions(const ice *s, ice_quasi_static *r)
{
    const int cells = (int)mesh_cells(s->mesh);
    for (int k = 0; k < cells; ++k) {
        int cell[MESH_MAX_DIM];
        r->seen[k] = -1;
        if (r->of[k] < 0) continue;
        ice_numbered_cell(s->mesh, k, cell);
        const ice_owned_cell c = ice_find_cell(s, cell);
        const double volume = mesh_cell_volume(s->mesh, cell[0]);
        ice_gas_region *g = &r->region[r->of[k]];
        const double share = gas_share_of_cell(s, r->material, cell);
        if (share > ICE_PASSING_FRACTION) r->seen[k] = r->of[k];
        const double mass = field_get(c.f, C_RHO, r->material, 0)[c.at] * volume * (s->cut ? share : 1.0);
        double energy = field_get(c.f, C_ENERGY, r->material, 0)[c.at];
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double u = field_get(c.f, C_VEL, r->material, a)[c.at];
            energy += 0.5 * u * u;
        }
        g->mass += mass;
        g->volume += share * volume;
        g->energy += mass * energy;
    }
}

static floe_status pressurise_region(const ice *s, ice_gas_region *g, const scene_load *load, double pressure)
{
    if (!g->open) {
        g->prescribed_pressure = pressure;
        return FLOE_OK;
    }
    return fail_key(
        s->ctx, KEY("time", "solver"),
        "static: load '%s' would pressurise gas that flows out at a side of the domain, past any "
        "solid that is thinner than two cells; make the load's region smaller, domain.cell finer, or use dynamic",
        load->name);
}

static floe_status apply_load(const ice *s, ice_quasi_static *r, const scene_load *given)
{
    const load_step step = {s->time, s->time + s->dt, s->step};
    const scene_load load = load_until(given, s->scene->time.end);
    const int cells = (int)mesh_cells(s->mesh);
    bool active = false;
    double pressure = NAN;
    if (load.kind == LOAD_PRESSURISE) pressure = load_scheduled_pressure(s->scene, &load, &step, &active);
    const double heating = load.kind == LOAD_HEAT ? load_heating_time(&load, &step) : 0.0;
    for (int k = 0; k < cells && (active || heating > 0.0); ++k) {
        int cell[MESH_MAX_DIM];
        double x[3] = {0.0, 0.0, 0.0};
        if (r->of[k] < 0) continue;
        ice_numbered_cell(s->mesh, k, cell);
        for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, cell[a]);
        const double share = ice_region_share(s->mesh, &load.region, cell);
        if (!(share > 0.0)) continue;
        /* A trace of gas within a wall belongs to whichever side is nearer: it does not say what is pressurised. */
        if (load.kind == LOAD_PRESSURISE && !s->cut && r->seen[k] < 0) continue;
        ice_gas_region *g = &r->region[r->of[k]];
        if (load.kind == LOAD_PRESSURISE)
            TRY(pressurise_region(s, g, &load, pressure));
        else
            g->heat += load_target(s->scene, given, x, s->time + 0.5 * s->dt) * heating * share *
                       gas_share_of_cell(s, r->material, cell) * mesh_cell_volume(s->mesh, cell[0]);
    }
    return FLOE_OK;
}

floe_status ice_quasi_static_find(ice *s, ice_quasi_static *r)
{
    TRY(find_gas_regions(s, r));
    measure_regions(s, r);
    for (int l = 0; l < s->scene->n_loads; ++l)
        if (ice_material_of(s, s->scene->load[l].material) == r->material &&
            (s->scene->load[l].kind == LOAD_PRESSURISE || s->scene->load[l].kind == LOAD_HEAT))
            TRY(apply_load(s, r, &s->scene->load[l]));
    return FLOE_OK;
}

int ice_gas_region_near(const ice *s, const ice_quasi_static *r, const int cell[MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    int found = r->of[ice_cell_number(m, cell)];
    for (int f = 0; f < 2 * m->dim && found < 0; ++f) {
        int beside[MESH_MAX_DIM];
        if (find_cell_beside(m, cell, f / 2, f % 2, beside)) found = r->of[ice_cell_number(m, beside)];
    }
    return found;
}

/* ---- the state of rest on the cells ---- */

/* What solids take of a cell at a pressure; their volumes there are set. */
static double take_solids(const ice *s, const ice_owned_cell *c, double pressure)
{
    double taken = 0.0;
    for (int r = 0; r < s->n_materials && ice_is_mixture(s); ++r) {
        if (!s->material[r].points) continue;
        const eos *law = &s->material[r].eos;
        const double T = ICE_ANY_TEMPERATURE;
        double *v = &field_get(c->f, C_VOL, r, 0)[c->at], dvdp;
        law->model->volume(law->par, 1, &pressure, &T, v, &dvdp);
        taken += field_get(c->f, C_RHO, r, 0)[c->at] * *v;
    }
    return taken;
}

/* Region and share of a cell's gas as it is now. */
typedef struct cell_gas {
    int region; /* whose pressure it has */
    double share;
} cell_gas;

static cell_gas gas_of(const ice *s, const ice_quasi_static *r, const ice_gas_region_state *state, int number)
{
    int cell[MESH_MAX_DIM];
    ice_numbered_cell(s->mesh, number, cell);
    const ice_owned_cell c = ice_find_cell(s, cell);
    const int region = r->n == 1 ? 0 : ice_gas_region_near(s, r, cell); /* a membrane may have moved far */
    const bool had = r->of[number] >= 0;
    const double pressure = region >= 0 ? state[region].pressure : s->scene->reference_pressure;
    double share = s->cut ? ice_open_cell(s, ice_region_of(s, r->material)->number, CUT_NEXT, cell)
                          : 1.0 - take_solids(s, &c, pressure);
    if (!s->cut && !(share > (had ? ICE_SHARE_TO_STAY : ICE_SHARE_TO_ENTER))) share = 0.0;
    return (cell_gas){region, region >= 0 ? share : 0.0};
}

static void set_gas_cell(const ice *s, const ice_quasi_static *r, int number, const ice_gas_region_state *state,
                         cell_gas g, double factor)
{
    int cell[MESH_MAX_DIM];
    ice_numbered_cell(s->mesh, number, cell);
    const ice_owned_cell c = ice_find_cell(s, cell);
    const bool has = g.share > 0.0;
    const int m = r->material;
    const double density = has ? factor * state[g.region].mass / state[g.region].volume : 0.0;
    field_get(c.f, C_RHO, m, 0)[c.at] = density * (ice_is_mixture(s) ? g.share : 1.0);
    field_get(c.f, C_ENERGY, m, 0)[c.at] = has ? state[g.region].energy : 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) field_get(c.f, C_VEL, m, a)[c.at] = 0.0;
    if (ice_is_mixture(s))
        field_get(c.f, C_VOL, m, 0)[c.at] = has ? state[g.region].volume / state[g.region].mass : 0.0;
    if (s->cut) field_get(c.f, C_OPEN, m, 0)[c.at] = g.share;
    field_get(c.f, C_PRESSURE, ice_region_of(s, m)->number, 0)[c.at] =
        g.region >= 0 ? state[g.region].pressure : s->scene->reference_pressure;
}

/* Volume (m3) that the cells offer a region: those without a solid, and the others. */
typedef struct region_volumes {
    double clear, shared;
} region_volumes;

static bool is_clear(const ice *s, cell_gas g)
{
    return ice_is_mixture(s) && g.share > 1.0 - 1e-12;
}

static void measure_volumes(const ice *s, const ice_quasi_static *r, const ice_gas_region_state *state,
                            region_volumes *volumes)
{
    const int cells = (int)mesh_cells(s->mesh);
    for (int k = 0; k < cells; ++k) {
        const cell_gas g = gas_of(s, r, state, k);
        const double volume = g.share * mesh_cell_volume(s->mesh, k % s->mesh->n[0]);
        if (!(g.share > 0.0)) continue;
        *(is_clear(s, g) ? &volumes[g.region].clear : &volumes[g.region].shared) += volume;
    }
}

/* The volume of a region by its cells differs a little from that inside the surface of the solids. So that no mass is lost, densities are multiplied by
 * the ratio: in the cells beside solids alone if that suffices, else in all of the region. */
static double density_factor(const ice *s, cell_gas g, const ice_gas_region_state *state, const region_volumes *volumes)
{
    if (!(g.share > 0.0)) return 1.0;
    const double all = state[g.region].volume, clear = volumes[g.region].clear, shared = volumes[g.region].shared;
    const double beside = (all - clear) / shared;
    if (!(beside > 1.0 / ICE_MOST_DENSITY_FACTOR && beside < ICE_MOST_DENSITY_FACTOR)) return all / (clear + shared);
    return is_clear(s, g) ? 1.0 : beside;
}

floe_status ice_quasi_static_fill(ice *s, const ice_quasi_static *r, const ice_gas_region_state *state)
{
    const int cells = (int)mesh_cells(s->mesh);
    region_volumes *volumes;
    TRY(memory_new(s->ctx, &volumes, (size_t)r->n, sizeof *volumes));
    measure_volumes(s, r, state, volumes);
    for (int k = 0; k < cells; ++k) {
        const cell_gas g = gas_of(s, r, state, k);
        set_gas_cell(s, r, k, state, g, density_factor(s, g, state, volumes));
    }
    memory_free(s->ctx, &volumes);
    return FLOE_OK;
}

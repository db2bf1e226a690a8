/* The first state beside embedded boundaries: what is open of a cell is filled by one gas of each side, or by fluids that share it (theory 7.5). */
#include "ice/start/ice_first_contents.h"
#include "ice/start/ice_start.h"

#include "ice/cut/ice_cut.h"
#include "ice/ice_constants.h"
#include "ice/state/ice_given.h"
#include "ice/state/ice_materials.h"
#include "scene/fluid_columns.h"

#include <math.h>
#include <string.h>

/* What a membrane leaves of a cell to each gas: its bodies, then the ambient where it is of that gas; without one, the
 * bodies' gas is as dense there as it is in its part of the cell. */
static floe_status fill_open(const ice *s, const int cell[3], const double lo[3], content *contents)
{
    double free = 1.0;
    TRY(ice_add_bodies(s, lo, &free, contents));
    for (int r = 0; r < s->n_materials; ++r) {
        const double open = ice_open_cell(s, ice_region_of(s, r)->number, CUT_NOW, cell);
        const bool ambient = s->scene->has_ambient && ice_material_of(s, s->scene->ambient_material) == r;
        content *c = &contents[r];
        if (open == 0.0) memset(c, 0, sizeof *c);
        if (ambient && c->fraction < open) TRY(ice_add_ambient(s, contents, open - c->fraction, lo));
    }
    return FLOE_OK;
}

/* Volume fractions of the fluids at a place, as ice_add_bodies has them of cells. False inside a solid. */
static bool find_fractions_at(const ice *s, const double x[3], double *fraction)
{
    const scene *given = s->scene;
    double free = 1.0;
    for (int b = 0; b < given->n_bodies; ++b)
        if (ice_material_of(s, given->body[b].material) < 0 && shape_inside(&given->body[b].shape, s->mesh->dim, x))
            return false;
    for (int pass = 0; pass < 2; ++pass)
        for (int b = 0; b < given->n_bodies; ++b) {
            const scene_body *body = &given->body[b];
            const int r = ice_material_of(s, body->material);
            if (r < 0 || body->yields != (pass == 1) || !shape_inside(&body->shape, s->mesh->dim, x)) continue;
            const double share = fmin(free, ice_share_at(given, body, x));
            fraction[r] += share;
            free -= share;
        }
    if (given->has_ambient) fraction[ice_material_of(s, given->ambient_material)] += free;
    return true;
}

/* Fractions in what solids leave open of a cell, by samples; false where none is there. */
static bool sample_fractions(const ice *s, const double lo[3], double *fraction)
{
    const int dim = s->mesh->dim, each = dim == 1 ? 64 : dim == 2 ? 16 : 8;
    int found = 0;
    for (int k = 0; k < (dim > 2 ? each : 1); ++k)
        for (int j = 0; j < (dim > 1 ? each : 1); ++j)
            for (int i = 0; i < each; ++i) {
                const int at[3] = {i, j, k};
                double x[3] = {0.0, 0.0, 0.0};
                for (int a = 0; a < dim; ++a) x[a] = lo[a] + (at[a] + 0.5) / each * s->mesh->h[a];
                found += find_fractions_at(s, x, fraction);
            }
    for (int r = 0; r < s->n_materials && found > 0; ++r) fraction[r] /= found;
    return found > 0;
}

static void scale_content(content *c, int dim, double factor)
{
    c->fraction *= factor;
    c->mass *= factor;
    c->energy *= factor;
    for (int a = 0; a < dim; ++a) c->momentum[a] *= factor;
}

/* The contents of a cell without solids, of volume one. */
static floe_status fill_whole(const ice *s, const int cell[3], content *contents)
{
    double lo[3] = {0.0, 0.0, 0.0}, sum = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) lo[a] = mesh_node(s->mesh, a, cell[a]);
    memset(contents, 0, (size_t)s->n_materials * sizeof *contents);
    TRY(ice_fill_cell(s, lo, 1.0, contents));
    for (int r = 0; r < s->n_materials; ++r) sum += contents[r].fraction;
    for (int r = 0; r < s->n_materials && sum > 0.0; ++r) scale_content(&contents[r], s->mesh->dim, 1.0 / sum);
    return FLOE_OK;
}

/* Goes to the cell beside, as high under gravity, of which more is open. False where there is none. */
static bool step_to_opener(const ice *s, int cell[3])
{
    const int region = s->region[0].number;
    int best[3] = {0, 0, 0};
    double most_open = ice_open_cell(s, region, CUT_NOW, cell);
    bool found = false;
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        int next[3] = {cell[0], cell[1], cell[2]};
        next[f / 2] += f % 2 == SIDE_UPPER ? 1 : -1;
        if (s->gravity[f / 2] != 0.0 || next[f / 2] < 0 || next[f / 2] >= s->mesh->n[f / 2]) continue;
        if (!(ice_open_face(s, region, CUT_NOW, cell, f / 2, f % 2) > 0.0)) continue;
        const double open = ice_open_cell(s, region, CUT_NOW, next);
        if (!(open > most_open)) continue;
        most_open = open;
        found = true;
        memcpy(best, next, sizeof best);
    }
    if (found) memcpy(cell, best, sizeof best);
    return found;
}

/* The whole cell beside a cut one, as high under gravity, a few cells away at most. */
static bool find_level(const ice *s, int cell[3])
{
    bool weight = false;
    for (int a = 0; a < s->mesh->dim; ++a) weight = weight || s->gravity[a] != 0.0;
    for (int step = 0; weight && step < 4; ++step) {
        if (!step_to_opener(s, cell)) return false;
        if (ice_open_cell(s, s->region[0].number, CUT_NOW, cell) == 1.0) return true;
    }
    return false;
}

static double largest_difference(const ice *s, const content *contents, const double *fraction)
{
    double most_off = 0.0;
    for (int r = 0; r < s->n_materials; ++r) most_off = fmax(most_off, fabs(contents[r].fraction - fraction[r]));
    return most_off;
}

/* Fluids that share a cut cell fill what is open of it as they would fill the whole cell, so that a level surface is level
 * to a wall, too; where the solid displaces one of them alone, as samples have it, or like the whole cell beside it. */
static floe_status fill_shared(const ice *s, const int cell[3], const double lo[3], content *contents)
{
    const double open = ice_open_cell(s, s->region[0].number, CUT_NOW, cell);
    double sampled[ICE_MAX_MATERIALS] = {0.0}, own[ICE_MAX_MATERIALS];
    content level[ICE_MAX_MATERIALS];
    int beside[3] = {cell[0], cell[1], cell[2]};
    if (open == 0.0) return FLOE_OK;
    TRY(fill_whole(s, cell, contents));
    if (open == 1.0) return FLOE_OK;
    const bool has_level = find_level(s, beside);
    for (int r = 0; r < s->n_materials; ++r) own[r] = contents[r].fraction;
    if (has_level) TRY(fill_whole(s, beside, level));
    if (has_level && largest_difference(s, level, own) < ICE_SAME_LEVEL) return FLOE_OK;
    if (!sample_fractions(s, lo, sampled)) return FLOE_OK;
    if (has_level && largest_difference(s, level, sampled) < ICE_SAMPLED_DIFFERENCE) {
        memcpy(contents, level, (size_t)s->n_materials * sizeof *contents);
        return FLOE_OK;
    }
    if (largest_difference(s, contents, sampled) < ICE_SAMPLED_DIFFERENCE) return FLOE_OK;
    for (int r = 0; r < s->n_materials; ++r)
        if (sampled[r] > 0.0 && !(own[r] > 0.0)) return FLOE_OK;
    for (int r = 0; r < s->n_materials; ++r)
        if (own[r] > 0.0) scale_content(&contents[r], s->mesh->dim, sampled[r] / own[r]);
    return FLOE_OK;
}

static void store_shared(const ice *s, const ice_view *v, const int cell[3], ptrdiff_t at, const content *contents)
{
    for (int r = 0; r < s->n_materials; ++r) v->m[r].open[at] = ice_open_cell(s, s->region[0].number, CUT_NOW, cell);
    ice_store_contents(s, v, at, contents);
}

/* Densities are of what is open. */
static void store_open(const ice *s, const ice_view *v, const int cell[3], ptrdiff_t at, content *contents)
{
    for (int r = 0; r < s->n_materials; ++r) {
        const double share = contents[r].fraction;
        v->m[r].open[at] = ice_open_cell(s, ice_region_of(s, r)->number, CUT_NOW, cell);
        contents[r].mass /= share > 0.0 ? share : 1.0;
        contents[r].energy /= share > 0.0 ? share : 1.0;
        contents[r].fraction = 1.0 / s->n_materials; /* stored as they are */
        for (int a = 0; a < MESH_MAX_DIM; ++a) contents[r].momentum[a] /= share > 0.0 ? share : 1.0;
    }
    ice_store_contents(s, v, at, contents);
}

static floe_status fill_open_cells(ice *s)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, -1, 0);
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v.b->n[0]; ++i) {
                const int j = ice_row_j(q, row), k = ice_row_k(q, row);
                const int cell[3] = {v.b->lo[0] + i, v.b->lo[1] + j, v.b->lo[2] + k};
                const double lo[3] = {mesh_node(s->mesh, 0, cell[0]), mesh_node(s->mesh, 1, cell[1]),
                                      s->mesh->dim > 2 ? mesh_node(s->mesh, 2, cell[2]) : 0.0};
                content contents[ICE_MAX_MATERIALS];
                memset(contents, 0, sizeof contents);
                if (v.multi) {
                    TRY(fill_shared(s, cell, lo, contents));
                    store_shared(s, &v, cell, mesh_index(v.b, i, j, k), contents);
                    continue;
                }
                TRY(fill_open(s, cell, lo, contents));
                store_open(s, &v, cell, mesh_index(v.b, i, j, k), contents);
            }
        if (v.multi) ice_guess_pressure(s, &v, field_get(s->domain->fields[id - 1], C_PRESSURE, 0, 0));
    }
    return FLOE_OK;
}

floe_status ice_cut_initialise(ice *s)
{
    TRY(fill_open_cells(s));
    TRY(ice_cut_merge_start(s));
    return scene_adds_weight(s->scene) ? ice_cut_hydrostatic(s) : FLOE_OK;
}

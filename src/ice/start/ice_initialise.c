/* The first state: fluids of bodies and of the ambient, cut by exact fractions; columns at rest under gravity. */
#include "ice/start/ice_start.h"

#include "base/memory.h"
#include "ice/ice_constants.h"
#include "ice/sealed/ice_sealed.h"
#include "ice/state/ice_cell_numbers.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "scene/formula.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

/* What one material brings into a cell, per cell volume. */
typedef struct content {
    double fraction, mass, momentum[3], energy;
} content;

static void add_content(content *c, int dim, double fraction, const fluid_state *state, const double *velocity)
{
    double square = 0.0;
    c->fraction += fraction;
    c->mass += fraction * state->density;
    for (int a = 0; a < dim; ++a) {
        c->momentum[a] += fraction * state->density * velocity[a];
        square += velocity[a] * velocity[a];
    }
    c->energy += fraction * state->density * (state->energy + 0.5 * square);
}

enum { AMBIENT = -1 /* in place of a body */ };

static floe_status state_at(const ice *s, int body, const double x[3], fluid_state *state, double velocity[3])
{
    if (body == AMBIENT) return ambient_fluid_state(s->scene, x, state, velocity);
    return body_fluid_state(s->scene, body, x, state, velocity);
}

/* Whether the first state of a body, or of the ambient, changes with place. */
static bool varies_by_place(const scene *s, int body)
{
    if (body != AMBIENT)
        return (s->body[body].initial_from_exact && s->initial) ||
               scene_varies(s, &s->body[body], sizeof s->body[body]);
    return scene_varies(s, &s->ambient_pressure, sizeof s->ambient_pressure) ||
           scene_varies(s, &s->ambient_temperature, sizeof s->ambient_temperature) ||
           scene_varies(s, s->ambient_velocity, sizeof s->ambient_velocity);
}

/* Three Gauss points an axis: the average of a smooth state to sixth order. */
static floe_status add_average(const ice *s, content *c, int body, double fraction, const double lo[3])
{
    static const double at[3] = {0.1127016653792583, 0.5, 0.8872983346207417},
                        weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const int dim = s->mesh->dim;
    for (int point = 0; point < (dim == 1 ? 3 : dim == 2 ? 9 : 27); ++point) {
        double x[3] = {0.0, 0.0, 0.0}, share = fraction, velocity[3];
        fluid_state state;
        for (int a = 0, rest = point; a < dim; ++a, rest /= 3) {
            x[a] = lo[a] + at[rest % 3] * s->mesh->h[a];
            share *= weight[rest % 3];
        }
        if (s->mesh->geometry == MESH_AXISYMMETRIC) share *= x[0] / (lo[0] + 0.5 * s->mesh->h[0]);
        TRY(state_at(s, body, x, &state, velocity));
        add_content(c, dim, share, &state, velocity);
    }
    return FLOE_OK;
}

static floe_status add_fluid(const ice *s, content *c, int body, double fraction, const double lo[3])
{
    double velocity[3];
    fluid_state state;
    if (varies_by_place(s->scene, body)) return add_average(s, c, body, fraction, lo);
    TRY(state_at(s, body, lo, &state, velocity));
    add_content(c, s->mesh->dim, fraction, &state, velocity);
    return FLOE_OK;
}

static floe_status add_ambient_content(const ice *s, content *contents, double free, const double lo[3])
{
    return add_fluid(s, &contents[ice_material_of(s, s->scene->ambient_material)], AMBIENT, free, lo);
}

/* Share of its shape's volume that a body takes at x; a formula's value is cut to 0 to 1. */
static double share_at(const scene *s, const scene_body *body, const double x[3])
{
    const expression *formula = scene_formula_of(s, &body->fraction);
    if (formula) return fmin(1.0, fmax(0.0, expression_value(formula, x, 0.0)));
    return body->fraction > 0.0 ? body->fraction : 1.0;
}

static double mean_share(const ice *s, const scene_body *body, const double lo[3], const double hi[3])
{
    const int each = 3, whole = s->mesh->dim == 1 ? 3 : s->mesh->dim == 2 ? 9 : 27;
    double sum = 0.0, x[3];
    if (!scene_formula_of(s->scene, &body->fraction)) return share_at(s->scene, body, lo);
    for (int i = 0; i < whole; ++i) {
        scene_sample_place(s->scene, lo, hi, each, i, x);
        sum += share_at(s->scene, body, x);
    }
    return sum / whole;
}

/* Share of a cell that a body takes. */
static double covered_by(const ice *s, const scene_body *body, const double lo[3])
{
    const bool radial = s->mesh->geometry == MESH_AXISYMMETRIC;
    double hi[3] = {0.0, 0.0, 0.0}, centroid[3];
    for (int a = 0; a < s->mesh->dim; ++a) hi[a] = lo[a] + s->mesh->h[a];
    const double inside = shape_fraction(&body->shape, s->mesh->dim, lo, hi, radial, 5, centroid);
    return (inside > 1.0 - 1e-12 ? 1.0 : inside) * mean_share(s, body, lo, hi);
}

/* The contents of one cell of the bodies that yield, or of those that do not, earlier bodies first; *left is the free
 * volume fraction. */
static floe_status add_bodies_that(const ice *s, bool yield, const double lo[3], double *left, content *contents)
{
    const scene *given = s->scene;
    double free = *left;
    for (int b = 0; b < given->n_bodies && free > 0.0; ++b) {
        const scene_body *body = &given->body[b];
        const int r = ice_material_of(s, body->material);
        if (r < 0 || s->material[r].points || body->yields != yield) continue;
        double fraction = covered_by(s, body, lo);
        if (fraction > free) fraction = free;
        if (!(fraction > 1e-12)) continue;
        free -= fraction;
        if (free < 1e-12) free = 0.0;
        TRY(add_fluid(s, &contents[r], b, fraction, lo));
    }
    *left = free;
    return FLOE_OK;
}

/* The rule of scene/layout.h. */
static floe_status add_bodies(const ice *s, const double lo[3], double *left, content *contents)
{
    TRY(add_bodies_that(s, false, lo, left, contents));
    return add_bodies_that(s, true, lo, left, contents);
}

/* The contents of one cell: bodies first, then the ambient in the free fraction. */
static floe_status fill_cell(const ice *s, const double lo[3], double free, content *contents)
{
    TRY(add_bodies(s, lo, &free, contents));
    return free > 0.0 && s->scene->has_ambient ? add_ambient_content(s, contents, free, lo) : FLOE_OK;
}

/* Share of a cell that is the ambient's: no body covers it, of fluid or of solid. */
static double ambient_share(const ice *s, const double lo[3])
{
    double left = s->scene->has_ambient ? 1.0 : 0.0;
    for (int b = 0; b < s->scene->n_bodies && left > 0.0; ++b) {
        const scene_body *body = &s->scene->body[b];
        if (ice_material_of(s, body->material) < 0) continue;
        left -= covered_by(s, body, lo);
    }
    return left > 1e-9 ? left : 0.0;
}

/* Fills the fraction `free` of a cell with the fluids of another cell, in their proportions. */
static floe_status add_like(const ice *s, const double lo[3], double free, content *contents)
{
    content like[ICE_MAX_MATERIALS];
    double left = 1.0, filled = 0.0;
    memset(like, 0, sizeof like);
    TRY(add_bodies(s, lo, &left, like));
    const double ambient = fmin(left, ambient_share(s, lo));
    if (ambient > 0.0) TRY(add_ambient_content(s, like, ambient, lo));
    for (int r = 0; r < s->n_materials; ++r) filled += like[r].fraction;
    for (int r = 0; r < s->n_materials && filled > 0.0; ++r) {
        content *c = &contents[r];
        const double share = free / filled;
        c->fraction += share * like[r].fraction;
        c->mass += share * like[r].mass;
        c->energy += share * like[r].energy;
        for (int a = 0; a < s->mesh->dim; ++a) c->momentum[a] += share * like[r].momentum[a];
    }
    return filled > 0.0 || !s->scene->has_ambient ? FLOE_OK : add_ambient_content(s, contents, free, lo);
}

/* A cell that a solid shares: what no fluid covers of it lies inside the solid, and is filled as the nearest cell outside, so
 * that a fluid has the mass and the momentum of its whole volume. */
static floe_status fill_beside(const ice *s, const double lo[3], double free, int nearest, content *contents)
{
    TRY(add_bodies(s, lo, &free, contents));
    const double ambient = fmin(free, ambient_share(s, lo));
    if (ambient > 0.0) TRY(add_ambient_content(s, contents, ambient, lo));
    free -= ambient;
    if (!(free > 0.0)) return FLOE_OK;
    int cell[MESH_MAX_DIM] = {0};
    double beside[3] = {0.0, 0.0, 0.0};
    if (nearest < 0) return s->scene->has_ambient ? add_ambient_content(s, contents, free, lo) : FLOE_OK;
    ice_numbered_cell(s->mesh, nearest, cell);
    for (int a = 0; a < s->mesh->dim; ++a) beside[a] = mesh_node(s->mesh, a, cell[a]);
    return add_like(s, beside, free, contents);
}

static void store_contents(const ice *s, const ice_view *v, ptrdiff_t at, const content *contents)
{
    double filled = 0.0;
    for (int r = 0; r < s->n_materials; ++r) filled += contents[r].fraction;
    for (int r = 0; r < s->n_materials; ++r) {
        if (s->material[r].points) continue;
        const ice_fluid *m = &v->m[r];
        const content *c = &contents[r];
        /* One fluid fills the cells; what a body cuts short of a cell is round-off. */
        const double share = v->multi ? 1.0 : filled;
        m->rho[at] = c->mass > 0.0 ? c->mass / share : 0.0;
        double square = 0.0;
        for (int a = 0; a < v->dim; ++a) {
            m->u[a][at] = c->mass > 0.0 ? c->momentum[a] / c->mass : 0.0;
            square += m->u[a][at] * m->u[a][at];
        }
        m->e[at] = c->mass > 0.0 ? c->energy / c->mass - 0.5 * square : 0.0;
        if (v->multi) m->vol[at] = c->mass > 0.0 ? c->fraction / c->mass : 0.0;
    }
}

/* Volume fraction that solids leave free in a cell. A cell that they almost fill gets no fluid, which would only absorb
 * their volume errors. */
static double fraction_beside(double taken)
{
    const double free = 1.0 - taken;
    return free < ICE_LEAST_FIRST_FRACTION ? 0.0 : free > 1.0 - 1e-12 ? 1.0 : free;
}

static floe_status initialise_block(const ice *s, const ice_view *v, const double *taken, const int *nearest)
{
    for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
        const double lo[3] = {mesh_node(s->mesh, 0, c.cell[0]), mesh_node(s->mesh, 1, c.cell[1]),
                              mesh_node(s->mesh, 2, c.cell[2])};
        content contents[ICE_MAX_MATERIALS];
        memset(contents, 0, sizeof contents);
        const double free = taken ? fraction_beside(taken[c.at]) : 1.0;
        TRY(nearest && free < 1.0 ? fill_beside(s, lo, free, nearest[ice_cell_number(s->mesh, c.cell)], contents)
                                  : fill_cell(s, lo, free, contents));
        double filled = free > 0.0 ? 0.0 : 1.0;
        for (int r = 0; r < s->n_materials; ++r) filled += contents[r].fraction;
        if (!(filled > 0.0)) {
            char place[160];
            ice_place(s, v->b, c.at, -1, place, sizeof place);
            return fail_key(
                s->ctx, KEY("ambient"),
                "%s at (%g, %g, %g) is empty: no body covers it; give an `ambient`, or a body of fluid there", place,
                lo[0], lo[1], lo[2]);
        }
        store_contents(s, v, c.at, contents);
    }
    return FLOE_OK;
}

/* The first guess at the equilibrium pressure: of any fluid in the cell by itself, else the ambient's, or the
 * reference. */
static void guess_pressure(const ice *s, const ice_view *v, double *p)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    for (int row = 0; row < q.n; ++row)
        for (int i = 0; i < v->b->n[0]; ++i) {
            const ptrdiff_t at = mesh_index(v->b, i, ice_row_j(q, row), ice_row_k(q, row));
            p[at] = s->scene->has_ambient ? s->scene->ambient_pressure : s->scene->reference_pressure;
            for (int r = 0; r < s->n_materials; ++r) {
                const ice_fluid *m = &v->m[r];
                if (s->material[r].points || !(m->rho[at] > 0.0)) continue;
                const double rho = v->multi ? 1.0 / m->vol[at] : m->rho[at];
                double c2;
                s->material[r].eos.model->pressure(s->material[r].eos.par, 1, &rho, &m->e[at], &p[at], &c2);
                break;
            }
        }
}

/* Specific volumes of solids at the first pressure, everywhere: the state that 2.10 carries on. */
static void start_solid_volumes(const ice *s, const ice_view *v, const double *p)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    for (int r = 0; r < s->n_materials; ++r) {
        if (!s->material[r].points) continue;
        const eos *law = &s->material[r].eos;
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v->b->n[0]; ++i) {
                const ptrdiff_t at = mesh_index(v->b, i, ice_row_j(q, row), ice_row_k(q, row));
                const double T = ICE_ANY_TEMPERATURE;
                double dvdp;
                law->model->volume(law->par, 1, &p[at], &T, &v->m[r].vol[at], &dvdp);
            }
    }
}

/* What a membrane leaves of a cell to each gas: its bodies, then the ambient where it is of that gas; without one, the
 * bodies' gas is as dense there as it is in its part of the cell. */
static floe_status fill_open(const ice *s, const int cell[3], const double lo[3], content *contents)
{
    double free = 1.0;
    TRY(add_bodies(s, lo, &free, contents));
    for (int r = 0; r < s->n_materials; ++r) {
        const double open = ice_open_cell(s, ice_region_of(s, r)->number, SEAL_NOW, cell);
        const bool ambient = s->scene->has_ambient && ice_material_of(s, s->scene->ambient_material) == r;
        content *c = &contents[r];
        if (open == 0.0) memset(c, 0, sizeof *c);
        if (ambient && c->fraction < open) TRY(add_ambient_content(s, contents, open - c->fraction, lo));
    }
    return FLOE_OK;
}

/* Volume fractions of the fluids at a place, as add_bodies has them of cells. False inside a solid. */
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
            const double share = fmin(free, share_at(given, body, x));
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
    TRY(fill_cell(s, lo, 1.0, contents));
    for (int r = 0; r < s->n_materials; ++r) sum += contents[r].fraction;
    for (int r = 0; r < s->n_materials && sum > 0.0; ++r) scale_content(&contents[r], s->mesh->dim, 1.0 / sum);
    return FLOE_OK;
}

/* Goes to the cell beside, as high under gravity, of which more is open. False where there is none. */
static bool step_to_opener(const ice *s, int cell[3])
{
    const int region = s->region[0].number;
    int best[3] = {0, 0, 0};
    double most_open = ice_open_cell(s, region, SEAL_NOW, cell);
    bool found = false;
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        int next[3] = {cell[0], cell[1], cell[2]};
        next[f / 2] += f % 2 == SIDE_UPPER ? 1 : -1;
        if (s->gravity[f / 2] != 0.0 || next[f / 2] < 0 || next[f / 2] >= s->mesh->n[f / 2]) continue;
        if (!(ice_open_face(s, region, SEAL_NOW, cell, f / 2, f % 2) > 0.0)) continue;
        const double open = ice_open_cell(s, region, SEAL_NOW, next);
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
        if (ice_open_cell(s, s->region[0].number, SEAL_NOW, cell) == 1.0) return true;
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
    const double open = ice_open_cell(s, s->region[0].number, SEAL_NOW, cell);
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
    for (int r = 0; r < s->n_materials; ++r) v->m[r].open[at] = ice_open_cell(s, s->region[0].number, SEAL_NOW, cell);
    store_contents(s, v, at, contents);
}

/* Densities are of what is open. */
static void store_open(const ice *s, const ice_view *v, const int cell[3], ptrdiff_t at, content *contents)
{
    for (int r = 0; r < s->n_materials; ++r) {
        const double share = contents[r].fraction;
        v->m[r].open[at] = ice_open_cell(s, ice_region_of(s, r)->number, SEAL_NOW, cell);
        contents[r].mass /= share > 0.0 ? share : 1.0;
        contents[r].energy /= share > 0.0 ? share : 1.0;
        contents[r].fraction = 1.0 / s->n_materials; /* stored as they are */
        for (int a = 0; a < MESH_MAX_DIM; ++a) contents[r].momentum[a] /= share > 0.0 ? share : 1.0;
    }
    store_contents(s, v, at, contents);
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
        if (v.multi) guess_pressure(s, &v, field_get(s->domain->fields[id - 1], C_PRESSURE, 0, 0));
    }
    return FLOE_OK;
}

static floe_status initialise_blocks(ice *s, double *const *taken, const int *nearest)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        TRY(initialise_block(s, &v, taken ? taken[v.b->id] : NULL, nearest));
        double *p = field_get(s->domain->fields[v.b->id], C_PRESSURE, 0, 0);
        guess_pressure(s, &v, p);
        if (v.multi) start_solid_volumes(s, &v, p);
    }
    return FLOE_OK;
}

floe_status ice_initialise(ice *s, double *const *taken)
{
    int *nearest = NULL;
    if (taken) TRY(ice_nearest_find(s, &nearest));
    const floe_status status = initialise_blocks(s, taken, nearest);
    memory_free(s->ctx, &nearest);
    return status == FLOE_OK ? ice_hydrostatic(s) : status;
}

floe_status ice_sealed_initialise(ice *s)
{
    TRY(fill_open_cells(s));
    TRY(ice_sealed_merge_start(s));
    return ice_asks_for_rest(s) ? ice_sealed_hydrostatic(s) : FLOE_OK;
}

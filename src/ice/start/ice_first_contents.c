#include "ice/start/ice_first_contents.h"

#include "ice/state/ice_cell_numbers.h"
#include "scene/formula.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

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

static floe_status add_initial_fluid(const ice *s, content *c, int body, double fraction, const double lo[3])
{
    double velocity[3];
    fluid_state state;
    if (varies_by_place(s->scene, body)) return add_average(s, c, body, fraction, lo);
    TRY(state_at(s, body, lo, &state, velocity));
    add_content(c, s->mesh->dim, fraction, &state, velocity);
    return FLOE_OK;
}

floe_status ice_add_ambient(const ice *s, content *contents, double free, const double lo[3])
{
    return add_initial_fluid(s, &contents[ice_material_of(s, s->scene->ambient_material)], AMBIENT, free, lo);
}

/* A formula's value is cut to 0 to 1. */
double ice_share_at(const scene *s, const scene_body *body, const double x[3])
{
    const expression *formula = scene_formula_of(s, &body->fraction);
    if (formula) return fmin(1.0, fmax(0.0, expression_value(formula, x, 0.0)));
    return body->fraction > 0.0 ? body->fraction : 1.0;
}

static double mean_share(const ice *s, const scene_body *body, const double lo[3], const double hi[3])
{
    const int each = 3, whole = s->mesh->dim == 1 ? 3 : s->mesh->dim == 2 ? 9 : 27;
    double sum = 0.0, x[3];
    if (!scene_formula_of(s->scene, &body->fraction)) return ice_share_at(s->scene, body, lo);
    for (int i = 0; i < whole; ++i) {
        scene_sample_place(s->scene, lo, hi, each, i, x);
        sum += ice_share_at(s->scene, body, x);
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
        TRY(add_initial_fluid(s, &contents[r], b, fraction, lo));
    }
    *left = free;
    return FLOE_OK;
}

floe_status ice_add_bodies(const ice *s, const double lo[3], double *left, content *contents)
{
    TRY(add_bodies_that(s, false, lo, left, contents));
    return add_bodies_that(s, true, lo, left, contents);
}

floe_status ice_fill_cell(const ice *s, const double lo[3], double free, content *contents)
{
    TRY(ice_add_bodies(s, lo, &free, contents));
    return free > 0.0 && s->scene->has_ambient ? ice_add_ambient(s, contents, free, lo) : FLOE_OK;
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
    TRY(ice_add_bodies(s, lo, &left, like));
    const double ambient = fmin(left, ambient_share(s, lo));
    if (ambient > 0.0) TRY(ice_add_ambient(s, like, ambient, lo));
    for (int r = 0; r < s->n_materials; ++r) filled += like[r].fraction;
    for (int r = 0; r < s->n_materials && filled > 0.0; ++r) {
        content *c = &contents[r];
        const double share = free / filled;
        c->fraction += share * like[r].fraction;
        c->mass += share * like[r].mass;
        c->energy += share * like[r].energy;
        for (int a = 0; a < s->mesh->dim; ++a) c->momentum[a] += share * like[r].momentum[a];
    }
    return filled > 0.0 || !s->scene->has_ambient ? FLOE_OK : ice_add_ambient(s, contents, free, lo);
}

floe_status ice_fill_beside(const ice *s, const double lo[3], double free, int nearest, content *contents)
{
    TRY(ice_add_bodies(s, lo, &free, contents));
    const double ambient = fmin(free, ambient_share(s, lo));
    if (ambient > 0.0) TRY(ice_add_ambient(s, contents, ambient, lo));
    free -= ambient;
    if (!(free > 0.0)) return FLOE_OK;
    int cell[MESH_MAX_DIM] = {0};
    double beside[3] = {0.0, 0.0, 0.0};
    if (nearest < 0) return s->scene->has_ambient ? ice_add_ambient(s, contents, free, lo) : FLOE_OK;
    ice_numbered_cell(s->mesh, nearest, cell);
    for (int a = 0; a < s->mesh->dim; ++a) beside[a] = mesh_node(s->mesh, a, cell[a]);
    return add_like(s, beside, free, contents);
}

void ice_store_contents(const ice *s, const ice_view *v, ptrdiff_t at, const content *contents)
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

void ice_guess_pressure(const ice *s, const ice_view *v, double *p)
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

#include "scene/formula.h"

#include "geom/bounds.h"
#include "scene/state.h"

#include <math.h>

static size_t place_in_scene(const scene *s, const void *number)
{
    return (size_t)((const char *)number - (const char *)s);
}

static const scene_formula *find_formula(const scene *s, const double *number)
{
    const size_t place = place_in_scene(s, number);
    for (int i = 0; i < s->n_formulas; ++i)
        if (s->formula[i].number == place) return &s->formula[i];
    return NULL;
}

const expression *scene_formula_of(const scene *s, const double *number)
{
    const scene_formula *found = find_formula(s, number);
    return found ? found->formula : NULL;
}

bool scene_varies(const scene *s, const void *part, size_t size)
{
    const size_t from = place_in_scene(s, part);
    for (int i = 0; i < s->n_formulas; ++i)
        if (s->formula[i].number >= from && s->formula[i].number < from + size) return true;
    return false;
}

bool scene_varies_in_time(const scene *s, const void *part, size_t size)
{
    const size_t from = place_in_scene(s, part);
    for (int i = 0; i < s->n_formulas; ++i)
        if (s->formula[i].number >= from && s->formula[i].number < from + size &&
            expression_has_time(s->formula[i].formula))
            return true;
    return false;
}

static floe_status refuse_value(const scene *s, const scene_formula *f, double value, const double x[3], double t)
{
    char expected[80];
    const param_spec rule = {.range = f->range, .lo = f->lo, .hi = f->hi};
    param_describe_range(&rule, expected, sizeof expected);
    return fail_key(s->ctx, f->path, "the formula gives %g at (%g, %g, %g)%s%g%s, and not %s", value, x[0], x[1], x[2],
                    " and t = ", t, scene_time_unit(s), expected);
}

floe_status scene_number(const scene *s, const double *number, const double x[3], double t, double *out)
{
    const scene_formula *f = s->n_formulas > 0 ? find_formula(s, number) : NULL;
    *out = f ? expression_value(f->formula, x, t) : *number;
    if (!f) return FLOE_OK;
    const param_spec rule = {.range = f->range, .lo = f->lo, .hi = f->hi};
    return param_in_range(&rule, *out) ? FLOE_OK : refuse_value(s, f, *out, x, t);
}

void scene_sample_place(const scene *s, const double lo[3], const double hi[3], int each, int number, double x[3])
{
    for (int a = 0; a < 3; ++a) {
        x[a] = a < s->mesh.dim ? lo[a] + (number % each + 0.5) / each * (hi[a] - lo[a]) : 0.0;
        if (a < s->mesh.dim) number /= each;
    }
}

/* In the middle of the domain, or where else it has a value. */
static double middle_value(const scene *s, const expression *formula)
{
    const int each = 5, whole = s->mesh.dim == 1 ? 5 : s->mesh.dim == 2 ? 25 : 125;
    double value = (double)NAN;
    for (int i = 0; i < whole && !isfinite(value); ++i) {
        double x[3];
        scene_sample_place(s, s->mesh.lower, s->mesh.upper, each, (whole / 2 + i) % whole, x);
        value = expression_value(formula, x, 0.0);
    }
    return value;
}

floe_status scene_add_formula(scene *s, double *number, expression *formula, const param_spec *rule,
                              const char *const *path)
{
    if (s->n_formulas == SCENE_MAX_FORMULAS) {
        expression_destroy(s->ctx, &formula);
        return fail_key(s->ctx, path, "there are more than %d formulas in the deck", SCENE_MAX_FORMULAS);
    }
    s->formula[s->n_formulas++] = (scene_formula){.number = place_in_scene(s, number),
                                                  .formula = formula,
                                                  .owned = true,
                                                  .range = rule->range,
                                                  .lo = rule->lo,
                                                  .hi = rule->hi,
                                                  .path = path};
    *number = middle_value(s, formula);
    return FLOE_OK;
}

floe_status scene_share_formula(scene *s, double *to, const double *from)
{
    const scene_formula *f = find_formula(s, from);
    if (!f) return FLOE_OK;
    if (s->n_formulas == SCENE_MAX_FORMULAS)
        return fail_key(s->ctx, f->path, "there are more than %d formulas in the deck", SCENE_MAX_FORMULAS);
    s->formula[s->n_formulas] = *f;
    s->formula[s->n_formulas].number = place_in_scene(s, to);
    s->formula[s->n_formulas++].owned = false;
    return FLOE_OK;
}

/* ---- first states, by samples ---- */

enum { SAMPLES_EACH = 9 };

typedef struct first_states {
    const scene *s;
    int body; /* -1: the ambient */
    double most_pressure;
} first_states;

static int sample_count(const scene *s)
{
    int n = 1;
    for (int a = 0; a < s->mesh.dim; ++a) n *= SAMPLES_EACH;
    return n;
}

/* The part of the domain that the body can be in. */
static void bounds_of(const scene *s, int body, double lo[3], double hi[3])
{
    const shape *part = body < 0 ? NULL : &s->body[body].shape;
    double from[3] = {0}, to[3] = {0};
    const bool bounded = part && shape_bounds(part, s->mesh.dim, from, to);
    for (int a = 0; a < 3; ++a) {
        lo[a] = bounded ? fmax(s->mesh.lower[a], from[a]) : s->mesh.lower[a];
        hi[a] = bounded ? fmin(s->mesh.upper[a], to[a]) : s->mesh.upper[a];
    }
}

static floe_status sample_first_states(first_states *w)
{
    const scene *s = w->s;
    double lo[3], hi[3];
    bounds_of(s, w->body, lo, hi);
    for (int i = 0; i < sample_count(s); ++i) {
        double x[3], velocity[3];
        fluid_state state;
        scene_sample_place(s, lo, hi, SAMPLES_EACH, i, x);
        if (w->body < 0)
            TRY(ambient_fluid_state(s, x, &state, velocity));
        else if (shape_inside(&s->body[w->body].shape, s->mesh.dim, x))
            TRY(body_fluid_state(s, w->body, x, &state, velocity));
        else
            continue;
        w->most_pressure = fmax(w->most_pressure, state.pressure);
    }
    return FLOE_OK;
}

double scene_largest_pressure(const scene *s, const scene_body *b)
{
    first_states w = {.s = s, .body = (int)(b - s->body), .most_pressure = (double)NAN};
    if (!scene_varies(s, b, sizeof *b) || b->initial_from_exact) return b->pressure;
    return sample_first_states(&w) == FLOE_OK ? w.most_pressure : b->pressure;
}

floe_status scene_check_first_states(const scene *s)
{
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_body *b = &s->body[k];
        if (b->initial_from_exact || b->material < 0 || s->material[b->material].kind != MATERIAL_FLUID) continue;
        if (scene_varies(s, b, sizeof *b)) TRY(sample_first_states(&(first_states){.s = s, .body = k}));
    }
    const bool varies = scene_formula_of(s, &s->ambient_pressure) || scene_formula_of(s, &s->ambient_temperature) ||
                        scene_varies(s, s->ambient_velocity, sizeof s->ambient_velocity);
    return s->has_ambient && varies ? sample_first_states(&(first_states){.s = s, .body = -1}) : FLOE_OK;
}

floe_status scene_check_formulas_in_time(const scene *s)
{
    const int samples = 200;
    for (int i = 0; i < s->n_formulas; ++i) {
        const scene_formula *f = &s->formula[i];
        if (!expression_has_time(f->formula) || expression_has_place(f->formula)) continue;
        for (int k = 0; k <= samples; ++k) {
            const double t = s->time.end * k / samples,
                         *number = (const double *)(const void *)((const char *)s + f->number);
            double value;
            TRY(scene_number(s, number, (const double[3]){0.0, 0.0, 0.0}, t, &value));
        }
    }
    return FLOE_OK;
}

void scene_free_formulas(scene *s)
{
    for (int i = 0; i < s->n_formulas; ++i)
        if (s->formula[i].owned) expression_destroy(s->ctx, &s->formula[i].formula);
    for (int i = 0; i < s->n_tables; ++i) value_table_destroy(s->ctx, &s->table[i].curve);
    s->n_formulas = s->n_tables = 0;
}

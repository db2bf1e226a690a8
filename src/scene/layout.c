#include "scene/layout.h"

#include "base/memory.h"
#include "scene/formula.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

_Static_assert((int)COMPOUND_MOST >= (int)SCENE_MAX_BODIES, "all bodies of a scene may be left out");

/* Common parts below this share of a cell, or of the smaller body, are round-off of surfaces in touch: of a ball in a ring
 * 2e-6 of a cell, and 2e-8 of the ball. */
static const double least_overlap = 1e-3, least_share = 1e-6;

typedef struct layout_work {
    const scene *s;
    const mesh *m;
    scene_coupling coupling;
    scene_layout *made; /* NULL until something differs from the deck */
} layout_work;

static bool is_fluid(const scene *s, int body)
{
    return s->material[s->body[body].material].kind == MATERIAL_FLUID;
}

static bool is_spread(const scene *s, int body)
{
    return s->body[body].fraction > 0.0 && s->body[body].fraction < 1.0;
}

/* ---- which of two bodies yields ---- */

/* Whether body a is left out where b is: fluids under solids; of two fluids, or of two solids, the one that `yields`,
 * else of fluids the later one. */
static bool yields_to(const scene *s, int a, int b)
{
    const bool fluid_a = is_fluid(s, a), fluid_b = is_fluid(s, b), gives = s->body[a].yields,
               takes = !s->body[b].yields;
    if (fluid_a != fluid_b) return fluid_a;
    if (gives == takes) return gives;
    return a > b && (fluid_a || gives);
}

static double common_volume(const layout_work *w, int a, int b)
{
    const mesh *m = w->m;
    return compound_common_volume(&w->s->body[a].shape, &w->s->body[b].shape, m->dim, m->lower, m->upper, m->h,
                                  m->geometry == MESH_AXISYMMETRIC);
}

static double volume_of(const layout_work *w, int body)
{
    const mesh *m = w->m;
    return compound_volume(&w->s->body[body].shape, m->dim, m->lower, m->upper, m->h, m->geometry == MESH_AXISYMMETRIC);
}

static bool bodies_overlap(const layout_work *w, int a, int b, double *volume)
{
    double cell = 1.0;
    for (int k = 0; k < w->m->dim; ++k) cell *= w->m->h[k];
    if (w->m->geometry == MESH_AXISYMMETRIC) cell *= 0.5 * (w->m->lower[0] + w->m->upper[0]);
    *volume = common_volume(w, a, b);
    return *volume > least_overlap * cell && *volume > least_share * fmin(volume_of(w, a), volume_of(w, b));
}

static floe_status refuse_overlap(const layout_work *w, int a, int b, double volume)
{
    static const char *const unit[] = {"", "m", "m2", "m3"};
    const scene *s = w->s;
    const bool radial = w->m->geometry == MESH_AXISYMMETRIC;
    const double smaller = fmin(volume_of(w, a), volume_of(w, b));
    return fail_key(s->ctx, KEY("bodies", s->body[b].name, "shape"),
                    "solid '%s' overlaps solid '%s' in %.3g %s (%.3g %% of the smaller of them): move one, or give the "
                    "one that is to be left out there 'yields: true'",
                    s->body[b].name, s->body[a].name, volume, radial ? "m3 per radian" : unit[w->m->dim],
                    100.0 * volume / smaller);
}

/* ---- shapes as they are filled ---- */

static floe_status begin_layout(layout_work *w)
{
    if (w->made) return FLOE_OK;
    TRY(memory_new(w->s->ctx, &w->made, 1, sizeof *w->made));
    w->made->scene = *w->s;
    w->made->deck = w->s;
    return FLOE_OK;
}

static floe_status subtract_later_bodies(layout_work *w, int body, int from)
{
    TRY(begin_layout(w));
    compound *part = &w->made->part[body];
    if (part->n == 0) part->whole = w->s->body[body].shape;
    part->less[part->n++] = w->s->body[from].shape;
    w->made->scene.body[body].shape = compound_shape(part);
    return FLOE_OK;
}

static floe_status lay_out_pair(layout_work *w, int a, int b)
{
    const scene *s = w->s;
    const bool solids = !is_fluid(s, a) && !is_fluid(s, b);
    double volume;
    /* In cells fluids share what solids and the fluids before them leave (ice_initialise.c). */
    if (!solids && w->coupling != COUPLING_MPM) return FLOE_OK;
    if (is_spread(s, a) || is_spread(s, b) || !bodies_overlap(w, a, b, &volume)) return FLOE_OK;
    if (yields_to(s, a, b)) return subtract_later_bodies(w, a, b);
    return yields_to(s, b, a) ? subtract_later_bodies(w, b, a) : refuse_overlap(w, a, b, volume);
}

static floe_status lay_out_bodies(layout_work *w)
{
    const scene *s = w->s;
    for (int b = 0; b < s->n_bodies && w->coupling != COUPLING_ICE; ++b)
        for (int a = 0; a < b; ++a)
            if (s->body[a].shape.model && s->body[b].shape.model) TRY(lay_out_pair(w, a, b));
    return FLOE_OK;
}

/* ---- the ambient as points ---- */

static double highest_pressure(const scene *s)
{
    double most = fabs(s->ambient_pressure);
    for (int b = 0; b < s->n_bodies; ++b)
        if (is_fluid(s, b))
            most = fmax(most, scene_largest_pressure(s, &s->body[b])); /* fmax: NAN where an exact solution gives it */
    return most;
}

/* Without points, the reference pressure stands for the ambient, which has no inertia then. */
static floe_status check_without_points(const scene *s)
{
    const double little = 1e-3, *v = s->ambient_velocity;
    if (scene_formula_of(s, &s->ambient_pressure))
        return fail_key(s->ctx, KEY("ambient", "points"),
                        "mpm: without points, the ambient is what acts as reference_pressure, and its own changes with "
                        "place: give it points");
    if (v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0 || scene_varies(s, v, sizeof s->ambient_velocity))
        return fail_key(s->ctx, KEY("ambient", "velocity"),
                        "mpm: without points the ambient is what acts as reference_pressure, and has no inertia: give "
                        "it points, or leave its velocity out");
    if (fabs(s->ambient_pressure - s->reference_pressure) <= little * highest_pressure(s)) return FLOE_OK;
    return fail_key(
        s->ctx, KEY("ambient", "points"),
        "mpm: without points, the ambient is what acts as reference_pressure (%g Pa), and its own is %g Pa: "
        "make them the same, or give it points",
        s->reference_pressure, s->ambient_pressure);
}

/* Some cell along a side is filled by the shape, in part. */
static bool reaches_side(const layout_work *w, const shape *rest, int axis, int end)
{
    const mesh *m = w->m;
    double lo[3], hi[3];
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = m->lower[a];
        hi[a] = m->upper[a];
    }
    if (end == SIDE_LOWER)
        hi[axis] = lo[axis] + m->h[axis];
    else
        lo[axis] = hi[axis] - m->h[axis];
    return compound_volume(rest, m->dim, lo, hi, m->h, false) > 0.0;
}

static floe_status check_ambient_sides(const layout_work *w, const shape *rest)
{
    const scene *s = w->s;
    for (int a = 0; a < w->m->dim; ++a)
        for (int i = 0; i < 2; ++i) {
            const bc_kind kind = s->bc.side[a][i].kind;
            if ((kind != BC_OUTLET && kind != BC_FREE) || !reaches_side(w, rest, a, i)) continue;
            return fail_key(s->ctx, KEY("boundaries", mesh_axis_name(w->m->geometry, a), i ? "upper" : "lower"),
                            "mpm: the ambient is of points, which leave through '%s' and do not come back: take 'slip' "
                            "or 'symmetry', 'ambient: {points: 0}' where its inertia does not matter, or ice-mpm",
                            bc_name(kind));
        }
    return FLOE_OK;
}

static floe_status name_ambient(const scene *s, char name[SCENE_NAME])
{
    (void)snprintf(name, SCENE_NAME, "ambient");
    for (int b = 0; b < s->n_bodies; ++b)
        if (strcmp(s->body[b].name, name) == 0)
            return fail_key(s->ctx, KEY("bodies", name),
                            "mpm: that is the name of the body that the ambient's points make: take another");
    return FLOE_OK;
}

/* Bodies that share faces leave round-off between them, of which no points are made (seed.c). */
static bool is_left(const mesh *m, const shape *rest)
{
    static const double trace = 1e-9;
    double whole = 1.0;
    for (int a = 0; a < m->dim; ++a) whole *= m->upper[a] - m->lower[a];
    return compound_volume(rest, m->dim, m->lower, m->upper, m->h, false) > trace * whole;
}

static floe_status add_ambient(layout_work *w)
{
    const scene *s = w->s;
    if (s->n_bodies == SCENE_MAX_BODIES)
        return fail_key(s->ctx, KEY("ambient"), "mpm: it is one body more than %d", SCENE_MAX_BODIES);
    TRY(begin_layout(w));
    scene *filled = &w->made->scene;
    compound *part = &w->made->part[s->n_bodies];
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].shape.model) part->less[part->n++] = s->body[b].shape;
    const shape rest = compound_shape(part);
    if (!is_left(w->m, &rest)) return FLOE_OK;
    TRY(check_ambient_sides(w, &rest));
    scene_body *b = &filled->body[filled->n_bodies];
    *b = (scene_body){.material = s->ambient_material,
                      .shape = rest,
                      .pressure = s->ambient_pressure,
                      .temperature = s->ambient_temperature,
                      .density = NAN,
                      .seeding = SEED_FITTED,
                      .merge = 0.3,
                      .membrane = {.length = NAN, .heavy_mass = NAN, .encloses = -1}};
    for (int a = 0; a < MESH_MAX_DIM; ++a) b->per_cell[a] = a < w->m->dim ? s->ambient_points : 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) b->velocity[a] = s->ambient_velocity[a];
    filled->n_bodies++;
    TRY(scene_share_formula(filled, &b->pressure, &filled->ambient_pressure));
    TRY(scene_share_formula(filled, &b->temperature, &filled->ambient_temperature));
    for (int a = 0; a < w->m->dim; ++a) TRY(scene_share_formula(filled, &b->velocity[a], &filled->ambient_velocity[a]));
    return name_ambient(s, b->name);
}

floe_status scene_lay_out(scene_layout **out, const scene *s, scene_coupling coupling, const mesh *m)
{
    layout_work w = {.s = s, .m = m, .coupling = coupling};
    floe_status status = lay_out_bodies(&w);
    if (status == FLOE_OK && coupling == COUPLING_MPM && s->has_ambient)
        status = s->ambient_points > 0 ? add_ambient(&w) : check_without_points(s);
    if (status != FLOE_OK) memory_free(s->ctx, &w.made);
    *out = w.made;
    return status;
}

#include "deck/check/check.h"

#include "deck/deck_internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

deck_node *node_path(deck_node *root, const char *const *key)
{
    while (root && *key) root = node_find(root, *key++);
    return root;
}

deck_node *nearest_path(deck_node *root, const char *const *key)
{
    for (; *key; key++) {
        deck_node *child = node_find(root, *key);
        if (!child) break;
        root = child;
    }
    return root;
}

bool is_clean(deck_node *root, const char *const *key)
{
    const deck_node *node = node_path(root, key);
    return node && !node->bad;
}

/* At the value if the node is what was looked for, else at its key. */
static floe_status enter_error(reader *r, deck_node *node, bool found, const char *expected, const char *hint,
                               const char *message)
{
    const bool at_value = found && node->kind != NODE_MAP;
    for (deck_node *n = node; n; n = n->parent) n->bad = true;
    return error_add(r->errors, at_value ? node->at : node->key_at, expected, hint, "%s", message);
}

floe_status bad_at(reader *r, const char *const *path, const char *expected, const char *hint, const char *format, ...)
{
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    deck_node *node = node_path(r->root, path);
    const bool found = node != NULL;
    if (!node) node = nearest_path(r->root, path);
    if (!node) return fail(r->ctx, FLOE_INTERNAL, "a deck without a root was checked: %s", message);
    return enter_error(r, node, found, expected, hint, message);
}

floe_status take_refusal(reader *r, floe_status status)
{
    char message[400];
    if (status != FLOE_BAD_INPUT) return status;
    deck_node *node = r->root;
    const char *path = context_key(r->ctx);
    for (size_t length; *path; path += length + (path[length] == '.')) {
        deck_node *child = node->kind == NODE_MAP ? node_match(node, path, &length) : NULL;
        if (!child) break;
        node = child;
    }
    const bool found = *path == '\0';
    snprintf(message, sizeof message, "%s", context_message(r->ctx));
    context_clear(r->ctx);
    return enter_error(r, node, found, NULL, NULL, message);
}

bool scene_runs_as(const scene *s, scene_coupling coupling)
{
    for (int i = 0; i < s->n_runs_as; i++) {
        if (s->runs_as[i] == coupling) return true;
    }
    return false;
}

static bool scene_has_solids(const scene *s)
{
    for (int i = 0; i < s->n_bodies; i++) {
        const int m = s->body[i].material;
        if (m >= 0 && s->material[m].kind == MATERIAL_SOLID) return true;
    }
    return false;
}

/* ---- mesh ---- */

static floe_status check_extent(reader *r, bool *ok)
{
    const mesh_spec *spec = &r->scene->mesh;
    for (int axis = 0; axis < spec->dim; axis++) {
        if (spec->upper[axis] > spec->lower[axis]) continue;
        *ok = false;
        TRY(bad_at(r, KEY("domain", "upper"), "a corner above 'lower' along every axis", NULL,
                   "the domain is empty along %s: from %g to %g", axis_name(spec, axis), spec->lower[axis],
                   spec->upper[axis]));
    }
    return FLOE_OK;
}

static floe_status check_mesh(reader *r)
{
    const mesh_spec *spec = &r->scene->mesh;
    bool ok = true;
    if (!is_clean(r->root, KEY("domain"))) return FLOE_OK;
    if (spec->geometry == MESH_AXISYMMETRIC && spec->dim != 2) {
        return bad_at(r, KEY("domain", "geometry"), "dim: 2", NULL, "an axisymmetric scene has 2 dimensions, not %d",
                      spec->dim);
    }
    if (spec->geometry == MESH_AXISYMMETRIC && spec->lower[0] < 0.0) {
        return bad_at(r, KEY("domain", "lower"), "a radius >= 0", NULL, "the domain begins at radius %g",
                      spec->lower[0]);
    }
    TRY(check_extent(r, &ok));
    if (!ok) return FLOE_OK;
    mesh made;
    return take_refusal(r, mesh_init(&made, r->ctx, spec));
}

/* ---- couplings ---- */

/* Where a coupling was asked for: its entry in runs_as, or `coupling`. */
static deck_node *coupling_node(reader *r, scene_coupling coupling)
{
    deck_node *list = node_find(r->root, "runs_as");
    for (deck_node *item = list ? list->first : NULL; item; item = item->next) {
        if (strcmp(item->text, coupling_name(coupling)) == 0) return item;
    }
    return node_find(r->root, "coupling");
}

static int find_solid_body(const scene *s)
{
    for (int i = 0; i < s->n_bodies; i++) {
        if (s->body[i].material >= 0 && s->material[s->body[i].material].kind == MATERIAL_SOLID) return i;
    }
    return -1;
}

static floe_status check_coupled_phases(reader *r, scene_coupling coupling)
{
    const scene *s = r->scene;
    deck_node *node = coupling_node(r, coupling);
    if (!node) return FLOE_OK;
    const int solid = find_solid_body(s);
    if (coupling == COUPLING_ICE && solid >= 0) {
        return bad(r, node, "mpm or ice-mpm", "'ice' has no solids, and body '%s' is one", s->body[solid].name);
    }
    if (coupling == COUPLING_ICE_MPM && scene_enclosing_body(s) < 0 && !node_find(r->root, "ambient")) {
        return bad(r, node, "ambient: {material: ..., pressure: ..., temperature: ...}",
                   "'ice-mpm' needs to know what surrounds the bodies: 'ambient' is missing");
    }
    const deck_node *bodies = node_find(r->root, "bodies");
    if (bodies && bodies->bad) return FLOE_OK; /* there may be more than could be read */
    if (coupling == COUPLING_MPM && s->n_bodies == 0) return bad(r, node, "bodies: {...}", "'mpm' needs a body");
    if (s->n_bodies == 0 && !s->has_ambient) return bad(r, node, "bodies: {...}", "the scene is empty");
    return FLOE_OK;
}

static floe_status check_couplings(reader *r)
{
    const scene *s = r->scene;
    deck_node *list = node_find(r->root, "runs_as");
    if ((list && list->bad) || !is_clean(r->root, KEY("coupling"))) return FLOE_OK;
    if (!scene_runs_as(s, s->coupling)) {
        return bad_at(r, KEY("coupling"), "a coupling that 'runs_as' lists", NULL, "'runs_as' does not list '%s'",
                      coupling_name(s->coupling));
    }
    for (int i = 0; i < s->n_runs_as; i++) TRY(check_coupled_phases(r, s->runs_as[i]));
    return FLOE_OK;
}

/* ---- ambient, time ---- */

/* A time over the interval has a fraction that tells to 1e-9 whether a snapshot is due (run/schedule.c); of more it would be round-off. */
#define SNAPSHOTS_MOST 1e6

static floe_status check_ambient(reader *r)
{
    const scene *s = r->scene;
    if (!is_clean(r->root, KEY("ambient"))) return FLOE_OK;
    const scene_material *m = &s->material[s->ambient_material];
    if (m->kind != MATERIAL_FLUID) {
        return bad_at(r, KEY("ambient", "material"), "the name of a fluid", NULL, "'%s' is a solid", m->name);
    }
    if (!m->eos.model || s->ambient_pressure > m->eos.model->pressure_floor(m->eos.par)) return FLOE_OK;
    return bad_at(r, KEY("ambient", "pressure"), NULL, NULL,
                  "'%s' does not exist at %g Pa: its pressure is above %g Pa. Give the absolute one", m->name,
                  s->ambient_pressure, m->eos.model->pressure_floor(m->eos.par));
}

static floe_status check_time(reader *r)
{
    const scene *s = r->scene;
    const scene_time *time = &s->time;
    if (is_clean(r->root, KEY("time")) && time->first_step > time->max_step) {
        TRY(bad_at(r, KEY("time", "first_step"), "at most max_step", NULL,
                   "the first step (%g s) is above max_step (%g s)", time->first_step, time->max_step));
    }
    if (is_clean(r->root, KEY("time")) && is_clean(r->root, KEY("output")) &&
        s->output.interval < time->end / SNAPSHOTS_MOST) {
        TRY(bad_at(r, KEY("output", "interval"), "a millionth of time.end at least",
                   "rows of history.csv can be as dense as steps: output.history_interval",
                   "a snapshot every %g%s: %.3g until %g%s are too many for a run to meet their times",
                   s->output.interval, scene_time_unit(s), time->end / s->output.interval, time->end,
                   scene_time_unit(s)));
    }
    if (is_clean(r->root, KEY("damping")) && !(s->damping.end > s->damping.start)) {
        TRY(bad_at(r, KEY("damping", "end"), "a time after 'start'", NULL,
                   "damping ends (%g s) before it starts (%g s)", s->damping.end, s->damping.start));
    }
    if (is_clean(r->root, KEY("stop")) && is_clean(r->root, KEY("bodies")) && !scene_has_solids(s)) {
        TRY(bad_at(r, KEY("stop"), NULL, NULL, "'stop' waits for solids to come to rest, and the scene has none"));
    }
    return FLOE_OK;
}

/* What points lose is known of blends of FLIP and PIC in which they keep some of their own velocity. */
static floe_status check_losses(reader *r)
{
    const scene_method *m = &r->scene->method;
    if (m->losses != LOSSES_HEAT) return FLOE_OK;
    if (strcmp(m->transfer, "flip") != 0 && is_clean(r->root, KEY("method", "transfer")))
        return bad_at(r, KEY("method", "transfer"), "flip, as method.losses is heat", NULL,
                      "what transfer '%s' loses is not known", m->transfer);
    if (m->flip > 0.0 || !is_clean(r->root, KEY("method", "flip"))) return FLOE_OK;
    return bad_at(r, KEY("method", "flip"), "a number above 0, as method.losses is heat", NULL,
                  "points with flip 0 forget what they lose");
}

floe_status check_scene(reader *r)
{
    TRY(check_mesh(r));
    TRY(check_boundaries(r));
    TRY(check_couplings(r));
    TRY(check_ambient(r));
    TRY(check_time(r));
    TRY(check_bodies(r));
    TRY(check_loads(r));
    TRY(check_sources(r));
    TRY(check_losses(r));
    TRY(check_contact(r));
    TRY(check_reactions(r));
    return check_verify(r);
}

/* bodies.NAME.motion: fixed, rigid, {rigid: {spin: ...}}, {velocity: ..., spin: ..., about: ..., axis: ...}, or a table in time. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- lists of any length ---- */

static const key_spec time_number = {.key = "times", .type = KEY_NUMBER, .unit = "s"};
static const key_spec spin_number = {.key = "spins", .type = KEY_NUMBER, .unit = "1/s"};
static const key_spec velocity_number = {.key = "velocities", .type = KEY_NUMBER, .unit = "m/s"};

static floe_status check_list(reader *r, const key_spec *key, deck_node *node)
{
    if (node->kind != NODE_LIST || node->n == 0) return bad(r, node, key->special->form, "'%s' is no list", key->key);
    if (node->n > MOTION_MAX_KNOTS)
        return bad(r, node, NULL, "'%s' has more than %d entries", key->key, MOTION_MAX_KNOTS);
    return FLOE_OK;
}

static floe_status read_times(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_motion *m = base;
    if (!node) return FLOE_OK;
    TRY(check_list(r, key, node));
    m->table = true;
    for (deck_node *item = node->first; item && !node->bad; item = item->next) {
        TRY(read_number(r, &time_number, item, &m->time[m->n]));
        if (m->n > 0 && !(m->time[m->n] > m->time[m->n - 1]))
            TRY(bad(r, item, NULL, "each time must be later than the one before it"));
        m->n++;
    }
    return FLOE_OK;
}

static floe_status read_one_velocity(reader *r, deck_node *item, double *v)
{
    const size_t dim = (size_t)r->scene->mesh.dim;
    if (item->kind == NODE_SCALAR && dim == 1) return read_number(r, &velocity_number, item, &v[0]);
    if (item->kind != NODE_LIST || item->n != dim)
        return bad(r, item, "a list with a number for each axis", "this is no velocity of the scene");
    for (deck_node *x = item->first; x; x = x->next) TRY(read_number(r, &velocity_number, x, v++));
    return FLOE_OK;
}

static floe_status read_one_spin(reader *r, deck_node *item, double *w)
{
    return read_number(r, &spin_number, item, w);
}

/* A list with an entry for each of the times. */
typedef struct timed_list {
    const char *expected, *entries; /* in messages: what the list should be, and what its entries are */
    floe_status (*read)(reader *r, deck_node *item, double *value);
    double *value;
    int stride; /* numbers from entry to entry */
} timed_list;

static floe_status read_timed(reader *r, const key_spec *key, deck_node *node, int times, const timed_list *list)
{
    int n = 0;
    if (!node) return FLOE_OK;
    TRY(check_list(r, key, node));
    for (deck_node *item = node->first; item && !node->bad; item = item->next)
        TRY(list->read(r, item, list->value + (ptrdiff_t)list->stride * n++));
    if (node->bad || n == times) return FLOE_OK;
    return bad(r, node, list->expected, "there are %d %s and %d times", n, list->entries, times);
}

static floe_status read_spins(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_motion *m = base;
    return read_timed(r, key, node, m->n,
                      &(timed_list){"a spin for each of the times", "spins", read_one_spin, m->spin, 1});
}

static floe_status read_velocities(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_motion *m = base;
    return read_timed(
        r, key, node, m->n,
        &(timed_list){"a velocity for each of the times", "velocities", read_one_velocity, m->velocity[0], 3});
}

static void write_numbers(writer *w, const char *key, const scene_motion *m, int dim, const double *value, int stride)
{
    if (!m->table) return;
    write_key_name(w, key);
    for (int k = 0; k < m->n; k++) {
        strbuf_append(&w->out, "%s%s", k == 0 ? " [" : ", ", dim > 1 ? "[" : "");
        for (int a = 0; a < dim; a++) {
            strbuf_append(&w->out, "%s", a == 0 ? "" : ", ");
            write_number(&w->out, value[stride * k + a]);
        }
        strbuf_append(&w->out, "%s", dim > 1 ? "]" : "");
    }
    strbuf_append(&w->out, "]\n");
}

static void write_times(writer *w, const key_spec *key, const void *base)
{
    const scene_motion *m = base;
    write_numbers(w, key->key, m, 1, m->time, 1);
}

static void write_velocities(writer *w, const key_spec *key, const void *base)
{
    const scene_motion *m = base;
    write_numbers(w, key->key, m, w->scene->mesh.dim, m->velocity[0], 3);
}

static void write_spins(writer *w, const key_spec *key, const void *base)
{
    const scene_motion *m = base;
    write_numbers(w, key->key, m, 1, m->spin, 1);
}

#define LIST_JSON "{\"type\": \"array\", \"minItems\": 1}"
static const special_key special_times = {
    .read = read_times, .write = write_times, .form = "a list of times, [t, t, ...] (s)", .json = LIST_JSON};
static const special_key special_velocities = {.read = read_velocities,
                                               .write = write_velocities,
                                               .form = "a list of velocities, [[u, v], [u, v], ...] (m/s)",
                                               .json = LIST_JSON};
static const special_key special_spins = {
    .read = read_spins, .write = write_spins, .form = "a list of spins, [w, w, ...] (1/s)", .json = LIST_JSON};

/* ---- a prescribed motion ---- */

static bool is_steady(const scene *s, const void *base)
{
    (void)s;
    return !((const scene_motion *)base)->table;
}

/* Times go first: the other lists are as long. */
static const key_spec driven_keys[] = {
    {"times", KEY_SPECIAL, .special = &special_times},
    {"velocities", KEY_SPECIAL, .special = &special_velocities},
    {"spins", KEY_SPECIAL, .special = &special_spins},
    {"velocity", KEY_VECTOR, "m/s", AT(scene_motion, velocity[0]), .applies = is_steady,
     .belongs = "motions without times"},
    {"spin", KEY_NUMBER, "1/s", AT(scene_motion, spin[0]), .applies = is_steady, .belongs = "motions without times"},
    {"about", KEY_VECTOR, "m", AT(scene_motion, about)},
    {"axis", KEY_VECTOR, NULL, AT(scene_motion, axis)},
};
static const key_table driven_table = TABLE(driven_keys);

static bool is_flat(const scene *s, const void *base)
{
    (void)base;
    return s->mesh.dim < 3;
}

static bool is_space(const scene *s, const void *base)
{
    return !is_flat(s, base);
}

static const key_spec turning_keys[] = {
    {"spin", KEY_NUMBER, "1/s", AT(scene_motion, turning[2]), .applies = is_flat, .belongs = "scenes in the plane"},
};
static const key_table turning_table = TABLE(turning_keys);
static const key_spec space_keys[] = {
    {"spin", KEY_VECTOR, "1/s", AT(scene_motion, turning), .applies = is_space, .belongs = "scenes in space"},
};
static const key_table space_table = TABLE(space_keys);
static const key_spec rigid_keys[] = {{"rigid", KEY_MAP, .table = &turning_table}};
static const key_table rigid_table = TABLE(rigid_keys);
static const key_spec rigid_space_keys[] = {{"rigid", KEY_MAP, .table = &space_table}};
static const key_table rigid_space_table = TABLE(rigid_space_keys);

static const key_table *table_of_rigid(const scene *s)
{
    return s->mesh.dim == 3 ? &rigid_space_table : &rigid_table;
}

/* What a prescribed motion needs to be one. */
static floe_status check_driven(reader *r, deck_node *node, const scene_motion *m)
{
    const bool turns = node_find(node, "spin") || node_find(node, "spins"), space = r->scene->mesh.dim == 3;
    if ((node_find(node, "velocities") || node_find(node, "spins")) && !m->table)
        return bad_key(r, node, "times: [...]", NULL, "a table of a motion has no times");
    if (turns && !node_find(node, "about"))
        return bad_key(r, node, "about: the point about which it turns, at the start", NULL,
                       "a body turns about no point");
    if (turns && space && !node_find(node, "axis"))
        return bad_key(r, node, "axis: a vector along the axis of the spin", NULL,
                       "a body in space turns about no axis");
    if (node_find(node, "axis") && !(m->axis[0] != 0.0 || m->axis[1] != 0.0 || m->axis[2] != 0.0))
        return bad_key(r, node_find(node, "axis"), "a vector", NULL, "the axis has no direction");
    if (node_find(node, "axis") && !space)
        return bad_key(r, node_find(node, "axis"), "leave it out", NULL, "in the plane a body turns in the plane");
    return FLOE_OK;
}

static floe_status read_motion(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_motion *m = (scene_motion *)(void *)((char *)base + key->offset);
    *m = (scene_motion){.about = {NAN, NAN, NAN}, .axis = {0.0, 0.0, 1.0}};
    if (!node) return FLOE_OK;
    if (node_is_word(node, "fixed")) {
        m->kind = MOTION_FIXED;
        return FLOE_OK;
    }
    if (node_is_word(node, "rigid")) {
        m->kind = MOTION_RIGID;
        return FLOE_OK;
    }
    if (node->kind != NODE_MAP) return bad(r, node, special_motion.form, "'%s' is none of the motions", key->key);
    if (node_find(node, "rigid")) {
        m->kind = MOTION_RIGID;
        return read_table(r, table_of_rigid(r->scene), node, m);
    }
    m->kind = MOTION_DRIVEN;
    TRY(read_table(r, &driven_table, node, m));
    if (!m->table) m->n = 1;
    for (int a = r->scene->mesh.dim; a < 3 && !isnan(m->about[0]); a++) m->about[a] = 0.0;
    return node->bad ? FLOE_OK : check_driven(r, node, m);
}

static void write_point(writer *w, const char *key, const double *x)
{
    write_key_name(w, key);
    strbuf_append(&w->out, " [");
    for (int a = 0; a < w->scene->mesh.dim; a++) {
        strbuf_append(&w->out, "%s", a == 0 ? "" : ", ");
        write_number(&w->out, x[a]);
    }
    strbuf_append(&w->out, "]\n");
}

static bool is_turned(const scene_motion *m)
{
    bool turned = false;
    for (int k = 0; k < m->n; k++) turned = turned || m->spin[k] != 0.0;
    return turned;
}

static void write_driven(writer *w, const scene_motion *m)
{
    if (m->table) {
        write_times(w, &driven_keys[0], m);
        write_velocities(w, &driven_keys[1], m);
        if (is_turned(m)) write_spins(w, &driven_keys[2], m);
    } else {
        write_point(w, "velocity", m->velocity[0]);
        if (is_turned(m)) {
            write_key_name(w, "spin");
            strbuf_append(&w->out, " ");
            write_number(&w->out, m->spin[0]);
            strbuf_append(&w->out, "\n");
        }
    }
    if (!isnan(m->about[0])) write_point(w, "about", m->about);
    if (is_turned(m) && w->scene->mesh.dim == 3) write_point(w, "axis", m->axis);
}

static void write_motion(writer *w, const key_spec *key, const void *base)
{
    const scene_motion *m = (const scene_motion *)(const void *)((const char *)base + key->offset);
    const bool turning = m->turning[0] != 0.0 || m->turning[1] != 0.0 || m->turning[2] != 0.0;
    if (m->kind == MOTION_BY_LAW) return;
    write_key_name(w, key->key);
    if (m->kind == MOTION_FIXED || (m->kind == MOTION_RIGID && !turning)) {
        strbuf_append(&w->out, m->kind == MOTION_FIXED ? " fixed\n" : " rigid\n");
        return;
    }
    strbuf_append(&w->out, "\n");
    w->indent++;
    if (m->kind == MOTION_RIGID)
        write_table(w, table_of_rigid(w->scene), m);
    else
        write_driven(w, m);
    w->indent--;
}

const special_key special_motion = {
    .read = read_motion,
    .write = write_motion,
    .form =
        "fixed; rigid, or {rigid: {spin: w}}; {velocity: [u, v], spin: w, about: [x, y], axis: [a, b, c]}; or {times: "
        "[t, t, ...], velocities: [[u, v], ...], spins: [w, ...], about: ..., axis: ...}",
    .json = "{\"anyOf\": [{\"enum\": [\"fixed\", \"rigid\"]}, {\"type\": \"object\"}]}",
};

/* Keys of `compare`, `study` and `stability`: axes and quantities. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A value as text on one line, as --set takes it. */
static void append_flow(strbuf *out, const deck_node *node)
{
    if (node->kind == NODE_SCALAR) {
        if (node->quoted)
            write_quoted(out, node->text);
        else
            strbuf_append(out, "%s", node->text);
        return;
    }
    strbuf_append(out, node->kind == NODE_LIST ? "[" : "{");
    for (const deck_node *child = node->first; child; child = child->next) {
        if (child != node->first) strbuf_append(out, ", ");
        if (node->kind == NODE_MAP) strbuf_append(out, "%s: ", child->key);
        append_flow(out, child);
    }
    strbuf_append(out, node->kind == NODE_LIST ? "]" : "}");
}

floe_status read_setting(reader *r, deck_node *node, char value[SCENE_VALUE])
{
    strbuf text = {.ctx = r->ctx};
    if (node_is_null(node)) return bad(r, node, "a value of the key", "an empty value");
    if (node->kind == NODE_SCALAR)
        strbuf_append(&text, "%s", node->text);
    else
        append_flow(&text, node);
    const bool fits = text.length < SCENE_VALUE;
    snprintf(value, SCENE_VALUE, "%s", text.data ? text.data : "");
    const floe_status status = text.status;
    strbuf_free(&text);
    TRY(status);
    return fits ? FLOE_OK : bad(r, node, NULL, "a value longer than %d characters", SCENE_VALUE - 1);
}

/* ---- compare.axis: {domain.cell: [0.1, 0.05]}; study.axes: {domain.cell: [0.1, 0.05], coupling: [mpm, ice-mpm]}; with
 * keys that change along: {domain.cell: {values: [0.1, 0.05], with: {bodies.string.membrane.number: [40, 80]}}} ---- */

static floe_status check_value(reader *r, deck_node *item, const scene_axis *axis)
{
    const int last = axis->n_values - 1;
    for (int i = 0; i < last; i++) {
        if (strcmp(axis->value[i], axis->value[last]) == 0)
            return bad(r, item, NULL, "the value '%s' of '%s' is listed twice", axis->value[i], axis->key);
    }
    return FLOE_OK;
}

static floe_status read_axis_key(reader *r, deck_node *node, char key[SCENE_KEY])
{
    if (strlen(node->key) >= SCENE_KEY) return bad_key(r, node, NULL, NULL, "the key is too long");
    snprintf(key, SCENE_KEY, "%s", node->key);
    return FLOE_OK;
}

/* A value of an axis, or of what changes along with it: null takes the key away, as --set does. */
static floe_status read_pick(reader *r, deck_node *item, char value[SCENE_VALUE])
{
    if (!node_is_null(item)) return read_setting(r, item, value);
    snprintf(value, SCENE_VALUE, "null");
    if (item->text[0] != '\0') return FLOE_OK;
    return bad(r, item, "a value of the key, or null, which takes the key away", "a value of the list is empty");
}

/* "[0.1, 0.05]" under the axis' key, or under "values". */
static floe_status read_axis_values(reader *r, deck_node *list, scene_axis *axis)
{
    if (list->kind != NODE_LIST || list->n == 0)
        return bad(r, list, "a list of values: [0.1, 0.05]", "the axis '%.80s' has no list of values", axis->key);
    if (list->n > SCENE_MAX_AXIS) return bad(r, list, NULL, "more than %d values", SCENE_MAX_AXIS);
    for (deck_node *item = list->first; item; item = item->next) {
        TRY(read_pick(r, item, axis->value[axis->n_values++]));
        TRY(check_value(r, item, axis));
    }
    return FLOE_OK;
}

/* "with": as many values of each key as the axis has. */
static floe_status read_with_values(reader *r, deck_node *node, scene_axis *axis)
{
    if (!node) return FLOE_OK;
    if (node->kind != NODE_MAP)
        return bad(r, node, special_axes.form, "'with' is not a map of keys with lists of values");
    if (node->n > SCENE_MAX_WITH) return bad(r, node, NULL, "more than %d keys change along", SCENE_MAX_WITH);
    for (deck_node *list = node->first; list; list = list->next) {
        scene_values *with = &axis->with[axis->n_with++];
        int n = 0;
        TRY(read_axis_key(r, list, with->key));
        if (list->kind != NODE_LIST || list->n != (size_t)axis->n_values)
            return bad(r, list, NULL, "'%.80s' is no list of %d values, one for each of '%.80s'", list->key,
                       axis->n_values, axis->key);
        for (deck_node *item = list->first; item; item = item->next, n++) TRY(read_pick(r, item, with->value[n]));
    }
    return FLOE_OK;
}

static floe_status read_axis_map(reader *r, deck_node *node, scene_axis *axis)
{
    *axis = (scene_axis){0};
    TRY(read_axis_key(r, node, axis->key));
    if (node->kind != NODE_MAP) return read_axis_values(r, node, axis);
    for (deck_node *part = node->first; part; part = part->next) {
        if (strcmp(part->key, "values") != 0 && strcmp(part->key, "with") != 0)
            return bad_key(r, part, special_axes.form, NULL, "'%.80s' is no key of an axis", part->key);
    }
    deck_node *values = node_find(node, "values");
    TRY(read_axis_values(r, values ? values : node, axis));
    return axis->n_values > 0 ? read_with_values(r, node_find(node, "with"), axis) : FLOE_OK;
}

static floe_status read_study_axis(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (!node) return FLOE_OK;
    if (node->kind != NODE_MAP || node->n != 1)
        return bad(r, node, special_axis.form, "'axis' is not one key with a list of values");
    return read_axis_map(r, node->first, (scene_axis *)(void *)((char *)base + key->offset));
}

/* Axes at the key's offset, at most `most`; *n counts them. */
static floe_status read_axis_list(reader *r, const key_spec *key, deck_node *node, scene_axis *axis, int *n, int most)
{
    if (!node) return FLOE_OK;
    if (node->kind != NODE_MAP)
        return bad(r, node, special_axes.form, "'%s' is not a map of keys with lists of values", key->key);
    if (node->n > (size_t)most) return bad(r, node, NULL, "more than %d axes", most);
    for (deck_node *list = node->first; list; list = list->next) {
        for (int i = 0; i < *n; i++) {
            if (strcmp(axis[i].key, list->key) == 0)
                TRY(bad_key(r, list, NULL, "put all values into one list", "the axis '%.80s' is given twice",
                            list->key));
        }
        TRY(read_axis_map(r, list, &axis[(*n)++]));
    }
    return FLOE_OK;
}

static floe_status read_axes(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_study *study = base;
    return read_axis_list(r, key, node, study->axis, &study->n_axes, SCENE_MAX_AXES);
}

/* Axes whose keys alone change. */
static floe_status take_lone_axes(reader *r, const key_spec *key, deck_node *node, scene_axis *axis, int *n, int most)
{
    TRY(read_axis_list(r, key, node, axis, n, most));
    for (int i = 0; i < *n; i++) {
        if (axis[i].n_with > 0)
            return bad(r, node_find(node, axis[i].key), NULL, "only axes of studies have keys that change along");
    }
    return FLOE_OK;
}

static floe_status read_each(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_stability *stability = base;
    return take_lone_axes(r, key, node, stability->each, &stability->n_each, SCENE_MAX_AXES);
}

/* One key with the range of a search, or two with the values of a map. */
static floe_status read_over(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_stability *stability = base;
    TRY(take_lone_axes(r, key, node, stability->over, &stability->n_over, SCENE_MAX_OVER));
    if (stability->n_over != 1 || stability->over[0].n_values == 2) return FLOE_OK;
    return bad(r, node->first, "two values, from and to; or two keys with lists of values, for a map",
               "the range of '%.80s' has %d values", stability->over[0].key, stability->over[0].n_values);
}

static void write_list_of(writer *w, const char *key, const char (*value)[SCENE_VALUE], int n)
{
    write_quoted(&w->out, key);
    for (int i = 0; i < n; i++) {
        strbuf_append(&w->out, "%s", i == 0 ? ": [" : ", ");
        write_quoted(&w->out, value[i]);
    }
    strbuf_append(&w->out, "]");
}

static void write_values(writer *w, const scene_axis *axis)
{
    if (axis->n_with == 0) {
        write_list_of(w, axis->key, axis->value, axis->n_values);
        return;
    }
    write_quoted(&w->out, axis->key);
    strbuf_append(&w->out, ": {");
    write_list_of(w, "values", axis->value, axis->n_values);
    strbuf_append(&w->out, ", with: {");
    for (int k = 0; k < axis->n_with; k++) {
        strbuf_append(&w->out, "%s", k == 0 ? "" : ", ");
        write_list_of(w, axis->with[k].key, axis->with[k].value, axis->n_values);
    }
    strbuf_append(&w->out, "}}");
}

static void write_axis(writer *w, const key_spec *key, const void *base)
{
    const scene_axis *axis = (const scene_axis *)(const void *)((const char *)base + key->offset);
    if (axis->n_values == 0) return;
    write_key_name(w, key->key);
    strbuf_append(&w->out, " {");
    write_values(w, axis);
    strbuf_append(&w->out, "}\n");
}

static void write_list(writer *w, const key_spec *key, const scene_axis *axis, int n)
{
    if (n == 0) return;
    write_key_name(w, key->key);
    for (int i = 0; i < n; i++) {
        strbuf_append(&w->out, i == 0 ? " {" : ", ");
        write_values(w, &axis[i]);
    }
    strbuf_append(&w->out, "}\n");
}

static void write_axes(writer *w, const key_spec *key, const void *base)
{
    const scene_study *study = base;
    write_list(w, key, study->axis, study->n_axes);
}

static void write_each(writer *w, const key_spec *key, const void *base)
{
    const scene_stability *stability = base;
    write_list(w, key, stability->each, stability->n_each);
}

static void write_over(writer *w, const key_spec *key, const void *base)
{
    const scene_stability *stability = base;
    write_list(w, key, stability->over, stability->n_over);
}

#define LISTS_OF_VALUES "{\"type\": \"object\", \"additionalProperties\": {\"type\": \"array\"}}"
#define LISTS_WITH_OTHERS                                                                                          \
    "{\"type\": \"object\", \"additionalProperties\": {\"anyOf\": [{\"type\": \"array\"}, {\"type\": \"object\", " \
    "\"additionalProperties\": false, \"required\": [\"values\"], \"properties\": {\"values\": {\"type\": "        \
    "\"array\"}, "                                                                                                 \
    "\"with\": " LISTS_OF_VALUES "}}]}}"
const special_key special_axis = {
    .read = read_study_axis,
    .write = write_axis,
    .form = "{key.of.the.deck: [value, value, ...]}",
    .json = LISTS_WITH_OTHERS,
};
const special_key special_axes = {
    .read = read_axes,
    .write = write_axes,
    .form = "{key.of.the.deck: [value, value, ...], another.key: [...]}; with keys that change along: "
            "{key.of.the.deck: {values: [...], with: {another.key: [...]}}}",
    .json = LISTS_WITH_OTHERS,
};
const special_key special_each = {
    .read = read_each,
    .write = write_each,
    .form = "{key.of.the.deck: [value, value, ...], another.key: [...]}",
    .json = LISTS_OF_VALUES,
};
const special_key special_over = {
    .read = read_over,
    .write = write_over,
    .form = "{key.of.the.deck: [from, to]}, or {key: [value, ...], another.key: [value, ...]}",
    .json = LISTS_OF_VALUES,
};

/* ---- study.quantities: [kinetic, pressure_gas] ---- */

static floe_status read_quantities(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_study *study = base;
    if (!node) return FLOE_OK;
    if (node->kind != NODE_LIST)
        return bad(r, node, special_quantities.form, "'%s' is not a list of columns", key->key);
    for (deck_node *item = node->first; item; item = item->next) {
        if (item->kind != NODE_SCALAR || strlen(item->text) >= SCENE_NAME || item->text[0] == '\0')
            return bad(r, item, "the name of a column of history.csv, without its unit", "this is no name of a column");
        if (study->n_quantities == SCENE_MAX_METRICS)
            return bad(r, item, NULL, "more than %d quantities", SCENE_MAX_METRICS);
        snprintf(study->quantity[study->n_quantities++], SCENE_NAME, "%s", item->text);
    }
    return FLOE_OK;
}

static void write_quantities(writer *w, const key_spec *key, const void *base)
{
    const scene_study *study = base;
    if (study->n_quantities == 0) return;
    write_key_name(w, key->key);
    for (int i = 0; i < study->n_quantities; i++) {
        strbuf_append(&w->out, i == 0 ? " [" : ", ");
        write_quoted(&w->out, study->quantity[i]);
    }
    strbuf_append(&w->out, "]\n");
}

const special_key special_quantities = {
    .read = read_quantities,
    .write = write_quantities,
    .form = "a list of columns: [kinetic, pressure_gas]",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"string\"}}",
};

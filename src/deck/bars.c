/* What a study must reach: study.require, study.check and study.refuse, each with the cases that it is for. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- where: {coupling: ice-mpm, domain.cell: 0.05} ---- */

static floe_status read_where(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_where *where = (scene_where *)(void *)((char *)base + key->offset);
    if (!node) return FLOE_OK;
    if (node->kind != NODE_MAP || node->n > SCENE_MAX_AXES)
        return bad(r, node, "{key of an axis: value}", "'%s' is no map of at most %d axes with a value each", key->key,
                   SCENE_MAX_AXES);
    for (deck_node *item = node->first; item; item = item->next) {
        if (strlen(item->key) >= SCENE_KEY) return bad_key(r, item, NULL, NULL, "the key is too long");
        snprintf(where->key[where->n], SCENE_KEY, "%s", item->key);
        TRY(read_setting(r, item, where->value[where->n++]));
    }
    return FLOE_OK;
}

static void write_where(writer *w, const key_spec *key, const void *base)
{
    const scene_where *where = (const scene_where *)(const void *)((const char *)base + key->offset);
    if (where->n == 0) return;
    write_key_name(w, key->key);
    for (int i = 0; i < where->n; i++) {
        strbuf_append(&w->out, i == 0 ? " {" : ", ");
        write_quoted(&w->out, where->key[i]);
        strbuf_append(&w->out, ": ");
        write_quoted(&w->out, where->value[i]);
    }
    strbuf_append(&w->out, "}\n");
}

static const special_key special_where = {
    .read = read_where,
    .write = write_where,
    .form = "{key of an axis: value}",
};
#define WHERE(type)                                                                                  \
    {                                                                                                \
        "where", KEY_SPECIAL, AT(type, where), .special = &special_where, .otherwise = "everywhere", \
                                               .doc = "only for these values of axes"                \
    }

/* ---- lists of tables ---- */

/* A list of at most SCENE_MAX_BARS items of a table: how the study holds it, and what an item must have. */
typedef struct bar_list {
    const key_table *table;
    size_t first, count, size; /* bytes: of the first item and of their number (int) in scene_study; of one item */
    void (*clear)(void *item);
    const char *(*misses)(const void *item); /* what it should have; NULL: nothing */
} bar_list;

static floe_status read_bar_list(reader *r, const key_spec *key, deck_node *node, scene_study *study,
                                 const bar_list *list)
{
    int *n = (int *)(void *)((char *)study + list->count);
    if (!node) return FLOE_OK;
    if (node->kind != NODE_LIST) return bad(r, node, key->special->form, "'%s' is not a list", key->key);
    if (node->n > SCENE_MAX_BARS) return bad(r, node, NULL, "more than %d in '%s'", SCENE_MAX_BARS, key->key);
    for (deck_node *item = node->first; item; item = item->next) {
        void *one = (char *)study + list->first + (size_t)(*n)++ * list->size;
        list->clear(one);
        TRY(read_table(r, list->table, item, one));
        const char *missing = item->kind == NODE_MAP ? list->misses(one) : NULL;
        if (missing) TRY(bad(r, item, missing, "this item of '%s' asks for nothing", key->key));
    }
    return FLOE_OK;
}

static void write_bar_list(writer *w, const key_spec *key, const scene_study *study, const bar_list *list)
{
    const int n = *(const int *)(const void *)((const char *)study + list->count);
    if (n == 0) return;
    write_key_name(w, key->key);
    strbuf_append(&w->out, "\n");
    for (int i = 0; i < n; i++) {
        w->indent++;
        strbuf_append(&w->out, "%*s-\n", 2 * w->indent, "");
        w->indent++;
        write_table(w, list->table, (const char *)study + list->first + (size_t)i * list->size);
        w->indent -= 2;
    }
}

#define BAR_LIST(table_, item, number, type, clear_, misses_)                                          \
    {                                                                                                  \
        .table = table_, .first = offsetof(scene_study, item), .count = offsetof(scene_study, number), \
        .size = sizeof(type), .clear = clear_, .misses = misses_                                       \
    }

/* ---- study.require: [{metric: eq13, order: 1.5, error: 0.02, where: {coupling: ice-mpm}}] ---- */

static const key_spec require_keys[] = {
    {"metric", KEY_TEXT, AT(scene_bar, metric), .required = true, .doc = "an error, or a quantity of the study"},
    {"order", KEY_NUMBER, AT(scene_bar, order), .otherwise = "not asked for", .doc = "at least"},
    {"error", KEY_NUMBER, NULL, PARAM_POSITIVE, AT(scene_bar, error), .otherwise = "not asked for", .doc = "at most"},
    WHERE(scene_bar),
};
static const key_table require_table = TABLE(require_keys);

static void clear_bar(void *item)
{
    *(scene_bar *)item = (scene_bar){.order = NAN, .error = NAN};
}

static const char *bar_misses(const void *item)
{
    const scene_bar *bar = item;
    return isnan(bar->order) && isnan(bar->error) ? "order: 1.5, or error: 0.01" : NULL;
}

static const bar_list require_list = BAR_LIST(&require_table, bar, n_bars, scene_bar, clear_bar, bar_misses);

static floe_status read_require(reader *r, const key_spec *key, deck_node *node, void *base)
{
    return read_bar_list(r, key, node, base, &require_list);
}

static void write_require(writer *w, const key_spec *key, const void *base)
{
    write_bar_list(w, key, base, &require_list);
}

const special_key special_require = {
    .read = read_require,
    .write = write_require,
    .form = "a list of {metric: name, order: at least, error: at most, where: {key of an axis: value}}",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"object\", \"additionalProperties\": false, \"required\": "
            "[\"metric\"], \"properties\": {\"metric\": {\"type\": \"string\"}, \"order\": {\"type\": [\"number\", "
            "\"string\"]}, \"error\": {\"type\": [\"number\", \"string\"]}, \"where\": {\"type\": \"object\"}}}}",
};

/* ---- study.check: [{of: l1_pressure, most: 0.1}, {of: kinetic, least: 0, most: 1, where: {coupling: ice}}] ---- */

static const key_spec check_keys[] = {
    {"of", KEY_TEXT, AT(scene_check, of), .required = true,
     .doc = "an error, `drift_mass`, `drift_momentum`, `drift_energy`, or a column of history.csv, in all its rows"},
    {"at", KEY_NUMBER, NULL, WITHIN(0, 1), AT(scene_check, at), .otherwise = "all rows",
     .doc = "of a column: its value at this share of the run's time, from 0 to 1"},
    {"change", KEY_BOOL, AT(scene_check, change), .fallback = "false",
     .doc = "of a column: its change since the start"},
    {"least", KEY_NUMBER, AT(scene_check, least), .otherwise = "any", .doc = "the smallest value that is right"},
    {"most", KEY_NUMBER, AT(scene_check, most), .otherwise = "any", .doc = "the largest value that is right"},
    WHERE(scene_check),
};
static const key_table check_table = TABLE(check_keys);

static void clear_check(void *item)
{
    *(scene_check *)item = (scene_check){.at = NAN, .least = NAN, .most = NAN};
}

static const char *check_misses(const void *item)
{
    const scene_check *check = item;
    return isnan(check->least) && isnan(check->most) ? "most: 0.01, or least: 0" : NULL;
}

static const bar_list check_list = BAR_LIST(&check_table, check, n_checks, scene_check, clear_check, check_misses);

static floe_status read_check(reader *r, const key_spec *key, deck_node *node, void *base)
{
    return read_bar_list(r, key, node, base, &check_list);
}

static void write_check(writer *w, const key_spec *key, const void *base)
{
    write_bar_list(w, key, base, &check_list);
}

const special_key special_check = {
    .read = read_check,
    .write = write_check,
    .form =
        "a list of {of: name, at: share, change: true, least: number, most: number, where: {key of an axis: value}}",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"object\", \"additionalProperties\": false, \"required\": "
            "[\"of\"], \"properties\": {\"of\": {\"type\": \"string\"}, \"change\": {\"type\": \"boolean\"}, "
            "\"at\": {\"type\": [\"number\", "
            "\"string\"]}, \"least\": {\"type\": [\"number\", \"string\"]}, \"most\": {\"type\": [\"number\", "
            "\"string\"]}, \"where\": {\"type\": \"object\"}}}}",
};

/* ---- study.refuse: [{why: text, where: {materials.gas.law: soft}}] ---- */

static const key_spec refuse_keys[] = {
    {"why", KEY_TEXT, AT(scene_refusal, why), .required = true, .doc = "the reason why there is no answer to be had"},
    WHERE(scene_refusal),
};
static const key_table refuse_table = TABLE(refuse_keys);

static void clear_refusal(void *item)
{
    *(scene_refusal *)item = (scene_refusal){.why = ""};
}

static const char *refusal_misses(const void *item)
{
    return ((const scene_refusal *)item)->why[0] ? NULL : "why: the reason in words";
}

static const bar_list refuse_list =
    BAR_LIST(&refuse_table, refusal, n_refusals, scene_refusal, clear_refusal, refusal_misses);

static floe_status read_refuse(reader *r, const key_spec *key, deck_node *node, void *base)
{
    return read_bar_list(r, key, node, base, &refuse_list);
}

static void write_refuse(writer *w, const key_spec *key, const void *base)
{
    write_bar_list(w, key, base, &refuse_list);
}

const special_key special_refuse = {
    .read = read_refuse,
    .write = write_refuse,
    .form = "a list of {why: reason, where: {key of an axis: value}}",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"object\", \"additionalProperties\": false, \"required\": "
            "[\"why\"], \"properties\": {\"why\": {\"type\": \"string\"}, \"where\": {\"type\": \"object\"}}}}",
};

/* ---- study.unchanged: [{by: initial mirrored, why: text, where: {bodies.block.velocity: [0, 0]}}] ---- */

static const key_spec unchanged_keys[] = {
    {"by", KEY_TEXT, AT(scene_unchanged, by), .required = true,
     .doc = "of frozen, initial, doubled, halved and mirrored those that leave the right answer as it is"},
    {"why", KEY_TEXT, AT(scene_unchanged, why), .required = true, .doc = "the reason"},
    WHERE(scene_unchanged),
};
static const key_table unchanged_table = TABLE(unchanged_keys);

static void clear_unchanged(void *item)
{
    *(scene_unchanged *)item = (scene_unchanged){.why = ""};
}

static const char *unchanged_misses(const void *item)
{
    return ((const scene_unchanged *)item)->by[0] ? NULL : "by: frozen";
}

static const bar_list unchanged_list =
    BAR_LIST(&unchanged_table, unchanged, n_unchanged, scene_unchanged, clear_unchanged, unchanged_misses);

static floe_status read_unchanged(reader *r, const key_spec *key, deck_node *node, void *base)
{
    return read_bar_list(r, key, node, base, &unchanged_list);
}

static void write_unchanged(writer *w, const key_spec *key, const void *base)
{
    write_bar_list(w, key, base, &unchanged_list);
}

const special_key special_unchanged = {
    .read = read_unchanged,
    .write = write_unchanged,
    .form = "a list of {by: spoilers, why: reason, where: {key of an axis: value}}",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"object\", \"additionalProperties\": false, \"required\": "
            "[\"by\", \"why\"], \"properties\": {\"by\": {\"type\": \"string\"}, \"why\": {\"type\": \"string\"}, "
            "\"where\": {\"type\": \"object\"}}}}",
};

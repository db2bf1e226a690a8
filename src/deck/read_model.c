/* One-key maps: a model of a registry with its parameters, and a variant with its keys. */
#include "deck/schema/schema.h"

#include "base/memory.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool stands_alone(const model_entry *entry)
{
    return entry->n_params == 1 && !entry->params[0].key;
}

key_spec key_of_param(const model_entry *entry, size_t i, const model_family *family)
{
    const param_spec *param = &entry->params[i];
    key_spec key = {.key = param->key ? param->key : entry->name,
                    .unit = param->unit,
                    .range = param->range,
                    .lo = param->lo,
                    .hi = param->hi,
                    .offset = param->offset,
                    .required = isnan(param->fallback),
                    .doc = param->doc,
                    .family = family,
                    .dim = param->dim,
                    .least = param->least};
    static const key_type type[] = {
        [PARAM_POINTS] = KEY_POINTS, [PARAM_MODEL] = KEY_MODEL, [PARAM_MODELS] = KEY_MODELS, [PARAM_FILE] = KEY_FILE};
    if (param->kind != PARAM_NUMBERS) {
        key.type = type[param->kind];
    } else if (param->count == 1) {
        key.type = KEY_NUMBER;
        key.size = sizeof(double);
    } else if (param->count == -3) {
        key.type = KEY_VECTOR;
        key.size = 3 * sizeof(double);
    } else {
        key.type = KEY_NUMBERS;
        key.size = (size_t)param->count * sizeof(double);
    }
    return key;
}

typedef struct family_names {
    const model_family *family;
    const deck_catalogue *catalogue;
} family_names;

static const char *family_name(const void *user, size_t i)
{
    const family_names *names = user;
    model_entry entry;
    return names->family->get(names->catalogue, i, &entry) ? entry.name : NULL;
}

static bool find_entry(reader *r, const model_family *family, const char *name, model_entry *entry)
{
    for (size_t i = 0; family->get(r->catalogue, i, entry); i++) {
        if (strcmp(entry->name, name) == 0) return true;
    }
    return false;
}

static const char *param_name(const void *user, size_t i)
{
    const model_entry *entry = user;
    if (i < entry->n_params) return entry->params[i].key;
    const key_spec *young = young_key(entry, i - entry->n_params);
    return young ? young->key : NULL;
}

static bool has_param(const model_entry *entry, const char *name)
{
    for (size_t i = 0; i < entry->n_params; i++) {
        if (strcmp(entry->params[i].key, name) == 0) return true;
    }
    return false;
}

static floe_status check_params(reader *r, const model_entry *entry, deck_node *map)
{
    for (deck_node *child = map->first; child; child = child->next) {
        const deck_node *first = node_find(map, child->key);
        if (first != child) {
            TRY(bad_key(r, child, NULL, "remove one of the two", "duplicate key '%.80s' (first at line %d, column %d)",
                        child->key, first->key_at.line, first->key_at.column));
        } else if (!has_param(entry, child->key) && !is_young_key(entry, child->key)) {
            TRY(bad_unknown_key(r, child, param_name, entry));
        }
    }
    return FLOE_OK;
}

/* The node holds the model's name by itself, as a value: "shape: everywhere". */
static bool is_bare(const deck_node *named)
{
    return named->kind == NODE_SCALAR && !node_is_null(named);
}

/* `named` stands for the model where it has no map of parameters. */
static floe_status refuse_missing(reader *r, const key_spec *key, deck_node *named)
{
    char form[256], expected[512];
    describe_expected(key, reader_dim(r), form, sizeof form);
    snprintf(expected, sizeof expected, "%s: %s (%s)", key->key, form, key->doc);
    if (is_bare(named)) return bad(r, named, expected, "missing key '%s' in '%.60s'", key->key, named->text);
    return bad_key(r, named, expected, NULL, "missing key '%s' in '%.60s'", key->key, named->key);
}

static floe_status read_param(reader *r, const key_spec *key, const param_spec *param, deck_node *map, deck_node *named,
                              char *par)
{
    deck_node *child = node_find(map, key->key);
    if (child) return read_key(r, key, child, par);
    if (key->required) return refuse_missing(r, key, named);
    double *field = (double *)(void *)(par + param->offset);
    const int n = param->count == -3 ? 3 : param->count;
    for (int i = 0; i < n; i++) field[i] = param->fallback;
    return FLOE_OK;
}

/* What is written as the value of the model itself. */
static floe_status read_alone(reader *r, const key_spec *key, deck_node *named, char *par)
{
    if (!is_bare(named)) return read_key(r, key, named, par);
    char expected[512];
    describe_expected(key, reader_dim(r), expected, sizeof expected);
    return bad(r, named, expected, "'%s' has no value", key->key);
}

/* Whether parameters of the model are models, points or files. */
static bool has_others(const model_entry *entry)
{
    for (size_t i = 0; i < entry->n_params; i++)
        if (entry->params[i].kind != PARAM_NUMBERS) return true;
    return false;
}

static floe_status check_model(reader *r, const model_family *family, const model_entry *entry, deck_node *named,
                               char *par)
{
    char why[MODEL_WHY] = "";
    const char *wrong = family->check ? family->check(entry, par, reader_dim(r)) : NULL;
    if (family->prepare) TRY(family->prepare(r->scene, entry, par, reader_dim(r), why));
    if (why[0]) wrong = why;
    if (!wrong) return FLOE_OK;
    if (is_bare(named)) return bad(r, named, NULL, "%s '%s': %s", family->noun, entry->name, wrong);
    return bad_key(r, named, NULL, NULL, "%s '%s': %s", family->noun, entry->name, wrong);
}

/* A model that a space of these dimensions does not have: its parameters are not looked at, for they would be of another space. */
static floe_status refuse_misfit(reader *r, const model_family *family, const model_entry *entry, deck_node *named)
{
    const char *why = family->misfit ? family->misfit(entry, reader_dim(r)) : NULL;
    if (!why) return FLOE_OK;
    if (is_bare(named)) return bad(r, named, NULL, "%s '%s': %s", family->noun, entry->name, why);
    return bad_key(r, named, NULL, NULL, "%s '%s': %s", family->noun, entry->name, why);
}

static floe_status read_params(reader *r, const model_family *family, const model_entry *entry, deck_node *map,
                               deck_node *named, void *field)
{
    char *par;
    const size_t errors = r->errors->count;
    TRY(refuse_misfit(r, family, entry, named));
    if (errors != r->errors->count) return FLOE_OK;
    TRY(scene_allocate(r->scene, &par, entry->param_size > 0 ? entry->param_size : 1));
    if (map && !stands_alone(entry)) TRY(check_params(r, entry, map));
    const bool by_young = gives_young(entry, map);
    if (by_young) TRY(read_young(r, entry, map, par));
    for (size_t i = 0; i < entry->n_params; i++) {
        const key_spec key = key_of_param(entry, i, family);
        if (by_young && is_modulus(key.key)) continue;
        TRY(stands_alone(entry) ? read_alone(r, &key, named, par)
                                : read_param(r, &key, &entry->params[i], map, named, par));
    }
    if (errors != r->errors->count && has_others(entry)) return FLOE_OK; /* nobody may ask a shape without parts */
    if (errors == r->errors->count) TRY(check_model(r, family, entry, named, par));
    family->store(field, entry, par);
    return FLOE_OK;
}

static floe_status bad_list(reader *r, const key_spec *key, deck_node *node)
{
    char found[80], expected[512];
    node_describe(node, found, sizeof found);
    describe_expected(key, reader_dim(r), expected, sizeof expected);
    if (node->kind == NODE_LIST)
        return bad(r, node, expected, "'%s' has %zu entries, of %d or more", key->key, node->n, key->least);
    return bad(r, node, expected, "'%s' is %s, not a list", key->key, found);
}

/* The single entry of a one-key map, NULL after an error. */
static floe_status find_single(reader *r, deck_node *node, const char *noun, deck_node **single)
{
    *single = NULL;
    char found[80];
    node_describe(node, found, sizeof found);
    if (node->kind != NODE_MAP) {
        return bad(r, node, "{name: {parameters}}", "'%.60s' is %s, not a %s", node->key ? node->key : noun, found,
                   noun);
    }
    if (node->n != 1) {
        deck_node *at = node->n > 1 ? node->first->next : node;
        if (!at->key) return bad(r, at, "{name: {parameters}}", "no entry, where one %s is needed", noun);
        return bad_key(r, at, "{name: {parameters}}", NULL, "'%.60s' has %zu entries, one %s is needed",
                       node->key ? node->key : noun, node->n, noun);
    }
    *single = node->first;
    return FLOE_OK;
}

/* "{radius: value, ...}": with the parameters that must be there, else the first. */
static void describe_params(const model_entry *entry, char *text, size_t size)
{
    size_t shown = 0;
    (void)snprintf(text, size, "{");
    for (size_t i = 0; i < entry->n_params; i++)
        if (isnan(entry->params[i].fallback))
            text_add(text, size, "%s%s: value", shown++ > 0 ? ", " : "", entry->params[i].key);
    if (shown == 0 && entry->n_params > 0) text_add(text, size, "%s: value", entry->params[shown++].key);
    text_add(text, size, "%s}", shown < entry->n_params ? ", ..." : "");
}

static floe_status read_model_at(reader *r, const model_family *family, deck_node *node, void *field)
{
    const family_names names = {family, r->catalogue};
    model_entry entry;
    if (node->kind == NODE_SCALAR && !node_is_null(node)) {
        if (!find_entry(r, family, node->text, &entry))
            return bad_name(r, node, false, family->noun, family_name, &names);
        return read_params(r, family, &entry, NULL, node, field);
    }
    deck_node *single;
    TRY(find_single(r, node, family->noun, &single));
    if (!single) return FLOE_OK;
    if (!find_entry(r, family, single->key, &entry))
        return bad_name(r, single, true, family->noun, family_name, &names);
    if (single->kind != NODE_MAP && !node_is_null(single) && !stands_alone(&entry)) {
        char found[80], expected[512];
        node_describe(single, found, sizeof found);
        describe_params(&entry, expected, sizeof expected);
        return bad(r, single, expected, "'%.60s' is %s, not a map", single->key, found);
    }
    return read_params(r, family, &entry, single->kind == NODE_MAP ? single : NULL, single, field);
}

/* In a space of its own dimension, if it has one. */
static floe_status read_model_in(reader *r, const key_spec *key, deck_node *node, void *field)
{
    const int outer = r->dim;
    if (key->dim > 0) r->dim = key->dim;
    const floe_status status = read_model_at(r, key->family, node, field);
    r->dim = outer;
    return status;
}

floe_status read_model(reader *r, const key_spec *key, deck_node *node, void *base)
{
    return read_model_in(r, key, node, (char *)base + key->offset);
}

floe_status read_models(reader *r, const key_spec *key, deck_node *node, void *base)
{
    param_list *list = (param_list *)(void *)((char *)base + key->offset);
    if (node->kind != NODE_LIST || node->n < (size_t)key->least) return bad_list(r, key, node);
    TRY(scene_allocate(r->scene, &list->item, node->n * key->family->field_size));
    for (deck_node *item = node->first; item; item = item->next, list->n++)
        TRY(read_model_in(r, key, item, (char *)list->item + list->n * key->family->field_size));
    return FLOE_OK;
}

static const char *variant_name(const void *user, size_t i)
{
    const variants *kinds = user;
    return i < kinds->n ? kinds->list[i].name : NULL;
}

static const variant *find_variant(const variants *kinds, const char *name)
{
    for (size_t i = 0; i < kinds->n; i++) {
        if (strcmp(kinds->list[i].name, name) == 0) return &kinds->list[i];
    }
    return NULL;
}

floe_status read_variant(reader *r, const variants *kinds, deck_node *node, void *field)
{
    deck_node *single = NULL, *map = NULL;
    const bool bare = node->kind == NODE_SCALAR && !node_is_null(node);
    if (!bare) {
        TRY(find_single(r, node, kinds->noun, &single));
        if (!single) return FLOE_OK;
        if (!node_is_null(single)) map = single;
    }
    const variant *kind = find_variant(kinds, bare ? node->text : single->key);
    if (!kind) return bad_name(r, bare ? node : single, !bare, kinds->noun, variant_name, kinds);
    kinds->choose(field, kind->value);
    if (!kind->table) {
        if (!map || (map->kind == NODE_MAP && map->n == 0)) return FLOE_OK;
        return bad(r, map, NULL, "%s '%s' takes no keys", kinds->noun, kind->name);
    }
    /* Without a map of its own, an empty one stands where the name does: what is required is then missing there. */
    deck_node empty = {.kind = NODE_MAP,
                       .key = kind->name,
                       .key_at = bare     ? node->at
                                 : single ? single->key_at
                                          : node->at,
                       .parent = node};
    return read_table(r, kind->table, map ? map : &empty, field);
}

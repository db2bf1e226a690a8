/* Reading by table: unknown, duplicate and missing keys, defaults, and the way from a key to its reader. */
#include "deck/other_names.h"
#include "deck/schema/schema.h"

#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { WORDS = 512, NAMES_SHOWN = 24 };

static floe_status enter_error(reader *r, deck_node *node, deck_location at, const char *expected, const char *hint,
                               const char *format, va_list arguments) FLOE_PRINTF(6, 0);

static floe_status enter_error(reader *r, deck_node *node, deck_location at, const char *expected, const char *hint,
                               const char *format, va_list arguments)
{
    char message[WORDS];
    vsnprintf(message, sizeof message, format, arguments);
    for (deck_node *n = node; n; n = n->parent) n->bad = true;
    return error_add(r->errors, at, expected, hint, "%s", message);
}

floe_status bad(reader *r, deck_node *node, const char *expected, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const floe_status status = enter_error(r, node, node->at, expected, NULL, format, arguments);
    va_end(arguments);
    return status;
}

floe_status bad_form(reader *r, const key_spec *key, deck_node *node, const char *form)
{
    char found[80];
    node_describe(node, found, sizeof found);
    return bad(r, node, form, "'%s' is %s", key->key, found);
}

floe_status bad_key(reader *r, deck_node *node, const char *expected, const char *hint, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const floe_status status = enter_error(r, node, node->key_at, expected, hint, format, arguments);
    va_end(arguments);
    return status;
}

static floe_status add_error_at(reader *r, deck_node *node, bool at_key, const char *expected, const char *hint,
                                const char *format, ...) FLOE_PRINTF(6, 7);

static floe_status add_error_at(reader *r, deck_node *node, bool at_key, const char *expected, const char *hint,
                                const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const floe_status status =
        enter_error(r, node, at_key ? node->key_at : node->at, expected, hint, format, arguments);
    va_end(arguments);
    return status;
}

static void list_names(const char *(*candidate)(const void *user, size_t i), const void *user, char all[WORDS])
{
    all[0] = '\0';
    for (size_t i = 0; i <= NAMES_SHOWN && candidate(user, i); i++)
        text_add(all, WORDS, "%s%s", i > 0 ? ", " : "", i < NAMES_SHOWN ? candidate(user, i) : "...");
}

floe_status bad_name(reader *r, deck_node *node, bool at_key, const char *noun,
                     const char *(*candidate)(const void *user, size_t i), const void *user)
{
    char all[WORDS];
    list_names(candidate, user, all);
    const char *name = at_key ? node->key : node->text, *remedy = NULL;
    const char *nearest = other_name(name, candidate, user, &remedy);
    if (!nearest) nearest = nearest_name(name, candidate, user);
    const char *start = nearest ? " (did you mean '" : "", *end = nearest ? "'?)" : "";
    if (!nearest) nearest = "";
    const char *expected = all[0] ? all : "none is defined in this deck, or in this build of floe";
    return add_error_at(r, node, at_key, expected, remedy, "unknown %s '%.80s'%s%s%s", noun, name, start, nearest, end);
}

/* What a key that is none shows of a slip in writing: the rest of 0,05 or of 1,5 ms, and a colon that YAML takes for a part of a word. */
static const char *slip_in_key(const char *key)
{
    const char *rest = key + strspn(key, "0123456789");
    if (rest != key && (*rest == '\0' || *rest == ' ')) return "write decimals with a point: 0.05, not 0,05";
    if (strpbrk(key, ":=")) return "write `key: value`, with a space behind the colon";
    return NULL;
}

floe_status bad_unknown_key(reader *r, deck_node *node, const char *(*candidate)(const void *user, size_t i),
                            const void *user)
{
    char place[WORDS];
    const char *remedy;
    const char *slip = slip_in_key(node->key);
    if (slip) return bad_key(r, node, NULL, slip, "unknown key '%.80s'", node->key);
    place_of_key(node->key, place, sizeof place);
    if (!place[0] || other_name(node->key, candidate, user, &remedy))
        return bad_name(r, node, true, "key", candidate, user);
    char all[WORDS];
    list_names(candidate, user, all);
    return bad_key(r, node, all, place, "unknown key '%.80s'", node->key);
}

static const char *key_name(const void *user, size_t i)
{
    const key_table *table = user;
    return i < table->n ? table->key[i].key : NULL;
}

static const key_spec *find_key(const key_table *table, const char *name)
{
    for (size_t i = 0; i < table->n; i++) {
        if (strcmp(table->key[i].key, name) == 0) return &table->key[i];
    }
    return NULL;
}

/* A key that is not in the table: one that has been renamed, or an unknown one. */
static floe_status refuse_key(reader *r, const key_table *table, deck_node *child)
{
    for (size_t i = 0; i < table->n; i++) {
        const key_spec *key = &table->key[i];
        if (key->formerly && strcmp(key->formerly, child->key) == 0)
            return bad_key(r, child, key->key, NULL, "'%s' is now called '%s'", key->formerly, key->key);
    }
    return bad_unknown_key(r, child, key_name, table);
}

/* Unknown keys, those that were to be taken away among them, and second occurrences. */
static floe_status check_keys(reader *r, const key_table *table, deck_node *map)
{
    for (deck_node *child = map->first; child; child = child->next) {
        const deck_node *first = node_find(map, child->key);
        if (first != child) {
            TRY(bad_key(r, child, NULL, "remove one of the two", "duplicate key '%.80s' (first at line %d, column %d)",
                        child->key, first->key_at.line, first->key_at.column));
        } else if (!find_key(table, child->key)) {
            TRY(refuse_key(r, table, child));
        }
    }
    for (deck_node *child = map->absent; child; child = child->next) {
        if (!child->taken && !find_key(table, child->key)) TRY(refuse_key(r, table, child));
    }
    return FLOE_OK;
}

/* The default, read as if the deck said so. */
static floe_status read_fallback(reader *r, const key_spec *key, void *base)
{
    deck_node node = {.kind = NODE_SCALAR, .text = key->fallback, .key = key->key};
    return read_key(r, key, &node, base);
}

static floe_status read_absent(reader *r, const key_spec *key, deck_node *map, void *base)
{
    if (key->required && map) {
        char form[WORDS / 2], expected[WORDS];
        describe_expected(key, reader_dim(r), form, sizeof form);
        snprintf(expected, sizeof expected, "%s: %s (%s)", key->key, form, key->doc);
        const char *quote = map->key ? "'" : "", *name = map->key ? map->key : "the deck";
        return bad_key(r, map, expected, NULL, "missing key '%s' in %s%.60s%s", key->key, quote, name, quote);
    }
    if (key->fallback) return read_fallback(r, key, base);
    if (key->type == KEY_MAP && !key->present) {
        return read_table(r, key->table, NULL, (char *)struct_of_map(key, base) + key->offset);
    }
    if (key->type == KEY_SPECIAL) return key->special->read(r, key, NULL, base);
    return FLOE_OK;
}

/* "a map: {pressure: value, ...}": with the keys that must be there, else the first. */
static void describe_table(const key_table *table, char *text, size_t size)
{
    size_t shown = 0;
    (void)snprintf(text, size, "a map: {");
    for (size_t i = 0; i < table->n; i++)
        if (table->key[i].required) text_add(text, size, "%s%s: value", shown++ > 0 ? ", " : "", table->key[i].key);
    if (shown == 0 && table->n > 0) text_add(text, size, "%s: value", table->key[shown++].key);
    text_add(text, size, "%s}", shown < table->n ? ", ..." : "");
}

floe_status read_table(reader *r, const key_table *table, deck_node *map, void *base)
{
    if (map && map->kind != NODE_MAP) {
        char found[80], expected[WORDS];
        node_describe(map, found, sizeof found);
        describe_table(table, expected, sizeof expected);
        return bad(r, map, expected, "'%.60s' is %s, not a map", map->key ? map->key : "the deck", found);
    }
    if (map) TRY(check_keys(r, table, map));
    for (size_t i = 0; i < table->n; i++) {
        const key_spec *key = &table->key[i];
        deck_node *node = node_find(map, key->key);
        const bool applies = !key->applies || key->applies(r->scene, base);
        if (node && !applies) {
            TRY(bad_key(r, node, NULL, NULL, "'%s' belongs to %s", key->key, key->belongs));
        } else if (node) {
            TRY(read_key(r, key, node, base));
        } else if (applies) {
            TRY(read_absent(r, key, map, base));
        }
    }
    return FLOE_OK;
}

static floe_status read_map(reader *r, const key_spec *key, deck_node *node, void *base)
{
    char *of = struct_of_map(key, base);
    if (key->present) {
        const bool given = true;
        memcpy(of + key->present - 1, &given, sizeof given);
    }
    return read_table(r, key->table, node, of + key->offset);
}

floe_status read_key(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (node_is_null(node) && key->type != KEY_MODEL && key->type != KEY_TEXT) {
        char expected[WORDS];
        describe_expected(key, reader_dim(r), expected, sizeof expected);
        return bad_key(r, node, expected, NULL, "'%s' has no value", key->key);
    }
    switch (key->type) {
    case KEY_MAP: return read_map(r, key, node, base);
    case KEY_NAMED: return read_named(r, key, node, base);
    case KEY_MODEL: return read_model(r, key, node, base);
    case KEY_MODELS: return read_models(r, key, node, base);
    case KEY_POINTS: return read_points(r, key, node, base);
    case KEY_FILE: return read_file_key(r, key, node, base);
    case KEY_VARIANT: return read_variant(r, key->variants, node, (char *)base + key->offset);
    case KEY_SPECIAL: return key->special->read(r, key, node, base);
    default: return read_scalar(r, key, node, base);
    }
}

static bool is_name(const char *text)
{
    const size_t length = strlen(text);
    const char *letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    const char *others = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789-";
    return length > 0 && length < SCENE_NAME && strchr(letters, text[0]) && strspn(text, others) == length;
}

static floe_status read_item(reader *r, const key_spec *key, deck_node *node, char *item)
{
    const named_items *items = key->items;
    snprintf(item, SCENE_NAME, "%s", node->key);
    if (items->begin) TRY(items->begin(r, node, item));
    if (items->table) {
        TRY(read_table(r, items->table, node, item));
    } else if (items->variants) {
        TRY(read_variant(r, items->variants, node, item));
    } else {
        TRY(read_key(r, items->value, node, item));
    }
    return items->end ? items->end(r, node, item) : FLOE_OK;
}

static const char *child_name(const void *user, size_t i)
{
    const deck_node *child = node_at(user, i);
    return child ? child->key : NULL;
}

/* A name that was to be taken away must be there, or have been. */
static floe_status check_absent(reader *r, const named_items *items, deck_node *map)
{
    for (deck_node *child = map->absent; child; child = child->next) {
        if (!child->taken && !node_find(map, child->key)) TRY(bad_name(r, child, true, items->noun, child_name, map));
    }
    return FLOE_OK;
}

floe_status read_named(reader *r, const key_spec *key, deck_node *node, void *base)
{
    const named_items *items = key->items;
    if (node->kind != NODE_MAP) {
        char found[80];
        node_describe(node, found, sizeof found);
        return bad(r, node, "name: {...}, one entry for each", "'%s' is %s, not a map of names", key->key, found);
    }
    TRY(check_absent(r, items, node));
    int count = 0;
    for (deck_node *child = node->first; child; child = child->next) {
        const deck_node *first = node_find(node, child->key);
        if (first != child) {
            TRY(bad_key(r, child, NULL, NULL, "duplicate %s '%.80s' (first at line %d, column %d)", items->noun,
                        child->key, first->key_at.line, first->key_at.column));
        } else if (!is_name(child->key)) {
            TRY(bad_key(r, child, "letters, digits, '_' and '-', a letter first, at most 63", NULL,
                        "'%.80s' cannot be the name of a %s", child->key, items->noun));
        } else if ((size_t)count == items->most) {
            return bad_key(r, child, NULL, NULL, "too many entries in '%s': at most %zu", key->key, items->most);
        } else {
            char *item = (char *)base + key->offset + (size_t)count * items->item_size;
            count++;
            memcpy((char *)base + items->count_offset, &count, sizeof count);
            TRY(read_item(r, key, child, item));
        }
    }
    return FLOE_OK;
}

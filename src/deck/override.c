#include "deck/override.h"

#include "deck/preset.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct override {
    deck_arena *arena;
    error_list *errors;
    deck_location at;
    const char *key, *value;
    deck_node *fresh; /* the value's tree */
} override;

static floe_status add_child(override *o, deck_node *map, const char *path, size_t length, deck_node *child)
{
    TRY(arena_text(o->arena, &child->key, path, length));
    child->key_at = child->at;
    node_append(map, child);
    return FLOE_OK;
}

/* K=null takes a key away, so that an alternative can be given; K= alone stays an error of the schema. */
static bool takes_away(const override *o)
{
    return o->value[0] != '\0' && node_is_null(o->fresh);
}

/* What is not there is not put there to be taken away: --set and an axis may both take the same key. Its name is kept
 * for the schema, unless it is known to have been there. */
static floe_status note_absent(override *o, deck_node *map, const char *path, size_t length)
{
    deck_node *absent;
    for (const deck_node *at = map->absent; at; at = at->next) {
        if (strncmp(at->key, path, length) == 0 && at->key[length] == '\0') return FLOE_OK;
    }
    TRY(node_new(o->arena, &absent, NODE_SCALAR, o->at));
    TRY(arena_text(o->arena, &absent->key, path, length));
    node_note_absent(map, absent);
    return FLOE_OK;
}

static void take_away(const override *o, deck_node *child)
{
    deck_node *map = child->parent;
    node_remove(child);
    child->taken = true;
    child->at = child->key_at = o->at;
    node_note_absent(map, child);
}

/* One step of a path through a map: *next is NULL once the value has been put in its place. */
static floe_status step_map(override *o, deck_node *map, const char **path, deck_node **next)
{
    size_t length;
    deck_node *child = node_match(map, *path, &length);
    *next = NULL;
    if (!child) {
        length = strcspn(*path, ".");
        if (length == 0) return error_add(o->errors, o->at, NULL, NULL, "'%s' has an empty part", o->key);
        if (takes_away(o)) return note_absent(o, map, *path, length);
        if ((*path)[length] == '\0') return add_child(o, map, *path, length, o->fresh);
        TRY(node_new(o->arena, &child, NODE_MAP, o->at));
        TRY(add_child(o, map, *path, length, child));
    } else if ((*path)[length] == '\0') {
        if (takes_away(o))
            take_away(o, child);
        else
            node_replace(child, o->fresh);
        return FLOE_OK;
    }
    *path += length + 1;
    *next = child;
    return FLOE_OK;
}

static floe_status step_list(override *o, deck_node *list, const char **path, deck_node **next)
{
    const size_t length = strcspn(*path, ".");
    char *end;
    const unsigned long i = strtoul(*path, &end, 10);
    deck_node *child = end == *path + length && isdigit((unsigned char)**path) ? node_at(list, i) : NULL;
    *next = NULL;
    if (!child) {
        char expected[64];
        snprintf(expected, sizeof expected, "an index from 0 to %zu", list->n - (list->n > 0));
        return error_add(o->errors, o->at, expected, NULL, "'%.*s' is no entry of a list of %zu", (int)length, *path,
                         list->n);
    }
    if ((*path)[length] == '\0') {
        node_replace(child, o->fresh);
        return FLOE_OK;
    }
    *path += length + 1;
    *next = child;
    return FLOE_OK;
}

static floe_status place_value(override *o, deck_node *root)
{
    const char *path = o->key;
    for (deck_node *node = root; node;) {
        if (node->kind == NODE_MAP) {
            TRY(step_map(o, node, &path, &node));
        } else if (node->kind == NODE_LIST) {
            TRY(step_list(o, node, &path, &node));
        } else if (node_is_null(node)) {
            node->kind = NODE_MAP; /* "materials:" without a value takes keys */
        } else {
            return error_add(o->errors, o->at, NULL, NULL, "'%s' is a value: it has no '%s'. Give a map in its place",
                             node->key ? node->key : "the deck", path);
        }
    }
    return FLOE_OK;
}

static floe_status apply_one(override *o, deck_node *root, int source, const char *text)
{
    const char *equals = strchr(text, '=');
    o->at = (deck_location){source, 1, 1};
    if (!equals || equals == text) {
        return error_add(o->errors, o->at, "K=V: domain.cell=0.0125", NULL, "this is no key with a value");
    }
    parse_error error;
    TRY(arena_text(o->arena, &o->key, text, (size_t)(equals - text)));
    o->value = equals + 1;
    const floe_status status = parse_yaml(&o->fresh, o->arena, source, o->value, strlen(o->value), &error);
    if (status == FLOE_BAD_INPUT) {
        return error_add(o->errors, o->at, NULL, error.remedy, "the value is not YAML: %s", error.text);
    }
    TRY(status);
    return place_value(o, root);
}

floe_status override_apply(deck_node *root, deck_arena *arena, const deck_overrides *set, error_list *errors)
{
    override o = {.arena = arena, .errors = errors};
    TRY(preset_open(root, arena));
    for (size_t i = 0; set && i < set->n; i++) {
        TRY(apply_one(&o, root, (int)i + 1, set->text[i]));
        TRY(preset_open(root, arena));
    }
    return FLOE_OK;
}

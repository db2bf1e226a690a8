/* Single values of a resolved deck, by their keys. */
#include "deck/tree.h"

#include "base/memory.h"
#include "deck/deck.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The node at a path of names and list indices joined by dots; NULL if there is none. */
static const deck_node *node_at_path(const deck_node *node, const char *path)
{
    while (node && *path) {
        size_t length;
        if (node->kind == NODE_MAP) {
            node = node_match(node, path, &length);
        } else if (node->kind == NODE_LIST) {
            char *end;
            const unsigned long i = strtoul(path, &end, 10);
            length = (size_t)(end - path);
            node = length > 0 ? node_at(node, i) : NULL;
        } else {
            return NULL;
        }
        path += length;
        if (*path == '.') path++;
    }
    return node;
}

static floe_status look_up(deck_arena *arena, const char *text, const char *key, char value[SCENE_VALUE])
{
    parse_error error;
    deck_node *root;
    const floe_status status = parse_yaml(&root, arena, 0, text, strlen(text), &error);
    if (status == FLOE_BAD_INPUT)
        return fail(arena->ctx, FLOE_INTERNAL, "the resolved deck is no YAML: %s", error.text);
    TRY(status);
    const deck_node *node = node_at_path(root, key);
    if (node && node->kind == NODE_SCALAR && strlen(node->text) < SCENE_VALUE)
        snprintf(value, SCENE_VALUE, "%s", node->text);
    return FLOE_OK;
}

floe_status deck_value(char value[SCENE_VALUE], const scene *s, const deck_catalogue *catalogue, const char *key)
{
    deck_arena arena = {.ctx = s->ctx};
    char *text;
    value[0] = '\0';
    TRY(deck_echo(&text, s, catalogue));
    const floe_status status = look_up(&arena, text, key, value);
    arena_free(&arena);
    memory_free(s->ctx, &text);
    return status;
}

#include "deck/tree.h"

#include "base/memory.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { ARENA_CHUNK = 16384 }; /* bytes of a chunk, unless one item needs more */

struct arena_chunk {
    arena_chunk *next;
    size_t used, size;
    alignas(max_align_t) char data[];
};

static floe_status add_chunk(deck_arena *arena, size_t size)
{
    arena_chunk *chunk;
    const size_t bytes = size > ARENA_CHUNK ? size : ARENA_CHUNK;
    TRY(memory_new(arena->ctx, &chunk, 1, sizeof *chunk + bytes));
    chunk->size = bytes;
    chunk->next = arena->chunk;
    arena->chunk = chunk;
    return FLOE_OK;
}

floe_status arena_new(deck_arena *arena, void *out, size_t size)
{
    const size_t alignment = alignof(max_align_t);
    const size_t rounded = (size + alignment - 1) / alignment * alignment;
    if (!arena->chunk || arena->chunk->size - arena->chunk->used < rounded) TRY(add_chunk(arena, rounded));
    void *data = arena->chunk->data + arena->chunk->used;
    arena->chunk->used += rounded;
    memcpy(out, &data, sizeof data);
    return FLOE_OK;
}

floe_status arena_text(deck_arena *arena, const char **out, const char *text, size_t length)
{
    char *copy;
    TRY(arena_new(arena, &copy, length + 1));
    if (length > 0) memcpy(copy, text, length);
    *out = copy;
    return FLOE_OK;
}

void arena_free(deck_arena *arena)
{
    while (arena->chunk) {
        arena_chunk *next = arena->chunk->next;
        memory_free(arena->ctx, &arena->chunk);
        arena->chunk = next;
    }
}

floe_status node_new(deck_arena *arena, deck_node **out, node_kind kind, deck_location at)
{
    TRY(arena_new(arena, out, sizeof **out));
    **out = (deck_node){.kind = kind, .text = "", .at = at, .key_at = at};
    return FLOE_OK;
}

void node_append(deck_node *parent, deck_node *child)
{
    child->parent = parent;
    child->next = NULL;
    if (parent->last) {
        parent->last->next = child;
    } else {
        parent->first = child;
    }
    parent->last = child;
    parent->n++;
}

void node_replace(deck_node *old, deck_node *fresh)
{
    deck_node *parent = old->parent;
    fresh->key = old->key;
    fresh->key_at = fresh->at;
    fresh->parent = parent;
    fresh->next = old->next;
    if (!parent) return;
    deck_node **link = &parent->first;
    while (*link != old) link = &(*link)->next;
    *link = fresh;
    if (parent->last == old) parent->last = fresh;
}

void node_remove(deck_node *child)
{
    deck_node *parent = child->parent, *before = NULL;
    for (deck_node *at = parent->first; at != child; at = at->next) before = at;
    if (before) {
        before->next = child->next;
    } else {
        parent->first = child->next;
    }
    if (parent->last == child) parent->last = before;
    parent->n--;
}

void node_note_absent(deck_node *map, deck_node *child)
{
    child->parent = map;
    child->next = map->absent;
    map->absent = child;
}

deck_node *node_find(const deck_node *map, const char *key)
{
    if (!map || map->kind != NODE_MAP) return NULL;
    for (deck_node *child = map->first; child; child = child->next) {
        if (strcmp(child->key, key) == 0) return child;
    }
    return NULL;
}

deck_node *node_match(const deck_node *map, const char *path, size_t *length)
{
    deck_node *best = NULL;
    *length = 0;
    for (deck_node *child = map->first; child; child = child->next) {
        const size_t n = strlen(child->key);
        if (n > *length && strncmp(child->key, path, n) == 0 && (path[n] == '.' || path[n] == '\0')) {
            best = child;
            *length = n;
        }
    }
    return best;
}

deck_node *node_at(const deck_node *node, size_t i)
{
    deck_node *child = node->first;
    while (child && i-- > 0) child = child->next;
    return child;
}

bool node_is_null(const deck_node *node)
{
    if (node->kind != NODE_SCALAR || node->quoted) return false;
    return node->text[0] == '\0' || strcmp(node->text, "~") == 0 || strcmp(node->text, "null") == 0;
}

bool node_is_word(const deck_node *node, const char *word)
{
    return node->kind == NODE_SCALAR && strcmp(node->text, word) == 0;
}

void node_describe(const deck_node *node, char *text, size_t size)
{
    if (node->kind == NODE_MAP) {
        snprintf(text, size, "a map");
    } else if (node->kind == NODE_LIST) {
        snprintf(text, size, "a list of %zu", node->n);
    } else if (node_is_null(node)) {
        snprintf(text, size, "empty");
    } else {
        snprintf(text, size, "'%.60s'", node->text);
    }
}

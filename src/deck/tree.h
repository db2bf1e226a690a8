/* The deck as a tree of nodes with their lines and columns in the source: parse.c builds it, --set edits it, and the
 * schema reads it. Nodes and texts live in an arena and go together. Private to src/deck. */
#ifndef DECK_TREE_H
#define DECK_TREE_H

#include "base/context.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    TREE_MAX_DEPTH = 100,    /* nested maps and lists */
    TREE_MAX_NODES = 100000, /* of one source */
    TREE_MAX_BYTES = 1 << 20 /* of one source */
};

typedef enum node_kind { NODE_SCALAR, NODE_LIST, NODE_MAP } node_kind;

typedef struct deck_location {
    int source;       /* 0: the deck file; n: the n-th --set (1 is the first) */
    int line, column; /* from 1; column counts characters */
} deck_location;

typedef struct deck_node {
    node_kind kind;
    bool quoted;          /* a scalar in quotes or a block */
    bool bad;             /* an error was found here or below */
    const char *text;     /* scalars; "" when empty */
    const char *key;      /* in a map: the key's text; NULL elsewhere */
    deck_location key_at; /* in a map */
    deck_location at;     /* of the value */
    struct deck_node *parent, *first, *last, *next;
    struct deck_node *absent; /* maps: what --set was to take away, chained by next */
    size_t n;                 /* children */
    bool taken;               /* among the absent: it was there; its places are now those of the --set */
} deck_node;

typedef struct arena_chunk arena_chunk;

typedef struct deck_arena {
    context *ctx; /* not owned */
    arena_chunk *chunk;
} deck_arena;

/* Zeroed storage that lives until arena_free. Errors: FLOE_NO_MEMORY. */
floe_status arena_new(deck_arena *arena, void *out, size_t size);
/* A copy of `length` bytes with a zero at the end. */
floe_status arena_text(deck_arena *arena, const char **out, const char *text, size_t length);
void arena_free(deck_arena *arena);

floe_status node_new(deck_arena *arena, deck_node **out, node_kind kind, deck_location at);
/* Makes `child` the last child of `parent`. */
void node_append(deck_node *parent, deck_node *child);
/* Replaces `old` by `fresh` in its parent, under the same key. */
void node_replace(deck_node *old, deck_node *fresh);
/* Removes `child` from its parent. */
void node_remove(deck_node *child);
/* Puts `child`, which is none of its children, among the absent of `map`. */
void node_note_absent(deck_node *map, deck_node *child);
/* The first child of a map with that key, NULL if there is none (or `map` is NULL or no map). */
deck_node *node_find(const deck_node *map, const char *key);
/* The child whose key is the longest beginning of `path` (keys may hold dots); *length is what it takes of the path. */
deck_node *node_match(const deck_node *map, const char *path, size_t *length);
/* The i-th child, NULL beyond the end. */
deck_node *node_at(const deck_node *node, size_t i);
/* "a map", "a list", "empty", "text 'abc'": what a node is, for messages. */
void node_describe(const deck_node *node, char *text, size_t size);
/* true for an empty plain scalar, `~` and `null`. */
bool node_is_null(const deck_node *node);
bool node_is_word(const deck_node *node, const char *word);

/* Parses YAML text into a tree (parse.c, the only file that sees libfyaml). On a syntax error *root is NULL and the
 * message, its place and FLOE_BAD_INPUT are returned in *error; other failures are in the context. */
typedef struct parse_error {
    deck_location at;
    char text[256];
    char remedy[160]; /* "" if there is none */
} parse_error;
floe_status parse_yaml(deck_node **root, deck_arena *arena, int source, const char *text, size_t length,
                       parse_error *error);

#endif

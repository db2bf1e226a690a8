/* What only a run can refuse, such as a surface that is not closed, told with the place of the key or name that it is about. */
#include "deck/override.h"
#include "deck/parts.h"

#include "base/memory.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { PATH_MOST = 512, DOTTED = PATH_MOST };

typedef struct blame {
    const char *cause;
    const deck_node *node; /* the best so far, NULL: none */
    size_t weight;
} blame;

static bool in_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* The words stand in the cause, and not as part of longer ones. */
static bool is_said(const char *cause, const char *words)
{
    const size_t length = strlen(words);
    for (const char *at = strstr(cause, words); at; at = strstr(at + 1, words)) {
        if ((at == cause || !in_word(at[-1])) && !in_word(at[length])) return true;
    }
    return false;
}

/* How well the cause names a key: by its whole path, by its own name in quotes, or, of the first level, as a word; 0: not at all. */
static size_t weigh(const char *cause, const deck_node *node, const char *path)
{
    char quoted[PATH_MOST];
    const bool first_level = !strchr(path, '.');
    if (is_said(cause, path)) return strlen(path) + (first_level ? 0 : DOTTED);
    (void)snprintf(quoted, sizeof quoted, "'%s'", node->key);
    return !first_level && strstr(cause, quoted) ? strlen(quoted) : 0;
}

static void search(blame *b, const deck_node *map, const char *prefix);

/* A chain of children, of a map or of what --set has taken from it. */
static void search_chain(blame *b, const deck_node *first, const char *prefix)
{
    for (const deck_node *child = first; child; child = child->next) {
        char path[PATH_MOST];
        const int length = snprintf(path, sizeof path, "%s%s%s", prefix, prefix[0] ? "." : "", child->key);
        if (length >= (int)sizeof path) continue; /* no message has room for it */
        const size_t weight = weigh(b->cause, child, path);
        if (weight > b->weight) b->weight = weight, b->node = child;
        if (child->kind == NODE_MAP && !child->taken) search(b, child, path);
    }
}

static void search(blame *b, const deck_node *map, const char *prefix)
{
    search_chain(b, map->first, prefix);
    search_chain(b, map->absent, prefix);
}

/* "deck.yaml:3:8" or "--set time.solver=static", "" where the cause names nothing of the deck. */
static floe_status find_place(const char *path, const deck_overrides *set, const char *text, size_t length,
                              const char *cause, deck_arena *arena, char place[PATH_MOST])
{
    deck_node *root;
    parse_error error;
    error_list ignored = {.arena = arena};
    place[0] = '\0';
    TRY(parse_yaml(&root, arena, 0, text, length, &error));
    TRY(override_apply(root, arena, set, &ignored));
    blame b = {.cause = cause};
    search(&b, root, "");
    if (!b.node) return FLOE_OK;
    const deck_place at = b.node->kind == NODE_MAP ? b.node->key_at : b.node->at;
    if (at.source > 0)
        (void)snprintf(place, PATH_MOST, "--set %s: ", set->text[at.source - 1]);
    else
        (void)snprintf(place, PATH_MOST, "%s:%d:%d: ", path, at.line, at.column);
    return FLOE_OK;
}

floe_status deck_blame(context *ctx, floe_status status, const char *path, const deck_overrides *set)
{
    if (status != FLOE_BAD_INPUT) return status;
    char cause[CONTEXT_MESSAGE_SIZE], place[PATH_MOST] = "", *text = NULL;
    size_t length;
    deck_arena arena = {.ctx = ctx};
    (void)snprintf(cause, sizeof cause, "%s", context_message(ctx));
    if (deck_read_file(ctx, path, &text, &length) == FLOE_OK &&
        find_place(path, set, text, length, cause, &arena, place) != FLOE_OK)
        place[0] = '\0'; /* the cause alone must do */
    arena_free(&arena);
    memory_free(ctx, &text);
    context_clear(ctx);
    return fail(ctx, status, "%s%s", place, cause);
}

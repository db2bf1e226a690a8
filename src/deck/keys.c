/* Notes in the scene where each key of its deck stands. */
#include "deck/deck_internal.h"
#include "scene/deck_location.h"

#include <string.h>

typedef struct key_list {
    scene_key *key;
    int n;
    const char *settings; /* all of --set, each with its zero */
    char *text;           /* where the next name goes */
} key_list;

/* Keys, and the bytes of their names. */
static int count_keys(const deck_node *map, size_t *bytes)
{
    int n = 0;
    for (const deck_node *child = map->first; child; child = child->next) {
        n += 1 + (child->kind == NODE_MAP ? count_keys(child, bytes) : 0);
        *bytes += strlen(child->key) + 1;
    }
    for (const deck_node *child = map->absent; child; child = child->next, n++) *bytes += strlen(child->key) + 1;
    return n;
}

static char *append_key_text(char *to, const char *text)
{
    const size_t size = strlen(text) + 1;
    memcpy(to, text, size);
    return to + size;
}

static const char *setting_of(const key_list *list, int source)
{
    const char *text = list->settings;
    for (; source > 1; source--) text += strlen(text) + 1;
    return text;
}

static void note_key(key_list *list, const deck_node *node, int above)
{
    const deck_location at = node->kind == NODE_MAP ? node->key_at : node->at;
    list->key[list->n++] = (scene_key){.name = list->text,
                                       .above = above,
                                       .line = at.line,
                                       .column = at.column,
                                       .setting = at.source > 0 ? setting_of(list, at.source) : NULL};
    list->text = append_key_text(list->text, node->key);
}

/* What was taken away comes last: what has been given again stands before it, and is found first. */
static void note_map(key_list *list, const deck_node *map, int above)
{
    for (const deck_node *child = map->first; child; child = child->next) {
        const int own = list->n;
        note_key(list, child, above);
        if (child->kind == NODE_MAP) note_map(list, child, own);
    }
    for (const deck_node *child = map->absent; child; child = child->next) note_key(list, child, above);
}

floe_status note_keys(scene *s, const deck_node *root, const deck_overrides *set)
{
    key_list list = {0};
    char *settings;
    size_t bytes = 1;
    const size_t n_set = set ? set->n : 0;
    const int n = count_keys(root, &bytes);
    for (size_t i = 0; i < n_set; i++) bytes += strlen(set->text[i]) + 1;
    TRY(scene_allocate(s, &list.key, (size_t)n * sizeof *list.key));
    TRY(scene_allocate(s, &settings, bytes));
    list.settings = list.text = settings;
    for (size_t i = 0; i < n_set; i++) list.text = append_key_text(list.text, set->text[i]);
    note_map(&list, root, -1);
    s->key = list.key;
    s->n_keys = list.n;
    return FLOE_OK;
}

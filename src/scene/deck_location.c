#include "scene/deck_location.h"

#include <stdio.h>
#include <string.h>

/* The key called `name`, of `length` characters, right under another; -1: there is none. */
static int find_under(const scene *s, int above, const char *name, size_t length)
{
    for (int k = 0; k < s->n_keys; k++) {
        const scene_key *key = &s->key[k];
        if (key->above == above && strncmp(key->name, name, length) == 0 && key->name[length] == '\0') return k;
    }
    return -1;
}

/* The last key on the way to `path` that is there. */
static int find_nearest(const scene *s, const char *path)
{
    int at = -1;
    while (*path) {
        const size_t length = strcspn(path, ".");
        const int next = find_under(s, at, path, length);
        if (next < 0) break;
        at = next;
        path += length + (path[length] == '.');
    }
    return at;
}

void scene_key_place(const scene *s, const char *path, char *text, size_t size)
{
    const int k = find_nearest(s, path);
    const scene_key *at = k < 0 ? NULL : &s->key[k];
    const size_t length = strlen(path);
    if (at && !at->setting)
        (void)snprintf(text, size, "%s:%d:%d: %s: ", s->path, at->line, at->column, path);
    else if (at && strncmp(at->setting, path, length) == 0 && at->setting[length] == '=')
        (void)snprintf(text, size, "--set %s: ", at->setting);
    else if (at)
        (void)snprintf(text, size, "--set %s: %s: ", at->setting, path);
    else
        (void)snprintf(text, size, "%s: ", path);
}

bool scene_has_key(const scene *s, const char *path)
{
    int at = -1;
    while (*path) {
        const size_t length = strcspn(path, ".");
        at = find_under(s, at, path, length);
        if (at < 0) return false;
        path += length + (path[length] == '.');
    }
    return true;
}

/* What "--set KEY=VALUE" leaves to be said of a key: nothing of the key if it is this one, nor of the value where the
 * cause begins with it. */
static void tell_setting(const char *setting, const char *key, const char *cause, char text[CONTEXT_MESSAGE_SIZE])
{
    const size_t length = strlen(key);
    const bool own = strncmp(setting, key, length) == 0 && setting[length] == '=';
    const char *value = own ? setting + length + 1 : "";
    const size_t said = strlen(value);
    if (said > 0 && strncmp(cause, value, said) == 0 && strncmp(cause + said, ": ", 2) == 0) cause += said + 2;
    (void)snprintf(text, CONTEXT_MESSAGE_SIZE, "--set %s: %s%s%.1500s", setting, own ? "" : key, own ? "" : ": ",
                   cause);
}

floe_status scene_deck_location(const scene *s, floe_status status)
{
    char key[CONTEXT_KEY_SIZE], cause[CONTEXT_MESSAGE_SIZE], text[CONTEXT_MESSAGE_SIZE];
    (void)snprintf(key, sizeof key, "%s", context_key(s->ctx));
    (void)snprintf(cause, sizeof cause, "%s", context_cause(s->ctx));
    const int k = key[0] ? find_nearest(s, key) : -1;
    if (status != FLOE_BAD_INPUT || k < 0) return status;
    const scene_key *at = &s->key[k];
    context_clear(s->ctx);
    if (!at->setting) return fail(s->ctx, status, "%s:%d:%d: %s: %s", s->path, at->line, at->column, key, cause);
    tell_setting(at->setting, key, cause, text);
    return fail(s->ctx, status, "%s", text);
}

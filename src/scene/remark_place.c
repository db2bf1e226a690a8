/* The place in the deck of what a remark is about, for those that do not tell it themselves. */
#include "scene/deck_location.h"
#include "scene/remark.h"

#include <stdio.h>
#include <string.h>

enum { KEY_PATH = 256 };

typedef struct named_thing {
    const char *words, *map; /* "body '", and the key that those are under */
} named_thing;

/* "bodies.wall" of the first thing that the remark names and the deck has; false: there is none. */
static bool find_subject(const scene *s, const char *text, char path[KEY_PATH])
{
    static const named_thing thing[] = {
        {"body '", "bodies"}, {"solid '", "materials"}, {"fluid '", "materials"}, {"material '", "materials"}};
    for (size_t k = 0; k < sizeof thing / sizeof thing[0]; ++k) {
        const char *at = strstr(text, thing[k].words);
        if (!at) continue;
        at += strlen(thing[k].words);
        (void)snprintf(path, KEY_PATH, "%s.%.*s", thing[k].map, (int)strcspn(at, "'"), at);
        if (scene_has_key(s, path)) return true;
    }
    return false;
}

void remark_with_place(const scene *s, const char *text, char *out, size_t size)
{
    char path[KEY_PATH], first[KEY_PATH], place[512];
    const size_t length = strcspn(text, ": ");
    const bool has_path = text[length] == ':' && text[length + 1] == ' ' && length < sizeof path;
    (void)snprintf(path, sizeof path, "%.*s", (int)length, text);
    (void)snprintf(first, sizeof first, "%.*s", (int)strcspn(path, "."), path);
    const bool told = strncmp(text, "--set ", strlen("--set ")) == 0 || strncmp(text, s->path, strlen(s->path)) == 0;
    if (!told && has_path && scene_has_key(s, first)) {
        scene_key_place(s, path, place, sizeof place);
        (void)snprintf(out, size, "%s%s", place, text + length + 2);
    } else if (!told && find_subject(s, text, path)) {
        scene_key_place(s, path, place, sizeof place);
        (void)snprintf(out, size, "%s%s", place, text);
    } else {
        (void)snprintf(out, size, "%s", text);
    }
}

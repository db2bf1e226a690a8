/* Lines and columns of the keys of a scene's deck, for refusals after the deck has been read. */
#ifndef SCENE_PLACE_H
#define SCENE_PLACE_H

#include "scene/scene.h"

/* A key of the deck. Texts are owned by the scene. */
struct scene_key {
    const char *name;    /* in its map */
    int above;           /* index of the key that it is under; -1: none, it is of the first level */
    int line, column;    /* in the deck, from 1; of a map those of the key, else of the value */
    const char *setting; /* "domain.cell=0.1": of a key set or removed beside the deck; NULL: it is in the deck */
};

/* After FLOE_BAD_INPUT: puts the place of the key that was refused in front of the context's message, "deck.yaml:3:8:
 * ", of what is under it, or "--set KEY=VALUE: "; where the deck does not have the key, that of what it would be in. A
 * second call changes nothing. Returns `status`. */
floe_status scene_deck_location(const scene *s, floe_status status);

/* "deck.yaml:3:8: time.end: " of a key, or of what it would be in; "--set KEY=VALUE: ", with the key after
 * it where it is another; "time.end: " where the deck has neither. For remarks. */
void scene_key_place(const scene *s, const char *path, char *text, size_t size);

/* Whether the deck, or --set, has the key of this path ("time.cfl.mpm"). */
bool scene_has_key(const scene *s, const char *path);

#endif

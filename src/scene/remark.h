/* Warnings about a scene that can run but will not give the right answer: for `floe check` and the log of a run. */
#ifndef SCENE_REMARK_H
#define SCENE_REMARK_H

#include "scene/scene.h"

/* Takes a remark: a sentence or two, without a line's end. */
typedef void remark_sink(void *user, const char *text);

/* Gives all warnings; most scenes have none. */
void scene_remarks(const scene *s, remark_sink *say, void *user);

/* A remark with the place in the deck of the key that it begins with, or of the body or material that it names first, as refusals have it. */
void remark_with_place(const scene *s, const char *text, char *out, size_t size);

#endif

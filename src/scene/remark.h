/* Remarks on a scene that can be run and will not be right: for `floe check` and the log of a run. */
#ifndef SCENE_REMARK_H
#define SCENE_REMARK_H

#include "scene/scene.h"

/* Takes a remark: a sentence or two, without a line's end. */
typedef void remark_sink(void *user, const char *text);

/* Says all that there is to say; nothing of most scenes. */
void scene_remarks(const scene *s, remark_sink *say, void *user);

#endif

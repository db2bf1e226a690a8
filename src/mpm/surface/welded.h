/* Bodies that move as one because they have one velocity of the nodes: where they touch, one surface bounds them (theory 7.2). */
#ifndef MPM_SURFACE_WELDED_H
#define MPM_SURFACE_WELDED_H

#include "scene/scene.h"

/* The shape whose surface a body has in space: its own; of bodies welded to each other the first has the union of all, and the others
 * have none (model NULL). */
typedef struct welded {
    shape shape;
    shape *part; /* of a union; NULL: the shape is the body's own */
} welded;

/* FLOE_NO_MEMORY. Released by welded_free. */
floe_status welded_find(const scene *s, const mesh *m, const scene_body *body, welded *out);
/* Whether a body's surface is that of others, too. */
bool welded_to_others(const scene *s, const mesh *m, const scene_body *body);
void welded_free(context *ctx, welded *w);

#endif

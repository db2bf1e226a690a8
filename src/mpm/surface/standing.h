/* Solids that stand on sides which they can leave: gas must come between them as they do (theory 7.2). */
#ifndef MPM_SURFACE_STANDING_H
#define MPM_SURFACE_STANDING_H

#include "geom/inset.h"
#include "scene/scene.h"

/* The shape whose surface bounds a solid of the scene: `whole`, which ends on the sides of the mesh; of one that can leave a side what lies a
 * hair's breadth off that side, whose surface is closed there. It refers to `part`. */
shape standing_shape(const scene *s, const mesh *m, const scene_body *body, const shape *whole, inset *part);

#endif

/* The rule for overlapping bodies in every coupling: a solid replaces a fluid, a fluid replaces the fluids after it in
 * the deck, and other solids replace a solid with `yields`; other overlaps of solids are refused. In mpm, the ambient
 * is a body of points that fills the rest of the domain. */
#ifndef SCENE_LAYOUT_H
#define SCENE_LAYOUT_H

#include "geom/compound.h"
#include "scene/scene.h"

typedef struct scene_layout {
    scene scene; /* the deck's, with the bodies' shapes as they are filled; nothing in it is owned */
    compound part[SCENE_MAX_BODIES];
    const scene *deck; /* that it lays out; not owned */
} scene_layout;

/* Lays out the bodies of a scene for a coupling. *out stays NULL where the deck's shapes are what is filled; the caller
 * frees it with memory_free. FLOE_BAD_INPUT: bodies that must not overlap, or an ambient that cannot be of points. */
floe_status scene_lay_out(scene_layout **out, const scene *s, scene_coupling coupling, const mesh *m);

#endif

/* One deck is one scene for every coupling: keys that a coupling cannot follow are refused, and keys that only another
 * one reads are remarked on. */
#ifndef SCENE_UNSUPPORTED_H
#define SCENE_UNSUPPORTED_H

#include "scene/remark.h"

/* Refuses what the scene asks for and the coupling cannot do: sides, properties, loads and interactions.
 * FLOE_BAD_INPUT with the key, the reason and the remedy. */
floe_status scene_refuse_unsupported(const scene *s, scene_coupling coupling);

/* Says which keys of the deck the scene's coupling does not read, unless another coupling of `runs_as` reads them. */
void scene_remark_unused(const scene *s, remark_sink *say, void *user);

/* The same of sources of mass and vents (unsupported_sources.c). */
floe_status scene_refuse_sources(const scene *s, scene_coupling coupling);

/* The same of bodies with a motion of their own (unsupported_motion.c). */
floe_status scene_refuse_motions(const scene *s, scene_coupling coupling);

#endif

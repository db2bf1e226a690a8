/* Checks of what no single key shows. A check whose keys are already wrong keeps silent. Private to src/deck. */
#ifndef DECK_CHECK_H
#define DECK_CHECK_H

#include "deck/schema/schema.h"

/* The node at a path of keys ("time", "end"), ending with NULL; NULL when the deck does not have it. */
deck_node *node_path(deck_node *root, const char *const *key);
/* The same, or its nearest ancestor that exists: where to point when the key is absent. */
deck_node *nearest_path(deck_node *root, const char *const *key);
/* The node exists and no error was found in it. */
bool is_clean(deck_node *root, const char *const *key);
/* An error at a path: at the value if the key is there, else at the key of its nearest ancestor. */
floe_status bad_at(reader *r, const char *const *path, const char *expected, const char *hint, const char *format, ...)
    FLOE_PRINTF(5, 6);

/* After FLOE_BAD_INPUT of another module: its refusal, taken from the context, as an error at its key; other statuses
 * do not change. */
floe_status take_refusal(reader *r, floe_status status);

/* Does a coupling belong to runs_as? */
bool scene_runs_as(const scene *s, scene_coupling coupling);

/* check.c, check_boundaries.c, check_bodies.c, check_contact.c, check_reactions.c, check_sources.c, check_verify.c */
floe_status check_scene(reader *r);
floe_status check_boundaries(reader *r);
floe_status check_bodies(reader *r);
/* A membrane by its number among the bodies; its curve and the mesh are without faults. */
floe_status check_membrane_points(reader *r, int body);
floe_status check_loads(reader *r);
floe_status check_sources(reader *r);
floe_status check_contact(reader *r);
floe_status check_reactions(reader *r);
floe_status check_verify(reader *r);

#endif

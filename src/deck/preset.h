/* Choices of `method` under one name: `method: g03`, or `method: {preset: g03, basis: quadratic}`. On the tree, before
 * the schema sees it. Private to src/deck. */
#ifndef DECK_PRESET_H
#define DECK_PRESET_H

#include "deck/deck_errors.h"
#include "deck/tree.h"

/* `method: NAME` as the map that it stands for, so that --set finds keys under it. */
floe_status preset_open(deck_node *root, deck_arena *arena);
/* Puts the keys of the preset in place of its name, but for those that the deck gives. An unknown name becomes an error. */
floe_status preset_expand(deck_node *root, deck_arena *arena, error_list *errors);

#endif

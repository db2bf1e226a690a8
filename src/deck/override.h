/* `--set K=V` on the tree, before the schema sees it. Private to src/deck. */
#ifndef DECK_OVERRIDE_H
#define DECK_OVERRIDE_H

#include "deck/deck_errors.h"

/* Applies all of them in order. Keys are paths: names and list indices (from 0) joined by dots; maps on the way are
 * made where they are missing. Faults are entered in the errors. */
floe_status override_apply(deck_node *root, deck_arena *arena, const deck_overrides *set, error_list *errors);

#endif

/* What decks may name: exact solutions, bases and metrics, from their registries. */
#ifndef RUN_CATALOGUE_H
#define RUN_CATALOGUE_H

#include "deck/deck.h"

/* Makes the catalogue; the caller owns it. */
floe_status catalogue_create(deck_catalogue **out, context *ctx);
void catalogue_destroy(context *ctx, deck_catalogue **catalogue);

#endif

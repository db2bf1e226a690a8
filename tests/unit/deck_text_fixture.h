/* Scenes from decks in C strings, with the catalogue of the program. */
#ifndef TESTS_UNIT_DECK_TEXT_FIXTURE_H
#define TESTS_UNIT_DECK_TEXT_FIXTURE_H

#include "check.h"

#include "deck/deck.h"
#include "floe/floe.h"
#include "run/catalogue.h"

#include <string.h>

/* The deck must be valid. */
static inline scene *fixture_scene(context *ctx, const char *text)
{
    scene *s;
    deck_catalogue *catalogue;
    deck_report report = {0};
    assert_int_equal(floe_init(), FLOE_OK);
    check_ok(ctx, catalogue_create(&catalogue, ctx));
    const floe_status status = deck_load_text(&s, ctx, "test", text, strlen(text), NULL, catalogue, &report);
    if (report.text) print_message("%s", report.text);
    check_ok(ctx, status);
    deck_report_free(&report);
    catalogue_destroy(ctx, &catalogue);
    return s;
}

#endif

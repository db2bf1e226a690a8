/* Any text as a deck; what follows a zero byte is one --set. It loads, or is refused with a report; nothing is left in memory; and a deck
 * that loads is written out resolved, loads again, and is then written in the same words. */
#include "fuzz.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "run/catalogue.h"

#include <string.h>

static context *ctx;
static deck_catalogue *catalogue;

static void begin(void)
{
    if (ctx) return;
    ctx = context_create();
    deck_init();
    fuzz_require(ctx && catalogue_create(&catalogue, ctx) == FLOE_OK, "no catalogue");
}

/* The resolved deck; NULL if the text makes none. The caller frees it. */
static char *resolve(const char *text, size_t length, const deck_overrides *set)
{
    char *echo = NULL;
    deck_report report = {0};
    scene *s = NULL;
    const floe_status status = deck_load_text(&s, ctx, "deck.yaml", text, length, set, catalogue, &report);
    fuzz_require((status == FLOE_OK) == (s != NULL), "a scene of a deck that does not load, or none of one that does");
    fuzz_require(status == FLOE_OK || (status == FLOE_BAD_INPUT && report.count > 0 && report.text && report.text[0]),
                 "refused without a report");
    if (status == FLOE_OK) fuzz_require(deck_echo(&echo, s, catalogue) == FLOE_OK, "a scene that cannot be written");
    scene_destroy(&s);
    deck_report_free(&report);
    context_clear(ctx);
    return echo;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin();
    const uint64_t before = memory_read_account(ctx).live_bytes;
    char *text = malloc(size + 1);
    fuzz_require(text != NULL, "no memory");
    memcpy(text, data, size);
    text[size] = '\0';
    const size_t length = strlen(text);
    const char *assignment = text + length + 1;
    const deck_overrides set = {&assignment, length < size ? 1 : 0};
    char *first = resolve(text, length, &set);
    if (first) {
        char *second = resolve(first, strlen(first), NULL);
        fuzz_require(second && strcmp(first, second) == 0, "a resolved deck is not resolved to itself");
        memory_free(ctx, &second);
    }
    memory_free(ctx, &first);
    free(text);
    fuzz_require(memory_read_account(ctx).live_bytes == before, "memory is lost");
    return 0;
}

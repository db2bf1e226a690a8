/* A load in which any allocation may fail, and texts that are cut off or damaged anywhere. */
#include "unit/test_deck_common.h"

#include <stdio.h>
#include <stdlib.h>

enum { DECK_SIZE = 16384 };

typedef struct fixture {
    context *ctx;
    catalogue_store store;
    char text[DECK_SIZE];
    size_t length;
} fixture;

static int set_up(void **state)
{
    static fixture f;
    FILE *file = fopen(FLOE_SOURCE_DIR "/inputs/pressurized_cylinder.yaml", "rb");
    if (!file) return -1;
    f.length = fread(f.text, 1, sizeof f.text - 1, file);
    fclose(file);
    deck_init();
    f.ctx = context_create();
    make_catalogue(&f.store);
    *state = &f;
    return f.ctx ? 0 : -1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    assert_int_equal(memory_read_account(f->ctx).live_bytes, 0);
    context_destroy(&f->ctx);
    return 0;
}

static floe_status load(fixture *f, const char *text, size_t length, const deck_overrides *set)
{
    deck_report report;
    scene *s;
    const floe_status status = deck_load_text(&s, f->ctx, "deck.yaml", text, length, set, &f->store.catalogue, &report);
    check_true((status == FLOE_OK) == (s != NULL));
    check_true((status == FLOE_BAD_INPUT) == (report.text != NULL));
    deck_report_free(&report);
    scene_destroy(&s);
    return status;
}

/* Fails the n-th allocation for n = 1, 2, ... until the load no longer notices; nothing may be left behind. */
static void sweep(fixture *f, const deck_overrides *set, floe_status in_the_end)
{
    for (uint64_t n = 1;; n++) {
        assert_true(n < 100000);
        memory_inject_failure(f->ctx, n);
        const floe_status status = load(f, f->text, f->length, set);
        memory_inject_failure(f->ctx, 0);
        assert_int_equal(memory_read_account(f->ctx).live_bytes, 0);
        context_clear(f->ctx);
        if (status == in_the_end) return;
        assert_int_equal(status, FLOE_NO_MEMORY);
    }
}

static void load_survives_every_failed_allocation(void **state)
{
    sweep(*state, NULL, FLOE_OK);
}

static void errors_survive_every_failed_allocation(void **state)
{
    static const char *const set[] = {"domain.cel=1", "materials.steel.density=-1", "bodies.bore.shape={bal: {}}"};
    const deck_overrides overrides = {set, sizeof set / sizeof set[0]};
    sweep(*state, &overrides, FLOE_BAD_INPUT);
}

static void echo_survives_every_failed_allocation(void **state)
{
    fixture *f = *state;
    deck_report report;
    scene *s;
    check_ok(f->ctx, deck_load_text(&s, f->ctx, "deck.yaml", f->text, f->length, NULL, &f->store.catalogue, &report));
    for (uint64_t n = 1;; n++) {
        char *text;
        memory_inject_failure(f->ctx, n);
        const floe_status status = deck_echo(&text, s, &f->store.catalogue);
        memory_inject_failure(f->ctx, 0);
        check_true((status == FLOE_OK) == (text != NULL));
        memory_free(f->ctx, &text);
        context_clear(f->ctx);
        if (status == FLOE_OK) break;
        assert_int_equal(status, FLOE_NO_MEMORY);
    }
    scene_destroy(&s);
}

/* A deck cut off anywhere is refused or loads; it never crashes. */
static void cut_decks_are_judged(void **state)
{
    fixture *f = *state;
    char text[DECK_SIZE];
    for (size_t length = 0; length < f->length; length += 7) {
        memcpy(text, f->text, length);
        text[length] = '\0';
        const floe_status status = load(f, text, length, NULL);
        check_true(status == FLOE_OK || status == FLOE_BAD_INPUT);
        context_clear(f->ctx);
    }
}

static void damaged_decks_are_judged(void **state)
{
    fixture *f = *state;
    char text[DECK_SIZE];
    static const char damage[] = "{}[]:,-#'\"&*!|>%@\n 9\xC3\x01";
    unsigned seed = 12345;
    for (int i = 0; i < 600; i++) {
        memcpy(text, f->text, f->length + 1);
        for (int k = 0; k < 3; k++) {
            seed = seed * 1103515245u + 12345u;
            const size_t at = (seed >> 8) % f->length;
            text[at] = damage[(seed >> 4) % (sizeof damage - 1)];
        }
        const floe_status status = load(f, text, f->length, NULL);
        check_true(status == FLOE_OK || status == FLOE_BAD_INPUT);
        context_clear(f->ctx);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(load_survives_every_failed_allocation, set_up, tear_down),
        cmocka_unit_test_setup_teardown(errors_survive_every_failed_allocation, set_up, tear_down),
        cmocka_unit_test_setup_teardown(echo_survives_every_failed_allocation, set_up, tear_down),
        cmocka_unit_test_setup_teardown(cut_decks_are_judged, set_up, tear_down),
        cmocka_unit_test_setup_teardown(damaged_decks_are_judged, set_up, tear_down),
    };
    return cmocka_run_group_tests_name("deck_memory", tests, NULL, NULL);
}

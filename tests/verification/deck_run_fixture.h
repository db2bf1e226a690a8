/* Decks that stand in a test as texts, loaded and run. */
#ifndef TESTS_VERIFICATION_DECK_RUN_FIXTURE_H
#define TESTS_VERIFICATION_DECK_RUN_FIXTURE_H

#include "check.h"

#include "base/memory.h"
#include "base/threads.h"
#include "deck/deck.h"
#include "run/catalogue.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Tests use what they need of it. */
#define FIXTURE static inline

typedef struct bench {
    context *ctx;
    deck_catalogue *catalogue;
    scene *scene;
    sim *sim;
} bench;

FIXTURE floe_status load(bench *t, const char *text, const char *const *set, size_t n, deck_report *report)
{
    const deck_overrides overrides = {set, n};
    (void)threads_use(1); /* tests run side by side */
    *t = (bench){.ctx = context_create()};
    check_ok(t->ctx, catalogue_create(&t->catalogue, t->ctx));
    return deck_load_text(&t->scene, t->ctx, "deck", text, strlen(text), &overrides, t->catalogue, report);
}

FIXTURE void begin(bench *t, const char *text, const char *const *set, size_t n)
{
    deck_report report;
    const floe_status status = load(t, text, set, n, &report);
    if (report.text) print_error("%s", report.text);
    deck_report_free(&report);
    check_ok(t->ctx, status);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, t->scene->coupling));
    check_ok(t->ctx, sim_open_ledger(t->sim));
}

FIXTURE void run_until(bench *t, double until)
{
    while (t->sim->time < until) check_ok(t->ctx, sim_step(t->sim, until));
    check_ok(t->ctx, sim_update_ledger(t->sim));
}

FIXTURE void end(bench *t)
{
    sim_destroy(&t->sim);
    scene_destroy(&t->scene);
    catalogue_destroy(t->ctx, &t->catalogue);
    assert_int_equal(memory_read_account(t->ctx).live_bytes, 0);
    context_destroy(&t->ctx);
}

/* All drifts of the run so far; and those of what gas at rest has more of than round-off. */
FIXTURE void check_drifts(bench *t, double most)
{
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) check_true(fabs(ledger_largest_drift(&t->sim->ledger, q)) <= most);
}

FIXTURE void check_drifts_at_rest(bench *t, double most)
{
    check_true(fabs(ledger_largest_drift(&t->sim->ledger, LEDGER_MASS)) <= most);
    check_true(fabs(ledger_largest_drift(&t->sim->ledger, LEDGER_ENERGY)) <= most);
}

#endif

/* Contexts, messages, decks (floe/floe.h). */
#include "library/library_internal.h"

#include "base/memory.h"
#include "floe_build.h"
#include "io/io.h"
#include "run/catalogue.h"

#include <gsl/gsl_errno.h>
#include <string.h>

#include <pthread.h>

/* What is said once to a process's libraries is, of necessity, state of the process. */
static pthread_once_t init_once = PTHREAD_ONCE_INIT;
static floe_status init_status = FLOE_OK;

static void init_library(void)
{
    gsl_set_error_handler_off();
    deck_init();
    init_status = io_init(NULL);
}

floe_status floe_init(void)
{
    return pthread_once(&init_once, init_library) == 0 ? init_status : FLOE_INTERNAL;
}

const char *floe_version(void)
{
    return FLOE_VERSION;
}

floe_context *floe_create(void)
{
    context *ctx = context_create();
    floe_context *floe = NULL;
    if (memory_new(ctx, &floe, 1, sizeof *floe) != FLOE_OK) {
        context_destroy(&ctx);
        return NULL;
    }
    floe->ctx = ctx;
    return floe;
}

void floe_destroy(floe_context **floe)
{
    if (!floe || !*floe) return;
    context *ctx = (*floe)->ctx;
    for (size_t i = 0; i < (*floe)->n_law; i++) memory_free(ctx, &(*floe)->law[i].params);
    for (size_t i = 0; i < (*floe)->n_eos; i++) memory_free(ctx, &(*floe)->eos[i].params);
    memory_free(ctx, &(*floe)->law);
    memory_free(ctx, &(*floe)->eos);
    deck_report_free(&(*floe)->report);
    memory_free(ctx, floe);
    context_destroy(&ctx);
}

const char *floe_message(const floe_context *floe)
{
    if (!floe) return "";
    return floe->report.text ? floe->report.text : context_message(floe->ctx);
}

void library_clear_messages(floe_context *floe)
{
    deck_report_free(&floe->report);
    context_clear(floe->ctx);
}

void library_log(void *user, log_level level, const char *line)
{
    static const floe_log_level levels[] = {[LOG_ERROR] = FLOE_LOG_ERROR,
                                            [LOG_WARNING] = FLOE_LOG_WARNING,
                                            [LOG_INFO] = FLOE_LOG_INFO,
                                            [LOG_DETAIL] = FLOE_LOG_DETAIL};
    const floe_context *floe = user;
    floe->log(floe->log_user, levels[level], line);
}

void floe_log(floe_context *floe, floe_log_function *log, void *user, floe_log_level most)
{
    static const log_level levels[] = {[FLOE_LOG_ERROR] = LOG_ERROR,
                                       [FLOE_LOG_WARNING] = LOG_WARNING,
                                       [FLOE_LOG_INFO] = LOG_INFO,
                                       [FLOE_LOG_DETAIL] = LOG_DETAIL};
    floe->log = log;
    floe->log_user = user;
    floe->detail = levels[most];
    context_set_sink(floe->ctx, log ? library_log : NULL, floe, floe->detail);
}

/* The catalogue with the program's laws; catalogue_destroy takes it back. */
static floe_status make_catalogue(const floe_context *floe, deck_catalogue **out)
{
    TRY(catalogue_create(out, floe->ctx));
    (*out)->law = floe->law;
    (*out)->n_law = floe->n_law;
    (*out)->eos = floe->eos;
    (*out)->n_eos = floe->n_eos;
    return FLOE_OK;
}

/* `text` NULL: of the file. */
static floe_status read_deck(floe_deck *deck, const char *path, const char *text, const deck_overrides *set)
{
    floe_context *floe = deck->floe;
    deck_catalogue *catalogue;
    TRY(make_catalogue(floe, &catalogue));
    const floe_status status =
        text ? deck_load_text(&deck->scene, floe->ctx, path, text, strlen(text), set, catalogue, &floe->report)
             : deck_load(&deck->scene, floe->ctx, path, set, catalogue, &floe->report);
    catalogue_destroy(floe->ctx, &catalogue);
    return status;
}

static floe_status load_deck(floe_context *floe, const char *path, const char *text, const deck_overrides *set,
                             floe_deck **deck)
{
    *deck = NULL;
    library_clear_messages(floe);
    TRY(memory_new(floe->ctx, deck, 1, sizeof **deck));
    (*deck)->floe = floe;
    const floe_status status = read_deck(*deck, path, text, set);
    if (status != FLOE_OK) floe_deck_destroy(deck);
    return status;
}

floe_status floe_load(floe_context *floe, const char *path, const char *const *set, size_t n_set, floe_deck **deck)
{
    return load_deck(floe, path, NULL, &(deck_overrides){set, n_set}, deck);
}

floe_status floe_load_text(floe_context *floe, const char *name, const char *text, const char *const *set, size_t n_set,
                           floe_deck **deck)
{
    return load_deck(floe, name, text, &(deck_overrides){set, n_set}, deck);
}

void floe_deck_destroy(floe_deck **deck)
{
    if (!deck || !*deck) return;
    context *ctx = (*deck)->floe->ctx;
    scene_destroy(&(*deck)->scene);
    memory_free(ctx, deck);
}

/* Contexts, messages, decks (floe/floe.h). */
#include "library/library_internal.h"

#include "base/memory.h"
#include "base/strbuf.h"
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

/* A deck, as it is asked for. */
typedef struct source {
    const char *path, *text; /* `text` NULL: of the file */
    deck_overrides set;
    bool axes; /* every value of its axes, too */
} source;

/* The errors, and behind them how many there are. */
static void end_report(floe_context *floe)
{
    char *whole;
    strbuf text;
    if (!floe->report.text) return;
    strbuf_init(&text, floe->ctx);
    strbuf_append(&text, "%s%s", floe->report.text, context_message(floe->ctx));
    if (strbuf_take(&text, &whole) == FLOE_OK) {
        memory_free(floe->ctx, &floe->report.text);
        floe->report.text = whole;
    }
    strbuf_free(&text);
}

static floe_status read_deck(floe_deck *deck, const source *from)
{
    floe_context *floe = deck->floe;
    deck_catalogue *catalogue;
    TRY(make_catalogue(floe, &catalogue));
    const floe_status status =
        from->text   ? deck_load_text(&deck->scene, floe->ctx, from->path, from->text, strlen(from->text), &from->set,
                                      catalogue, &floe->report)
        : from->axes ? deck_check(&deck->scene, floe->ctx, from->path, &from->set, catalogue, &floe->report)
                     : deck_load(&deck->scene, floe->ctx, from->path, &from->set, catalogue, &floe->report);
    catalogue_destroy(floe->ctx, &catalogue);
    end_report(floe);
    return status;
}

static floe_status load_deck(floe_context *floe, source from, floe_deck **deck)
{
    *deck = NULL;
    library_clear_messages(floe);
    TRY(memory_new(floe->ctx, deck, 1, sizeof **deck));
    (*deck)->floe = floe;
    const floe_status status = read_deck(*deck, &from);
    if (status != FLOE_OK) floe_deck_destroy(deck);
    return status;
}

floe_status floe_load(floe_context *floe, const char *path, const char *const *set, size_t n_set, floe_deck **deck)
{
    return load_deck(floe, (source){.path = path, .set = {set, n_set}}, deck);
}

floe_status floe_validate(floe_context *floe, const char *path, const char *const *set, size_t n_set, floe_deck **deck)
{
    return load_deck(floe, (source){.path = path, .set = {set, n_set}, .axes = true}, deck);
}

floe_status floe_load_text(floe_context *floe, const char *name, const char *text, const char *const *set, size_t n_set,
                           floe_deck **deck)
{
    return load_deck(floe, (source){.path = name, .text = text, .set = {set, n_set}}, deck);
}

void floe_deck_destroy(floe_deck **deck)
{
    if (!deck || !*deck) return;
    context *ctx = (*deck)->floe->ctx;
    scene_destroy(&(*deck)->scene);
    memory_free(ctx, deck);
}

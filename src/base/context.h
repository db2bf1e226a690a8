/* A context carries what would otherwise be global: the last message, the memory account, the log.
 * One context per simulation or command; every object that can fail holds a pointer to one.
 * Functions marked "any thread" may be called inside a parallel region. */
#ifndef BASE_CONTEXT_H
#define BASE_CONTEXT_H

#include "base/compiler.h"
#include "floe/status.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { CONTEXT_MESSAGE_SIZE = 2048, CONTEXT_KEY_SIZE = 256 };

typedef enum log_level { LOG_ERROR, LOG_WARNING, LOG_INFO, LOG_DETAIL } log_level;

/* Receives one line (no newline at its end). `user` is what was handed to context_set_sink. */
typedef void log_sink(void *user, log_level level, const char *line);

typedef struct context context;

/* Makes a context that logs to nobody; NULL only when memory is out. The caller owns it. */
context *context_create(void);
/* Frees *ctx and sets it NULL; NULL and NULL content are fine. In a debug build a leak of counted memory is
 * reported. */
void context_destroy(context **ctx);

/* Records the message of a failure where it is found, and returns `code` (any thread; the first message of
 * a failure is kept until context_clear). A message says what was wrong, the values, and the remedy. */
floe_status fail(context *ctx, floe_status code, const char *format, ...) FLOE_PRINTF(3, 4);

/* The path of a key of the deck: KEY("bodies", "bag", "shape"). */
#define KEY(...) ((const char *const[]){__VA_ARGS__, NULL})
/* A failure caused by a key of the deck: FLOE_BAD_INPUT, with the message "bodies.bag.shape: CAUSE". The key is also
 * stored by itself, so that the reader of the deck can add its line and column. The cause has the value and the remedy
 * (any thread; `key` is copied). */
floe_status fail_key(context *ctx, const char *const *key, const char *format, ...) FLOE_PRINTF(3, 4);
/* Puts a prefix before the key of a refusal by a function that knows only the end of it: "radius" under KEY("bodies",
 * "bag") becomes "bodies.bag.radius"; a FLOE_BAD_INPUT without a key gets this one. Other statuses do not change.
 * Returns `status`. */
floe_status fail_under(context *ctx, floe_status status, const char *const *above);

/* The message of the last failure, "" when there is none. Owned by the context. */
const char *context_message(const context *ctx);
/* The key that it is about, its names joined by dots; "" if there is none. Owned by the context. */
const char *context_key(const context *ctx);
/* The message without the key before it. Owned by the context. */
const char *context_cause(const context *ctx);
void context_clear(context *ctx);

void context_set_sink(context *ctx, log_sink *sink, void *user, log_level most_detail);
/* One formatted line to the sink, if `level` is not beyond the sink's detail (any thread). */
void context_log(context *ctx, log_level level, const char *format, ...) FLOE_PRINTF(3, 4);

/* What becomes non-zero when work is asked to end early: a signal, say. Not owned; NULL: never. Work that may take minutes asks
 * context_must_stop between its parts, and returns FLOE_INTERRUPTED with its state as it was. */
void context_watch(context *ctx, const volatile sig_atomic_t *stop);
bool context_must_stop(const context *ctx);

const char *status_name(floe_status status); /* "FLOE_RETRY" */
const char *status_text(floe_status status); /* the sentence of FLOE_STATUS_LIST */
int status_exit(floe_status status);         /* the exit status of the command line (docs/outputs.md) */

/* Returns from the calling function when `expression` is not FLOE_OK. */
#define TRY(expression)                                 \
    do {                                                \
        const floe_status try_status_ = (expression);   \
        if (try_status_ != FLOE_OK) return try_status_; \
    } while (0)

#endif

#include "base/context.h"

#include "base/compiler.h"
#include "base/context_internal.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static void context_init_account(context *ctx)
{
    atomic_init(&ctx->attempts, 0);
    atomic_init(&ctx->allocations, 0);
    atomic_init(&ctx->live_bytes, 0);
    atomic_init(&ctx->peak_bytes, 0);
    atomic_init(&ctx->fail_from, 0);
}

context *context_create(void)
{
    context *ctx = calloc(1, sizeof *ctx);
    if (ctx == NULL) return NULL;
    if (pthread_mutex_init(&ctx->message_lock, NULL) != 0) goto free_context;
    if (pthread_mutex_init(&ctx->log_lock, NULL) != 0) goto destroy_message_lock;
    context_init_account(ctx);
    ctx->most_detail = LOG_INFO;
    return ctx;

destroy_message_lock:
    pthread_mutex_destroy(&ctx->message_lock);
free_context:
    free(ctx);
    return NULL;
}

/* A context without a sink has nobody to tell, and a leak must not pass unseen: then it goes to stderr. */
static void context_report_leak(context *ctx)
{
    const uint64_t live = atomic_load(&ctx->live_bytes);
    if (live == 0) return;
    if (ctx->sink != NULL) {
        context_log(ctx, LOG_ERROR, "memory leak: %" PRIu64 " bytes still live at context_destroy", live);
    } else {
        fprintf(stderr, "floe: memory leak: %" PRIu64 " bytes still live at context_destroy\n", live);
    }
}

void context_watch(context *ctx, const volatile sig_atomic_t *stop)
{
    ctx->stop = stop;
}

bool context_must_stop(const context *ctx)
{
    return ctx->stop && *ctx->stop;
}

void context_destroy(context **ctx)
{
    if (ctx == NULL || *ctx == NULL) return;
    if (FLOE_CHECKS) context_report_leak(*ctx);
    pthread_mutex_destroy(&(*ctx)->log_lock);
    pthread_mutex_destroy(&(*ctx)->message_lock);
    free(*ctx);
    *ctx = NULL;
}

/* Formats into text[size]; what does not fit is cut and the cut is shown by "...". */
static void format_bounded(char *text, size_t size, const char *format, va_list arguments) FLOE_PRINTF(3, 0);

static void format_bounded(char *text, size_t size, const char *format, va_list arguments)
{
    const int length = vsnprintf(text, size, format, arguments);
    if (length < 0) {
        snprintf(text, size, "(a message could not be formatted: \"%.200s\")", format);
    } else if ((size_t)length >= size) {
        memcpy(text + size - 4, "...", 4);
    }
}

floe_status fail(context *ctx, floe_status code, const char *format, ...)
{
    /* A failure reported as success would be lost: it is a fault of the caller. */
    const floe_status reported = code == FLOE_OK ? FLOE_INTERNAL : code;
    if (ctx == NULL) return reported;
    pthread_mutex_lock(&ctx->message_lock);
    if (!ctx->failed) {
        va_list arguments;
        va_start(arguments, format);
        format_bounded(ctx->message, sizeof ctx->message, format, arguments);
        va_end(arguments);
        ctx->failed = true;
    }
    pthread_mutex_unlock(&ctx->message_lock);
    return reported;
}

/* "a.b.c"; names that do not fit are left out, and the key is then that of what they are in. */
static void join_names(const char *const *name, char key[CONTEXT_KEY_SIZE])
{
    size_t length = 0;
    key[0] = '\0';
    for (; *name; name++) {
        const size_t more = (length > 0) + strlen(*name);
        if (length + more >= CONTEXT_KEY_SIZE) return;
        length += (size_t)snprintf(key + length, CONTEXT_KEY_SIZE - length, "%s%s", length > 0 ? "." : "", *name);
    }
}

/* Writes the message anew: the key, and behind it the cause, which is no part of the message. */
static void append_cause(context *ctx, const char *cause)
{
    const char *colon = ctx->key[0] ? ": " : "";
    (void)snprintf(ctx->message, sizeof ctx->message, "%s%s%.1700s", ctx->key, colon, cause);
    ctx->cause = strlen(ctx->key) + strlen(colon);
}

floe_status fail_key(context *ctx, const char *const *key, const char *format, ...)
{
    if (ctx == NULL) return FLOE_BAD_INPUT;
    pthread_mutex_lock(&ctx->message_lock);
    if (!ctx->failed) {
        char cause[CONTEXT_MESSAGE_SIZE];
        va_list arguments;
        va_start(arguments, format);
        format_bounded(cause, sizeof cause, format, arguments);
        va_end(arguments);
        join_names(key, ctx->key);
        append_cause(ctx, cause);
        ctx->failed = true;
    }
    pthread_mutex_unlock(&ctx->message_lock);
    return FLOE_BAD_INPUT;
}

floe_status fail_under(context *ctx, floe_status status, const char *const *above)
{
    if (status != FLOE_BAD_INPUT || ctx == NULL) return status;
    char own[CONTEXT_KEY_SIZE], cause[CONTEXT_MESSAGE_SIZE];
    pthread_mutex_lock(&ctx->message_lock);
    memcpy(own, ctx->key, sizeof own);
    (void)snprintf(cause, sizeof cause, "%s", ctx->message + ctx->cause);
    join_names(above, ctx->key);
    const size_t length = strlen(ctx->key);
    if (own[0] && length + 1 + strlen(own) < sizeof ctx->key) {
        ctx->key[length] = '.';
        memcpy(ctx->key + length + 1, own, strlen(own) + 1);
    }
    append_cause(ctx, cause);
    pthread_mutex_unlock(&ctx->message_lock);
    return status;
}

const char *context_message(const context *ctx)
{
    return ctx == NULL ? "" : ctx->message;
}

const char *context_key(const context *ctx)
{
    return ctx == NULL ? "" : ctx->key;
}

const char *context_cause(const context *ctx)
{
    return ctx == NULL ? "" : ctx->message + ctx->cause;
}

void context_clear(context *ctx)
{
    if (ctx == NULL) return;
    pthread_mutex_lock(&ctx->message_lock);
    ctx->failed = false;
    ctx->message[0] = ctx->key[0] = '\0';
    ctx->cause = 0;
    pthread_mutex_unlock(&ctx->message_lock);
}

void context_set_sink(context *ctx, log_sink *sink, void *user, log_level most_detail)
{
    if (ctx == NULL) return;
    pthread_mutex_lock(&ctx->log_lock);
    ctx->sink = sink;
    ctx->sink_user = user;
    ctx->most_detail = most_detail;
    pthread_mutex_unlock(&ctx->log_lock);
}

/* The sink is promised a line without a newline at its end. */
static void strip_newlines(char *line)
{
    size_t length = strlen(line);
    while (length > 0 && line[length - 1] == '\n') line[--length] = '\0';
}

void context_log(context *ctx, log_level level, const char *format, ...)
{
    if (ctx == NULL) return;
    pthread_mutex_lock(&ctx->log_lock);
    if (ctx->sink != NULL && level <= ctx->most_detail) {
        char line[CONTEXT_MESSAGE_SIZE];
        va_list arguments;
        va_start(arguments, format);
        format_bounded(line, sizeof line, format, arguments);
        va_end(arguments);
        strip_newlines(line);
        ctx->sink(ctx->sink_user, level, line);
    }
    pthread_mutex_unlock(&ctx->log_lock);
}

typedef struct status_entry {
    const char *name;
    const char *text;
    int exit_status;
} status_entry;

static const status_entry status_table[FLOE_STATUS_COUNT] = {
#define STATUS_ENTRY(name, exit_status, text) [name] = {#name, text, exit_status},
    FLOE_STATUS_LIST(STATUS_ENTRY)
#undef STATUS_ENTRY
};

/* An unknown code can only come from a fault of floe's own. */
static const status_entry *status_find(floe_status status)
{
    const int code = (int)status;
    return &status_table[code >= 0 && code < (int)FLOE_STATUS_COUNT ? code : (int)FLOE_INTERNAL];
}

const char *status_name(floe_status status)
{
    return status_find(status)->name;
}

const char *status_text(floe_status status)
{
    return status_find(status)->text;
}

int status_exit(floe_status status)
{
    return status_find(status)->exit_status;
}

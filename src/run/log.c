#include "run/log.h"

#include "base/timer.h"

#include <string.h>

static const char *level_name(log_level level)
{
    switch (level) {
    case LOG_ERROR: return "error";
    case LOG_WARNING: return "warning";
    case LOG_INFO: return "info";
    case LOG_DETAIL: return "detail";
    }
    return "";
}

/* A log that cannot be written does not end the run: what it says is said elsewhere too. */
static void write_log_line(void *user, log_level level, const char *line)
{
    run_log *log = user;
    char text[CONTEXT_MESSAGE_SIZE + 64];
    const int size =
        snprintf(text, sizeof text, "%10.3f s  %-7s  %s\n", wall_seconds() - log->started, level_name(level), line);
    /* A failure here must not take the place of the message that is being logged: it goes to nobody. */
    context *ctx = log->file.ctx;
    log->file.ctx = NULL;
    if (size > 0 && log->file.path) (void)line_file_append(&log->file, text, strlen(text));
    log->file.ctx = ctx;
    if (!log->options->sink || level > log->options->sink_detail) return;
    progress_clear(log->progress);
    log->options->sink(log->options->sink_user, level, line);
}

static floe_status open_in(run_log *log, const char *dir, bool keep)
{
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/run.log", dir);
    if (!keep || !file_exists(path)) TRY(file_replace_text(log->ctx, path, ""));
    return line_file_open(&log->file, log->ctx, path);
}

floe_status run_log_open(run_log *log, context *ctx, const run_options *options, progress *p)
{
    *log = (run_log){.ctx = ctx, .options = options, .progress = p, .started = wall_seconds()};
    TRY(open_in(log, options->dir, options->resume));
    log->open = true;
    context_set_sink(ctx, write_log_line, log, LOG_DETAIL);
    return FLOE_OK;
}

floe_status run_log_reopen(run_log *log, const char *dir)
{
    line_file_close(&log->file);
    return open_in(log, dir, true);
}

void run_log_close(run_log *log)
{
    if (!log->open) return;
    context_set_sink(log->ctx, log->options->sink, log->options->sink_user, log->options->sink_detail);
    line_file_close(&log->file);
    log->open = false;
}

/* DIR/run.log: what a run has to say, one line each, beside whoever else listens. */
#ifndef RUN_LOG_H
#define RUN_LOG_H

#include "io/file.h"
#include "run/progress.h"
#include "run/run.h"

typedef struct run_log {
    context *ctx;               /* not owned */
    const run_options *options; /* not owned: the other listener */
    progress *progress;         /* not owned: the live line is taken away before others write */
    line_file file;             /* owned */
    bool open;
    double started; /* wall clock, s */
} run_log;

/* Opens DIR/run.log, anew or at its end, and becomes the context's sink. */
floe_status run_log_open(run_log *log, context *ctx, const run_options *options, progress *p);
/* Goes on in the folder `dir`, where the log may be or not. */
floe_status run_log_reopen(run_log *log, const char *dir);
/* Gives the context its sink of before (options->sink). A log that is not open is fine. */
void run_log_close(run_log *log);

#endif

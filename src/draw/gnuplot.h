/* gnuplot as a process. */
#ifndef DRAW_GNUPLOT_H
#define DRAW_GNUPLOT_H

#include "base/context.h"

/* Runs DIR/SCRIPT in DIR for each of the n scripts, by one gnuplot. True when all have run. That gnuplot is missing, or fails,
 * is a warning in the log, never a failure: the scripts are there. */
bool gnuplot_run(context *ctx, const char *dir, const char *const *script, size_t n);

#endif

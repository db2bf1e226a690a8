/* gnuplot as a process. */
#ifndef DRAW_GNUPLOT_H
#define DRAW_GNUPLOT_H

#include "base/context.h"

typedef enum gnuplot_result { GNUPLOT_DONE, GNUPLOT_FAILED, GNUPLOT_MISSING } gnuplot_result;

/* Runs DIR/SCRIPT in DIR for each of the n scripts, by one gnuplot. That it is missing, or that a script fails, is a
 * warning in the log, never a failure: the scripts are there. */
gnuplot_result gnuplot_run(context *ctx, const char *dir, const char *const *script, size_t n);

#endif

/* gnuplot as a process. */
#ifndef DRAW_GNUPLOT_H
#define DRAW_GNUPLOT_H

#include "base/context.h"

/* Runs DIR/script in DIR. That gnuplot is missing, or fails, is a warning in the log, never a failure: the script is there. */
void gnuplot_run(context *ctx, const char *dir, const char *script);

#endif

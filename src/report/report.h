/* `floe report`: results as one page of HTML that holds all it shows. */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "base/context.h"

typedef struct report_options {
    const char *const *dir; /* n_dirs folders that floe run, compare, study or stability have written */
    size_t n_dirs;
    const char *file;   /* the page; plots go beside it, to the folder of its name without ".html" and with "_files" */
    const char *title;  /* NULL: that of what is shown */
    const double *time; /* s, n_times: of the field pictures, the nearest snapshots; none: the first and the last */
    size_t n_times;
} report_options;

/* Writes the page and its plots. FLOE_BAD_INPUT for a folder without results, before anything is written. What a folder
 * lacks (an older version's, an unfinished run's) is left out of the page. */
floe_status report_write(context *ctx, const report_options *options);

#endif

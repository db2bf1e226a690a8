/* A run's results as pieces of a page. Private to src/study/report. */
#ifndef REPORT_RUN_SECTION_H
#define REPORT_RUN_SECTION_H

#include "io/csv.h"
#include "report/page.h"

/* What the sections of one run share. */
typedef struct run_view {
    page *page; /* not owned */
    const char *dir;
    const struct json_t *summary; /* not owned */
    char stem[PLOT_STEM];         /* before the names of its plots */
    bool dimensionless;           /* set by run_view_write */
    bool brief;                   /* one of many: what tells them apart, and no more */
} run_view;

/* All of a run: facts, errors, plots, ledger, times. */
floe_status run_view_write(run_view *v);

/* Its history as plots, and its ledger as a table. */
floe_status run_history(const run_view *v);
/* Its fields as pictures, at the times that the page asks for. */
floe_status run_pictures(const run_view *v);
/* Its profile (DIR/FILE) beside the exact solution; `by` is NULL, or the column whose values are runs to be told
 * apart. */
floe_status run_profile(page *p, const char *dir, const char *file, const char *stem, const char *by);

/* The title of the deck in a run's folder, or else the folder's own name. */
floe_status run_title(page *p, const char *dir, char title[PAGE_TEXT]);
/* Facts of a list in progress: with what it was run, and when FILE of the folder was written. */
void run_build_facts(strbuf *out, const struct json_t *summary, const char *dir, const char *file);
/* The last part of a path. */
const char *base_name(const char *path);
/* Sets name to "STEM-NAME", for a plot. */
void plot_name(const run_view *v, const char *name, char out[PLOT_STEM]);

#endif

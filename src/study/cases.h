/* The cases of a comparison, and how they are run. Private to src/study. */
#ifndef STUDY_CASES_H
#define STUDY_CASES_H

#include "study/compare.h"

/* What makes a case of the deck: the user's settings, then its coupling and its value of the axis. */
typedef struct case_set {
    const char **text; /* counted memory, owned */
    size_t n;
    char coupling[64], axis[256];
} case_set;

floe_status case_set_make(case_set *set, const comparison *c, const compare_options *o, const compare_case *one);
void case_set_free(context *ctx, case_set *set);

/* The case's folder, DIR/FOLDER. */
void case_path(const comparison *c, const compare_case *one, char path[COMPARE_PATH]);
/* "[2/6] mpm, domain.cell=0.05" */
void case_label(const comparison *c, size_t i, char label[160]);
/* Tells the user how a case has ended. */
void case_report(const comparison *c, const compare_options *o, size_t i);

/* Runs the cases one after the other in this process; FLOE_INTERRUPTED when asked to stop. */
floe_status cases_run_here(comparison *c, const compare_options *o);
/* Runs up to o->jobs cases at a time, each in a process of its own (src/study/cases_jobs.c). */
floe_status cases_run_as_jobs(comparison *c, const compare_options *o);

#endif

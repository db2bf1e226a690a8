/* `floe compare`: one deck in every coupling and along an axis, side by side: errors, orders, run times. */
#ifndef STUDY_COMPARE_H
#define STUDY_COMPARE_H

#include "study/batch.h"

enum { COMPARE_PATH = 4096, COMPARE_MAX_METRICS = SUMMARY_MAX_ERRORS };

typedef struct compare_options {
    const char *deck; /* path */
    deck_overrides set;
    const char *axis;                  /* "KEY=V1,V2,..." instead of the deck's; NULL: the deck's */
    const char *dir;                   /* of the results, one folder in it for each case; made if it is not there */
    int threads;                       /* of each case; 0: one, which is what the times are compared at */
    int jobs;                          /* cases at a time; 0: one */
    const char *program;               /* the floe program, which runs the cases */
    const volatile sig_atomic_t *stop; /* as in run_options */
    FILE *progress;                    /* NULL: quiet */
} compare_options;

/* One run of the comparison. */
typedef struct compare_case {
    scene_coupling coupling;
    char value[64];   /* of the axis; "" without one */
    double h;         /* m: domain.cell along the first axis */
    const char **set; /* what makes the case of the deck: the user's settings, then its coupling and its value; owned */
    char coupling_set[64], axis_set[256];
    batch_case *run; /* in comparison.run */
} compare_case;

typedef struct comparison {
    context *ctx;    /* not owned */
    char *deck_path; /* owned */
    char *dir;       /* owned */
    char title[256];
    char exact[SCENE_NAME]; /* "" if none */
    scene_axis axis;        /* n_values 0: none */
    compare_case *list;     /* owned */
    batch_case *run;        /* its runs, n as well; owned */
    size_t n;
} comparison;

/* Runs all cases, writes compare.json, compare.csv and the plots, and leaves the results in *out (owned by the caller).
 * A case that diverges is a result. FLOE_INTERRUPTED: the rest was not run, and what there is was written. */
floe_status compare_run(comparison **out, context *ctx, const compare_options *options);
void compare_destroy(comparison **c);

/* The table of a comparison: one line a case, then the fitted orders. */
floe_status compare_print(const comparison *c, FILE *file);

/* Names of the errors that any case has, in the order in which they come; returns how many. */
int compare_metrics(const comparison *c, const char *name[COMPARE_MAX_METRICS]);
/* The distinct couplings, in order; returns how many. */
int compare_couplings(const comparison *c, scene_coupling coupling[COUPLING_COUNT]);

/* Errors of one metric and coupling over h, and the power law fitted to them. */
typedef struct compare_order {
    double h[SCENE_MAX_AXIS], error[SCENE_MAX_AXIS];
    size_t n;
    double order, standard_error; /* NAN where nothing can be fitted */
} compare_order;
compare_order compare_fit(const comparison *c, scene_coupling coupling, const char *name);

/* compare.json and compare.csv. */
floe_status compare_write(const comparison *c);
/* compare.gp, profile.csv, and, with gnuplot, errors.svg and profile.svg. */
floe_status compare_plot(const comparison *c);

#endif

/* `floe run --tolerance`: the answer of a deck to within an error, by the cheapest of the variants that its `study`
 * names.
 *
 * The study's axes give the variants and their spacings. Its cases are run from cheap to dear, each a process, until
 * one of them is within the tolerance (study/tolerance/choose.h). The error is measured where the deck has an exact
 * solution or a reference, and else estimated from the last values of a quantity over spacings. DIR then holds that
 * case's outputs, DIR/cases all that was run, as a study. */
#ifndef STUDY_TOLERANCE_H
#define STUDY_TOLERANCE_H

#include "study/study.h"
#include "study/tolerance/choose.h"

enum { TOLERANCE_TEXT = 512 };

typedef struct tolerance_options {
    /* Its name and dir are set by the call; axes and the rest as in a study, one case at a time, untimed. */
    study_options study;
    const char *dir;  /* of the answer */
    double tolerance; /* > 0; of errors that are ratios, and of estimates, relative; else in the error's unit */
    /* An error of the deck's verify.metrics, or one of its study.quantities; NULL: the first ratio among the errors,
     * the first error, the first quantity. */
    const char *metric;
    double budget; /* s of run time, of all cases together, earlier legs included; 0: no limit */
} tolerance_options;

typedef struct tolerance {
    context *ctx;                     /* not owned */
    const tolerance_options *options; /* not owned */
    study_options study_options;      /* those of `study` */
    char cases[BATCH_PATH];           /* DIR/cases */
    study *study;                     /* owned */
    char metric[SCENE_NAME];          /* an error, or a quantity */
    int quantity;                     /* index in the study's quantities; -1: an error that is measured */
    choose_curve *curve;              /* one a group of the study; owned */
    choose_case *list;                /* of all curves; owned */
    size_t *index;                    /* the study's case of each entry of `list`; owned */
    choose_step step;                 /* what was decided last */
    bool met;
    bool published; /* DIR has the outputs of a case */
} tolerance;

/* Runs cases until one is within the tolerance, and makes DIR of it. *out, owned by the caller, says what was done.
 * FLOE_BAD_INPUT: the deck has no study, no spacings, or nothing to measure an error by; nothing was run.
 * FLOE_MISSED_BAR: no case reaches the tolerance, or not in the time given: the message says how near the best came and
 * what it would take; DIR has the best case. FLOE_INTERRUPTED: stopped; the same call goes on. */
floe_status tolerance_run(tolerance **out, context *ctx, const tolerance_options *options);
void tolerance_destroy(tolerance **t);

/* The cases that were run with error, time and why each was the last of its kind, and what was chosen. */
floe_status tolerance_print(const tolerance *t, FILE *file);

/* What a variant's quantity is off by. */
typedef struct tolerance_estimate {
    double relative; /* bound on |value - limit|/|value|; NAN: too few values */
    bool sure;       /* the values converge, and are three at least */
    const char *how; /* in words */
    double order;    /* observed; NAN */
    double settled;  /* what a next value that is the same as the last would be off by; 0: not known */
} tolerance_estimate;
/* From n values f over spacings h, coarsest first. Three at least that approach their limit from one side, no faster
 * than with an order of 2.1, are extrapolated: with the observed order and a safety factor of 1.25 if four of them
 * agree on it, else with an order of at most one and a factor of 3. Others are taken to be off by twice what the last
 * three span. */
tolerance_estimate tolerance_estimate_of(size_t n, const double *h, const double *f);

#endif

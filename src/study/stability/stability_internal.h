/* The parts of a stability search. Private to src/study. */
#ifndef STUDY_STABILITY_INTERNAL_H
#define STUDY_STABILITY_INTERNAL_H

#include "study/crossed.h"
#include "study/stability/stability.h"

/* A value that is to be run. */
typedef struct stability_wish {
    size_t set;
    double x;                  /* of a search */
    int value[SCENE_MAX_OVER]; /* of a map: indices of the axes' values */
} stability_wish;

/* stability_setup.c: keys, ranges and combinations from the options and the deck; everything is checked. */
floe_status stability_setup(stability *s, const stability_options *o);

/* stability_cases.c */
/* The wishes as cases of a batch; the caller frees them. */
typedef struct stability_cases {
    batch_case *list;
    case_settings *settings; /* n of both */
    size_t n;
} stability_cases;
floe_status stability_cases_make(stability_cases *cases, const stability *s, const stability_options *o,
                                 const stability_wish *wish, size_t n);
void stability_cases_free(context *ctx, stability_cases *cases);
batch_options stability_batch(const stability *s, const stability_options *o);
/* Runs the wishes and notes their probes. */
floe_status stability_round(stability *s, const stability_options *o, const stability_wish *wish, size_t n);

#endif

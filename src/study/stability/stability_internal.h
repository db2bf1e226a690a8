/* The parts of a stability search. Private to src/study. */
#ifndef STUDY_STABILITY_INTERNAL_H
#define STUDY_STABILITY_INTERNAL_H

#include "study/crossed.h"
#include "study/stability/stability.h"

/* stability_setup.c: keys, ranges and combinations from the options and the deck; everything is checked. */
floe_status stability_setup(stability *s, const stability_options *o);

/* stability_cases.c */
/* A value of a search, or the values of a map by their indices, that is to be run. */
stability_probe stability_probe_at(const stability *s, size_t set, double x);
stability_probe stability_probe_of_map(const stability *s, size_t set, size_t cell);

/* Probes as cases of a batch; the caller frees them, whatever comes back. */
typedef struct stability_cases {
    batch_case *list;
    case_settings *settings; /* n of both */
    size_t n;
} stability_cases;
floe_status stability_cases_make(stability_cases *cases, const stability *s, const stability_options *o,
                                 const stability_probe *probe, size_t n);
void stability_cases_free(context *ctx, stability_cases *cases);
batch_options stability_batch(const stability *s, const stability_options *o);
/* Fills the verdict of a probe whose case has ended, and tells the search of its set. */
floe_status stability_judge_case(stability *s, stability_probe *p, const batch_case *one);

#endif

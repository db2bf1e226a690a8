/* A run's report on its own accuracy: drifts of mass, momentum and energy, and counts of lost points, floors, guards
 * and merged cells. */
#ifndef RUN_TRUTH_H
#define RUN_TRUTH_H

#include "io/summary.h"

/* The bars that each quantity's largest drift has passed so far. */
typedef struct run_truth {
    int passed[LEDGER_QUANTITIES];
} run_truth;

/* From the current ledger; a resumed run does not repeat what was logged before. */
void truth_begin(run_truth *t, const sim *s);
/* Logs each bar, 1 and 10 %, when a drift passes it. Cheap enough for every step. */
void truth_log(run_truth *t, const sim *s);
/* Sets out->notes, for the last line of a run, and adds what is beyond 10 % to its warnings. */
void truth_summarise(const sim *s, run_summary *out);

#endif

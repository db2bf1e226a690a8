/* What a run says of its own truth: how far mass, momentum and energy have drifted, and what was lost, floored, guarded
 * or merged on the way. */
#ifndef RUN_TRUTH_H
#define RUN_TRUTH_H

#include "io/summary.h"

/* The bars that each quantity's largest drift has passed so far. */
typedef struct run_truth {
    int passed[LEDGER_QUANTITIES];
} run_truth;

/* From the account as it is: what a run that goes on has said already is not said again. */
void truth_begin(run_truth *t, const sim *s);
/* Logs each bar, 1 and 10 %, when a drift passes it. Cheap enough for every step. */
void truth_log(run_truth *t, const sim *s);
/* Sets out->notes, for the last line of a run, and adds what is beyond 10 % to its warnings. */
void truth_summarise(const sim *s, run_summary *out);

#endif

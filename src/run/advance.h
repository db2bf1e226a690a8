/* What goes with each step of a simulation, whoever makes the steps: rest, the account, threads. */
#ifndef RUN_ADVANCE_H
#define RUN_ADVANCE_H

#include "run/truth.h"

/* Sets the threads of the steps to come and returns their number: `named`, or the scene's, where above 0, else what the
 * scene can use. */
int advance_choose_threads(const sim *s, int named);
/* Whether the scene's end, its largest number of steps or rest is reached. */
bool advance_is_finished(const sim *s);
/* After a step that began at `before` (s): looks for rest, where the scene asks for it. */
floe_status advance_check_rest(sim *s, double before);
/* The same for the account, which is brought up to date every so many steps. FLOE_DIVERGED: energy has come from
 * nothing. */
floe_status advance_check_ledger(sim *s, run_truth *truth);

#endif

/* The engine of study, compare, stability and runs to a tolerance: cases -> judge -> table.
 *
 *     deck, axes --next--> cases of a round --batch--> their summaries, histories --take--> verdicts --write--> table
 *                    ^                                                                |
 *                    +----------------------------------------------------------------+
 *
 * A judge names the cases of a round, looks at what they have come to, and names the next, until it has no question left:
 * a study asks once, and once more for times; a search of stability bisects; a run to a tolerance asks case by case. */
#ifndef STUDY_JUDGE_H
#define STUDY_JUDGE_H

#include "batch/batch.h"

/* The cases that a judge wants next, and how they are run. */
typedef struct case_round {
    batch_options batch;
    batch_case *list; /* the judge's, there until it is asked again */
    size_t n;         /* 0: it has what it wants */
} case_round;

typedef struct case_judge {
    floe_status (*next)(void *of, case_round *round);
    /* Of a batch that was stopped, some cases are BATCH_WAITING. */
    floe_status (*take)(void *of, const case_round *round);
    /* The results, from what was taken. */
    floe_status (*write)(void *of);
    /* After all of it: FLOE_MISSED_BAR, with what was not reached, ... */
    floe_status (*conclude)(void *of);
} case_judge;

/* Runs rounds until the judge wants no more. FLOE_INTERRUPTED: stopped; what there is was taken and written, and the same
 * command goes on from there. Other errors of a batch or of the judge end it with nothing written. */
floe_status judge_cases(context *ctx, const case_judge *judge, void *of);

/* The scene of the deck with the user's settings alone. */
floe_status judge_base_scene(context *ctx, const batch_options *batch, const deck_overrides *set, scene **out);

#endif

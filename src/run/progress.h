/* Progress of a run: on a terminal one live line, elsewhere a plain line now and then. */
#ifndef RUN_PROGRESS_H
#define RUN_PROGRESS_H

#include "run/live_line.h"
#include "sim/sim.h"

typedef struct progress {
    live_line line;
    const char *label;  /* not owned; NULL: none */
    double started;     /* wall clock, s */
    double first_time;  /* s of the scene, at the start */
    double drift;       /* the largest of the run so far */
    const char *drifts; /* of what */
} progress;

/* Begins at the present time of `s`. */
void progress_begin(progress *p, FILE *file, const char *label, const sim *s);
/* Takes note of the ledger, which has just been brought up to date. */
void progress_show_ledger(progress *p, const ledger *l);
/* Shows where the run stands, if it is time to; cheap enough to be called after every step. */
void progress_show(progress *p, const sim *s);
/* Takes the live line away, so that other lines can be written. */
void progress_clear(progress *p);

#endif

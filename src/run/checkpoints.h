/* The checkpoints of a run: on its way, and at its ends. */
#ifndef RUN_CHECKPOINTS_H
#define RUN_CHECKPOINTS_H

#include "run/checkpoint_clock.h"
#include "run/output.h"

typedef struct run_checkpoints {
    run_output *output; /* not owned */
    sim *sim;           /* not owned */
    checkpoint_clock clock;
    double seconds; /* wall time that checkpoints took, those at the ends included */
    double time;    /* of the latest one, s; NAN: there is none */
    long steps;     /* of the latest one of this leg; -1: there is none */
    int64_t owed;   /* what that one says is owed */
    bool failed;    /* one during the run failed, and this was logged */
    bool told;      /* that they are spaced out */
} run_checkpoints;

/* `started`: wall clock at the start of the run; `cost`: what the first checkpoint is expected to take, s. */
run_checkpoints run_checkpoints_start(run_output *o, sim *s, double started, double cost);
/* Reserves disk space for one, unless the deck wants no checkpoints during the run; logs where the disk has none. */
void run_checkpoints_reserve(run_checkpoints *c);
/* Writes one now, unless there is one of this time; uses the reserved space if necessary. `wall` as for
 * output_checkpoint. */
floe_status run_checkpoints_write(run_checkpoints *c, double wall);
/* Writes one during the run if the clock says that one is due. A failure is only logged: the run is sound, and the
 * earlier ones stay. */
floe_status run_checkpoints_way(run_checkpoints *c, double wall);
/* Logs the time that checkpoints during the run took. */
void run_checkpoints_say(const run_checkpoints *c);

#endif

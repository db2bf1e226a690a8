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
    bool failed;    /* one on the way has, and this was said */
    bool told;      /* that they are spaced out */
} run_checkpoints;

/* `started`: wall clock at the start of the run; `cost`: what the first checkpoint is expected to take, s. */
run_checkpoints run_checkpoints_start(run_output *o, sim *s, double started, double cost);
/* Keeps room on the disk for one, unless the deck wants none on the way; says where there is none. */
void run_checkpoints_keep_room(run_checkpoints *c);
/* Writes one now, unless there is one of now; the room that was kept is used if it must be. `wall` as for
 * output_checkpoint. */
floe_status run_checkpoints_write(run_checkpoints *c, double wall);
/* Writes one on the way, where the clock says that one is due. That it cannot be written is only said: the run is sound, and the earlier ones stay. */
floe_status run_checkpoints_way(run_checkpoints *c, double wall);
/* Says what those on the way took. */
void run_checkpoints_say(const run_checkpoints *c);

#endif

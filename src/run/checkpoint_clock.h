/* When a run writes checkpoints on its way. Left to floe: with every snapshot and every two minutes of wall time, as long
 * as all of them together stay within 2 % of the wall time of the run; one that would not waits until it does. What a
 * kill costs is thus the work since the last snapshot, two minutes, or fifty times what a checkpoint takes, whichever
 * is met last. No result depends on it. */
#ifndef RUN_CHECKPOINT_CLOCK_H
#define RUN_CHECKPOINT_CLOCK_H

#include <stdbool.h>

#define CHECKPOINT_CLOCK_SHARE 0.02  /* of the wall time */
#define CHECKPOINT_CLOCK_LONGEST 120 /* s of wall time without one */

/* All times are s of wall time. */
typedef struct checkpoint_clock {
    double interval; /* what the deck says: a time, NAN: left to floe, INFINITY: none */
    double started;  /* when the run, or this leg of it, did */
    double last;     /* when the last checkpoint was begun; at first `started` */
    double cost;     /* what the next one is expected to take */
    double spent;    /* on all of them */
    long written;
    long passed;   /* snapshots that came before the checkpoint of the one before them */
    bool snapshot; /* one has come since the last checkpoint */
} checkpoint_clock;

/* `cost` is what the first one is expected to take. */
checkpoint_clock checkpoint_clock_start(double interval, double now, double cost);
/* A snapshot has been written. */
void checkpoint_clock_see_snapshot(checkpoint_clock *c);
/* Is a checkpoint to be written now? */
bool checkpoint_clock_is_due(const checkpoint_clock *c, double now);
/* One was written, or tried, from `begun` to `now`. */
void checkpoint_clock_count(checkpoint_clock *c, double begun, double now);

#endif

/* Cases of one deck as processes of their own (`floe run`), some at a time.
 *
 * A case that diverges, is killed, cannot be read or takes too long is a result with its cause, and the rest go on. A
 * finished case leaves FOLDER/case.json, by which a later batch knows it and need not run it again; a case that was cut
 * short can go on from its checkpoint, and else is run again from its start. One batch at a time in a folder: DIR and
 * each case's folder are locked while they are written to. */
#ifndef BATCH_BATCH_H
#define BATCH_BATCH_H

#include "base/sha256.h"
#include "deck/deck.h"
#include "io/summary.h"

#include <signal.h>

enum { BATCH_PATH = 4096, BATCH_MESSAGE = 512 };

typedef enum batch_state { BATCH_WAITING, BATCH_RUNNING, BATCH_ENDED } batch_state;

typedef struct batch_case {
    char label[160];        /* "mpm, domain.cell=0.05", for people */
    char folder[256];       /* in the batch's; made if it is not there */
    const char *const *set; /* n_set of "KEY=VALUE": what makes the case of the deck; not owned */
    size_t n_set;
    double weight; /* expected cost in any unit, for the time that is left; 0: unknown, taken as 1 */

    /* Filled by batch_prepare. */
    char hash[SHA256_TEXT]; /* of the resolved deck; "" before */
    double end;             /* s: the deck's time.end */

    /* Filled by batch_run. */
    batch_state state;  /* BATCH_WAITING after it: not run, as the batch was stopped */
    floe_status status; /* FLOE_OK, FLOE_DIVERGED, FLOE_INTERRUPTED (out of time), FLOE_BAD_INPUT (no run can be
                                    made of it), FLOE_INTERNAL (killed by a signal), ... */
    bool ran;           /* summary holds something */
    bool kept;          /* it was finished before and has not been run again */
    bool resumed;       /* it went on from its checkpoint: its times are those of no single run */
    bool start_over;    /* its checkpoint could not be gone on with */
    bool timed_out;     /* max_wall was reached */
    char message[BATCH_MESSAGE]; /* why it is not FLOE_OK */
    bool alone;                  /* it ran alone on one thread, as far as the batch knows: its time counts */
    double other_cores;          /* processor time that others used while it ran, per wall time; NAN: unknown */
    double process_seconds;      /* processor time of its whole process, s; NAN: unknown */
    run_summary summary;
} batch_case;

typedef struct batch_options {
    const char *program; /* the floe program */
    const char *deck;    /* path */
    const char *dir;
    int jobs;           /* cases at a time; 0: one */
    int threads;        /* of each; 0: one */
    double max_wall;    /* s of each case, or of each leg of one that goes on; 0: no limit */
    bool keep_finished; /* cases that have ended before with the very same resolved deck are not run again */
    bool go_on;         /* a case that was cut short goes on from its checkpoint, if this build of floe began it, of the
                           very same resolved deck */
    bool thin;          /* of a case that has ended, its snapshots and checkpoint are removed */
    const volatile sig_atomic_t *stop; /* becomes non-zero when the batch is asked to stop; NULL: never */
    FILE *progress;                    /* NULL: quiet */
} batch_options;

/* Loads the case's deck: hash and end are filled, and *out (may be NULL) gets the scene, which the caller owns.
 * FLOE_BAD_INPUT: all errors are in the context's message. */
floe_status batch_prepare(context *ctx, const batch_options *o, batch_case *one, scene **out);

/* Runs the cases. FLOE_INTERRUPTED when asked to stop: those that have not ended are BATCH_WAITING, and the same batch
 * goes on with them. Other errors are those of the batch itself (its folder, its processes), not of its cases. */
floe_status batch_run(context *ctx, const batch_options *o, batch_case *list, size_t n);

/* Takes over the cases that have ended before, and runs none: the others are BATCH_WAITING. */
floe_status batch_recall(context *ctx, const batch_options *o, batch_case *list, size_t n);

/* "done", "at_rest", "diverged", "timed_out", "interrupted", "failed", "not_run". */
const char *batch_status_name(const batch_case *one);

/* This program's own file, for batch_options.program; `name` is argv[0], taken where the system does not tell. */
void batch_find_program(char path[BATCH_PATH], const char *name);

#endif
